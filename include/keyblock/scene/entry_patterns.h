// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_entry_patterns_h
#define keyblock_scene_entry_patterns_h

#include <deal.II/base/patterns.h>

namespace Keyblock::EntryPatterns
{
  using dealii::Patterns::Double;
  using dealii::Patterns::Integer;

  inline const Double any_number;
  inline const Double not_negative(0.);
  inline const Double positive(1e-300);
  inline const Double fraction(0., 1.);
  inline const Double friction_range(0., 89.9);
} // namespace Keyblock::EntryPatterns

#endif

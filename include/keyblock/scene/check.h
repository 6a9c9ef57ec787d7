// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_check_h
#define keyblock_scene_check_h

#include <keyblock/base/errors.h>
#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /** Throw InputError with @p sentence unless @p condition holds. */
  inline void
  require(const bool condition, const std::string &sentence)
  {
    AssertThrow(condition, InputError(sentence));
  }

  /** Contradictions between the entries of the domain; throws InputError. They
   * are looked for before joints are made in it. */
  template <int dim>
  void check_domain(const Scene<dim> &scene);
} // namespace Keyblock

#endif

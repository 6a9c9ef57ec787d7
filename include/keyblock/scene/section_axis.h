// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_section_axis_h
#define keyblock_scene_section_axis_h

#include <keyblock/scene/domain.h>

// Sections are extruded along y and then turned about Excavation::pivot, so
// that this axis has the trend and the plunge of the entries, and x of the
// section stays level.
namespace Keyblock
{
  /** The place of @p p, given across, along and upwards in the section. */
  Point<3> from_section(const Excavation<3> &excavation, const Point<3> &p);

  /** The place of @p p across, along and upwards in the section. */
  Point<3> to_section(const Excavation<3> &excavation, const Point<3> &p);
} // namespace Keyblock

#endif

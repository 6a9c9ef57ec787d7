// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_polygon_h
#define keyblock_scene_polygon_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Why @p corners do not bound a simple area: an outline that crosses or
   * touches itself, a spike, no area; empty if they do. The first corner need
   * not be repeated at the end. */
  std::string fault_of_polygon(const std::vector<dealii::Point<2>> &corners);

  /** Leave out the last of the @p corners of an @p entry if it is the first one
   * again. Throws InputError if others that follow each other are the same. */
  template <int dim>
  void tidy_corners(std::vector<dealii::Point<dim>> &corners,
                    const std::string &entry);
} // namespace Keyblock

#endif

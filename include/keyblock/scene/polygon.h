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

  /**
   * Convex polygons that together are a simple one, each by the numbers of its
   * corners, counterclockwise: the polygon itself if it is convex, else
   * triangles. Corners within straight edges may be left out of triangles.
   */
  std::vector<std::vector<unsigned int>>
  convex_parts(const std::vector<dealii::Point<2>> &corners);

  /** The convex hull of a simple polygon. Its sides are straight from corner
   * to corner; edges of the polygon lie on them or beside pockets. */
  struct HullOfPolygon
  {
    struct Side
    {
      unsigned int begin, end;         ///< corners, the hull to the left
      std::vector<unsigned int> edges; ///< of the polygon, on the side
    };
    struct Pocket
    {
      std::vector<dealii::Point<2>> corners;
      std::vector<unsigned int> edges; ///< of the polygon
    };
    std::vector<Side> sides;
    std::vector<Pocket> pockets;

    explicit HullOfPolygon(const std::vector<dealii::Point<2>> &corners);
  };

  /** Leave out the last of the @p corners of an @p entry if it is the first one
   * again. Throws InputError if others that follow each other are the same. */
  template <int dim>
  void tidy_corners(std::vector<dealii::Point<dim>> &corners,
                    const std::string &entry);
} // namespace Keyblock

#endif

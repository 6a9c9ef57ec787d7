// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_solid_h
#define keyblock_scene_solid_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Keyblock
{
  using dealii::Point;

  /** Triangles between points. */
  struct TriangleSurface
  {
    using Triangle = std::array<unsigned int, 3>;
    using Edge     = std::pair<unsigned int, unsigned int>; ///< lesser first

    /** The edge of a triangle from its vertex @p i. */
    static Edge
    edge_of(const Triangle &t, const unsigned int i)
    {
      return std::minmax(t[i], t[(i + 1) % 3]);
    }

    std::vector<Point<3>> vertices;
    std::vector<Triangle> triangles;

    /** Make one vertex of those that coincide up to @p tolerance and drop
     * triangles without three different ones. */
    void weld(const double tolerance);

    /** Turn triangles as their neighbours, outward. Returns why they do not
     * bound a body: an open edge, or one with more than two triangles; empty if
     * they do. */
    std::string orient();

    /** Turn triangles as their neighbours, also of an open surface. Returns why
     * that cannot be: an edge with more than two triangles, or one side only;
     * empty if it can. */
    std::string align();

    /** Parts that are not connected by edges. */
    std::vector<TriangleSurface> components() const;

    /** Volume that oriented triangles enclose [m3]. */
    double volume() const;
  };

  /** A body bounded by triangles: what a file of an excavation contains, or
   * stands for it where its surface is curved. */
  class Solid
  {
  public:
    /** Of triangles that orient() has turned. */
    explicit Solid(TriangleSurface surface);
    ~Solid();

    /** Distance [m] of @p p from the surface, positive inside. */
    double depth_inside(const Point<3> &p) const;

    const TriangleSurface surface;
    Point<3> low, high; ///< corners of the box around it [m]

  private:
    struct Search;

    std::unique_ptr<const Search> search;
  };
} // namespace Keyblock

#endif

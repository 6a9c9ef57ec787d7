// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_joint_sheet_h
#define keyblock_mesh_joint_sheet_h

#include <keyblock/mesh/surface.h>
#include <keyblock/scene/joint_extent.h>

#include <memory>
#include <vector>

namespace Keyblock
{
  /**
   * What is cut into a mesh as a whole: a joint, or the plane facets of a bent
   * one, which share corners. It has two sides: plus is where the normal of its
   * first facet points to, of the other facets that of their neighbour. Facets
   * are numbered from 0. Of a single joint all is as JointExtent has it.
   */
  template <int dim>
  class JointSheet
  {
  public:
    /** @p joints: indices into Scene::joints, see joints_by_surface() */
    JointSheet(const Scene<dim> &scene,
               const std::vector<unsigned int> &joints);
    ~JointSheet();

    const std::vector<unsigned int> joints; ///< by number of the facet

    /** By number of the facet. */
    std::vector<JointExtent<dim>> facets;

    bool
    is_plane() const
    {
      return facets.size() == 1;
    }

    /** Whether it has no rim; a bent one has. */
    bool
    is_infinite() const
    {
      return is_plane() && facets[0].is_infinite();
    }

    /** Distance [m] of @p p from the sheet, positive on its plus side; beyond a
     * rim from the plane of the facet there. */
    double distance(const Point<dim> &p) const;

    /** Unit normal at the point of the sheet nearest to @p p, to its plus side:
     * along it distance() changes most. */
    Tensor<1, dim> normal_at(const Point<dim> &p) const;

    /** Distance [m] within the sheet from the point nearest to @p p to the rim,
     * positive inside; 1e300 without a rim. */
    double depth_inside(const Point<dim> &p) const;

    /** Where the sheet crosses the way from @p a to @p b, from 0 to 1; if it
     * does not, where their distances from it suggest. */
    double crossing(const Point<dim> &a,
                    const Point<dim> &b,
                    const double distance_a,
                    const double distance_b) const;

    /** Number of the facet that a face with these corners lies on: of those at
     * its centre and near its corners the one whose plane it is least off. */
    unsigned int facet_along(const std::vector<Point<dim>> &corners) const;

    /** Whether that facet's normal points to the minus side. */
    bool is_turned(const unsigned int facet) const;

    /** Points that reach farthest [m]; none if it is infinite. */
    std::vector<Point<dim>> outermost_points() const;

    /** As JointExtent has them: sum of the facets' areas [m^(dim-1)]; half of
     * the length or twice the area over the length of the rim [m]. */
    double area() const;
    double half_width() const;

  private:
    struct Search;

    std::unique_ptr<const Search> search; ///< none of a single joint
  };
} // namespace Keyblock

#endif

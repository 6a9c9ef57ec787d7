// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_domain_outline_h
#define keyblock_scene_domain_outline_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /** The outer boundary of the modelled ground, and which joints reach into
   * it. In 2D any polygon, in 3D a box or parallelepiped. */
  template <int dim>
  class DomainOutline
  {
  public:
    /** Of a domain whose shape is not `file`. */
    explicit DomainOutline(const Domain<dim> &domain);

    /** Of a box. */
    DomainOutline(const Point<dim> &lower, const Point<dim> &upper);

    /** Whether a part of an infinite joint or of a disc is inside. */
    bool meets(const Joint<dim> &joint) const;

    /**
     * The part of the plane of @p joint within the outline (of a polygon:
     * within the box around it): its corners in order, in 2D its two ends;
     * empty if there is none.
     */
    std::vector<Point<dim>> cut(const Joint<dim> &joint) const;

    Point<dim> lower, upper; ///< corners of the box around it [m]

  private:
    /** Half spaces normal * x <= offset that hold the outline. */
    struct HalfSpace
    {
      Tensor<1, dim> normal;
      double offset; ///< [m]
    };

    void add_parallelepiped(const Point<dim> &corner,
                            const std::vector<Point<dim>> &edges);

    std::vector<HalfSpace> half_spaces;
    std::vector<Point<dim>> corners; ///< in order, in 2D
  };

  /** Unit vectors along a plane with normal @p n, at right angles. */
  template <int dim>
  std::vector<Tensor<1, dim>> directions_across(const Tensor<1, dim> &n);

  /** Volume of a domain whose shape is not `file` [m^dim]. */
  template <int dim>
  double volume_of(const Domain<dim> &domain);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/joint_extent.h>
#include <keyblock/scene/near_misses.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Planes at a smaller angle (sine) do not meet. */
    constexpr double least_sine_of_meeting = 1e-6;

    /** The way from the rim of a joint, within its plane, to the plane of
     * another one that it lies on one side of [m]; negative if it crosses it.
     */
    template <int dim>
    class WayToPlane
    {
    public:
      WayToPlane(const Joint<dim> &joint,
                 const JointExtent<dim> &extent,
                 const std::vector<Point<dim>> &corners,
                 const JointExtent<dim> &other)
        : ahead(other.normal - (other.normal * extent.normal) * extent.normal)
        , sine(ahead.norm())
      {
        if (sine < least_sine_of_meeting)
          return;
        if (joint.extent == JointShape::disc)
          add(joint.point, joint.radius, other);
        else
          for (const Point<dim> &corner : corners)
            add(corner, 0., other);
      }

      /** 1e300 if the planes do not meet. */
      double
      length() const
      {
        return has_above && has_below ? -1. : least;
      }

      Point<dim> foot; ///< where it ends

    private:
      void
      add(const Point<dim> &p,
          const double radius,
          const JointExtent<dim> &other)
      {
        const double height = other.distance(p) / sine; // within the plane
        has_above |= height + radius > 0.;
        has_below |= height - radius < 0.;
        if (std::abs(height) - radius < least)
          {
            least = std::abs(height) - radius;
            foot  = p - height / sine * ahead;
          }
      }

      const Tensor<1, dim> ahead;
      const double sine;
      double least   = 1e300;
      bool has_above = false, has_below = false;
    };
  } // namespace



  template <int dim>
  std::vector<NearMiss>
  list_near_misses(const Scene<dim> &scene,
                   const double least,
                   const double most)
  {
    std::vector<NearMiss> result;
    std::vector<JointExtent<dim>> extents;
    for (const auto &joint : scene.joints)
      extents.emplace_back(*joint);
    for (unsigned int j = 0; j < extents.size(); ++j)
      if (!extents[j].is_infinite())
        {
          const auto corners = extents[j].outermost_points();
          for (unsigned int other = 0; other < extents.size(); ++other)
            if (other != j)
              {
                const WayToPlane<dim> way(*scene.joints[j],
                                          extents[j],
                                          corners,
                                          extents[other]);
                if (way.length() > least && way.length() <= most &&
                    extents[other].depth_inside(way.foot) >= 0.)
                  result.push_back({j, other, way.length()});
              }
        }
    std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
      return a.gap < b.gap;
    });
    return result;
  }

  template std::vector<NearMiss>
  list_near_misses(const Scene<2> &, const double, const double);
  template std::vector<NearMiss>
  list_near_misses(const Scene<3> &, const double, const double);
} // namespace Keyblock

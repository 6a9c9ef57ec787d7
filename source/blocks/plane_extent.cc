// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/plane_extent.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Rounding of distances in units. */
    constexpr double rounding_of_extents = 1e-12;

    /** Sine between planes below which their line is not looked for. */
    constexpr double nearly_parallel = 1e-6;

    /** Corners of the polygon within a disc. */
    constexpr unsigned int n_disc_corners = 64;

    /** Number of edges of a polygon; a segment has one. */
    template <int dim>
    unsigned int
    n_sides(const std::vector<Point<dim>> &polygon)
    {
      return dim == 2 ? 1 : polygon.size();
    }

    /** Part a convex polygon by a plane n.x + d = 0: what lies where that is
     * positive is returned, the rest stays. */
    template <int dim>
    std::vector<Point<dim>>
    cut_off(std::vector<Point<dim>> &polygon,
            const std::pair<Tensor<1, dim>, double> &plane)
    {
      std::vector<Point<dim>> inside, outside;
      for (unsigned int i = 0; i < polygon.size(); ++i)
        {
          const Point<dim> &x = polygon[i],
                           &y = polygon[(i + 1) % polygon.size()];
          const double a      = plane.first * x + plane.second,
                       b      = plane.first * y + plane.second;
          (a > 0. ? outside : inside).push_back(x);
          if (i < n_sides(polygon) && (a > 0.) != (b > 0.))
            {
              inside.push_back(x + a / (a - b) * (y - x));
              outside.push_back(inside.back());
            }
        }
      polygon = inside;
      return outside;
    }



    template <int dim>
    bool
    cover_rest(const std::vector<const PlaneExtent<dim> *> &extents,
               const unsigned int first,
               std::vector<Point<dim>> polygon,
               const double narrow)
    {
      if (polygon.size() < dim || is_narrow(polygon, narrow))
        return true;
      if (first == extents.size())
        return false;
      if (extents[first]->covers(polygon))
        return true;
      for (const auto &edge : extents[first]->inner_rim())
        {
          const auto outside = cut_off(polygon, edge);
          if (!cover_rest(extents, first + 1, outside, narrow))
            return false;
          if (polygon.size() < dim)
            break;
        }
      return true;
    }
  } // namespace



  template <int dim>
  bool
  is_narrow(const std::vector<Point<dim>> &polygon, const double width)
  {
    if constexpr (dim == 2)
      return polygon[0].distance(polygon[1]) <= width;
    else
      {
        double perimeter = 0.;
        Tensor<1, dim> twice;
        for (unsigned int i = 0; i < polygon.size(); ++i)
          {
            const Tensor<1, dim> a = polygon[i] - polygon[0],
                                 b = polygon[(i + 1) % polygon.size()] -
                                     polygon[0];
            perimeter += (b - a).norm();
            twice += cross_product_3d(a, b);
          }
        return twice.norm() <= width * perimeter;
      }
  }



  template <int dim>
  PlaneExtent<dim>::PlaneExtent(const JointPiece<dim> &piece,
                                const ConvexCells<dim> &cells,
                                const double bridging)
    : joint(piece.joint)
    , plane{ConvexCells<dim>::nothing, 0}
    , tolerance(std::max(bridging / cells.length(), rounding_of_extents))
    , is_unbounded(piece.shape == JointPiece<dim>::Shape::unbounded)
    , is_disc(dim == 3 && piece.shape == JointPiece<dim>::Shape::disc)
    , normal(piece.normal / piece.normal.norm())
    , center(cells.to_unit(piece.point))
  {
    if (piece.shape == JointPiece<dim>::Shape::disc)
      radius = piece.radius / cells.length();
    if constexpr (dim == 2)
      if (piece.shape == JointPiece<dim>::Shape::disc)
        {
          const Tensor<1, dim> along = radius * cross_product_2d(normal);
          corners                    = {center - along, center + along};
        }
    if (piece.shape == JointPiece<dim>::Shape::polygon)
      {
        Tensor<1, dim> sum;
        for (const Point<dim> &corner : piece.corners)
          {
            corners.push_back(cells.to_unit(corner));
            sum += corners.back();
          }
        center = Point<dim>(sum / double(corners.size()));
        for (const Point<dim> &corner : corners)
          radius = std::max(radius, center.distance(corner));
      }
    make_rim();
    make_box();
  }



  template <int dim>
  void
  PlaneExtent<dim>::make_rim()
  {
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        const Tensor<1, dim> edge =
          corners[(i + 1) % corners.size()] - corners[i];
        Tensor<1, dim> outward;
        if constexpr (dim == 2)
          outward = -edge;
        else
          outward = cross_product_3d(edge, normal);
        if (outward.norm() == 0.)
          continue;
        outward /= outward.norm();
        if (outward * (center - corners[i]) > 0.)
          outward = -outward;
        rim.emplace_back(outward, -(outward * corners[i]));
      }
  }



  template <int dim>
  void
  PlaneExtent<dim>::make_box()
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (is_unbounded)
          {
            low[d]  = -1e300;
            high[d] = 1e300;
            continue;
          }
        const double half =
          is_disc ? radius * std::sqrt(std::max(0., 1. - normal[d] * normal[d]))
                  : 0.;
        low[d]  = center[d] - half;
        high[d] = center[d] + half;
        for (const Point<dim> &corner : corners)
          {
            low[d]  = std::min(low[d], corner[d]);
            high[d] = std::max(high[d], corner[d]);
          }
        low[d] -= tolerance;
        high[d] += tolerance;
      }
  }



  template <int dim>
  bool
  PlaneExtent<dim>::meets_box() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (low[d] > 1. || high[d] < -1.)
        return false;
    return true;
  }



  template <int dim>
  bool
  PlaneExtent<dim>::reaches(const ExactPlane<dim> &other, const int side) const
  {
    if (is_unbounded)
      return true;
    if (is_disc)
      {
        const double cosine = other.normal * normal;
        return side * other.distance(center) +
                 radius * std::sqrt(std::max(0., 1. - cosine * cosine)) >=
               -tolerance;
      }
    return std::any_of(corners.begin(), corners.end(), [&](const auto &corner) {
      return side * other.distance(corner) >= -tolerance;
    });
  }



  template <int dim>
  bool
  PlaneExtent<dim>::overlaps(const std::vector<Point<dim>> &section) const
  {
    // convex sets are apart if a line is between them: here the rim's edges,
    // and for a disc the tangent nearest to the hull
    const auto lies_beyond = [&](const Tensor<1, dim> &outward,
                                 const double offset) {
      return std::all_of(section.begin(), section.end(), [&](const auto &x) {
        return outward * x + offset > tolerance;
      });
    };
    for (const auto &[outward, offset] : rim)
      if (lies_beyond(outward, offset))
        return false;
    if (!is_disc || section.empty())
      return true;
    const Point<dim> nearest = *std::min_element(
      section.begin(), section.end(), [&](const auto &x, const auto &y) {
        return x.distance_square(center) < y.distance_square(center);
      });
    const Tensor<1, dim> outward = nearest - center;
    const double distance        = outward.norm();
    return distance <= radius + tolerance ||
           !lies_beyond(outward / distance,
                        -(outward * center) / distance - radius);
  }



  template <int dim>
  bool
  PlaneExtent<dim>::covers(const std::vector<Point<dim>> &polygon) const
  {
    if (is_unbounded)
      return true;
    return std::all_of(polygon.begin(), polygon.end(), [&](const auto &x) {
      if (is_disc)
        return x.distance(center) <= radius + tolerance;
      return std::all_of(rim.begin(), rim.end(), [&](const auto &edge) {
        return edge.first * x + edge.second <= tolerance;
      });
    });
  }



  /** Where the line p + t u lies in the extent, by t; empty if the first is
   * larger. */
  template <int dim>
  std::pair<double, double>
  PlaneExtent<dim>::interval(const Point<dim> &p, const Tensor<1, dim> &u) const
  {
    std::pair<double, double> part(-1e300, 1e300);
    if (is_disc)
      {
        const double middle = u * (center - p);
        const double r      = radius + tolerance;
        const double square = r * r - (p + middle * u).distance_square(center);
        if (square < 0.)
          return {1., -1.};
        return {middle - std::sqrt(square), middle + std::sqrt(square)};
      }
    for (const auto &[outward, offset] : rim)
      {
        const double slope = outward * u,
                     value = outward * p + offset - tolerance;
        if (std::abs(slope) < rounding_of_extents)
          {
            if (value > rounding_of_extents)
              return {1., -1.};
          }
        else if (slope > 0.)
          part.second = std::min(part.second, -value / slope);
        else
          part.first = std::max(part.first, -value / slope);
      }
    return part;
  }



  template <int dim>
  bool
  PlaneExtent<dim>::crosses(const PlaneExtent &other,
                            const ConvexCells<dim> &cells) const
  {
    if (!is_unbounded && !other.is_unbounded &&
        center.distance(other.center) > radius + other.radius + 2. * tolerance)
      return false;
    const ExactPlane<dim> &p = cells.plane(plane.plane),
                          &q = cells.plane(other.plane.plane);
    if (!reaches(q, -1) || !reaches(q, +1) || !other.reaches(p, -1) ||
        !other.reaches(p, +1))
      return false;
    if constexpr (dim == 3)
      {
        const Tensor<1, dim> u = cross_product_3d(p.normal, q.normal);
        const double sine      = u.norm();
        if (sine < nearly_parallel)
          return true;
        const Point<dim> x(
          cross_product_3d(q.offset * p.normal - p.offset * q.normal, u) /
          (sine * sine));
        const auto a = interval(x, u / sine), b = other.interval(x, u / sine);
        return std::max(a.first, b.first) <=
               std::min(a.second, b.second) + tolerance;
      }
    return true;
  }



  template <int dim>
  std::vector<std::pair<Tensor<1, dim>, double>>
  PlaneExtent<dim>::inner_rim() const
  {
    if constexpr (dim == 3)
      if (is_disc)
        {
          Tensor<1, dim> axis;
          axis[std::abs(normal[0]) < 0.6 ? 0 : 1] = 1.;
          Tensor<1, dim> u = cross_product_3d(normal, axis);
          u /= u.norm();
          const Tensor<1, dim> w = cross_product_3d(normal, u);
          const double pi        = dealii::numbers::PI;
          std::vector<std::pair<Tensor<1, dim>, double>> result;
          for (unsigned int i = 0; i < n_disc_corners; ++i)
            {
              const double angle = 2. * pi * i / n_disc_corners;
              const Tensor<1, dim> outward =
                std::cos(angle) * u + std::sin(angle) * w;
              result.emplace_back(outward,
                                  -(outward * center) -
                                    (radius + tolerance) *
                                      std::cos(pi / n_disc_corners));
            }
          return result;
        }
    auto result = rim;
    for (auto &edge : result)
      edge.second -= tolerance;
    return result;
  }



  template <int dim>
  bool
  cover_together(const std::vector<const PlaneExtent<dim> *> &extents,
                 const std::vector<Point<dim>> &polygon,
                 const double narrow)
  {
    return cover_rest(extents, 0, polygon, narrow);
  }



#define INSTANTIATE(dim)                                                       \
  template class PlaneExtent<dim>;                                             \
  template bool is_narrow(const std::vector<Point<dim>> &, const double);      \
  template bool cover_together(const std::vector<const PlaneExtent<dim> *> &,  \
                               const std::vector<Point<dim>> &,                \
                               const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/domain_outline.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Whether a part of the segment from @p a to @p b is inside a polygon. */
    bool
    reaches_into(const std::vector<Point<2>> &corners,
                 const Point<2> &a,
                 const Point<2> &b)
    {
      const auto cross = [](const Tensor<1, 2> &u, const Tensor<1, 2> &v) {
        return u[0] * v[1] - u[1] * v[0];
      };
      // where it crosses edges; between two crossings it is in or out
      std::vector<double> places = {0., 1.};
      const Tensor<1, 2> along   = b - a;
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          const Tensor<1, 2> edge =
                               corners[(i + 1) % corners.size()] - corners[i],
                             to = corners[i] - a;
          const double slope    = cross(along, edge);
          if (slope == 0.)
            continue;
          const double t = cross(to, edge) / slope,
                       s = cross(to, along) / slope;
          if (t > 0. && t < 1. && s >= 0. && s <= 1.)
            places.push_back(t);
        }
      std::sort(places.begin(), places.end());
      for (unsigned int k = 0; k + 1 < places.size(); ++k)
        {
          const Point<2> p = a + 0.5 * (places[k] + places[k + 1]) * along;
          bool is_inside   = false;
          for (unsigned int i = 0; i < corners.size(); ++i)
            {
              const Point<2> &c = corners[i],
                             &d = corners[(i + 1) % corners.size()];
              if ((c[1] > p[1]) != (d[1] > p[1]) &&
                  p[0] < c[0] + (p[1] - c[1]) / (d[1] - c[1]) * (d[0] - c[0]))
                is_inside = !is_inside;
            }
          if (is_inside && places[k] < places[k + 1])
            return true;
        }
      return false;
    }
  } // namespace



  template <int dim>
  std::vector<Tensor<1, dim>>
  directions_across(const Tensor<1, dim> &n)
  {
    if constexpr (dim == 2)
      {
        Tensor<1, dim> along;
        along[0] = -n[1];
        along[1] = n[0];
        return {along};
      }
    else
      {
        Tensor<1, dim> axis;
        axis[std::abs(n[2]) < 0.9 ? 2 : 0] = 1.;
        Tensor<1, dim> first               = dealii::cross_product_3d(n, axis);
        first /= first.norm();
        return {first, dealii::cross_product_3d(n, first)};
      }
  }



  template <int dim>
  DomainOutline<dim>::DomainOutline(const Domain<dim> &domain)
  {
    std::vector<Point<dim>> edges = domain.edges;
    if (domain.shape == DomainShape::polygon)
      {
        lower = upper = domain.polygon[0];
        for (const Point<dim> &corner : domain.polygon)
          for (unsigned int d = 0; d < dim; ++d)
            {
              lower[d] = std::min(lower[d], corner[d]);
              upper[d] = std::max(upper[d], corner[d]);
            }
        *this   = DomainOutline(lower, upper);
        corners = domain.polygon;
        return;
      }
    if (domain.shape == DomainShape::box)
      {
        edges.assign(dim, Point<dim>());
        for (unsigned int d = 0; d < dim; ++d)
          edges[d][d] = domain.size[d];
      }
    add_parallelepiped(domain.corner, edges);
  }



  template <int dim>
  DomainOutline<dim>::DomainOutline(const Point<dim> &lower,
                                    const Point<dim> &upper)
  {
    std::vector<Point<dim>> edges(dim);
    for (unsigned int d = 0; d < dim; ++d)
      edges[d][d] = upper[d] - lower[d];
    add_parallelepiped(lower, edges);
  }



  template <int dim>
  void
  DomainOutline<dim>::add_parallelepiped(const Point<dim> &corner,
                                         const std::vector<Point<dim>> &edges)
  {
    lower = upper = corner;
    for (unsigned int e = 0; e < dim; ++e)
      {
        for (unsigned int d = 0; d < dim; ++d)
          (edges[e][d] > 0. ? upper : lower)[d] += edges[e][d];
        Tensor<1, dim> n;
        if constexpr (dim == 2)
          {
            n[0] = -edges[1 - e][1];
            n[1] = edges[1 - e][0];
          }
        else
          n = dealii::cross_product_3d(Tensor<1, dim>(edges[(e + 1) % dim]),
                                       Tensor<1, dim>(edges[(e + 2) % dim]));
        n *= (n * edges[e] > 0. ? 1. : -1.) / n.norm();
        half_spaces.push_back({n, n * (corner + edges[e])});
        half_spaces.push_back({-n, -(n * corner)});
      }
    if constexpr (dim == 2)
      corners = {corner,
                 corner + edges[0],
                 corner + edges[0] + edges[1],
                 corner + edges[1]};
  }



  template <int dim>
  std::vector<Point<dim>>
  DomainOutline<dim>::cut(const Joint<dim> &joint) const
  {
    // a square (in 2D a segment) of the plane that is larger than the outline
    const Tensor<1, dim> n  = joint.normal();
    const auto across       = directions_across<dim>(n);
    const Point<dim> middle = lower + 0.5 * (upper - lower);
    const Point<dim> center = middle - joint.distance(middle) * n;
    const double size       = lower.distance(upper);
    std::vector<Point<dim>> piece;
    if constexpr (dim == 2)
      piece = {center - size * across[0], center + size * across[0]};
    else
      for (const auto &[a, b] : {std::pair<int, int>(-1, -1),
                                 std::pair<int, int>(1, -1),
                                 std::pair<int, int>(1, 1),
                                 std::pair<int, int>(-1, 1)})
        piece.push_back(center + a * size * across[0] + b * size * across[1]);
    for (const HalfSpace &half_space : half_spaces)
      {
        std::vector<Point<dim>> rest;
        for (unsigned int i = 0; i < piece.size(); ++i)
          {
            const Point<dim> &p  = piece[i];
            const Point<dim> &q  = piece[(i + 1) % piece.size()];
            const double beyond  = half_space.normal * p - half_space.offset;
            const double follows = half_space.normal * q - half_space.offset;
            if (beyond <= 0.)
              rest.push_back(p);
            if ((dim == 3 || i == 0) && (beyond > 0.) != (follows > 0.))
              rest.push_back(p + beyond / (beyond - follows) * (q - p));
          }
        piece = rest;
      }
    return piece.size() < dim ? std::vector<Point<dim>>() : piece;
  }



  template <int dim>
  bool
  DomainOutline<dim>::meets(const Joint<dim> &joint) const
  {
    const std::vector<Point<dim>> piece = cut(joint);
    if (piece.empty())
      return false;
    const bool is_disc = joint.extent == JointShape::disc;
    if constexpr (dim == 2)
      {
        const Tensor<1, dim> half =
          joint.radius * directions_across<dim>(joint.normal())[0];
        return is_disc
                 ? reaches_into(corners, joint.point - half, joint.point + half)
                 : reaches_into(corners, piece[0], piece[1]);
      }
    if (!is_disc || std::all_of(half_spaces.begin(),
                                half_spaces.end(),
                                [&](const HalfSpace &half_space) {
                                  return half_space.normal * joint.point <=
                                         half_space.offset;
                                }))
      return true;
    for (unsigned int i = 0; i < piece.size(); ++i)
      {
        const Tensor<1, dim> edge = piece[(i + 1) % piece.size()] - piece[i],
                             to   = joint.point - piece[i];
        const double length       = edge.norm_square();
        const double share =
          length > 0. ? std::clamp(to * edge / length, 0., 1.) : 0.;
        if ((to - share * edge).norm() < joint.radius)
          return true;
      }
    return false;
  }

  template <int dim>
  double
  volume_of(const Domain<dim> &domain)
  {
    double volume = 1.;
    if (domain.shape == DomainShape::polygon)
      {
        volume = 0.;
        for (unsigned int i = 0; i < domain.polygon.size(); ++i)
          {
            const Point<dim> &a = domain.polygon[i],
                             &b =
                               domain.polygon[(i + 1) % domain.polygon.size()];
            volume += 0.5 * (a[0] * b[1] - a[1] * b[0]);
          }
        return std::abs(volume);
      }
    if (domain.shape == DomainShape::parallelepiped)
      {
        Tensor<2, dim> frame;
        for (unsigned int d = 0; d < dim; ++d)
          frame[d] = domain.edges[d];
        return determinant(frame);
      }
    for (const double side : domain.size)
      volume *= side;
    return volume;
  }

  template std::vector<Tensor<1, 2>> directions_across(const Tensor<1, 2> &);
  template std::vector<Tensor<1, 3>> directions_across(const Tensor<1, 3> &);
  template double volume_of(const Domain<2> &);
  template double volume_of(const Domain<3> &);
  template class DomainOutline<2>;
  template class DomainOutline<3>;
} // namespace Keyblock

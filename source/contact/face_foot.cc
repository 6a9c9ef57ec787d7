// SPDX-License-Identifier: LGPL-2.1-or-later
// The nearest point of a face, bilinear in 3D.
#include <keyblock/contact/face_foot.h>
#include <keyblock/contact/geometry.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Weights of bilinear interpolation at (s, t). */
    inline std::array<double, 4>
    bilinear_weights(const double s, const double t)
    {
      return {{(1. - s) * (1. - t), s * (1. - t), (1. - s) * t, s * t}};
    }

    /** sum of weights times corners */
    template <int dim, std::size_t n>
    inline Vector<dim>
    combine(const std::array<Vector<dim>, n> &corner,
            const std::array<double, n> &weight)
    {
      Vector<dim> sum{};
      for (std::size_t v = 0; v < n; ++v)
        sum = add<dim>(sum, weight[v], corner[v]);
      return sum;
    }

    /** A bilinear face as x0 + e s + f t + g s t, and a point seen from x0. */
    struct BilinearFace
    {
      BilinearFace(const std::array<Vector<3>, 4> &x, const Vector<3> &p)
        : e(difference<3>(x[1], x[0]))
        , f(difference<3>(x[2], x[0]))
        , g(difference<3>(difference<3>(x[3], x[2]), e))
        , h(difference<3>(p, x[0]))
        , diagonals(cross(difference<3>(x[3], x[0]), difference<3>(x[2], x[1])))
      {}

      /** Derivatives by the parameters. */
      Vector<3>
      by_s(const double t) const
      {
        return add<3>(e, t, g);
      }
      Vector<3>
      by_t(const double s) const
      {
        return add<3>(f, s, g);
      }

      /** From the place of parameters to the point. */
      Vector<3>
      offset(const double s, const double t) const
      {
        return add<3>(add<3>(h, -s, e), -t, by_t(s));
      }

      Vector<3> e, f, g, h;
      Vector<3> diagonals; ///< their cross product: along the mean normal
    };

    /** Parameters of the point of a face that covers the point, seen along the
     * face's normal: of the two roots of
     *   k2 t^2 + k1 t + k0 = 0,
     * from p = x0 + e s + f t + g s t, the one where the face is not turned
     * over, as it is beyond a reflex corner, or nearer to its centre. */
    std::array<double, 2>
    covering_parameters(const BilinearFace &face)
    {
      const auto &[e, f, g, h, normal] = face;
      const auto area = [&](const Vector<3> &a, const Vector<3> &b) {
        return dot<3>(cross(a, b), normal);
      };
      const double k2 = area(g, f), k0 = area(h, e);
      const double k1 = area(e, f) + area(h, g);
      // a face that turns back on itself covers less than its plane
      const double root =
        -0.5 *
        (k1 +
         std::copysign(std::sqrt(std::max(0., k1 * k1 - 4. * k0 * k2)), k1));
      std::array<double, 2> nearest{{0.5, 0.5}};
      double least = std::numeric_limits<double>::max();
      bool is_over = true;
      for (const double t : {k0 / root, root / k2})
        {
          const Vector<3> across = face.by_s(t);
          const double s =
            dot<3>(add<3>(h, -t, f), across) / dot<3>(across, across);
          const double distance =
            std::max(std::abs(s - 0.5), std::abs(t - 0.5));
          const bool is_turned = area(across, face.by_t(s)) <= 0.;
          // false where a root is infinite
          if ((is_turned == is_over && distance < least) ||
              (!is_turned && is_over && std::isfinite(distance)))
            {
              least   = distance;
              is_over = is_turned;
              nearest = {{s, t}};
            }
        }
      return nearest;
    }

    /** Change of parameters that is the last: the next is smaller by the gap
     * over the radius to which faces are warped [-]. */
    constexpr double last_change = 1e-11;

    /** Iterations for feet further from a face than half its width. */
    constexpr int most_outside = 2;

    /** Parameters of the point of a face nearest to the point, not clamped:
     * Gauss-Newton from the point that covers it, which is exact on plane
     * faces. It may fail outside of warped faces, where it is given up, and of
     * faces that are not convex. */
    std::array<double, 2>
    nearest_parameters(const BilinearFace &face)
    {
      auto [s, t] = covering_parameters(face);
      s           = std::clamp(s, -10., 10.);
      t           = std::clamp(t, -10., 10.);
      for (int iteration = 0; iteration < 20; ++iteration)
        {
          const Vector<3> a = face.by_s(t), b = face.by_t(s);
          const Vector<3> r = face.offset(s, t);
          const double aa = dot<3>(a, a), ab = dot<3>(a, b), bb = dot<3>(b, b);
          const double ra = dot<3>(r, a), rb = dot<3>(r, b);
          const double det    = aa * bb - ab * ab;
          const double ds     = (bb * ra - ab * rb) / det;
          const double dt     = (aa * rb - ab * ra) / det;
          s                   = std::clamp(s + ds, -10., 10.);
          t                   = std::clamp(t + dt, -10., 10.);
          const bool is_found = std::abs(ds) + std::abs(dt) < last_change;
          const bool is_far =
            std::max(std::abs(s - 0.5), std::abs(t - 0.5)) > 1.;
          if (is_found || (is_far && iteration >= most_outside))
            break;
        }
      return {{s, t}};
    }

    constexpr double inside_tolerance = 1e-9;

    /** Points further beside the foot on a face than this, over its size, have
     * no foot there [-]. */
    constexpr double farthest_beside = 1e-6;

    bool
    is_in_unit_range(const double s)
    {
      return s >= -inside_tolerance && s <= 1. + inside_tolerance;
    }

    /** Parameter of the point of the line from @p a to @p b nearest to @p p. */
    template <int dim>
    double
    parameter_on_line(const Vector<dim> &a,
                      const Vector<dim> &b,
                      const Vector<dim> &p)
    {
      const Vector<dim> along = difference<dim>(b, a);
      return dot<dim>(difference<dim>(p, a), along) / dot<dim>(along, along);
    }

    /** Weights of the point of a bilinear face's edges nearest to @p p. */
    std::array<double, 4>
    nearest_on_edges(const std::array<Vector<3>, 4> &x, const Vector<3> &p)
    {
      std::array<double, 4> nearest{};
      double least = std::numeric_limits<double>::max();
      for (const auto &[a, b] :
           {std::array<unsigned int, 2>{{0, 1}}, {{2, 3}}, {{0, 2}}, {{1, 3}}})
        {
          const double s =
            std::clamp(parameter_on_line<3>(x[a], x[b], p), 0., 1.);
          std::array<double, 4> weight{};
          weight[a] = 1. - s;
          weight[b] = s;
          const double distance =
            norm<3>(difference<3>(p, combine<3, 4>(x, weight)));
          if (distance < least)
            {
              least   = distance;
              nearest = weight;
            }
        }
      return nearest;
    }
  } // namespace



  template <>
  FaceFoot<2>
  find_foot<2>(const std::array<Vector<2>, 2> &x, const Vector<2> &p)
  {
    const Vector<2> along = difference<2>(x[1], x[0]);
    const double s        = parameter_on_line<2>(x[0], x[1], p);
    const double place    = std::clamp(s, 0., 1.);
    FaceFoot<2> result;
    result.size      = norm<2>(along);
    result.normal    = unit<2>({{along[1], -along[0]}});
    result.is_inside = is_in_unit_range(s);
    result.weight    = {{1. - place, place}};
    result.offset    = difference<2>(p, combine<2, 2>(x, result.weight));
    result.gap       = dot<2>(result.offset, result.normal);
    return result;
  }



  template <>
  FaceFoot<3>
  find_foot<3>(const std::array<Vector<3>, 4> &x, const Vector<3> &p)
  {
    const BilinearFace face(x, p);
    const std::array<double, 2> st = nearest_parameters(face);
    const double s                 = std::clamp(st[0], 0., 1.);
    const double t                 = std::clamp(st[1], 0., 1.);
    const Vector<3> area           = cross(face.by_s(t), face.by_t(s));
    const bool is_turned           = dot<3>(area, face.diagonals) <= 0.;
    FaceFoot<3> result;
    result.size   = std::sqrt(norm<3>(area));
    result.normal = unit<3>(area);
    result.weight = bilinear_weights(s, t);
    result.offset = face.offset(s, t);
    result.gap    = dot<3>(result.offset, result.normal);
    // at a reflex corner, parameters of the face reach beyond it, turned over
    result.is_inside =
      is_in_unit_range(st[0]) && is_in_unit_range(st[1]) && !is_turned &&
      norm<3>(add<3>(result.offset, -result.gap, result.normal)) <
        farthest_beside * result.size;
    if (!result.is_inside)
      {
        if (is_turned)
          result.normal = unit<3>(face.diagonals);
        result.weight = nearest_on_edges(x, p);
        result.offset = difference<3>(p, combine<3, 4>(x, result.weight));
        result.gap    = dot<3>(result.offset, result.normal);
      }
    return result;
  }



  bool
  could_touch(const std::array<Vector<3>, 4> &x,
              const Vector<3> &p,
              const double reach)
  {
    const Vector<3> center = combine<3, 4>(x, {{0.25, 0.25, 0.25, 0.25}});
    const Vector<3> normal =
      unit<3>(cross(difference<3>(x[3], x[0]), difference<3>(x[2], x[1])));
    double radius = 0., warp = 0.;
    for (const Vector<3> &corner : x)
      {
        const Vector<3> arm = difference<3>(corner, center);
        radius              = std::max(radius, dot<3>(arm, arm));
        warp                = std::max(warp, std::abs(dot<3>(arm, normal)));
      }
    radius                 = std::sqrt(radius);
    const Vector<3> arm    = difference<3>(p, center);
    const double height    = dot<3>(arm, normal);
    const double sideways2 = dot<3>(arm, arm) - height * height;
    const double margin    = 1.01 * radius + reach +
                          0.5 * std::abs(height) * std::min(1., warp / radius);
    return height <= reach + 3. * warp + 1e-9 * radius &&
           sideways2 <= margin * margin;
  }

} // namespace Keyblock

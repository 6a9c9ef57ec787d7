// SPDX-License-Identifier: LGPL-2.1-or-later
// Narrow phase: gaps, normals and weights of nodes on faces.
#include <keyblock/contact_geometry.h>
#include <keyblock/contact_search.h>

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

    /** Parameters of the point of a bilinear face nearest to @p p, not clamped:
     * Gauss-Newton, which is exact after one step on parallelograms. */
    std::array<double, 2>
    nearest_parameters(const std::array<Vector<3>, 4> &x, const Vector<3> &p)
    {
      double s = 0.5, t = 0.5;
      for (int iteration = 0; iteration < 20; ++iteration)
        {
          const Vector<3> a = combine<3, 4>(x, {{-(1. - t), 1. - t, -t, t}});
          const Vector<3> b = combine<3, 4>(x, {{-(1. - s), -s, 1. - s, s}});
          const Vector<3> r =
            difference<3>(p, combine<3, 4>(x, bilinear_weights(s, t)));
          const double aa = dot<3>(a, a), ab = dot<3>(a, b), bb = dot<3>(b, b);
          const double ra = dot<3>(r, a), rb = dot<3>(r, b);
          const double det = aa * bb - ab * ab;
          const double ds  = (bb * ra - ab * rb) / det;
          const double dt  = (aa * rb - ab * ra) / det;
          s                = std::clamp(s + ds, -10., 10.);
          t                = std::clamp(t + dt, -10., 10.);
          if (std::abs(ds) + std::abs(dt) < 1e-13)
            break;
        }
      return {{s, t}};
    }

    /** Whether a projection of @p p on the face with corners @p x could be
     * inside, or nearer than @p reach, with a gap of at most @p reach. Errs on
     * the safe side where the face is warped. */
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
      const double margin =
        1.01 * radius + reach +
        0.5 * std::abs(height) * std::min(1., warp / radius);
      return height <= reach + 3. * warp + 1e-9 * radius &&
             sideways2 <= margin * margin;
    }

    constexpr double inside_tolerance = 1e-9;

    bool
    is_in_unit_range(const double s)
    {
      return s >= -inside_tolerance && s <= 1. + inside_tolerance;
    }
  } // namespace



  template <int dim>
  std::array<Vector<dim>, Mesh<dim>::n_face_vertices>
  ContactSearch<dim>::corners_of(const std::vector<double> &position,
                                 const unsigned int face) const
  {
    std::array<Vector<dim>, Mesh<dim>::n_face_vertices> corners;
    for (unsigned int v = 0; v < corners.size(); ++v)
      corners[v] = at<dim>(position, face_slots[face][v]);
    return corners;
  }



  template <int dim>
  typename ContactSearch<dim>::Projection
  ContactSearch<dim>::project(const std::vector<double> &position,
                              const Vector<dim> &point,
                              const unsigned int face) const
  {
    constexpr unsigned int n = Mesh<dim>::n_face_vertices;
    const auto x             = corners_of(position, face);
    const Vector<dim> &p     = point;

    Projection result;
    result.face = face;
    // nearest point of the segment from corner a to corner b, as weights
    const auto on_segment = [&](const unsigned int a, const unsigned int b) {
      const Vector<dim> along = difference<dim>(x[b], x[a]);
      const double s = std::clamp(dot<dim>(difference<dim>(p, x[a]), along) /
                                    dot<dim>(along, along),
                                  0.,
                                  1.);
      std::array<double, n> weight{};
      weight[a] = 1. - s;
      weight[b] = s;
      return weight;
    };
    if constexpr (dim == 2)
      {
        const Vector<2> along = difference<2>(x[1], x[0]);
        const double length   = norm<2>(along);
        const double s =
          dot<2>(difference<2>(p, x[0]), along) / (length * length);
        result.is_inside = is_in_unit_range(s);
        result.weight    = on_segment(0, 1);
        result.normal    = {{along[1] / length, -along[0] / length}};
        result.size      = length;
      }
    else
      {
        const std::array<double, 2> st = nearest_parameters(x, p);
        result.is_inside = is_in_unit_range(st[0]) && is_in_unit_range(st[1]);
        const double s   = std::clamp(st[0], 0., 1.);
        const double t   = std::clamp(st[1], 0., 1.);
        if (result.is_inside)
          result.weight = bilinear_weights(s, t);
        else
          {
            double least = std::numeric_limits<double>::max();
            for (const auto &edge : {std::array<unsigned int, 2>{{0, 1}},
                                     {{2, 3}},
                                     {{0, 2}},
                                     {{1, 3}}})
              {
                const auto weight = on_segment(edge[0], edge[1]);
                const double distance =
                  norm<3>(difference<3>(p, combine<3, 4>(x, weight)));
                if (distance < least)
                  {
                    least         = distance;
                    result.weight = weight;
                  }
              }
          }
        const Vector<3> a    = combine<3, 4>(x, {{-(1. - t), 1. - t, -t, t}});
        const Vector<3> b    = combine<3, 4>(x, {{-(1. - s), -s, 1. - s, s}});
        const Vector<3> area = cross(a, b);
        result.size          = std::sqrt(norm<3>(area));
        result.normal        = unit<3>(area);
      }
    result.offset = difference<dim>(p, combine<dim, n>(x, result.weight));
    result.gap    = dot<dim>(result.offset, result.normal);
    return result;
  }



  template <int dim>
  bool
  ContactSearch<dim>::opposes(const std::vector<double> &position,
                              const unsigned int slave,
                              const Vector<dim> &normal) const
  {
    for (const unsigned int f : faces_of_slot[slave])
      if (dot<dim>(face_normal(position, f), normal) < -0.1)
        return true;
    return false;
  }



  template <int dim>
  bool
  ContactSearch<dim>::is_coplanar(const Projection &a, const Projection &b)
  {
    const double cosine_of_kink = 0.996; // 5 degrees
    return dot<dim>(a.normal, b.normal) > cosine_of_kink;
  }



  template <int dim>
  bool
  ContactSearch<dim>::is_convex(const std::vector<double> &position,
                                const Projection &a,
                                const Projection &b) const
  {
    if (interface.surface[a.face].block != interface.surface[b.face].block)
      return false;
    Vector<dim> from_a_to_b{};
    for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
      from_a_to_b =
        add<dim>(from_a_to_b,
                 1. / Mesh<dim>::n_face_vertices,
                 difference<dim>(at<dim>(position, face_slots[b.face][v]),
                                 at<dim>(position, face_slots[a.face][v])));
    return dot<dim>(from_a_to_b, a.normal) < -1e-6 * a.size;
  }



  template <int dim>
  bool
  ContactSearch<dim>::hides(const std::vector<double> &position,
                            const Projection &a,
                            const Projection &b) const
  {
    const double slack   = 1e-6 * a.size;
    const Vector<dim> on = at<dim>(position, face_slots[a.face][0]);
    if (is_coplanar(a, b) || a.gap < -slack)
      return false;
    for (const unsigned int slot : face_slots[b.face])
      if (dot<dim>(difference<dim>(at<dim>(position, slot), on), a.normal) >
          slack)
        return false;
    return true;
  }



  template <int dim>
  void
  ContactSearch<dim>::add_contacts(
    const std::vector<double> &position,
    const double reach,
    const double travelled,
    const Candidate &candidate,
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    const Vector<dim> place = at<dim>(position, candidate.slave);
    std::vector<Projection> near, paired, inside, outside;
    for (const CandidateFace &face : candidate.faces)
      {
        // both have moved since the search
        if (face.clearance - 2. * travelled > reach)
          continue;
        if constexpr (dim == 3)
          if (!could_touch(corners_of(position, face.face), place, reach))
            continue;
        const Projection projection = project(position, place, face.face);
        if (projection.gap <= reach && projection.gap >= -face.largest_overlap)
          near.push_back(projection);
      }
    if (near.empty())
      return;
    for (const CandidateFace &face : candidate.paired_faces)
      {
        const Projection projection = project(position, place, face.face);
        if (norm<dim>(projection.offset) < reach + 1e-5 * projection.size)
          paired.push_back(projection);
      }
    const auto is_covered_by_pair = [&](const Projection &projection) {
      return std::any_of(paired.begin(),
                         paired.end(),
                         [&](const Projection &other) {
                           return is_coplanar(other, projection) ||
                                  is_convex(position, other, projection);
                         });
    };
    for (const Projection &projection : near)
      if (!is_covered_by_pair(projection))
        (projection.is_inside ? inside : outside).push_back(projection);
    const auto add_contact = [&](const Projection &projection,
                                 const Vector<dim> &normal,
                                 const double gap) {
      SurfaceContact<dim> contact;
      contact.slave           = candidate.slave;
      contact.face            = projection.face;
      contact.joint           = interface.surface[projection.face].joint;
      contact.master_block    = interface.surface[projection.face].block;
      contact.point.n_nodes   = 1 + Mesh<dim>::n_face_vertices;
      contact.point.node[0]   = candidate.slave;
      contact.point.weight[0] = 1.;
      for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
        {
          contact.point.node[v + 1]   = face_slots[projection.face][v];
          contact.point.weight[v + 1] = -projection.weight[v];
        }
      contact.point.normal = normal;
      contact.point.gap    = gap;
      contacts.push_back(contact);
    };

    // over faces: the nearest of those with nearly one normal, and of those of
    // a convex edge the one that the slave is least deep below, or that of the
    // joint that it slides along; else one per face, but for those behind
    // another, as the sides of a joint in a bed
    const auto leads = [&](const Projection &a, const Projection &b) {
      return interface.surface[a.face].joint != none &&
             interface.surface[b.face].joint == none &&
             std::abs(a.gap) < 0.01 * a.size &&
             std::abs(start_distance(candidate.slave, a.face)) < 1e-3 * a.size;
    };
    std::sort(inside.begin(), inside.end(), [](const auto &a, const auto &b) {
      return std::abs(a.gap) < std::abs(b.gap) ||
             (std::abs(a.gap) == std::abs(b.gap) && a.face < b.face);
    });
    std::vector<bool> is_opposed;
    for (const Projection &projection : inside)
      is_opposed.push_back(
        opposes(position, candidate.slave, projection.normal));
    std::vector<Projection> kept;
    for (unsigned int i = 0; i < inside.size(); ++i)
      {
        bool is_covered = !is_opposed[i];
        for (const Projection &other : kept)
          is_covered = is_covered || is_coplanar(other, inside[i]);
        for (unsigned int j = 0; j < inside.size() && !is_covered; ++j)
          {
            const bool is_before =
              leads(inside[j], inside[i]) ||
              (!leads(inside[i], inside[j]) &&
               (inside[j].gap > inside[i].gap ||
                (inside[j].gap == inside[i].gap && j < i)));
            is_covered =
              ((is_opposed[j] || inside[j].gap > 0.) && is_before &&
               is_convex(position, inside[j], inside[i])) ||
              (is_opposed[j] && hides(position, inside[j], inside[i]) &&
               (is_before || !hides(position, inside[i], inside[j])));
          }
        if (!is_covered)
          {
            kept.push_back(inside[i]);
            add_contact(inside[i], inside[i].normal, inside[i].gap);
          }
      }
    if (!kept.empty() || outside.empty())
      return;

    // beside faces: the nearest edge or corner
    const auto nearest =
      std::min_element(outside.begin(),
                       outside.end(),
                       [](const Projection &a, const Projection &b) {
                         return norm<dim>(a.offset) < norm<dim>(b.offset);
                       });
    const double distance = norm<dim>(nearest->offset);
    if (distance > reach)
      return;
    Vector<dim> mean{};
    for (const Projection &projection : outside)
      if (norm<dim>(difference<dim>(projection.offset, nearest->offset)) <
          1e-9 * nearest->size)
        mean = add<dim>(mean, 1., projection.normal);
    mean                     = unit<dim>(mean);
    const double gap         = dot<dim>(nearest->offset, mean);
    const bool is_off        = distance > 1e-6 * nearest->size && gap > 0.;
    const Vector<dim> normal = is_off ? unit<dim>(nearest->offset) : mean;
    if ((is_off || distance < 0.1 * nearest->size) &&
        opposes(position, candidate.slave, normal) &&
        can_stand_on(position, candidate.slave, normal))
      add_contact(*nearest, normal, is_off ? distance : gap);
  }



  template <int dim>
  void
  ContactSearch<dim>::evaluate(const std::vector<double> &position,
                               const double reach,
                               const double travelled,
                               std::vector<SurfaceContact<dim>> &contacts) const
  {
    contacts.clear();
    for (const Candidate &candidate : candidates)
      add_contacts(position, reach, travelled, candidate, contacts);
    drop_mirrored(contacts);
    if constexpr (dim == 3)
      add_ridge_contacts(position, reach, contacts);
  }

  template std::array<Vector<2>, 2>
  ContactSearch<2>::corners_of(const std::vector<double> &,
                               const unsigned int) const;
  template std::array<Vector<3>, 4>
  ContactSearch<3>::corners_of(const std::vector<double> &,
                               const unsigned int) const;
  template ContactSearch<2>::Projection
  ContactSearch<2>::project(const std::vector<double> &,
                            const Vector<2> &,
                            const unsigned int) const;
  template bool ContactSearch<2>::opposes(const std::vector<double> &,
                                          const unsigned int,
                                          const Vector<2> &) const;
  template ContactSearch<3>::Projection
  ContactSearch<3>::project(const std::vector<double> &,
                            const Vector<3> &,
                            const unsigned int) const;
  template bool ContactSearch<3>::opposes(const std::vector<double> &,
                                          const unsigned int,
                                          const Vector<3> &) const;
  template void
  ContactSearch<2>::evaluate(const std::vector<double> &,
                             const double,
                             const double,
                             std::vector<SurfaceContact<2>> &) const;
  template void
  ContactSearch<3>::evaluate(const std::vector<double> &,
                             const double,
                             const double,
                             std::vector<SurfaceContact<3>> &) const;
} // namespace Keyblock

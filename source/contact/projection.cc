// SPDX-License-Identifier: LGPL-2.1-or-later
// Narrow phase: gaps, normals and weights of nodes on faces.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/search.h>

#include <algorithm>
#include <iterator>

namespace Keyblock
{
  namespace
  {
    /** Over the size of a face [-]: distance of feet that are one; distance
     * from a plane that is none; overlap beside faces up to which a node is
     * taken to be on them. */
    constexpr double same_foot = 1e-9, no_distance = 1e-6, deepest_beside = 0.1;

    /** Difference of cosines that are equal [-]. */
    constexpr double equal_cosine = 1e-9;
  } // namespace



  template <int dim>
  bool
  ContactSearch<dim>::is_convex(const std::vector<double> &position,
                                const Projection<dim> &a,
                                const Projection<dim> &b) const
  {
    if (surface.interface.surface[a.face].block !=
        surface.interface.surface[b.face].block)
      return false;
    Vector<dim> from_a_to_b{};
    for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
      from_a_to_b = add<dim>(
        from_a_to_b,
        1. / Mesh<dim>::n_face_vertices,
        difference<dim>(at<dim>(position, surface.nodes_of_face[b.face][v]),
                        at<dim>(position, surface.nodes_of_face[a.face][v])));
    return dot<dim>(from_a_to_b, a.normal) < -no_distance * a.size;
  }



  template <int dim>
  bool
  ContactSearch<dim>::hides(const std::vector<double> &position,
                            const Projection<dim> &a,
                            const Projection<dim> &b) const
  {
    const double slack   = no_distance * a.size;
    const Vector<dim> on = at<dim>(position, surface.nodes_of_face[a.face][0]);
    if (is_coplanar(a, b) || a.gap < -slack)
      return false;
    for (const unsigned int node : surface.nodes_of_face[b.face])
      if (dot<dim>(difference<dim>(at<dim>(position, node), on), a.normal) >
          slack)
        return false;
    return true;
  }



  template <int dim>
  std::vector<Projection<dim>>
  ContactSearch<dim>::feet_near(const std::vector<double> &position,
                                const double reach,
                                const double travelled,
                                const Candidate &candidate) const
  {
    const Vector<dim> place = at<dim>(position, candidate.slave);
    std::vector<Projection<dim>> near, paired;
    for (const CandidateFace &face : candidate.faces)
      {
        // both have moved since the search
        if (face.clearance - 2. * travelled > reach)
          continue;
        if constexpr (dim == 3)
          if (!could_touch(surface.corners_of(position, face.face),
                           place,
                           reach))
            continue;
        const Projection<dim> projection =
          surface.project(position, place, face.face);
        if (projection.gap <= reach && projection.gap >= -face.largest_overlap)
          near.push_back(projection);
      }
    if (near.empty())
      return near;
    for (const CandidateFace &face : candidate.paired_faces)
      {
        const Projection<dim> projection =
          surface.project(position, place, face.face);
        if (norm<dim>(projection.offset) < reach + 1e-5 * projection.size)
          paired.push_back(projection);
      }
    const auto is_covered_by_pair = [&](const Projection<dim> &projection) {
      return std::any_of(paired.begin(),
                         paired.end(),
                         [&](const Projection<dim> &other) {
                           return is_coplanar(other, projection) ||
                                  is_convex(position, other, projection);
                         });
    };
    near.erase(std::remove_if(near.begin(), near.end(), is_covered_by_pair),
               near.end());
    return near;
  }



  template <int dim>
  std::vector<Projection<dim>>
  ContactSearch<dim>::feet_on_pairs(const std::vector<double> &position,
                                    const unsigned int node) const
  {
    std::vector<Projection<dim>> feet;
    const auto candidate =
      std::lower_bound(candidates.begin(),
                       candidates.end(),
                       node,
                       [](const Candidate &a, const unsigned int b) {
                         return a.slave < b;
                       });
    if (candidate == candidates.end() || candidate->slave != node)
      return feet;
    for (const CandidateFace &face : candidate->paired_faces)
      feet.push_back(
        surface.project(position, at<dim>(position, node), face.face));
    return feet;
  }



  template <int dim>
  void
  ContactSearch<dim>::add_contact(
    const unsigned int slave,
    const Projection<dim> &projection,
    const Vector<dim> &normal,
    const double gap,
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    SurfaceContact<dim> contact;
    contact.slave           = slave;
    contact.face            = projection.face;
    contact.joint           = surface.interface.surface[projection.face].joint;
    contact.master_block    = surface.interface.surface[projection.face].block;
    contact.point.n_nodes   = 1 + Mesh<dim>::n_face_vertices;
    contact.point.node[0]   = slave;
    contact.point.weight[0] = 1.;
    for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
      {
        contact.point.node[v + 1]   = surface.nodes_of_face[projection.face][v];
        contact.point.weight[v + 1] = -projection.weight[v];
      }
    contact.point.normal = normal;
    contact.point.gap    = gap;
    contacts.push_back(contact);
  }



  template <int dim>
  std::vector<Projection<dim>>
  ContactSearch<dim>::feet_that_count(const std::vector<double> &position,
                                      const unsigned int slave,
                                      std::vector<Projection<dim>> inside) const
  {
    const auto leads = [&](const Projection<dim> &a, const Projection<dim> &b) {
      return surface.interface.surface[a.face].joint != none &&
             surface.interface.surface[b.face].joint == none &&
             std::abs(a.gap) < 0.01 * a.size &&
             std::abs(surface.start_distance(slave, a.face)) < 1e-3 * a.size;
    };
    std::sort(inside.begin(), inside.end(), [](const auto &a, const auto &b) {
      return std::abs(a.gap) < std::abs(b.gap) ||
             (std::abs(a.gap) == std::abs(b.gap) && a.face < b.face);
    });
    std::vector<bool> is_opposed;
    is_opposed.reserve(inside.size());
    for (const Projection<dim> &projection : inside)
      is_opposed.push_back(
        surface.can_bear(position, slave, projection.face, projection.normal));
    std::vector<Projection<dim>> kept;
    for (unsigned int i = 0; i < inside.size(); ++i)
      {
        bool is_covered = !is_opposed[i];
        for (const Projection<dim> &other : kept)
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
          kept.push_back(inside[i]);
      }
    return kept;
  }



  template <int dim>
  void
  ContactSearch<dim>::add_contact_beside(
    const std::vector<double> &position,
    const double reach,
    const Candidate &candidate,
    const std::vector<Projection<dim>> &outside,
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    const unsigned int slave = candidate.slave;
    const auto nearest =
      std::min_element(outside.begin(),
                       outside.end(),
                       [](const Projection<dim> &a, const Projection<dim> &b) {
                         return norm<dim>(a.offset) < norm<dim>(b.offset);
                       });
    const double distance = norm<dim>(nearest->offset);
    if (distance > reach)
      return;
    // of faces that meet there those of the slave's own joints, if any: it
    // slides along them
    const auto is_there = [&](const Projection<dim> &projection) {
      return norm<dim>(difference<dim>(projection.offset, nearest->offset)) <
             same_foot * nearest->size;
    };
    const auto is_on_own_joint = [&](const Projection<dim> &projection) {
      return is_there(projection) &&
             surface.is_on_joint(
               slave, surface.interface.surface[projection.face].joint);
    };
    const bool has_own =
      std::any_of(outside.begin(), outside.end(), is_on_own_joint);
    std::vector<Projection<dim>> there;
    std::copy_if(outside.begin(),
                 outside.end(),
                 std::back_inserter(there),
                 [&](const Projection<dim> &projection) {
                   return has_own ? is_on_own_joint(projection)
                                  : is_there(projection);
                 });
    Vector<dim> mean{};
    for (const Projection<dim> &projection : there)
      mean = add<dim>(mean, 1., projection.normal);
    mean              = unit<dim>(mean);
    const double gap  = dot<dim>(nearest->offset, mean);
    const bool is_off = distance > no_distance * nearest->size && gap > 0.;
    const Vector<dim> normal = is_off ? unit<dim>(nearest->offset) : mean;
    if ((!is_off && distance >= deepest_beside * nearest->size) ||
        !surface.opposes(position, slave, normal) ||
        !surface.can_stand_on(position, slave, normal))
      return;
    const Projection<dim> *across = &there[0];
    for (const Projection<dim> &projection : there)
      if (dot<dim>(projection.normal, normal) >
          dot<dim>(across->normal, normal) + equal_cosine)
        across = &projection;
    add_contact(slave, *across, normal, is_off ? distance : gap, contacts);
    if (dot<dim>(across->normal, normal) > cosine_of_kink)
      keep_joint_at_rim(position, candidate, *across, contacts.back());
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
    std::vector<Projection<dim>> inside, outside;
    for (const Projection<dim> &foot :
         feet_near(position, reach, travelled, candidate))
      (foot.is_inside ? inside : outside).push_back(foot);
    const std::vector<Projection<dim>> kept =
      feet_that_count(position, candidate.slave, inside);
    for (const Projection<dim> &foot : kept)
      {
        const auto face  = std::find_if(candidate.faces.begin(),
                                       candidate.faces.end(),
                                       [&](const CandidateFace &one) {
                                         return one.face == foot.face;
                                       });
        const double gap = foot.gap + face->rounding;
        if (gap > reach)
          continue;
        add_contact(candidate.slave, foot, foot.normal, gap, contacts);
        keep_joint_at_rim(position, candidate, foot, contacts.back());
      }
    if (add_contacts_flush(position, candidate, kept, outside, contacts))
      return;
    if (kept.empty() && !outside.empty())
      add_contact_beside(position, reach, candidate, outside, contacts);
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
      ridges->add_contacts(position, reach, contacts);
  }

  template bool ContactSearch<2>::is_convex(const std::vector<double> &,
                                            const Projection<2> &,
                                            const Projection<2> &) const;
  template void
  ContactSearch<2>::add_contact(const unsigned int,
                                const Projection<2> &,
                                const Vector<2> &,
                                const double,
                                std::vector<SurfaceContact<2>> &) const;
  template bool ContactSearch<3>::is_convex(const std::vector<double> &,
                                            const Projection<3> &,
                                            const Projection<3> &) const;
  template void
  ContactSearch<3>::add_contact(const unsigned int,
                                const Projection<3> &,
                                const Vector<3> &,
                                const double,
                                std::vector<SurfaceContact<3>> &) const;
  template std::vector<Projection<2>>
  ContactSearch<2>::feet_on_pairs(const std::vector<double> &,
                                  const unsigned int) const;
  template std::vector<Projection<3>>
  ContactSearch<3>::feet_on_pairs(const std::vector<double> &,
                                  const unsigned int) const;
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

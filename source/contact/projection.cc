// SPDX-License-Identifier: LGPL-2.1-or-later
// Narrow phase: gaps, normals and weights of nodes on faces.
#include <keyblock/contact/face_foot.h>
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/search.h>

#include <algorithm>
#include <iterator>

namespace Keyblock
{
  template <int dim>
  std::array<Vector<dim>, Mesh<dim>::n_face_vertices>
  ContactSearch<dim>::corners_of(const std::vector<double> &position,
                                 const unsigned int face) const
  {
    std::array<Vector<dim>, Mesh<dim>::n_face_vertices> corners;
    for (unsigned int v = 0; v < corners.size(); ++v)
      corners[v] = at<dim>(position, nodes_of_face[face][v]);
    return corners;
  }



  template <int dim>
  typename ContactSearch<dim>::Projection
  ContactSearch<dim>::project(const std::vector<double> &position,
                              const Vector<dim> &point,
                              const unsigned int face) const
  {
    const FaceFoot<dim> foot =
      find_foot<dim>(corners_of(position, face), point);
    return {face,
            foot.weight,
            foot.offset,
            foot.normal,
            foot.is_inside,
            foot.gap,
            foot.size};
  }



  template <int dim>
  bool
  ContactSearch<dim>::opposes(const std::vector<double> &position,
                              const unsigned int slave,
                              const Vector<dim> &normal) const
  {
    for (const unsigned int f : faces_of_node[slave])
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
                 difference<dim>(at<dim>(position, nodes_of_face[b.face][v]),
                                 at<dim>(position, nodes_of_face[a.face][v])));
    return dot<dim>(from_a_to_b, a.normal) < -1e-6 * a.size;
  }



  template <int dim>
  bool
  ContactSearch<dim>::hides(const std::vector<double> &position,
                            const Projection &a,
                            const Projection &b) const
  {
    const double slack   = 1e-6 * a.size;
    const Vector<dim> on = at<dim>(position, nodes_of_face[a.face][0]);
    if (is_coplanar(a, b) || a.gap < -slack)
      return false;
    for (const unsigned int node : nodes_of_face[b.face])
      if (dot<dim>(difference<dim>(at<dim>(position, node), on), a.normal) >
          slack)
        return false;
    return true;
  }



  template <int dim>
  bool
  ContactSearch<dim>::is_on_joint(const unsigned int node,
                                  const unsigned int joint) const
  {
    return joint != none &&
           std::any_of(faces_of_node[node].begin(),
                       faces_of_node[node].end(),
                       [&](const unsigned int f) {
                         return interface.surface[f].joint == joint;
                       });
  }



  template <int dim>
  std::vector<typename ContactSearch<dim>::Projection>
  ContactSearch<dim>::feet_near(const std::vector<double> &position,
                                const double reach,
                                const double travelled,
                                const Candidate &candidate) const
  {
    const Vector<dim> place = at<dim>(position, candidate.slave);
    std::vector<Projection> near, paired;
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
      return near;
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
    near.erase(std::remove_if(near.begin(), near.end(), is_covered_by_pair),
               near.end());
    return near;
  }



  template <int dim>
  void
  ContactSearch<dim>::add_contact(
    const unsigned int slave,
    const Projection &projection,
    const Vector<dim> &normal,
    const double gap,
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    SurfaceContact<dim> contact;
    contact.slave           = slave;
    contact.face            = projection.face;
    contact.joint           = interface.surface[projection.face].joint;
    contact.master_block    = interface.surface[projection.face].block;
    contact.point.n_nodes   = 1 + Mesh<dim>::n_face_vertices;
    contact.point.node[0]   = slave;
    contact.point.weight[0] = 1.;
    for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
      {
        contact.point.node[v + 1]   = nodes_of_face[projection.face][v];
        contact.point.weight[v + 1] = -projection.weight[v];
      }
    contact.point.normal = normal;
    contact.point.gap    = gap;
    contacts.push_back(contact);
  }



  template <int dim>
  std::vector<typename ContactSearch<dim>::Projection>
  ContactSearch<dim>::feet_that_count(const std::vector<double> &position,
                                      const unsigned int slave,
                                      std::vector<Projection> inside) const
  {
    const auto leads = [&](const Projection &a, const Projection &b) {
      return interface.surface[a.face].joint != none &&
             interface.surface[b.face].joint == none &&
             std::abs(a.gap) < 0.01 * a.size &&
             std::abs(start_distance(slave, a.face)) < 1e-3 * a.size;
    };
    std::sort(inside.begin(), inside.end(), [](const auto &a, const auto &b) {
      return std::abs(a.gap) < std::abs(b.gap) ||
             (std::abs(a.gap) == std::abs(b.gap) && a.face < b.face);
    });
    std::vector<bool> is_opposed;
    is_opposed.reserve(inside.size());
    for (const Projection &projection : inside)
      is_opposed.push_back(opposes(position, slave, projection.normal));
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
          kept.push_back(inside[i]);
      }
    return kept;
  }



  template <int dim>
  void
  ContactSearch<dim>::add_contact_beside(
    const std::vector<double> &position,
    const double reach,
    const unsigned int slave,
    const std::vector<Projection> &outside,
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    const auto nearest =
      std::min_element(outside.begin(),
                       outside.end(),
                       [](const Projection &a, const Projection &b) {
                         return norm<dim>(a.offset) < norm<dim>(b.offset);
                       });
    const double distance = norm<dim>(nearest->offset);
    if (distance > reach)
      return;
    // of faces that meet there those of the slave's own joints, if any: it
    // slides along them
    const auto is_there = [&](const Projection &projection) {
      return norm<dim>(difference<dim>(projection.offset, nearest->offset)) <
             1e-9 * nearest->size;
    };
    const auto is_on_own_joint = [&](const Projection &projection) {
      return is_there(projection) &&
             is_on_joint(slave, interface.surface[projection.face].joint);
    };
    const bool has_own =
      std::any_of(outside.begin(), outside.end(), is_on_own_joint);
    std::vector<Projection> there;
    std::copy_if(outside.begin(),
                 outside.end(),
                 std::back_inserter(there),
                 [&](const Projection &projection) {
                   return has_own ? is_on_own_joint(projection)
                                  : is_there(projection);
                 });
    Vector<dim> mean{};
    for (const Projection &projection : there)
      mean = add<dim>(mean, 1., projection.normal);
    mean                     = unit<dim>(mean);
    const double gap         = dot<dim>(nearest->offset, mean);
    const bool is_off        = distance > 1e-6 * nearest->size && gap > 0.;
    const Vector<dim> normal = is_off ? unit<dim>(nearest->offset) : mean;
    if ((!is_off && distance >= 0.1 * nearest->size) ||
        !opposes(position, slave, normal) ||
        !can_stand_on(position, slave, normal))
      return;
    const Projection *across = &there[0];
    for (const Projection &projection : there)
      if (dot<dim>(projection.normal, normal) >
          dot<dim>(across->normal, normal) + 1e-9)
        across = &projection;
    add_contact(slave, *across, normal, is_off ? distance : gap, contacts);
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
    std::vector<Projection> inside, outside;
    for (const Projection &foot :
         feet_near(position, reach, travelled, candidate))
      (foot.is_inside ? inside : outside).push_back(foot);
    const std::vector<Projection> kept =
      feet_that_count(position, candidate.slave, inside);
    for (const Projection &foot : kept)
      add_contact(candidate.slave, foot, foot.normal, foot.gap, contacts);
    if (kept.empty() && !outside.empty())
      add_contact_beside(position, reach, candidate.slave, outside, contacts);
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
  template bool ContactSearch<2>::is_coplanar(const Projection &,
                                              const Projection &);
  template bool ContactSearch<3>::is_coplanar(const Projection &,
                                              const Projection &);
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

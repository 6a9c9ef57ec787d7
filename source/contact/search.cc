// SPDX-License-Identifier: LGPL-2.1-or-later
// Broad phase: which nodes may meet which faces.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/search.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Share of a face's corner in a point that counts as the corner. */
    constexpr double share_of_corner = 0.9;
  } // namespace



  template <int dim>
  ContactSearch<dim>::ContactSearch(const ContactSurface<dim> &surface)
    : surface(surface)
  {
    if constexpr (dim == 3)
      ridges = std::make_unique<RidgeSearch>(surface);
  }



  template <int dim>
  typename ContactSearch<dim>::CandidateFace
  ContactSearch<dim>::make_candidate(const std::vector<double> &position,
                                     const unsigned int slave,
                                     const unsigned int face) const
  {
    const Projection<dim> now =
      surface.project(position, at<dim>(position, slave), face);
    const double before = -surface.start_distance(slave, face);
    CandidateFace result{face,
                         largest_overlap_of(before, now.size),
                         0.,
                         surface.rounding_of_tip(slave, face)};
    const double distance = norm<dim>(now.offset);
    if (now.gap > 0.)
      result.clearance = distance;
    // behind the face for good, or too far beside it
    if (now.gap < -result.largest_overlap - surface.skin() ||
        (!(now.gap < 0. && now.is_inside) &&
         distance > range() + 1e-5 * now.size))
      result.clearance = -1.;
    return result;
  }



  template <int dim>
  void
  ContactSearch<dim>::drop_mirrored(
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    // the corner of its face that a contact stands on, or `none`
    const auto corner_of = [](const SurfaceContact<dim> &contact) {
      for (int k = 1; k < contact.point.n_nodes; ++k)
        if (contact.point.weight[k] < -share_of_corner)
          return contact.point.node[k];
      return none;
    };
    const auto has_slave = [](const SurfaceContact<dim> &contact,
                              const unsigned int node) {
      return contact.slave < node;
    };
    // contacts are in the order of their slaves
    const auto is_mirror = [&](const SurfaceContact<dim> &contact) {
      const unsigned int corner = corner_of(contact);
      if (corner == none ||
          surface.is_slave_block(surface.block_of_node[contact.slave],
                                 contact.master_block))
        return false;
      for (auto other = std::lower_bound(
             contacts.begin(), contacts.end(), corner, has_slave);
           other != contacts.end() && other->slave == corner;
           ++other)
        if (corner_of(*other) == contact.slave &&
            dot<dim>(other->point.normal, contact.point.normal) < -0.99)
          return true;
      return false;
    };
    std::vector<bool> is_dropped;
    is_dropped.reserve(contacts.size());
    for (const SurfaceContact<dim> &contact : contacts)
      is_dropped.push_back(is_mirror(contact));
    unsigned int n_kept = 0;
    for (unsigned int i = 0; i < contacts.size(); ++i)
      if (!is_dropped[i])
        contacts[n_kept++] = contacts[i];
    contacts.resize(n_kept);
  }



  template <int dim>
  void
  ContactSearch<dim>::search(const std::vector<double> &position,
                             const IsPaired &is_paired,
                             const std::vector<bool> &has_changed)
  {
    std::vector<std::pair<dealii::BoundingBox<dim>, unsigned int>> boxes;
    for (const unsigned int f : surface.faces_with_area)
      boxes.emplace_back(surface.box_of(position, f, range()), f);
    const auto tree = dealii::pack_rtree(boxes);

    const std::vector<Candidate> before = std::move(candidates);
    candidates.clear();
    auto kept     = before.begin();
    namespace bgi = boost::geometry::index;
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      {
        while (kept != before.end() && kept->slave < node)
          ++kept;
        if (!has_changed.empty() && !has_changed[node])
          {
            if (kept != before.end() && kept->slave == node)
              candidates.push_back(*kept);
            continue;
          }
        dealii::Point<dim> p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = position[dim * node + d];
        Candidate candidate{node, {}, {}};
        const unsigned int block = surface.block_of_node[node];
        const auto is_a_slave_on = [&](const unsigned int f) {
          return surface.is_slave_block(block,
                                        surface.interface.surface[f].block) ||
                 (surface.is_on_edge[node] &&
                  surface.can_stand_on(position,
                                       node,
                                       surface.face_normal(position, f)));
        };
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::intersects(p)))
          {
            const unsigned int f = hit.second;
            if (!surface.may_meet(node, f))
              continue;
            const bool has_pair = is_paired(node, f);
            if (!has_pair && !is_a_slave_on(f))
              continue;
            const CandidateFace face = make_candidate(position, node, f);
            if (face.clearance >= 0.)
              (has_pair ? candidate.paired_faces : candidate.faces)
                .push_back(face);
          }
        std::sort(candidate.faces.begin(),
                  candidate.faces.end(),
                  [](const CandidateFace &a, const CandidateFace &b) {
                    return a.face < b.face;
                  });
        if (!candidate.faces.empty())
          candidates.push_back(candidate);
      }
    if constexpr (dim == 3)
      ridges->search(position, is_paired);
  }



  template <int dim>
  std::vector<unsigned int>
  ContactSearch<dim>::candidate_nodes() const
  {
    std::vector<bool> is_used(surface.n_nodes(), false);
    for (const Candidate &candidate : candidates)
      {
        is_used[candidate.slave] = true;
        // the slave's own faces tell which side of it is outside
        for (const unsigned int f : surface.faces_of_node[candidate.slave])
          for (const unsigned int node : surface.nodes_of_face[f])
            is_used[node] = true;
        for (const CandidateFace &candidate_face : candidate.faces)
          for (const unsigned int node :
               surface.nodes_of_face[candidate_face.face])
            is_used[node] = true;
      }
    if constexpr (dim == 3)
      ridges->mark_nodes(is_used);
    std::vector<unsigned int> surface_nodes;
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (is_used[node])
        surface_nodes.push_back(node);
    return surface_nodes;
  }



  template class ContactSearch<2>;
  template class ContactSearch<3>;
} // namespace Keyblock

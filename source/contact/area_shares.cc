// SPDX-License-Identifier: LGPL-2.1-or-later
// Which points stand for where faces lie on each other.
#include <keyblock/contact/area.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  template <typename Condition>
  bool
  ContactAreas<dim>::has_pair_that(const unsigned int node,
                                   const unsigned int joint,
                                   const Condition &condition) const
  {
    const unsigned int g = topology.group_of_node[node];
    if (g == none)
      return false;
    const unsigned int v    = surface.vertex_of_node[node];
    const auto [begin, end] = topology.pairs_of_group(g);
    for (unsigned int p = begin; p < end; ++p)
      if (const Pair<dim> &pair = interface.pairs[p];
          pair.joint == joint && (pair.minus == v || pair.plus == v) &&
          condition(memory.state[p], pair.minus == v ? pair.plus : pair.minus))
        return true;
    return false;
  }



  template <int dim>
  bool
  ContactAreas<dim>::has_opened(const unsigned int node,
                                const unsigned int joint) const
  {
    return has_pair_that(node,
                         joint,
                         [](const PairState<dim> &state, unsigned int) {
                           return state.has_opened;
                         });
  }



  template <int dim>
  bool
  ContactAreas<dim>::has_pair(const unsigned int node,
                              const unsigned int joint,
                              const unsigned int block) const
  {
    return has_pair_that(
      node,
      joint,
      [&](const PairState<dim> &state, const unsigned int partner) {
        return !state.is_converted && !state.is_removed &&
               state.status != ContactStatus::open &&
               surface.is_on_block(surface.node_of_vertex[partner], block);
      });
  }



  template <int dim>
  auto
  ContactAreas<dim>::list_footings() const -> std::vector<Footing>
  {
    std::vector<Footing> footings;
    for (const SurfaceContact<dim> &contact : memory.contacts)
      if (contact.joint != none && strength.needs_areas[contact.joint] &&
          !contact.is_ridge)
        footings.push_back(
          {{contact.slave, contact.joint, contact.master_block}});
    std::sort(footings.begin(), footings.end());
    return footings;
  }



  template <int dim>
  auto
  ContactAreas<dim>::key_of(const FaceOverlap<dim> &overlap) const -> Footing
  {
    const SurfaceFace<dim> &slave  = interface.surface[overlap.slave_face];
    const SurfaceFace<dim> &master = interface.surface[overlap.master_face];
    return between(slave.joint, slave.block, master.block);
  }



  template <int dim>
  bool
  ContactAreas<dim>::share_between(const FaceOverlap<dim> &overlap,
                                   const double area,
                                   const std::vector<Footing> &bearing,
                                   std::vector<AreaShare> &shares) const
  {
    return share_overlap(area,
                         overlap.slave_face,
                         interface.surface[overlap.master_face].block,
                         overlap.slave_weight,
                         bearing,
                         shares) ||
           share_overlap(area,
                         overlap.master_face,
                         interface.surface[overlap.slave_face].block,
                         overlap.master_weight,
                         bearing,
                         shares);
  }



  template <int dim>
  void
  ContactAreas<dim>::distribute(const std::vector<Footing> &footings)
  {
    std::vector<AreaShare> shares;
    std::map<Footing, std::array<double, 2>> areas; // with points, and without
    for (const FaceOverlap<dim> &overlap : overlaps)
      {
        const double area = overlap.area * (1. - share_of_pairs(overlap, true));
        const std::size_t n_before = shares.size();
        const bool has_points = share_between(overlap, area, footings, shares);
        areas[key_of(overlap)][has_points ? 0 : 1] += area;
        for (std::size_t k = n_before; k < shares.size(); ++k)
          shares[k].between = key_of(overlap);
      }
    // faces that have lifted a little, but not opened, lean on the others: what
    // lies beside points that touch nothing is not lost
    std::map<Footing, BearingPoint> by_footing;
    std::map<Footing, unsigned int> side_pairs;
    for (const AreaShare &part : shares)
      {
        const auto &[with, without] = areas[part.between];
        const unsigned int side_pair =
          side_pairs.try_emplace(part.between, side_pairs.size()).first->second;
        BearingPoint &point = by_footing[part.footing];
        point.footing       = part.footing;
        point.side_pair     = side_pair;
        point.area += part.area * (1. + without / with);
      }
    points.clear();
    for (const auto &[footing, point] : by_footing)
      points.push_back(point);
    sums.assign(side_pairs.size(), {});
  }



  template <int dim>
  double
  ContactAreas<dim>::share_of_pairs(const FaceOverlap<dim> &overlap,
                                    const bool with_opened) const
  {
    const auto &surface_nodes = surface.nodes_of_face[overlap.slave_face];
    const unsigned int joint  = interface.surface[overlap.slave_face].joint;
    const unsigned int block  = interface.surface[overlap.master_face].block;
    double sum                = 0.;
    for (unsigned int k = 0; k < surface_nodes.size(); ++k)
      if ((with_opened && has_opened(surface_nodes[k], joint)) ||
          has_pair(surface_nodes[k], joint, block))
        sum += overlap.slave_weight[k];
    return std::min(sum, 1.);
  }



  template <int dim>
  bool
  ContactAreas<dim>::share_overlap(
    const double area,
    const unsigned int face,
    const unsigned int block,
    const std::array<double, Mesh<dim>::n_face_vertices> &weight,
    const std::vector<Footing> &bearing,
    std::vector<AreaShare> &shares) const
  {
    const auto &surface_nodes = surface.nodes_of_face[face];
    const unsigned int joint  = interface.surface[face].joint;
    double sum                = 0.;
    std::array<bool, Mesh<dim>::n_face_vertices> takes;
    for (unsigned int k = 0; k < surface_nodes.size(); ++k)
      {
        takes[k] =
          std::binary_search(bearing.begin(),
                             bearing.end(),
                             Footing{{surface_nodes[k], joint, block}}) &&
          !has_opened(surface_nodes[k], joint) &&
          !has_pair(surface_nodes[k], joint, block);
        sum += takes[k] ? weight[k] : 0.;
      }
    if (sum <= 0.)
      return false;
    for (unsigned int k = 0; k < surface_nodes.size(); ++k)
      if (takes[k])
        shares.push_back(
          {{{surface_nodes[k], joint, block}}, {}, area * weight[k] / sum});
    return true;
  }



  template class ContactAreas<2>;
  template class ContactAreas<3>;
} // namespace Keyblock

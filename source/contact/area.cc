// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/area.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Gap over the size of a face beyond which a joint has come apart [-]. */
    constexpr double least_opening = 1e-3;

    /** Pressure over the joint's mean below which a point bears cohesion only
     * in proportion: one that hovers would take it and let go in turns, and
     * stick and slip by that [-]. */
    constexpr double full_pressure = 0.1;

    /** Joint, and two blocks in order. */
    std::array<unsigned int, 3>
    between(const unsigned int joint,
            const unsigned int a,
            const unsigned int b)
    {
      return {{joint, std::min(a, b), std::max(a, b)}};
    }
  } // namespace



  template <int dim>
  ContactAreas<dim>::ContactAreas(const PairTopology<dim> &topology,
                                  const ContactStrength<dim> &strength,
                                  const SurfaceNodes<dim> &nodes,
                                  const Fields<dim> &fields,
                                  ContactMemory<dim> &memory)
    : topology(topology)
    , interface(topology.interface)
    , surface(topology.surface)
    , strength(strength)
    , nodes(nodes)
    , fields(fields)
    , memory(memory)
  {}



  template <int dim>
  void
  ContactAreas<dim>::find_overlaps(const bool is_moved)
  {
    const std::vector<bool> &joints = strength.needs_areas;
    if (is_moved &&
        std::find(joints.begin(), joints.end(), true) != joints.end())
      overlaps = list_overlaps<dim>(surface, memory.searched_position, joints);
    is_shared = false;
  }



  template <int dim>
  auto
  ContactAreas<dim>::find(const Footing &footing) const -> unsigned int
  {
    const auto point =
      std::lower_bound(points.begin(),
                       points.end(),
                       footing,
                       [](const BearingPoint &p, const Footing &f) {
                         return p.footing < f;
                       });
    return point != points.end() && point->footing == footing
             ? point - points.begin()
             : none;
  }



  template <int dim>
  double
  ContactAreas<dim>::of(const SurfaceContact<dim> &contact) const
  {
    const unsigned int point =
      find({{contact.slave, contact.joint, contact.master_block}});
    return point == none ? std::numeric_limits<double>::quiet_NaN()
                         : points[point].present_area;
  }



  template <int dim>
  void
  ContactAreas<dim>::note_openings()
  {
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (!strength.needs_areas[pair.joint] || memory.state[p].has_opened ||
            memory.state[p].is_removed ||
            memory.state[p].status == ContactStatus::sticking)
          continue;
        const unsigned int minus = topology.numbering.local_node(pair.minus);
        const unsigned int plus  = topology.numbering.local_node(pair.plus);
        // nodes in surface contacts are known on all ranks
        const bool is_surface_contact =
          memory.is_surface_contact_group[topology.group_of_pair[p]];
        if (!is_surface_contact && (minus == none || plus == none))
          continue;
        const double *at_minus =
          is_surface_contact
            ? &nodes.displacement[dim * surface.node_of_vertex[pair.minus]]
            : &fields.displacement[dim * minus];
        const double *at_plus =
          is_surface_contact
            ? &nodes.displacement[dim * surface.node_of_vertex[pair.plus]]
            : &fields.displacement[dim * plus];
        double gap = 0.;
        for (int d = 0; d < dim; ++d)
          gap += memory.normal[p][d] * (at_plus[d] - at_minus[d]);
        if (gap - memory.dilation_of(p) > least_opening * pair.face_size)
          {
            memory.state[p].has_opened = true;
            is_shared                  = false;
          }
      }
  }



  template <int dim>
  bool
  ContactAreas<dim>::has_opened(const unsigned int node,
                                const unsigned int joint) const
  {
    const unsigned int g = topology.group_of_node[node];
    if (g == none)
      return false;
    const unsigned int v = surface.vertex_of_node[node];
    for (unsigned int p = interface.group_pairs_begin[g];
         p < interface.group_pairs_begin[g + 1];
         ++p)
      if (memory.state[p].has_opened && interface.pairs[p].joint == joint &&
          (interface.pairs[p].minus == v || interface.pairs[p].plus == v))
        return true;
    return false;
  }



  template <int dim>
  bool
  ContactAreas<dim>::has_pair(const unsigned int node,
                              const unsigned int joint,
                              const unsigned int block) const
  {
    const unsigned int g = topology.group_of_node[node];
    if (g == none)
      return false;
    const unsigned int v = surface.vertex_of_node[node];
    for (unsigned int p = interface.group_pairs_begin[g];
         p < interface.group_pairs_begin[g + 1];
         ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (pair.joint != joint || memory.state[p].is_converted ||
            memory.state[p].is_removed ||
            memory.state[p].status == ContactStatus::open ||
            (pair.minus != v && pair.plus != v))
          continue;
        const unsigned int partner = pair.minus == v ? pair.plus : pair.minus;
        if (surface.is_on_block(surface.node_of_vertex[partner], block))
          return true;
      }
    return false;
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
  ContactAreas<dim>::share()
  {
    std::vector<Footing> footings = list_footings();
    if (!is_shared || footings != shared_among)
      {
        distribute(footings);
        shared_among = std::move(footings);
        is_shared    = true;
      }
    weigh_by_pressure();
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
  void
  ContactAreas<dim>::weigh_by_pressure()
  {
    for (BearingPoint &point : points)
      point.impulse = 0.;
    std::fill(sums.begin(), sums.end(), BearingSums{});
    if (points.empty())
      return;
    for (const SurfaceContact<dim> &contact : memory.contacts)
      if (contact.joint != none && !contact.is_ridge)
        if (const unsigned int point =
              find({{contact.slave, contact.joint, contact.master_block}});
            point != none)
          points[point].impulse +=
            std::max(0., dot<dim>(contact.point.impulse, contact.point.normal));
    for (const BearingPoint &point : points)
      {
        sums[point.side_pair].area += point.area;
        sums[point.side_pair].impulse += point.impulse;
      }
    for (BearingPoint &point : points)
      {
        BearingSums &sum = sums[point.side_pair];
        // its pressure over the mean that is enough for all of its area
        const double enough = full_pressure * sum.impulse * point.area;
        point.present_area =
          point.area *
          (enough > 0. ? std::min(1., point.impulse * sum.area / enough) : 1.);
        sum.present_area += point.present_area;
      }
    for (BearingPoint &point : points)
      if (const BearingSums &sum = sums[point.side_pair]; sum.present_area > 0.)
        point.present_area *= sum.area / sum.present_area;
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
  void
  ContactAreas<dim>::average_pressure(const double kick)
  {
    std::map<Footing, double> area, impulse;
    for (const FaceOverlap<dim> &overlap : overlaps)
      area[key_of(overlap)] +=
        overlap.area * (1. - share_of_pairs(overlap, false));
    for (const SurfaceContact<dim> &contact : memory.contacts)
      if (contact.joint != none && !contact.is_ridge)
        impulse[between(contact.joint,
                        surface.block_of_node[contact.slave],
                        contact.master_block)] +=
          dot<dim>(contact.point.impulse, contact.point.normal);
    mean_pressure.clear();
    for (const auto &[key, sum] : impulse)
      if (const auto found = area.find(key);
          found != area.end() && found->second > 0.)
        mean_pressure[key] = sum / (found->second * kick);
  }



  template <int dim>
  double
  ContactAreas<dim>::pressure_at(const SurfaceContact<dim> &contact) const
  {
    const auto found =
      mean_pressure.find(between(contact.joint,
                                 surface.block_of_node[contact.slave],
                                 contact.master_block));
    return found == mean_pressure.end() ? 0. : found->second;
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

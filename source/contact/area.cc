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
  ContactAreas<dim>::note_openings(
    const std::function<double(unsigned int)> &dilation_of)
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
        const double opened = least_opening * pair.face_size;
        if (gap > opened && gap - dilation_of(p) > opened)
          {
            memory.state[p].has_opened = true;
            is_shared                  = false;
          }
      }
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



  template class ContactAreas<2>;
  template class ContactAreas<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/shotcrete.h>

#include <keyblock/base/sort_unique.h>
#include <keyblock/step/liner_mass.h>
#include <keyblock/step/row_bound.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Share of the strength from which on a section counts as sheared [-]. */
    constexpr double full_share = 1. - 1e-9;
  } // namespace



  template <int dim>
  Shotcrete<dim>::Shotcrete(const Scene<dim> &scene,
                            const SplitMesh<dim> &split,
                            const Numbering<dim> &numbering)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , weighed_mass(numbering.n_owned(), 0.)
    , inert_mass(numbering.n_owned(), 0.)
    , acceleration(scene)
    , trial(scene.safety.bolt_convention)
  {
    for (unsigned int i = 0; i < split.liners.size(); ++i)
      for (const LinerTrace<dim> &trace : split.liners[i].traces)
        {
          if (scene.liners[i]->shear_strength == 0.)
            continue;
          sections.emplace_back();
          sections.back().liner = i;
          sections.back().trace = trace;
        }
  }



  template <int dim>
  void
  Shotcrete<dim>::take_ground(const Ground<dim> &ground)
  {
    const auto is_there = [&](const unsigned int liner) {
      return scene.stage_number(scene.liners[liner]->stage) <=
             ground.stage_number;
    };
    for (Section &section : sections)
      section.is_present = is_there(section.liner) &&
                           !ground.is_excavated(section.trace.cell[0]) &&
                           !ground.is_excavated(section.trace.cell[1]);
    acceleration.take_ground(ground);
    std::fill(weighed_mass.begin(), weighed_mass.end(), 0.);
    std::fill(inert_mass.begin(), inert_mass.end(), 0.);
    reports.clear();
    for (unsigned int i = 0; i < split.liners.size(); ++i)
      if (is_there(i))
        {
          reports.push_back({i});
          reports.back().area =
            add_liner_mass(ground, numbering, i, weighed_mass);
          if (!scene.liners[i]->is_structural())
            add_liner_mass(ground, numbering, i, inert_mass);
        }
  }



  template <int dim>
  double
  Shotcrete<dim>::stiffness_of(const Section &section) const
  {
    return scene.liners[section.liner]->shear_modulus * section.trace.length;
  }



  template <int dim>
  double
  Shotcrete<dim>::strength_of(const Section &section) const
  {
    const Liner &liner = *scene.liners[section.liner];
    return liner.shear_strength * liner.thickness * section.trace.length;
  }



  template <int dim>
  std::vector<unsigned int>
  Shotcrete<dim>::nodes() const
  {
    std::vector<unsigned int> list;
    for (const Section &section : sections)
      for (const unsigned int v : section.trace.vertex)
        if (section.is_present && numbering.is_owned(v))
          list.push_back(numbering.local_node(v));
    for (unsigned int node = 0; node < weighed_mass.size(); ++node)
      if (weighed_mass[node] > 0.)
        list.push_back(node);
    sort_unique(list);
    return list;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  Shotcrete<dim>::openings(const std::vector<double> &displacement) const
  {
    std::vector<Tensor<1, dim>> result(sections.size());
    for (unsigned int i = 0; i < sections.size(); ++i)
      for (unsigned int side = 0; side < 2; ++side)
        if (const unsigned int v = sections[i].trace.vertex[side];
            sections[i].is_present && numbering.is_owned(v))
          for (unsigned int d = 0; d < dim; ++d)
            result[i][d] += (side == 0 ? -1. : 1.) *
                            displacement[dim * numbering.local_node(v) + d];
    if (!result.empty())
      numbering.communicator.sum(result.front().begin_raw(),
                                 dim * result.size());
    return result;
  }



  template <int dim>
  void
  Shotcrete<dim>::respond(const Tensor<1, dim> &opening, Section &section) const
  {
    if (!section.is_installed)
      {
        section.is_installed = true;
        section.rest         = opening;
        section.slip         = Tensor<1, dim>();
      }
    const double stiffness = stiffness_of(section);
    const double strength  = strength_of(section);
    const Tensor<1, dim> stretch =
      section.trace.in_section(opening - section.rest) - section.slip;
    const Tensor<1, dim> before = section.force;
    section.force               = -stiffness * stretch;
    const double excess         = section.force.norm() - strength;
    if (excess <= 0.)
      return;
    const Tensor<1, dim> slipped =
      excess / (stiffness * stretch.norm()) * stretch;
    section.slip += slipped;
    section.force *= strength / section.force.norm();
    // by the mean of the forces before and behind, as all work of a step
    section.dissipated -= 0.5 * (before + section.force) * slipped;
  }



  template <int dim>
  void
  Shotcrete<dim>::add_force(const std::vector<double> &displacement,
                            std::vector<double> &force)
  {
    // the same on every rank
    if (std::none_of(sections.begin(), sections.end(), [](const Section &s) {
          return s.is_present;
        }))
      return;
    const std::vector<Tensor<1, dim>> opening = openings(displacement);
    for (unsigned int i = 0; i < sections.size(); ++i)
      {
        Section &section = sections[i];
        if (!section.is_present)
          continue;
        respond(opening[i], section);
        Tensor<1, dim> on_second = section.force;
        if (!trial.is_whole())
          on_second += trial.taken(-section.force,
                                   section.trace.block,
                                   section.trace.joint,
                                   Tensor<1, dim>());
        // against what it does to the rock
        for (unsigned int side = 0; side < 2; ++side)
          if (const unsigned int v = section.trace.vertex[side];
              numbering.is_owned(v))
            for (unsigned int d = 0; d < dim; ++d)
              force[dim * numbering.local_node(v) + d] +=
                (side == 0 ? 1. : -1.) * on_second[d];
      }
  }



  template <int dim>
  void
  Shotcrete<dim>::add_load(const double time, std::vector<double> &load) const
  {
    const Tensor<1, dim> g = acceleration.at(time);
    for (unsigned int node = 0; node < weighed_mass.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        load[dim * node + d] += weighed_mass[node] * g[d];
  }



  template <int dim>
  void
  Shotcrete<dim>::add_mass(const typename ForceElement<dim>::Inertia &inertia,
                           std::vector<double> &mass)
  {
    frequency = inertia.frequency;
    own_mass  = inert_mass;
    add_inertia_of_liners(
      inertia, [this]() { return row_sums(); }, own_mass, mass);
  }



  template <int dim>
  StepBound
  Shotcrete<dim>::step_bound(const std::vector<double> &inverse_mass) const
  {
    // its own mass bears as much as the cells' highest frequency asks of it
    std::vector<double> row = row_sums();
    for (unsigned int node = 0; node < own_mass.size(); ++node)
      row[node] -= frequency * frequency * own_mass[node];
    return bound_of_rows(row, inverse_mass, numbering);
  }



  template <int dim>
  std::vector<double>
  Shotcrete<dim>::row_sums() const
  {
    std::vector<double> row(numbering.n_owned(), 0.);
    for (const Section &section : sections)
      for (const unsigned int v : section.trace.vertex)
        if (section.is_present && numbering.is_owned(v))
          row[numbering.local_node(v)] +=
            2. * trial.largest_share() * stiffness_of(section);
    return row;
  }



  template <int dim>
  double
  Shotcrete<dim>::stored_energy(const std::vector<double> &) const
  {
    double energy = 0.;
    if (numbering.communicator.is_root())
      for (const Section &section : sections)
        if (section.is_present)
          energy += 0.5 * section.force.norm_square() / stiffness_of(section);
    return energy;
  }



  template <int dim>
  double
  Shotcrete<dim>::plastic_work() const
  {
    double work = 0.;
    if (numbering.communicator.is_root())
      for (const Section &section : sections)
        work += section.dissipated;
    return work;
  }



  template <int dim>
  ForceElementState
  Shotcrete<dim>::remember() const
  {
    ForceElementState state{name(), {}, {}};
    for (const Section &section : sections)
      for_each_number(section, [&](const double number) {
        state.numbers.push_back(number);
      });
    return state;
  }



  template <int dim>
  void
  Shotcrete<dim>::recall(const ForceElementState &state)
  {
    std::size_t at = 0;
    for (Section &section : sections)
      for_each_number(section,
                      [&](auto &number) { number = state.numbers.at(at++); });
  }



  template <int dim>
  std::vector<LinerReport>
  Shotcrete<dim>::report() const
  {
    std::vector<LinerReport> result = reports;
    for (LinerReport &liner : result)
      for (const Section &section : sections)
        if (section.is_present && section.liner == liner.liner)
          {
            const double strength = strength_of(section);
            const double share    = section.force.norm() / strength;
            liner.trace_length += section.trace.length;
            liner.strength += strength;
            liner.largest_load = std::max(liner.largest_load, share);
            if (share >= full_share)
              liner.sheared += section.trace.length;
          }
    return result;
  }

  template class Shotcrete<2>;
  template class Shotcrete<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/conditions.h>

#include <keyblock/step/initial_state.h>

namespace Keyblock
{
  template <int dim>
  Conditions<dim>::Conditions(const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Numbering<dim> &numbering,
                              CellArrays<dim> &cells,
                              Fields<dim> &fields)
    : active_cells(scene, split, numbering, cells, fields)
    , supports(scene, split, numbering, clock, fields)
    , loads(scene, split, numbering, fields)
    , trial_pressure(split, numbering)
    , scene(scene)
    , split(split)
    , numbering(numbering)
    , fields(fields)
  {
    allocate_fields(split, numbering, fields);
    make_elements();
    excavate(1);
    set_initial_stress(scene, split.mesh, cells);
    set_initial_velocity(scene, split.mesh, numbering, fields);
    if (scene.time_stepping.is_large())
      {
        fields.position = fields.reference;
        fields.rate     = fields.velocity;
      }
  }



  template <int dim>
  void
  Conditions<dim>::make_elements()
  {
    if (FarFieldSprings<dim>::is_wanted(scene))
      {
        auto springs = std::make_unique<FarFieldSprings<dim>>(scene,
                                                              split,
                                                              numbering,
                                                              fields);
        far_field    = springs.get();
        elements.push_back(std::move(springs));
      }
    if (QuietBoundary<dim>::is_wanted(scene))
      {
        auto dashpots =
          std::make_unique<QuietBoundary<dim>>(scene, split, numbering, clock);
        quiet = dashpots.get();
        elements.push_back(std::move(dashpots));
      }
    if (!split.bolts.empty())
      {
        auto of_scene = std::make_unique<Bolts<dim>>(scene, split, numbering);
        bolts         = of_scene.get();
        elements.push_back(std::move(of_scene));
      }
    if (!split.liners.empty())
      {
        auto sprayed =
          std::make_unique<Shotcrete<dim>>(scene, split, numbering);
        shotcrete = sprayed.get();
        elements.push_back(std::move(sprayed));
      }
    if (StructuralLiners<dim>::is_wanted(scene))
      {
        auto bonded = std::make_unique<StructuralLiners<dim>>(scene,
                                                              split,
                                                              numbering,
                                                              active_cells);
        liners      = bonded.get();
        elements.push_back(std::move(bonded));
      }
  }



  template <int dim>
  void
  Conditions<dim>::excavate(const unsigned int number)
  {
    // supports that are quiet from the start wait for the initial state
    if (quiet && number > 1)
      quiet->release(number, reaction());
    active_cells.excavate(number);
    for (const auto &element : elements)
      element->take_ground(active_cells.ground());
    set_up_supports();
    loads.set_up(active_cells.ground());
  }



  template <int dim>
  void
  Conditions<dim>::set_up_supports()
  {
    supports.set_up(active_cells.ground(), [&](const unsigned int s) {
      return scene.supports[s]->is_far_field() ? far_field->is_acting()
                                               : quiet && quiet->is_acting(s);
    });
    scale_density(false);
  }



  template <int dim>
  void
  Conditions<dim>::freeze(const std::vector<bool> &is_frozen_cell)
  {
    active_cells.freeze(is_frozen_cell);
    excavate(active_cells.state().stage_number);
  }



  template <int dim>
  StageState
  Conditions<dim>::remember() const
  {
    StageState state{active_cells.state(),
                     loads.state(),
                     clock.state(),
                     {},
                     trial_pressure.value};
    for (const auto &element : elements)
      state.elements.push_back(element->remember());
    return state;
  }



  template <int dim>
  void
  Conditions<dim>::take_up(const StageState &state)
  {
    active_cells.recall(state.cells);
    loads.recall(state.loads);
    clock.recall(state.stage_begins);
    trial_pressure.value = state.trial_pressure;
    for (unsigned int i = 0; i < elements.size(); ++i)
      elements[i]->recall(state.elements.at(i));
  }



  template <int dim>
  void
  Conditions<dim>::recall(const StageState &state)
  {
    const bool has_other_cells = !(active_cells.state() == state.cells);
    take_up(state);
    if (has_other_cells)
      excavate(state.cells.stage_number);
  }



  template <int dim>
  void
  Conditions<dim>::resume(const StageState &state)
  {
    take_up(state);
    excavate(state.cells.stage_number);
  }



  template <int dim>
  void
  Conditions<dim>::scale_density(const bool is_scaled)
  {
    active_cells.scale_density(is_scaled);
    add_masses(is_scaled);
    list_moving_nodes();
    stable_step               = active_cells.stable_step;
    frequency_ratio_of_liners = frequency_ratio_of_traces = 1.;
    for (const auto &element : elements)
      {
        const double before = stable_step.frequency;
        stable_step.add(element->step_bound(fields.inverse_mass));
        const double ratio = stable_step.frequency / before;
        if (element.get() == shotcrete || element.get() == liners)
          frequency_ratio_of_liners *= ratio;
        if (element.get() == shotcrete)
          frequency_ratio_of_traces = ratio;
      }
  }



  template <int dim>
  void
  Conditions<dim>::add_masses(const bool is_scaled)
  {
    std::vector<double> own(numbering.n_owned(), 0.);
    for (const auto &element : elements)
      element->add_mass({active_cells.stable_step.frequency, is_scaled}, own);
    if (!numbering.communicator.on_any(std::any_of(
          own.begin(), own.end(), [](const double m) { return m > 0.; })))
      return;
    std::vector<double> by_dof(dim * numbering.n_local(), 0.);
    for (unsigned int node = 0; node < own.size(); ++node)
      by_dof[dim * node] = own[node];
    numbering.update_ghosts(by_dof);
    own.resize(numbering.n_local());
    for (unsigned int node = 0; node < own.size(); ++node)
      own[node] = by_dof[dim * node];
    active_cells.add_mass(own);
  }



  template <int dim>
  void
  Conditions<dim>::list_moving_nodes()
  {
    std::vector<bool> is_outer(numbering.n_local(), false);
    const auto take = [&](const unsigned int vertex) {
      split.for_each_carrier(vertex, [&](const unsigned int carrier, double) {
        for (const unsigned int v : {vertex, carrier})
          if (numbering.is_owned(v))
            is_outer[numbering.local_node(v)] = true;
      });
    };
    for (const unsigned int v : split.interface.group_vertices)
      take(v);
    for (const SurfaceFace<dim> &face : split.interface.surface)
      for (const unsigned int v : face.vertices)
        take(v);
    for (const unsigned int node : numbering.hanging_nodes)
      is_outer[node] = true;
    for (const NodeSupport<dim> &support : fields.supports)
      is_outer[support.node] = true;
    for (const auto &element : elements)
      if (element->is_viscous())
        for (const unsigned int node : element->nodes())
          is_outer[node] = true;

    fields.runs.clear();
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (is_outer[node] || fields.inverse_mass[node] > 0.)
        {
          if (fields.runs.empty() || fields.runs.back().end != node ||
              fields.runs.back().is_inner == is_outer[node])
            fields.runs.push_back({node, node, !is_outer[node]});
          ++fields.runs.back().end;
        }
  }



  template <int dim>
  void
  Conditions<dim>::set_damping(const Stage &stage)
  {
    active_cells.set_damping(stage);
    if (stage.has_stiffness_damping() || has_viscous_elements())
      fields.damping_force.assign(fields.velocity.size(), 0.);
  }



  template <int dim>
  std::vector<double>
  Conditions<dim>::reaction() const
  {
    std::vector<double> given(dim * numbering.n_owned());
    for (unsigned int i = 0; i < given.size(); ++i)
      given[i] =
        fields.internal_force[i] - fields.load[i] - fields.contact_force[i];
    return given;
  }



  template <int dim>
  std::string
  Conditions<dim>::release_supports()
  {
    std::string remark;
    const std::vector<double> given = reaction();
    if (far_field && !far_field->is_acting())
      {
        far_field->release(given);
        if (!far_field->is_coupled())
          remark = "the far field does not enclose its centre: springs only";
      }
    if (quiet)
      quiet->release(1, given);
    loads.forget_load();
    set_up_supports();
    set_damping(Stage());
    return remark;
  }



  template <int dim>
  bool
  Conditions<dim>::is_load_changing() const
  {
    return loads.is_load_changing() ||
           std::any_of(elements.begin(), elements.end(), [](const auto &e) {
             return e->is_load_changing();
           });
  }



  template <int dim>
  double
  Conditions<dim>::radiated_work(const double kick) const
  {
    double work = 0.;
    for (const auto &element : elements)
      if (element->is_viscous())
        work += element->damping_work(fields, kick);
    return work;
  }



  template <int dim>
  void
  Conditions<dim>::reduce_strength(const StrengthReduction &reduction)
  {
    for (const auto &element : elements)
      element->reduce_strength(reduction);
  }



  template <int dim>
  void
  Conditions<dim>::take_ways(const std::vector<Tensor<1, dim>> &ways)
  {
    for (const auto &element : elements)
      element->take_ways(ways);
  }



  template <int dim>
  void
  Conditions<dim>::set_load(const double time)
  {
    if (is_load_changing())
      loads.forget_load();
    if (loads.set_load(time))
      for (const auto &element : elements)
        element->add_load(time, fields.load);
  }



  template <int dim>
  void
  Conditions<dim>::apply_supports(const double time, const double step)
  {
    supports.apply_supports(time, step, loads.displacement_share_of_step(step));
  }

  template class Conditions<2>;
  template class Conditions<3>;
} // namespace Keyblock

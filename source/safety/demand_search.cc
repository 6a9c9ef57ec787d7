// SPDX-License-Identifier: LGPL-2.1-or-later
// The search for the pressure on a block's free faces with which it holds at
// the wanted factor.
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/pressure_bracket.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Resultant over the load of the block of @p result in the trial that
     * failed at the factor that is nearest to @p wanted; 0: none has [-]. */
    double
    unbalanced_in_failure(const SafetyFactor &result, const double wanted)
    {
      const Trial *nearest = nullptr;
      for (const Trial &trial : result.trials)
        if (!trial.is_stable && !trial.is_undecided &&
            (nearest == nullptr || std::abs(trial.factor - wanted) <
                                     std::abs(nearest->factor - wanted)))
          nearest = &trial;
      return nearest == nullptr ? 0. : nearest->unbalanced;
    }

    /** Let the pressure of trials act on @p faces of blocks with a @p load [N];
     * those on both ends may cancel each other, which leaves no unit. */
    template <int dim>
    PressedBlock<dim>
    press_on(const RunParts<dim> &run,
             const SplitMesh<dim> &split,
             const std::vector<CellFace> &faces,
             const double load)
    {
      run.conditions.trial_pressure.press_on(faces);
      PressedBlock<dim> pressed;
      pressed.area = sum_of_areas(split.mesh, faces);
      if (pressed.area.norm() > 0.)
        pressed.unit = load / pressed.area.norm();
      return pressed;
    }

    /** A pressure that does what @p unbalanced of the load does, if that is
     * known [Pa]. */
    template <int dim>
    double
    guess_pressure(const PressedBlock<dim> &pressed, const double unbalanced)
    {
      return pressed.unit * (unbalanced > 0. ? unbalanced : 1.);
    }

    /** Capacity of bolts that do what an active force of @p demand does at the
     * wanted factor, which divides what passive ones bear [N]. */
    double
    capacity_for(const TriedDemand &demand, const SafetySettings &safety)
    {
      return demand.force() * (safety.bolt_convention == BoltConvention::passive
                                 ? std::max(1., safety.wanted)
                                 : 1.);
    }
  } // namespace



  std::string
  describe_outcome(const TriedDemand &demand)
  {
    switch (demand.outcome)
      {
        case TriedDemand::Outcome::not_sought:
          return "";
        case TriedDemand::Outcome::met:
          return "met";
        case TriedDemand::Outcome::bracketed:
          return "support";
        case TriedDemand::Outcome::out_of_reach:
          return "out of reach";
        case TriedDemand::Outcome::undecided:
          return "undecided";
      }
    return "";
  }



  template <int dim>
  PressedBlock<dim>
  StrengthReductionSearch<dim>::press_on_block(const SafetyFactor &result)
  {
    const Ground<dim> ground = run.conditions.active_cells.ground();
    const FreeFaces<dim> free(ground);
    const BlockStatics<dim> statics =
      judge_block<dim>(ground.rigid(),
                       FreeFaces<dim>(ground.rigid()),
                       blocks,
                       result.block,
                       run.step.time,
                       run.conditions.broken_segments());
    Tensor<1, dim> way = statics.limit.direction;
    if (way.norm() == 0.)
      for (unsigned int d = 0; d < dim; ++d)
        way[d] = trials.failure.way()[d];
    TriedBlocks alone;
    alone.block = result.block;
    PressedBlock<dim> pressed =
      press_on(run,
               split,
               list_supported_faces(ground, free, result.block, way),
               trials.measures.motion(alone).load);
    if (pressed.unit == 0.)
      return pressed;
    pressed.area_of_force = pressed.area.norm();
    const double by_statics =
      std::isfinite(statics.demand.pressure) ? statics.demand.pressure : 0.;
    if (statics.facts.is_complete)
      pressed.slides_below = by_statics;
    pressed.first_guess =
      by_statics > 0.
        ? by_statics
        : guess_pressure(pressed,
                         unbalanced_in_failure(result, scene.safety.wanted));
    return pressed;
  }



  template <int dim>
  PressedBlock<dim>
  StrengthReductionSearch<dim>::PressureSearch::press_on_group(
    StrengthReductionSearch &owner,
    const TriedBlocks &tried,
    const double unbalanced)
  {
    const Ground<dim> ground = owner.run.conditions.active_cells.ground();
    const FreeFaces<dim> free(ground);
    Tensor<1, dim> way;
    for (unsigned int d = 0; d < dim; ++d)
      way[d] = owner.trials.failure.way()[d];
    std::vector<CellFace> faces;
    double load = 0.;
    for (const unsigned int b : tried.all())
      {
        TriedBlocks alone;
        alone.block = b;
        load += owner.trials.measures.motion(alone).load;
        const auto own = list_supported_faces(ground, free, b, way);
        faces.insert(faces.end(), own.begin(), own.end());
      }
    PressedBlock<dim> pressed = press_on(owner.run, owner.split, faces, load);
    pressed.area_of_force     = pressed.area.norm();
    pressed.first_guess       = guess_pressure(pressed, unbalanced);
    return pressed;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::search_pressure(
    const TriedBlocks &tried,
    const PressedBlock<dim> &pressed,
    const unsigned int number,
    const double start,
    const PressureState &now,
    TriedDemand &demand)
  {
    PressureSearch search(
      *this, tried, pressed, number, start, now.is_at_rest, demand);
    demand.outcome = search.find(now.fails_without);
    search.finish();
    demand.area = pressed.area_of_force;
    if (demand.outcome == TriedDemand::Outcome::bracketed)
      demand.numbers = list_new_bolts(
        run.conditions.active_cells.ground(),
        find_support_of_block(run.conditions.active_cells.ground(),
                              tried.block,
                              run.step.time,
                              run.conditions.broken_segments()),
        capacity_for(demand, scene.safety));
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::add_demand(const unsigned int number,
                                           const Known &known,
                                           SafetyFactor &result)
  {
    using Outcome       = SafetyFactor::Outcome;
    const double wanted = scene.safety.wanted;
    if (!scene.safety.is_demand_tried())
      return;
    const bool is_carried = result.outcome == Outcome::carried;
    const bool group_fails =
      !result.group.empty() && result.group_lower < wanted;
    if (!group_fails && (is_carried || result.lower >= wanted))
      {
        result.tried_demand.outcome = TriedDemand::Outcome::met;
        return;
      }
    TriedBlocks tried;
    tried.block      = result.block;
    tried.is_carried = is_carried;
    if (group_fails)
      for (const unsigned int id : result.group)
        if (id != blocks.blocks[result.block].id)
          tried.companions.push_back(id - 1);
    const double unstable = group_fails ? result.group_upper : result.upper;
    PressureState now;
    now.is_at_rest            = result.outcome != Outcome::falls_freely;
    now.fails_without         = unstable > 0. && unstable <= wanted;
    PressedBlock<dim> pressed = press_on_block(result);
    if (group_fails && pressed.unit == 0.)
      pressed =
        PressureSearch::press_on_group(*this,
                                       tried,
                                       unbalanced_in_failure(result, wanted));
    search_pressure(
      tried, pressed, number, known.start, now, result.tried_demand);
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::add_demand_of_pressed(
    const PressedBlock<dim> &pressed,
    const unsigned int number,
    const Known &known,
    SafetyFactor &result)
  {
    TriedBlocks alone;
    alone.block = result.block;
    search_pressure(alone,
                    pressed,
                    number,
                    known.start,
                    PressureState(),
                    result.tried_demand);
  }

#define INSTANTIATE(dim)                                                       \
  template PressedBlock<dim> StrengthReductionSearch<dim>::press_on_block(     \
    const SafetyFactor &);                                                     \
  template void StrengthReductionSearch<dim>::add_demand(const unsigned int,   \
                                                         const Known &,        \
                                                         SafetyFactor &);      \
  template void StrengthReductionSearch<dim>::add_demand_of_pressed(           \
    const PressedBlock<dim> &,                                                 \
    const unsigned int,                                                        \
    const Known &,                                                             \
    SafetyFactor &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

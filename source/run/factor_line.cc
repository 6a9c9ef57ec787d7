// SPDX-License-Identifier: LGPL-2.1-or-later
// What is said of a safety factor on the screen.
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/run/safety_study.h>
#include <keyblock/safety/block_statics.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace Keyblock
{
  namespace
  {
    /** Blocks 1, 2. */
    std::string
    list_group(const SafetyFactor &factor)
    {
      std::string text = "blocks ";
      for (unsigned int i = 0; i < factor.group.size(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(factor.group[i]);
      return text;
    }



    /** Faces that the pressure of its demand by trials acts on: those of a
     * group if that lacks the wanted factor, found for it or for another. */
    std::string
    describe_pressed(const SafetyFactor &factor)
    {
      const bool is_of_group =
        !factor.group.empty() &&
        factor.group_lower < factor.support_demand.factor &&
        (factor.has_own_group() || factor.tried_demand.trials.empty());
      return is_of_group ? "free faces of " + list_group(factor)
                         : "its free faces";
    }



    bool
    asks_for_support(const SafetyFactor &factor)
    {
      return factor.tried_demand.outcome != TriedDemand::Outcome::not_sought &&
             factor.tried_demand.outcome != TriedDemand::Outcome::met;
    }



    std::string
    describe_group(const SafetyFactor &factor)
    {
      std::ostringstream text;
      text << std::setprecision(5)
           << (factor.has_own_group() ? "" : "in the group of ")
           << list_group(factor)
           << (factor.has_own_group() ? " move together: " : ": ")
           << factor.value_of_group() << " [" << factor.group_lower << ", "
           << factor.group_upper << "]";
      if (factor.group_undecided_upper > 0.)
        text << ", undecided from " << factor.group_undecided_lower << " to "
             << factor.group_undecided_upper;
      return text.str();
    }



    /** The joints that a failing block presses beside those of its way by limit
     * equilibrium, as in "J1/J2"; empty: none. */
    std::string
    pressed_beside(const SafetyFactor &factor)
    {
      const std::vector<std::string> &known = factor.limit_mode.joints;
      BlockMode pressed;
      for (const std::string &name : factor.failure_mode.joints)
        if (std::find(known.begin(), known.end(), name) == known.end())
          pressed.add_joint(name);
      return pressed.names();
    }



    /** Why strength reduction gives more than limit equilibrium, where that is
     * known; else empty. */
    template <int dim>
    std::string
    explain_more(const SafetyFactor &factor)
    {
      // shear across the way has held wedges at up to this times limit
      // equilibrium
      constexpr double most_by_shear = 1.25;
      if (!factor.group.empty())
        return "";
      const std::string pressed = pressed_beside(factor);
      const std::string advice  = ": rely on no more than limit equilibrium";
      if (!pressed.empty())
        return "; more than limit equilibrium, as " + pressed +
               " is pressed, too, by turning or by stress" + advice;
      if (!factor.facts.is_complete)
        return "";
      const bool is_on_two_planes =
        dim == 3 && factor.limit_mode.joints.size() > 1;
      if (factor.lower > most_by_shear * factor.limit_factor)
        return "; far more than limit equilibrium, and nothing known holds it" +
               advice;
      return is_on_two_planes
               ? "; shear across its way helps to hold the wedge, limit "
                 "equilibrium is on the safe side"
               : "";
    }



    /** Why strength reduction differs from limit equilibrium, where that is
     * known and not a matter of the bracket; else empty. */
    template <int dim>
    std::string
    explain_difference(const SafetyFactor &factor, const Scene<dim> &scene)
    {
      constexpr double more = 1.005, less = 0.98;
      const double limit = factor.limit_factor;
      if (factor.outcome != SafetyFactor::Outcome::bracketed ||
          !std::isfinite(limit) || limit < 0.)
        return "";
      if (factor.lower > more * limit)
        return explain_more<dim>(factor);
      if (factor.upper >= less * limit)
        return "";
      if (factor.facts.loses_friction)
        return "; less than limit equilibrium, as friction falls where points "
               "slip";
      if (!has_initial_stress(scene))
        return "";
      std::ostringstream text;
      text << "; less than limit equilibrium, as stress in the rock pushes, "
              "too: ";
      double lost = 0.; // by the trial that failed
      for (const Trial &trial : factor.trials)
        if (!trial.is_of_group && trial.factor == factor.upper)
          lost = trial.weakened_area;
      if (lost > 0.)
        text << "it moves until cohesion is lost on " << std::setprecision(5)
             << lost << (dim == 2 ? " m" : " m2");
      else
        text << "it moves off again after it was damped";
      return text.str();
    }



    /** The line about the support that a wanted factor asks for by trials. */
    template <int dim>
    void
    print_demand(std::ostream &out,
                 const SafetyFactor &factor,
                 const Blocks<dim> &blocks,
                 const Scene<dim> &scene)
    {
      using Outcome             = TriedDemand::Outcome;
      const TriedDemand &demand = factor.tried_demand;
      const double by_statics   = factor.support_demand.pressure;
      const std::string per     = dim == 2 ? " kN/m" : " kN";
      out << "Support block " << blocks.blocks[factor.block].id << " after "
          << factor.stage << ": " << std::setprecision(4);
      if (demand.outcome == Outcome::bracketed)
        out << 1e-3 * demand.pressure() << " kPa [" << 1e-3 * demand.lower
            << ", " << 1e-3 * demand.upper << "], " << 1e-3 * demand.force()
            << per << " against " << describe_pressed(factor);
      else if (demand.outcome == Outcome::out_of_reach)
        out << "no pressure on " << describe_pressed(factor) << " is enough";
      else
        out << "undecided";
      if (demand.undecided_upper > 0.)
        out << ", undecided from " << 1e-3 * demand.undecided_lower << " to "
            << 1e-3 * demand.undecided_upper << " kPa";
      for (const auto &[set, number] : demand.numbers)
        out << ", or " << describe_bolts(scene, set, number);
      out << ", for a factor of " << factor.support_demand.factor;
      if (by_statics == 0.)
        out << "; limit equilibrium asks for none";
      else if (std::isfinite(by_statics))
        out << "; limit equilibrium " << 1e-3 * by_statics << " kPa";
      double seconds = 0.;
      for (const Trial &trial : demand.trials)
        seconds += trial.seconds;
      if (!demand.trials.empty())
        out << "; " << demand.trials.size()
            << (demand.trials.size() == 1 ? " trial, " : " trials, ")
            << std::setprecision(3) << seconds << " s";
      out << std::endl;
    }



    template <int dim>
    void
    begin_line(std::ostream &out,
               const SafetyFactor &factor,
               const Blocks<dim> &blocks)
    {
      out << "Factor  block " << blocks.blocks[factor.block].id << " after "
          << factor.stage << ": ";
    }
  } // namespace



  template <int dim>
  void
  print_group(std::ostream &out,
              const SafetyFactor &factor,
              const Blocks<dim> &blocks,
              const Scene<dim> &scene)
  {
    begin_line(out, factor, blocks);
    out << describe_group(factor) << std::endl;
    // what its group asks for
    if (factor.tried_demand.trials.empty() && asks_for_support(factor))
      print_demand(out, factor, blocks, scene);
  }



  template <int dim>
  void
  print_factor(std::ostream &out,
               const SafetyFactor &factor,
               const Blocks<dim> &blocks,
               const Scene<dim> &scene)
  {
    double seconds = 0.;
    for (const Trial &trial : factor.trials)
      seconds += trial.seconds;
    begin_line(out, factor, blocks);
    out << std::setprecision(5);
    const bool is_tried = factor.outcome != SafetyFactor::Outcome::by_statics;
    if (factor.outcome == SafetyFactor::Outcome::bracketed)
      out << factor.value() << " [" << factor.lower << ", " << factor.upper
          << "]";
    else if (factor.outcome == SafetyFactor::Outcome::falls_freely &&
             factor.failure_mode.motion != "falling")
      out << "below " << factor.upper;
    else if (is_tried)
      out << describe_outcome(factor);
    if (factor.undecided_upper > 0.)
      out << ", undecided from " << factor.undecided_lower << " to "
          << factor.undecided_upper;
    if (!factor.failure_mode.motion.empty())
      out << ", " << factor.failure_mode.text();
    if (!factor.group.empty())
      out << "; " << describe_group(factor);
    out << (is_tried ? "; " : "") << "limit equilibrium "
        << (has_initial_stress(scene) ? "without in-situ clamping " : "");
    if (std::isfinite(factor.limit_factor))
      out << factor.limit_factor << " ";
    else
      out << "above all ";
    out << "(" << factor.limit_mode.text()
        << (factor.limit_remark.empty() ? "" : "; ") << factor.limit_remark
        << ")";
    if (factor.stress_ratio > 0.)
      out << ", stress ratio " << factor.stress_ratio;
    const Block<dim> &block = blocks.blocks[factor.block];
    Trial last; // that held
    for (const Trial &trial : factor.trials)
      if (trial.is_stable && !trial.is_of_group && trial.factor == factor.lower)
        last = trial;
    // a bond that keeps its cohesion has lost no more than its tensile strength
    if (last.n_broken > 0 &&
        (factor.facts.bears_tension || last.weakened_area > 0.))
      out << "; " << last.n_broken << " bonds broke in the last that held";
    if (last.weakened_area > 0.)
      out << "; cohesion lost on " << last.weakened_area
          << (dim == 2 ? " m" : " m2") << " by the last that held"
          << (std::isfinite(factor.limit_factor)
                ? ", counted by limit equilibrium"
                : "");
    if (!factor.trials.empty() && factor.trials.front().phase == 0)
      out << "; by running the stage again: joints that are strong from the "
             "first keep it clamped";
    out << explain_difference(factor, scene);
    if (factor.outcome == SafetyFactor::Outcome::immovable ||
        factor.outcome == SafetyFactor::Outcome::clamped)
      for (const Trial &trial : factor.trials)
        if (!trial.is_stable && !trial.is_undecided && !trial.is_of_group)
          {
            out << "; it failed at " << trial.factor
                << " when its strength changed in one go from that at "
                << trial.start;
            break;
          }
    if (is_too_coarse(block, scene))
      out << "; only " << std::setprecision(2) << block.cells_across()
          << " cells across, not " << scene.meshing.cells_across;
    if (is_tried)
      out << "; " << factor.trials.size()
          << (factor.trials.size() == 1 ? " trial, " : " trials, ")
          << std::setprecision(3) << seconds << " s";
    out << std::endl;
    if (asks_for_support(factor))
      print_demand(out, factor, blocks, scene);
  }

  template void print_group(std::ostream &,
                            const SafetyFactor &,
                            const Blocks<2> &,
                            const Scene<2> &);
  template void print_group(std::ostream &,
                            const SafetyFactor &,
                            const Blocks<3> &,
                            const Scene<3> &);
  template void print_factor(std::ostream &,
                             const SafetyFactor &,
                             const Blocks<2> &,
                             const Scene<2> &);
  template void print_factor(std::ostream &,
                             const SafetyFactor &,
                             const Blocks<3> &,
                             const Scene<3> &);
} // namespace Keyblock

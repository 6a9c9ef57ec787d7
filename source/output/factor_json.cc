// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/output/factor_json.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    Json
    trials_as_json(const std::vector<Trial> &trials)
    {
      Json list = Json::array();
      for (const Trial &trial : trials)
        list.push_back({{"factor", trial.factor},
                        {"pressure", trial.pressure},
                        {"start", trial.start},
                        {"of_group", trial.is_of_group},
                        {"stable", trial.is_stable},
                        {"undecided", trial.is_undecided},
                        {"broken_bonds", trial.n_broken},
                        {"weakened_area", trial.weakened_area},
                        {"phase", trial.phase},
                        {"slip", trial.slip},
                        {"velocity", trial.velocity},
                        {"acceleration", trial.acceleration},
                        {"unbalanced", trial.unbalanced},
                        {"steps", trial.n_steps},
                        {"seconds", trial.seconds},
                        {"phase_1_seconds", trial.phase_1_seconds}});
      return list;
    }

    /** The blocks that move together, and their factor. */
    Json
    group_as_json(const SafetyFactor &factor)
    {
      Json json = {{"blocks", factor.group},
                   {"lower", factor.group_lower},
                   {"upper", factor.group_upper},
                   {"value", factor.value_of_group()}};
      if (factor.group_undecided_upper > 0.)
        {
          json["undecided_lower"] = factor.group_undecided_lower;
          json["undecided_upper"] = factor.group_undecided_upper;
        }
      return json;
    }

    Json
    demand_as_json(const SupportDemand &demand)
    {
      Json json = {{"factor", demand.factor}};
      if (demand.force == 0.)
        json["outcome"] = "met";
      else if (std::isinf(demand.force))
        json["outcome"] = "out of reach";
      else
        {
          json["outcome"]  = "support";
          json["force"]    = demand.force;
          json["pressure"] = demand.pressure;
        }
      for (const auto &[set, number] : demand.numbers)
        if (number > 0)
          json["bolts"][set] = number;
      return json;
    }

    /** By trials, for a factor that is wanted. */
    Json
    demand_as_json(const TriedDemand &demand, const double factor)
    {
      Json json = {{"factor", factor}, {"outcome", describe_outcome(demand)}};
      if (demand.outcome == TriedDemand::Outcome::bracketed)
        {
          json["lower"]    = demand.lower;
          json["pressure"] = demand.pressure();
          json["force"]    = demand.force();
        }
      else if (demand.lower > 0.)
        json["lower"] = demand.lower;
      if (demand.upper > 0.)
        json["upper"] = demand.upper;
      if (demand.undecided_upper > 0.)
        {
          json["undecided_lower"] = demand.undecided_lower;
          json["undecided_upper"] = demand.undecided_upper;
        }
      for (const auto &[set, number] : demand.numbers)
        json["bolts"][set] = number;
      json["trials"] = trials_as_json(demand.trials);
      return json;
    }

    Json
    strength_reduction_as_json(const SafetyFactor &factor)
    {
      using Outcome = SafetyFactor::Outcome;
      Json json     = {{"stage", factor.stage}};
      if (factor.lower > 0.)
        json["lower"] = factor.lower;
      if (factor.upper > 0.)
        json["upper"] = factor.upper;
      if (factor.outcome == Outcome::bracketed)
        json["value"] = factor.value();
      if (factor.undecided_upper > 0.)
        {
          json["undecided_lower"] = factor.undecided_lower;
          json["undecided_upper"] = factor.undecided_upper;
        }
      json["outcome"]      = describe_outcome(factor);
      json["failure_mode"] = factor.failure_mode.text();
      if (!factor.group.empty())
        json["group"] = group_as_json(factor);
      if (factor.tried_demand.outcome != TriedDemand::Outcome::not_sought)
        json["support_demand"] =
          demand_as_json(factor.tried_demand, factor.support_demand.factor);
      json["trials"] = trials_as_json(factor.trials);
      return json;
    }
  } // namespace



  void
  put_limit_factor(const double factor, Json &json)
  {
    const bool is_stable = std::isinf(factor) && factor > 0.;
    json["outcome"]      = is_stable ? "stable" : "factor";
    if (!is_stable)
      json["value"] = factor;
  }



  void
  put_factors(const std::vector<SafetyFactor> &factors,
              const unsigned int block,
              Json &json)
  {
    Json strength = Json::array(), limit = Json::array(), ratio = Json::array();
    for (const SafetyFactor &factor : factors)
      {
        if (factor.block != block)
          continue;
        Json cheap = {{"stage", factor.stage},
                      {"mode", factor.limit_mode.text()},
                      {"remark", factor.limit_remark}};
        put_limit_factor(factor.limit_factor, cheap);
        if (const OnceGone &then = factor.limit_once_gone; !then.blocks.empty())
          cheap["once_gone"] = {{"blocks", then.blocks},
                                {"value", then.factor},
                                {"mode", then.mode}};
        if (factor.support_demand.factor > 0.)
          cheap["support_demand"] = demand_as_json(factor.support_demand);
        limit.push_back(cheap);
        if (factor.outcome == SafetyFactor::Outcome::by_statics)
          continue;
        strength.push_back(strength_reduction_as_json(factor));
        ratio.push_back({{"stage", factor.stage}});
        if (factor.stress_ratio > 0.)
          ratio.back()["value"] = factor.stress_ratio;
        json["failure_mode"] = factor.failure_mode.text();
      }
    if (!limit.empty())
      json["limit_equilibrium"] = limit;
    if (strength.empty())
      return;
    json["safety_factor"] = strength;
    json["stress_ratio"]  = ratio;
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_safety_h
#define keyblock_scene_safety_h

#include <keyblock/base/choice.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  using dealii::ParameterHandler;

  /** Joints whose strength a trial reduces. */
  enum class ReducedJoints
  {
    of_block,
    all
  };
  template <>
  struct ChoiceNames<ReducedJoints>
  {
    static constexpr std::array<const char *, 2> names = {
      {"of the block", "all"}};
  };

  /** Search for the safety factor. */
  enum class FactorSearch
  {
    bisection,
    sweep,
    limit_equilibrium ///< no search, and no step
  };
  template <>
  struct ChoiceNames<FactorSearch>
  {
    static constexpr std::array<const char *, 3> names = {
      {"bisection", "sweep", "limit equilibrium"}};
  };

  /** What tells the support that a wanted factor asks for. */
  enum class DemandSearch
  {
    limit_equilibrium,
    strength_reduction ///< trials too, with a pressure on the free faces
  };
  template <>
  struct ChoiceNames<DemandSearch>
  {
    static constexpr std::array<const char *, 2> names = {
      {"limit equilibrium", "strength reduction"}};
  };

  /** How the forces of bolts enter a factor. */
  enum class BoltConvention
  {
    active,
    passive
  };
  template <>
  struct ChoiceNames<BoltConvention>
  {
    static constexpr std::array<const char *, 2> names = {
      {"active", "passive"}};
  };

  /** Safety factors by strength reduction, and what goes with them. */
  struct SafetySettings
  {
    std::string blocks = "none";
    std::vector<std::string> stages;
    std::vector<std::string> joints;
    ReducedJoints reduced_joints = ReducedJoints::of_block;
    bool reduces_rock            = false;
    FactorSearch method          = FactorSearch::bisection;
    double sweep_step            = 0.01;
    double bracket               = 0.005;
    double lowest                = 0.1;
    double highest               = 100.;
    double mass_damping          = 0.2;
    double local_damping         = 0.;
    double damping_ratio         = 1.;
    double window                = 1.;
    double maximum_periods       = 100.;
    unsigned int trial_steps     = 0;
    bool warm_start              = true;
    bool adaptive_damping        = true;
    bool true_masses             = false;
    double reach                 = 3.;
    std::vector<double> seismic_coefficient;
    double removal_slip            = 0.05;
    BoltConvention bolt_convention = BoltConvention::active;
    double wanted                  = 0.; ///< factor [-]
    DemandSearch wanted_by         = DemandSearch::limit_equilibrium;
    double critical_factor         = 2.; ///< by limit equilibrium [-]
    unsigned int rank_groups       = 1;

    bool
    is_wanted() const
    {
      return blocks != "none" || is_by_statics();
    }

    /** Whether blocks are judged by limit equilibrium alone, where stages only
     * excavate and support. */
    bool
    is_by_statics() const
    {
      return method == FactorSearch::limit_equilibrium;
    }

    /** Whether trials look for the support that the wanted factor asks for. */
    bool
    is_demand_tried() const
    {
      return wanted > 0. && wanted_by == DemandSearch::strength_reduction &&
             is_wanted() && !is_by_statics();
    }

    /** Whether only blocks with a free face are asked for. */
    bool
    wants_exposed_only() const
    {
      return blocks == "exposed" || wants_critical_only() || is_by_statics();
    }

    /** Whether only those of them are, whose factor by limit equilibrium is
     * below the critical one. */
    bool
    wants_critical_only() const
    {
      return blocks == "critical";
    }

    /** Whether the factor of the block called @p id (from 1) is asked for, as
     * far as its number tells. */
    bool wants_block(const unsigned int id) const;

    bool wants_stage(const std::string &name) const;

    void declare(ParameterHandler &prm);
  };

  /** Which faces the block theory report looks at. */
  struct BlockTheorySettings
  {
    bool report = false;

    /** Azimuths that walls face, seen from the rock [deg]; in 2D 90 (+x) and
     * 270 (-x) only. */
    std::vector<double> walls = {0., 90., 180., 270.};

    /** Free width of a flat roof [m], 0: no largest wedges. */
    double roof_span = 0.;
    /** Azimuth of the axis across which it is measured [deg]. */
    double roof_axis = 0.;

    void declare(ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_stage_h
#define keyblock_scene_stage_h

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

  /** How contact is solved; none: joints are ignored. */
  enum class ContactMethod
  {
    exact,
    published,
    none
  };
  template <>
  struct ChoiceNames<ContactMethod>
  {
    static constexpr std::array<const char *, 3> names = {
      {"exact", "published", "none"}};
  };

  /** Geometry of the strains: the reference one or the current one. */
  enum class Kinematics
  {
    small,
    large
  };
  template <>
  struct ChoiceNames<Kinematics>
  {
    static constexpr std::array<const char *, 2> names = {{"small", "large"}};
  };

  /** How a stage goes to its end. */
  enum class StageKind
  {
    dynamic,
    quasi_static,
    static_solve
  };
  template <>
  struct ChoiceNames<StageKind>
  {
    static constexpr std::array<const char *, 3> names = {
      {"dynamic", "quasi-static", "static"}};
  };

  /** Which parts of Rayleigh damping act. */
  enum class RayleighTerms
  {
    both,
    mass,
    stiffness
  };
  template <>
  struct ChoiceNames<RayleighTerms>
  {
    static constexpr std::array<const char *, 3> names = {
      {"both", "mass", "stiffness"}};
  };

  /** How contact is found and solved. */
  struct ContactSettings
  {
    ContactMethod method            = ContactMethod::exact;
    double default_friction_angle   = 30.;
    double tolerance                = 1e-8;
    unsigned int maximum_iterations = 2000;
    double slip_tolerance           = 1e-6;
    bool weld_infinite_blocks       = true;
    bool tie_all                    = false;

    bool
    is_published_variant() const
    {
      return method == ContactMethod::published;
    }

    void declare(ParameterHandler &prm);
  };

  /** The explicit step. */
  struct TimeStepping
  {
    Kinematics kinematics     = Kinematics::small;
    double safety             = 0.9;
    double maximum_step       = 0.;
    double least_step         = 0.;
    double largest_added_mass = 0.01;
    bool ledger               = true;
    bool skips_resting        = true;
    double rest_speed         = 1e-12;

    bool
    is_large() const
    {
      return kinematics == Kinematics::large;
    }

    void declare(ParameterHandler &prm);
  };

  /** A stretch of time with its own damping, or a way to a new equilibrium;
   * excavations that name it are excavated at its start. */
  struct Stage
  {
    std::string name;
    StageKind kind               = StageKind::dynamic;
    double duration              = 0.;
    unsigned int maximum_steps   = 0;
    double unbalanced_ratio      = 0.;
    double damping_ratio         = 0.;
    double mass_damping          = 0.;
    double rayleigh_ratio        = 0.;
    double rayleigh_frequency    = 0.;
    RayleighTerms rayleigh_terms = RayleighTerms::both;
    double local_damping         = 0.;
    bool damps_contact_force     = true;
    bool scales_density          = true;
    double ramp_duration         = 0.;
    std::string water_level;                 ///< from it on; empty: as before
    std::vector<std::string> drained_joints; ///< from it on
    std::vector<double> seismic_coefficient; ///< the same
    double ramp_unbalance          = 2e-3;
    double friction_angle_override = -1.;
    bool reset_motion              = false;

    bool
    is_dynamic() const
    {
      return kind == StageKind::dynamic;
    }
    bool
    is_quasi_static() const
    {
      return kind == StageKind::quasi_static;
    }
    bool
    is_static() const
    {
      return kind == StageKind::static_solve;
    }

    /** Rayleigh's stiffness-proportional damping, over the stiffness [s]. */
    double rayleigh_stiffness() const;

    /** Whether forces are proportional to rates of strain. */
    bool
    has_stiffness_damping() const
    {
      return damping_ratio > 0. || rayleigh_stiffness() > 0.;
    }

    /** Give the entries of a quasi-static stage that were left at zero the
     * values of its driver, and add Rayleigh's mass damping to that. */
    void complete();

    void declare(ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

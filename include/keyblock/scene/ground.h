// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_ground_h
#define keyblock_scene_ground_h

#include <keyblock/base/choice.h>

#include <cmath>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  using dealii::ParameterHandler;

  /** Constitutive model of a material. */
  enum class MaterialModel
  {
    elastic,
    mohr_coulomb,
    rigid
  };
  template <>
  struct ChoiceNames<MaterialModel>
  {
    static constexpr std::array<const char *, 3> names = {
      {"elastic", "mohr_coulomb", "rigid"}};
  };

  /** CellIntegration of the volume change of cells. */
  enum class CellIntegration
  {
    automatic,
    full,
    mean_dilatation
  };
  template <>
  struct ChoiceNames<CellIntegration>
  {
    static constexpr std::array<const char *, 3> names = {
      {"automatic", "full", "mean dilatation"}};
  };

  /** Whether the initial stress is brought into equilibrium. */
  enum class InitialEquilibrium
  {
    none,
    static_solve
  };
  template <>
  struct ChoiceNames<InitialEquilibrium>
  {
    static constexpr std::array<const char *, 2> names = {{"none", "static"}};
  };

  /** Ground whose state follows from its depth: what entries leave open of
   * gravity, initial stress, supports and overburden. */
  template <int dim>
  struct DepthGround
  {
    double depth   = -1.; ///< of elevation 0 below the surface [m]; < 0: none
    double density = 0.;  ///< 0: of most of the rock
    std::vector<double> k0 = {1.};
    double azimuth         = 90.;

    bool
    is_given() const
    {
      return depth >= 0.;
    }

    void declare(ParameterHandler &prm);
  };

  /** Rock, fault filling or a rigid body, and where it is. */
  template <int dim>
  struct Material
  {
    std::string name;
    std::string region         = "all";
    std::string stage          = ""; ///< from which on; empty: the start
    MaterialModel model        = MaterialModel::elastic;
    double young_modulus       = 15e9;
    double poisson_ratio       = 0.25;
    double density             = 2700.;
    std::string rigid_velocity = "";

    // strength of the model mohr_coulomb; -1 as the entries explain
    double cohesion                  = 0.;
    double friction_angle            = 30.;
    double dilation_angle            = 0.;
    double tensile_strength          = -1.;
    double residual_cohesion         = -1.;
    double residual_friction_angle   = -1.;
    double residual_tensile_strength = -1.;
    double softening_strain          = 0.;
    CellIntegration integration      = CellIntegration::automatic;

    bool
    is_rigid() const
    {
      return model == MaterialModel::rigid;
    }
    bool
    is_plastic() const
    {
      return model == MaterialModel::mohr_coulomb;
    }

    /** Whether the volume change is averaged over each cell (B-bar), so that
     * neither plastic flow nor a high Poisson ratio locks. */
    bool
    has_mean_dilatation() const
    {
      return integration == CellIntegration::mean_dilatation ||
             (integration == CellIntegration::automatic &&
              (is_plastic() || poisson_ratio > 0.4));
    }

    /** Tensile strength at which the cone of friction and cohesion ends [Pa];
     * infinite without friction. */
    double apex() const;

    double
    lame_lambda() const
    {
      return young_modulus * poisson_ratio /
             ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }
    double
    shear_modulus() const
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }

    /** Stress per strain along one axis, none across it [Pa]. */
    double
    p_wave_modulus() const
    {
      return lame_lambda() + 2. * shear_modulus();
    }

    /** Of plane waves [m/s]. */
    double
    p_wave_speed() const
    {
      return std::sqrt(p_wave_modulus() / density);
    }
    double
    s_wave_speed() const
    {
      return std::sqrt(shear_modulus() / density);
    }

    void declare(ParameterHandler &prm);
  };

  /** State at time zero, and gravity. */
  template <int dim>
  struct InitialState
  {
    std::string gravity;
    std::string stress;
    std::string velocity;

    // stress that grows with depth
    double surface_elevation           = 0.;
    double vertical_stress_gradient    = 0.;
    double surface_stress              = 0.;
    std::vector<double> lateral_ratios = {1.};
    double lateral_azimuth             = 90.;

    InitialEquilibrium equilibrium = InitialEquilibrium::none;

    // stress inverted from measurements
    std::string measured_points;
    std::vector<std::string> stress_fields;

    bool
    has_depth_stress() const
    {
      return vertical_stress_gradient > 0. || surface_stress != 0.;
    }

    void declare(ParameterHandler &prm);
  };

  /** A water level that stands for none. */
  constexpr const char *no_water = "none";

  /** Water table: pressure in joints without a Water pressure of their own. */
  struct WaterSettings
  {
    std::string level;          ///< its elevation, a formula [m]; empty: none
    double unit_weight = 9810.; ///< [N/m3]

    void declare(ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

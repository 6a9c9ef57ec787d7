// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_results_h
#define keyblock_scene_results_h

#include <deal.II/base/point.h>

#include <keyblock/base/choice.h>

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  using dealii::ParameterHandler;
  using dealii::Point;

  /** What a monitor looks at. */
  enum class MonitorKind
  {
    point,
    block,
    region,
    joint,
    support
  };
  template <>
  struct ChoiceNames<MonitorKind>
  {
    static constexpr std::array<const char *, 5> names = {
      {"point", "block", "region", "joint", "support"}};
  };

  /** Closed form, or other reference, that results are compared with. */
  enum class ClosedForm
  {
    none,
    resting,
    incline,
    bar_impact,
    oblique_impact,
    bond_break,
    newmark,
    gravity_column,
    kirsch,
    salencon,
    spherical_cavity,
    footing,
    value,
    toppling,
    rotation,
    joint_wave
  };
  template <>
  struct ChoiceNames<ClosedForm>
  {
    static constexpr std::array<const char *, 16> names = {{"none",
                                                            "resting",
                                                            "incline",
                                                            "bar_impact",
                                                            "oblique_impact",
                                                            "bond_break",
                                                            "newmark",
                                                            "gravity_column",
                                                            "kirsch",
                                                            "salencon",
                                                            "spherical_cavity",
                                                            "footing",
                                                            "value",
                                                            "toppling",
                                                            "rotation",
                                                            "joint_wave"}};
  };

  /** A quantity written to history.csv. */
  template <int dim>
  struct Monitor
  {
    std::string name;
    MonitorKind kind   = MonitorKind::point;
    std::string region = "1";
    std::string joint;
    std::string support;
    Point<dim> location;
    unsigned int block = 0; ///< its number in the block table; 0: by location

    void declare(ParameterHandler &prm);
  };

  /** The closed form that the scene is compared with. */
  struct CheckSettings
  {
    ClosedForm closed_form = ClosedForm::none;
    std::string joint      = "";
    double reference_time  = 0.;
    double window_start    = 0.;
    double length          = 0.;
    std::string quantity   = "";
    double reference       = 0.;

    /** Whether it is measured in the rock and not by monitors. */
    bool
    needs_rock() const
    {
      return closed_form == ClosedForm::gravity_column ||
             closed_form == ClosedForm::kirsch ||
             closed_form == ClosedForm::salencon ||
             closed_form == ClosedForm::footing ||
             closed_form == ClosedForm::spherical_cavity ||
             closed_form == ClosedForm::value;
    }

    void declare(ParameterHandler &prm);
  };

  /** What is written, and how often. */
  struct OutputSettings
  {
    std::string folder            = "";
    unsigned int history_interval = 1;
    unsigned int vtu_count        = 5;
    bool write_vtu                = true;
    double checkpoint_interval    = 600.;
    bool keeps_stages             = false; ///< states at their ends

    void declare(ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

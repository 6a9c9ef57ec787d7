// SPDX-License-Identifier: LGPL-2.1-or-later
// Contradictions between the entries of materials, stages, loads and safety
// factors.
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/scene/check_parts.h>
#include <keyblock/scene/polygon.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  void
  check_stage(const Stage &stage)
  {
    require(stage.duration > 0. || stage.maximum_steps > 0 || stage.is_static(),
            "The stage '" + stage.name + "' never ends; set 'Stages/" +
              stage.name +
              "/Kind' to quasi-static, with which it ends in "
              "balance, as for an excavation, or 'Duration' for shaking.");
    const std::string rayleigh = "Stages/" + stage.name + "/Rayleigh ";
    require(stage.rayleigh_ratio == 0. || stage.rayleigh_frequency > 0.,
            "The entry '" + rayleigh + "ratio' is " +
              text_of(stage.rayleigh_ratio) + ", but '" + rayleigh +
              "frequency' is 0; give the frequency at which it holds in Hz.");
    require(stage.rayleigh_ratio == 0. || stage.kind == StageKind::dynamic,
            "The entry '" + rayleigh + "ratio' is " +
              text_of(stage.rayleigh_ratio) + ", but the stage is " +
              name_of(stage.kind) +
              "; Rayleigh damping is for dynamic stages, leave it out.");
  }



  template <int dim>
  void
  check_material(const Material<dim> &material)
  {
    const std::string section = "Materials/" + material.name;
    if (!material.is_plastic())
      return;
    require(material.dilation_angle <= material.friction_angle,
            "The entry '" + section + "/Dilation angle' is " +
              text_of(material.dilation_angle) +
              " degrees, above the friction angle of " +
              text_of(material.friction_angle) +
              "; such rock would create energy, lower it.");
    require(material.cohesion > 0. || material.friction_angle > 0.,
            "The material '" + material.name +
              "' has neither cohesion nor friction; set '" + section +
              "/Cohesion' or 'Friction angle'.");
  }



  template <int dim>
  void
  check_stages_of_excavations(const Scene<dim> &scene)
  {
    for (const auto &excavation : scene.excavations)
      require(scene.stage_number(excavation->stage) < scene.stages.size() + 2,
              "The entry 'Excavations/" + excavation->name + "/Stage' is '" +
                excavation->stage +
                "', which is not in 'Stages/Names'; name a stage there, or "
                "start.");
    for (const auto &traction : scene.tractions)
      require(scene.stage_number(traction->stage) < scene.stages.size() + 2,
              "The entry 'Tractions/" + traction->name + "/Stage' is '" +
                traction->stage +
                "', which is not in 'Stages/Names'; name a stage there, or "
                "start.");
    for (const auto &material : scene.materials)
      {
        if (material->stage.empty())
          continue;
        require(material->stage != "start" &&
                  scene.stage_number(material->stage) < scene.stages.size() + 2,
                "The entry 'Materials/" + material->name + "/Stage' is '" +
                  material->stage +
                  "', which is not in 'Stages/Names'; name a stage there, "
                  "or leave it empty for the start.");
        require(!material->is_rigid(),
                "The material '" + material->name +
                  "' is rigid and takes its region in a later stage ("
                  "'Materials/" +
                  material->name +
                  "/Stage'), which only deformable materials can; change "
                  "its 'Model'.");
      }
    for (const auto &excavation : scene.excavations)
      {
        if (excavation->backfill_stage.empty())
          continue;
        const unsigned int number =
          scene.stage_number(excavation->backfill_stage);
        require(
          number < scene.stages.size() + 2 &&
            number > scene.stage_number(excavation->stage),
          "The entry 'Excavations/" + excavation->name +
            "/Backfill stage' is '" + excavation->backfill_stage +
            "', which is not a stage after the one that excavates it; name "
            "a later one of 'Stages/Names'.");
        require(
          excavation->stage != "start",
          "The excavation '" + excavation->name +
            "' is filled, but excavated before the first stage, so that its "
            "cells are not kept; set 'Excavations/" +
            excavation->name + "/Stage' to the name of a stage.");
        require(scene.material_index(excavation->backfill_material) <
                  scene.materials.size(),
                "The entry 'Excavations/" + excavation->name +
                  "/Backfill material' is '" + excavation->backfill_material +
                  "', which is not in 'Materials/Names'.");
      }
    for (const auto &stage : scene.stages)
      require(stage->name != "start",
              "A stage is called 'start' in 'Stages/Names', which stands for "
              "the time before all stages; give it another name.");
  }



  void
  check_time_stepping(const TimeStepping &stepping)
  {
    require(stepping.maximum_step == 0. ||
              stepping.least_step <= stepping.maximum_step,
            "The entry 'Time stepping/Least step' is " +
              text_of(stepping.least_step) +
              " s, above 'Time stepping/Maximum step'; mass would be moved "
              "for nothing: lower one or raise the other.");
  }



  template <int dim>
  void
  check_initial_state(const Scene<dim> &scene)
  {
    const InitialState<dim> &state = scene.initial_state;
    require(state.stress.empty() || !state.has_depth_stress(),
            "The initial stress is given twice, by 'Initial state/Stress' and "
            "by depth; remove one.");
    require(state.measured_points.empty() ||
              (state.stress.empty() && !state.has_depth_stress()),
            "The initial stress is given twice, by 'Initial state/Measured "
            "points' and by 'Stress' or depth; remove one.");
    require(state.measured_points.empty() == state.stress_fields.empty(),
            "The entries 'Initial state/Measured points' and 'Stress fields' "
            "belong together; give both or none.");
    const std::vector<std::string> known =
      dim == 2
        ? std::vector<std::string>{"gravity", "push x", "graded x"}
        : std::vector<std::string>{
            "gravity", "push x", "push y", "graded x", "graded y", "shear xy"};
    for (const std::string &field : state.stress_fields)
      require(std::find(known.begin(), known.end(), field) != known.end(),
              "The entry 'Initial state/Stress fields' names '" + field +
                "'; in " + std::to_string(dim) +
                "D there are gravity, push x, graded x" +
                (dim == 3 ? ", push y, graded y, shear xy." : "."));
    require(!state.gravity.empty() || std::count(state.stress_fields.begin(),
                                                 state.stress_fields.end(),
                                                 "gravity") == 0,
            "The entry 'Initial state/Stress fields' names 'gravity', but "
            "'Initial state/Gravity' is empty; give it, or leave the field "
            "out.");
    require(state.lateral_ratios.size() == 1 ||
              state.lateral_ratios.size() == 2,
            "The entry 'Initial state/Lateral ratios' has " +
              std::to_string(state.lateral_ratios.size()) +
              " numbers; give one or two.");
    require(state.equilibrium == InitialEquilibrium::none ||
              !scene.time_stepping.is_large(),
            "The entry 'Initial state/Equilibrium' is static, which needs "
            "'Time stepping/Kinematics' = small.");
    for (const auto &stage : scene.stages)
      require(!stage->is_static() || !scene.time_stepping.is_large() ||
                scene.safety.is_by_statics(),
              "The entry 'Stages/" + stage->name +
                "/Kind' is static, which needs 'Time stepping/Kinematics' = "
                "small.");
  }



  template <int dim>
  void
  check_expressions(const Scene<dim> &scene)
  {
    const unsigned int n_stress = dim == 2 ? 4 : 6;
    check_expression<dim>(scene.initial_state.gravity,
                          dim,
                          "Initial state/Gravity");
    check_expression<dim>(scene.initial_state.stress,
                          n_stress,
                          "Initial state/Stress");
    check_expression<dim>(scene.initial_state.velocity,
                          dim,
                          "Initial state/Velocity");
    for (const auto &material : scene.materials)
      {
        const std::string section = "Materials/" + material->name;
        if (material->region != "all" &&
            material->region.rfind("id ", 0) != 0 &&
            material->region.rfind("band ", 0) != 0)
          check_expression<dim>(material->region, 1, section + "/Region");
        check_expression<dim>(material->rigid_velocity,
                              dim,
                              section + "/Rigid velocity");
      }
    for (const auto &monitor : scene.monitors)
      check_expression<dim>(monitor->region,
                            1,
                            "Monitors/" + monitor->name + "/Region");
    for (const auto &traction : scene.tractions)
      {
        const std::string section = "Tractions/" + traction->name;
        check_expression<dim>(traction->region, 1, section + "/Region");
        require(!traction->expression.empty(),
                "The entry '" + section +
                  "/Traction' is empty; give a formula per axis.");
        check_expression<dim>(traction->expression, dim, section + "/Traction");
        require(traction->boundaries.empty() != traction->region.empty(),
                "The traction '" + traction->name +
                  "' needs exactly one of 'Boundaries' and 'Region'.");
      }
  }



  /** Whether there is a joint or a set of that name. */
  template <int dim>
  bool
  has_joint(const Scene<dim> &scene, const std::string &name)
  {
    return !scene.joints_called(name).empty() ||
           std::any_of(scene.joint_sets.begin(),
                       scene.joint_sets.end(),
                       [&](const auto &set) { return set->name == name; });
  }



  template <int dim>
  void
  check_safety(const Scene<dim> &scene)
  {
    const SafetySettings &safety = scene.safety;
    if (safety.blocks != "none" && safety.blocks != "all" &&
        !safety.wants_exposed_only())
      for (const std::string &word :
           dealii::Utilities::split_string_list(safety.blocks))
        require(!word.empty() &&
                  word.find_first_not_of("0123456789") == std::string::npos &&
                  word.find_first_not_of('0') != std::string::npos,
                "The entry 'Safety factor/Blocks' contains '" + word +
                  "'; give none, all, exposed, critical, or numbers of the "
                  "block table.");
    for (const std::string &name : safety.stages)
      require(scene.stage_number(name) < scene.stages.size() + 2,
              "The entry 'Safety factor/Stages' names '" + name +
                "', which is not in 'Stages/Names'.");
    for (const std::string &name : safety.joints)
      {
        require(has_joint(scene, name),
                "The entry 'Safety factor/Joints' names '" + name +
                  "', which is not in 'Joints/Names', nor another joint or a "
                  "set.");
        require(std::count(safety.joints.begin(), safety.joints.end(), name) ==
                  1,
                "The entry 'Safety factor/Joints' names '" + name +
                  "' twice; name each joint once.");
      }
    require(!safety.is_wanted() || scene.contact.method != ContactMethod::none,
            "The entry 'Safety factor/" +
              std::string(safety.is_by_statics() ? "Method" : "Blocks") +
              "' needs contact; set 'Contact/Method' to exact.");
    require(!safety.is_by_statics() ||
              scene.checks.closed_form == ClosedForm::none,
            "The entry 'Safety factor/Method' is limit equilibrium, with which "
            "no step is made, but 'Check/Closed form' is " +
              name_of(scene.checks.closed_form) +
              ", which is measured on steps; set it to none.");
    if (safety.wanted_by == DemandSearch::strength_reduction)
      {
        require(safety.wanted > 0.,
                "The entry 'Safety factor/Wanted by' is strength reduction, "
                "but 'Wanted' is 0, so that no support is looked for; set "
                "'Safety factor/Wanted' to the factor that blocks shall have.");
        require(!safety.is_by_statics(),
                "The entry 'Safety factor/Wanted by' is strength reduction, "
                "but 'Method' is limit equilibrium, with which no trial is "
                "made; set 'Safety factor/Method' to bisection, or 'Wanted "
                "by' to limit equilibrium.");
      }
    require(safety.lowest < 1. && safety.highest > 1.,
            "The entries 'Safety factor/Lowest' and 'Highest' must have 1 "
            "between them.");
    require(safety.seismic_coefficient.empty() ||
              safety.seismic_coefficient.size() == dim,
            "The entry 'Safety factor/Seismic coefficient' has " +
              std::to_string(safety.seismic_coefficient.size()) +
              " values where " + std::to_string(dim) + " are needed.");
    if (scene.water.level != no_water)
      check_expression<dim>(scene.water.level, 1, "Water/Level");
    for (const auto &stage : scene.stages)
      require(stage->seismic_coefficient.empty() ||
                stage->seismic_coefficient.size() == dim,
              "The entry 'Stages/" + stage->name +
                "/Seismic coefficient' has " +
                std::to_string(stage->seismic_coefficient.size()) +
                " values where " + std::to_string(dim) + " are needed.");
    for (const auto &stage : scene.stages)
      if (stage->water_level != no_water)
        check_expression<dim>(stage->water_level,
                              1,
                              "Stages/" + stage->name + "/Water level");
    for (const auto &joint : scene.joints)
      {
        const std::string section = "Joints/" + joint->name;
        check_expression<dim>(joint->water_pressure,
                              1,
                              section + "/Water pressure");
        if (joint->water_level != no_water)
          check_expression<dim>(joint->water_level,
                                1,
                                section + "/Water level");
        require(joint->water_pressure.empty() || joint->water_level.empty(),
                "The joint '" + joint->name +
                  "' has both 'Water pressure' and 'Water level'; keep one.");
      }
    for (const auto &stage : scene.stages)
      for (const std::string &name : stage->drained_joints)
        require(has_joint(scene, name),
                "The entry 'Stages/" + stage->name +
                  "/Drained joints' names '" + name +
                  "', which is no joint or set of joints; correct the name.");
  }

  template void check_material(const Material<2> &);
  template void check_material(const Material<3> &);
  template void check_stages_of_excavations(const Scene<2> &);
  template void check_stages_of_excavations(const Scene<3> &);
  template void check_initial_state(const Scene<2> &);
  template void check_initial_state(const Scene<3> &);
  template void check_expressions(const Scene<2> &);
  template void check_expressions(const Scene<3> &);
  template bool has_joint(const Scene<2> &, const std::string &);
  template bool has_joint(const Scene<3> &, const std::string &);
  template void check_safety(const Scene<2> &);
  template void check_safety(const Scene<3> &);
} // namespace Keyblock

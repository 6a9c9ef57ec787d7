// SPDX-License-Identifier: LGPL-2.1-or-later
// Contradictions between the entries of a scene, found before anything else.
#include <keyblock/base/errors.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/scene/boundary_names.h>
#include <keyblock/scene/check_parts.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    check_monitors(const Scene<dim> &scene)
    {
      for (const auto &monitor : scene.monitors)
        require(monitor->kind != MonitorKind::joint ||
                  monitor->joint == "all" || has_joint(scene, monitor->joint),
                "The monitor '" + monitor->name + "' names the joint '" +
                  monitor->joint +
                  "', which is not in 'Joints/Names', nor another joint or a "
                  "set; correct 'Monitors/" +
                  monitor->name + "/Joint'.");
      for (const auto &monitor : scene.monitors)
        require(monitor->kind != MonitorKind::support ||
                  std::any_of(scene.supports.begin(),
                              scene.supports.end(),
                              [&](const auto &support) {
                                return support->name == monitor->support;
                              }),
                "The monitor '" + monitor->name + "' names the support '" +
                  monitor->support +
                  "', which is not in 'Supports/Names'; correct 'Monitors/" +
                  monitor->name + "/Support'.");
    }

    /** The closed form of a wave across a joint needs a wave that comes in, a
     * joint, and a place on each side of it. */
    template <int dim>
    void
    check_joint_wave(const Scene<dim> &scene)
    {
      const auto n_waves = std::count_if(scene.supports.begin(),
                                         scene.supports.end(),
                                         [](const auto &support) {
                                           return support->is_quiet() &&
                                                  !support->velocity.empty();
                                         });
      const auto n_points =
        std::count_if(scene.monitors.begin(),
                      scene.monitors.end(),
                      [](const auto &monitor) {
                        return monitor->kind == MonitorKind::point;
                      });
      require(n_waves > 0 && n_points == 2 && !scene.checks.joint.empty(),
              "The entry 'Check/Closed form' is joint_wave, which needs a "
              "quiet support with a 'Velocity', a joint in 'Check/Joint' and "
              "two monitors of kind point, before and behind it; found are "
              "supports: " +
                std::to_string(n_waves) + ", joint: '" + scene.checks.joint +
                "', monitors: " + std::to_string(n_points) +
                "; correct 'Supports', 'Check/Joint' or 'Monitors'.");
    }

    /** A closed form needs monitors and entries of its own. */
    template <int dim>
    void
    check_closed_form(const Scene<dim> &scene)
    {
      const auto has_monitor = [&](const MonitorKind kind) {
        for (const auto &monitor : scene.monitors)
          if (monitor->kind == kind)
            return true;
        return false;
      };
      const ClosedForm form = scene.checks.closed_form;
      const bool is_on_body = form != ClosedForm::none &&
                              form != ClosedForm::joint_wave &&
                              !scene.checks.needs_rock();
      require(!is_on_body || has_monitor(MonitorKind::block),
              "The entry 'Check/Closed form' is " + name_of(form) +
                ", which needs a monitor of kind block; add one to "
                "'Monitors/Names'.");
      require(form != ClosedForm::oblique_impact ||
                has_monitor(MonitorKind::region),
              "The entry 'Check/Closed form' is oblique_impact, which needs a "
              "monitor of kind region over the middle of the slab; add one to "
              "'Monitors/Names'.");
      require(
        form != ClosedForm::footing ||
          (has_monitor(MonitorKind::support) && scene.checks.length > 0.),
        "The entry 'Check/Closed form' is footing, which needs a monitor of "
        "kind support and the loaded width in 'Check/Length'.");
      require(form != ClosedForm::gravity_column ||
                !scene.initial_state.gravity.empty(),
              "The entry 'Check/Closed form' is gravity_column, which needs "
              "'Initial state/Gravity'; set it.");
      require((form != ClosedForm::kirsch && form != ClosedForm::salencon) ||
                (scene.excavations.size() == 1 &&
                 scene.excavations[0]->shape == ExcavationShape::circle),
              "The entry 'Check/Closed form' is " + name_of(form) +
                ", which needs one excavation of shape circle.");
      require(
        form != ClosedForm::spherical_cavity ||
          (dim == 3 && scene.excavations.size() == 1 &&
           scene.checks.length > 0.),
        "The entry 'Check/Closed form' is spherical_cavity, which needs "
        "'Dimension' 3, one excavation, and the radius of the cavity about "
        "the origin in 'Check/Length'.");
      require(!is_on_body || form == ClosedForm::rotation ||
                has_monitor(MonitorKind::joint),
              "The entry 'Check/Closed form' is " + name_of(form) +
                ", which needs a monitor of kind joint; add one to "
                "'Monitors/Names'.");
      require(!is_on_body || form == ClosedForm::rotation ||
                form == ClosedForm::bar_impact ||
                form == ClosedForm::oblique_impact ||
                !scene.checks.joint.empty(),
              "The entry 'Check/Joint' is empty, but the closed form " +
                name_of(form) + " is measured on a joint; name it.");
      require((form != ClosedForm::bar_impact &&
               form != ClosedForm::bond_break) ||
                scene.checks.length > 0.,
              "The entry 'Check/Length' is 0, but the closed form " +
                name_of(form) + " needs the length of the bar in metres.");
      require(
        form != ClosedForm::newmark ||
          std::any_of(scene.materials.begin(),
                      scene.materials.end(),
                      [](const auto &m) {
                        return m->is_rigid() && !m->rigid_velocity.empty();
                      }),
        "The entry 'Check/Closed form' is newmark, which needs a material "
        "that moves by 'Rigid velocity'; set that of the base.");
      require((form != ClosedForm::bar_impact &&
               form != ClosedForm::oblique_impact) ||
                !scene.initial_state.velocity.empty(),
              "The entry 'Check/Closed form' is " + name_of(form) +
                ", which needs the body's 'Initial state/Velocity'; set it.");
      require(
        form != ClosedForm::bond_break ||
          (!scene.supports.empty() &&
           !scene.supports.front()->velocity.empty()),
        "The entry 'Check/Closed form' is bond_break, which needs a first "
        "support that pulls; set its 'Velocity'.");
      if (form == ClosedForm::joint_wave)
        check_joint_wave(scene);
      require(form == ClosedForm::none || !scene.stages.empty(),
              "The entry 'Check/Closed form' is " + name_of(form) +
                ", but 'Stages/Names' is empty; name a stage to measure.");
      const auto n_checked = scene.joints_called(scene.checks.joint).size();
      require(
        scene.checks.joint.empty() || n_checked > 0,
        "The entry 'Check/Joint' is '" + scene.checks.joint +
          "', which is not in 'Joints/Names', nor another joint or a set.");
      require(scene.checks.joint.empty() || n_checked == 1,
              "The entry 'Check/Joint' is '" + scene.checks.joint +
                "', a set of " + std::to_string(n_checked) +
                " joints, but closed forms are of a single one; name it.");
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::cross_check() const
  {
    check_safety(*this);
    check_domain(*this);
    check_meshing(*this);
    for (const auto &excavation : excavations)
      {
        check_excavation(*excavation);
        require(excavation->shape != ExcavationShape::formula ||
                  meshing.generator != MeshGenerator::gmsh,
                "The entry 'Excavations/" + excavation->name +
                  "/Shape' is formula, which Gmsh cannot follow; use another "
                  "shape or another 'Mesh/Generator'.");
      }
    for (const auto &joint : joints)
      check_joint(*joint);
    check_joints_inside(*this);
    require(
      !materials.empty(),
      "The entry 'Materials/Names' is empty; name at least one material.");
    for (const auto &material : materials)
      check_material(*material);
    for (const auto &stage : stages)
      check_stage(*stage);
    check_stages_of_excavations(*this);
    check_bolts(*this);
    check_liners(*this);
    check_time_stepping(time_stepping);
    check_initial_state(*this);
    check_expressions(*this);
    check_boundary_names(*this);
    check_supports(*this);
    check_monitors(*this);
    check_closed_form(*this);
    for (const auto &joint : joints)
      require(!contact.is_published_variant() ||
                !JointStiffness(*joint).is_compliant(),
              "The joint '" + joint->name +
                "' has a stiffness, but 'Contact/Method' is published, which "
                "knows rigid joints only; choose another method or remove "
                "'Normal stiffness' and 'Shear stiffness'.");
  }

  template void Scene<2>::cross_check() const;
  template void Scene<3>::cross_check() const;
} // namespace Keyblock

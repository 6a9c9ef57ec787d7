// SPDX-License-Identifier: LGPL-2.1-or-later
// Contradictions between the entries of a scene, found before anything else.
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/polygon.h>
#include <keyblock/scene/scene.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

namespace Keyblock
{
  namespace
  {

    void
    require_simple(const std::vector<Point<2>> &corners,
                   const std::string &entry)
    {
      const std::string fault = fault_of_polygon(corners);
      require(fault.empty(),
              "The polygon '" + entry + "' " + fault +
                "; give its corners in the order in which they follow each "
                "other along its outline.");
    }

    template <int dim>
    void
    check_expression(const std::string &text,
                     const unsigned int n_components,
                     const std::string &entry)
    {
      if (!text.empty())
        Expression<dim>(text, n_components, entry);
    }

  } // namespace



  template <int dim>
  void
  check_domain(const Scene<dim> &scene)
  {
    const Domain<dim> &domain   = scene.domain;
    const Meshing<dim> &meshing = scene.meshing;
    if (domain.shape == DomainShape::box)
      {
        require(domain.size.size() == dim,
                "The entry 'Domain/Size' has " +
                  std::to_string(domain.size.size()) +
                  " numbers where the box needs " + std::to_string(dim) +
                  "; give one length per axis.");
        for (const double length : domain.size)
          require(length > 0.,
                  "The entry 'Domain/Size' contains " + text_of(length) +
                    "; lengths must be positive.");
      }
    if (domain.shape == DomainShape::parallelepiped)
      {
        require(domain.edges.size() == dim,
                "The entry 'Domain/Edges' has " +
                  std::to_string(domain.edges.size()) +
                  " vectors where the parallelepiped needs " +
                  std::to_string(dim) + "; separate vectors by ';'.");
        Tensor<2, dim> frame;
        for (unsigned int d = 0; d < dim; ++d)
          frame[d] = domain.edges[d];
        require(determinant(frame) > 0.,
                "The vectors of 'Domain/Edges' span a volume of " +
                  text_of(determinant(frame)) +
                  "; order them right-handed and not in one plane.");
      }
    if (domain.shape == DomainShape::polygon)
      {
        require(dim == 2 && domain.polygon.size() >= 3,
                "The entry 'Domain/Shape' is polygon, which needs Dimension "
                "2 and at least three corners in 'Domain/Polygon'; found " +
                  std::to_string(domain.polygon.size()) + ".");
        require(meshing.generator == MeshGenerator::gmsh,
                "The entry 'Mesh/Generator' is " + name_of(meshing.generator) +
                  ", which cannot mesh a polygon; set it to gmsh.");
        if constexpr (dim == 2)
          require_simple(domain.polygon, "Domain/Polygon");
      }
    require((domain.shape == DomainShape::file) ==
              (meshing.generator == MeshGenerator::file),
            "The entries 'Domain/Shape' (" + name_of(domain.shape) +
              ") and 'Mesh/Generator' (" + name_of(meshing.generator) +
              ") contradict each other; set both to file or neither.");
    if (domain.shape == DomainShape::file)
      {
        require(!domain.file.empty(),
                "The entry 'Domain/File' is empty; name the mesh file.");
        const auto beside =
          std::filesystem::path(scene.file).parent_path() / domain.file;
        require(std::filesystem::exists(beside) ||
                  std::filesystem::exists(domain.file),
                "The mesh file '" + domain.file +
                  "' of the entry 'Domain/File' does not exist; give a path "
                  "relative to the scene file.");
      }
  }

  template void check_domain(const Scene<2> &);
  template void check_domain(const Scene<3> &);



  namespace
  {
    template <int dim>
    void
    check_meshing(const Scene<dim> &scene)
    {
      const Meshing<dim> &meshing = scene.meshing;
      const auto check_distances  = [](const std::vector<double> &distances,
                                      const std::string &entry) {
        for (unsigned int i = 0; i < distances.size(); ++i)
          require(distances[i] > 0. &&
                    (i == 0 || distances[i] <= distances[i - 1]),
                  "The entry 'Mesh/" + entry +
                    "' is not a list of decreasing distances (number " +
                    std::to_string(i + 1) + " is " +
                    std::to_string(distances[i]) +
                    "); begin with the distance of the first halving.");
      };
      check_distances(meshing.refine_at_excavations, "Refine at excavations");
      check_distances(meshing.refine_at_joints, "Refine at joints");
      require(meshing.refine_at_excavations.empty() ||
                std::any_of(scene.excavations.begin(),
                            scene.excavations.end(),
                            [](const auto &e) {
                              return e->shape != ExcavationShape::formula;
                            }),
              "The entry 'Mesh/Refine at excavations' needs an excavation with "
              "an outline; use 'Mesh/Refinement levels'.");
      require(meshing.refine_at_joints.empty() || !scene.joints.empty(),
              "The entry 'Mesh/Refine at joints' needs 'Joints/Names'.");
      if (meshing.generator != MeshGenerator::structured)
        return;
      require(meshing.cells.size() == dim,
              "The entry 'Mesh/Cells' has " +
                std::to_string(meshing.cells.size()) +
                " numbers where a structured mesh needs " +
                std::to_string(dim) + "; give one count per edge.");
      for (const unsigned int n : meshing.cells)
        require(n > 0,
                "The entry 'Mesh/Cells' contains 0; give positive counts.");
      require(meshing.gradings.empty() || meshing.gradings.size() == dim,
              "The entry 'Mesh/Gradings' has " +
                std::to_string(meshing.gradings.size()) + " values where " +
                std::to_string(dim) +
                " are needed; give uniform or a ratio per edge.");
    }

    template <int dim>
    void
    check_excavation(const Excavation<dim> &excavation)
    {
      const std::string section   = "Excavations/" + excavation.name;
      const ExcavationShape shape = excavation.shape;
      require(shape != ExcavationShape::extruded_polygon || dim == 3,
              "The entry '" + section +
                "/Shape' is extruded polygon, which needs Dimension 3; use "
                "polygon in 2D.");
      require((shape != ExcavationShape::polygon &&
               shape != ExcavationShape::circle) ||
                dim == 2,
              "The entry '" + section + "/Shape' is " + name_of(shape) +
                ", which needs Dimension 2; use box or extruded polygon.");
      if (shape == ExcavationShape::polygon ||
          shape == ExcavationShape::extruded_polygon)
        {
          require(excavation.vertices.size() >= 3,
                  "The entry '" + section + "/Vertices' has " +
                    std::to_string(excavation.vertices.size()) +
                    " corners; a polygon needs at least three.");
          require_simple(excavation.vertices, section + "/Vertices");
        }
      if (shape == ExcavationShape::extruded_polygon)
        require(excavation.from < excavation.to,
                "The entry '" + section + "/From' (" +
                  text_of(excavation.from) + ") is not below '" + section +
                  "/To' (" + text_of(excavation.to) + "); exchange them.");
      if (shape == ExcavationShape::formula)
        {
          require(!excavation.formula.empty(),
                  "The entry '" + section +
                    "/Formula' is empty; give a formula that is positive "
                    "inside.");
          check_expression<dim>(excavation.formula, 1, section + "/Formula");
        }
      if (shape == ExcavationShape::circle)
        require(excavation.radius > 0.,
                "The entry '" + section +
                  "/Radius' is 0; give a positive radius in metres.");
      if (shape == ExcavationShape::box)
        {
          require(excavation.size.size() == dim,
                  "The entry '" + section + "/Size' has " +
                    std::to_string(excavation.size.size()) + " numbers; give " +
                    std::to_string(dim) + ".");
          for (const double length : excavation.size)
            require(length > 0.,
                    "The entry '" + section + "/Size' contains " +
                      text_of(length) + "; lengths must be positive.");
        }
    }

    /** Corners of a polygon in space, by two axes of its plane. */
    template <int dim>
    std::vector<Point<2>>
    corners_in_plane(const Joint<dim> &joint)
    {
      const Tensor<1, dim> normal = joint.normal();
      unsigned int steepest       = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) > std::abs(normal[steepest]))
          steepest = d;
      std::vector<Point<2>> corners;
      for (const Point<dim> &vertex : joint.vertices)
        corners.emplace_back(vertex[steepest == 0 ? 1 : 0],
                             vertex[steepest == dim - 1 ? dim - 2 : dim - 1]);
      return corners;
    }

    template <int dim>
    void
    check_joint(const Joint<dim> &joint)
    {
      const std::string section = "Joints/" + joint.name;
      const std::string entry =
        (joint.origin.empty() ? "The" : joint.origin + ": the") + " entry '" +
        section;
      require(joint.normal_entry.empty() || joint.normal_entry.size() == dim,
              entry + "/Normal' has " +
                std::to_string(joint.normal_entry.size()) + " numbers; give " +
                std::to_string(dim) + " or none.");
      if (!joint.normal_entry.empty())
        {
          double largest = 0.;
          for (const double component : joint.normal_entry)
            largest = std::max(largest, std::abs(component));
          // the reciprocal of a smaller one may be infinite
          require(largest > std::numeric_limits<double>::min(),
                  entry + "/Normal' is the zero vector; give a direction.");
        }
      if (dim == 2 && joint.normal_entry.empty() &&
          joint.extent != JointShape::polygon)
        require(joint.dip_direction == 90. || joint.dip_direction == 270.,
                entry + "/Dip direction' is " + text_of(joint.dip_direction) +
                  "; in 2D it is 90 (descends to +x) or 270 (to -x).");
      if (joint.extent == JointShape::disc)
        require(joint.radius > 0.,
                entry +
                  "/Radius' is 0; give the radius of the disc in metres.");
      if (joint.extent == JointShape::polygon)
        {
          const bool is_enough =
            dim == 2 ? joint.vertices.size() == 2 : joint.vertices.size() >= 3;
          require(is_enough,
                  entry + "/Vertices' has " +
                    std::to_string(joint.vertices.size()) +
                    " corners; give two ends in 2D, at least three corners "
                    "in 3D.");
          const double size = joint.vertices[0].distance(joint.vertices[1]);
          require(size > 0.,
                  "The first two corners of '" + section +
                    "/Vertices' coincide; give distinct corners.");
          require(std::isfinite(joint.normal().norm()),
                  "The corners of '" + section +
                    "/Vertices' lie on one line, or are no finite numbers; "
                    "give corners of a polygon.");
          for (const Point<dim> &vertex : joint.vertices)
            require(std::abs(joint.distance(vertex)) < 1e-6 * size,
                    "A corner of '" + section + "/Vertices' is " +
                      text_of(joint.distance(vertex)) +
                      " m off the plane of the others; joints are plane.");
          if (dim == 3)
            require_simple(corners_in_plane(joint), section + "/Vertices");
        }
      const double tangent =
        std::tan(joint.friction_angle * dealii::numbers::PI / 180.);
      require(joint.tensile_strength * tangent <= joint.cohesion * (1. + 1e-9),
              entry + "/Tensile strength' is " +
                text_of(joint.tensile_strength) +
                " Pa, beyond the apex cohesion / tan(friction angle) = " +
                text_of(joint.cohesion / tangent) +
                " Pa; lower it or raise 'Cohesion'.");
      require(joint.kinetic_friction_angle <= joint.friction_angle,
              entry + "/Kinetic friction angle' is " +
                text_of(joint.kinetic_friction_angle) +
                " deg, above 'Friction angle' = " +
                text_of(joint.friction_angle) +
                " deg; sliding friction cannot exceed static friction.");
      require(joint.residual_cohesion <= joint.cohesion,
              entry + "/Residual cohesion' is " +
                text_of(joint.residual_cohesion) + " Pa, above 'Cohesion' = " +
                text_of(joint.cohesion) + " Pa; lower it.");
      make_joint_law(joint, section);
    }

    void
    check_stage(const Stage &stage)
    {
      require(stage.duration > 0. || stage.maximum_steps > 0 ||
                stage.is_static(),
              "The stage '" + stage.name + "' never ends; set 'Stages/" +
                stage.name + "/Duration' or 'Maximum steps'.");
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
                    scene.stage_number(material->stage) <
                      scene.stages.size() + 2,
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
      require(
        state.stress.empty() || !state.has_depth_stress(),
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
        dim == 2 ? std::vector<std::string>{"gravity", "push x", "graded x"}
                 : std::vector<std::string>{"gravity",
                                            "push x",
                                            "push y",
                                            "graded x",
                                            "graded y",
                                            "shear xy"};
      for (const std::string &field : state.stress_fields)
        require(std::find(known.begin(), known.end(), field) != known.end(),
                "The entry 'Initial state/Stress fields' names '" + field +
                  "'; in " + std::to_string(dim) +
                  "D there are gravity, push x, graded x" +
                  (dim == 3 ? ", push y, graded y, shear xy." : "."));
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
        require(!stage->is_static() || !scene.time_stepping.is_large(),
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
      for (const auto &support : scene.supports)
        {
          const std::string section = "Supports/" + support->name;
          check_expression<dim>(support->region, 1, section + "/Region");
          check_expression<dim>(support->velocity, dim, section + "/Velocity");
          check_expression<dim>(support->displacement,
                                dim,
                                section + "/Displacement");
          require(support->velocity.empty() || support->displacement.empty(),
                  "The support '" + support->name +
                    "' has both 'Velocity' and 'Displacement'; keep one.");
          require(!support->is_far_field() || !support->boundaries.empty(),
                  "The support '" + support->name +
                    "' is a far field, which needs 'Boundaries'; name them.");
          require(support->boundaries.empty() != support->region.empty(),
                  "The support '" + support->name +
                    "' needs exactly one of 'Boundaries' and 'Region'.");
          require(support->directions != SupportDirections::normal ||
                    support->region.empty(),
                  "The support '" + support->name +
                    "' has 'Directions' normal, which needs 'Boundaries'; "
                    "name boundaries or axes.");
          require(dim == 3 || !support->names_axis(2),
                  "The entry '" + section + "/Directions' is " +
                    name_of(support->directions) +
                    ", but there is no z in 2D.");
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
          check_expression<dim>(traction->expression,
                                dim,
                                section + "/Traction");
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
      if (safety.blocks != "none" && safety.blocks != "all")
        for (const std::string &word :
             dealii::Utilities::split_string_list(safety.blocks))
          require(!word.empty() &&
                    word.find_first_not_of("0123456789") == std::string::npos &&
                    word.find_first_not_of('0') != std::string::npos,
                  "The entry 'Safety factor/Blocks' contains '" + word +
                    "'; give none, all, or numbers of the block table.");
      for (const std::string &name : safety.stages)
        require(scene.stage_number(name) < scene.stages.size() + 2,
                "The entry 'Safety factor/Stages' names '" + name +
                  "', which is not in 'Stages/Names'.");
      for (const std::string &name : safety.joints)
        require(has_joint(scene, name),
                "The entry 'Safety factor/Joints' names '" + name +
                  "', which is not in 'Joints/Names', nor another joint or a "
                  "set.");
      require(!safety.is_wanted() ||
                scene.contact.method != ContactMethod::none,
              "The entry 'Safety factor/Blocks' needs contact; set "
              "'Contact/Method' to exact.");
      require(safety.lowest < 1. && safety.highest > 1.,
              "The entries 'Safety factor/Lowest' and 'Highest' must have 1 "
              "between them.");
      require(safety.seismic_coefficient.empty() ||
                safety.seismic_coefficient.size() == dim,
              "The entry 'Safety factor/Seismic coefficient' has " +
                std::to_string(safety.seismic_coefficient.size()) +
                " values where " + std::to_string(dim) + " are needed.");
      for (const auto &joint : scene.joints)
        if (!joint->water_pressure.empty())
          check_expression<dim>(joint->water_pressure,
                                1,
                                "Joints/" + joint->name + "/Water pressure");
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
    require(
      !materials.empty(),
      "The entry 'Materials/Names' is empty; name at least one material.");
    for (const auto &material : materials)
      check_material(*material);
    for (const auto &stage : stages)
      check_stage(*stage);
    check_stages_of_excavations(*this);
    check_bolts(*this);
    check_time_stepping(time_stepping);
    check_initial_state(*this);
    check_expressions(*this);
    for (const auto &monitor : monitors)
      require(monitor->kind != MonitorKind::joint || monitor->joint == "all" ||
                has_joint(*this, monitor->joint),
              "The monitor '" + monitor->name + "' names the joint '" +
                monitor->joint +
                "', which is not in 'Joints/Names', nor another joint or a "
                "set; correct 'Monitors/" +
                monitor->name + "/Joint'.");
    for (const auto &monitor : monitors)
      require(monitor->kind != MonitorKind::support ||
                std::any_of(supports.begin(),
                            supports.end(),
                            [&](const auto &support) {
                              return support->name == monitor->support;
                            }),
              "The monitor '" + monitor->name + "' names the support '" +
                monitor->support +
                "', which is not in 'Supports/Names'; correct 'Monitors/" +
                monitor->name + "/Support'.");
    const auto has_monitor = [&](const MonitorKind kind) {
      for (const auto &monitor : monitors)
        if (monitor->kind == kind)
          return true;
      return false;
    };
    const ClosedForm form = checks.closed_form;
    const bool is_on_body = form != ClosedForm::none && !checks.needs_rock();
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
        (has_monitor(MonitorKind::support) && checks.length > 0.),
      "The entry 'Check/Closed form' is footing, which needs a monitor of "
      "kind support and the loaded width in 'Check/Length'.");
    require((form != ClosedForm::kirsch && form != ClosedForm::salencon) ||
              (excavations.size() == 1 &&
               excavations[0]->shape == ExcavationShape::circle),
            "The entry 'Check/Closed form' is " + name_of(form) +
              ", which needs one excavation of shape circle.");
    require(form != ClosedForm::spherical_cavity ||
              (dim == 3 && excavations.size() == 1 && checks.length > 0.),
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
              form == ClosedForm::oblique_impact || !checks.joint.empty(),
            "The entry 'Check/Joint' is empty, but the closed form " +
              name_of(form) + " is measured on a joint; name it.");
    require((form != ClosedForm::bar_impact &&
             form != ClosedForm::bond_break) ||
              checks.length > 0.,
            "The entry 'Check/Length' is 0, but the closed form " +
              name_of(form) + " needs the length of the bar in metres.");
    require(form != ClosedForm::newmark ||
              std::any_of(materials.begin(),
                          materials.end(),
                          [](const auto &m) {
                            return m->is_rigid() && !m->rigid_velocity.empty();
                          }),
            "The entry 'Check/Closed form' is newmark, which needs a material "
            "that moves by 'Rigid velocity'; set that of the base.");
    require((form != ClosedForm::bar_impact &&
             form != ClosedForm::oblique_impact) ||
              !initial_state.velocity.empty(),
            "The entry 'Check/Closed form' is " + name_of(form) +
              ", which needs the body's 'Initial state/Velocity'; set it.");
    require(form != ClosedForm::bond_break ||
              (!supports.empty() && !supports.front()->velocity.empty()),
            "The entry 'Check/Closed form' is bond_break, which needs a first "
            "support that pulls; set its 'Velocity'.");
    require(form == ClosedForm::none || !stages.empty(),
            "The entry 'Check/Closed form' is " + name_of(form) +
              ", but 'Stages/Names' is empty; name a stage to measure.");
    const auto n_checked = joints_called(checks.joint).size();
    require(checks.joint.empty() || n_checked > 0,
            "The entry 'Check/Joint' is '" + checks.joint +
              "', which is not in 'Joints/Names', nor another joint or a set.");
    require(checks.joint.empty() || n_checked == 1,
            "The entry 'Check/Joint' is '" + checks.joint + "', a set of " +
              std::to_string(n_checked) +
              " joints, but closed forms are of a single one; name it.");
  }

  template void Scene<2>::cross_check() const;
  template void Scene<3>::cross_check() const;
} // namespace Keyblock

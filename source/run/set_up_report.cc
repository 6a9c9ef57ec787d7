// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/bounding_box.h>

#include <keyblock/base/number_text.h>
#include <keyblock/blocks/mesh_fidelity.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/mesh/file_shapes.h>
#include <keyblock/mesh/place_digits.h>
#include <keyblock/mesh/report_warnings.h>
#include <keyblock/run/bare_top_warnings.h>
#include <keyblock/run/bolt_warnings.h>
#include <keyblock/run/circle_warnings.h>
#include <keyblock/run/free_field_warnings.h>
#include <keyblock/run/set_up_report.h>
#include <keyblock/run/wanted_blocks.h>
#include <keyblock/run/water_check.h>
#include <keyblock/run/wave_resolution.h>
#include <keyblock/safety/block_theory.h>
#include <keyblock/scene/given.h>
#include <keyblock/step/initial_tension.h>
#include <keyblock/step/roller_shear.h>
#include <keyblock/step/step_spread.h>

#include <algorithm>
#include <iomanip>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Least over median step of the cells that is not warned of [-]. */
    constexpr double least_step_ratio = 0.05;

    /** A warning if there are joints but no pair of them, or empty. */
    template <int dim>
    std::string
    warning_of_welded_joints(const Scene<dim> &scene,
                             const SplitMesh<dim> &split,
                             const MeshReport<dim> &report)
    {
      if (scene.joints.empty() || scene.contact.method == ContactMethod::none ||
          !split.interface.pairs.empty())
        return "";
      std::set<unsigned int> joints;
      for (const auto &of_cell : split.mesh.joint)
        for (const unsigned int j : of_cell)
          if (j != none)
            joints.insert(j);
      std::string names;
      unsigned int n = 0;
      for (const unsigned int j : joints)
        if (n++ < 8)
          names += (names.empty() ? "" : ", ") + scene.joints[j]->name;
      if (n == 0)
        return "";
      std::string reasons = "infinite or not closed";
      if (report.n_lost_blocks > 0 || !report.thin_rock.empty())
        reasons += ", too small for the cells";
      if (has_rigid_material(scene))
        reasons += ", or hold cells of a rigid material";
      return "All joints stay welded, with 0 pairs, because the blocks beside "
             "them are " +
             reasons + ": " + names + (n > 8 ? ", ..." : "") +
             "; let joints and outer boundaries enclose blocks, name fewer of "
             "them in "
             "'Domain/Truncated boundaries', or set 'Contact/Weld infinite "
             "blocks' to "
             "false.";
    }



    /** Names of the joints that touch the vertices of a cell, or empty. */
    template <int dim>
    std::string
    names_of_joints_at(const Mesh<dim> &mesh,
                       const unsigned int cell,
                       const Scene<dim> &scene)
    {
      std::set<unsigned int> joints;
      const auto touches = [&](const unsigned int vertex) {
        const auto &corners = mesh.cells[cell];
        return std::any_of(corners.begin(), corners.end(), [&](const auto v) {
          return mesh.vertices[v] == mesh.vertices[vertex];
        });
      };
      if (cell != none)
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (mesh.joint[c][f] != none && joints.count(mesh.joint[c][f]) == 0)
              {
                const auto vertices = mesh.face_vertices(c, f);
                if (std::any_of(vertices.begin(), vertices.end(), touches))
                  joints.insert(mesh.joint[c][f]);
              }
      std::string names;
      for (const unsigned int j : joints)
        names += (names.empty() ? "" : ", ") + scene.joints[j]->name;
      return names;
    }



    template <int dim>
    void
    print_stable_step(std::ostream &out,
                      const Model<dim> &model,
                      const RunReport &report)
    {
      out << "        stable time step " << model.stable_step()
          << " s, set by the cell at (" << report.stable_step_place << ")"
          << (report.stable_step_joints.empty()
                ? ""
                : " beside " + report.stable_step_joints)
          << "\n        least over median step of "
          << "the cells " << report.step_ratio << '\n';
    }



    /** That one cell sets the time step of dynamic stages, or empty. */
    template <int dim>
    std::string
    warning_of_small_step(const Model<dim> &model, const RunReport &report)
    {
      if (model.n_cells_global == 0 || report.step_ratio >= least_step_ratio ||
          !model.scene.has_dynamic_stage())
        return "";
      return "The least stable step of a cell is " +
             text_of(report.step_ratio, 3) +
             " times the median one, and sets the time step of dynamic stages; "
             "improve the mesh there" +
             (model.scene.time_stepping.least_step == 0.
                ? ", or set 'Time stepping/Least step'."
                : ".");
    }



    /** Those of the mesh, which rank 0 alone knows (collective). */
    template <int dim>
    std::vector<std::string>
    warnings_of_joints(const Model<dim> &model)
    {
      std::string lines;
      if (model.communicator.is_root())
        for (const std::string &sentence :
             warnings_of_mesh_report(model.mesh_report, model.scene))
          lines += sentence + '\n';
      std::istringstream all(model.communicator.text_of_root(lines));
      std::vector<std::string> found;
      for (std::string line; std::getline(all, line);)
        found.push_back(line);
      return found;
    }
  } // namespace



  namespace
  {
    /** What compliant joints leave out in this scene, or empty. */
    template <int dim>
    std::string
    warning_of_compliant_joints(const Scene<dim> &scene)
    {
      if (!are_any_compliant(scene.joints) || scene.safety.is_by_statics() ||
          std::none_of(scene.stages.begin(),
                       scene.stages.end(),
                       [](const auto &stage) { return stage->is_static(); }))
        return "";
      return "Joints have 'Normal stiffness' and 'Shear stiffness', but static "
             "stages tie all joints, so that what is dug in them does not "
             "move joints; choose 'Stages/NAME/Kind = quasi-static' to see "
             "their compliance.";
    }



    /** That joints which are shaken open with every slip, or empty. */
    template <int dim>
    std::string
    warning_of_dilation(const Scene<dim> &scene)
    {
      if (std::none_of(scene.supports.begin(),
                       scene.supports.end(),
                       [](const auto &support) {
                         return support->history || !support->velocity.empty();
                       }))
        return "";
      for (const auto &joint : scene.joints)
        {
          const auto &strength = *joint;
          if (strength.value_of("Dilation angle") > 0. &&
              strength.value_of("Dilation slip") <= 0.)
            return "The joint '" + joint->name +
                   "' is shaken and has a 'Dilation angle' without a 'Dilation "
                   "slip': it opens with every slip, also back where it came "
                   "from, and presses on what confines it without a limit; "
                   "give the slip after which it opens no further.";
        }
      return "";
    }



    /** That sliding on a joint gains more energy by opening it than friction
     * takes, or empty. */
    template <int dim>
    std::string
    warning_of_steep_dilation(const Scene<dim> &scene)
    {
      for (const auto &joint : scene.joints)
        {
          const double dilation = joint->value_of("Dilation angle"),
                       friction = joint->kinetic_friction_angle >= 0.
                                    ? joint->kinetic_friction_angle
                                    : joint->friction_angle;
          if (dilation > friction)
            return "The joint '" + joint->name +
                   "' has a 'Dilation angle' of " + text_of(dilation) +
                   " degrees, above its friction angle of " +
                   text_of(friction) +
                   ": sliding opens it at a gain of energy; lower the one or "
                   "raise the other.";
        }
      return "";
    }



    /** A warning if a mesh file looks as if its unit were not the metre, or
     * empty. */
    template <int dim>
    std::string
    warning_of_large_mesh(const Scene<dim> &scene, const Mesh<dim> &mesh)
    {
      constexpr double largest = 20e3; // [m]
      if (scene.domain.shape != DomainShape::file)
        return "";
      const dealii::BoundingBox<dim> box(mesh.vertices);
      double length = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        length = std::max(length, box.side_length(d));
      if (length <= largest)
        return "";
      return "The mesh '" + scene.domain.file +
             "' of the entry 'Domain/File' is " + text_of(length) +
             " m long: is it in mm or cm? Coordinates are in metres; scale "
             "them where the mesh is made.";
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_set_up(const Model<dim> &model,
                     const Monitors<dim> &monitors,
                     const RunReport &report)
  {
    std::vector<std::string> warnings = warnings_of_joints(model);
    warnings.insert(warnings.end(),
                    monitors.warnings.begin(),
                    monitors.warnings.end());
    for (const std::string &warning :
         {warning_of_small_step(model, report),
          warning_of_tension(
            model.communicator, model.scene, model.split, model.cells),
          warning_of_welded_joints(model.scene, model.split, model.mesh_report),
          warning_of_compliant_joints(model.scene),
          warning_of_large_mesh(model.scene, model.split.mesh),
          warning_of_dilation(model.scene),
          warning_of_steep_dilation(model.scene)})
      if (!warning.empty())
        warnings.push_back(warning);
    for (const std::vector<std::string> &more :
         {warnings_of_rollers(
            model.communicator, model.scene, model.split, model.cells),
          warnings_of_short_waves(model.scene, model.split),
          warnings_of_free_fields(model.scene, model.split),
          warnings_of_file_shapes(model.scene),
          warnings_of_circles(model.scene, model.split.mesh),
          warnings_of_coarse_bolts(model.scene, model.split),
          warnings_of_brittle_bolts(model.scene, model.split),
          warnings_of_cut_bolts(model.scene, model.split),
          warnings_of_idle_bolts(model.scene, model.split),
          warnings_of_heads_in_air(model.scene, model.split),
          warnings_of_low_water(model.scene, model.split),
          warnings_of_bare_top(model.scene, model.split.mesh, model.blocks),
          warnings_of_attached_blocks(model.scene, model.split, model.blocks),
          warnings_of_coarse_mesh(model.scene, model.split, model.blocks)})
      warnings.insert(warnings.end(), more.begin(), more.end());
    return warnings;
  }



  template <int dim>
  void
  report_stable_step(const Model<dim> &model, RunReport &report)
  {
    std::ostringstream place;
    place.precision(digits_of_place(model.split.mesh, 6));
    for (unsigned int d = 0; d < dim; ++d)
      place << (d ? ", " : "") << model.conditions->stable_step.place[d];
    report.stable_step_place = place.str();
    const StepSpread<dim> spread =
      measure_step_spread(model.communicator,
                          model.conditions->active_cells.frequency,
                          model.cells.mesh_cell,
                          model.split.mesh);
    report.step_ratio = spread.ratio();
    report.stable_step_joints =
      names_of_joints_at(model.split.mesh, spread.cell, model.scene);
  }



  namespace
  {
    /** What structural liners are taken for. */
    template <int dim>
    void
    print_liners(std::ostream &out, const Model<dim> &model)
    {
      for (unsigned int i = 0; i < model.split.liners.size(); ++i)
        if (const auto &faces = model.split.liners[i].faces; !faces.empty())
          out << "Liner   " << model.scene.liners[i]->name << ": "
              << faces.size()
              << " faces of the mesh carry thrust and bend, elastic and bonded "
                 "to the rock; bending and punching between its nodes are not "
                 "seen\n";
    }
  } // namespace



  template <int dim>
  void
  print_mesh(std::ostream &out,
             const Model<dim> &model,
             const RunReport &report)
  {
    out << "Mesh    " << model.split.mesh.n_cells() << " cells ("
        << model.n_cells_global << " deformable), "
        << model.numbering->n_global() << " nodes, "
        << model.split.interface.pairs.size()
        << " pairs; least scaled Jacobian " << std::setprecision(3)
        << model.quality.minimum_scaled_jacobian << "\n";
    if (model.n_cells_global > 0)
      print_stable_step(out, model, report);
    print_mesh_report(out, model.mesh_report, model.scene);
    print_file_shapes(out, model.scene);
    print_liners(out, model);
    out << std::flush;
  }



  template <int dim>
  void
  print_blocks(std::ostream &out, const Model<dim> &model)
  {
    print_block_table(out, model.blocks, model.scene);
    if (model.scene.block_theory.report)
      print_block_theory(out,
                         find_block_theory(model.scene,
                                           model.scene.block_theory));
    out << std::flush;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<std::string> warnings_of_set_up(const Model<dim> &,     \
                                                       const Monitors<dim> &,  \
                                                       const RunReport &);     \
  template void report_stable_step(const Model<dim> &, RunReport &);           \
  template void print_mesh(std::ostream &,                                     \
                           const Model<dim> &,                                 \
                           const RunReport &);                                 \
  template void print_blocks(std::ostream &, const Model<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

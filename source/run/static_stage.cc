// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/run/static_stage.h>
#include <keyblock/step/equilibrium.h>

#include <algorithm>
#include <iomanip>

namespace Keyblock
{
  namespace
  {
    /** Static solves that refine each other, where all is linear, and at most
     * where elements are not: bolts slip and yield. */
    constexpr unsigned int linear_refinements = 4, maximum_refinements = 20;

    /** Unbalanced ratio with which more are of no use [-]. */
    constexpr double good_ratio = 1e-12;
  } // namespace



  template <int dim>
  void
  solve_for_equilibrium(Model<dim> &model, const double share_of_displacements)
  {
    StaticSolver<dim> solver(model.split,
                             *model.numbering,
                             model.cells,
                             model.fields,
                             model.fields.supports,
                             model.conditions->elements);
    const auto &elements = model.conditions->elements;
    const bool is_linear =
      std::none_of(elements.begin(), elements.end(), [](const auto &e) {
        return e->has_product();
      });
    const unsigned int most =
      is_linear ? linear_refinements : maximum_refinements;
    double share = share_of_displacements;
    for (unsigned int i = 0; i < most; ++i)
      {
        model.step->update_forces();
        std::vector<double> force(model.fields.load.size(), 0.);
        for (unsigned int k = 0; k < dim * model.numbering->n_owned(); ++k)
          force[k] = model.fields.load[k] - model.fields.internal_force[k];
        const double ratio           = solver.residual_ratio(force);
        model.step->unbalanced_ratio = ratio;
        if (share == 0. &&
            ratio < (i < linear_refinements ? 1e-14 : good_ratio))
          break;
        model.step->add_displacement(
          solver.solve(force, [&](const NodeSupport<dim> &support) {
            return share *
                   model.conditions->supports.prescribed_displacement(support);
          }));
        share = 0.;
      }
    model.step->update_forces();
    std::vector<double> force(model.fields.load.size(), 0.);
    for (unsigned int k = 0; k < dim * model.numbering->n_owned(); ++k)
      force[k] = model.fields.load[k] - model.fields.internal_force[k];
    model.step->unbalanced_ratio = solver.residual_ratio(force);
  }



  template <int dim>
  void
  establish_initial_state(Model<dim> &model)
  {
    bool changes_later = false;
    for (unsigned int s = 0; s < model.scene.stages.size(); ++s)
      changes_later = changes_later || model.conditions->changes(s + 2);
    const bool is_static =
      model.scene.initial_state.equilibrium == InitialEquilibrium::static_solve;
    // compliant joints are born with the stress of the ground
    const bool has_springs_under_stress =
      are_any_compliant(model.scene.joints) &&
      (!model.scene.initial_state.stress.empty() ||
       model.scene.initial_state.has_depth_stress());
    if (!is_static && !changes_later &&
        !model.conditions->releases_supports() && !has_springs_under_stress)
      return;
    model.step->begin_stage(Stage(), 1);
    model.step->update_forces();
    if (is_static)
      {
        const double start = MPI_Wtime();
        solve_for_equilibrium(model, 0.);
        model.step->zero_displacements();
        model.out << "Static  initial equilibrium in " << std::setprecision(3)
                  << MPI_Wtime() - start << " s, unbalanced ratio "
                  << model.step->unbalanced_ratio << std::endl;
      }
    const std::string remark = model.conditions->release_supports();
    if (!remark.empty())
      model.out << "Rock    " << remark << std::endl;
    model.step->choose_step(1);
    if (model.contact == nullptr)
      return;
    // the second time all stick, and the forces of points that meet are the
    // nearest to the rock's stress
    model.contact->tie(true);
    model.step->settle_contact();
    model.step->settle_contact();
    model.contact->tie(false);
    std::vector<bool> is_exposed;
    for (const Block<dim> &block : model.blocks.blocks)
      is_exposed.push_back(block.class_of_stage[std::min<std::size_t>(
                             1, block.class_of_stage.size() - 1)] ==
                           BlockClass::exposed);
    const unsigned int n_held = model.contact->hold_bent_points(is_exposed);
    if (n_held > 0)
      model.out << "Joints  " << n_held
                << " points whose faces the mesh has bent are held until rock "
                   "is excavated or shaken"
                << std::endl;
    model.step->settle_contact();
    const JointSums<dim> points = model.contact->report().count_pairs();
    if (points.n_open + points.n_sliding > 0)
      model.out << "Joints  " << points.n_open + points.n_sliding
                << " points cannot bear the initial stress: " << points.n_open
                << " open, " << points.n_sliding << " slide" << std::endl;
  }

  template void solve_for_equilibrium(Model<2> &, const double);
  template void solve_for_equilibrium(Model<3> &, const double);
  template void establish_initial_state(Model<2> &);
  template void establish_initial_state(Model<3> &);
} // namespace Keyblock

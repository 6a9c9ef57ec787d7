// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_check_parts_h
#define keyblock_scene_check_parts_h

#include <keyblock/base/expression.h>
#include <keyblock/scene/check.h>

// The parts of Scene::cross_check(); all throw InputError.
namespace Keyblock
{
  /** An expression of the entry @p entry, if there is one, can be read. */
  template <int dim>
  void
  check_expression(const std::string &text,
                   const unsigned int n_components,
                   const std::string &entry)
  {
    if (!text.empty())
      Expression<dim>(text, n_components, entry);
  }

  template <int dim>
  void check_meshing(const Scene<dim> &scene);

  template <int dim>
  void check_excavation(const Excavation<dim> &excavation);

  template <int dim>
  void check_joint(const Joint<dim> &joint);

  /** Some joint of a scene lies in its domain. */
  template <int dim>
  void check_joints_inside(const Scene<dim> &scene);

  void check_stage(const Stage &stage);

  template <int dim>
  void check_material(const Material<dim> &material);

  template <int dim>
  void check_stages_of_excavations(const Scene<dim> &scene);

  void check_time_stepping(const TimeStepping &stepping);

  template <int dim>
  void check_initial_state(const Scene<dim> &scene);

  void check_study_variable(const StudyVariable &variable);

  template <int dim>
  void check_supports(const Scene<dim> &scene);

  template <int dim>
  void check_expressions(const Scene<dim> &scene);

  /** Whether there is a joint or a set of that name. */
  template <int dim>
  bool has_joint(const Scene<dim> &scene, const std::string &name);

  template <int dim>
  void check_safety(const Scene<dim> &scene);
} // namespace Keyblock

#endif

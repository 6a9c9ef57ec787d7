// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_study_entries_h
#define keyblock_scene_study_entries_h

#include <keyblock/scene/scene.h>

#include <vector>

namespace Keyblock
{
  /** Throw InputError if a variable of the study names an entry that there is
   * not, or if two of them set the same one: by its name, by a pattern or a set
   * of joints, or as strength of a set from which joints have theirs. */
  template <int dim>
  void check_study_entries(const Scene<dim> &scene);

  /** Throw InputError if an entry does not take the values, by variable, that
   * were drawn for it. */
  template <int dim>
  void check_study_values(const Scene<dim> &scene,
                          const std::vector<std::vector<double>> &values);

  /** Names of the variables that set what limit equilibrium does not take, as
   * in-situ stress and stiffness. */
  template <int dim>
  std::vector<std::string> list_variables_of_stress(const Scene<dim> &scene);
} // namespace Keyblock

#endif

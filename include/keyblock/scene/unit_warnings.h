// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_unit_warnings_h
#define keyblock_scene_unit_warnings_h

#include <keyblock/scene/scene.h>
#include <keyblock/scene/text.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Values that look as if they were in another unit, one sentence each:
   * angles in radians, stresses in MPa or GPa, densities in t/m3, forces in kN,
   * lengths and areas in millimetres. */
  template <int dim>
  std::vector<std::string> warnings_of_units(const Scene<dim> &scene);

  /** Loads, strengths and accelerations that look as if they were in another
   * unit, or gravity upside down, one sentence each. */
  template <int dim>
  std::vector<std::string> warnings_of_loads(const Scene<dim> &scene);

  /** What is hardly ever meant: water above the ground, gravity that no ground
   * has or that is across a profile, benches dug from below, dips in radians.
   */
  template <int dim>
  std::vector<std::string> warnings_of_mistakes(const Scene<dim> &scene);

  /** What is missing: loads, supports, the depth of the ground. */
  template <int dim>
  std::vector<std::string> warnings_of_missing_entries(const Scene<dim> &scene);

  /** A sentence if the scene says nothing of the rock. */
  template <int dim>
  std::vector<std::string> warnings_of_default_rock(const Scene<dim> &scene,
                                                    const SceneText &text);

  /** A sentence if the initial stress that follows from Ground/Depth is not
   * that of the weight of all the rock. */
  template <int dim>
  std::vector<std::string> warnings_of_ground(const Scene<dim> &scene);

  /** A sentence if what loads the top of a domain by Ground/Depth from the
   * start is not the initial stress there. */
  template <int dim>
  std::vector<std::string> warnings_of_ground_top(const Scene<dim> &scene);

  /** Drawings (ASCII DXF) of excavations and joints whose header names another
   * unit ($INSUNITS) than the scene's Scale, one sentence each; before the
   * joints are parted into facets, which do not name their file. */
  template <int dim>
  std::vector<std::string> warnings_of_drawings(const Scene<dim> &scene);
} // namespace Keyblock

#endif

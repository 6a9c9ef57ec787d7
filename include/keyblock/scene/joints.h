// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joints_h
#define keyblock_scene_joints_h

#include <keyblock/scene/scene.h>
#include <keyblock/scene/text.h>

namespace Keyblock
{
  /**
   * The joints of a scene from all its sources, in this order: @p names, rows
   * of the table, sets. The strength of a joint is the default one, then that
   * of its set, then that of its row, then what its subsection and overrides
   * say. Throws InputError for names that stand twice and for subsections and
   * overrides of joints that there are not.
   */
  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  make_joints(const Scene<dim> &scene,
              const std::vector<std::string> &names,
              const SceneText &text);

  /** Whether the pattern of an override means a joint or a set of this name: as
   * it is, or by * and ?. */
  bool matches_name(const std::string &pattern, const std::string &name);

  /** Let the entry `Joints/Names` name all joints. */
  template <int dim>
  void note_joints(ParameterHandler &prm,
                   const std::vector<std::unique_ptr<Joint<dim>>> &joints);

  /** The subsections of all joints, numbers exact; empty entries left out. */
  template <int dim>
  std::string
  print_joints(const std::vector<std::unique_ptr<Joint<dim>>> &joints);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_idle_entries_h
#define keyblock_scene_idle_entries_h

#include <keyblock/scene/scene.h>
#include <keyblock/scene/text.h>

namespace Keyblock
{
  /**
   * Take the extent of a joint whose entries do not give it from its Vertices
   * or Radius, as that of a row of a table. Throws InputError for an entry that
   * another one leaves without effect, as a dip besides a normal vector; a
   * later override may replace what the file or an earlier one gives, but not
   * corners by an extent: nothing else says where such a joint is.
   *
   * @param passages  what the scene says of the joint, the file first
   * @param is_resolved  whether the file has all entries of the joint, as
   *   used.prm has, so that only overrides are looked at
   */
  template <int dim>
  void settle_plane(Joint<dim> &joint,
                    const std::vector<const JointPassage *> &passages,
                    const bool is_resolved);

  /** Throw InputError for overrides of what is not made again by a scene whose
   * joints are all written out, as in used.prm. @p has_depth: whether Ground
   * gives anything. */
  void refuse_idle_overrides(const SceneText &text, const bool has_depth);

  /** Throw InputError for entries that have no effect with the choice beside
   * them, as the radius of an excavation that is a box; those of the file are
   * left alone if an override makes that choice, or if all joints are written
   * out, as in used.prm. @p prm: the entries as they were parsed. */
  template <int dim>
  void refuse_idle_entries(ParameterHandler &prm,
                           const Scene<dim> &scene,
                           const SceneText &text);

  /** Sentences on entries that are allowed and have no effect. */
  template <int dim>
  std::vector<std::string> warnings_of_idle_entries(const Scene<dim> &scene);
} // namespace Keyblock

#endif

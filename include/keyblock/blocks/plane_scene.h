// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_plane_scene_h
#define keyblock_blocks_plane_scene_h

#include <keyblock/blocks/plane_blocks.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <variant>

namespace Keyblock
{
  /** The planes of a scene, which is to live as long; or what in it has none,
   * as the part of a sentence after "because". A circle is a polygon of many
   * sides with its area. Joints keep their numbers, and excavations theirs. */
  template <int dim>
  std::variant<PlaneScene<dim>, std::string>
  list_planes(const Scene<dim> &scene);

  /** Lengths for find_plane_blocks(), by the size of the domain. */
  template <int dim>
  PlaneBlockOptions plane_block_options(const PlaneScene<dim> &scene);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_surface_places_h
#define keyblock_contact_surface_places_h

#include <keyblock/blocks/interface.h>
#include <keyblock/scene/scene.h>

#include <vector>

namespace Keyblock
{
  /** Surface nodes and faces of the split mesh, by index. */
  template <int dim>
  struct SurfaceTopology
  {
    const std::vector<unsigned int> &vertex_of_node;
    const std::vector<std::vector<unsigned int>> &faces_of_node;

    /** Outward by the right-hand rule. */
    const std::vector<typename Mesh<dim>::FaceVertices> &nodes_of_face;
  };

  /** Where the surface is at the start. */
  template <int dim>
  struct SurfacePlaces
  {
    std::vector<Point<dim>> of_node; ///< [m]

    /** Of each face: whether what the mesh has bent leaves it no area, so that
     * it has no normal and is no part of the surface. */
    std::vector<bool> is_flat;
  };

  /**
   * Puts each surface node at its vertex, but in the planes of the joints of
   * its faces, which the mesh may have bent: so bent faces do not interlock.
   * Free faces keep their planes. Where a joint's trace moves across the nodes
   * beside it, they move with it; a free face that has its edges on the trace
   * becomes flat.
   */
  template <int dim>
  SurfacePlaces<dim>
  place_in_joint_planes(const Mesh<dim> &mesh,
                        const Scene<dim> &scene,
                        const std::vector<SurfaceFace<dim>> &surface,
                        const SurfaceTopology<dim> &topology);
} // namespace Keyblock

#endif

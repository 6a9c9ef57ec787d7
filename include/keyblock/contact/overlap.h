// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_overlap_h
#define keyblock_contact_overlap_h

#include <keyblock/contact/search.h>

namespace Keyblock
{
  /** Where two faces of one joint lie on each other. */
  template <int dim>
  struct FaceOverlap
  {
    unsigned int slave_face, master_face; ///< indices into Interface::surface
    double area;                          ///< [m^(dim-1)]

    /** Shares of the faces' nodes at the overlap's centre. */
    std::array<double, Mesh<dim>::n_face_vertices> slave_weight, master_weight;
  };

  /** Overlaps of the faces of @p joints (by index), which touch each other at
   * @p position but for a tenth of their size. */
  template <int dim>
  std::vector<FaceOverlap<dim>>
  list_overlaps(const ContactSurface<dim> &surface,
                const std::vector<double> &position,
                const std::vector<bool> &joints);

  /** How deep a node is in a block, beyond how deep it was at the start. */
  template <int dim>
  struct Overlap
  {
    double depth = 0.; ///< [m]
    Vector<dim> place{};
  };

  /** The deepest of all nodes at @p position, found without the candidates of
   * @p search: a check of contact. Nodes behind faces from the start are left
   * out as there, and those that a pair holds: faces that the mesh has bent may
   * lie in several layers in a joint's plane. */
  template <int dim>
  Overlap<dim> find_largest_overlap(const ContactSearch<dim> &search,
                                    const std::vector<double> &position,
                                    const std::vector<bool> &is_removed_block);
} // namespace Keyblock

#endif

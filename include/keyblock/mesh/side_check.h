// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_side_check_h
#define keyblock_mesh_side_check_h

#include <keyblock/mesh/mesh.h>

#include <string>

namespace Keyblock
{
  /** Throws InputError if two cells lie on the same side of a face: making
   * cells positive must not have hidden that they lie on top of each other.
   * @param origin, @param remedy begin and end of the sentence */
  template <int dim>
  void check_sides(const Mesh<dim> &mesh,
                   const std::string &origin,
                   const std::string &remedy);
} // namespace Keyblock

#endif

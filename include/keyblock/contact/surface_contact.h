// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_surface_contact_h
#define keyblock_contact_surface_contact_h

#include <keyblock/contact/contact_surface.h>
#include <keyblock/contact/solver.h>

#include <functional>

namespace Keyblock
{
  /** A slave on a master face (or its edge or corner), or in 3D a ridge across
   * another, as found now. */
  template <int dim>
  struct SurfaceContact
  {
    unsigned int
      slave;           ///< surface node; of ridges the first of the slave ridge
    unsigned int face; ///< index into Interface::surface; one of the ridge's
    unsigned int joint; ///< of the face, or `none`
    unsigned int master_block;
    bool is_ridge = false;
    ContactPoint<dim> point;
  };

  /** Whether the pair contact of a surface node with a face stands for it, so
   * that the face is not to be searched. */
  using IsPaired = std::function<bool(unsigned int, unsigned int)>;
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_material_region_h
#define keyblock_mesh_material_region_h

#include <keyblock/base/expression.h>
#include <keyblock/scene/scene.h>

#include <array>

namespace Keyblock
{
  /** Where a material is: the meaning of `Materials/NAME/Region`. */
  template <int dim>
  class MaterialRegion
  {
  public:
    /** Throws InputError if it is a band that does not name two joints. */
    MaterialRegion(const Scene<dim> &scene, const Material<dim> &material);

    /** Whether it is a group of cells of the mesh file, not of places. */
    bool is_group() const;

    /** Whether @p point lies in it; never in a group. */
    bool contains(const dealii::Point<dim> &point) const;

  private:
    const std::string &region;
    const bool is_all, is_band;
    std::array<const Joint<dim> *, 2> band{}; ///< the lower one, the upper one
    const Expression<dim> inside;             ///< of other regions
  };
} // namespace Keyblock

#endif

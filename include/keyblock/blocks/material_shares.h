// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_material_shares_h
#define keyblock_blocks_material_shares_h

#include <keyblock/blocks/interface.h>
#include <keyblock/mesh/material_region.h>

#include <deque>
#include <string>

namespace Keyblock
{
  /** The densities of materials that are there from the start, by place. */
  template <int dim>
  class DensityOfPlaces
  {
  public:
    explicit DensityOfPlaces(const Scene<dim> &scene);

    /** Whether it varies, and with places alone. */
    bool varies() const;

    /** [kg/m3]; of places without material @p otherwise. */
    double at(const Point<dim> &point, const double otherwise) const;

    /** Mean density of a cell of which @p of_cell is that at its centre, by
     * parts of it, which are smaller where the density changes [kg/m3]. */
    double mean(const Mesh<dim> &mesh,
                const unsigned int cell,
                const double of_cell) const;

  private:
    std::deque<MaterialRegion<dim>> regions;
    std::vector<double> densities;
    bool has_groups = false;
  };

  /** Warning of finite blocks whose mass differs by more than half a percent
   * from that of the regions of their materials, as a cell has the material at
   * its centre: one sentence, empty if there are none. Regions count at the
   * middles of many parts of each cell that a boundary crosses. */
  template <int dim>
  std::string warning_of_material_shares(const Scene<dim> &scene,
                                         const SplitMesh<dim> &split,
                                         const Blocks<dim> &blocks);
} // namespace Keyblock

#endif

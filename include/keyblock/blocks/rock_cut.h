// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_rock_cut_h
#define keyblock_blocks_rock_cut_h

#include <keyblock/blocks/plane_blocks.h>

#include <vector>

namespace Keyblock
{
  /** The cells into which excavations and joints cut a domain. */
  template <int dim>
  class RockCut
  {
  public:
    /** Cut excavations out of the domain, and the rest along joints. Keeps
     * references to both arguments. Throws InputError as ConvexCells. */
    RockCut(const PlaneScene<dim> &scene, const PlaneBlockOptions &options);

    /** The extent that covers a polygon (in units) on a plane: the first of
     * those that do so together; or nothing. */
    unsigned int closing_extent(const unsigned int plane,
                                const std::vector<Point<dim>> &polygon) const;

    /** Whether several joints cover a polygon each. */
    bool has_choice(const unsigned int plane,
                    const std::vector<Point<dim>> &polygon) const;

    ConvexCells<dim> cells;
    std::vector<unsigned int> excavation_of_cell;  ///< index; or nothing
    std::vector<unsigned int> stage_of_excavation; ///< by index
    std::vector<PlaneExtent<dim>> extents;         ///< of joints that cut
    std::vector<std::vector<unsigned int>> extents_of_plane; ///< by joint
    unsigned int n_stages = 0;

  private:
    static constexpr unsigned int nothing = ConvexCells<dim>::nothing;

    void excavate();
    void excavate(const unsigned int piece);
    void cut_joints();
    bool touches_excavation(const PlaneExtent<dim> &extent) const;

    const PlaneScene<dim> &scene;
    const PlaneBlockOptions &options;
  };

  /** Indices of extents that may bound an exposed block, ascending. A face of a
   * block ends at as many other surfaces as space has dimensions, and its
   * joints are connected with an excavation.
   * @param touches_excavation of each extent: an excavation counts as many
   * surfaces */
  template <int dim>
  std::vector<unsigned int>
  find_relevant_extents(const std::vector<PlaneExtent<dim>> &extents,
                        const std::vector<bool> &touches_excavation,
                        const ConvexCells<dim> &cells);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_faces_h
#define keyblock_safety_block_faces_h

#include <keyblock/blocks/free_faces.h>
#include <keyblock/safety/limit_equilibrium.h>

#include <set>

namespace Keyblock
{
  /** A force and the point it acts at. */
  template <int dim>
  struct PointForce
  {
    Point<dim> place;     ///< [m]
    Tensor<1, dim> force; ///< [N], per metre in 2D
  };

  template <int dim>
  Tensor<1, dim> sum_of(const std::vector<PointForce<dim>> &forces);

  /** What acts on a block, but for what other blocks do. */
  template <int dim>
  struct BlockLoads
  {
    Point<dim> centroid;
    Tensor<1, dim> weight;                  ///< mass times gravity [N]
    Tensor<1, dim> seismic;                 ///< Seismic coefficient [N]
    std::vector<PointForce<dim>> tractions; ///< on free faces
    std::vector<PointForce<dim>> water;     ///< in joints
    Tensor<1, dim> water_along;             ///< its part along bent faces [N]

    /** All of it, water within the planes of joints excluded [N]. */
    Tensor<1, dim>
    without_water() const
    {
      return weight + seismic + sum_of(tractions) + water_along;
    }

    /** All of it, each where it acts. */
    std::vector<PointForce<dim>> all() const;
  };

  /** That of limit equilibrium at the stage of @p ground [m/s2]. */
  template <int dim>
  Tensor<1, dim>
  seismic_acceleration(const Ground<dim> &ground)
  {
    Tensor<1, dim> coefficient =
      ground.scene.seismic_coefficient(ground.stage_number);
    const auto &more = ground.scene.safety.seismic_coefficient;
    for (unsigned int d = 0; d < more.size(); ++d)
      coefficient[d] += more[d];
    return standard_gravity * coefficient;
  }

  /** A block as limit equilibrium sees it. */
  template <int dim>
  struct BlockSurroundings
  {
    /** Joints that it touches, one face per joint and side, and free faces of
     * other rock that its own lie against. */
    std::vector<BlockFace<dim>> faces;

    /** Blocks across each of the faces, by index. */
    std::vector<std::set<unsigned int>> others;

    BlockLoads<dim> loads;

    /** Of a face against its joint's plane [deg]. */
    double largest_bend = 0.;

    /** Of the free faces between the planes over that in the mesh, by their
     * mean normal [-]. */
    double free_area_ratio = 1.;

    std::string bent;           ///< name of the joint that is bent most
    bool is_attached   = false; ///< to rock that is not excavated yet
    bool is_on_fill    = false;
    bool has_free_face = false; ///< that touches another one
  };

  /**
   * What @p block touches and what acts on it at @p time. Water and tractions
   * are summed as Loads does, water by its pressure at the faces'
   * vertices; of a block that is known exactly (Block::exact), weight, areas
   * and water are those between its planes, where the mesh has bent them;
   * tractions are scaled by the ratio of its free areas.
   */
  template <int dim>
  BlockSurroundings<dim> look_around(const Ground<dim> &ground,
                                     const FreeFaces<dim> &free,
                                     const Block<dim> &block,
                                     const double time);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_theory_h
#define keyblock_safety_block_theory_h

#include <keyblock/scene/scene.h>

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace Keyblock
{
  /** All joints of one orientation. */
  template <int dim>
  struct ParallelJoints
  {
    std::string name;
    Tensor<1, dim> normal;       ///< unit, upwards
    double friction_angle = 30.; ///< [deg]
  };

  /**
   * The directions into which a block can move that lies on one side of each
   * set (Goodman and Shi 1985): the block's shape when it shrinks to a point.
   */
  struct JointPyramid
  {
    std::string code;      ///< per set 0: above the joint, 1: below it
    bool is_empty = false; ///< no direction: blocks of this code are tapered
    std::string mode;      ///< in words, with the names of the sets
    double factor = 0.;    ///< of friction alone; infinite if stable [-]
  };

  /** A plane that an excavation exposes. */
  template <int dim>
  struct FreeFace
  {
    std::string name;
    Tensor<1, dim> into_rock; ///< unit normal

    /** Joint pyramids, by index and least factor first, of the blocks that are
     * finite here and can be taken out. */
    std::vector<unsigned int> removable;
  };

  /** Which blocks of the joint sets are removable, and where. */
  template <int dim>
  struct BlockTheory
  {
    std::vector<ParallelJoints<dim>> sets;
    std::vector<JointPyramid> pyramids; ///< all 2^n, by code
    std::vector<FreeFace<dim>> faces;
    BlockTheorySettings settings;
    std::string remark; ///< why there is nothing, one sentence; else empty

    unsigned int n_empty() const;
  };

  /** Normals of the sets, pointing into the block of that @p code. */
  template <int dim>
  std::vector<Tensor<1, dim>>
  inward_normals(const std::vector<ParallelJoints<dim>> &sets,
                 const std::string &code);

  /**
   * Joint pyramids of @p sets, with the mode and the factor of a block on all
   * of their sides under @p gravity [m/s2], and those that are removable in a
   * flat roof, a floor and walls. A block is finite where its joint pyramid and
   * the half space of rock have no direction in common, and removable if the
   * joint pyramid itself is not empty (Shi's theorem, Goodman and Shi 1985).
   */
  template <int dim>
  BlockTheory<dim>
  find_block_theory(const std::vector<ParallelJoints<dim>> &sets,
                    const Tensor<1, dim> &gravity,
                    const BlockTheorySettings &settings);

  /**
   * The same for the infinite joints of @p scene and its gravity at the origin
   * (downwards if it has none). Parallel joints are one set, with the least of
   * their friction angles; cohesion, water and stress are left out. More than
   * eight sets give a remark only.
   */
  template <int dim>
  BlockTheory<dim> find_block_theory(const Scene<dim> &scene,
                                     const BlockTheorySettings &settings);

  /** A wedge that fills the whole width of a roof. */
  struct RoofWedge
  {
    double height = 0.; ///< [m]
    double area   = 0.; ///< of its base in the roof [m2]
    double volume = 0.; ///< [m3]
  };

  /** Largest block of the joint pyramid @p code, which must be removable in the
   * roof, in a flat roof of the width in @p settings. */
  RoofWedge find_largest_roof_wedge(const std::vector<ParallelJoints<3>> &sets,
                                    const std::string &code,
                                    const BlockTheorySettings &settings);

  /** The report for people. */
  template <int dim>
  void print_block_theory(std::ostream &out, const BlockTheory<dim> &theory);

  /** The report for summary.json: joint_pyramids (code, mode, factor), faces
   * (face, removable codes, largest_volumes [m3]), or the remark. */
  template <int dim>
  nlohmann::ordered_json block_theory_as_json(const BlockTheory<dim> &theory);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_deformation_damping_h
#define keyblock_step_deformation_damping_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/contact/contact.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /**
   * Damping of the deformation of finite blocks that slide. An elastic block
   * that slides with Coulomb friction flutters: its lowest modes grow by
   * themselves, at a rate that the mesh does not change, while stiffness
   * damping of given ratio at the cells' frequency damps them the less the
   * finer the mesh (doc/theory.md, section 4). So a node of mass m of such a
   * block bears
   *
   *   -a m (v - v_rigid)
   *
   * where v_rigid moves with the block's mean velocity and turns as its faces
   * on joints do, and a is critical for the lowest mode. Its sum over the block
   * is zero; what moves as a rigid body is not damped.
   */
  template <int dim>
  class DeformationDamping
  {
  public:
    DeformationDamping(const SplitMesh<dim> &split,
                       const Blocks<dim> &blocks,
                       const Numbering<dim> &numbering,
                       const CellArrays<dim> &cells,
                       Fields<dim> &fields);

    /** Call after cells or masses have changed (collective). */
    void begin_stage();

    /** Add the force, by velocities of the step before, to the damping force of
     * a stage with the damping ratio @p ratio; a is at most @p largest_rate
     * [1/s] (collective). */
    void add_force(const Contact<dim> &contact,
                   const double ratio,
                   const double largest_rate,
                   const double *position);

  private:
    struct Member
    {
      unsigned int node;
      double area; ///< on joints [m^(dim-1)]
    };

    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    Fields<dim> &fields;

    std::vector<std::vector<Member>> members; ///< owned nodes, by finite block

    /** Square root of shear modulus times volume, over the block's thickness
     * [sqrt(N/m)]: over the square root of its mass the time in which a shear
     * wave crosses it, inverted. */
    std::vector<double> stiffness;
  };
} // namespace Keyblock

#endif

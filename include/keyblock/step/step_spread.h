// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_step_spread_h
#define keyblock_step_step_spread_h

#include <keyblock/mesh/mesh.h>

namespace Keyblock
{
  /** Cell with the highest frequency of all; of equal ones the first of the
   * mesh. */
  struct StiffestCell
  {
    double frequency  = 0.;   ///< [rad/s]; 0: there are no cells
    unsigned int cell = none; ///< in the mesh
  };

  /** The stiffest of all ranks' cells with the highest @p frequency each
   * [rad/s], @p mesh_cell their places in the mesh (collective). */
  StiffestCell find_stiffest(const Communicator &communicator,
                             const std::vector<double> &frequency,
                             const std::vector<unsigned int> &mesh_cell);

  /** How far the cell that sets the time step is from an ordinary one. Steps
   * are 2 / omega, without damping and safety. */
  template <int dim>
  struct StepSpread
  {
    double least      = 0.;   ///< of all cells [s]; 0: there are none
    double median     = 0.;   ///< of all cells [s]
    unsigned int cell = none; ///< of the least step, in the mesh
    Point<dim> place;         ///< centre of that cell [m]

    /** Least over median step [-]; 1 without cells. */
    double
    ratio() const
    {
      return median > 0. ? least / median : 1.;
    }
  };

  /**
   * Spread of the stable steps of cells with the highest @p frequency each
   * [rad/s], @p mesh_cell their places in @p mesh. The median of an even number
   * of cells is the mean of the two in the middle. Every rank gives its own
   * cells, and gets the spread of all (collective).
   */
  template <int dim>
  StepSpread<dim>
  measure_step_spread(const Communicator &communicator,
                      const std::vector<double> &frequency,
                      const std::vector<unsigned int> &mesh_cell,
                      const Mesh<dim> &mesh);
} // namespace Keyblock

#endif

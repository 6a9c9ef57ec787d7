// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_mass_scaling_h
#define keyblock_rock_mass_scaling_h

#include <keyblock/base/communicator.h>
#include <keyblock/blocks/blocks.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * How the inertia of one block is shared out anew, so that its stiffest cells
   * do not set the time step: the density of each cell is multiplied by
   * max(floor, omega^2) / square with the cell's highest frequency omega. Its
   * frequency is sqrt(square) then, or below. What stiff cells get is taken
   * from the others, by one factor: the mass of the block stays, and with it
   * the acceleration under any force (doc/theory.md, equation 8).
   */
  struct MassScaling
  {
    double square        = 0.; ///< highest frequency, squared; 0: not scaled
    double floor         = 0.; ///< of a cell's, in its density [rad^2/s^2]
    double added         = 0.; ///< mass moved to stiff cells [kg]
    double mass          = 0.; ///< of the block's deformable cells [kg]
    unsigned int n_cells = 0;  ///< that got it
    bool is_at_bound = false;  ///< some of them still are: too much to be added

    /** Density for inertia over the true one, of a cell [-]. */
    double
    factor(const double frequency) const
    {
      return square > 0. ? std::max(floor, frequency * frequency) / square : 1.;
    }

    /** Highest frequency of a cell with that density [rad/s]. */
    double
    scaled(const double frequency) const
    {
      return square == 0. ? frequency
             : frequency * frequency >= floor
               ? std::sqrt(square)
               : frequency * std::sqrt(square / floor);
    }

    /** Mass moved, as a fraction of the block's [-]. */
    double
    added_fraction() const
    {
      return mass > 0. ? added / mass : 0.;
    }
  };

  /** Whether any block's inertia is shared out anew. */
  inline bool
  is_any_scaled(const std::vector<MassScaling> &blocks)
  {
    return std::any_of(blocks.begin(), blocks.end(), [](const MassScaling &b) {
      return b.square > 0.;
    });
  }

  /**
   * Bring the frequencies of cells down to @p highest [rad/s], or as far as no
   * block, and no cell that gives, loses more than the fraction @p largest of
   * its mass. Collective; every rank gives its own cells.
   * @param frequency highest of each cell [rad/s]
   * @param mass of each cell [kg]
   * @param block of each cell, below @p n_blocks
   */
  std::vector<MassScaling> scale_masses(const Communicator &communicator,
                                        const std::vector<double> &frequency,
                                        const std::vector<double> &mass,
                                        const std::vector<unsigned int> &block,
                                        const unsigned int n_blocks,
                                        const double highest,
                                        const double largest);

  /** Mass added to cells of all blocks, over the mass of these [-]. */
  double total_added_fraction(const std::vector<MassScaling> &scaling);

  /** What was added to which blocks; nothing if no block is scaled. */
  template <int dim>
  std::string describe_mass_scaling(const std::vector<MassScaling> &scaling,
                                    const Blocks<dim> &blocks,
                                    const double least_step);

  /** A sentence for each block whose step stays below @p least_step [s]. */
  template <int dim>
  std::vector<std::string>
  warnings_of_mass_scaling(const std::vector<MassScaling> &scaling,
                           const Blocks<dim> &blocks,
                           const double least_step);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_wave_resolution_h
#define keyblock_run_wave_resolution_h

#include <keyblock/blocks/ground.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Cells per wavelength that waves need, or they disperse. */
  constexpr double least_cells_per_wavelength = 10.;

  /** A sentence for each history, or velocity by a formula, of a support with
   * shear waves shorter than
   * that somewhere in the rock of its stage: up to the frequency below which 95
   * % of its energy lies. */
  template <int dim>
  std::vector<std::string> warnings_of_short_waves(const Scene<dim> &scene,
                                                   const SplitMesh<dim> &split);
} // namespace Keyblock

#endif

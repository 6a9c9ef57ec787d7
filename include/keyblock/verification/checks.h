// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_verification_checks_h
#define keyblock_verification_checks_h

#include <keyblock/output/output.h>

namespace Keyblock
{
  /** The deformable cells that are there at the end, of all ranks. */
  template <int dim>
  struct RockState
  {
    struct Cell
    {
      typename Mesh<dim>::CellVertices vertices; ///< of the split mesh
      unsigned int material;
      double volume;                            ///< [m^dim]
      Point<dim> center;                        ///< [m]
      std::array<double, n_stress<dim>> stress; ///< mean [Pa]
      double plastic_share; ///< of the volume that has yielded [-]
    };
    std::vector<Cell> cells;
    std::vector<Point<dim>> vertices;          ///< of the split mesh [m]
    std::vector<Tensor<1, dim>> displacements; ///< of the vertices [m]
  };

  /** Collect the state on every rank (collective). */
  template <int dim>
  RockState<dim> gather_rock(const SplitMesh<dim> &split,
                             const Numbering<dim> &numbering,
                             const CellArrays<dim> &cells,
                             const Fields<dim> &fields);

  /** What a closed form is computed from. */
  template <int dim>
  struct CheckInput
  {
    const Scene<dim> &scene;
    const Blocks<dim> &blocks;
    const History &history;

    /** Index into blocks of the block each monitor watches, or `none`. */
    const std::vector<unsigned int> &block_of_monitor;

    /** Energies at the end of each stage. */
    const std::vector<StageReport> &stages;

    const RockState<dim> &rock;
  };

  /**
   * Compare the last stage with the closed form that `Check/Closed form`
   * names: values NAME, NAME_reference and NAME_relative_error, references
   * computed from the scene's own entries and blocks. Rank 0 only.
   */
  template <int dim>
  CheckValues evaluate_checks(const CheckInput<dim> &input);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_internal_force_h
#define keyblock_internal_force_h

#include <keyblock/material.h>
#include <keyblock/shape.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /** What the hot loop over cells reads and writes, one entry per deformable
   * cell of this rank. Free of deal.II. */
  template <int dim>
  struct CellArrays
  {
    static constexpr int n_vertices = 1 << dim;

    std::vector<std::array<unsigned int, n_vertices>> nodes;
    std::vector<double> lambda, mu; ///< [Pa]
    std::vector<double> beta;       ///< stiffness damping time [s]

    /** n_stress<dim> values at each Gauss point of each cell [Pa]. */
    std::vector<double> stress;

    double *
    stress_of(const unsigned int cell)
    {
      return stress.data() + std::size_t(cell) * n_vertices * n_stress<dim>;
    }
    const double *
    stress_of(const unsigned int cell) const
    {
      return stress.data() + std::size_t(cell) * n_vertices * n_stress<dim>;
    }
  };

  /** Settings of one pass over the cells. */
  struct ForcePass
  {
    double step      = 0.;    ///< length of the strain increment [s]
    bool is_large    = false; ///< current geometry, rotated stress
    bool has_damping = false;
  };

  /**
   * Advance the stress at all Gauss points by the strain increment
   * `step * sym grad(rate)` and add the nodal forces: internal force
   * integral of B^T stress to @p internal, and damping force integral of B^T
   * (beta C : sym grad(rate)) to @p damping. Arrays hold dim values per node.
   *
   * @param position reference positions if small, current ones if large [m]
   * @param rate velocity over the last step, v(n-1/2) [m/s]
   *
   * In `large` the gradient is taken at the middle of the step and the stress
   * is rotated by the spin, so that a rigid rotation strains nothing; the force
   * uses the geometry at the step's end, so that it has no moment.
   */
  template <int dim>
  void add_internal_force(const ForcePass &pass,
                          CellArrays<dim> &cells,
                          const double *position,
                          const double *rate,
                          double *internal,
                          double *damping);

  /** Elastic energy of all cells of this rank [J]. */
  template <int dim>
  double elastic_energy(const CellArrays<dim> &cells, const double *position);

  /**
   * Highest frequency of one free cell with its own lumped mass [rad/s], an
   * upper bound of what it contributes to the whole mesh's (full integration).
   * @param corners positions of the vertices [m]
   */
  template <int dim>
  double highest_frequency(
    const std::array<std::array<double, dim>, 1 << dim> &corners,
    const double lambda,
    const double mu,
    const double density);

  /** Row-sum lumped mass of each vertex of a cell [kg]. */
  template <int dim>
  std::array<double, 1 << dim>
  lumped_mass(const std::array<std::array<double, dim>, 1 << dim> &corners,
              const double density);
} // namespace Keyblock

#endif

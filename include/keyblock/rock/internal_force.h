// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_internal_force_h
#define keyblock_rock_internal_force_h

#include <keyblock/base/simd.h>
#include <keyblock/rock/material.h>
#include <keyblock/rock/mohr_coulomb.h>
#include <keyblock/rock/shape.h>

#include <boost/align/aligned_allocator.hpp>

#include <array>
#include <vector>

namespace Keyblock
{
  /** What a cell computes, and so which loop it is in. */
  enum class CellKind
  {
    elastic,         ///< all Gauss points for themselves
    mean_dilatation, ///< elastic, volume change averaged over the cell
    plastic          ///< the same with Mohr-Coulomb strength
  };
  constexpr unsigned int n_cell_kinds = 3;

  /** Stresses at the Gauss points of cells [Pa], tension positive. Batches of
   * cells are stored value by value, so that a register holds the same value
   * of several cells. */
  template <int dim>
  class StressArray
  {
  public:
    static constexpr unsigned int n_points = 1 << dim;

    /** Components in the order of n_stress<dim>. */
    using Stress = std::array<double, n_stress<dim>>;

    /** Room for @p n_cells stresses of zero. */
    void
    reinit(const unsigned int n_cells)
    {
      const std::size_t n_batches = (n_cells + batch_size - 1) / batch_size;
      values.assign(n_batches * batch_size * n_points * n_stress<dim>, 0.);
    }

    Stress
    at(const unsigned int cell, const unsigned int point) const
    {
      Stress stress;
      for (int k = 0; k < n_stress<dim>; ++k)
        stress[k] = values[place(cell, point) + k * batch_size];
      return stress;
    }

    void
    set(const unsigned int cell, const unsigned int point, const Stress &stress)
    {
      for (int k = 0; k < n_stress<dim>; ++k)
        values[place(cell, point) + k * batch_size] = stress[k];
    }

    /** All numbers as they are kept (CellArrays::stress_at), for sums of whole
     * arrays and for the loop over cells. */
    std::vector<double, boost::alignment::aligned_allocator<double, 64>> values;

  private:
    static std::size_t
    place(const unsigned int cell, const unsigned int point)
    {
      return (std::size_t(cell / batch_size) * n_points + point) *
               n_stress<dim> * batch_size +
             cell % batch_size;
    }
  };

  /** What the hot loop over cells reads and writes, one entry per deformable
   * cell of this rank. Free of deal.II. */
  template <int dim>
  struct CellArrays
  {
    static constexpr int n_vertices = 1 << dim;

    std::vector<std::array<unsigned int, n_vertices>> nodes;
    /** Index of each cell in the split mesh. */
    std::vector<unsigned int> mesh_cell;

    /** Cells are sorted by kind: index of the first cell of each. */
    std::array<unsigned int, n_cell_kinds + 1> kind_begin{};

    std::vector<double> lambda, mu; ///< [Pa]
    std::vector<double> beta;       ///< stiffness damping time, if any [s]

    /**
     * In 2D elastic cells (not those with mean dilatation) the stress across
     * the plane is kept less nu times the sum of the normal stresses in it:
     * that is what elastic strain does not change, so that the loop over cells
     * need not touch it.
     */
    StressArray<dim> stress;

    using Stress = typename StressArray<dim>::Stress;

    /** Stress at a Gauss point [Pa]. */
    Stress
    stress_at(const unsigned int cell, const unsigned int point) const
    {
      return stress_at(cell, point, stress);
    }

    /** The same of an array of these cells kept elsewhere. */
    Stress
    stress_at(const unsigned int cell,
              const unsigned int point,
              const StressArray<dim> &array) const
    {
      Stress s = array.at(cell, point);
      s[2] += kept_share(cell) * (s[0] + s[1]);
      return s;
    }

    void
    set_stress(const unsigned int cell, const unsigned int point, Stress s)
    {
      s[2] -= kept_share(cell) * (s[0] + s[1]);
      stress.set(cell, point, s);
    }

    /** Whether all cells of a kind have the same moduli. */
    std::array<bool, n_cell_kinds> is_uniform{};

    // Mohr-Coulomb cells only, counted from the first of them
    std::vector<MohrCoulomb> strengths;   ///< one per material
    std::vector<unsigned short> strength; ///< of each cell, into strengths
    std::vector<double> plastic_strain;   ///< of each Gauss point [-]
    double plastic_work     = 0.;         ///< so far, on this rank [J]
    unsigned int n_yielding = 0;          ///< Gauss points, last pass

    unsigned int
    first_plastic() const
    {
      return kind_begin[unsigned(CellKind::plastic)];
    }

  private:
    /** Poisson's ratio where `stress` is kept without the part that follows
     * from the others, else 0. */
    double
    kept_share(const unsigned int cell) const
    {
      return dim == 2 && cell < kind_begin[1]
               ? 0.5 * lambda[cell] / (lambda[cell] + mu[cell])
               : 0.;
    }
  };

  /** Cells one after the other. */
  struct CellRange
  {
    unsigned int begin, end;
  };

  /** Settings of one pass over the cells. */
  struct ForcePass
  {
    double step      = 0.;    ///< length of the strain increment [s]
    bool is_large    = false; ///< current geometry, rotated stress
    bool has_damping = false;

    /** Cells to work on, in order; null: all. Ranges that begin at multiples
     * of batch_size are fastest. */
    const std::vector<CellRange> *cells = nullptr;
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
   * Cells of kind mean_dilatation and plastic replace the volume change, and
   * the pressure in the force, by its mean over the cell (B-bar, Hughes 1980);
   * in 2D that gives an out-of-plane strain. Plastic cells return the stress to
   * the yield surface and book the work of plastic strains with the mean of the
   * stresses before and after the step, as the leapfrog's energy needs.
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

  /**
   * Stiffness matrix of a cell, by rows, degrees of freedom dim * vertex +
   * axis; the same integration as add_internal_force [N/m].
   * @param is_averaged whether the volume change is averaged over the cell
   */
  template <int dim>
  std::array<double, dim *(1 << dim) * dim *(1 << dim)>
  cell_stiffness(const std::array<std::array<double, dim>, 1 << dim> &corners,
                 const bool is_averaged,
                 const double lambda,
                 const double mu);

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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_equilibrium_h
#define keyblock_step_equilibrium_h

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <keyblock/step/set_up.h>

#include <functional>

namespace Keyblock
{
  /**
   * Elastic equilibrium of the cells that are there, all joints tied: conjugate
   * gradients with algebraic multigrid (Trilinos ML). The matrix is made of the
   * same cell loops as the explicit step, so that a body in static equilibrium
   * stays at rest in it. Ties, supports and nodes without cells are constraint
   * lines. Geometry is the reference one; plastic cells count as elastic.
   */
  template <int dim>
  class StaticSolver
  {
  public:
    /** Assembles and factorizes: make a new one after cells, supports or
     * springs changed (collective). */
    StaticSolver(const SplitMesh<dim> &split,
                 const Numbering<dim> &numbering,
                 const CellArrays<dim> &cells,
                 const Fields<dim> &fields,
                 const std::vector<NodeSupport<dim>> &supports);

    /** Displacement that a support prescribes [m]. */
    using Prescribed = std::function<Tensor<1, dim>(const NodeSupport<dim> &)>;

    /**
     * Displacement [m] of all local degrees of freedom under the nodal forces
     * @p force (local degrees of freedom, owned ones count) [N].
     *
     * The residual falls to @p tolerance of its first value [-]. Throws
     * ComputationError if the iteration does not converge, as for a body that
     * nothing holds.
     */
    std::vector<double> solve(const std::vector<double> &force,
                              const Prescribed &prescribed,
                              const double tolerance = 1e-13);

    /** Norm of what @p force (owned degrees of freedom) leaves unbalanced on
     * free nodes, ties summed, over the norm of internal forces [-]. */
    double residual_ratio(const std::vector<double> &force) const;

    /** Period of the lowest mode with the masses in use, by inverse iteration
     * and the Rayleigh quotient [s]. */
    double lowest_period();

    unsigned int n_iterations = 0; ///< of the last solve

  private:
    using TrilinosVector = dealii::TrilinosWrappers::MPI::Vector;

    void make_constraints(const Prescribed &prescribed,
                          dealii::AffineConstraints<double> &lines) const;
    void assemble();

    /** Nodal forces with those of constrained nodes added to the nodes that
     * lead them. */
    TrilinosVector condense(const std::vector<double> &force) const;
    void condense_far_field();
    TrilinosVector solve_system(TrilinosVector &right_side,
                                const dealii::AffineConstraints<double> &lines,
                                const double tolerance);

    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    const Fields<dim> &fields;
    const std::vector<NodeSupport<dim>> &supports;

    dealii::IndexSet owned, relevant;
    dealii::AffineConstraints<double> homogeneous;
    dealii::TrilinosWrappers::SparseMatrix matrix;
    /** Columns that couple the nodes of the far field, condensed. */
    std::vector<TrilinosVector> far_columns;
    dealii::TrilinosWrappers::PreconditionAMG preconditioner;
  };
} // namespace Keyblock

#endif

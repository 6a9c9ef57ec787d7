// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_equilibrium_h
#define keyblock_step_equilibrium_h

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>
#include <keyblock/step/force_element.h>

#include <functional>
#include <map>

namespace Keyblock
{
  /**
   * Elastic equilibrium of the cells that are there, all joints tied: conjugate
   * gradients with algebraic multigrid (Trilinos ML). The matrix is made of the
   * same cell loops as the explicit step, so that a body in static equilibrium
   * stays at rest in it. Ties, supports and nodes without cells are constraint
   * lines. Geometry is the reference one; plastic cells count as elastic, and
   * what springs of bolts do now as what they will do.
   */
  template <int dim>
  class StaticSolver
  {
  public:
    /** Assembles and factorizes: make a new one after cells, supports or
     * elements changed (collective). */
    StaticSolver(const SplitMesh<dim> &split,
                 const Numbering<dim> &numbering,
                 const CellArrays<dim> &cells,
                 const Fields<dim> &fields,
                 const std::vector<NodeSupport<dim>> &supports,
                 const ForceElements<dim> &elements);

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
     * and the Rayleigh quotient; 0 if nothing moves [s]. */
    double lowest_period();

    unsigned int n_iterations = 0; ///< of the last solve

  private:
    static constexpr unsigned int n_cell_dofs = dim * (1 << dim);
    using TrilinosVector = dealii::TrilinosWrappers::MPI::Vector;

    void make_constraints(const Prescribed &prescribed,
                          dealii::AffineConstraints<double> &lines) const;
    void tie_hanging_nodes(dealii::AffineConstraints<double> &lines) const;

    /** The node that leads each node of a joint: the one with the least number
     * of those that were one before the split. */
    std::map<unsigned int, unsigned int> find_leaders() const;

    /** Give @p node the displacement @p u in the directions of @p support. */
    void hold(const unsigned int node,
              const NodeSupport<dim> &support,
              const Tensor<1, dim> &u,
              dealii::AffineConstraints<double> &lines) const;

    using GlobalDof = dealii::types::global_dof_index;
    GlobalDof global_dof(const unsigned int node, const unsigned int d) const;
    std::vector<GlobalDof>
    global_dofs(const std::vector<unsigned int> &local) const;
    std::vector<GlobalDof> dofs_of(const unsigned int cell) const;

    /** Stiffness of a deformable cell at its vertices [N/m]. */
    std::array<double, n_cell_dofs * n_cell_dofs>
    stiffness_of(const unsigned int cell) const;

    void assemble(const ForceElements<dim> &elements);
    /** Give the matrix its pattern. */
    void set_up_matrix(const ForceElements<dim> &elements);
    void add_cells();
    void add_elements(const ForceElements<dim> &elements);

    /** Put something on the diagonal of nodes without cells. */
    void fill_diagonal();
    void set_up_preconditioner();

    /** Forces that displacements @p lift of constrained nodes put on their
     * neighbours [m, N]. */
    std::vector<double> force_of_lift(const std::vector<double> &lift) const;

    /** Nodal forces with those of constrained nodes added to the nodes that
     * lead them. */
    TrilinosVector condense(const std::vector<double> &force) const;

    /** Add to @p result what elements' products make of @p x (collective). */
    void add_products(const TrilinosVector &x, TrilinosVector &result) const;
    TrilinosVector solve_system(TrilinosVector &right_side,
                                const dealii::AffineConstraints<double> &lines,
                                const double tolerance);

    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    const Fields<dim> &fields;
    const std::vector<NodeSupport<dim>> &supports;
    std::vector<ForceElement<dim> *> with_products;

    dealii::IndexSet owned, relevant;
    dealii::AffineConstraints<double> homogeneous;
    dealii::TrilinosWrappers::SparseMatrix matrix;
    /** W and C of the elements that couple many nodes, W condensed. */
    struct Coupling
    {
      std::vector<TrilinosVector> columns;
      std::shared_ptr<const dealii::FullMatrix<double>> matrix;
    };
    std::vector<Coupling> couplings;
    dealii::TrilinosWrappers::PreconditionAMG preconditioner;
  };
} // namespace Keyblock

#endif

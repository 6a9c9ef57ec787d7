// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/equilibrium.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <keyblock/rock/cell_geometry.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  template <int dim>
  StaticSolver<dim>::StaticSolver(const SplitMesh<dim> &split,
                                  const Numbering<dim> &numbering,
                                  const CellArrays<dim> &cells,
                                  const Fields<dim> &fields,
                                  const std::vector<NodeSupport<dim>> &supports,
                                  const ForceElements<dim> &elements)
    : split(split)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , supports(supports)
    , owned(numbering.partitioner->locally_owned_range())
    , relevant(owned)
  {
    relevant.add_indices(numbering.partitioner->ghost_indices());
    make_constraints([](const NodeSupport<dim> &) { return Tensor<1, dim>(); },
                     homogeneous);
    for (const auto &element : elements)
      if (element->has_product())
        with_products.push_back(element.get());
    assemble(elements);
  }



  template <int dim>
  std::array<double,
             StaticSolver<dim>::n_cell_dofs * StaticSolver<dim>::n_cell_dofs>
  StaticSolver<dim>::stiffness_of(const unsigned int cell) const
  {
    Corners<dim, double> corners;
    for (unsigned int v = 0; v < (1 << dim); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        corners[v][d] = fields.reference[dim * cells.nodes[cell][v] + d];
    return cell_stiffness<dim>(corners,
                               cell >= cells.kind_begin[1],
                               cells.lambda[cell],
                               cells.mu[cell]);
  }



  template <int dim>
  void
  StaticSolver<dim>::assemble(const ForceElements<dim> &elements)
  {
    set_up_matrix(elements);
    add_cells();
    add_elements(elements);
    matrix.compress(dealii::VectorOperation::add);
    fill_diagonal();
    set_up_preconditioner();
    for (const auto &element : elements)
      {
        const CoupledStiffness stiffness = element->coupled_stiffness();
        if (stiffness.columns.empty())
          continue;
        couplings.push_back({{}, stiffness.coupling});
        for (const std::vector<double> &column : stiffness.columns)
          couplings.back().columns.push_back(condense(column));
      }
  }



  template <int dim>
  std::vector<typename StaticSolver<dim>::GlobalDof>
  StaticSolver<dim>::dofs_of(const unsigned int cell) const
  {
    std::vector<GlobalDof> dofs;
    dofs.reserve(n_cell_dofs);
    for (const unsigned int node : cells.nodes[cell])
      for (unsigned int d = 0; d < dim; ++d)
        dofs.push_back(global_dof(node, d));
    return dofs;
  }



  template <int dim>
  void
  StaticSolver<dim>::set_up_matrix(const ForceElements<dim> &elements)
  {
    dealii::TrilinosWrappers::SparsityPattern pattern(owned,
                                                      owned,
                                                      relevant,
                                                      numbering.communicator);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      homogeneous.add_entries_local_to_global(dofs_of(c), pattern, true);
    for (const auto &element : elements)
      element->for_each_stiffness([&](const std::vector<unsigned int> &dofs,
                                      const dealii::FullMatrix<double> &) {
        homogeneous.add_entries_local_to_global(global_dofs(dofs),
                                                pattern,
                                                true);
      });
    for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
      {
        const auto dof = numbering.partitioner->local_to_global(i);
        pattern.add(dof, dof);
      }
    pattern.compress();
    matrix.reinit(pattern);
  }



  template <int dim>
  void
  StaticSolver<dim>::add_cells()
  {
    constexpr unsigned int n = n_cell_dofs;
    dealii::FullMatrix<double> stiffness(n, n);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const auto k = stiffness_of(c);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            stiffness(i, j) = k[i * n + j];
        homogeneous.distribute_local_to_global(stiffness, dofs_of(c), matrix);
      }
  }



  template <int dim>
  void
  StaticSolver<dim>::add_elements(const ForceElements<dim> &elements)
  {
    for (const auto &element : elements)
      element->for_each_stiffness(
        [&](const std::vector<unsigned int> &dofs,
            const dealii::FullMatrix<double> &stiffness) {
          homogeneous.distribute_local_to_global(stiffness,
                                                 global_dofs(dofs),
                                                 matrix);
        });
  }



  template <int dim>
  void
  StaticSolver<dim>::fill_diagonal()
  {
    double diagonal = 0.;
    for (const auto i : owned)
      diagonal = std::max(diagonal, std::abs(matrix.diag_element(i)));
    diagonal = numbering.communicator.max(diagonal);
    for (const auto i : owned)
      if (matrix.diag_element(i) == 0.)
        matrix.set(i, i, diagonal);
    matrix.compress(dealii::VectorOperation::insert);
  }



  template <int dim>
  void
  StaticSolver<dim>::set_up_preconditioner()
  {
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    dealii::DoFTools::extract_constant_modes(*numbering.dof_handler,
                                             dealii::ComponentMask(),
                                             settings.constant_modes);
    settings.elliptic              = true;
    settings.smoother_sweeps       = 2;
    settings.aggregation_threshold = 0.02;
    preconditioner.initialize(matrix, settings);
  }



  namespace
  {
    /** Sparse matrix plus what couples many nodes. */
    template <typename VectorType, typename Coupling, typename Products>
    struct CoupledMatrix
    {
      const dealii::TrilinosWrappers::SparseMatrix &matrix;
      const std::vector<Coupling> &couplings;
      const Products &add_products;

      void
      vmult(VectorType &result, const VectorType &x) const
      {
        matrix.vmult(result, x);
        add_products(x, result);
        for (const Coupling &coupling : couplings)
          {
            const std::vector<VectorType> &columns = coupling.columns;
            dealii::Vector<double> work(columns.size()),
              strength(columns.size());
            for (unsigned int m = 0; m < columns.size(); ++m)
              work[m] = columns[m] * x;
            coupling.matrix->vmult(strength, work);
            for (unsigned int m = 0; m < columns.size(); ++m)
              result.add(strength[m], columns[m]);
          }
      }
    };
  } // namespace



  template <int dim>
  typename StaticSolver<dim>::TrilinosVector
  StaticSolver<dim>::solve_system(
    TrilinosVector &right_side,
    const dealii::AffineConstraints<double> &lines,
    const double tolerance)
  {
    TrilinosVector solution(owned, numbering.communicator);
    const double size = right_side.l2_norm();
    n_iterations      = 0;
    if (size > 0.)
      {
        dealii::SolverControl control(2000, tolerance * size);
        dealii::SolverCG<TrilinosVector> solver(control);
        try
          {
            const auto products = [this](const TrilinosVector &x,
                                         TrilinosVector &result) {
              add_products(x, result);
            };
            const CoupledMatrix<TrilinosVector, Coupling, decltype(products)>
              coupled{matrix, couplings, products};
            solver.solve(coupled, solution, right_side, preconditioner);
          }
        catch (const dealii::SolverControl::NoConvergence &failure)
          {
            // round-off may end above the tolerance: good enough is enough
            AssertThrow(failure.last_residual <
                          std::max(1e-9, tolerance) * size,
                        ComputationError(
                          "The static solve stopped after " +
                          std::to_string(failure.last_step) +
                          " iterations; is every part of the model held by "
                          "'Supports' or tied to one that is, and are the "
                          "stiffest cells less than 1e5 times as stiff as the "
                          "softest?"));
          }
        n_iterations = control.last_step();
      }
    lines.distribute(solution);
    return solution;
  }



  template <int dim>
  std::vector<double>
  StaticSolver<dim>::solve(const std::vector<double> &force,
                           const Prescribed &prescribed,
                           const double tolerance)
  {
    dealii::AffineConstraints<double> lines;
    make_constraints(prescribed, lines);

    // lifting of prescribed displacements: their forces on free neighbours
    std::vector<double> lift(dim * numbering.n_local(), 0.);
    bool has_lift = false;
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto dof =
            numbering.partitioner->local_to_global(dim * node + d);
          if (lines.is_inhomogeneously_constrained(dof))
            {
              lift[dim * node + d] = lines.get_inhomogeneity(dof);
              has_lift             = true;
            }
        }
    std::vector<double> total(force);
    std::fill(total.begin() + dim * numbering.n_owned(), total.end(), 0.);
    if (numbering.communicator.on_any(has_lift))
      {
        const std::vector<double> lifted = force_of_lift(lift);
        for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
          total[i] -= lifted[i];
      }
    TrilinosVector right_side     = condense(total);
    const TrilinosVector solution = solve_system(right_side, lines, tolerance);
    std::vector<double> result(dim * numbering.n_local(), 0.);
    for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
      result[i] = solution(numbering.partitioner->local_to_global(i));
    numbering.update_ghosts(result);
    return result;
  }



  template <int dim>
  typename StaticSolver<dim>::TrilinosVector
  StaticSolver<dim>::condense(const std::vector<double> &force) const
  {
    TrilinosVector condensed(owned, numbering.communicator);
    std::vector<dealii::types::global_dof_index> dof(1);
    dealii::Vector<double> value(1);
    for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
      {
        dof[0]   = numbering.partitioner->local_to_global(i);
        value[0] = force[i];
        homogeneous.distribute_local_to_global(value, dof, condensed);
      }
    condensed.compress(dealii::VectorOperation::add);
    return condensed;
  }



  template <int dim>
  double
  StaticSolver<dim>::residual_ratio(const std::vector<double> &force) const
  {
    double scale = 0.;
    for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
      scale += fields.internal_force[i] * fields.internal_force[i] +
               fields.load[i] * fields.load[i];
    scale = std::sqrt(numbering.communicator.sum(scale));
    return scale > 0. ? condense(force).l2_norm() / scale : 0.;
  }



  template <int dim>
  double
  StaticSolver<dim>::lowest_period()
  {
    // inverse iteration from a force with parts along all axes; the quotient is
    // in error by the square of the shape's error
    const unsigned int n_owned = numbering.n_owned();
    std::vector<double> x(dim * numbering.n_local(), 1.), force(x.size(), 0.);
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = 1. + 0.5 * (i % dim);
    double period = 0.;
    for (unsigned int iteration = 0; iteration < 4; ++iteration)
      {
        for (unsigned int i = 0; i < dim * n_owned; ++i)
          force[i] = fields.mass[i / dim] * x[i];
        const std::vector<double> y = solve(
          force,
          [](const NodeSupport<dim> &) { return Tensor<1, dim>(); },
          1e-3);
        double yky = 0., ymy = 0.;
        for (unsigned int i = 0; i < dim * n_owned; ++i)
          {
            yky += force[i] * y[i];
            ymy += fields.mass[i / dim] * y[i] * y[i];
          }
        yky = numbering.communicator.sum(yky);
        ymy = numbering.communicator.sum(ymy);
        if (!(yky > 0.))
          return 0.; // nothing is left that moves
        x                   = y;
        const double before = period;
        period              = 2. * dealii::numbers::PI * std::sqrt(ymy / yky);
        if (std::abs(period - before) < 0.01 * period)
          break;
      }
    return period;
  }

  template class StaticSolver<2>;
  template class StaticSolver<3>;
} // namespace Keyblock

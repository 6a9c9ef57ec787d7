// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/equilibrium.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <keyblock/base/mpi.h>
#include <keyblock/rock/cell_geometry.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  template <int dim>
  StaticSolver<dim>::StaticSolver(const SplitMesh<dim> &split,
                                  const Numbering<dim> &numbering,
                                  const CellArrays<dim> &cells,
                                  const Fields<dim> &fields,
                                  const std::vector<NodeSupport<dim>> &supports)
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
    assemble();
  }



  template <int dim>
  void
  StaticSolver<dim>::make_constraints(
    const Prescribed &prescribed,
    dealii::AffineConstraints<double> &lines) const
  {
    lines.reinit(relevant);
    const auto &partitioner = *numbering.partitioner;
    const auto global = [&](const unsigned int node, const unsigned int d) {
      return partitioner.local_to_global(dim * node + d);
    };

    for (unsigned int h = 0; h < numbering.hanging_nodes.size(); ++h)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto line = global(numbering.hanging_nodes[h], d);
          lines.add_line(line);
          for (unsigned int m = numbering.masters_begin[h];
               m < numbering.masters_begin[h + 1];
               ++m)
            lines.add_entry(line,
                            global(numbering.masters[m].node, d),
                            numbering.masters[m].weight);
        }

    // nodes that one vertex had before the split move together: the one with
    // the least number leads, and takes the supports of all
    std::map<unsigned int, unsigned int> leader;
    const Interface<dim> &interface = split.interface;
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        unsigned int first = none;
        bool is_complete   = true;
        for (unsigned int i = interface.group_begin[g];
             i < interface.group_begin[g + 1];
             ++i)
          {
            const unsigned int node =
              numbering.local_node(interface.group_vertices[i]);
            is_complete = is_complete && node != none;
            if (node != none &&
                (first == none || global(node, 0) < global(first, 0)))
              first = node;
          }
        if (is_complete)
          for (unsigned int i = interface.group_begin[g];
               i < interface.group_begin[g + 1];
               ++i)
            leader[numbering.local_node(interface.group_vertices[i])] = first;
      }
    std::map<unsigned int, NodeSupport<dim>> held;
    for (const NodeSupport<dim> &support : supports)
      {
        const auto found = leader.find(support.node);
        const unsigned int node =
          found == leader.end() ? support.node : found->second;
        auto &entry = held.emplace(node, support).first->second;
        if (support.n_directions > entry.n_directions)
          entry = support;
      }
    for (const auto &[node, first] : leader)
      if (node != first)
        for (unsigned int d = 0; d < dim; ++d)
          {
            lines.add_line(global(node, d));
            lines.add_entry(global(node, d), global(first, d), 1.);
          }
    for (const auto &[node, support] : held)
      {
        const Tensor<1, dim> u = prescribed(support);
        Tensor<1, dim> free;
        if (support.n_directions == 1)
          {
            // n . (v - u) = 0, solved for the component where n is largest
            const auto &n  = support.directions[0];
            unsigned int k = 0;
            double value   = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              {
                k = std::abs(n[d]) > std::abs(n[k]) ? d : k;
                value += n[d] * u[d];
              }
            lines.add_line(global(node, k));
            for (unsigned int d = 0; d < dim; ++d)
              if (d != k && std::abs(n[d]) > 1e-14)
                lines.add_entry(global(node, k), global(node, d), -n[d] / n[k]);
            lines.set_inhomogeneity(global(node, k), value / n[k]);
            continue;
          }
        if (support.n_directions + 1 == dim)
          {
            // free along one direction in 3D
            const auto &a = support.directions[0], &b = support.directions[1];
            for (unsigned int d = 0; d < dim; ++d)
              free[d] = a[(d + 1) % dim] * b[(d + 2) % dim] -
                        a[(d + 2) % dim] * b[(d + 1) % dim];
            unsigned int k = 0;
            for (unsigned int d = 0; d < dim; ++d)
              k = std::abs(free[d]) > std::abs(free[k]) ? d : k;
            for (unsigned int d = 0; d < dim; ++d)
              if (d != k)
                {
                  lines.add_line(global(node, d));
                  if (std::abs(free[d]) > 1e-14)
                    lines.add_entry(global(node, d),
                                    global(node, k),
                                    free[d] / free[k]);
                  lines.set_inhomogeneity(global(node, d),
                                          u[d] - free[d] / free[k] * u[k]);
                }
            continue;
          }
        for (unsigned int d = 0; d < dim; ++d)
          {
            lines.add_line(global(node, d));
            lines.set_inhomogeneity(global(node, d), u[d]);
          }
      }
    // nodes without any cell
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      if (fields.mass[node] == 0. && leader.count(node) == 0)
        for (unsigned int d = 0; d < dim; ++d)
          if (!lines.is_constrained(global(node, d)))
            lines.add_line(global(node, d));
    lines.close();
  }



  template <int dim>
  void
  StaticSolver<dim>::assemble()
  {
    constexpr unsigned int n = dim * (1 << dim);
    std::vector<dealii::types::global_dof_index> dofs(n);
    const auto list_dofs = [&](const unsigned int c) {
      for (unsigned int v = 0; v < (1 << dim); ++v)
        for (unsigned int d = 0; d < dim; ++d)
          dofs[dim * v + d] =
            numbering.partitioner->local_to_global(dim * cells.nodes[c][v] + d);
    };
    dealii::TrilinosWrappers::SparsityPattern pattern(owned,
                                                      owned,
                                                      relevant,
                                                      world());
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        list_dofs(c);
        homogeneous.add_entries_local_to_global(dofs, pattern, true);
      }
    for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
      {
        const auto dof = numbering.partitioner->local_to_global(i);
        pattern.add(dof, dof);
      }
    pattern.compress();
    matrix.reinit(pattern);

    dealii::FullMatrix<double> stiffness(n, n);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        list_dofs(c);
        Corners<dim, double> corners;
        for (unsigned int v = 0; v < (1 << dim); ++v)
          for (unsigned int d = 0; d < dim; ++d)
            corners[v][d] = fields.reference[dim * cells.nodes[c][v] + d];
        const auto k = cell_stiffness<dim>(corners,
                                           c >= cells.kind_begin[1],
                                           cells.lambda[c],
                                           cells.mu[c]);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            stiffness(i, j) = k[i * n + j];
        homogeneous.distribute_local_to_global(stiffness, dofs, matrix);
      }
    dealii::FullMatrix<double> spring_stiffness(1, 1);
    dofs.resize(1);
    for (const auto &spring : fields.far_field.springs)
      for (unsigned int d = 0; d < dim; ++d)
        {
          dofs[0] =
            numbering.partitioner->local_to_global(dim * spring.node + d);
          spring_stiffness(0, 0) = spring.stiffness;
          homogeneous.distribute_local_to_global(spring_stiffness,
                                                 dofs,
                                                 matrix);
        }
    matrix.compress(dealii::VectorOperation::add);
    // rows of nodes without cells
    double diagonal = 0.;
    for (const auto i : owned)
      diagonal = std::max(diagonal, std::abs(matrix.diag_element(i)));
    diagonal = max_over_ranks(diagonal);
    for (const auto i : owned)
      if (matrix.diag_element(i) == 0.)
        matrix.set(i, i, diagonal);
    matrix.compress(dealii::VectorOperation::insert);

    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    dealii::DoFTools::extract_constant_modes(*numbering.dof_handler,
                                             dealii::ComponentMask(),
                                             settings.constant_modes);
    settings.elliptic              = true;
    settings.smoother_sweeps       = 2;
    settings.aggregation_threshold = 0.02;
    preconditioner.initialize(matrix, settings);
    condense_far_field();
  }



  template <int dim>
  void
  StaticSolver<dim>::condense_far_field()
  {
    const FarField<dim> &far_field = fields.far_field;
    const unsigned int n           = far_field.n_columns();
    std::vector<double> column(dim * numbering.n_owned());
    for (unsigned int m = 0; m < n; ++m)
      {
        std::fill(column.begin(), column.end(), 0.);
        for (unsigned int i = 0; i < dim * far_field.springs.size(); ++i)
          column[dim * far_field.springs[i / dim].node + i % dim] =
            far_field.columns[i * n + m];
        far_columns.push_back(condense(column));
      }
  }



  namespace
  {
    /** Sparse matrix plus the coupling of the far field. */
    template <typename VectorType>
    struct CoupledMatrix
    {
      const dealii::TrilinosWrappers::SparseMatrix &matrix;
      const std::vector<VectorType> &columns;
      const dealii::FullMatrix<double> *coupling; ///< null: no columns

      void
      vmult(VectorType &result, const VectorType &x) const
      {
        matrix.vmult(result, x);
        dealii::Vector<double> work(columns.size()), strength(columns.size());
        for (unsigned int m = 0; m < columns.size(); ++m)
          work[m] = columns[m] * x;
        if (!columns.empty())
          coupling->vmult(strength, work);
        for (unsigned int m = 0; m < columns.size(); ++m)
          result.add(strength[m], columns[m]);
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
    TrilinosVector solution(owned, world());
    const double size = right_side.l2_norm();
    n_iterations      = 0;
    if (size > 0.)
      {
        dealii::SolverControl control(2000, tolerance * size);
        dealii::SolverCG<TrilinosVector> solver(control);
        try
          {
            const CoupledMatrix<TrilinosVector> coupled{
              matrix, far_columns, fields.far_field.coupling.get()};
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
    constexpr unsigned int n = dim * (1 << dim);

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
    if (on_any_rank(has_lift))
      {
        std::vector<double> lifted(lift.size(), 0.);
        for (unsigned int c = 0; c < cells.nodes.size(); ++c)
          {
            Corners<dim, double> corners;
            for (unsigned int v = 0; v < (1 << dim); ++v)
              for (unsigned int d = 0; d < dim; ++d)
                corners[v][d] = fields.reference[dim * cells.nodes[c][v] + d];
            std::array<double, n> u;
            bool is_touched = false;
            for (unsigned int i = 0; i < n; ++i)
              {
                u[i]       = lift[dim * cells.nodes[c][i / dim] + i % dim];
                is_touched = is_touched || u[i] != 0.;
              }
            if (!is_touched)
              continue;
            const auto k = cell_stiffness<dim>(corners,
                                               c >= cells.kind_begin[1],
                                               cells.lambda[c],
                                               cells.mu[c]);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                lifted[dim * cells.nodes[c][i / dim] + i % dim] +=
                  k[i * n + j] * u[j];
          }
        numbering.add_ghosts_to_owners(lifted);
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
    TrilinosVector condensed(owned, world());
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
    scale = std::sqrt(sum_over_ranks(scale));
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
        yky                 = sum_over_ranks(yky);
        ymy                 = sum_over_ranks(ymy);
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

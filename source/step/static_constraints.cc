// SPDX-License-Identifier: LGPL-2.1-or-later
// Ties, supports and nodes without cells, as constraint lines of the static
// solver, and what prescribed displacements ask for.
#include <keyblock/step/equilibrium.h>

#include <cmath>

namespace Keyblock
{
  template <int dim>
  typename StaticSolver<dim>::GlobalDof
  StaticSolver<dim>::global_dof(const unsigned int node,
                                const unsigned int d) const
  {
    return numbering.partitioner->local_to_global(dim * node + d);
  }



  template <int dim>
  std::vector<typename StaticSolver<dim>::GlobalDof>
  StaticSolver<dim>::global_dofs(const std::vector<unsigned int> &local) const
  {
    std::vector<GlobalDof> dofs;
    for (const unsigned int i : local)
      dofs.push_back(numbering.partitioner->local_to_global(i));
    return dofs;
  }



  template <int dim>
  void
  StaticSolver<dim>::make_constraints(
    const Prescribed &prescribed,
    dealii::AffineConstraints<double> &lines) const
  {
    lines.reinit(relevant);
    tie_hanging_nodes(lines);
    // nodes that one vertex had before the split move together: the one that
    // leads takes the supports of all
    const std::map<unsigned int, unsigned int> leader = find_leaders();
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
            lines.add_line(global_dof(node, d));
            lines.add_entry(global_dof(node, d), global_dof(first, d), 1.);
          }
    for (const auto &[node, support] : held)
      hold(node, support, prescribed(support), lines);
    // nodes without any cell
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      if (fields.mass[node] == 0. && leader.count(node) == 0)
        for (unsigned int d = 0; d < dim; ++d)
          if (!lines.is_constrained(global_dof(node, d)))
            lines.add_line(global_dof(node, d));
    lines.close();
  }



  template <int dim>
  void
  StaticSolver<dim>::tie_hanging_nodes(
    dealii::AffineConstraints<double> &lines) const
  {
    for (unsigned int h = 0; h < numbering.hanging_nodes.size(); ++h)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const GlobalDof line = global_dof(numbering.hanging_nodes[h], d);
          lines.add_line(line);
          for (unsigned int m = numbering.masters_begin[h];
               m < numbering.masters_begin[h + 1];
               ++m)
            lines.add_entry(line,
                            global_dof(numbering.masters[m].node, d),
                            numbering.masters[m].weight);
        }
  }



  template <int dim>
  std::map<unsigned int, unsigned int>
  StaticSolver<dim>::find_leaders() const
  {
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
                (first == none || global_dof(node, 0) < global_dof(first, 0)))
              first = node;
          }
        if (is_complete)
          for (unsigned int i = interface.group_begin[g];
               i < interface.group_begin[g + 1];
               ++i)
            leader[numbering.local_node(interface.group_vertices[i])] = first;
      }
    return leader;
  }



  namespace
  {
    /** Index of the largest component. */
    template <int dim, typename List>
    unsigned int
    largest_of(const List &list)
    {
      unsigned int k = 0;
      for (unsigned int d = 0; d < dim; ++d)
        k = std::abs(list[d]) > std::abs(list[k]) ? d : k;
      return k;
    }
  } // namespace



  template <int dim>
  void
  StaticSolver<dim>::hold(const unsigned int node,
                          const NodeSupport<dim> &support,
                          const Tensor<1, dim> &u,
                          dealii::AffineConstraints<double> &lines) const
  {
    if (support.n_directions == 1)
      {
        // n . (v - u) = 0, solved for the component where n is largest
        const auto &n        = support.directions[0];
        const unsigned int k = largest_of<dim>(n);
        double value         = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          value += n[d] * u[d];
        lines.add_line(global_dof(node, k));
        for (unsigned int d = 0; d < dim; ++d)
          if (d != k && std::abs(n[d]) > 1e-14)
            lines.add_entry(global_dof(node, k),
                            global_dof(node, d),
                            -n[d] / n[k]);
        lines.set_inhomogeneity(global_dof(node, k), value / n[k]);
        return;
      }
    if (support.n_directions + 1 == dim)
      {
        // free along one direction in 3D
        const auto &a = support.directions[0], &b = support.directions[1];
        Tensor<1, dim> free;
        for (unsigned int d = 0; d < dim; ++d)
          free[d] = a[(d + 1) % dim] * b[(d + 2) % dim] -
                    a[(d + 2) % dim] * b[(d + 1) % dim];
        const unsigned int k = largest_of<dim>(free);
        for (unsigned int d = 0; d < dim; ++d)
          if (d != k)
            {
              lines.add_line(global_dof(node, d));
              if (std::abs(free[d]) > 1e-14)
                lines.add_entry(global_dof(node, d),
                                global_dof(node, k),
                                free[d] / free[k]);
              lines.set_inhomogeneity(global_dof(node, d),
                                      u[d] - free[d] / free[k] * u[k]);
            }
        return;
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        lines.add_line(global_dof(node, d));
        lines.set_inhomogeneity(global_dof(node, d), u[d]);
      }
  }



  template <int dim>
  void
  StaticSolver<dim>::add_products(const TrilinosVector &x,
                                  TrilinosVector &result) const
  {
    if (with_products.empty())
      return;
    TrilinosVector all(x);
    homogeneous.distribute(all);
    std::vector<double> moved(dim * numbering.n_local(), 0.),
      force(moved.size(), 0.);
    for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
      moved[i] = all(numbering.partitioner->local_to_global(i));
    for (ForceElement<dim> *element : with_products)
      element->add_product(moved, force);
    result += condense(force);
  }



  template <int dim>
  std::vector<double>
  StaticSolver<dim>::force_of_lift(const std::vector<double> &lift) const
  {
    constexpr unsigned int n = n_cell_dofs;
    std::vector<double> lifted(lift.size(), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        std::array<double, n> u;
        bool is_touched = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            u[i]       = lift[dim * cells.nodes[c][i / dim] + i % dim];
            is_touched = is_touched || u[i] != 0.;
          }
        if (!is_touched)
          continue;
        const auto k = stiffness_of(c);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            lifted[dim * cells.nodes[c][i / dim] + i % dim] +=
              k[i * n + j] * u[j];
      }
    numbering.add_ghosts_to_owners(lifted);
    return lifted;
  }

#define INSTANTIATE(dim)                                                       \
  template StaticSolver<dim>::GlobalDof StaticSolver<dim>::global_dof(         \
    const unsigned int, const unsigned int) const;                             \
  template std::vector<StaticSolver<dim>::GlobalDof>                           \
  StaticSolver<dim>::global_dofs(const std::vector<unsigned int> &) const;     \
  template void StaticSolver<dim>::make_constraints(                           \
    const StaticSolver<dim>::Prescribed &,                                     \
    dealii::AffineConstraints<double> &) const;                                \
  template void StaticSolver<dim>::add_products(const TrilinosVector &,        \
                                                TrilinosVector &) const;       \
  template std::vector<double> StaticSolver<dim>::force_of_lift(               \
    const std::vector<double> &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// What structural liners add to inertia, and how they shorten the step.
#include <keyblock/step/liner_mass.h>
#include <keyblock/step/structural_liner.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  std::map<unsigned int, double>
  StructuralLiners<dim>::row_sums() const
  {
    std::map<unsigned int, double> rows;
    for (const Lining &lining : linings)
      if (lining.is_present)
        {
          const std::vector<double> sums = lining.shell.row_sums();
          for (const Anchor &anchor : lining.anchors)
            if (anchor.share > 0.)
              split.for_each_carrier(anchor.vertex,
                                     [&](const unsigned int carrier,
                                         const double weight) {
                                       rows[carrier] += weight * anchor.share *
                                                        sums[anchor.point];
                                     });
        }
    return rows;
  }



  template <int dim>
  std::vector<double>
  StructuralLiners<dim>::own_row_sums() const
  {
    std::vector<double> sums(numbering.n_owned(), 0.);
    for (const auto &[vertex, sum] : row_sums())
      if (numbering.is_owned(vertex))
        sums[numbering.local_node(vertex)] = sum;
    return sums;
  }



  template <int dim>
  void
  StructuralLiners<dim>::add_mass(
    const typename ForceElement<dim>::Inertia &inertia,
    std::vector<double> &mass)
  {
    own_mass = true_mass;
    add_inertia_of_liners(
      inertia, [this]() { return own_row_sums(); }, own_mass, mass);
  }



  template <int dim>
  StepBound
  StructuralLiners<dim>::step_bound(
    const std::vector<double> &inverse_mass) const
  {
    StepBound bound;
    const std::map<unsigned int, double> rows = row_sums();
    std::vector<unsigned int> vertices;
    vertices.reserve(rows.size());
    for (const auto &[vertex, sum] : rows)
      vertices.push_back(vertex);
    if (vertices.empty())
      return bound;
    const std::vector<double> of_rock =
      active_cells.squared_frequencies_at(vertices);
    const double highest =
      active_cells.stable_step.frequency * active_cells.stable_step.frequency;
    // what others have added to a node has the highest frequency of all, the
    // liner's own mass nothing else to bear
    for (unsigned int i = 0; i < vertices.size(); ++i)
      if (numbering.is_owned(vertices[i]))
        {
          const unsigned int node = numbering.local_node(vertices[i]);
          const double added      = active_cells.added_mass_at(node);
          bound.squared_frequency =
            std::max(bound.squared_frequency,
                     of_rock[i] - highest +
                       inverse_mass[node] * (rows.at(vertices[i]) +
                                             (highest - of_rock[i]) * added -
                                             highest * own_mass[node]));
        }
    bound.squared_frequency =
      numbering.communicator.max(bound.squared_frequency);
    return bound;
  }

#define INSTANTIATE(dim)                                                       \
  template std::map<unsigned int, double> StructuralLiners<dim>::row_sums()    \
    const;                                                                     \
  template std::vector<double> StructuralLiners<dim>::own_row_sums() const;    \
  template void StructuralLiners<dim>::add_mass(                               \
    const typename ForceElement<dim>::Inertia &, std::vector<double> &);       \
  template StepBound StructuralLiners<dim>::step_bound(                        \
    const std::vector<double> &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

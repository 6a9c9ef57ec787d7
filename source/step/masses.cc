// SPDX-License-Identifier: LGPL-2.1-or-later
// Masses of nodes: true, of equal steps, or shared out anew within blocks.
#include <keyblock/step/active_cells.h>
#include <keyblock/step/step_spread.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  template <int dim>
  const MassScaling *
  ActiveCells<dim>::scaling_of(const unsigned int cell) const
  {
    if (mass_scaling.empty())
      return nullptr;
    const std::size_t block = split.block_of_cell[cells.mesh_cell[cell]];
    return &mass_scaling[std::min(block, mass_scaling.size() - 1)];
  }



  template <int dim>
  void
  ActiveCells<dim>::set_up_mass_scaling()
  {
    mass_scaling.clear();
    std::vector<double> scaled = frequency;
    if (scene.time_stepping.least_step > 0.)
      {
        share_out_masses();
        for (unsigned int c = 0; c < scaled.size(); ++c)
          scaled[c] = scaling_of(c)->scaled(frequency[c]);
      }
    const StiffestCell stiffest =
      find_stiffest(numbering.communicator, scaled, cells.mesh_cell);
    unscaled_step.frequency = stiffest.frequency;
    if (stiffest.cell != none)
      unscaled_step.place = split.mesh.cell_center(stiffest.cell);
  }



  template <int dim>
  void
  ActiveCells<dim>::share_out_masses()
  {
    unsigned int n_blocks = 0;
    for (const unsigned int b : split.block_of_cell)
      if (b != none)
        n_blocks = std::max(n_blocks, b + 1);
    std::vector<double> mass;
    std::vector<unsigned int> block;
    for (const unsigned int mesh_cell : cells.mesh_cell)
      {
        const auto shares = lumped_mass<dim>(corners_of(mesh_cell),
                                             material_of(mesh_cell).density);
        mass.push_back(std::accumulate(shares.begin(), shares.end(), 0.));
        block.push_back(std::min(split.block_of_cell[mesh_cell], n_blocks));
      }
    mass_scaling = scale_masses(numbering.communicator,
                                frequency,
                                mass,
                                block,
                                n_blocks + 1,
                                2. / scene.time_stepping.least_step,
                                scene.time_stepping.largest_added_mass);
  }



  template <int dim>
  template <typename Density>
  std::vector<double>
  ActiveCells<dim>::sum_masses(const Density &density) const
  {
    std::vector<double> mass(dim * numbering.n_local(), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int mesh_cell = cells.mesh_cell[c];
        const auto share =
          lumped_mass<dim>(corners_of(mesh_cell),
                           density(c, material_of(mesh_cell).density));
        for (int v = 0; v < (1 << dim); ++v)
          for (int d = 0; d < dim; ++d)
            mass[dim * cells.nodes[c][v] + d] += share[v];
      }
    numbering.add_hanging_to_masters(mass);
    numbering.add_ghosts_to_owners(mass);
    numbering.update_ghosts(mass);
    std::vector<double> by_node(numbering.n_local());
    for (unsigned int node = 0; node < by_node.size(); ++node)
      by_node[node] = mass[dim * node];
    return by_node;
  }



  template <int dim>
  void
  ActiveCells<dim>::set_up_weighing_mass()
  {
    fields.weighing_mass = sum_masses(
      [](const unsigned int, const double density) { return density; });
  }



  template <int dim>
  void
  ActiveCells<dim>::scale_density(const bool is_scaled)
  {
    if (is_scaled)
      fields.mass =
        sum_masses([&](const unsigned int cell, const double density) {
          const double ratio = frequency[cell] / lowest_frequency;
          return density * ratio * ratio;
        });
    else if (is_any_scaled(mass_scaling))
      fields.mass =
        sum_masses([&](const unsigned int cell, const double density) {
          return density * scaling_of(cell)->factor(frequency[cell]);
        });
    else
      fields.mass = fields.weighing_mass;
    added_mass.clear();
    invert_masses();
    stable_step = unscaled_step;
    if (is_scaled)
      stable_step.frequency = lowest_frequency;
  }



  template <int dim>
  void
  ActiveCells<dim>::add_mass(const std::vector<double> &added)
  {
    for (unsigned int node = 0; node < fields.mass.size(); ++node)
      fields.mass[node] += added[node];
    added_mass = added;
    invert_masses();
  }



  template <int dim>
  void
  ActiveCells<dim>::invert_masses()
  {
    fields.inverse_mass.resize(fields.mass.size());
    for (unsigned int node = 0; node < fields.mass.size(); ++node)
      {
        const int support = fields.support_of_node[node];
        const bool is_free =
          support < 0 || !fields.supports[support].is_fixed();
        fields.inverse_mass[node] =
          is_free && fields.mass[node] > 0. ? 1. / fields.mass[node] : 0.;
      }
    hold_frozen_nodes();
  }



  template <int dim>
  std::vector<double>
  ActiveCells<dim>::squared_frequencies_at(
    const std::vector<unsigned int> &vertices) const
  {
    std::vector<double> at_node(numbering.n_local(), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const double scaled = mass_scaling.empty()
                                ? frequency[c]
                                : scaling_of(c)->scaled(frequency[c]);
        // equal steps make the highest of all that of each
        const double highest = std::min(scaled, stable_step.frequency);
        for (const unsigned int vertex : split.mesh.cells[cells.mesh_cell[c]])
          split.for_each_carrier(vertex, [&](const unsigned int v, double) {
            double &value = at_node[numbering.local_node(v)];
            value         = std::max(value, highest * highest);
          });
      }
    std::vector<double> result;
    for (const unsigned int v : vertices)
      {
        const unsigned int node = numbering.local_node(v);
        result.push_back(node == none ? 0. : at_node[node]);
      }
    numbering.communicator.max_lists(result);
    return result;
  }



  template <int dim>
  void
  ActiveCells<dim>::hold_frozen_nodes()
  {
    if (is_frozen.empty())
      return;
    const Ground<dim> ground = this->ground();
    // of all ranks' cells: those at the rim belong to several
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (is_frozen[c] && !ground.is_excavated(c))
        for (const unsigned int vertex : split.mesh.cells[c])
          if (const unsigned int node = numbering.local_node(vertex);
              node != none)
            fields.inverse_mass[node] = 0.;
  }



  template <int dim>
  void
  ActiveCells<dim>::set_damping(const Stage &stage)
  {
    cells.beta.clear();
    if (!stage.has_stiffness_damping())
      return;
    for (unsigned int c = 0; c < frequency.size(); ++c)
      {
        // (7) holds if no cell has more than the ratio at its own frequency
        const double highest =
          mass_scaling.empty()
            ? frequency[c]
            : std::max(frequency[c], scaling_of(c)->scaled(frequency[c]));
        cells.beta.push_back(2. * stage.damping_ratio / highest +
                             stage.rayleigh_stiffness());
      }
  }

#define INSTANTIATE(dim)                                                       \
  template void ActiveCells<dim>::set_up_mass_scaling();                       \
  template void ActiveCells<dim>::set_up_weighing_mass();                      \
  template void ActiveCells<dim>::scale_density(const bool);                   \
  template void ActiveCells<dim>::add_mass(const std::vector<double> &);       \
  template std::vector<double> ActiveCells<dim>::squared_frequencies_at(       \
    const std::vector<unsigned int> &) const;                                  \
  template void ActiveCells<dim>::set_damping(const Stage &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbers that are not finite, found while it can be told where.
#include <keyblock/base/mpi.h>
#include <keyblock/run/simulation.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    bool
    is_finite(const double *values, const std::size_t n)
    {
      return std::all_of(values, values + n, [](const double value) {
        return std::isfinite(value);
      });
    }

    std::string
    text_of(const double value)
    {
      std::ostringstream out;
      out << value;
      return out.str();
    }
  } // namespace



  template <int dim>
  void
  Simulation<dim>::check_finite()
  {
    // of both fields the first vertex at fault on any rank
    for (const auto &[what, field] :
         {std::make_pair("velocity", &fields.velocity),
          std::make_pair("displacement", &fields.displacement)})
      {
        unsigned int bad = none;
        for (unsigned int node = 0; node < numbering->n_owned(); ++node)
          if (!is_finite(field->data() + dim * node, dim))
            bad = std::min(bad, numbering->vertex_of_node[node]);
        bad = min_over_ranks(bad);
        if (bad == none)
          continue;
        for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
          for (const unsigned int v : split.mesh.cells[c])
            if (v == bad)
              fail_not_finite(what, split.block_of_cell[c]);
        fail_not_finite(what, none);
      }
  }



  template <int dim>
  void
  Simulation<dim>::check_state()
  {
    check_finite();
    unsigned int bad             = none;
    constexpr unsigned int n     = 1 << dim;
    const unsigned int n_elastic = cells.first_plastic();
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        bool is_good =
          c < n_elastic ||
          is_finite(cells.plastic_strain.data() + n * (c - n_elastic), n);
        for (unsigned int q = 0; q < n && is_good; ++q)
          {
            const auto stress = cells.stress.at(c, q);
            is_good           = is_finite(stress.data(), stress.size());
          }
        if (!is_good)
          bad = std::min(bad, cells.mesh_cell[c]);
      }
    bad = min_over_ranks(bad);
    if (bad != none)
      fail_not_finite("stress", split.block_of_cell[bad]);
    check_sample();
  }



  template <int dim>
  void
  Simulation<dim>::check_sample()
  {
    // the same on all ranks
    const auto energies = step->energies.as_array();
    for (unsigned int i = 0; i < n_energy_terms; ++i)
      if (!std::isfinite(energies[i]))
        fail_not_finite("energy '" + Energies::terms()[i].name + "'", none);
    for (const auto &[what, value] :
         {std::make_pair("energies' residual", step->energies.residual()),
          std::make_pair("unbalanced ratio", step->unbalanced_ratio),
          std::make_pair("largest nodal ratio", step->largest_nodal_ratio),
          std::make_pair("time step", step->dt),
          std::make_pair("time", step->time)})
      if (!std::isfinite(value))
        fail_not_finite(what, none);
  }



  template <int dim>
  void
  Simulation<dim>::check_factor(const SafetyFactor &factor)
  {
    bool is_good = std::isfinite(factor.value()) &&
                   std::isfinite(factor.lower) && std::isfinite(factor.upper) &&
                   std::isfinite(factor.stress_ratio) &&
                   !std::isnan(factor.limit_factor);
    for (const Trial &trial : factor.trials)
      is_good =
        is_good && std::isfinite(trial.slip) && std::isfinite(trial.velocity) &&
        std::isfinite(trial.acceleration) && std::isfinite(trial.unbalanced);
    // every rank has the same numbers, or at least the same verdict
    if (on_any_rank(!is_good))
      fail_not_finite("safety factor after stage '" + factor.stage + "'",
                      factor.block);
  }



  template <int dim>
  void
  Simulation<dim>::check_history() const
  {
    std::string message;
    const History &history = monitors->history; // on the root only
    for (const std::vector<double> &row : history.rows)
      for (unsigned int c = 0; c < row.size() && message.empty(); ++c)
        if (!std::isfinite(row[c]))
          message = "The value of '" + history.columns[c] + "' is " +
                    text_of(row[c]) + " at step " + text_of(row[1]) +
                    " (time " + text_of(row[2]) + " s); see '" + folder +
                    "history.csv'.";
    message = text_of_root(message);
    AssertThrow(message.empty(), ComputationError(message));
  }



  template <int dim>
  void
  Simulation<dim>::fail_not_finite(const std::string &what,
                                   const unsigned int block)
  {
    if (scene.output.write_vtu)
      output->write_vtu(step->time);
    monitors->write_csv(folder + "history.csv");
    throw ComputationError(
      "The " + what + " is not finite at step " +
      std::to_string(step->n_steps) + " (time " + std::to_string(step->time) +
      " s)" +
      (block == none ? ""
                     : " in block " + std::to_string(blocks.blocks[block].id)) +
      "; the last state is in '" + folder +
      (scene.output.write_vtu ? "solution.pvd" : "history.csv") +
      (step->n_steps == 0
         ? "'. Check the numbers of 'Initial state', 'Materials' and loads."
         : "'. Lower 'Time stepping/Safety', or raise 'Damping ratio'."));
  }

  template void Simulation<2>::check_finite();
  template void Simulation<3>::check_finite();
  template void Simulation<2>::check_state();
  template void Simulation<3>::check_state();
  template void Simulation<2>::check_sample();
  template void Simulation<3>::check_sample();
  template void Simulation<2>::check_factor(const SafetyFactor &);
  template void Simulation<3>::check_factor(const SafetyFactor &);
  template void Simulation<2>::check_history() const;
  template void Simulation<3>::check_history() const;
  template void Simulation<2>::fail_not_finite(const std::string &,
                                               const unsigned int);
  template void Simulation<3>::fail_not_finite(const std::string &,
                                               const unsigned int);
} // namespace Keyblock

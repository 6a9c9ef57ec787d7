// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/finite_check.h>

#include <keyblock/base/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

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

  } // namespace



  template <int dim>
  FiniteCheck<dim>::FiniteCheck(const Model<dim> &model,
                                Monitors<dim> &monitors,
                                Output<dim> &output,
                                const std::string &folder)
    : model(model)
    , monitors(monitors)
    , output(output)
    , folder(folder)
  {}



  template <int dim>
  void
  FiniteCheck<dim>::check_motion()
  {
    // of both fields the first vertex at fault on any rank
    const std::array<std::pair<const char *, const std::vector<double> *>, 2>
      named{{{"velocity", &model.fields.velocity},
             {"displacement", &model.fields.displacement}}};
    for (const auto &[what, field] : named)
      {
        unsigned int bad = none;
        for (unsigned int node = 0; node < model.numbering->n_owned(); ++node)
          if (!is_finite(field->data() + dim * node, dim))
            bad = std::min(bad, model.numbering->vertex_of_node[node]);
        bad = model.communicator.min(bad);
        if (bad == none)
          continue;
        for (unsigned int c = 0; c < model.split.mesh.n_cells(); ++c)
          for (const unsigned int v : model.split.mesh.cells[c])
            if (v == bad)
              fail(what, model.split.block_of_cell[c]);
        fail(what, none);
      }
  }



  template <int dim>
  void
  FiniteCheck<dim>::check_state()
  {
    check_motion();
    unsigned int bad             = none;
    constexpr unsigned int n     = 1 << dim;
    const unsigned int n_elastic = model.cells.first_plastic();
    for (unsigned int c = 0; c < model.cells.nodes.size(); ++c)
      {
        bool is_good =
          c < n_elastic ||
          is_finite(model.cells.plastic_strain.data() + n * (c - n_elastic), n);
        for (unsigned int q = 0; q < n && is_good; ++q)
          {
            const auto stress = model.cells.stress.at(c, q);
            is_good           = is_finite(stress.data(), stress.size());
          }
        if (!is_good)
          bad = std::min(bad, model.cells.mesh_cell[c]);
      }
    bad = model.communicator.min(bad);
    if (bad != none)
      fail("stress", model.split.block_of_cell[bad]);
    check_sample();
  }



  template <int dim>
  void
  FiniteCheck<dim>::check_sample()
  {
    // the same on all ranks
    const auto energies = model.step->energies.as_array();
    for (unsigned int i = 0; i < n_energy_terms; ++i)
      if (!std::isfinite(energies[i]))
        fail("energy '" + Energies::terms()[i].name + "'", none);
    const std::array<std::pair<const char *, double>, 5> named{
      {{"energies' residual", model.step->energies.residual()},
       {"unbalanced ratio", model.step->unbalanced_ratio},
       {"largest nodal ratio", model.step->largest_nodal_ratio},
       {"time step", model.step->dt},
       {"time", model.step->time}}};
    for (const auto &[what, value] : named)
      if (!std::isfinite(value))
        fail(what, none);
  }



  template <int dim>
  void
  FiniteCheck<dim>::check_factor(const SafetyFactor &factor)
  {
    bool is_good = std::isfinite(factor.value()) &&
                   std::isfinite(factor.lower) && std::isfinite(factor.upper) &&
                   std::isfinite(factor.stress_ratio) &&
                   !std::isnan(factor.limit_factor) &&
                   std::isfinite(factor.tried_demand.force());
    for (const auto &trials : {factor.trials, factor.tried_demand.trials})
      for (const Trial &trial : trials)
        is_good = is_good && std::isfinite(trial.slip) &&
                  std::isfinite(trial.velocity) &&
                  std::isfinite(trial.acceleration) &&
                  std::isfinite(trial.unbalanced);
    // every rank has the same numbers, or at least the same verdict
    if (model.communicator.on_any(!is_good))
      fail("safety factor after stage '" + factor.stage + "'", factor.block);
  }



  template <int dim>
  void
  FiniteCheck<dim>::check_history() const
  {
    std::string message;
    const History &history = monitors.history; // on the root only
    for (const std::vector<double> &row : history.rows)
      for (unsigned int c = 0; c < row.size() && message.empty(); ++c)
        if (!std::isfinite(row[c]))
          message =
            "The value of '" + history.columns[c] + "' is " + text_of(row[c]) +
            " at step " + text_of(row[1]) + " (time " + text_of(row[2]) +
            " s)" +
            (folder.empty() ? "." : "; see '" + folder + "history.csv'.");
    message = model.communicator.text_of_root(message);
    AssertThrow(message.empty(), ComputationError(message));
  }



  template <int dim>
  void
  FiniteCheck<dim>::fail(const std::string &what, const unsigned int block)
  {
    if (model.scene.output.write_vtu)
      output.write_vtu(model.step->time);
    if (!folder.empty())
      monitors.write_csv(folder + "history.csv");
    throw ComputationError(
      "The " + what + " is not finite at step " +
      std::to_string(model.step->n_steps) + " (time " +
      std::to_string(model.step->time) + " s)" +
      (block == none
         ? ""
         : " in block " + std::to_string(model.blocks.blocks[block].id)) +
      (folder.empty()
         ? ""
         : "; the last state is in '" + folder +
             (model.scene.output.write_vtu ? "solution.pvd" : "history.csv") +
             "'") +
      (model.step->n_steps == 0
         ? ". Check the numbers of 'Initial state', 'Materials' and loads."
         : ". Lower 'Time stepping/Safety', or raise 'Damping ratio'."));
  }

  template class FiniteCheck<2>;
  template class FiniteCheck<3>;
} // namespace Keyblock

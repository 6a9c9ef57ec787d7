// SPDX-License-Identifier: LGPL-2.1-or-later
// What came out of a run so far, as it stands in a checkpoint.
#include <deal.II/base/mpi.h>

#include <keyblock/checkpoint/checkpoint.h>
#include <keyblock/checkpoint/state_rows.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <sstream>
#include <utility>

namespace Keyblock
{
  template <typename Action>
  void
  for_each_number(Trial &trial, const Action &action)
  {
    action(trial.factor);
    action(trial.pressure);
    action(trial.start);
    action(trial.is_of_group);
    action(trial.is_stable);
    action(trial.is_undecided);
    action(trial.n_broken);
    action(trial.weakened_area);
    action(trial.phase);
    action(trial.slip);
    action(trial.velocity);
    action(trial.acceleration);
    action(trial.unbalanced);
    action(trial.n_steps);
    action(trial.seconds);
    action(trial.phase_1_seconds);
  }

  template <typename Action>
  void
  for_each_number(SafetyFactor &factor, const Action &action)
  {
    action(factor.block);
    action(factor.outcome);
    action(factor.lower);
    action(factor.upper);
    action(factor.undecided_lower);
    action(factor.undecided_upper);
    action(factor.group_lower);
    action(factor.group_upper);
    action(factor.group_undecided_lower);
    action(factor.group_undecided_upper);
    action(factor.limit_factor);
    action(factor.limit_once_gone.factor);
    action(factor.facts.is_complete);
    action(factor.facts.loses_friction);
    action(factor.facts.bears_tension);
    action(factor.stress_ratio);
    action(factor.support_demand.factor);
    action(factor.support_demand.force);
    action(factor.support_demand.pressure);
    action(factor.tried_demand.outcome);
    action(factor.tried_demand.lower);
    action(factor.tried_demand.upper);
    action(factor.tried_demand.undecided_lower);
    action(factor.tried_demand.undecided_upper);
    action(factor.tried_demand.area);
  }

  template <typename Action>
  void
  for_each_number(StageReport &report, const Action &action)
  {
    action(report.steps);
    action(report.time_step);
    action(report.unbalanced_ratio);
    action(report.max_displacement);
    action(report.largest_nodal_ratio);
    unsigned int end = report.is_converged + report.is_timed;
    action(end);
    report.is_converged = end > 0;
    report.is_timed     = end > 1;
    action(report.cells);
    action(report.plastic_cells);
    action(report.yielding_points);
    action(report.points.open);
    action(report.points.sliding);
    action(report.points.sticking);
    action(report.points.intact);
    action(report.through_rock);
    action(report.largest_overlap);
    for (double &coordinate : report.overlap_place)
      action(coordinate);
    action(report.turned_block);
    action(report.turned_by);
    action(report.arm_error);
    std::array<double, n_energy_terms> energies = report.energies.as_array();
    for (double &energy : energies)
      action(energy);
    report.energies = Energies::from_array(energies);
  }



  void
  exchange(StateFile &file,
           const std::string &group,
           std::vector<StageReport> &reports)
  {
    exchange_rows(file, group + "numbers", reports);
    exchange_texts(file, group + "name", reports, &StageReport::name);
    exchange_texts(file, group + "remark", reports, &StageReport::remark);
    exchange_texts(file, group + "warning", reports, &StageReport::warning);
  }



  namespace
  {
    /** Numbers of bolts that factors ask for, by set; @p demand is what names
     * them in a factor. */
    template <typename Demand>
    void
    exchange_bolt_numbers(StateFile &file,
                          const std::string &group,
                          std::vector<SafetyFactor> &factors,
                          Demand SafetyFactor::*const demand)
    {
      std::vector<std::string> sets;
      std::vector<unsigned int> numbers, n_sets;
      for (const SafetyFactor &factor : factors)
        {
          n_sets.push_back((factor.*demand).numbers.size());
          for (const auto &[set, number] : (factor.*demand).numbers)
            {
              sets.push_back(set);
              numbers.push_back(number);
            }
        }
      file.exchange(group + "n_demand_sets", n_sets);
      file.exchange(group + "demand_sets", sets);
      file.exchange(group + "demand_numbers", numbers);
      unsigned int next = 0;
      for (unsigned int f = 0; f < factors.size(); ++f)
        {
          (factors[f].*demand).numbers.clear();
          for (const unsigned int end = next + n_sets.at(f); next < end; ++next)
            (factors[f].*demand)
              .numbers.emplace_back(sets.at(next), numbers.at(next));
        }
    }

    /** Modes of factors; @p mode is one of a factor. */
    void
    exchange_modes(StateFile &file,
                   const std::string &name,
                   std::vector<SafetyFactor> &factors,
                   BlockMode SafetyFactor::*const mode)
    {
      std::vector<std::string> texts;
      for (const SafetyFactor &factor : factors)
        texts.push_back((factor.*mode).packed());
      file.exchange(name, texts);
      for (unsigned int f = 0; f < factors.size(); ++f)
        factors[f].*mode = BlockMode::unpacked(texts.at(f));
    }

    /** Trials of factors, or of their demands; @p list gives those of one. */
    template <typename List>
    void
    exchange_trials(StateFile &file,
                    const std::string &group,
                    std::vector<SafetyFactor> &factors,
                    const List &list)
    {
      std::vector<unsigned int> n_trials;
      std::vector<Trial> trials;
      for (SafetyFactor &factor : factors)
        {
          n_trials.push_back(list(factor).size());
          trials.insert(trials.end(), list(factor).begin(), list(factor).end());
        }
      file.exchange(group + "n_trials", n_trials);
      exchange_rows(file, group + "trials", trials);
      auto next = trials.begin();
      for (unsigned int f = 0; f < factors.size(); ++f)
        {
          list(factors[f]).assign(next, next + n_trials.at(f));
          next += n_trials[f];
        }
    }

    /** What limit equilibrium says once others have gone, but for the factor.
     */
    void
    exchange_once_gone(StateFile &file,
                       const std::string &group,
                       std::vector<SafetyFactor> &factors)
    {
      std::vector<std::string> modes;
      std::vector<unsigned int> n_blocks, blocks;
      for (const SafetyFactor &factor : factors)
        {
          const OnceGone &then = factor.limit_once_gone;
          modes.push_back(then.mode);
          n_blocks.push_back(then.blocks.size());
          blocks.insert(blocks.end(), then.blocks.begin(), then.blocks.end());
        }
      file.exchange(group + "once_gone_modes", modes);
      file.exchange(group + "n_once_gone", n_blocks);
      file.exchange(group + "once_gone", blocks);
      auto next = blocks.begin();
      for (unsigned int f = 0; f < factors.size(); ++f)
        {
          factors[f].limit_once_gone.mode = modes.at(f);
          factors[f].limit_once_gone.blocks.assign(next, next + n_blocks.at(f));
          next += n_blocks[f];
        }
    }
  } // namespace



  void
  exchange(StateFile &file,
           const std::string &group,
           std::vector<SafetyFactor> &factors)
  {
    exchange_rows(file, group + "numbers", factors);
    exchange_texts(file, group + "stage", factors, &SafetyFactor::stage);
    exchange_modes(file,
                   group + "failure_mode",
                   factors,
                   &SafetyFactor::failure_mode);
    exchange_texts(file, group + "held_by", factors, &SafetyFactor::held_by);
    exchange_modes(file,
                   group + "limit_mode",
                   factors,
                   &SafetyFactor::limit_mode);
    exchange_texts(file,
                   group + "limit_remark",
                   factors,
                   &SafetyFactor::limit_remark);
    exchange_bolt_numbers(file, group, factors, &SafetyFactor::support_demand);
    exchange_bolt_numbers(file,
                          group + "tried_",
                          factors,
                          &SafetyFactor::tried_demand);
    exchange_once_gone(file, group, factors);
    exchange_trials(
      file, group, factors, [](SafetyFactor & factor) -> auto & {
        return factor.trials;
      });
    exchange_trials(
      file, group + "demand_", factors, [](SafetyFactor & factor) -> auto & {
        return factor.tried_demand.trials;
      });
    std::vector<unsigned int> group_sizes, group_ids;
    for (const SafetyFactor &factor : factors)
      {
        group_sizes.push_back(factor.group.size());
        group_ids.insert(group_ids.end(),
                         factor.group.begin(),
                         factor.group.end());
      }
    file.exchange(group + "group_sizes", group_sizes);
    file.exchange(group + "group_ids", group_ids);
    auto next_id = group_ids.begin();
    for (unsigned int f = 0; f < factors.size(); ++f)
      {
        factors[f].group.assign(next_id, next_id + group_sizes[f]);
        next_id += group_sizes[f];
      }
  }



  std::vector<SafetyFactor>
  gather_from_rank_groups(const Communicator &all,
                          const std::vector<SafetyFactor> &mine)
  {
    // numbers of factors, of their trials, groups and bolts, of the trials and
    // bolts of their demands, and texts
    using Rows                    = std::vector<std::vector<double>>;
    constexpr unsigned int n_rows = 6, n_texts = 7;
    const auto row_of_trials = [](const std::vector<Trial> &trials) {
      std::vector<double> row;
      for (const Trial &trial : trials)
        for (const double number : numbers_of(trial))
          row.push_back(number);
      return row;
    };
    const auto row_of_bolts = [](const auto &bolts, std::string &sets) {
      std::vector<double> row;
      for (const auto &[set, number] : bolts)
        {
          row.push_back(number);
          sets += set + '\n';
        }
      return row;
    };
    std::pair<Rows, std::vector<std::string>> packed;
    for (const SafetyFactor &factor : mine)
      {
        packed.first.push_back(numbers_of(factor));
        packed.first.push_back(row_of_trials(factor.trials));
        packed.first.emplace_back(factor.group.begin(), factor.group.end());
        std::string sets, tried_sets;
        packed.first.push_back(
          row_of_bolts(factor.support_demand.numbers, sets));
        packed.first.push_back(row_of_trials(factor.tried_demand.trials));
        packed.first.push_back(
          row_of_bolts(factor.tried_demand.numbers, tried_sets));
        for (const std::string &text : {factor.stage,
                                        factor.failure_mode.packed(),
                                        factor.limit_mode.packed(),
                                        factor.limit_remark,
                                        factor.held_by,
                                        sets,
                                        tried_sets})
          packed.second.push_back(text);
      }
    const auto trials_of = [](const std::vector<double> &row) {
      const std::size_t n = numbers_of(Trial()).size();
      std::vector<Trial> trials;
      for (std::size_t t = 0; t + n <= row.size(); t += n)
        trials.push_back(from_numbers<Trial>(row.data() + t));
      return trials;
    };
    const auto bolts_of = [](const std::vector<double> &row,
                             const std::string &sets) {
      std::vector<std::pair<std::string, unsigned int>> bolts;
      std::istringstream lines(sets);
      for (const double number : row)
        {
          bolts.emplace_back("", static_cast<unsigned int>(number));
          std::getline(lines, bolts.back().first);
        }
      return bolts;
    };
    std::vector<SafetyFactor> found;
    for (const auto &[rows, texts] :
         dealii::Utilities::MPI::all_gather(all, packed))
      for (std::size_t f = 0; n_rows * f < rows.size(); ++f)
        {
          const auto row      = rows.begin() + n_rows * f;
          const auto text     = texts.begin() + n_texts * f;
          auto factor         = from_numbers<SafetyFactor>(row[0].data());
          factor.trials       = trials_of(row[1]);
          factor.stage        = text[0];
          factor.failure_mode = BlockMode::unpacked(text[1]);
          factor.limit_mode   = BlockMode::unpacked(text[2]);
          factor.limit_remark = text[3];
          factor.group.assign(row[2].begin(), row[2].end());
          factor.held_by                = text[4];
          factor.support_demand.numbers = bolts_of(row[3], text[5]);
          factor.tried_demand.trials    = trials_of(row[4]);
          factor.tried_demand.numbers   = bolts_of(row[5], text[6]);
          const auto is_same            = [&](const SafetyFactor &other) {
            return other.block == factor.block;
          };
          if (std::none_of(found.begin(), found.end(), is_same))
            found.push_back(factor);
        }
    std::sort(found.begin(),
              found.end(),
              [](const SafetyFactor &a, const SafetyFactor &b) {
                return a.block < b.block;
              });
    return found;
  }



  void
  exchange(StateFile &file, const std::string &group, History &history)
  {
    const std::size_t n = history.columns.size();
    std::vector<double> rows;
    for (const std::vector<double> &row : history.rows)
      rows.insert(rows.end(), row.begin(), row.end());
    file.exchange(group + "rows", rows);
    file.exchange(group + "stage_begin", history.stage_begin);
    if (!file.is_read() || !file.communicator.is_root())
      return;
    AssertThrow(rows.size() % n == 0,
                InputError("The history in the checkpoint has other columns "
                           "than this scene; name another by --restart."));
    history.rows.clear();
    for (std::size_t i = 0; i + n <= rows.size(); i += n)
      history.rows.emplace_back(rows.begin() + i, rows.begin() + i + n);
  }
} // namespace Keyblock

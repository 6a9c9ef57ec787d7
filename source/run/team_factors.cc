// SPDX-License-Identifier: LGPL-2.1-or-later
// Safety factors of a stage: by this run, or by teams with a copy of it each.
#include <keyblock/base/mpi.h>
#include <keyblock/base/teams.h>
#include <keyblock/run/simulation.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  void
  Simulation<dim>::find_remaining_factors()
  {
    const Snapshot<dim> after               = take_snapshot(parts());
    const std::vector<unsigned int> removed = removal_stage;
    const bool was_converged                = is_converged;
    try
      {
        find_safety_factors(present.index, present.before, after);
      }
    catch (const StopRequest &)
      {
        // what is saved is the end of the stage, and the factors found
        recall(after, parts());
        removal_stage = removed;
        is_converged  = was_converged;
        throw;
      }
  }



  template <int dim>
  std::unique_ptr<Simulation<dim>>
  Simulation<dim>::copy_set_up() const
  {
    auto copy = std::make_unique<Simulation>(scene_file, overrides, folder);
    copy->scene.output.write_vtu           = false;
    copy->scene.output.checkpoint_interval = 0.;
    copy->blocks                           = blocks;
    copy->split                            = split;
    copy->set_up();
    return copy;
  }



  template <int dim>
  std::vector<char>
  Simulation<dim>::state_image()
  {
    StateFile file;
    put_state(file);
    return file.image();
  }



  template <int dim>
  typename Simulation<dim>::TeamResult
  Simulation<dim>::find_factors_of_team(std::vector<char> &image)
  {
    TeamResult result;
    const std::size_t n_known = safety_factors.size();
    const TeamScope scope;
    try
      {
        if (team_copy == nullptr)
          team_copy = copy_set_up();
        {
          StateFile state(image);
          team_copy->restore(state);
        }
        result.n_capped = team_copy->contact->tally.n_capped;
        team_copy->find_remaining_factors();
      }
    catch (const StopRequest &request)
      {
        result.signal = request.signal;
      }
    catch (const ComputationError &error)
      {
        result.failure = error.message;
      }
    if (team_copy == nullptr)
      return result;
    result.n_capped = team_copy->contact->tally.n_capped - result.n_capped;
    if (team_copy->safety_factors.size() > n_known)
      result.factors.assign(team_copy->safety_factors.begin() + n_known,
                            team_copy->safety_factors.end());
    return result;
  }



  template <int dim>
  void
  Simulation<dim>::find_factors_in_teams()
  {
    if (list_wanted_blocks(present.index).empty())
      return;
    std::vector<char> image = state_image();
    const TeamResult mine   = find_factors_of_team(image);
    contact->tally.n_capped += mine.n_capped;

    // what one team found is not lost where another was stopped
    wait_for_all_teams();
    for (const SafetyFactor &factor : gather_from_teams(mine.factors))
      {
        safety_factors.push_back(factor);
        const bool is_mine = std::any_of(mine.factors.begin(),
                                         mine.factors.end(),
                                         [&](const SafetyFactor &other) {
                                           return other.block == factor.block;
                                         });
        if (!is_mine) // those were printed as they were found
          print_factor(factor);
      }
    const std::string failure = any_text(mine.failure);
    AssertThrow(failure.empty(), ComputationError(failure));
    const int signal = max_over_ranks(mine.signal);
    if (signal > 0)
      throw StopRequest{signal};
    save_if_due();
  }

  template void Simulation<2>::find_remaining_factors();
  template void Simulation<3>::find_remaining_factors();
  template void Simulation<2>::find_factors_in_teams();
  template void Simulation<3>::find_factors_in_teams();
} // namespace Keyblock

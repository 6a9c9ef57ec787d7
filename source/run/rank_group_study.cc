// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/rank_group_study.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  RankGroupStudy<dim>::Copy::Copy(const Communicator &communicator,
                                  const Model<dim> &original,
                                  const std::string &scene_file,
                                  const std::vector<std::string> &overrides)
    : model(communicator, scene_file, overrides)
  {
    // the root of the run is that of the first group, which prints
    model.out.set_condition(original.out.is_active());
    model.scene.output.write_vtu           = false;
    model.scene.output.checkpoint_interval = 0.;
    model.blocks                           = original.blocks;
    model.split                            = original.split;
    model.set_up();
    run = std::make_unique<Run<dim>>(model, "", "", MPI_Wtime());
  }



  template <int dim>
  RankGroupStudy<dim>::RankGroupStudy(const RankGroups &groups,
                                      Model<dim> &model,
                                      Run<dim> &run,
                                      const std::string &scene_file,
                                      const std::vector<std::string> &overrides)
    : groups(groups)
    , model(model)
    , run(run)
    , scene_file(scene_file)
    , overrides(overrides)
  {}



  template <int dim>
  typename RankGroupStudy<dim>::Result
  RankGroupStudy<dim>::find_factors_of_this_group(std::vector<char> &image)
  {
    Result result;
    try
      {
        if (copy == nullptr)
          copy =
            std::make_unique<Copy>(groups.mine(), model, scene_file, overrides);
        {
          StateFile state(copy->model.communicator, image);
          copy->run->checkpointing.restore(state);
        }
        result.n_capped = copy->model.contact->tally.n_capped;
        copy->run->safety.find_remaining_factors(groups);
      }
    catch (const StopRequest &request)
      {
        result.signal = request.signal;
      }
    catch (const ComputationError &error)
      {
        result.failure = error.message;
      }
    if (copy == nullptr)
      return result;
    result.n_capped = copy->model.contact->tally.n_capped - result.n_capped;
    const std::vector<SafetyFactor> &found = copy->run->record.safety_factors;
    const std::size_t n_known              = run.record.safety_factors.size();
    if (found.size() > n_known)
      result.factors.assign(found.begin() + n_known, found.end());
    return result;
  }



  template <int dim>
  void
  RankGroupStudy<dim>::find_factors()
  {
    if (run.safety.list_wanted_blocks().empty())
      return;
    std::vector<char> image;
    {
      StateFile file(model.communicator);
      run.checkpointing.put_state(file);
      image = file.image();
    }
    const Result mine = find_factors_of_this_group(image);
    model.contact->tally.n_capped += mine.n_capped;

    // what one group found is not lost where another was stopped
    groups.wait_for_all();
    for (const SafetyFactor &factor :
         gather_from_rank_groups(groups.all, mine.factors))
      {
        const bool is_mine = std::any_of(mine.factors.begin(),
                                         mine.factors.end(),
                                         [&](const SafetyFactor &other) {
                                           return other.block == factor.block;
                                         });
        // those were printed as they were found
        run.safety.record_factor(factor, is_mine);
      }
    const std::string failure = model.communicator.any_text(mine.failure);
    AssertThrow(failure.empty(), ComputationError(failure));
    const int signal = model.communicator.max(mine.signal);
    if (signal > 0)
      throw StopRequest{signal};
    run.checkpointing.save_if_due();
  }

  template class RankGroupStudy<2>;
  template class RankGroupStudy<3>;
} // namespace Keyblock

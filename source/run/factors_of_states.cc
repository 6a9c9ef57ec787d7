// SPDX-License-Identifier: LGPL-2.1-or-later
// Safety factors from states that an earlier run has kept.
#include <keyblock/run/kept_states.h>
#include <keyblock/run/simulation.h>

#include <cstring>
#include <filesystem>

namespace Keyblock
{
  namespace
  {
    /** Throw InputError if the results of the run that wrote a @p state would
     * be overwritten in a @p folder. */
    void
    protect_results(const std::string &state, const std::string &folder)
    {
      std::error_code error;
      std::filesystem::path home = std::filesystem::path(state).parent_path();
      if (home.empty())
        home = ".";
      AssertThrow(!std::filesystem::equivalent(home, folder, error),
                  InputError("The output folder '" + folder +
                             "' has the results of the run that --factors "
                             "reads, which would be lost; choose another by "
                             "--output."));
    }
  } // namespace



  template <int dim>
  void
  Simulation<dim>::find_factors(const std::string &source)
  {
    watch_signals();
    if (!has_chosen_folder)
      folder.insert(folder.size() - 1, "-factors");
    // a state in the middle of factors could not say that no stage follows
    model.scene.output.checkpoint_interval = 0.;
    groups = std::make_unique<RankGroups>(model.communicator,
                                          model.scene.safety.rank_groups);
    const std::vector<KeptState> states =
      list_kept_states(model.communicator, source, model.scene);
    for (const KeptState &state : states)
      model.communicator.on_root(
        [&]() { protect_results(state.file, folder); });
    model.warnings.add(model.scene.warnings());
    model.make_geometry();
    for (const KeptState &state : states)
      {
        StateFile file(model.communicator, state.file);
        check_mesh(file, state.file, model.split);
      }
    set_up();
    if (groups->n() > 1 && !model.scene.safety.is_by_statics())
      group_study = std::make_unique<RankGroupStudy<dim>>(
        *groups, model, *parts, scene_file, overrides);
    open_output();
    try
      {
        find_factors(states);
        finish();
      }
    catch (const StopRequest &request)
      {
        model.out << "Stopped by a signal (" << strsignal(request.signal)
                  << "). The factors found so far stand above only; the same "
                     "command finds all of them anew."
                  << std::endl;
        throw;
      }
  }



  template <int dim>
  void
  Simulation<dim>::find_factors(const std::vector<KeptState> &states)
  {
    // factors of earlier stages are guesses for later ones, as in a run
    std::vector<SafetyFactor> factors;
    std::vector<VtuRecord> records;
    const double begin = parts->record.wall_start;
    for (const KeptState &state : states)
      {
        {
          StateFile file(model.communicator, state.file);
          parts->checkpointing.resume(file, state.file);
        }
        parts->record.wall_start     = begin; // the other run has told its own
        parts->record.safety_factors = factors;
        parts->record.present.wants_factors = state.is_wanted;
        parts->output.records               = records;
        if (state.is_wanted && group_study)
          group_study->find_factors();
        else if (state.is_wanted)
          parts->safety.find_remaining_factors(*groups);
        if (model.scene.output.write_vtu)
          parts->output.write_vtu(model.step->time);
        factors = parts->record.safety_factors;
        records = parts->output.records;
      }
  }

  template void Simulation<2>::find_factors(const std::string &);
  template void Simulation<3>::find_factors(const std::string &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_rank_group_study_h
#define keyblock_run_rank_group_study_h

#include <keyblock/run/run.h>

namespace Keyblock
{
  /**
   * Safety factors of a stage found by rank groups, each with a copy of the
   * model on its own ranks.
   */
  template <int dim>
  class RankGroupStudy
  {
  public:
    /** @param overrides of the entries of @p scene_file */
    RankGroupStudy(const RankGroups &groups,
                   Model<dim> &model,
                   Run<dim> &run,
                   const std::string &scene_file,
                   const std::vector<std::string> &overrides);

    /** Find the factors that are wanted after the present stage and not known
     * yet (collective over all ranks of all groups). */
    void find_factors();

  private:
    /** The run on the ranks of this group. */
    struct Copy
    {
      Copy(const Communicator &communicator,
           const Model<dim> &original,
           const std::string &scene_file,
           const std::vector<std::string> &overrides);

      Model<dim> model;
      std::unique_ptr<Run<dim>> run;
    };

    /** What a group found, or why it was stopped. */
    struct Result
    {
      std::vector<SafetyFactor> factors;
      unsigned int n_capped = 0; ///< contact groups
      int signal            = 0;
      std::string failure; ///< message of a ComputationError
    };

    /** What this group finds from the state in @p image (StateFile::image). */
    Result find_factors_of_this_group(std::vector<char> &image);

    const RankGroups &groups;
    Model<dim> &model;
    Run<dim> &run;
    std::string scene_file;
    std::vector<std::string> overrides;
    std::unique_ptr<Copy> copy;
  };
} // namespace Keyblock

#endif

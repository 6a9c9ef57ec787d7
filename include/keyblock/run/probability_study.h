// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_probability_study_h
#define keyblock_run_probability_study_h

#include <keyblock/blocks/block_geometry.h>
#include <keyblock/run/study_report.h>
#include <keyblock/run/varied_strengths.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Keyblock
{
  /**
   * Samples of a scene with the variables of `Study`, each judged by limit
   * equilibrium of rigid blocks after every stage that changes something; no
   * step is taken. At the level full those with a critical block are run, too,
   * each by one rank, and their critical blocks judged by strength reduction.
   * Ranks share the samples. Meshes are made anew only where a variable changes
   * more than strengths and loads, and the scene is read anew only where one
   * changes more than strengths of joints. samples.csv grows as the
   * study goes, and a study of the same scene in the same folder goes on from
   * there, also with more or fewer random samples; results of another one are
   * moved into a folder of their own. study.json has the results.
   */
  template <int dim>
  class ProbabilityStudy
  {
  public:
    /** Read and check the scene. Throws InputError (collective).
     * @param folder of the output; empty: as for a run */
    ProbabilityStudy(const Communicator &communicator,
                     const std::string &scene_file,
                     const std::vector<std::string> &overrides,
                     const std::string &folder);

    /** (collective) Throws StopRequest after a signal; what was done is kept.
     */
    void run();

  private:
    /** Values of the variables in all samples: by variable. */
    void draw();

    /** Whether a variable changes more than strengths and loads. */
    bool changes_geometry() const;

    BlockGeometry<dim> make_geometry(const Scene<dim> &sample) const;

    /** Whether samples differ in joints of sets alone. */
    bool draws_joints_alone() const;

    /** The scene of a sample, until the next one is asked for. */
    const Scene<dim> &scene_of(const unsigned int index) const;

    /** Overrides that give the variables these values. */
    std::vector<std::string>
    overrides_of(const std::vector<double> &drawn) const;

    /** Overrides that make a sample of the scene. */
    std::vector<std::string> overrides_of(const unsigned int index) const;

    /** Factors of blocks by limit equilibrium, once those that fail have gone,
     * and the stages of the least. */
    struct BlockFactors
    {
      // by block; infinite: it cannot move
      std::vector<double> factor; ///< the least, once others have gone, too
      std::vector<double> first;  ///< where none has gone

      std::vector<unsigned int> stage; ///< of first, Scene::stage_number
      std::vector<bool> is_exposed;    ///< in a stage, by block
    };

    BlockFactors judge_blocks(const Scene<dim> &sample,
                              const BlockGeometry<dim> &geometry) const;

    /** Run a sample and put the factors by strength reduction in place of those
     * by limit equilibrium. */
    void run_sample(const unsigned int index, BlockFactors &factors) const;

    /** @param may_run whether the level full is followed */
    SampleResult judge(const unsigned int index, const bool may_run) const;

    /** The same; errors name the sample. */
    SampleResult judge_named(const unsigned int index,
                             const bool may_run) const;

    /** Judge samples [begin, end) on all ranks (collective). */
    void judge_batch(const unsigned int begin, const unsigned int end);

    /** Entries that samples depend on, a line each: where they are drawn each
     * by itself not their number, and where the factors of all blocks are known
     * not the threshold. */
    std::string entries_of_samples(
      const std::vector<std::pair<std::string, std::string>> &entries) const;

    /** Rows of samples.csv that are there already, of this very study. */
    void read_samples();

    /** The rows of @p text that can be used, with the failures of the present
     * threshold; their numbers are appended to @p figures. */
    std::string take_rows(const std::string &text,
                          std::vector<double> &figures) const;

    /** Numbers of a row of samples.csv, but for its drawn values. */
    std::vector<double>
    figures_of_row(const std::vector<std::string> &fields) const;

    /** Let samples.csv have the rows that can be used, and no others; results
     * of another study are moved away first (on one rank). */
    void begin_table() const;
    void move_other_study_away() const;

    /** Append the samples from @p begin on. */
    void write_samples(const unsigned int begin) const;

    /** What samples.csv begins with: a digest of the scene, and names. */
    std::string make_header() const;

    /** Length of tunnel that a sample stands for [m]: in 2D 1, in 3D that of
     * the extruded excavations, or 0. */
    double length_of_tunnel() const;

    const Communicator communicator;
    const std::string scene_file;
    const std::vector<std::string> overrides;
    Scene<dim> scene;
    std::string folder;

    std::unique_ptr<VariedStrengths<dim>> strengths; ///< of the scene
    std::string header;
    mutable std::unique_ptr<Scene<dim>> sample;   ///< last one that was read
    std::unique_ptr<BlockGeometry<dim>> geometry; ///< null: one for each sample
    std::vector<std::vector<double>> values;
    std::vector<SampleResult> results;
    unsigned int n_resumed = 0; ///< samples that were there

    /** What read_samples() has found; on the first rank alone. */
    struct
    {
      std::string rows;            ///< that can be used
      unsigned int n_rows     = 0; ///< may be more than are asked for
      bool is_of_other_study  = false;
      bool is_as_it_should_be = false; ///< nothing has to be written anew
    } table;
  };
} // namespace Keyblock

#endif

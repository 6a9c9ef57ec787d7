// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_study_report_h
#define keyblock_run_study_report_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/safety/sample_statistics.h>

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace Keyblock
{
  /** What a study says of one sample. */
  struct SampleResult
  {
    double factor      = 0.; ///< the least of all; infinite: nothing can move
    unsigned int block = 0;  ///< its number in the block table; 0: none
    unsigned int stage = 0;  ///< Scene::stage_number; 0: none
    unsigned int n_exposed = 0;  ///< finite blocks with a free face in a stage
    unsigned int n_failed  = 0;  ///< of those, below the threshold
    double failed_volume   = 0.; ///< [m^dim]
    double rigid_factor    = 0.; ///< the least by limit equilibrium alone
    bool is_coarse         = false; ///< warnings_of_coarse_mesh() has some

    /** Least factor by block, where all samples have the same blocks. */
    std::vector<double> factors;
  };

  /** Numbers of a sample that do not belong to single blocks. */
  constexpr unsigned int n_sample_figures = 8;

  /** A result as numbers, n_sample_figures and one for each block. */
  std::vector<double> figures_of(const SampleResult &result);

  /** The result that @p n numbers from @p figures on are. */
  SampleResult result_of(const double *figures, const unsigned int n);

  /** Note how many blocks are below the threshold, and their volume.
   * @param factors by block */
  template <int dim>
  void count_failed(const Blocks<dim> &blocks,
                    const std::vector<double> &factors,
                    const double threshold,
                    SampleResult &result);

  /** The results of a study, for people and as JSON. */
  template <int dim>
  class StudyReport
  {
  public:
    /**
     * @param blocks of all samples; null: each has its own
     * @param values of the variables by variable and sample
     * @param mesh_warnings of the mesh that all samples share, if they do
     * @param length of tunnel that a sample stands for [m]; 0: not known
     * @param seconds that the samples took, but for the @p n_resumed first
     */
    StudyReport(const Scene<dim> &scene,
                const Blocks<dim> *blocks,
                const std::vector<std::vector<double>> &values,
                const std::vector<SampleResult> &results,
                const std::vector<std::string> &mesh_warnings,
                const double length,
                const double seconds,
                const unsigned int n_resumed);

    void print(std::ostream &out) const;

    /** @return whether the file could be written */
    bool write(const std::string &file_name) const;

  private:
    /** Probability that a sample among the first @p n has a block that fails.
     */
    ProbabilityEstimate probability_of(const std::size_t n) const;

    /** Probability of the same by limit equilibrium alone, over all samples. */
    ProbabilityEstimate rigid_probability() const;

    /** Probability that a block (by index) fails, over all samples. */
    ProbabilityEstimate probability_of_block(const unsigned int block) const;

    /** Size, probability and factors of the finite blocks. */
    nlohmann::ordered_json describe_blocks() const;

    /** What the mesh, or those of samples, have changed of blocks. */
    std::vector<std::string> warnings() const;

    /** Finite least factors of the samples. */
    std::vector<double> finite_factors() const;

    /** Those of @p factors that are values: neither infinite nor bounds. */
    std::vector<double> values_of(std::vector<double> factors) const;

    /** Whether a factor is only known to be above the highest one tried. */
    bool is_bound(const double factor) const;

    /** Share of the samples whose least factor is a bound. */
    double held_share() const;

    /** Rank correlation of a variable (by index) with the least factor, over
     * samples that have one. */
    double correlation_of(const unsigned int variable) const;

    const Scene<dim> &scene;
    const Blocks<dim> *blocks;
    const std::vector<std::vector<double>> &values;
    const std::vector<SampleResult> &results;
    std::vector<std::string> mesh_warnings;
    double length, seconds;
    unsigned int n_resumed;
    double mean_failed = 0., mean_volume = 0.; ///< per sample
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_run_estimate_h
#define keyblock_run_run_estimate_h

#include <keyblock/run/run.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Least and most of something. */
  struct EstimatedRange
  {
    double least = 0., most = 0.;

    void
    add(const double low, const double high)
    {
      least += low;
      most += high;
    }
  };

  /** What one stage will take. */
  struct StageForecast
  {
    std::string name;
    EstimatedRange steps;
    bool is_static    = false; ///< solved, not stepped
    bool has_end      = true;  ///< by its duration; else by its balance
    bool may_end_late = false; ///< at Maximum steps, before it is in balance
  };

  /**
   * Forecast of the time and memory that a run will take on processors of its
   * own: its first steps are made for up to a second, on the ranks that are
   * there, and counted on. Steps
   * of stages that end when forces are in balance, and trials of factors, are
   * counted by what scenes of the project take; they are ranges.
   */
  template <int dim>
  class RunEstimate
  {
  public:
    /** Make the first steps (collective): @p model is in another state
     * afterwards. Throws ComputationError if they fail. */
    RunEstimate(Model<dim> &model, Run<dim> &run);

    /** Two or three lines for people. */
    void print(std::ostream &out) const;

    std::vector<StageForecast> stages;
    double seconds_per_step = 0.; ///< [s]
    double static_seconds   = 0.; ///< of the first solve, or of the ramp's [s]
    unsigned int n_factors  = 0;  ///< blocks and stages that ask for one
    EstimatedRange trial_seconds; ///< of all of them [s]
    double memory = 0.;           ///< peak, of all ranks [bytes]

  private:
    /** Time some steps of the first stage that has any. */
    void time_steps();

    /** Steps of the @p stage (index). */
    StageForecast forecast(const unsigned int stage) const;

    /** Add the trials of factors after the @p stage (index). */
    void add_trials(const unsigned int stage);

    /** Bytes on this rank that the run takes besides what is there now. */
    double count_bytes_to_come() const;

    /** Seconds of all steps [s]. */
    EstimatedRange step_seconds() const;

    Model<dim> &model;
    Run<dim> &run;
    double ramp_steps = 0.; ///< of a ramp, if it is not given
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_python_any_run_h
#define keyblock_python_any_run_h

#include <keyblock/python/any_blocks.h>
#include <keyblock/run/simulation.h>

namespace Keyblock::Python
{
  /** How far a stage is. */
  struct Advance
  {
    std::string stage;
    double time            = 0.; ///< simulated [s]
    std::uint64_t step     = 0;  ///< of the stage
    double unbalance       = 0.; ///< unbalanced force ratio, as last measured
    double ramp_left       = 0.; ///< share of the excavation's ramp [-]
    unsigned int n_sliding = 0, n_open = 0; ///< contact points
  };

  /** A stage that was run. */
  struct StageResult
  {
    StageReport report;
    double time = 0.; ///< simulated, at its end [s]
  };

  /** A safety factor by strength reduction. */
  struct FactorResult
  {
    unsigned int block = 0; ///< id
    std::string stage, outcome;
    double value = 0.; ///< not a number if there is none
    double lower = 0., upper = 0.;
    std::string failure_mode;
    std::vector<unsigned int> group;
    double limit_factor = 0., stress_ratio = 0.;
    std::string limit_mode;
    unsigned int n_trials = 0;
    double seconds        = 0.;
  };

  /** The contact points of joints, n of them. */
  struct JointPointTable
  {
    std::vector<std::string> joint, state; ///< names
    Array<unsigned int> blocks; ///< ids on minus and plus side; 0: rock, (n, 2)
    Array<double> place, normal, slip, shear; ///< (n, dim) [m, -, m, Pa]
    Array<double> area, gap, pressure;        ///< (n) [m^(dim-1), m, Pa]
  };

  /** A run, stage by stage (all collective). */
  class AnyRun
  {
  public:
    explicit AnyRun(const bool is_verbose)
      : is_verbose(is_verbose)
    {}
    virtual ~AnyRun() = default;

    /** Mesh, set-up and initial state. Throws InputError.
     * @param folder of the output; empty: nothing is written
     * @param checkpoint to go on from, or empty */
    static std::shared_ptr<AnyRun>
    start(const std::shared_ptr<const AnyScene> &scene,
          const std::string &folder,
          const std::string &checkpoint,
          const bool is_verbose);

    /** All that can be checked without a step. Throws InputError; returns the
     * warnings of scene and set-up. */
    static std::vector<std::string>
    validate(const std::shared_ptr<const AnyScene> &scene,
             const bool is_verbose);

    /** Free what the run keeps; nothing else can be called afterwards. */
    virtual void close() = 0;

    virtual bool has_stage_left() const = 0;

    /** Run the next stage, or go on with that which was stopped.
     * @param watcher called every @p interval steps, if it is set */
    virtual StageResult
    run_stage(const std::function<void(const Advance &)> &watcher,
              const unsigned int interval) = 0;
    virtual void finish()                  = 0;

    virtual FactorResult find_factor(const unsigned int block)           = 0;
    virtual std::vector<FactorResult> factors() const                    = 0;
    virtual std::vector<std::string> warnings() const                    = 0;
    virtual std::shared_ptr<const AnyBlocks> blocks() const              = 0;
    virtual double time() const                                          = 0;
    virtual Array<double> displacement() const                           = 0;
    virtual Array<double> velocity() const                               = 0;
    virtual Array<double> stress() const                                 = 0;
    virtual JointPointTable joint_points() const                         = 0;
    virtual std::pair<std::vector<std::string>, Array<double>> history() = 0;

    const bool is_verbose; ///< whether the run says what it does
    bool is_finished = false;
  };

  template <int dim>
  class RunOf : public AnyRun
  {
  public:
    RunOf(const std::shared_ptr<const SceneOf<dim>> &scene,
          const std::string &folder,
          const std::string &checkpoint,
          const bool is_verbose);

    void close() override;
    bool has_stage_left() const override;
    StageResult run_stage(const std::function<void(const Advance &)> &watcher,
                          const unsigned int interval) override;
    void finish() override;
    FactorResult find_factor(const unsigned int block) override;
    std::vector<FactorResult> factors() const override;
    std::vector<std::string> warnings() const override;
    std::shared_ptr<const AnyBlocks> blocks() const override;
    double time() const override;

    /** Of the vertices [m], the last values of those that were dug away. */
    Array<double> displacement() const override;
    Array<double> velocity() const override;

    /** Mean stress of the cells, a tensor each [Pa]; not a number where there
     * is no deformable rock. */
    Array<double> stress() const override;

    /** Pairs whose sides are there; places at the start. */
    JointPointTable joint_points() const override;

    /** Columns and rows of history.csv. */
    std::pair<std::vector<std::string>, Array<double>> history() override;

  private:
    /** Throws InputError if it is closed. */
    Simulation<dim> &open() const;
    Array<double> by_vertex(const std::vector<double> &field) const;
    FactorResult describe(const SafetyFactor &factor) const;

    std::shared_ptr<const SceneOf<dim>> scene;   ///< keeps its text
    std::unique_ptr<Simulation<dim>> simulation; ///< null: closed
  };
} // namespace Keyblock::Python

#endif

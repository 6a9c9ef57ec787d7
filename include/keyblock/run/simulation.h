// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_simulation_h
#define keyblock_run_simulation_h

#include <keyblock/base/stop_request.h>
#include <keyblock/checkpoint/checkpoint.h>
#include <keyblock/geostress/geostress.h>
#include <keyblock/safety/safety_factor.h>
#include <keyblock/safety/slip_record.h>
#include <keyblock/verification/checks.h>

namespace Keyblock
{
  /** How far a stage has come. */
  template <int dim>
  struct StageProgress
  {
    unsigned int index       = 0; ///< into Scene::stages
    std::uint64_t first_step = 0; ///< of the run, when the stage began
    std::uint64_t n_planned  = 0; ///< steps
    std::uint64_t n_done     = 0;
    unsigned int n_vtu       = 0; ///< outputs written
    Overlap<dim> overlap;         ///< the deepest in them, so far
    bool has_removed   = false;   ///< a block, in the last step
    bool is_reported   = false;   ///< only safety factors are left
    bool wants_factors = false;
    SlipRecord slips;     ///< since the ramp has ended
    Snapshot<dim> before; ///< the state it began with, if it wants factors
  };

  /**
   * A run from scene to summary. Members stand in the order of the data; each
   * is built from references to earlier ones. run() tells the story.
   */
  template <int dim>
  class Simulation
  {
  public:
    /** Read and check the scene; nothing is computed or written.
     * @param checkpoint file to continue from, or empty */
    Simulation(const std::string &scene_file,
               const std::vector<std::string> &overrides,
               const std::string &output_folder,
               const std::string &checkpoint = "");

    /** Mesh, blocks and set-up, without time steps and without output. */
    void validate();

    /** From the start, or from the checkpoint, to the summary. A signal lets it
     * write a checkpoint and throw StopRequest. */
    void run();

    /** What the run works on, for tests and tools that look at the result. */
    const SplitMesh<dim> &
    geometry() const
    {
      return split;
    }
    const Contact<dim> *
    interface_contact() const
    {
      return contact.get();
    }

    /** Stresses of the deformable cells of this rank. */
    const CellArrays<dim> &
    cell_arrays() const
    {
      return cells;
    }

    const Fields<dim> &
    nodal_fields() const
    {
      return fields;
    }
    const Numbering<dim> &
    node_numbering() const
    {
      return *numbering;
    }

    /** Stable time step without damping, before the safety factor [s]. */
    double
    stable_step() const
    {
      return conditions->stable_step.limit(Stage());
    }

    /** Inertia moved within blocks in the present stage (step/active_cells.h).
     */
    const std::vector<MassScaling> &
    mass_scaling() const
    {
      return conditions->active_cells.mass_scaling;
    }

    /** What the monitors measured (rank 0). */
    const History &
    measured() const
    {
      return monitors->history;
    }

    /** Displacement, or velocity, of every vertex of the split mesh, dim values
     * each, the same on all ranks (collective). */
    std::vector<double> vertex_displacements() const;
    std::vector<double> vertex_velocities() const;

  private:
    std::vector<double>
    gather_by_vertex(const std::vector<double> &field) const;
    void make_geometry();
    void print_set_up(std::ostream &out);
    void print_stable_step(std::ostream &out) const;
    std::string names_of_joints_at(const Mesh<dim> &mesh,
                                   const unsigned int cell) const;

    /** What mass scaling does in the present stage, if that is news. */
    void print_mass_scaling(std::ostream &out);
    void set_up();
    void open_output();
    void run_stages();
    void establish_initial_state();
    void begin_stage(const unsigned int index);
    void complete_stage();
    void dig_stage(const Stage &stage, const unsigned int number);
    void step_through(const Stage &stage, StageProgress<dim> &progress);
    void solve_stage();
    /** Whether any was there to be removed. */
    bool remove_failed_blocks(const Stage &stage, StageProgress<dim> &progress);
    /** Blocks whose factor after a stage is wanted and not known. */
    std::vector<unsigned int>
    list_wanted_blocks(const unsigned int index) const;

    /** Those of them that this team looks at. */
    std::vector<unsigned int>
    list_blocks_of_team(const unsigned int index) const;

    /** Factor of a block that was removed in the stage. */
    SafetyFactor factor_of_failed_block(StrengthReductionSearch<dim> &search,
                                        const unsigned int block,
                                        const unsigned int index,
                                        const Snapshot<dim> &before);
    SafetyFactor factor_of_standing_block(StrengthReductionSearch<dim> &search,
                                          const unsigned int block,
                                          const unsigned int index);
    void find_safety_factors(const unsigned int index,
                             const Snapshot<dim> &before,
                             const Snapshot<dim> &after);

    /** Those of the present stage that are not known yet and are this team's,
     * on the ranks of world(). */
    void find_remaining_factors();

    /** The same for all teams, each with a copy of this run. */
    void find_factors_in_teams();

    /** What a team found, or why it was stopped. */
    struct TeamResult
    {
      std::vector<SafetyFactor> factors;
      unsigned int n_capped = 0; ///< contact groups
      int signal            = 0;
      std::string failure; ///< message of a ComputationError
    };

    /** All that restore() needs, as bytes (StateFile::image). */
    std::vector<char> state_image();

    /** What this team finds from the state in @p image. */
    TeamResult find_factors_of_team(std::vector<char> &image);

    /** This run on the ranks of world(), set up but without a state. */
    std::unique_ptr<Simulation> copy_set_up() const;
    bool holds_when_strong(const unsigned int block,
                           const unsigned int index,
                           const Snapshot<dim> &before);
    bool is_class_wanted(const unsigned int block,
                         const unsigned int number) const;
    void print_factor(const SafetyFactor &factor) const;
    RunParts<dim>
    parts()
    {
      return {*conditions, cells, fields, contact.get(), *step};
    }
    void pace_ramp(const Stage &stage);
    double ramp_duration_of(const Stage &stage) const;
    /** Deepest overlap of nodes and other blocks, now or before (collective).
     */
    void look_for_overlap(StageProgress<dim> &progress) const;

    void report_stage(const Stage &stage, const std::uint64_t n_steps);
    std::string name_what_moves(const StageProgress<dim> &progress) const;

    // Numbers that are not finite end the run with a ComputationError that
    // says which and where (run/finite_check.cc; all collective).

    /** Displacements and velocities of all nodes. */
    void check_finite();

    /** The same, stresses, and what was measured of the last step. */
    void check_state();

    /** Energies and the unbalanced force, as last sampled. */
    void check_sample();
    void check_factor(const SafetyFactor &factor);
    void check_history() const;

    /** The block and the step where the quantity @p what is at fault. */
    [[noreturn]] void fail_not_finite(const std::string &what,
                                      const unsigned int block);

    /** Whether all stages take a number of steps that can be made. Throws
     * InputError. */
    void check_durations() const;
    void report_progress(const unsigned int stage, const double fraction);
    void finish();

    /** Save the run if that is due, or stop it if a signal asks for that
     * (collective). */
    void save_if_due();
    void save();

    /** Add all that restore() needs to @p file. */
    void put_state(StateFile &file);
    void restore(StateFile &file);
    void exchange_progress(StateFile &file);
    void exchange_results(StateFile &file);
    void check_origin(StateFile &file) const;
    void check_mesh(StateFile &file) const;
    void save_and_stop(const StopRequest &request);

    /** Remember the checkpoint called @p name as the last complete one. */
    void note_checkpoint(const std::string &name);

    /** A sentence about where the last complete checkpoint is. */
    std::string name_last_checkpoint() const;
    void count_cells();

    /** Warn if there are joints but no pair of them. */
    void list_welded_joints();

    Scene<dim> scene;
    std::string scene_file;
    std::vector<std::string> overrides; ///< of its entries
    std::string folder;
    std::string checkpoint; ///< to continue from, or empty
    std::string command;    ///< that starts this run anew
    std::string last_checkpoint, restart_command; ///< of the run, if any
    Mesh<dim> mesh;
    MeshQuality quality;
    MeshReport<dim> mesh_report;
    std::vector<std::string> remarks; ///< warnings of the set-up
    Blocks<dim> blocks;
    SplitMesh<dim> split;
    std::unique_ptr<Numbering<dim>> numbering;
    CellArrays<dim> cells;
    Fields<dim> fields;
    std::unique_ptr<Conditions<dim>> conditions;
    std::unique_ptr<Contact<dim>> contact;
    std::unique_ptr<ExplicitStep<dim>> step;
    std::unique_ptr<Monitors<dim>> monitors;
    std::unique_ptr<Output<dim>> output;

    std::unique_ptr<Geostress> geostress;
    RunReport report;
    std::vector<StageReport> stage_reports;
    std::vector<SafetyFactor> safety_factors;
    std::unique_ptr<Simulation> team_copy;   ///< on the ranks of this team
    std::vector<unsigned int> removal_stage; ///< number, by block; 0: there
    bool is_trial        = false;            ///< nothing is recorded or printed
    double wall_start    = 0.;
    double last_progress = 0.;
    double last_saved    = 0.; ///< wall time of the last checkpoint [s]
    StageProgress<dim> present;
    bool is_converged = true;
    std::vector<double> stage_start_displacement;
    unsigned long long n_cells_global = 0;
    std::string mass_scaling_text; ///< as it was last printed
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_step_h
#define keyblock_step_step_h

#include <keyblock/contact/contact.h>
#include <keyblock/step/conditions.h>
#include <keyblock/step/deformation_damping.h>
#include <keyblock/step/energy_ledger.h>
#include <keyblock/step/resting_cells.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace Keyblock
{
  /** All that the step remembers besides the arrays. */
  struct StepState
  {
    double time           = 0.; ///< of displacements [s]
    std::uint64_t n_steps = 0;
    double dt             = 0.;
    Energies energies; ///< as of the last sampled step

    /** Sum of |unbalanced force| on free nodes over the sum of |driving force|,
     * as last sampled [-]. What drives is what excavated cells carried, in a
     * stage that excavates; else loads, else reactions. */
    double unbalanced_ratio = 0.;

    /** Largest unbalanced force of a node over the mean force, the same [-]. */
    double largest_nodal_ratio = 0.;

    /** Save all but the settings of the stage under @p group, or read it
     * (StateFile::exchange). */
    template <typename File>
    void exchange(File &file, const std::string &group);

  protected:
    Stage stage;
    double kick            = 0.;   ///< h of the present step [s]
    double previous_dt     = 0.;   ///< length of the last move [s]
    bool starts_at_rest    = true; ///< the next kick is a half one
    bool is_first          = true; ///< of the stage
    bool is_stress_current = true; ///< contains the last move
    LedgerState work;
    double out_of_balance_sum = 0.; ///< of |force| of the cells excavated [N]
  };

  /**
   * One explicit step, the verbs in order: force, predict, contact, move.
   * Velocities live at half steps; the first kick of a stage that starts from
   * rest is a half one (doc/theory.md, equations 1 to 6).
   */
  template <int dim>
  class ExplicitStep : public StepState
  {
  public:
    ExplicitStep(const Scene<dim> &scene,
                 const SplitMesh<dim> &split,
                 const Blocks<dim> &blocks,
                 const Numbering<dim> &numbering,
                 Conditions<dim> &conditions,
                 CellArrays<dim> &cells,
                 Fields<dim> &fields,
                 Contact<dim> *contact);

    /** Prepare (after `excavate`, if it excavates) stage @p number
     * (Scene::stage_number); returns the length of its steps [s]. */
    double begin_stage(const Stage &stage, const unsigned int number);

    /** Go on within stage @p number, in a state read from a file. */
    void resume(const Stage &stage, const unsigned int number);

    /** Bring stresses and forces up to the present displacements. */
    void update_forces();

    /** Solve contact for bodies at rest, without moving them: forces of points
     * and contact_force are those that hold them. */
    void settle_contact();

    /**
     * Go to stage @p number (Conditions::excavate). Returns the forces that
     * keep the owned degrees of freedom balanced all the same: what excavated
     * cells carried, what new loads ask for [N].
     */
    std::vector<double> excavate(const unsigned int number);

    /** Size of @p out_of_balance (as from `excavate`) over the largest of this
     * stage (collective) [-]. */
    double share_of_excavated(const std::vector<double> &out_of_balance) const;

    /** The next stage has excavated nothing yet. */
    void
    forget_excavated_cells()
    {
      out_of_balance_sum = work.excavated_energy = 0.;
    }

    /** Add the elastic response to the displacement increment @p change (local
     * degrees of freedom), as of a static solve. */
    void add_displacement(const std::vector<double> &change);

    /** Take displacements from here on from the present state. */
    void zero_displacements();

    /** Set all velocities to zero; the next kick is a half one. */
    void stop_motion();

    /** Whether steps leave the time as it is (StageClock::stands). */
    void
    hold_time(const bool is_held)
    {
      conditions.clock.stand(is_held);
    }

    /** Mass damping [1/s], for the rest of the stage. */
    void
    set_mass_damping(const double rate)
    {
      stage.mass_damping = rate;
    }

    /** Call the masses' users after they changed, and take the step they
     * allow. Returns its length [s]. Throws InputError (count_steps). */
    double choose_step(const unsigned int number);

    /** The forces that keep the owned degrees of freedom balanced as they are,
     * those of a ramp that runs included [N]. */
    std::vector<double> list_out_of_balance() const;

    /** The longest step [s] that masses, damping and the scene allow in
     * @p stage. */
    double longest_step(const Stage &stage) const;

    /** Measure the energies of a state that has not moved yet (collective). */
    void sample_start();

    StepState
    remember() const
    {
      return *this;
    }
    void
    recall(const StepState &state)
    {
      StepState::operator=(state);
    }

    /** Advance by one step; returns its length [s]. With @p sample the
     * energies and the unbalanced force are measured. */
    double advance(const bool sample);

    /** Measure unbalanced_ratio and largest_nodal_ratio (collective). */
    void sample_unbalanced_force();

    /** Whether the work of all forces is added up. */
    bool keeps_ledger;

    /** Whether cells where nothing moves may be left out of steps; forces are
     * then complete after sampled steps only. */
    bool skips_resting;

    /** Steps of cells left out so far, on this rank. */
    double n_skipped = 0.;

    double contact_seconds = 0.; ///< wall time spent in contact
    double force_seconds   = 0.; ///< wall time spent in cell forces

  private:
    /** Take friction and damping from @p stage. */
    void apply_settings(const Stage &stage);
    const double *positions() const;
    /** The force verb of a step: of all cells, or those that do not rest; what
     * rests is chosen anew from time to time. */
    void update_internal_force(const bool of_all);
    void compute_internal_force(const bool with_resting = true);
    /** Whether cells at rest stay so until the next check, and can be told. */
    bool may_rest() const;
    /** Whether forces by velocities act: stiffness damping, dashpots. */
    bool has_damping_force() const;
    /** Choose the cells to leave out until the next check. */
    void look_for_rest();
    /** Kick all nodes; with @p moves_inner the inner ones move as well. */
    void predict_nodes(const bool moves_inner);
    void resolve_contact();

    /** What the ledger has to know of this step. */
    LedgerStep ledger_step() const;

    /** Move the outer nodes and the ghosts, and book the work done on them;
     * or all nodes, whose work has been booked. */
    void move_nodes(const bool with_inner);

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    Conditions<dim> &conditions;
    CellArrays<dim> &cells;
    Fields<dim> &fields;
    Contact<dim> *contact;
    RestingCells<dim> resting;
    DeformationDamping<dim> deformation_damping;
    EnergyLedger<dim> ledger;
    unsigned int n_searches_seen = none; ///< of contact
  };



  template <typename File>
  void
  StepState::exchange(File &file, const std::string &group)
  {
    file.exchange(group + "time", time);
    file.exchange(group + "n_steps", n_steps);
    file.exchange(group + "dt", dt);
    file.exchange(group + "unbalanced_ratio", unbalanced_ratio);
    file.exchange(group + "largest_nodal_ratio", largest_nodal_ratio);
    file.exchange(group + "kick", kick);
    file.exchange(group + "previous_dt", previous_dt);
    file.exchange(group + "starts_at_rest", starts_at_rest);
    file.exchange(group + "is_first", is_first);
    file.exchange(group + "is_stress_current", is_stress_current);
    file.exchange(group + "out_of_balance_sum", out_of_balance_sum);

    const auto sampled = energies.as_array();
    std::vector<double> list(sampled.begin(), sampled.end());
    file.exchange(group + "energies", list);
    std::array<double, n_energy_terms> terms;
    std::copy(list.begin(), list.end(), terms.begin());
    energies = Energies::from_array(terms);

    work.exchange(file, group);
  }
} // namespace Keyblock

#endif

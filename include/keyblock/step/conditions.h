// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_conditions_h
#define keyblock_step_conditions_h

#include <keyblock/step/active_cells.h>
#include <keyblock/step/bolts.h>
#include <keyblock/step/far_field_springs.h>
#include <keyblock/step/loads.h>
#include <keyblock/step/quiet_boundary.h>
#include <keyblock/step/shotcrete.h>
#include <keyblock/step/stage_clock.h>
#include <keyblock/step/structural_liner.h>
#include <keyblock/step/supports.h>
#include <keyblock/step/trial_pressure.h>

#include <algorithm>

namespace Keyblock
{
  /** What has been excavated, taken away, ramped and let go so far. */
  struct StageState
  {
    CellState cells;
    LoadState loads;
    std::vector<double> stage_begins; ///< StageClock::state [s]
    std::vector<ForceElementState> elements;
    double trial_pressure = 0.; ///< zero but in trials: not in files [Pa]
  };

  /**
   * From the scene to the arrays of the hot loops: the cells that are there,
   * supports, loads and force elements, and the order in which they follow from
   * each other.
   */
  template <int dim>
  class Conditions
  {
  public:
    Conditions(const Scene<dim> &scene,
               const SplitMesh<dim> &split,
               const Numbering<dim> &numbering,
               CellArrays<dim> &cells,
               Fields<dim> &fields);

    /**
     * Go to stage @p number (Scene::stage_number): take away the cells that are
     * excavated, put in those that are filled, apply the tractions of the
     * stage; cells, masses, supports and tractions are made anew, stresses of
     * the cells that stay are kept. What the excavated cells carried is left
     * unbalanced.
     */
    void excavate(const unsigned int number);

    /** Whether stage @p number excavates, fills or loads anything. */
    bool
    changes(const unsigned int number) const
    {
      return is_changing(scene, number);
    }

    /** Leave out cells that stay as they are, and hold all their nodes; by mesh
     * cell. Empty: none (see recall). */
    void freeze(const std::vector<bool> &is_frozen_cell);

    /** (collective) */
    StageState remember() const;

    /** Go back to a state; cells and fields are those of its stage, but with
     * the stresses and motions of now (collective). */
    void recall(const StageState &state);

    /** Take up a state of another run; stresses are to be put in afterwards. */
    void resume(const StageState &state);

    /** Use masses that give all cells the lowest frequency of them, or not
     * (ActiveCells::scale_density). */
    void scale_density(const bool is_scaled);

    /** Prepare for stiffness-proportional damping of this ratio [-]. */
    void set_damping(const Stage &stage);

    /** Whether an element has a force by velocities. */
    bool
    has_viscous_elements() const
    {
      return std::any_of(elements.begin(), elements.end(), [](const auto &e) {
        return e->is_viscous();
      });
    }

    /** Whether supports of the scene let go after the initial state. */
    bool
    releases_supports() const
    {
      return far_field != nullptr || quiet != nullptr;
    }

    /** Replace the far-field supports by springs, and those that are quiet from
     * the start by dashpots, and what they carry now by a dead load; needs the
     * present internal force and load.
     * @return a sentence if there is something to say of them, or empty */
    std::string release_supports();

    /** Whether set_load sets other values from step to step. */
    bool is_load_changing() const;

    /** What force elements took out of the rock as waves in the step whose
     * velocities the fields have, on this rank [J]. */
    double radiated_work(const double kick) const;

    /** The strength of joints is divided for a trial: what holds blocks besides
     * may follow. */
    void reduce_strength(const StrengthReduction &reduction);

    /** Ways of blocks without support (ForceElement::take_ways). */
    void take_ways(const std::vector<Tensor<1, dim>> &ways);

    /** Bolts that are installed, and what they do. */
    std::vector<BoltReport<dim>>
    report_bolts() const
    {
      return bolts ? bolts->report() : std::vector<BoltReport<dim>>();
    }

    /** Segments of bolts that have broken. */
    BrokenSegments
    broken_segments() const
    {
      return bolts ? bolts->broken_segments() : BrokenSegments();
    }

    /** What shotcrete bears. */
    std::vector<LinerReport>
    report_liners() const
    {
      return shotcrete ? shotcrete->report() : std::vector<LinerReport>();
    }

    /** What structural liners bear. */
    std::vector<LinerLoads<dim>>
    report_structural_liners() const
    {
      return liners ? liners->report() : std::vector<LinerLoads<dim>>();
    }

    /** Set fields.load to all loads at @p time. */
    void set_load(const double time);

    /** Supports::apply_supports, with the displacements that are ramped. */
    void apply_supports(const double time, const double step);

    StageClock clock;
    ActiveCells<dim> active_cells;
    Supports<dim> supports;
    Loads<dim> loads;
    ForceElements<dim> elements;
    TrialPressure<dim> trial_pressure;

    StableStep<dim> stable_step; ///< of the masses in use and all elements

    /** Highest frequency with shotcrete and structural liners over that without
     * them [-]. */
    double frequency_ratio_of_liners = 1.;
    double frequency_ratio_of_traces = 1.; ///< the same of shotcrete alone

  private:
    void make_elements();

    /** What supports give to the rock now, on owned degrees of freedom [N]. */
    std::vector<double> reaction() const;
    void set_up_supports();

    /** Take up a state; excavate is to follow if its cells are others. */
    void take_up(const StageState &state);

    /** Add what force elements have of inertia to the masses (collective). */
    void add_masses(const bool is_scaled);

    /** List the nodes that may move, in runs (Fields::runs). */
    void list_moving_nodes();

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    Fields<dim> &fields;

    FarFieldSprings<dim> *far_field = nullptr; ///< one of elements, if any
    Bolts<dim> *bolts               = nullptr; ///< the same
    Shotcrete<dim> *shotcrete       = nullptr; ///< the same
    StructuralLiners<dim> *liners   = nullptr; ///< the same
    QuietBoundary<dim> *quiet       = nullptr; ///< the same
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_set_up_h
#define keyblock_step_set_up_h

#include <keyblock/base/expression.h>
#include <keyblock/blocks/ground.h>
#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>
#include <keyblock/rock/mass_scaling.h>
#include <keyblock/step/step_spread.h>

#include <map>
#include <memory>

namespace Keyblock
{
  /** A load on one node that depends on position and time. */
  template <int dim>
  struct NodalTraction
  {
    unsigned int node;
    unsigned int traction; ///< index into Scene::tractions
    double area;           ///< [m^(dim-1)]
    Point<dim> place;      ///< of the face's centre [m]
  };

  /** Cell that sets the time step, and the step it allows. */
  template <int dim>
  struct StableStep
  {
    double frequency = 0.; ///< highest of all cells [rad/s]
    Point<dim> place;      ///< centre of that cell [m]

    /**
     * Stable step under a stage's damping: y = omega dt / 2 of the velocity
     * that alternates from step to step obeys (1 + alpha) (y^2 + 2 c y) <= 1
     * with c = zeta + a / (2 omega); stiffness damping zeta, mass damping a,
     * local damping alpha. Without mass and local damping that is 2 / omega
     * (sqrt(1 + zeta^2) - zeta) [s].
     */
    double limit(const Stage &stage) const;

    /** Mass damping besides that of the stage with which steps of @p dt are
     * still stable [1/s]. */
    double mass_damping_left(const Stage &stage, const double dt) const;
  };

  /** What has been dug, taken away and ramped so far. */
  struct StageState
  {
    unsigned int stage_number = 0;
    std::vector<bool> is_removed;                       ///< by block
    std::vector<bool> is_frozen;                        ///< by mesh cell
    std::vector<double> carried_force, far_field_force; ///< [N]
    double ramp_duration = 0., ramp_progress = 1., ramp_pace = 1.;
    double share_carried   = 0.;
    bool is_far_field_free = false;
  };

  /**
   * From the scene to the arrays of the hot loops: masses, supports, loads,
   * initial stress and velocity, and the frequency of every cell.
   */
  template <int dim>
  class Conditions : private StageState
  {
  public:
    Conditions(const Scene<dim> &scene,
               const SplitMesh<dim> &split,
               const Numbering<dim> &numbering,
               CellArrays<dim> &cells,
               Fields<dim> &fields);

    /** Set cells.beta for stiffness-proportional damping. */
    void set_damping(const double damping_ratio);

    /**
     * Go to stage @p number (Scene::stage_number): take away the cells that are
     * dug, put in those that are filled, apply the tractions of the stage;
     * cells, masses, supports and tractions are made anew, stresses of the
     * cells that stay are kept. What the dug cells carried is left unbalanced.
     */
    void dig(const unsigned int number);

    /** Take a block away, as if it were dug in the present stage. */
    void remove_block(const unsigned int block);

    /** Leave out cells that stay as they are, and hold all their nodes; by mesh
     * cell. Empty: none (see recall). */
    void freeze(const std::vector<bool> &is_frozen_cell);

    bool
    is_removed_block(const unsigned int block) const
    {
      return !is_removed.empty() && is_removed[block];
    }

    StageState
    remember() const
    {
      return *this;
    }

    /** Go back to a state; cells and fields are those of its stage, but with
     * the stresses and motions of now. */
    void recall(const StageState &state);

    /** Take up a state of another run; stresses are to be put in afterwards. */
    void resume(const StageState &state);

    /** Divide the strength of all rock by 1 / @p share. */
    void reduce_strength(const double share);

    /** Whether stage @p number digs, fills or loads anything. */
    bool changes(const unsigned int number) const;

    /** Use masses that give all cells the lowest frequency of them, or those
     * of `mass_scaling`, the true ones without it. Gravity is not affected. */
    void scale_density(const bool is_scaled);

    /**
     * Add @p force (owned degrees of freedom) to the load and take it away
     * over @p duration, as half a cosine [N, s]. Displacements of supports grow
     * with it. Duration 0: nothing is added, and they are reached at once.
     */
    void start_ramp(const std::vector<double> &force, const double duration);

    /** Move on by a step [s] times the pace. */
    void advance_ramp(const double step);

    /** Slow the ramp down, where it would outrun the rock: 0 to 1 [-]. */
    void
    set_ramp_pace(const double pace)
    {
      ramp_pace = pace;
    }

    /** Whether set_load sets other values from step to step. */
    bool
    is_load_changing() const
    {
      return !is_load_constant || is_ramping();
    }

    bool
    is_ramping() const
    {
      return ramp_progress < 1.;
    }

    /** Share of what the stage ramps out that is left now [-]. */
    double
    ramp_share_left() const
    {
      return is_ramping() ? share_left_at(ramp_progress) : 0.;
    }

    bool has_far_field() const;

    /** Replace the far-field supports by springs (rock/far_field.h), and what
     * they carry now by a dead load; needs the present internal force and load.
     */
    void release_far_field();

    /** Set fields.load to gravity, tractions and ramped forces at @p time. */
    void set_load(const double time);

    /** Remove held components of fields.velocity and put in those prescribed
     * for the step from @p time to time + @p step, on owned nodes. */
    void apply_supports(const double time, const double step);

    /** Take the held components out of @p force (owned degrees of freedom). */
    void remove_held_components(std::vector<double> &force) const;

    /** Displacement [m] that a support prescribes at the end of the ramp. */
    Tensor<1, dim> prescribed_displacement(const NodeSupport<dim> &s) const;

    /** What is there now. */
    Ground<dim>
    ground() const
    {
      return {scene, split, stage_number, &is_removed};
    }

    bool
    is_dug(const unsigned int mesh_cell) const
    {
      return ground().is_dug(mesh_cell);
    }

    /** Index into Scene::materials, that of the fill where it is filled. */
    unsigned int
    material_of(const unsigned int mesh_cell) const
    {
      return ground().material_of(mesh_cell);
    }

    StableStep<dim> stable_step;   ///< of the masses in use
    std::vector<double> frequency; ///< of each deformable cell here [rad/s]

    /** Inertia shared out anew within blocks (Time stepping/Least step): one
     * entry for each block, the last for rock that is dug later. Empty: none.
     */
    std::vector<MassScaling> mass_scaling;

  private:
    /** Share of the ramped force that is left [-]. */
    double share_left_at(const double progress) const;
    double next_progress(const double step) const;
    void read_formulas();
    void list_cells();
    void hold_frozen_nodes();
    void list_moving_nodes();
    void set_up_frequencies();
    void set_up_mass_scaling();

    void share_out_masses();

    /** Of the block of a cell of `cells`; null without mass_scaling. */
    const MassScaling *scaling_of(const unsigned int cell) const;
    double density_of(const unsigned int mesh_cell) const;
    std::array<std::array<double, dim>, 1 << dim>
    corners_of(const unsigned int mesh_cell) const;

    /** Mass by node [kg], with @p density(cell, true density) [kg/m3]. */
    template <typename Density>
    std::vector<double> sum_masses(const Density &density) const;
    void set_up_far_field();
    void bound_step_by_far_field();
    void set_up_mass();
    void set_up_supports();
    void set_up_tractions();
    void set_up_water();
    void set_up_initial_state();

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    CellArrays<dim> &cells;
    Fields<dim> &fields;

    std::unique_ptr<Expression<dim>> gravity;
    std::vector<std::unique_ptr<Expression<dim>>> motions, tractions;
    std::vector<NodalTraction<dim>> nodal_tractions;
    std::vector<bool> is_displacement; ///< one per motion
    /** Of water in joints, by degree of freedom [N]. */
    std::vector<std::pair<unsigned int, double>> water_forces;
    bool is_load_constant = true;
    bool is_load_set      = false;

    std::vector<unsigned int> cell_of_local; ///< into cells, or `none`
    StableStep<dim> unscaled_step; ///< of masses that are not all scaled
    double lowest_frequency = 0.;  ///< of all cells [rad/s]
  };
} // namespace Keyblock

#endif

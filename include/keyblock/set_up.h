// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_set_up_h
#define keyblock_set_up_h

#include <keyblock/dofs.h>
#include <keyblock/expression.h>
#include <keyblock/fields.h>
#include <keyblock/internal_force.h>

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
  };

  /**
   * From the scene to the arrays of the hot loops: masses, supports, loads,
   * initial stress and velocity, and the frequency of every cell.
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

    /** Set cells.beta for stiffness-proportional damping. */
    void set_damping(const double damping_ratio);

    /** Set fields.load to gravity and tractions at @p time. */
    void set_load(const double time);

    /** Remove held components of fields.velocity and put in prescribed ones
     * at @p time, on owned nodes. */
    void apply_supports(const double time);

    StableStep<dim> stable_step;
    std::vector<double> frequency; ///< of each deformable cell here [rad/s]

  private:
    void set_up_cells();
    void set_up_mass();
    void set_up_supports();
    void set_up_tractions();
    void set_up_initial_state();

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    CellArrays<dim> &cells;
    Fields<dim> &fields;

    std::unique_ptr<Expression<dim>> gravity;
    std::vector<std::unique_ptr<Expression<dim>>> motions, tractions;
    std::vector<NodalTraction<dim>> nodal_tractions;
    bool is_load_constant = true;
    bool is_load_set      = false;
  };
} // namespace Keyblock

#endif

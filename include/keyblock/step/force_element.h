// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_force_element_h
#define keyblock_step_force_element_h

#include <keyblock/blocks/ground.h>
#include <keyblock/contact/state.h>
#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/step/stable_step.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dealii
{
  template <typename>
  class FullMatrix;
} // namespace dealii

namespace Keyblock
{
  /** What a force element remembers besides the motion of its nodes: enough to
   * go back to it, on any number of ranks. */
  struct ForceElementState
  {
    std::string name;            ///< of the element
    std::vector<double> numbers; ///< the same on every rank
    std::vector<double> nodal;   ///< dim per owned node, or empty
  };

  /** What forces by velocities are taken from. */
  template <int dim>
  struct MotionOfStep
  {
    const Fields<dim> &fields; ///< velocities before the kick, other forces
    double time;               ///< [s]
    double step;               ///< since forces were asked for last; 0: again
    double kick;               ///< [s]
    double mass_damping;       ///< of the stage [1/s]
    double stiffness_damping;  ///< of the stage, but for Damping ratio [s]
  };

  /** Stiffness W C W^T that couples many nodes, of low rank. */
  struct CoupledStiffness
  {
    std::vector<std::vector<double>> columns; ///< W, each by owned dof
    std::shared_ptr<const dealii::FullMatrix<double>> coupling; ///< C
  };

  /**
   * What acts on nodes besides cells, contact and loads: the springs of the far
   * field, and whatever else is of that kind (bolts, dashpots of a quiet
   * boundary, a lining). The step adds the forces of all of them, takes in the
   * bounds they set it, and books their energies; checkpoints keep their
   * states. A new kind is a class like FarFieldSprings
   * (step/far_field_springs.h) and a line in
   * Conditions::make_elements.
   *
   * Nodes are local ones and never hang; forces count on owned nodes, as the
   * internal force does: against what they do to the rock.
   */
  template <int dim>
  class ForceElement
  {
  public:
    virtual ~ForceElement() = default;

    /** Of its own: under it a checkpoint keeps the state. */
    virtual std::string name() const = 0;

    /** Cells have come or gone, or a stage with other ones begins. */
    virtual void
    take_ground(const Ground<dim> &)
    {}

    /** The strength of joints is divided for a trial, or no longer. */
    virtual void
    reduce_strength(const StrengthReduction &)
    {}

    /** Before that: the ways (unit vectors, by block) that blocks would take
     * without support; zero, or behind the last: not known. */
    virtual void
    take_ways(const std::vector<Tensor<1, dim>> &)
    {}

    /** Owned nodes on which it acts. */
    virtual std::vector<unsigned int> nodes() const = 0;

    /** Add the force at @p displacement (of local degrees of freedom), which
     * may be asked for more than once (collective) [m, N]. */
    virtual void add_force(const std::vector<double> &displacement,
                           std::vector<double> &force) = 0;

    /** Velocities are set to zero. */
    virtual void
    stop_motion()
    {}

    /** Whether it has a force by velocities. */
    virtual bool
    is_viscous() const
    {
      return false;
    }

    /** Add that, to the damping force of the step (collective) [N]. */
    virtual void
    add_damping_force(const MotionOfStep<dim> &, std::vector<double> &)
    {}

    /** This rank's share of what that force takes out of the model in the step
     * whose velocities @p fields has, if it leaves as waves and not as heat;
     * its nodes are outer ones (Fields::runs) [J]. */
    virtual double
    damping_work(const Fields<dim> &, const double) const
    {
      return 0.;
    }

    /** Whether add_load adds other values from step to step. */
    virtual bool
    is_load_changing() const
    {
      return false;
    }

    /** Add what it puts on nodes whatever they do, to the load at a time [s,
     * N]. */
    virtual void
    add_load(const double, std::vector<double> &) const
    {}

    /** What it takes its inertia from. */
    struct Inertia
    {
      double frequency;     ///< highest of the cells [rad/s]
      bool has_equal_steps; ///< masses are not the true ones: as large as keeps
                            ///< that frequency
    };

    /** Add its own inertia to the mass of owned nodes, before step_bound() is
     * asked for [kg]. */
    virtual void
    add_mass(const Inertia &, std::vector<double> &)
    {}

    /** How it shortens the step, given an inverse mass per node (collective)
     * [1/kg]. */
    virtual StepBound
    step_bound(const std::vector<double> &inverse_mass) const = 0;

    /** This rank's share of what is stored (collective) [J]. */
    virtual double
    stored_energy(const std::vector<double> &displacement) const = 0;

    /** This rank's share of what plastic strains have dissipated, ever [J]. */
    virtual double
    plastic_work() const
    {
      return 0.;
    }

    /** A stiffness matrix and its local degrees of freedom [N/m]. */
    using AddStiffness =
      std::function<void(const std::vector<unsigned int> &dofs,
                         const dealii::FullMatrix<double> &stiffness)>;

    /** Call @p add for each piece of the stiffness, for static solutions: on
     * one rank, where all of its degrees of freedom are local. */
    virtual void
    for_each_stiffness(const AddStiffness &) const
    {}

    /** Whether a part of its present stiffness is told by add_product() (the
     * same on every rank). */
    virtual bool
    has_product() const
    {
      return false;
    }

    /** Add the product of that part with @p displacement to @p force, both of
     * local degrees of freedom, of which owned ones count (collective) [m, N].
     */
    virtual void
    add_product(const std::vector<double> &, std::vector<double> &)
    {}

    /** The part of the stiffness that has no small pieces. */
    virtual CoupledStiffness
    coupled_stiffness() const
    {
      return {};
    }

    /** (collective) */
    virtual ForceElementState remember() const = 0;

    /** Take up a state that remember() gave, or the one of a run that is
     * continued (collective). */
    virtual void recall(const ForceElementState &state) = 0;
  };

  template <int dim>
  using ForceElements = std::vector<std::unique_ptr<ForceElement<dim>>>;
} // namespace Keyblock

#endif

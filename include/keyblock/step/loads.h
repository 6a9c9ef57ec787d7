// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_loads_h
#define keyblock_step_loads_h

#include <keyblock/base/expression.h>
#include <keyblock/blocks/face_quadrature.h>
#include <keyblock/blocks/ground.h>
#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/step/body_acceleration.h>
#include <keyblock/step/ramp.h>

#include <functional>
#include <memory>
#include <utility>

namespace Keyblock
{
  /** A quadrature point of a face at which a traction or a pressure that
   * depends on time is taken, and the shares of the face's nodes in it. */
  template <int dim, typename Area>
  struct LoadPoint
  {
    unsigned int formula; ///< index into Scene::tractions or Scene::joints
    Point<dim> place;

    /** Owned nodes, and the areas that are theirs: those of pressures point
     * the way that they push [m^(dim-1)]. */
    std::vector<std::pair<unsigned int, Area>> areas;
  };

  /** What is ramped out, and how far it is. */
  struct LoadState
  {
    Ramp ramp;
    std::vector<double>
      out_of_balance_force; ///< by owned degree of freedom [N]

    /** Share of the supports' displacements that is not reached yet, and of
     * what was left of them when the ramp began, if they go with it [-]. */
    double displacement_left = 1., displacement_ramped = 0.;
  };

  /** Gravity, tractions, water in joints, and forces that are taken away over
   * a time. */
  template <int dim>
  class Loads : private LoadState
  {
  public:
    Loads(const Scene<dim> &scene,
          const SplitMesh<dim> &split,
          const Numbering<dim> &numbering,
          Fields<dim> &fields);

    /** Find the nodes that tractions and water act on in @p ground. */
    void set_up(const Ground<dim> &ground);

    /**
     * Add @p force (owned degrees of freedom) to the load and take it away
     * over @p duration, as half a cosine [N, s]; nothing if it is zero. What is
     * left of the displacements of supports grows with it if
     * @p moves_supports.
     */
    void start_ramp(const std::vector<double> &force,
                    const double duration,
                    const bool moves_supports);

    /** Whether displacements of supports are still to be reached. */
    bool
    has_displacement_left() const
    {
      return displacement_left > 0.;
    }

    /** What is left of the supports' displacements is reached now; the share
     * that this is [-]. */
    double
    take_displacement()
    {
      return std::exchange(displacement_left, 0.);
    }

    /** Move on by a step [s] times the pace. */
    void advance_ramp(const double step);

    /** Slow the ramp down, where it would outrun the rock: 0 to 1 [-]. */
    void
    set_ramp_pace(const double pace)
    {
      ramp.pace = pace;
    }

    bool
    is_ramping() const
    {
      return ramp.is_running();
    }

    /** Share of what the stage ramps out that is left now [-]. */
    double
    ramp_share_left() const
    {
      return is_ramping() ? ramp.share_left() : 0.;
    }

    /** Share of the supports' displacements that is reached in the next step of
     * this length [s -> -]. */
    double
    displacement_share_of_step(const double step) const
    {
      return displacement_ramped * ramp.share_of_step(step);
    }

    /** Whether set_load sets other values from step to step. */
    bool
    is_load_changing() const
    {
      return !is_constant || is_water_varying || is_ramping();
    }

    /** Set fields.load to gravity, water, tractions and ramped forces at
     * @p time. Returns whether it had to: else they are what they were. */
    bool set_load(const double time);

    /** Let the next call of set_load set all values. */
    void
    forget_load()
    {
      is_set = false;
    }

    const LoadState &
    state() const
    {
      return *this;
    }

    void
    recall(const LoadState &other)
    {
      LoadState::operator=(other);
      forget_load();
    }

  private:
    void read_formulas();
    void set_up_tractions(const Ground<dim> &ground);
    void set_up_water(const Ground<dim> &ground);

    /**
     * Let a load act on the nodes of a face: one that is steady as forces, one
     * that is @p is_varying by points that are added to @p varying.
     * @param formula index into Scene::tractions or Scene::joints
     * @param value_at of a place, at time zero [Pa]
     * @param area_of of a FacePoint, outward: times the value it is the force
     *        [m^(dim-1)]
     */
    template <typename Value, typename AreaOf, typename Area>
    void add_load(const CellFace &face,
                  const unsigned int formula,
                  const bool is_varying,
                  const Value &value_at,
                  const AreaOf &area_of,
                  std::vector<LoadPoint<dim, Area>> &varying);

    /** Let a traction that depends on time act on the part of a face that
     * @p is_covered, by a function of the place: at one point of it. */
    void add_part(const CellFace &face,
                  const unsigned int traction,
                  const std::function<bool(const Point<dim> &)> &is_covered);

    bool has_owned_node(const CellFace &face) const;

    /** One entry by degree of freedom. */
    void sum_steady_forces();

    /** Call @p action(local node, share of it in the point [-]) for the owned
     * nodes of a face. */
    template <typename Action>
    void for_each_share(const CellFace &face,
                        const FacePoint<dim> &point,
                        const Action &action) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    Fields<dim> &fields;

    BodyAcceleration<dim> acceleration;
    std::vector<std::unique_ptr<Expression<dim>>> tractions;
    std::vector<std::unique_ptr<Expression<dim>>> water_pressures; ///< by joint

    /** Of tractions and water that do not depend on time, by degree of
     * freedom, in the order of faces [N]; those that do. */
    std::vector<std::pair<unsigned int, double>> steady_forces;
    std::vector<LoadPoint<dim, double>> varying_tractions;
    std::vector<LoadPoint<dim, Tensor<1, dim>>> varying_water;
    bool is_constant = true; ///< neither traction nor gravity depends on time

    /** Whether a formula for water does now, here or on another rank: steps
     * that ranks take together go by it. */
    bool is_water_varying = false;
    bool is_set           = false;
    double share_set      = 0.; ///< of the ramped force in the load [-]
  };
} // namespace Keyblock

#endif

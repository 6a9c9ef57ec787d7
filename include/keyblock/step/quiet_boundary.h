// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_quiet_boundary_h
#define keyblock_step_quiet_boundary_h

#include <keyblock/base/expression.h>
#include <keyblock/base/time_series.h>
#include <keyblock/step/free_field.h>
#include <keyblock/step/stage_clock.h>

namespace Keyblock
{
  /**
   * The traction of a quiet boundary per velocity that it lets out:
   * rho (c_p n n^T + c_s (I - n n^T)) [Pa s/m], with unit normal @p n. Waves
   * along the normal leave without a reflection (Lysmer and Kuhlemeyer, 1969).
   */
  template <int dim>
  Tensor<2, dim> quiet_impedance(const Material<dim> &material,
                                 const Tensor<1, dim> &n);

  /** Whether the history of a quiet support is the traction of a wave, not its
   * particle velocity. */
  template <int dim>
  bool
  lets_in_stress(const Support<dim> &support)
  {
    return support.history &&
           support.history_quantity == HistoryQuantity::stress;
  }

  /**
   * Supports of kind quiet and free field: dashpots that let waves out of the
   * model and, if a wave is given or ground beside the model moves (FreeField),
   * let it in. A support holds its nodes until the stage that it
   * names; from then on what it carried stays as a dead load. With impedance C,
   * velocity v and the incoming wave's particle velocity w the traction is
   * 2 C w - C v: outgoing and incoming waves add up without disturbing each
   * other. Of a history of stress C w is what it says.
   *
   * The velocity of the dashpots is the mean of those before and after the
   * kick, so that they neither shorten the step nor add energy: with the kick
   * h, the mass m and all other forces R of a node their force F obeys
   * (I + h / (2 m) C) F = C (v + h / (2 m) R) (doc/theory.md).
   */
  template <int dim>
  class QuietBoundary : public ForceElement<dim>
  {
  public:
    QuietBoundary(const Scene<dim> &scene,
                  const SplitMesh<dim> &split,
                  const Numbering<dim> &numbering,
                  const StageClock &clock);

    /** Whether a support of @p scene is one. */
    static bool is_wanted(const Scene<dim> &scene);

    /** Whether support number @p support has begun to be quiet. */
    bool
    is_acting(const unsigned int support) const
    {
      return acts[support];
    }

    /**
     * Let go of the supports that are quiet from stage @p number or before.
     * They carry @p reaction (owned degrees of freedom, on the rock) now [N].
     * @return whether there is one
     */
    bool release(const unsigned int number,
                 const std::vector<double> &reaction);

    std::string
    name() const override
    {
      return "quiet_boundary";
    }
    void take_ground(const Ground<dim> &ground) override;
    std::vector<unsigned int> nodes() const override;
    void
    add_force(const std::vector<double> &, std::vector<double> &) override
    {}
    bool is_viscous() const override;
    void
    stop_motion() override
    {
      free_field.stop_motion();
    }
    void add_damping_force(const MotionOfStep<dim> &motion,
                           std::vector<double> &force) override;
    double damping_work(const Fields<dim> &fields,
                        const double kick) const override;
    bool is_load_changing() const override;
    void add_load(const double time, std::vector<double> &load) const override;
    StepBound
    step_bound(const std::vector<double> &) const override
    {
      return {};
    }
    double
    stored_energy(const std::vector<double> &) const override
    {
      return 0.;
    }
    ForceElementState remember() const override;
    void recall(const ForceElementState &state) override;

  private:
    /** A node of one of the supports that act. */
    struct Dashpot
    {
      unsigned int node, support;
      Tensor<2, dim> impedance; ///< times the area [N s/m]
      double area;              ///< [m^(dim-1)]
    };

    /** All dashpots at a node. */
    struct Node
    {
      unsigned int node;
      Tensor<2, dim> impedance; ///< [N s/m]
      Tensor<1, dim> force;     ///< of the last step [N]
    };

    void find_dashpots();

    /** Whether a support lets a wave in that Velocity or a history gives. */
    bool
    has_wave(const unsigned int support) const
    {
      return waves[support] || scene.supports[support]->history;
    }

    /** Particle velocity of the wave that support number @p support lets in, or
     * the velocity that it prescribes [m/s]; the wave's traction if it
     * lets_in_stress() [Pa]. */
    Tensor<1, dim> incoming(const unsigned int support,
                            const Point<dim> &place,
                            const double time) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const StageClock &clock;
    /** Index into Scene::materials by cell, `none` where it is excavated. */
    std::vector<unsigned int> material;

    std::vector<bool> acts;                              ///< by support
    std::vector<std::unique_ptr<Expression<dim>>> waves; ///< by support
    std::vector<Dashpot> dashpots;
    std::vector<Node> at_nodes;
    FreeField<dim> free_field;
    std::vector<Tensor<1, dim>> drive; ///< of the free field, by node [N]
    std::vector<double> dead_load;     ///< by owned degree of freedom [N]
  };
} // namespace Keyblock

#endif

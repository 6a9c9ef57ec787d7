// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_supports_h
#define keyblock_step_supports_h

#include <keyblock/base/expression.h>
#include <keyblock/blocks/ground.h>
#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/step/stage_clock.h>

#include <functional>
#include <map>
#include <memory>

namespace Keyblock
{
  /** Nodes that are held or moved, by supports of the scene and by rigid
   * bodies. They are listed in Fields::supports. Each support moves a node
   * along the directions that it holds; where several hold the same direction,
   * one that moves goes before one that rests, and the last one before others.
   */
  template <int dim>
  class Supports
  {
  public:
    Supports(const Scene<dim> &scene,
             const SplitMesh<dim> &split,
             const Numbering<dim> &numbering,
             const StageClock &clock,
             Fields<dim> &fields);

    /** List the nodes that are held in @p ground, but by supports (by index)
     * that have let go (@p is_released). Masses are to be set anew. */
    void set_up(const Ground<dim> &ground,
                const std::function<bool(unsigned int)> &is_released);

    /** Remove held components of fields.velocity and put in those prescribed
     * for the step from @p time to time + @p step, on owned nodes.
     * Displacements grow by the share @p share_of_step of themselves [-]. */
    void apply_supports(const double time,
                        const double step,
                        const double share_of_step);

    /** Take the held components out of @p force (owned degrees of freedom). */
    void remove_held_components(std::vector<double> &force) const;

    /** Displacement [m] that a support prescribes, in the end. */
    Tensor<1, dim> prescribed_displacement(const NodeSupport<dim> &s) const;

  private:
    using Found = std::map<unsigned int, NodeSupport<dim>>; ///< by local node

    /** How nodes move: by a formula or a history. */
    struct Motion
    {
      std::unique_ptr<Expression<dim>> formula;
      bool is_displacement = false; ///< else a velocity
      std::shared_ptr<const TimeSeries> history;
      unsigned int stage = 0; ///< in which the history begins
    };

    /** A formula by which nodes move; returns its index. */
    int add_motion(const std::string &formula,
                   const std::string &entry,
                   const bool is_displacement);

    /** The motion that a support prescribes, or -1. */
    int motion_of(const Support<dim> &support);

    /** Velocity that a motion prescribes [m/s]. */
    Tensor<1, dim> velocity_of(const Motion &motion,
                               const Point<dim> &place,
                               const double time) const;

    /** The vector whose components along the axes of @p support are those of
     * @p value, a function of a motion and a place. */
    template <typename Value>
    Tensor<1, dim> prescribed(const NodeSupport<dim> &support,
                              const Value &value) const;
    void hold_rigid_bodies(const Ground<dim> &ground, Found &found);

    /** Hold the nodes of a support, number @p s; returns how many vertices of
     * the whole mesh it holds. */
    unsigned int
    hold(const unsigned int s, const Ground<dim> &ground, Found &found);
    Point<dim> place_of(const NodeSupport<dim> &support) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const StageClock &clock;
    Fields<dim> &fields;
    std::vector<Motion> motions;
  };
} // namespace Keyblock

#endif

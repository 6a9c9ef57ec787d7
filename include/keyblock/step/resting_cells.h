// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_resting_cells_h
#define keyblock_step_resting_cells_h

#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>
#include <keyblock/step/force_element.h>

namespace Keyblock
{
  /** What counts as rest. */
  struct RestLimit
  {
    double kick;      ///< force times this over mass is the kick [s]
    double speed;     ///< of nodes that rest, before and after it [m/s]
    bool has_damping; ///< Fields::damping_force acts
  };

  /**
   * Cells in which nothing moves, left out of the steps within a check
   * interval.
   *
   * In a step the motion of a node reaches the nodes of its own cells and no
   * others. Cells farther than n_steps layers from all that moves, and from all
   * that contact, moving supports or other ranks may set in motion, can so be
   * left out of the next n_steps steps without any change of the result; their
   * nodes, velocity zero, are left out of the passes over the nodes.
   *
   * A tolerance takes nodes for resting that creep: their velocity is set to
   * zero when stresses contain all of their way, so that what is lost is their
   * kinetic energy alone. They wake as soon as the forces on them would make
   * them faster than the tolerance.
   */
  template <int dim>
  class RestingCells
  {
  public:
    /** Steps from one check to the next. */
    static constexpr unsigned int n_steps = 10;

    RestingCells(const SplitMesh<dim> &split,
                 const Numbering<dim> &numbering,
                 const CellArrays<dim> &cells,
                 Fields<dim> &fields,
                 const ForceElements<dim> &elements);

    /** Cells, nodes that move or supports have changed: start anew, with a
     * check at the next step. */
    void forget();

    /** Nothing rests until the next check. */
    void
    wake()
    {
      rests = false;
    }

    /** Whether it is time to check. */
    bool
    is_due() const
    {
      return n_steps_left == 0;
    }

    /** Count a step. */
    void
    advance()
    {
      n_steps_left = (is_due() ? n_steps : n_steps_left) - 1;
    }

    /**
     * Choose what rests until the next check. Forces are those of the present
     * displacements, of all cells; call it before the kick.
     * @param touched local nodes that contact may set in motion by then
     * @return kinetic energy of this rank's nodes that were stopped [J]
     */
    double check(const RestLimit &limit,
                 const std::vector<unsigned int> &touched);

    /** Cells that do not rest, or null if none rests. */
    const std::vector<CellRange> *
    awake_cells() const
    {
      return rests ? &awake : nullptr;
    }

    /** Number of them. */
    unsigned int n_awake() const;

    /** Nodes that move. */
    const std::vector<NodeRun> &
    moving_nodes() const
    {
      return rests ? moving : fields.runs;
    }

  private:
    /** Number of `batch_size` cells one after the other: what rests as one. */
    unsigned int n_batches() const;

    /** List the batches at each node, and the nodes that never rest: those of
     * joints, hanging nodes and their masters, nodes of moving supports and of
     * force elements, nodes that other ranks have as well. */
    void set_up();

    bool is_resting(const unsigned int node, const RestLimit &limit) const;

    /** Wake the batches at @p node, and list those that slept. */
    void wake_around(const unsigned int node,
                     std::vector<char> &is_awake,
                     std::vector<unsigned int> &woken) const;

    /** Wake the batches up to n_steps layers from those of @p front. */
    void spread(std::vector<unsigned int> &front,
                std::vector<char> &is_awake) const;

    /** List the nodes all of whose cells are awake, and stop the others;
     * returns their kinetic energy [J]. */
    double divide_nodes(const std::vector<char> &is_awake);

    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    Fields<dim> &fields;
    const ForceElements<dim> &elements;

    bool is_set_up = false, rests = false;
    unsigned int n_steps_left = 0;
    std::vector<CellRange> awake;
    std::vector<NodeRun> moving;

    std::vector<bool> never_rests;                ///< by node
    std::vector<unsigned int> batch_begin, batch; ///< at each node
  };
} // namespace Keyblock

#endif

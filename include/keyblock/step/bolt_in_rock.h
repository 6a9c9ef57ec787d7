// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_bolt_in_rock_h
#define keyblock_step_bolt_in_rock_h

#include <keyblock/rock/bolt_chain.h>
#include <keyblock/step/passive_support.h>
#include <keyblock/step/rock_binding.h>

#include <string>

namespace Keyblock
{
  /** What a bolt does now, for output. */
  template <int dim>
  struct BoltReport
  {
    const Bolt<dim> *bolt = nullptr;
    std::vector<double> axial_force; ///< of its segments, tension positive [N]
    std::vector<double> slip;        ///< of the grout at its nodes [m]
    double plate_force = 0.;         ///< [N]
    double dowel_force = 0.;         ///< largest at a joint it crosses [N]
    double cut_length  = 0.;         ///< dug with the rock around it [m]
    std::vector<bool> is_cut;        ///< its segments: the same
    bool is_broken = false;
    std::string limit; ///< describe(BoltChain::Capacity::Limit) where it is
                       ///< weakest; empty: it holds no joint between blocks
  };

  /**
   * One bolt and the rock around it: a chain (rock/bolt_chain.h) whose nodes go
   * with the cells they lie in, and a dowel where it crosses a joint. Its
   * points are the nodes, then the two sides of each crossing. What is dug
   * later takes its part with it.
   */
  template <int dim>
  class BoltInRock
  {
  public:
    BoltInRock(const Bolt<dim> &bolt, const Scene<dim> &scene);

    /** Number of the stage at whose beginning it is installed. */
    unsigned int
    stage_number() const
    {
      return first_stage;
    }

    /** What of the rock around it is there. */
    void take_ground(const Ground<dim> &ground,
                     const Numbering<dim> &numbering);

    /** The rock at its points; empty before take_ground(). */
    const std::vector<RockBinding<dim>> &
    points() const
    {
      return bindings;
    }

    /** Its nodes, the first of its points. */
    unsigned int
    n_nodes() const
    {
      return reference.size();
    }

    /** From the head to the end (unit vector). */
    const Tensor<1, dim> &
    direction() const
    {
      return way;
    }

    /** Joints at which it wants to know the jump of the rock. */
    unsigned int
    n_jumps() const
    {
      return chain.material().dowel_strength > 0. ? dowels.size() : 0;
    }

    /** Write this rank's parts of the jumps of the rock at these to @p jump,
     * dim numbers for each [m]. */
    void get_jumps(const std::vector<double> &displacement, double *jump) const;

    /**
     * Follow the rock: put forces on it at the nodes, along the bolt, in the
     * place of its displacement there, and take up @p jump at the joints [N,
     * m]. The first time it is installed there.
     */
    void respond(double *along, const double *jump);

    /** The same of a small further displacement and elastic springs (the change
     * of the forces); subtract those of dowels from forces on this rank's
     * nodes. */
    void
    multiply(double *along, const double *jump, std::vector<double> &forces);

    /** Subtract forces across it at joints, less what a @p trial takes from all
     * its forces there, from forces on this rank's nodes [N]. */
    void subtract_at_joints(const PassiveSupport<dim> &trial,
                            std::vector<double> &forces) const;

    /** Call @p add(binding, bound): no more than this stiffness in any
     * direction of an axis acts at it, when forces at joints are up to @p
     * larger times as large as by themselves [N/m, -]. */
    template <typename Action>
    void
    for_each_stiffness_bound(const double larger, const Action &add) const
    {
      const std::vector<double> bound = chain.stiffness_bound();
      const double shape              = row_sum(way);
      for (unsigned int i = 0; i < bound.size(); ++i)
        add(bindings[i], share * shape * bound[i]);
      for (unsigned int i = bound.size(); i < bindings.size(); ++i)
        {
          const unsigned int k = (i - bound.size()) / 2;
          double at_joint      = 0.;
          if (chain.material().dowel_strength > 0. &&
              !bolt.crossings[k].is_void())
            at_joint = larger * chain.material().dowel_stiffness;
          if (larger > 1.)
            at_joint += (larger - 1.) * dim * chain.stiffest_segment();
          if (at_joint > 0.)
            add(bindings[i], 2. * share * at_joint);
        }
    }

    double stored_energy() const;     ///< [J]
    double dissipated_energy() const; ///< so far [J]

    /** Which of its segments have broken. */
    std::vector<bool> broken_segments() const;

    /** Append all that it remembers, and take it from @p at on again. */
    void remember(std::vector<double> &numbers) const;
    void recall(const std::vector<double> &numbers, std::size_t &at);

    bool
    is_installed() const
    {
      return was_installed;
    }

    BoltReport<dim> report() const;

  private:
    /** Where it crosses a joint, or a void, in which nothing shears it. */
    struct Dowel
    {
      bool is_there = false;    ///< rock and bolt
      Tensor<1, dim> reference; ///< behind less before when installed [m]
      Tensor<1, dim> slip;      ///< plastic, across the bolt [m]
      Tensor<1, dim> force;     ///< on the rock before it [N]
      double dissipated = 0.;   ///< [J]
    };

    /** Largest sum of a row of the matrix of @p way with itself [-]. */
    static double row_sum(const Tensor<1, dim> &way);

    void install(const double *along, const double *jump);

    /** Whether there is a bar between the sides of joint @p k. */
    bool
    is_whole_at_joint(const unsigned int k) const
    {
      return dowels[k].is_there &&
             !chain.is_broken_between(bolt.crossings[k].begin,
                                      bolt.crossings[k].end);
    }

    /** Follow the @p jump of the rock across joint @p k [m]. */
    void follow_at_joint(const unsigned int k, const Tensor<1, dim> &jump);

    /** Subtract @p on_first, a force of a dowel on the rock before joint @p k,
     * and what is on the rock behind it, from forces on this rank's nodes [N].
     */
    void subtract_at_joint(const unsigned int k,
                           const Tensor<1, dim> &on_first,
                           std::vector<double> &forces) const;

    /** Of the @p jump of the rock across a joint the part since the bolt was
     * installed and across it [m]. */
    Tensor<1, dim> shear_of(const Dowel &dowel, Tensor<1, dim> jump) const;

    /** Follow a shear of the rock [m]. */
    void follow(Dowel &dowel, const Tensor<1, dim> &shear) const;

    double stored_energy_of(const Dowel &dowel) const; ///< of one bolt [J]

    const Bolt<dim> &bolt;
    Tensor<1, dim> way;
    double share; ///< of a bolt, per metre in 2D
    unsigned int first_stage;
    bool was_installed = false;
    BoltChain chain;
    std::vector<RockBinding<dim>> bindings;
    std::vector<double> reference; ///< of nodes along it when installed [m]
    std::vector<Dowel> dowels;     ///< one for each crossing
    double cut_length = 0.;        ///< [m]
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_bolt_chain_h
#define keyblock_rock_bolt_chain_h

#include <keyblock/scene/bolts.h>

#include <limits>
#include <string>
#include <vector>

namespace Keyblock
{
  /** What a bolt is made of and how it is held. */
  struct BoltProperties
  {
    double axial_stiffness = 0.; ///< Young modulus times area [N]
    double yield_force     = std::numeric_limits<double>::infinity(); ///< [N]
    double rupture_strain  = 0.; ///< 0: it never breaks [-]
    double bond_stiffness  = 0.; ///< of the grout, per length [N/m/m]
    double bond_strength   = 0.; ///< of the grout, per length [N/m]
    double free_length     = 0.; ///< without grout, from the head [m]
    double plate_stiffness = 0.; ///< [N/m]
    double plate_strength  = 0.; ///< 0: there is no plate [N]
    double pretension      = 0.; ///< [N]
    double dowel_stiffness = 0.; ///< across a joint [N/m]
    double dowel_strength  = 0.; ///< across a joint [N]
  };

  /** What a bolt remembers: enough to go on from it. */
  struct BoltChainState
  {
    std::vector<double> displacement; ///< of its nodes along it [m]
    std::vector<double> slip;         ///< of the grout at each node [m]
    std::vector<double> elongation;   ///< plastic, of each segment [m]
    std::vector<double> is_broken;    ///< 1 or 0, of each segment
    double plate_shift = 0.;          ///< of the plate on the bolt [m]
    double dissipated  = 0.;          ///< so far [J]

    std::vector<double> bond_force;  ///< of the rock on each node [N]
    std::vector<double> axial_force; ///< of each segment, tension positive [N]
    double plate_force = 0.;         ///< on the rock [N]
  };

  /**
   * One bolt without mass: axial springs in a row from the head into the rock,
   * each node tied to the rock by grout, and the head by a plate that can only
   * push the rock. Grout slips at its strength, the bar yields, and breaks at
   * its rupture strain. Equilibrium of the nodes is solved for in every step by
   * Newton's method on a tridiagonal system, so that the bolt does not bear on
   * the time step.
   *
   * Displacements are along the bolt, positive from the head into the rock, and
   * since it was installed.
   */
  class BoltChain
  {
  public:
    /** @param places of the nodes, distances from the head, ascending [m] */
    BoltChain(const BoltProperties &properties,
              const std::vector<double> &places);

    unsigned int
    n_nodes() const
    {
      return place.size();
    }

    /** Nodes of which @p is_held is false have no rock around them. */
    void set_ground(const std::vector<bool> &is_held);

    /** Pull the head with the pretension against the plate, and lock it. */
    void tension();

    /** Bring the nodes into equilibrium with the rock displaced by @p rock at
     * each of them [m]. */
    void follow(const std::vector<double> &rock);

    /** Force of the bolt on the rock at each node, along it [N]. */
    const std::vector<double> &
    force_on_rock() const
    {
      return rock_force;
    }

    /** Axial force of each segment, tension positive [N]. */
    const std::vector<double> &
    axial_force() const
    {
      return state.axial_force;
    }

    /** Of the plate on the rock [N]. */
    double
    plate_force() const
    {
      return state.plate_force;
    }

    double stored_energy() const; ///< [J]

    /** No more than this stiffness acts on the rock at each node [N/m]. */
    std::vector<double> stiffness_bound() const;

    /** Greatest tension it can bear at the distance @p s from the head, and
     * what limits it. */
    struct Capacity
    {
      enum class Limit
      {
        yield,
        head,  ///< bond and plate between the head and s
        anchor ///< bond beyond s
      };
      double force = 0.; ///< [N]
      Limit limit  = Limit::yield;
    };
    Capacity capacity(const double s) const;

    const BoltProperties &
    material() const
    {
      return properties;
    }

    BoltChainState state;

  private:
    /** Set forces and tangents to those at the present displacement. */
    void respond(const std::vector<double> &rock);

    /** Displacements of the nodes in equilibrium. @p jack: pulls the head in
     * place of the plate, unless it is negative [N] */
    void solve(const std::vector<double> &rock, const double jack);

    /** Set the residual to the unbalanced forces of the nodes, and return the
     * largest [N]. */
    double find_residual(const double jack);

    /** Set the change to that of Newton's method for the residual. */
    void find_change(const double jack);

    /** Slip and yield for good. */
    void commit(const std::vector<double> &rock);

    /** Grout of node @p i between two distances from the head [m]. */
    double grouted_length(const unsigned int i,
                          const double from,
                          const double to) const;

    double
    segment_length(const unsigned int j) const
    {
      return place[j + 1] - place[j];
    }

    /** Springs of a row, and whether they are at their limits. */
    struct Springs
    {
      std::vector<double> stiffness; ///< 0: there is none [N/m]
      std::vector<double> strength;  ///< [N]
      std::vector<bool> is_elastic;  ///< not at its limit

      explicit Springs(const unsigned int n)
        : stiffness(n, 0.)
        , strength(n, 0.)
        , is_elastic(n, true)
      {}

      /** The force @p trial of spring @p i, taken back to its limit. */
      double
      limit(const unsigned int i, const double trial)
      {
        is_elastic[i] = trial <= strength[i] && trial >= -strength[i];
        return is_elastic[i] ? trial
                             : (trial > 0. ? strength[i] : -strength[i]);
      }
    };

    BoltProperties properties;
    std::vector<double> place;    ///< of the nodes [m]
    Springs bonds, segments;      ///< of nodes; between them
    double stiffest       = 0.;   ///< of all springs [N/m]
    bool is_plate_held    = true; ///< by rock
    bool is_plate_elastic = true;
    std::vector<double> rock_force; ///< [N]

    // of one solution
    std::vector<double> residual, diagonal, off, change, before;
  };

  /** What bolts are made of, as the scene says. */
  template <int dim>
  BoltProperties properties_of(const BoltSet<dim> &set);

  /** What limits a bolt, in words. */
  std::string describe(const BoltChain::Capacity::Limit limit);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_bolt_chain_h
#define keyblock_rock_bolt_chain_h

#include <keyblock/scene/bolts.h>

#include <array>
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

  /** Where the grout of a node begins and ends: distances from the head of
   * its bolt [m]. */
  using GroutRange = std::array<double, 2>;

  /** Of each bolt (SplitMesh::bolts) which of its segments have broken in a
   * run; empty: none of any. */
  using BrokenSegments = std::vector<std::vector<bool>>;

  /**
   * One bolt without mass: axial springs in a row from the head into the rock,
   * each node tied to the rock by grout, and the head by a plate that can only
   * push the rock. Grout slips at its strength, the bar yields, and breaks at
   * its rupture strain, over the whole length where no grout is between.
   * Equilibrium of the nodes is solved for in every step by Newton's method on
   * a tridiagonal system, so that the bolt does not bear on the time step;
   * while nothing slips or yields, by its factors alone.
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
      return n;
    }

    /** Nodes of which @p is_held is false have no rock around them, and
     * segments of which @p is_cut is true are no more. @p ranges: of the
     * nodes; empty: from middle to middle between nodes. */
    void set_ground(const std::vector<bool> &is_held,
                    const std::vector<bool> &is_cut,
                    const std::vector<GroutRange> &ranges = {});

    /** Pull the head with the pretension against the plate, and lock it. */
    void tension();

    /** Bring the nodes into equilibrium with the rock displaced by @p rock at
     * each of them [m]. */
    void follow(const double *rock);

    /** Force of the bolt on the rock at node @p i, along it [N]. */
    double
    force_on_rock(const unsigned int i) const
    {
      return (i == 0 ? plate_on_rock : 0.) - row(bond_force)[i];
    }

    /** Axial force of segment @p j, tension positive [N]. */
    double
    axial_force_of(const unsigned int j) const
    {
      return row(axial_force)[j];
    }

    /** Slip of the grout at node @p i, where there is rock [m]. */
    double
    slip_of(const unsigned int i) const
    {
      return row(bond_stiffness)[i] > 0. ? row(slip)[i] : 0.;
    }

    /** The segment at the distance @p s from the head. */
    unsigned int segment_at(const double s) const;

    /** Whether segment @p j was cut with the rock around it. */
    bool
    is_cut_at(const unsigned int j) const
    {
      return is_cut[j];
    }

    /** Whether segment @p j has broken. */
    bool
    is_broken_at(const unsigned int j) const
    {
      return row(broken)[j] != 0.;
    }

    /** Whether any has. */
    bool is_broken() const;

    /** The first segment and the one behind the last that a place between
     * distances @p a and @p b from the head is on. */
    std::array<unsigned int, 2>
    segments_between(const double a, const double b) const
    {
      return {{segment_at(a), segment_at(b) + 1}};
    }

    bool is_cut_between(const double a, const double b) const;
    bool is_broken_between(const double a, const double b) const;

    bool
    is_parted_between(const double a, const double b) const
    {
      return is_cut_between(a, b) || is_broken_between(a, b);
    }

    /** Whether segment @p j was cut or has broken: it bears nothing. */
    bool
    is_parted_at(const unsigned int j) const
    {
      return is_cut[j] || is_broken_at(j);
    }

    /** Of the plate on the rock [N]. */
    double
    plate_force() const
    {
      return plate_on_rock;
    }

    /** Put what elastic springs would change the forces of the bolt on the rock
     * by in the place of a further displacement of the rock at each node, all
     * nodes in equilibrium [m, N]. */
    void multiply(double *rock);

    /** Of the stiffest segment before it is cut or breaks [N/m]. */
    double stiffest_segment() const;

    double stored_energy() const; ///< [J]

    double
    dissipated_energy() const ///< so far [J]
    {
      return dissipated;
    }

    /** No more than this stiffness acts on the rock at each node [N/m]. */
    std::vector<double> stiffness_bound() const;

    /** Greatest tension it can bear at the distance @p s from the head, as
     * far as it is in one piece, and what limits it. */
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

    /** Append all that it remembers, and take it from @p at on again. */
    void remember(std::vector<double> &numbers) const;
    void recall(const std::vector<double> &numbers, std::size_t &at);

  private:
    /** One number for each node or segment; those of all rows stand one behind
     * the other, as a step reads them. The first ones are remembered. */
    enum Row : unsigned int
    {
      displacement, ///< of nodes along the bolt [m]
      slip,         ///< of the grout at nodes [m]
      elongation,   ///< plastic, of segments [m]
      broken,       ///< 1 or 0, of segments
      bond_force,   ///< of the rock on nodes [N]
      axial_force,  ///< of segments [N]
      followed,     ///< displacement of the rock that was followed last [m]
      n_remembered,
      bond_stiffness = n_remembered, ///< 0: there is no rock [N/m]
      bond_strength,                 ///< [N]
      segment_stiffness,             ///< 0: it is cut or broken [N/m]
      factor,                        ///< of the solution: off over diagonal [-]
      inverse,                       ///< the same: over the diagonal [m/N]
      residual,                      ///< unbalanced forces of nodes [N]
      change,                        ///< of displacements [m]
      before,                        ///< displacements before the change [m]
      n_rows
    };

    double *
    row(const Row r)
    {
      return numbers.data() + r * n;
    }

    const double *
    row(const Row r) const
    {
      return numbers.data() + r * n;
    }

    /** Segments are as stiff as cuts and breaks leave them, and stretches lie
     * between cuts, breaks and grout. */
    void set_segments();

    /** Follow if all springs are elastic before and behind, by one solution;
     * otherwise false, and nothing has changed. */
    bool follow_elastically(const double *rock);

    /** Half the work of the rock against the present forces of the bolt on its
     * way from where it was followed last [J]. */
    double half_work_on_way(const double *rock) const;

    /** Set forces to those at the present displacement of springs that neither
     * slip nor yield any further. */
    void set_trial_forces(const double *rock);

    /** The same of the plate, which may push or pull [N]. */
    double
    trial_plate_force(const double rock) const
    {
      return properties.plate_stiffness *
             (row(displacement)[0] - rock - plate_shift);
    }

    /** First and last node of segments in a row without grout between them,
     * which bear the same force: one bar, however it is divided. */
    using Stretch = std::array<unsigned int, 2>;

    /** Whether the segments on both sides of node @p i are in one stretch. */
    bool has_equal_forces_at(const unsigned int i) const;

    /** Whether a stretch, if it is whole, is longer than it can bear. */
    bool is_over_rupture(const Stretch &stretch) const;

    /** Let a stretch that yields be elongated alike all along. */
    void spread_elongation(const Stretch &stretch);

    /** Set forces to those at the present displacement. */
    void respond(const double *rock);

    /** Displacements of the nodes in equilibrium, and what slips, yields and
     * breaks on the way there. @p jack: pulls the head in place of the plate,
     * unless it is negative [N] */
    void solve(const double *rock, const double jack);

    /** The same with the segments that there are: Newton's method. */
    void find_equilibrium(const double *rock, const double jack);

    /** Residual that counts as none [N]. */
    double negligible_residual(const double *rock, const double jack) const;

    /** Set the residual to the unbalanced forces of the nodes, and return the
     * largest [N]. */
    double find_residual(const double jack);

    /** Factorise the tangent, that of springs at their limits as good as none.
     */
    void factorise(const double jack);

    /** Set the change to that of Newton's method for the residual. */
    void find_change();

    /** Slip and yield for good. */
    void commit(const double *rock);

    /** Stretches that are longer than they can bear are no more. Returns
     * whether there are any. */
    bool break_segments();

    /** Grout of node @p i between two distances from the head [m]. */
    double grouted_length(const unsigned int i,
                          const double from,
                          const double to) const;

    double
    segment_length(const unsigned int j) const
    {
      return place[j + 1] - place[j];
    }

    /** Of segment @p j before it is cut or breaks [N/m]. */
    double
    whole_stiffness(const unsigned int j) const
    {
      return properties.axial_stiffness / segment_length(j);
    }

    BoltProperties properties;
    unsigned int n;              ///< number of nodes
    std::vector<double> numbers; ///< all rows
    std::vector<double> place;   ///< of the nodes [m]
    std::vector<char> bond_is_elastic, segment_is_elastic;
    std::vector<bool> is_cut;       ///< of segments
    std::vector<GroutRange> grout;  ///< of nodes
    std::vector<Stretch> stretches; ///< all segments, in order
    double stiffest       = 0.;     ///< of all springs [N/m]
    double plate_shift    = 0.;     ///< of the plate on the bolt [m]
    double plate_on_rock  = 0.;     ///< [N]
    double dissipated     = 0.;     ///< [J]
    bool is_plate_held    = true;   ///< by rock
    bool is_plate_elastic = true;
    bool was_elastic      = true; ///< all springs; and no force in a plate
                                  ///< that is not
    bool is_factorised = false;   ///< the tangent of elastic springs
  };

  /** What bolts are made of, as the scene says. */
  template <int dim>
  BoltProperties properties_of(const BoltSet<dim> &set);

  /** What limits a bolt, in words. */
  std::string describe(const BoltChain::Capacity::Limit limit);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_fields_h
#define keyblock_rock_fields_h

#include <array>
#include <utility>
#include <vector>

namespace Keyblock
{
  /** Directions in which a node is held or moved. */
  template <int dim>
  struct NodeSupport
  {
    unsigned int node;
    unsigned int n_directions = 0; ///< orthonormal, of `directions`
    std::array<std::array<double, dim>, dim> directions{};

    /** What the supports name: normals or axes, of which `directions` are made
     * one after the other; the motion that prescribes the component along each
     * (Supports), or -1 for zero. */
    std::array<std::array<double, dim>, dim> axes{};
    std::array<int, dim> motions{};

    bool
    is_fixed() const
    {
      return n_directions == dim;
    }

    bool
    is_moved() const
    {
      for (unsigned int k = 0; k < n_directions; ++k)
        if (motions[k] >= 0)
          return true;
      return false;
    }
  };

  /** Nodes one after the other. */
  struct NodeRun
  {
    unsigned int begin, end;

    /** Nothing but cells, loads and damping acts on them: no joint, support
     * or hanging node. They are predicted and moved in one pass. */
    bool is_inner;
  };

  /**
   * The state of all local nodes: dim values per node, owned nodes first. A
   * node that is fixed in all directions has inverse mass zero.
   */
  template <int dim>
  struct Fields
  {
    std::vector<double> reference;      ///< X [m]
    std::vector<double> displacement;   ///< u(n) [m]
    std::vector<double> position;       ///< X + u, kept in `large` only [m]
    std::vector<double> velocity;       ///< v(n-1/2), then v(n+1/2) [m/s]
    std::vector<double> old_velocity;   ///< v(n-1/2) during a step [m/s]
    std::vector<double> internal_force; ///< integral of B^T stress [N]
    std::vector<double> damping_force;  ///< stiffness-proportional [N]
    std::vector<double> load;           ///< gravity and tractions [N]
    std::vector<double> contact_force;  ///< impulses of the last step / h [N]
    std::vector<double> local_damping;  ///< impulse of this step, if any [N s]

    std::vector<double> mass;          ///< one per node, scaled or not [kg]
    std::vector<double> weighing_mass; ///< the true one [kg]
    std::vector<double> inverse_mass;  ///< one per node [1/kg]

    /** Owned nodes that may move, in order. */
    std::vector<NodeRun> runs;

    /** One per node: held by a cluster, whose solve applies the damping. */
    std::vector<unsigned char> is_in_cluster;

    /** Shifts of positions that contact asks for besides the motion, as degree
     * of freedom and length [m]; applied, and cleared, by the move. */
    std::vector<std::pair<unsigned int, double>> shifts;

    /** Velocity of the last move with its shifts, kept in `large` only. */
    std::vector<double> rate;

    std::vector<NodeSupport<dim>> supports; ///< sorted by node
    /** Owned nodes of each entry of Scene::supports. */
    std::vector<std::vector<unsigned int>> nodes_of_support;

    std::vector<int> support_of_node; ///< index or -1, one per node
  };
} // namespace Keyblock

#endif

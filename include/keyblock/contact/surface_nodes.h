// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_surface_nodes_h
#define keyblock_contact_surface_nodes_h

#include <keyblock/contact/solver.h>
#include <keyblock/contact/topology.h>
#include <keyblock/rock/fields.h>

namespace Keyblock
{

  /**
   * The nodes of faces that may touch, with the same numbers on all ranks:
   * their masses and supports, and their values to and from the fields. Vectors
   * have dim values for each, by the number that ContactSurface gives it.
   */
  template <int dim>
  class SurfaceNodes
  {
  public:
    SurfaceNodes(const PairTopology<dim> &topology, Fields<dim> &fields);

    /** Take up present masses and supports (collective). */
    void measure();

    /** Which nodes are gathered and scattered. */
    void activate(const std::vector<bool> &is_active);

    /** Values of active nodes from the fields; those in @p shared, which are
     * solved on all ranks, from their owners (collective). */
    void gather(const std::vector<unsigned int> &shared);

    /** Velocities and contact forces to the fields.
     * @param kick that impulses are divided by [s] */
    void scatter(const double kick);

    /** Present positions of all of them [m] (collective). */
    std::vector<double> gather_positions() const;

    std::vector<double> velocity, old_velocity; ///< [m/s]
    std::vector<double> displacement, position; ///< [m]
    std::vector<double> impulse;                ///< [N s]
    std::vector<double> inverse_mass;           ///< [1/kg]
    std::vector<unsigned int> local_node;       ///< or `none`
    std::vector<const double *> projection;     ///< as in ContactNodes
    ContactNodes<dim> view;                     ///< of the above

  private:
    const ContactSurface<dim> &surface;
    const Numbering<dim> &numbering;
    Fields<dim> &fields;
    std::vector<unsigned int> active;
    std::vector<std::array<double, dim * dim>> projection_storage;
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_history_h
#define keyblock_contact_history_h

#include <keyblock/contact/area.h>

namespace Keyblock
{

  /**
   * What the laws of joints remember of contact points, from step to step: in
   * the state of a pair, and after its conversion by surface node and joint, so
   * that it lasts whatever the node meets.
   */
  template <int dim>
  class ContactHistory
  {
  public:
    ContactHistory(const PairTopology<dim> &topology,
                   const ContactStrength<dim> &strength,
                   const ContactAreas<dim> &areas,
                   const SurfaceNodes<dim> &nodes,
                   const Fields<dim> &fields,
                   ContactMemory<dim> &memory);

    /** That of a surface contact: of its slave, or the mean over the nodes of
     * the face it is on, whichever has slipped farther. A fresh surface under
     * a worn one is as worn as that. */
    JointHistory of(const SurfaceContact<dim> &contact) const;

    /** Of all surface nodes [m]: surfaces so far apart may touch. */
    double largest_dilation() const;

    /** By how much the sides of a @p pair have pushed each other apart, as a
     * pair and since they are in surface contact [m]. */
    double dilation_of(const unsigned int pair) const;

    /** Leave what a pair's joint remembers to its nodes. */
    void pass_on(const unsigned int pair);

    /** Add the slip of the present step.
     * @param step dt [s] */
    void advance(const double step);

  private:
    /** That of a node, none so far if it is not listed. */
    JointHistory find(const unsigned int node, const unsigned int joint) const;
    JointHistory &at(const unsigned int node, const unsigned int joint);

    /** Velocity of a pair's plus side from its minus side [m/s]; false if this
     * rank does not have both. */
    bool find_velocity(const unsigned int pair, Vector<dim> &velocity) const;

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const ContactSurface<dim> &surface;
    const ContactStrength<dim> &strength;
    const ContactAreas<dim> &areas;
    const SurfaceNodes<dim> &nodes;
    const Fields<dim> &fields;
    ContactMemory<dim> &memory;
  };
} // namespace Keyblock

#endif

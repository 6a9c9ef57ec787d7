// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_strength_loans_h
#define keyblock_contact_strength_loans_h

#include <keyblock/contact/strength.h>

namespace Keyblock
{

  /**
   * What pairs bear for a while beyond their joint's strength: what rock
   * excavated in a stage held together, and what only the mesh makes slide,
   * where it has bent a joint's faces. Both are taken away along the stage's
   * ramp.
   */
  template <int dim>
  class StrengthLoans
  {
  public:
    StrengthLoans(const PairTopology<dim> &topology,
                  const ContactStrength<dim> &strength,
                  ContactMemory<dim> &memory);

    /** Let go of the pairs that rock excavated in stage @p number held
     * together. What they bore beyond the joint's strength is lent
     * (collective). */
    void unweld(const unsigned int number);

    /** Lend to bent points not next to exposed blocks what they lack
     * (collective). @return number of points held */
    unsigned int hold_bent_points(const std::vector<bool> &is_exposed);

    /** Let those go along the ramp of the stage that begins. */
    void release_bent_points();

  private:
    bool may_hold(const unsigned int pair,
                  const std::vector<bool> &is_exposed) const;

    /** How much the mesh's bends may make of the forces of a group [N]. */
    double doubt_about(const unsigned int group) const;

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const ContactStrength<dim> &strength;
    ContactMemory<dim> &memory;
  };
} // namespace Keyblock

#endif

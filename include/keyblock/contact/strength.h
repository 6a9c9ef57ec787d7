// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_strength_h
#define keyblock_contact_strength_h

#include <keyblock/contact/state.h>
#include <keyblock/contact/topology.h>

#include <memory>

namespace Keyblock
{

  class JointLaw; // law/joint_law.h
  struct JointPointState;
  struct StrengthEnvelope;

  /** How strong contact points are: by the laws of their joints, and what a
   * stage or a trial puts in the place of their strength. */
  template <int dim>
  class ContactStrength
  {
  public:
    ContactStrength(const PairTopology<dim> &topology,
                    const ContactMemory<dim> &memory);

    /** Replace all friction angles [deg]; negative: back to the laws'. */
    void override_friction(const double angle);

    /** Strength of a pair, while it is bonded or not.
     * @param kick interval of the impulses [s] */
    PointStrength of_pair(const unsigned int pair,
                          const bool is_intact,
                          const double kick) const;

    /** Strength of a surface contact that stands for @p area [m^(dim-1)], NaN
     * if it is not known; then cohesion stays what it was.
     * @param history of the contact
     * @param pressure on the joint there [Pa] */
    PointStrength of_surface(const SurfaceContact<dim> &contact,
                             const double area,
                             const JointHistory &history,
                             const double pressure,
                             const double kick) const;

    /** Tension and shear of a pair in state @p now beyond its strength [N]. */
    std::array<double, 2> beyond(const unsigned int pair,
                                 const PairState<dim> &now) const;

    /** Effective normal stress of a pair in the last step [Pa]. */
    double pressure_of_pair(const unsigned int pair) const;

    /** Whether a joint's pairs are bonded when they are let go. */
    bool is_bonded(const unsigned int joint) const;

    std::vector<std::shared_ptr<const JointLaw>> laws; ///< by joint
    bool has_memory     = false;                       ///< one of the laws
    bool needs_pressure = false;                       ///< one of the laws
    std::vector<bool> needs_areas; ///< of surface contacts, by joint

    StrengthReduction reduction;
    double weld_share = 0.;    ///< as in ContactStep
    bool is_tied      = false; ///< all points stick, whatever their strength

  private:
    /** Strength by the joint's law, or of free faces (none), with what the
     * stage has put in the place of friction. */
    StrengthEnvelope envelope_of(const unsigned int joint,
                                 const JointPointState &point) const;

    const PairTopology<dim> &topology;
    const ContactMemory<dim> &memory;
    const Scene<dim> &scene;
    std::shared_ptr<const JointLaw> law_of_free_faces;
    double override_tangent = -1.; ///< negative: none
  };
} // namespace Keyblock

#endif

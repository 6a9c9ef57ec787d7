// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_joint_law_h
#define keyblock_contact_joint_law_h

#include <keyblock/contact/law.h>
#include <keyblock/scene/scene.h>

#include <memory>

namespace Keyblock
{
  /** How strong a joint is at one place: shear up to cohesion + tangent x
   * pressure, tension up to the tensile strength. */
  struct StrengthEnvelope
  {
    double static_tangent   = 0.; ///< tan(phi) while it sticks [-]
    double kinetic_tangent  = 0.; ///< tan(phi) while it slides [-]
    double cohesion         = 0.; ///< [Pa]
    double tensile_strength = 0.; ///< [Pa]

    /** The same as impulses of a point.
     * @param share of the strength that is left, as in strength reduction [-]
     * @param area that the point stands for [m^(dim-1)]
     * @param kick interval that impulses are collected over [s] */
    PointStrength
    of_point(const double share, const double area, const double kick) const;
  };

  /** What has happened to one contact point of a joint. */
  struct JointPointState
  {
    bool is_intact  = true; ///< bonded; else it has slid or opened
    bool has_opened = false;
  };

  /**
   * How strong a joint is, by what has happened to it. The only place that
   * turns a joint's entries into strength: contact of pairs and of surfaces,
   * strength reduction and limit equilibrium all ask it. A new law is a class
   * of its own and a line in make_joint_law.
   */
  class JointLaw
  {
  public:
    virtual ~JointLaw() = default;

    virtual StrengthEnvelope envelope(const JointPointState &state) const = 0;
  };

  /** The law that the entries of a joint ask for. */
  std::shared_ptr<const JointLaw> make_joint_law(const JointStrength &entries);

  /** That of faces which no joint has marked: friction alone.
   * @param angle of friction [deg] */
  std::shared_ptr<const JointLaw> make_friction_law(const double angle);
} // namespace Keyblock

#endif

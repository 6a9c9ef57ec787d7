// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_joint_law_h
#define keyblock_law_joint_law_h

#include <keyblock/law/joint_history.h>
#include <keyblock/law/joint_strength.h>
#include <keyblock/law/point_strength.h>

#include <functional>
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
    double dilation_tangent = 0.; ///< tan(psi): opening over slip now [-]

    /** The same as impulses of a point.
     * @param share of the strength that is left, as in strength reduction [-]
     * @param area that the point stands for [m^(dim-1)]
     * @param kick interval that impulses are collected over [s] */
    PointStrength
    of_point(const double share, const double area, const double kick) const
    {
      PointStrength strength;
      strength.static_friction  = share * static_tangent;
      strength.kinetic_friction = share * kinetic_tangent;
      strength.cohesion         = share * cohesion * area * kick;
      strength.tension          = share * tensile_strength * area * kick;
      strength.dilation         = dilation_tangent;
      return strength;
    }
  };

  /** All a law may know of one contact point. */
  struct JointPointState
  {
    bool is_intact       = true;  ///< bonded; else it has slid or opened
    bool has_opened      = false; ///< since the start
    JointHistory history = {};
    double pressure = 0.; ///< effective normal stress of the last step [Pa]
  };

  /**
   * How strong a joint is, by what has happened to it. The only place that
   * turns a joint's entries into strength: contact of pairs and of surfaces,
   * strength reduction and limit equilibrium all ask it. A new law is one
   * file with a JointLawKind, and a line in joint_law.cc that names it.
   */
  class JointLaw
  {
  public:
    virtual ~JointLaw() = default;

    virtual StrengthEnvelope envelope(const JointPointState &state) const = 0;

    /** Whether strength depends on the state's history; if not, contact does
     * not keep it. */
    virtual bool
    has_memory() const
    {
      return false;
    }

    /** Whether strength depends on the pressure, which is not measured else. */
    virtual bool
    depends_on_pressure() const
    {
      return false;
    }

    /** What becomes of @p history when the point slides a further @p slip [m]
     * under @p pressure [Pa] (0 unless depends_on_pressure). */
    virtual JointHistory
    advance(JointHistory history,
            const double slip,
            const double /*pressure*/) const
    {
      history.slip += slip;
      return history;
    }
  };

  /** An entry that a law adds to those of joints. */
  struct JointLawEntry
  {
    std::string name;
    double value;           ///< by default
    double lowest, highest; ///< what may be typed
    std::string unit;       ///< m, deg, Pa, or empty: a number
    std::string description;
  };

  /** A law as users choose it by the entry 'Law'. */
  struct JointLawKind
  {
    std::string name, description;
    std::vector<JointLawEntry> entries; ///< besides those all joints have

    /** Make the law of a joint. Throws InputError, beginning with the entry's
     * section, for values that do not go together. */
    std::function<std::shared_ptr<const JointLaw>(const JointStrength &entries,
                                                  const std::string &section)>
      make;
  };

  /** All laws that can be chosen; the first is the default. */
  const std::vector<JointLawKind> &joint_law_kinds();

  /** That of a name. Throws std::out_of_range if there is none. */
  const JointLawKind &joint_law_kind(const std::string &name);

  /** The entries that they add, each name once. */
  const std::vector<JointLawEntry> &joint_law_entries();

  /** The law that the entries of a joint ask for.
   * @param section of the scene the entries are from, for messages */
  std::shared_ptr<const JointLaw>
  make_joint_law(const JointStrength &entries,
                 const std::string &section = "Joints");

  /** That of faces which no joint has marked: friction alone.
   * @param angle of friction [deg] */
  std::shared_ptr<const JointLaw> make_friction_law(const double angle);
} // namespace Keyblock

#endif

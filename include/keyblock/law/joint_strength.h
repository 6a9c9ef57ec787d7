// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_joint_strength_h
#define keyblock_law_joint_strength_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  /** The entries of a joint or a set of joints that say how strong it is, and
   * the water in it. What they mean, the joint's law says (law/joint_law.h). */
  struct JointStrength
  {
    JointStrength();

    double friction_angle         = 30.; ///< static [deg]
    double kinetic_friction_angle = -1.; ///< [deg]; -1: the static one
    double cohesion               = 0.;  ///< [Pa]
    double tensile_strength       = 0.;  ///< [Pa]
    double residual_cohesion      = -1.; ///< [Pa]; -1: as cohesion
    std::string water_pressure;          ///< formula [Pa]; empty: none
    std::string water_level;             ///< formula [m]; empty: the scene's

    std::string law;                ///< its name
    std::vector<double> law_values; ///< of joint_law_entries(), in their order

    /** Cohesion of a joint that slides [Pa]. */
    double
    cohesion_of_sliding() const
    {
      return residual_cohesion < 0. ? cohesion : residual_cohesion;
    }

    /** The value of an entry that laws have added, by its name. */
    double value_of(const std::string &entry) const;

    /** Which of two joints rules where they share faces: that with the lower
     * friction angle, of equal ones that with the lower cohesion. */
    bool is_weaker_than(const JointStrength &other) const;

    void declare_strength(dealii::ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/angle.h>
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/barton_bandis.h>
#include <keyblock/law/slip_weakening.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Largest angle of friction and roughness together [deg]. */
    constexpr double largest_angle = 70.;

    /** Length of the samples that JRC and JCS are given for [m]. */
    constexpr double sample_length = 0.1;

    /** Weaker walls than of any rock are given in another unit [Pa]. */
    constexpr double least_wall_strength = 1e4;

    class BartonBandis : public JointLaw
    {
    public:
      BartonBandis(const JointStrength &entries)
        : roughness(entries.value_of("JRC"))
        , wall_strength(entries.value_of("JCS"))
        , residual_angle(entries.value_of("Residual friction angle"))
      {
        const double length = entries.value_of("Joint length");
        if (length > 0.)
          {
            const double ratio = std::max(1., length / sample_length);
            wall_strength *= std::pow(ratio, -0.03 * roughness);
            roughness *= std::pow(ratio, -0.02 * roughness);
          }
      }

      StrengthEnvelope
      envelope(const JointPointState &state) const override
      {
        double angle = largest_angle;
        if (state.pressure > 0.)
          angle = residual_angle +
                  roughness *
                    std::max(0., std::log10(wall_strength / state.pressure));
        StrengthEnvelope strength;
        strength.static_tangent = strength.kinetic_tangent =
          tangent_of(std::min(angle, std::max(largest_angle, residual_angle)));
        return strength;
      }

      bool
      depends_on_pressure() const override
      {
        return true;
      }

    private:
      double roughness;      ///< JRC [-]
      double wall_strength;  ///< JCS [Pa]
      double residual_angle; ///< [deg]
    };

    std::shared_ptr<const JointLaw>
    make_barton_bandis(const JointStrength &entries, const std::string &section)
    {
      const auto require = [&](const bool condition,
                               const std::string &entry,
                               const std::string &remedy) {
        AssertThrow(condition,
                    InputError("'" + section + "/" + entry + "' " + remedy));
      };
      require(entries.value_of("JCS") > 0.,
              "JCS",
              "is 0; the law barton-bandis needs the compressive strength of "
              "the joint's walls in pascals.");
      require(entries.value_of("JCS") >= least_wall_strength,
              "JCS",
              "is " + text_of(entries.value_of("JCS")) +
                " Pa, which no rock is as weak as; give it in pascals, 50 MPa "
                "as 50e6.");
      require(entries.value_of("JRC") >= 0.,
              "JRC",
              "is not given; the law barton-bandis needs the roughness "
              "coefficient of the joint.");
      require(entries.value_of("Residual friction angle") >= 0.,
              "Residual friction angle",
              "is not given; the law barton-bandis needs it in degrees.");
      require(entries.cohesion == 0. && entries.tensile_strength == 0.,
              "Cohesion",
              "or 'Tensile strength' is given, but a joint by the law "
              "barton-bandis has none; remove them.");
      require(entries.friction_angle == JointStrength().friction_angle &&
                entries.kinetic_friction_angle < 0.,
              "Friction angle",
              "or 'Kinetic friction angle' is given, but friction by the law "
              "barton-bandis follows from 'JRC', 'JCS' and 'Residual friction "
              "angle'; remove them.");
      return std::make_shared<const BartonBandis>(entries);
    }
  } // namespace



  JointLawKind
  barton_bandis_joint()
  {
    constexpr double any = std::numeric_limits<double>::max();
    return {"barton-bandis",
            "friction of rough joints by JRC, JCS and Residual friction angle, "
            "which falls with normal stress",
            {{"JRC",
              -1.,
              -1.,
              40.,
              "",
              "Joint roughness coefficient [-], for the law barton-bandis; -1: "
              "not given."},
             {"JCS",
              0.,
              0.,
              any,
              "Pa",
              "Compressive strength of the joint's walls [Pa], for the law "
              "barton-bandis."},
             residual_friction_entry(),
             {"Joint length",
              0.,
              0.,
              any,
              "m",
              "Length of the joint between others [m], for the law "
              "barton-bandis: JRC and JCS, measured on 0.1 m, are scaled to "
              "it if it is longer; 0: they are those of the joint."}},
            make_barton_bandis};
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// The entries of a probability study, and its distributions.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check_parts.h>
#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/study.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/math/distributions/normal.hpp>

#include <cmath>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::Distribution>
    : Keyblock::ChoiceConversion<Keyblock::Distribution>
  {};
  template <>
  struct Convert<Keyblock::Sampling>
    : Keyblock::ChoiceConversion<Keyblock::Sampling>
  {};
  template <>
  struct Convert<Keyblock::StudyLevel>
    : Keyblock::ChoiceConversion<Keyblock::StudyLevel>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  namespace
  {
    double
    share_below(const StudyVariable &v, const double x)
    {
      const boost::math::normal standard;
      switch (v.distribution)
        {
          case Distribution::normal:
            return boost::math::cdf(standard, (x - v.mean) / v.deviation);
            case Distribution::lognormal: {
              const double s2 = std::log1p(std::pow(v.deviation / v.mean, 2));
              return x <= 0.
                       ? 0.
                       : boost::math::cdf(standard,
                                          (std::log(x / v.mean) + 0.5 * s2) /
                                            std::sqrt(s2));
            }
          case Distribution::exponential:
            return x <= 0. ? 0. : -std::expm1(-x / v.mean);
          default:
            return 0.;
        }
    }

    /** The same without cuts. */
    double
    uncut_quantile(const StudyVariable &v, const double p)
    {
      const boost::math::normal standard;
      switch (v.distribution)
        {
          case Distribution::normal:
            return v.mean + v.deviation * boost::math::quantile(standard, p);
            case Distribution::lognormal: {
              const double s2 = std::log1p(std::pow(v.deviation / v.mean, 2));
              return v.mean * std::exp(std::sqrt(s2) *
                                         boost::math::quantile(standard, p) -
                                       0.5 * s2);
            }
          case Distribution::exponential:
            return -v.mean * std::log1p(-p);
          default:
            return 0.;
        }
    }
  } // namespace



  double
  StudyVariable::quantile(const double p, const unsigned int index) const
  {
    switch (distribution)
      {
        case Distribution::sequence:
          return minimum + index;
        case Distribution::uniform:
          return minimum + p * (maximum - minimum);
          case Distribution::triangular: {
            const double width = maximum - minimum, left = mode - minimum;
            return p * width < left
                     ? minimum + std::sqrt(p * width * left)
                     : maximum - std::sqrt((1. - p) * width * (maximum - mode));
          }
          default: {
            const double low  = share_below(*this, minimum);
            const double high = share_below(*this, maximum);
            const double q    = low + p * (high - low);
            return q <= 0.   ? minimum
                   : q >= 1. ? maximum
                             : uncut_quantile(*this, q);
          }
      }
  }



  void
  check_study_variable(const StudyVariable &v)
  {
    const std::string section = "Study/" + v.name;
    require(v.entry.find('/') != std::string::npos,
            "The entry '" + section + "/Entry' is '" + v.entry +
              "'; name the entry that takes the values, as Section/Entry.");
    const bool has_ends = v.minimum > -1e300 && v.maximum < 1e300;
    switch (v.distribution)
      {
        case Distribution::normal:
        case Distribution::lognormal:
          require(v.deviation > 0.,
                  "The entry '" + section + "/Deviation' is " +
                    text_of(v.deviation) + "; a " + name_of(v.distribution) +
                    " distribution needs a positive one.");
          [[fallthrough]];
        case Distribution::exponential:
          require(v.mean > 0. || v.distribution == Distribution::normal,
                  "The entry '" + section + "/Mean' is " + text_of(v.mean) +
                    "; the distribution " + name_of(v.distribution) +
                    " needs a positive one.");
          require(v.minimum < v.maximum &&
                    share_below(v, v.maximum) > share_below(v, v.minimum),
                  "The entries '" + section + "/Minimum' (" +
                    text_of(v.minimum) + ") and 'Maximum' (" +
                    text_of(v.maximum) +
                    ") leave nothing of the distribution; move them apart.");
          break;
        case Distribution::uniform:
        case Distribution::triangular:
          require(has_ends && v.minimum < v.maximum,
                  "The variable '" + v.name + "' is " +
                    name_of(v.distribution) + ", which needs '" + section +
                    "/Minimum' below 'Maximum'; set both.");
          require(v.distribution == Distribution::uniform ||
                    (v.mode >= v.minimum && v.mode <= v.maximum),
                  "The entry '" + section + "/Mode' is " + text_of(v.mode) +
                    ", which is not between Minimum and Maximum; move it.");
          break;
        case Distribution::sequence:
          require(v.minimum > -1e300,
                  "The variable '" + v.name +
                    "' is a sequence, which begins at '" + section +
                    "/Minimum'; set it.");
      }
  }



  void
  StudyVariable::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Entry",
                      entry,
                      "Entry that takes the values, `Section/Entry` as for "
                      "--set, with its unit. No two variables may set the "
                      "same one, be it by a pattern or a set of joints.");
    prm.add_parameter(
      "Distribution",
      distribution,
      "Distribution of the values. normal, lognormal: Mean and Deviation (of "
      "the values themselves); exponential: Mean; each is cut off at Minimum "
      "and Maximum; uniform: from Minimum to Maximum; triangular: the same "
      "with its top at Mode; sequence: Minimum, Minimum + 1, ..., as for the "
      "seed of a set of joints.");
    prm.add_parameter("Mean", mean, "Mean before it is cut off.");
    prm.add_parameter("Deviation",
                      deviation,
                      "Standard deviation before it is cut off.",
                      Double(0.));
    prm.add_parameter("Minimum", minimum, "Least value; -1e300: no bound.");
    prm.add_parameter("Maximum", maximum, "Greatest value; 1e300: no bound.");
    prm.add_parameter("Mode", mode, "Most frequent value (triangular).");
  }



  void
  StudySettings::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    prm.add_parameter("Samples",
                      samples,
                      "Number of samples that `keyblock SCENE.prm --study` "
                      "judges. Those of Sampling random go on from the samples "
                      "that are in the output folder, whatever their number; a "
                      "Latin hypercube of another number is another one.",
                      Integer(1, 100000000));
    prm.add_parameter("Seed",
                      seed,
                      "Seed of the random numbers; the same samples on any "
                      "number of ranks.",
                      Integer(0));
    prm.add_parameter("Sampling",
                      sampling,
                      "Way of drawing samples. latin hypercube: one value in "
                      "each of as many equally probable parts as there are "
                      "samples; random: each by itself.");
    prm.add_parameter("Level",
                      level,
                      "Level of the study. rigid: limit equilibrium alone, no "
                      "step is taken; full: samples in which a block has a "
                      "factor below Safety factor/Critical factor by it are "
                      "run, with factors by strength reduction of those "
                      "blocks.");
    prm.add_parameter("Threshold",
                      threshold,
                      "Factor below which a block counts as failed [-].",
                      Double(0.));
  }
} // namespace Keyblock

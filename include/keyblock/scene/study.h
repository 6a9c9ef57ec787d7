// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_study_h
#define keyblock_scene_study_h

#include <keyblock/base/choice.h>

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  /** Distribution of a variable of a study. */
  enum class Distribution
  {
    normal,
    lognormal,
    exponential,
    uniform,
    triangular,
    sequence
  };
  template <>
  struct ChoiceNames<Distribution>
  {
    static constexpr std::array<const char *, 6> names = {{"normal",
                                                           "lognormal",
                                                           "exponential",
                                                           "uniform",
                                                           "triangular",
                                                           "sequence"}};
  };

  /** How samples of a study are drawn. */
  enum class Sampling
  {
    latin_hypercube,
    random
  };
  template <>
  struct ChoiceNames<Sampling>
  {
    static constexpr std::array<const char *, 2> names = {
      {"latin hypercube", "random"}};
  };

  /** What judges the blocks of a study's samples. */
  enum class StudyLevel
  {
    rigid,
    full
  };
  template <>
  struct ChoiceNames<StudyLevel>
  {
    static constexpr std::array<const char *, 2> names = {{"rigid", "full"}};
  };

  /** An entry of the scene that differs from sample to sample. */
  struct StudyVariable
  {
    std::string name;
    std::string entry; ///< Section/Entry, as for --set
    Distribution distribution = Distribution::normal;
    double mean               = 0.;
    double deviation          = 0.;
    double minimum            = -1e300;
    double maximum            = 1e300;
    double mode               = 0.;

    /** Value at which the distribution, cut off at minimum and maximum, has
     * reached the share @p p, 0 < p < 1; of a sequence that of sample number
     * @p index, from 0. */
    double quantile(const double p, const unsigned int index) const;

    void declare(dealii::ParameterHandler &prm);
  };

  /** How many samples of the scene are drawn, and how. */
  struct StudySettings
  {
    unsigned int samples = 1000;
    unsigned int seed    = 1;
    Sampling sampling    = Sampling::latin_hypercube;
    StudyLevel level     = StudyLevel::rigid;
    double threshold     = 1.; ///< factors below it are failures [-]

    void declare(dealii::ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

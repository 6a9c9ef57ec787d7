// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_sample_statistics_h
#define keyblock_safety_sample_statistics_h

#include <vector>

namespace Keyblock
{
  /** A probability as samples tell it, and where it lies with 95 %. */
  struct ProbabilityEstimate
  {
    double value = 0., lower = 0., upper = 1.;
  };

  /** That of which @p n_hits of @p n_samples were hits, with Wilson's interval
   * (1927). */
  ProbabilityEstimate estimate_probability(const unsigned int n_hits,
                                           const unsigned int n_samples);

  /** Mean, standard deviation and percentiles of a list. */
  struct SampleStatistics
  {
    /** @p values in any order; not empty */
    explicit SampleStatistics(std::vector<double> values);

    /** Value below which the share @p p of the sorted list lies, linear
     * between neighbours. */
    double percentile(const double p) const;

    double mean = 0., deviation = 0.;
    std::vector<double> sorted;
  };

  /** Coefficient of correlation of the ranks of two lists of the same length
   * (Spearman); 0 if one of them is constant. Values that differ by a part in
   * 1e12 are equal. */
  double rank_correlation(const std::vector<double> &x,
                          const std::vector<double> &y);
} // namespace Keyblock

#endif

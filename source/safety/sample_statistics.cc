// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/sample_statistics.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  ProbabilityEstimate
  estimate_probability(const unsigned int n_hits, const unsigned int n_samples)
  {
    const double z = 1.959963984540054; // of 95 %
    const double n = n_samples, p = n_hits / n, zz = z * z / n;
    const double middle = (p + 0.5 * zz) / (1. + zz);
    const double half =
      z / (1. + zz) * std::sqrt(p * (1. - p) / n + 0.25 * zz / n);
    return {p, std::max(0., middle - half), std::min(1., middle + half)};
  }



  SampleStatistics::SampleStatistics(std::vector<double> values)
    : sorted(std::move(values))
  {
    std::sort(sorted.begin(), sorted.end());
    mean = std::accumulate(sorted.begin(), sorted.end(), 0.) / sorted.size();
    for (const double x : sorted)
      deviation += (x - mean) * (x - mean);
    deviation =
      sorted.size() > 1 ? std::sqrt(deviation / (sorted.size() - 1.)) : 0.;
  }



  double
  SampleStatistics::percentile(const double p) const
  {
    const double place      = p * (sorted.size() - 1.);
    const std::size_t below = std::min<std::size_t>(place, sorted.size() - 1);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
  }



  namespace
  {
    /** Whether the values differ by no more than round-off. */
    bool
    are_equal(const double a, const double b)
    {
      constexpr double round_off = 1e-12;
      return std::abs(a - b) <= round_off * std::max(std::abs(a), std::abs(b));
    }

    /** Rank of each value in its list, equal ones sharing the mean of theirs.
     */
    std::vector<double>
    ranks_of(const std::vector<double> &x)
    {
      std::vector<std::size_t> order(x.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(),
                order.end(),
                [&](const std::size_t a, const std::size_t b) {
                  return x[a] < x[b];
                });
      std::vector<double> rank(x.size());
      for (std::size_t i = 0; i < order.size();)
        {
          std::size_t end = i + 1;
          while (end < order.size() && are_equal(x[order[end]], x[order[i]]))
            ++end;
          for (std::size_t k = i; k < end; ++k)
            rank[order[k]] = 0.5 * (i + end - 1.);
          i = end;
        }
      return rank;
    }
  } // namespace



  double
  rank_correlation(const std::vector<double> &x, const std::vector<double> &y)
  {
    if (x.empty())
      return 0.;
    const std::vector<double> a = ranks_of(x), b = ranks_of(y);
    const double middle = 0.5 * (a.size() - 1.);
    double ab = 0., aa = 0., bb = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        ab += (a[i] - middle) * (b[i] - middle);
        aa += (a[i] - middle) * (a[i] - middle);
        bb += (b[i] - middle) * (b[i] - middle);
      }
    return aa > 0. && bb > 0. ? ab / std::sqrt(aa * bb) : 0.;
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/warning_list.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/run/study_report.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <ostream>

namespace Keyblock
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    constexpr std::array<double, 7> percents = {
      {1., 5., 25., 50., 75., 95., 99.}};

    /** Bins of histograms: this many from the least to the greatest value. */
    constexpr unsigned int n_bins = 40;

    /** Points of the curve of convergence. */
    constexpr unsigned int n_points = 20;

    Json
    as_json(const ProbabilityEstimate &p)
    {
      return {{"value", p.value}, {"lower", p.lower}, {"upper", p.upper}};
    }

    /** Put statistics of @p values, if there are any, under @p key. */
    void
    put_statistics(const std::vector<double> &values,
                   const std::string &key,
                   Json &owner)
    {
      if (values.empty())
        return;
      const SampleStatistics statistics(values);
      Json json = {{"samples", values.size()},
                   {"mean", statistics.mean},
                   {"deviation", statistics.deviation},
                   {"least", statistics.sorted.front()},
                   {"greatest", statistics.sorted.back()},
                   {"percentiles", Json::object()},
                   {"histogram", Json::object()}};
      for (const double percent : percents)
        json["percentiles"][std::to_string(std::lround(percent))] =
          statistics.percentile(0.01 * percent);
      // rounding errors are no spread
      const double low   = statistics.sorted.front(),
                   size  = std::max(std::abs(low),
                                   std::abs(statistics.sorted.back())),
                   least = size > 0. ? 1e-9 * size : 1.,
                   width =
                     std::max(statistics.sorted.back() - low, least) / n_bins;
      std::vector<unsigned int> counts(n_bins, 0);
      for (const double x : values)
        ++counts[std::min<unsigned int>((x - low) / width, n_bins - 1)];
      json["histogram"] = {{"from", low}, {"width", width}, {"counts", counts}};
      owner[key]        = json;
    }

    /** The share of @p n samples that fail; its interval has no rounding errors
     * where none or all do. */
    ProbabilityEstimate
    estimate(const std::size_t n_failed, const std::size_t n)
    {
      ProbabilityEstimate p = estimate_probability(n_failed, n);
      if (n_failed == 0)
        p.lower = 0.;
      if (n_failed == n)
        p.upper = 1.;
      return p;
    }

    /** Whether values are drawn, not counted: those of seeds have no mean and
     * no rank. */
    bool
    is_drawn(const StudyVariable &variable)
    {
      return variable.distribution != Distribution::sequence;
    }

    std::ostream &
    operator<<(std::ostream &out, const ProbabilityEstimate &p)
    {
      return out << p.value << " [" << p.lower << ", " << p.upper << "]";
    }
  } // namespace



  template <int dim>
  void
  count_failed(const Blocks<dim> &blocks,
               const std::vector<double> &factors,
               const double threshold,
               SampleResult &result)
  {
    result.n_failed      = 0;
    result.failed_volume = 0.;
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      if (factors[b] < threshold)
        {
          ++result.n_failed;
          result.failed_volume += blocks.blocks[b].best_volume();
        }
  }



  template <int dim>
  StudyReport<dim>::StudyReport(const Scene<dim> &scene,
                                const Blocks<dim> *blocks,
                                const std::vector<std::vector<double>> &values,
                                const std::vector<SampleResult> &results,
                                const std::vector<std::string> &mesh_warnings,
                                const double length,
                                const double seconds,
                                const unsigned int n_resumed)
    : scene(scene)
    , blocks(blocks)
    , values(values)
    , results(results)
    , mesh_warnings(mesh_warnings)
    , length(length)
    , seconds(seconds)
    , n_resumed(n_resumed)
  {
    for (const SampleResult &result : results)
      {
        mean_failed += result.n_failed / double(results.size());
        mean_volume += result.failed_volume / results.size();
      }
  }



  template <int dim>
  ProbabilityEstimate
  StudyReport<dim>::probability_of(const std::size_t n) const
  {
    return estimate(std::count_if(results.begin(),
                                  results.begin() + n,
                                  [](const SampleResult &r) {
                                    return r.n_failed > 0;
                                  }),
                    n);
  }



  template <int dim>
  ProbabilityEstimate
  StudyReport<dim>::rigid_probability() const
  {
    return estimate(std::count_if(results.begin(),
                                  results.end(),
                                  [&](const SampleResult &r) {
                                    return r.rigid_factor <
                                           scene.study.threshold;
                                  }),
                    results.size());
  }



  template <int dim>
  ProbabilityEstimate
  StudyReport<dim>::probability_of_block(const unsigned int block) const
  {
    return estimate(std::count_if(results.begin(),
                                  results.end(),
                                  [&](const SampleResult &r) {
                                    return r.factors[block] <
                                           scene.study.threshold;
                                  }),
                    results.size());
  }



  template <int dim>
  std::vector<double>
  StudyReport<dim>::finite_factors() const
  {
    std::vector<double> factors;
    for (const SampleResult &result : results)
      if (std::isfinite(result.factor))
        factors.push_back(result.factor);
    return factors;
  }



  template <int dim>
  double
  StudyReport<dim>::correlation_of(const unsigned int variable) const
  {
    std::vector<double> x;
    for (unsigned int i = 0; i < results.size(); ++i)
      if (std::isfinite(results[i].factor))
        x.push_back(values[variable][i]);
    return rank_correlation(x, finite_factors());
  }



  template <int dim>
  void
  StudyReport<dim>::print(std::ostream &out) const
  {
    const unsigned int n_new = results.size() - n_resumed;
    for (const std::string &warning : warnings())
      WarningList::print(out, warning);
    out << std::setprecision(4) << "Study   " << results.size()
        << (scene.study.level == StudyLevel::full
              ? " samples, those with critical blocks run, "
              : " samples of limit equilibrium, ")
        << (scene.study.sampling == Sampling::random ? "random"
                                                     : "Latin hypercube")
        << ", seed " << scene.study.seed << "; " << seconds << " s";
    if (seconds > 0. && n_new > 0)
      out << ", " << 60. * n_new / seconds << " a minute";
    out << "\n        probability that a block fails (factor below "
        << scene.study.threshold << "): " << probability_of(results.size())
        << " with 95 %\n        failed blocks per sample " << mean_failed
        << ", " << (dim == 2 ? "area " : "volume ") << mean_volume
        << (dim == 2 ? " m2" : " m3")
        << ", with those that fall once others have gone, as no stress "
           "clamps them";
    if (dim == 3 && length > 0.)
      out << ", per metre of tunnel " << mean_failed / length << " and "
          << mean_volume / length << " m3";
    const std::vector<double> factors = finite_factors(),
                              found   = values_of(factors);
    if (!found.empty())
      {
        const SampleStatistics statistics(found);
        out << "\n        least factor: mean " << statistics.mean
            << ", deviation " << statistics.deviation << ", 5 % below "
            << statistics.percentile(0.05) << ", 95 % below "
            << statistics.percentile(0.95);
      }
    if (scene.study.level == StudyLevel::full)
      out << "\n        by limit equilibrium alone: " << rigid_probability();
    if (found.size() < factors.size())
      out << "\n        in " << factors.size() - found.size()
          << " samples every block holds at 'Safety factor/Highest': least "
             "factor above "
          << scene.safety.highest;
    if (factors.size() < results.size())
      out << "\n        in " << results.size() - factors.size()
          << " samples no block can move";
    out << '\n';
    for (unsigned int v = 0; v < values.size(); ++v)
      if (is_drawn(*scene.study_variables[v]))
        out << "        " << scene.study_variables[v]->name
            << ": rank correlation with the least factor " << correlation_of(v)
            << '\n';
    if (blocks)
      for (unsigned int b = 0; b < blocks->blocks.size(); ++b)
        if (probability_of_block(b).value > 0.)
          out << "        block " << blocks->blocks[b].id
              << " fails with probability " << probability_of_block(b) << '\n';
    out << std::flush;
  }



  template <int dim>
  nlohmann::ordered_json
  StudyReport<dim>::describe_blocks() const
  {
    Json list = Json::array();
    for (unsigned int b = 0; blocks && b < blocks->blocks.size(); ++b)
      {
        const Block<dim> &block = blocks->blocks[b];
        if (block.is_infinite || block.is_rigid)
          continue;
        std::vector<double> factors;
        for (const SampleResult &result : results)
          factors.push_back(result.factors[b]);
        Json json = {{"id", block.id},
                     {"volume", block.best_volume()},
                     {"probability", as_json(probability_of_block(b))}};
        put_statistics(values_of(factors), "factor", json);
        list.push_back(json);
      }
    return list;
  }



  template <int dim>
  bool
  StudyReport<dim>::write(const std::string &file_name) const
  {
    Json root = {{"scene", scene.file},
                 {"samples", results.size()},
                 {"seed", scene.study.seed},
                 {"sampling", name_of(scene.study.sampling)},
                 {"threshold", scene.study.threshold},
                 {"seconds", seconds},
                 {"resumed_samples", n_resumed},
                 {"level", name_of(scene.study.level)},
                 {"probability", as_json(probability_of(results.size()))},
                 {"rigid_probability", as_json(rigid_probability())},
                 {"failed_blocks_per_sample", mean_failed},
                 {"failed_volume_per_sample", mean_volume}};
    if (length > 0.)
      {
        root["failed_blocks_per_metre"] = mean_failed / length;
        root["failed_volume_per_metre"] = mean_volume / length;
      }
    put_statistics(values_of(finite_factors()), "least_factor", root);
    root["held_share"] = held_share();
    root["immovable_share"] =
      1. - finite_factors().size() / double(results.size());
    std::vector<double> volumes;
    for (const SampleResult &result : results)
      if (result.n_failed > 0)
        volumes.push_back(result.failed_volume);
    put_statistics(volumes, "failed_volume", root);
    root["warnings"]  = warnings();
    root["variables"] = Json::array();
    for (unsigned int v = 0; v < values.size(); ++v)
      {
        const StudyVariable &variable = *scene.study_variables[v];
        Json json                     = {{"name", variable.name},
                                         {"entry", variable.entry},
                                         {"distribution", name_of(variable.distribution)}};
        if (is_drawn(variable))
          {
            const SampleStatistics drawn(values[v]);
            json["mean"]             = drawn.mean;
            json["deviation"]        = drawn.deviation;
            json["rank_correlation"] = correlation_of(v);
          }
        root["variables"].push_back(json);
      }
    root["convergence"] = Json::array();
    for (unsigned int k = 1; k <= n_points; ++k)
      {
        const std::size_t n = k * results.size() / n_points;
        if (n > 0)
          {
            Json point       = as_json(probability_of(n));
            point["samples"] = n;
            root["convergence"].push_back(point);
          }
      }
    if (const Json list = describe_blocks(); !list.empty())
      root["blocks"] = list;
    std::ofstream out(file_name);
    out << root.dump(2) << '\n';
    return static_cast<bool>(out.flush());
  }

  template void count_failed(const Blocks<2> &,
                             const std::vector<double> &,
                             const double,
                             SampleResult &);
  template void count_failed(const Blocks<3> &,
                             const std::vector<double> &,
                             const double,
                             SampleResult &);
  template class StudyReport<2>;
  template class StudyReport<3>;
} // namespace Keyblock

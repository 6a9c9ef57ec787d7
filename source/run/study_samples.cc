// SPDX-License-Identifier: LGPL-2.1-or-later
// The samples of a study: what is drawn, and the table that it goes on from.
#include <keyblock/base/digest.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/random_numbers.h>
#include <keyblock/run/probability_study.h>

#include <boost/algorithm/string.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** A random order of 0 ... n - 1. */
    std::vector<unsigned int>
    shuffled(const unsigned int n, RandomNumbers &random)
    {
      std::vector<unsigned int> order(n);
      std::iota(order.begin(), order.end(), 0);
      for (unsigned int i = n; i > 1; --i)
        std::swap(order[i - 1],
                  order[static_cast<unsigned int>(random.uniform() * i)]);
      return order;
    }
  } // namespace



  template <int dim>
  void
  ProbabilityStudy<dim>::draw()
  {
    const unsigned int n = scene.study.samples;
    for (unsigned int v = 0; v < scene.study_variables.size(); ++v)
      {
        // a stream of its own, so that another variable changes none of it
        RandomNumbers random(scene.study.seed +
                             0x9E3779B97F4A7C15ULL * (v + 1));
        std::vector<unsigned int> stratum;
        if (scene.study.sampling == Sampling::latin_hypercube)
          stratum = shuffled(n, random);
        std::vector<double> drawn;
        for (unsigned int i = 0; i < n; ++i)
          {
            // never 0 or 1, where normal values are infinite
            const double u =
              std::min(std::max(random.uniform(), 0x1p-54), 1. - 0x1p-53);
            const double p =
              stratum.empty() ? u : (stratum[i] + u) / static_cast<double>(n);
            drawn.push_back(scene.study_variables[v]->quantile(p, i));
          }
        values.push_back(drawn);
      }
  }



  template <int dim>
  std::string
  ProbabilityStudy<dim>::make_header() const
  {
    std::string text =
      "# study " + digest_of(scene.used_entries()) + "\nsample";
    for (const auto &variable : scene.study_variables)
      text += "," + variable->name;
    text +=
      ",factor,block,stage,exposed_blocks,failed_blocks,failed_volume,rigid_"
      "factor,coarse_mesh";
    if (geometry)
      for (const auto &block : geometry->blocks.blocks)
        text += ",factor_" + std::to_string(block.id);
    return text + "\n";
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::read_samples()
  {
    std::vector<double> rows;
    const unsigned int n =
      n_sample_figures + (geometry ? geometry->blocks.blocks.size() : 0);
    if (communicator.is_root())
      {
        std::ifstream in(folder + "samples.csv");
        std::string begin(header.size(), '\0');
        in.read(&begin[0], begin.size());
        std::string line;
        // a row that was being written when the study was killed has no end
        while (in && begin == header && std::getline(in, line) && !in.eof())
          {
            std::vector<std::string> fields;
            boost::split(fields, line, boost::is_any_of(","));
            if (fields.size() != 1 + values.size() + n ||
                fields[0] != std::to_string(rows.size() / n + 1))
              break;
            for (unsigned int i = 1 + values.size(); i < fields.size(); ++i)
              {
                double value = std::numeric_limits<double>::infinity();
                if (i == 1 + values.size() + 2)
                  value = fields[i].empty() ? 0.
                          : fields[i] == "start"
                            ? 1.
                            : scene.stage_number(fields[i]);
                else if (!fields[i].empty())
                  read_number(fields[i], false, value);
                else if (i == 1 + values.size() + 1)
                  value = 0.;
                rows.push_back(value);
              }
          }
      }
    communicator.broadcast(rows);
    for (std::size_t i = 0;
         i + n <= rows.size() && results.size() < scene.study.samples;
         i += n)
      results.push_back(
        {rows[i],
         static_cast<unsigned int>(rows[i + 1]),
         static_cast<unsigned int>(rows[i + 2]),
         static_cast<unsigned int>(rows[i + 3]),
         static_cast<unsigned int>(rows[i + 4]),
         rows[i + 5],
         rows[i + 6],
         rows[i + 7] > 0.,
         {rows.begin() + i + n_sample_figures, rows.begin() + i + n}});
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::write_samples(const unsigned int begin) const
  {
    bool is_written = true;
    if (communicator.is_root())
      {
        std::ofstream out(folder + "samples.csv",
                          begin > 0 ? std::ios::app : std::ios::trunc);
        if (begin == 0)
          out << header;
        // where nothing can move there is no factor
        const auto number = [](const double value) {
          return std::isfinite(value) ? exact_text(value) : std::string();
        };
        for (unsigned int i = begin; i < results.size(); ++i)
          {
            const SampleResult &r = results[i];
            out << i + 1;
            for (const std::vector<double> &drawn : values)
              out << ',' << exact_text(drawn[i]);
            out << ',' << number(r.factor) << ',';
            if (r.block > 0)
              out << r.block;
            out << ',';
            if (r.stage > 0)
              out << (r.stage == 1 ? "start" : scene.stages[r.stage - 2]->name);
            out << ',' << r.n_exposed << ',' << r.n_failed << ','
                << exact_text(r.failed_volume) << ',' << number(r.rigid_factor)
                << ',' << r.is_coarse;
            for (const double factor : r.factors)
              out << ',' << number(factor);
            out << '\n';
          }
        is_written = static_cast<bool>(out.flush());
      }
    communicator.assert_written(is_written, folder + "samples.csv");
  }

#define INSTANTIATE(dim)                                                       \
  template void ProbabilityStudy<dim>::draw();                                 \
  template std::string ProbabilityStudy<dim>::make_header() const;             \
  template void ProbabilityStudy<dim>::read_samples();                         \
  template void ProbabilityStudy<dim>::write_samples(const unsigned int) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

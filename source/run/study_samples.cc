// SPDX-License-Identifier: LGPL-2.1-or-later
// The samples of a study: what is drawn, and the table that it goes on from.
#include <keyblock/base/digest.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/random_numbers.h>
#include <keyblock/run/probability_study.h>
#include <keyblock/scene/entries.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

namespace Keyblock
{
  std::vector<double>
  figures_of(const SampleResult &r)
  {
    std::vector<double> figures = {r.factor,
                                   double(r.block),
                                   double(r.stage),
                                   double(r.n_exposed),
                                   double(r.n_failed),
                                   r.failed_volume,
                                   r.rigid_factor,
                                   double(r.is_coarse)};
    figures.insert(figures.end(), r.factors.begin(), r.factors.end());
    return figures;
  }



  SampleResult
  result_of(const double *figures, const unsigned int n)
  {
    return {figures[0],
            static_cast<unsigned int>(figures[1]),
            static_cast<unsigned int>(figures[2]),
            static_cast<unsigned int>(figures[3]),
            static_cast<unsigned int>(figures[4]),
            figures[5],
            figures[6],
            figures[7] > 0.,
            std::vector<double>(figures + n_sample_figures, figures + n)};
  }



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

    /** Empty if there is no such file. */
    std::string
    content_of(const std::string &file_name)
    {
      std::ostringstream text;
      std::ifstream in(file_name, std::ios::binary);
      if (in.peek() != std::ifstream::traits_type::eof())
        text << in.rdbuf();
      return text.str();
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
  ProbabilityStudy<dim>::entries_of_samples(
    const std::vector<std::pair<std::string, std::string>> &entries) const
  {
    const bool has_strata =
      scene.study.sampling == Sampling::latin_hypercube &&
      std::any_of(scene.study_variables.begin(),
                  scene.study_variables.end(),
                  [](const auto &variable) {
                    return variable->distribution != Distribution::sequence;
                  });
    std::string text;
    for (const auto &[name, value] : entries)
      if ((has_strata || name != "Study/Samples") &&
          (!geometry || name != "Study/Threshold"))
        text += name + " = " + value + '\n';
    return text;
  }



  template <int dim>
  std::string
  ProbabilityStudy<dim>::make_header() const
  {
    std::string text =
      "# study " +
      // results without what falls once others have gone, or have uncovered it,
      // are of another study
      digest_of("with others gone, and uncovered, the first one counts\n" +
                entries_of_samples(list_entries(scene.used_entries()))) +
      "\nsample";
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
  std::vector<double>
  ProbabilityStudy<dim>::figures_of_row(
    const std::vector<std::string> &fields) const
  {
    std::vector<double> figures;
    for (unsigned int i = 1 + values.size(); i < fields.size(); ++i)
      {
        const unsigned int column = i - 1 - values.size();
        double value              = std::numeric_limits<double>::infinity();
        if (column == 2)
          value = fields[i].empty()      ? 0.
                  : fields[i] == "start" ? 1.
                                         : scene.stage_number(fields[i]);
        else if (!fields[i].empty())
          read_number(fields[i], false, value);
        else if (column == 1)
          value = 0.;
        figures.push_back(value);
      }
    return figures;
  }



  template <int dim>
  std::string
  ProbabilityStudy<dim>::take_rows(const std::string &text,
                                   std::vector<double> &figures) const
  {
    const unsigned int n_drawn = values.size();
    const unsigned int n =
      n_sample_figures + (geometry ? geometry->blocks.blocks.size() : 0);
    std::string rows;
    std::istringstream in(text);
    unsigned int number = 0;
    // a row that was being written when the study was killed has no end
    for (std::string line; std::getline(in, line) && !in.eof();)
      {
        std::vector<std::string> fields;
        boost::split(fields, line, boost::is_any_of(","));
        if (fields.size() != 1 + n_drawn + n ||
            fields[0] != std::to_string(++number))
          break;
        std::vector<double> row = figures_of_row(fields);
        if (geometry)
          {
            SampleResult result = result_of(row.data(), n);
            count_failed(geometry->blocks,
                         result.factors,
                         scene.study.threshold,
                         result);
            row                     = figures_of(result);
            fields[1 + n_drawn + 4] = std::to_string(result.n_failed);
            fields[1 + n_drawn + 5] = exact_text(result.failed_volume);
          }
        rows += boost::join(fields, ",") + '\n';
        figures.insert(figures.end(), row.begin(), row.end());
      }
    return rows;
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::read_samples()
  {
    std::vector<double> figures;
    const unsigned int n =
      n_sample_figures + (geometry ? geometry->blocks.blocks.size() : 0);
    if (communicator.is_root())
      {
        const std::string text = content_of(folder + "samples.csv");
        // of a study that was killed at once there is a part of the header
        table.is_of_other_study =
          text.compare(0, header.size(), header, 0, text.size()) != 0;
        if (!table.is_of_other_study && text.size() >= header.size())
          table.rows = take_rows(text.substr(header.size()), figures);
        table.is_as_it_should_be = text == header + table.rows;
        table.n_rows             = figures.size() / n;
        figures.resize(
          std::min<std::size_t>(figures.size(),
                                std::size_t(n) * scene.study.samples));
      }
    communicator.broadcast(figures);
    for (std::size_t i = 0; i < figures.size(); i += n)
      results.push_back(result_of(&figures[i], n));
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::move_other_study_away() const
  {
    namespace fs    = std::filesystem;
    using Entries   = std::vector<std::pair<std::string, std::string>>;
    unsigned int k  = 1;
    const auto name = [&]() { return folder + "earlier_" + std::to_string(k); };
    while (fs::exists(name()))
      ++k;
    const auto lines = [&](const Entries &entries) {
      std::vector<std::string> list;
      const std::string text = entries_of_samples(entries);
      boost::split(list, text, boost::is_any_of("\n"));
      return std::set<std::string>(list.begin(), list.end());
    };
    const auto now  = lines(list_entries(scene.used_entries()));
    const auto then = lines(list_entries(content_of(folder + "used.prm")));
    std::string difference;
    for (const std::string &line : now)
      if (then.size() > 1 && then.count(line) == 0 && difference.empty() &&
          line.find("/Digest of ") == std::string::npos)
        difference = "; it now has '" + line.substr(0, 80) + "'";
    std::error_code error;
    fs::create_directories(name(), error);
    for (const char *file :
         {"samples.csv", "study.json", "used.prm", "samples"})
      if (!error && fs::exists(folder + file))
        fs::rename(folder + file, name() + "/" + file, error);
    AssertThrow(!error,
                InputError("The results of another study cannot be moved to '" +
                           name() + "'; name another output folder."));
    std::cout << "Study   the results in '" << folder
              << "' are of other samples" << difference << "; they are now in '"
              << name() << "'" << std::endl;
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::begin_table() const
  {
    if (table.is_of_other_study)
      move_other_study_away();
    if (table.n_rows > results.size())
      std::cout << "Study   " << table.n_rows << " samples are there, of which "
                << "the first " << results.size() << " count" << std::endl;
    else if (table.n_rows > 0)
      std::cout << "Study   goes on after " << table.n_rows << " samples"
                << std::endl;
    if (table.is_as_it_should_be)
      return;
    // beside it, so that nothing is lost if this is killed
    const std::string name = folder + "samples.csv", part = name + ".part";
    std::ofstream out(part, std::ios::binary);
    out << header << table.rows;
    out.close();
    std::error_code error;
    std::filesystem::rename(part, name, error);
    AssertThrow(out && !error,
                InputError("The file '" + name +
                           "' cannot be written; check free space and "
                           "permissions."));
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::write_samples(const unsigned int begin) const
  {
    bool is_written = true;
    if (communicator.is_root())
      {
        std::ofstream out(folder + "samples.csv",
                          std::ios::binary | std::ios::app);
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
  template void ProbabilityStudy<dim>::begin_table() const;                    \
  template void ProbabilityStudy<dim>::write_samples(const unsigned int) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

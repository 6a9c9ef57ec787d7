// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/geostress/measurements.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace Keyblock
{
  template <int dim>
  const std::vector<std::string> &
  component_names()
  {
    static const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"xx", "yy", "zz", "xy"}
               : std::vector<std::string>{"xx", "yy", "zz", "yz", "xz", "xy"};
    return names;
  }

  namespace
  {
    /** Whether the words of a first line name columns: its places are no
     * numbers. */
    template <int dim>
    bool
    is_header(const std::vector<std::string> &words)
    {
      try
        {
          for (unsigned int d = 0; d < dim; ++d)
            dealii::Utilities::string_to_double(words.at(d));
          return false;
        }
      catch (const std::exception &)
        {
          return true;
        }
    }
  } // namespace



  template <int dim>
  std::vector<Measurement<dim>>
  read_measurements(const Scene<dim> &scene)
  {
    const std::filesystem::path path =
      std::filesystem::path(scene.file).parent_path() /
      scene.initial_state.measured_points;
    std::ifstream in(path);
    AssertThrow(in,
                InputError("The file '" + path.string() +
                           "' of the entry 'Initial state/Measured points' "
                           "cannot be read; check its path."));
    std::vector<Measurement<dim>> list;
    std::string line;
    for (unsigned int number = 1; std::getline(in, line); ++number)
      {
        if (line.empty() || line[0] == '#')
          continue;
        const std::vector<std::string> words =
          dealii::Utilities::split_string_list(line, ',');
        if (number == 1 && is_header<dim>(words))
          continue;
        const auto complain = [&](const std::string &what) {
          AssertThrow(false,
                      InputError("Line " + std::to_string(number) + " of '" +
                                 path.string() + "' " + what +
                                 "; a line is x,y," + (dim == 3 ? "z," : "") +
                                 "component,value,weight."));
        };
        if (words.size() != dim + 3)
          complain("has " + std::to_string(words.size()) + " columns");
        Measurement<dim> m;
        try
          {
            for (unsigned int d = 0; d < dim; ++d)
              m.place[d] = dealii::Utilities::string_to_double(words[d]);
            m.value  = dealii::Utilities::string_to_double(words[dim + 1]);
            m.weight = dealii::Utilities::string_to_double(words[dim + 2]);
          }
        catch (const dealii::ExceptionBase &)
          {
            complain("has a number that cannot be read");
          }
        const auto &names = component_names<dim>();
        m.component =
          std::find(names.begin(), names.end(), words[dim]) - names.begin();
        if (m.component == names.size())
          complain("names the component '" + words[dim] + "'");
        if (!(m.weight > 0.) || !std::isfinite(m.value))
          complain("needs a finite value and a positive weight");
        for (unsigned int d = 0; d <= dim; ++d)
          m.text += words[d] + (d < dim ? "," : "");
        list.push_back(m);
      }
    return list;
  }

  template const std::vector<std::string> &component_names<2>();
  template const std::vector<std::string> &component_names<3>();
  template std::vector<Measurement<2>> read_measurements(const Scene<2> &);
  template std::vector<Measurement<3>> read_measurements(const Scene<3> &);
} // namespace Keyblock

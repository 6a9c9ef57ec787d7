// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether a checkpoint is of this scene and mesh.
#include <keyblock/checkpoint/checkpoint.h>
#include <keyblock/scene/entries.h>

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <map>
#include <sstream>

namespace Keyblock
{
  template <int dim>
  std::string
  signature(const SplitMesh<dim> &split)
  {
    // Fowler, Noll and Vo: h = (h xor byte) * prime
    std::uint64_t h = 14695981039346656037ull;
    const auto add  = [&h](const auto &value) {
      unsigned char bytes[sizeof(value)];
      std::memcpy(bytes, &value, sizeof(value));
      for (const unsigned char byte : bytes)
        h = (h ^ byte) * 1099511628211ull;
    };
    for (const Point<dim> &vertex : split.mesh.vertices)
      for (unsigned int d = 0; d < dim; ++d)
        add(vertex[d]);
    for (const auto &cell : split.mesh.cells)
      for (const unsigned int vertex : cell)
        add(vertex);
    for (const Pair<dim> &pair : split.interface.pairs)
      for (const unsigned int number : {pair.minus, pair.plus, pair.joint})
        add(number);
    std::ostringstream out;
    out << std::hex << std::setw(16) << std::setfill('0') << h;
    return out.str();
  }



  std::array<std::string, 3>
  find_difference(const std::string &saved,
                  const std::string &present,
                  const std::vector<std::string> &changeable,
                  const std::vector<std::string> &fixed)
  {
    const auto old_values = list_entries(saved),
               new_values = list_entries(present);
    const std::map<std::string, std::string> before(old_values.begin(),
                                                    old_values.end());
    const std::map<std::string, std::string> now(new_values.begin(),
                                                 new_values.end());
    const auto value_in = [](const std::map<std::string, std::string> &values,
                             const std::string &entry) {
      const auto found = values.find(entry);
      return found == values.end() ? "missing" : "'" + found->second + "'";
    };
    const auto is_free = [&](const std::string &entry) {
      if (std::find(fixed.begin(), fixed.end(), entry) != fixed.end())
        return false;
      return std::any_of(
        changeable.begin(), changeable.end(), [&](const auto &beginning) {
          return entry.compare(0, beginning.size(), beginning) == 0;
        });
    };
    for (const auto *values : {&old_values, &new_values})
      for (const auto &[entry, value] : *values)
        if (value_in(before, entry) != value_in(now, entry) && !is_free(entry))
          return {{entry, value_in(before, entry), value_in(now, entry)}};
    return {};
  }

  template std::string signature(const SplitMesh<2> &);
  template std::string signature(const SplitMesh<3> &);
} // namespace Keyblock

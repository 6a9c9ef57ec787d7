// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/spelling.h>

#include <algorithm>
#include <vector>

namespace Keyblock
{
  bool
  is_like(const std::string &word, const std::string &known)
  {
    const std::size_t n = word.size(), m = known.size();
    const std::size_t slips = m < 4 ? 0 : m < 8 ? 1 : 2;
    if (std::max(n, m) - std::min(n, m) > slips)
      return false;
    std::vector<std::vector<std::size_t>> distance(n + 1,
                                                   std::vector<std::size_t>(m +
                                                                            1));
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; j <= m; ++j)
        {
          std::size_t &least = distance[i][j];
          least              = i == 0 ? j : i;
          if (i == 0 || j == 0)
            continue;
          least = std::min(
            {distance[i - 1][j] + 1,
             distance[i][j - 1] + 1,
             distance[i - 1][j - 1] + (word[i - 1] == known[j - 1] ? 0 : 1)});
          if (i > 1 && j > 1 && word[i - 1] == known[j - 2] &&
              word[i - 2] == known[j - 1])
            least = std::min(least, distance[i - 2][j - 2] + 1);
        }
    return distance[n][m] <= slips;
  }
} // namespace Keyblock

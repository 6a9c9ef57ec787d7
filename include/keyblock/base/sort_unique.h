// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_sort_unique_h
#define keyblock_base_sort_unique_h

#include <algorithm>
#include <vector>

namespace Keyblock
{
  /** Sort @p list and leave one of equal values. */
  template <typename Value>
  void
  sort_unique(std::vector<Value> &list)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
} // namespace Keyblock

#endif

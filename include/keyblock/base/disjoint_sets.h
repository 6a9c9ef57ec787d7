// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_disjoint_sets_h
#define keyblock_base_disjoint_sets_h

#include <algorithm>
#include <numeric>
#include <vector>

namespace Keyblock
{
  /** Sets that grow together; the root of a set is its least member. */
  class DisjointSets
  {
  public:
    explicit DisjointSets(const unsigned int n)
      : parent(n)
    {
      std::iota(parent.begin(), parent.end(), 0);
    }

    unsigned int
    root(unsigned int i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }

    void
    join(const unsigned int a, const unsigned int b)
    {
      const unsigned int ra = root(a), rb = root(b);
      parent[std::max(ra, rb)] = std::min(ra, rb);
    }

  private:
    std::vector<unsigned int> parent;
  };
} // namespace Keyblock

#endif

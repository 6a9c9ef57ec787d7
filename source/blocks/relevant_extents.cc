// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/rock_cut.h>

#include <algorithm>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Extents that each one crosses. */
    template <int dim>
    std::vector<std::vector<unsigned int>>
    list_crossings(const std::vector<PlaneExtent<dim>> &extents,
                   const ConvexCells<dim> &cells)
    {
      // large ones reach all; of others only those near along x
      std::vector<unsigned int> order(extents.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const auto a, const auto b) {
                         return extents[a].lowest_x() < extents[b].lowest_x();
                       });
      std::vector<std::vector<unsigned int>> crossings(extents.size());
      for (unsigned int i = 0; i < order.size(); ++i)
        for (unsigned int k = i + 1; k < order.size(); ++k)
          {
            const unsigned int a = order[i], b = order[k];
            if (extents[b].lowest_x() > extents[a].highest_x())
              break;
            if (extents[a].crosses(extents[b], cells))
              {
                crossings[a].push_back(b);
                crossings[b].push_back(a);
              }
          }
      return crossings;
    }
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  find_relevant_extents(const std::vector<PlaneExtent<dim>> &extents,
                        const std::vector<bool> &touches_excavation,
                        const ConvexCells<dim> &cells)
  {
    const unsigned int n = extents.size();
    const auto crossings = list_crossings(extents, cells);
    // those that too few others end go, again and again
    std::vector<bool> is_left(n, true);
    std::vector<unsigned int> n_ends(n), front;
    const auto drop_if_too_few = [&](const unsigned int i) {
      if (is_left[i] && n_ends[i] < dim)
        {
          is_left[i] = false;
          front.push_back(i);
        }
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        n_ends[i] = crossings[i].size() + (touches_excavation[i] ? dim : 0);
        drop_if_too_few(i);
      }
    while (!front.empty())
      {
        const unsigned int i = front.back();
        front.pop_back();
        for (const unsigned int k : crossings[i])
          {
            --n_ends[k];
            drop_if_too_few(k);
          }
      }
    // of the rest, what is connected with an excavation
    std::vector<bool> is_reached(n, false);
    const auto reach = [&](const unsigned int i) {
      if (is_left[i] && !is_reached[i])
        {
          is_reached[i] = true;
          front.push_back(i);
        }
    };
    for (unsigned int i = 0; i < n; ++i)
      if (touches_excavation[i])
        reach(i);
    while (!front.empty())
      {
        const unsigned int i = front.back();
        front.pop_back();
        for (const unsigned int k : crossings[i])
          reach(k);
      }
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < n; ++i)
      if (is_reached[i])
        result.push_back(i);
    return result;
  }



#define INSTANTIATE(dim)                                                       \
  template std::vector<unsigned int> find_relevant_extents(                    \
    const std::vector<PlaneExtent<dim>> &,                                     \
    const std::vector<bool> &,                                                 \
    const ConvexCells<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

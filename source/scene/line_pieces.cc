// SPDX-License-Identifier: LGPL-2.1-or-later
// Which lines of a drawing go on from one to another.
#include <keyblock/base/box.h>
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/scene/plane_facets.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Distance of ends that meet, over the size of the drawing [-]. */
    constexpr double closeness = 1e-9;
  } // namespace



  std::vector<std::vector<std::vector<Point<2>>>>
  pieces_of_paths(const std::vector<std::vector<Point<2>>> &paths)
  {
    std::vector<Point<2>> all;
    for (const auto &path : paths)
      all.insert(all.end(), path.begin(), path.end());
    const double tolerance = closeness * diagonal_of_box(all);
    struct Meeting
    {
      Point<2> place;
      std::vector<unsigned int> paths;
    };
    std::vector<Meeting> meetings;
    for (unsigned int i = 0; i < paths.size(); ++i)
      for (const Point<2> &end : {paths[i].front(), paths[i].back()})
        {
          auto at =
            std::find_if(meetings.begin(),
                         meetings.end(),
                         [&](const Meeting &meeting) {
                           return meeting.place.distance(end) <= tolerance;
                         });
          if (at == meetings.end())
            at = meetings.insert(at, {end, {}});
          at->paths.push_back(i);
        }
    DisjointSets together(paths.size());
    for (const Meeting &meeting : meetings)
      if (meeting.paths.size() == 2)
        together.join(meeting.paths[0], meeting.paths[1]);
    std::map<unsigned int, unsigned int> piece_of_root;
    std::vector<std::vector<std::vector<Point<2>>>> pieces;
    for (unsigned int i = 0; i < paths.size(); ++i)
      {
        const auto [entry, is_new] =
          piece_of_root.emplace(together.root(i), pieces.size());
        if (is_new)
          pieces.emplace_back();
        pieces[entry->second].push_back(paths[i]);
      }
    return pieces;
  }

} // namespace Keyblock

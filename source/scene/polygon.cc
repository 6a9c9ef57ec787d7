// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/scene/polygon.h>

// no rescaling to integers: coordinates are metres, and small
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>

#include <algorithm>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Twice the area of a triangle, positive if it is counterclockwise [m2].
     */
    double
    twice_area(const dealii::Point<2> &a,
               const dealii::Point<2> &b,
               const dealii::Point<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    /** The side of the line from @p a to @p b on which @p c lies: 1 left, -1
     * right, 0 on the line up to rounding. */
    int
    side_of(const dealii::Point<2> &a,
            const dealii::Point<2> &b,
            const dealii::Point<2> &c)
    {
      constexpr double rounding = 1e-12;
      const double area         = twice_area(a, b, c);
      if (std::abs(area) <=
          rounding * a.distance(b) * std::max(a.distance(c), b.distance(c)))
        return 0;
      return area > 0. ? 1 : -1;
    }
  } // namespace



  std::string
  fault_of_polygon(const std::vector<dealii::Point<2>> &corners)
  {
    namespace geometry = boost::geometry;
    geometry::model::ring<geometry::model::d2::point_xy<double>> ring;
    for (const auto &corner : corners)
      ring.emplace_back(corner[0], corner[1]);
    geometry::correct(ring);
    geometry::validity_failure_type failure;
    if (geometry::is_valid(ring, failure))
      return "";
    switch (failure)
      {
        case geometry::failure_few_points:
        case geometry::failure_wrong_topological_dimension:
          return "has no area";
        case geometry::failure_spikes:
          return "has a spike";
        case geometry::failure_duplicate_points:
          return "";
        case geometry::failure_invalid_coordinate:
          return "has corners that are no finite numbers";
        default:
          return "crosses or touches itself";
      }
  }



  std::vector<std::vector<unsigned int>>
  convex_parts(const std::vector<dealii::Point<2>> &corners)
  {
    std::vector<unsigned int> rest(corners.size());
    std::iota(rest.begin(), rest.end(), 0);
    double area = 0.;
    for (unsigned int i = 2; i < corners.size(); ++i)
      area += twice_area(corners[0], corners[i - 1], corners[i]);
    if (area < 0.)
      std::reverse(rest.begin(), rest.end());
    const auto at = [&](const unsigned int i) -> const dealii::Point<2> & {
      return corners[rest[i % rest.size()]];
    };
    const auto turn_at = [&](const unsigned int i) {
      return side_of(at(i + rest.size() - 1), at(i), at(i + 1));
    };
    const auto is_ear = [&](const unsigned int i) {
      const auto &a = at(i + rest.size() - 1), &b = at(i), &c = at(i + 1);
      for (unsigned int k = i + 2; k < i + rest.size() - 1; ++k)
        if (side_of(a, b, at(k)) >= 0 && side_of(b, c, at(k)) >= 0 &&
            side_of(c, a, at(k)) >= 0)
          return false;
      return true;
    };
    std::vector<std::vector<unsigned int>> parts;
    while (rest.size() >= 3)
      {
        std::vector<int> turns;
        for (unsigned int i = 0; i < rest.size(); ++i)
          turns.push_back(turn_at(i));
        if (*std::min_element(turns.begin(), turns.end()) >= 0)
          {
            parts.push_back(rest);
            break;
          }
        // corners in straight lines first: they are no ears
        unsigned int next =
          std::find(turns.begin(), turns.end(), 0) - turns.begin();
        for (unsigned int i = 0; next == rest.size() && i < rest.size(); ++i)
          if (turns[i] > 0 && is_ear(i))
            next = i;
        Assert(next < rest.size(),
               dealii::ExcMessage("A polygon that is not simple."));
        if (next == rest.size())
          break;
        const unsigned int n = rest.size();
        if (turns[next] > 0)
          parts.push_back(
            {rest[(next + n - 1) % n], rest[next], rest[(next + 1) % n]});
        rest.erase(rest.begin() + next);
      }
    return parts;
  }



  HullOfPolygon::HullOfPolygon(const std::vector<dealii::Point<2>> &corners)
  {
    const unsigned int n = corners.size();
    double area          = 0.;
    for (unsigned int i = 0; i < n; ++i)
      area += twice_area(corners[0], corners[i], corners[(i + 1) % n]);
    // number i counterclockwise, and the edge from there to the next one
    const auto corner = [&](const unsigned int i) {
      return area > 0. ? i % n : n - 1 - i % n;
    };
    const auto edge = [&](const unsigned int i) {
      return area > 0. ? i % n : (2 * n - 2 - i % n) % n;
    };
    const unsigned int first =
      std::min_element(corners.begin(),
                       corners.end(),
                       [](const auto &a, const auto &b) {
                         return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
                       }) -
      corners.begin();
    unsigned int i = 0;
    while (corner(i) != first)
      ++i;
    for (const unsigned int last = i + n; i < last;)
      {
        // the corner that has all others to the left, the farthest of these
        unsigned int j = i + 1;
        for (unsigned int k = i + 2; k <= last && k < i + n; ++k)
          {
            const double turn = twice_area(corners[corner(i)],
                                           corners[corner(j)],
                                           corners[corner(k)]);
            if (turn <= 0.)
              j = k;
          }
        sides.push_back({corner(i), corner(j), {}});
        const auto is_on = [&](const unsigned int k) {
          return side_of(corners[corner(i)],
                         corners[corner(j)],
                         corners[corner(k)]) == 0;
        };
        for (unsigned int k = i; k < j;)
          {
            unsigned int next = k + 1;
            while (!is_on(next))
              ++next;
            if (next == k + 1)
              sides.back().edges.push_back(edge(k));
            else
              {
                pockets.emplace_back();
                for (unsigned int m = k; m <= next; ++m)
                  pockets.back().corners.push_back(corners[corner(m)]);
                for (unsigned int m = k; m < next; ++m)
                  pockets.back().edges.push_back(edge(m));
              }
            k = next;
          }
        i = j;
      }
  }



  template <int dim>
  void
  tidy_corners(std::vector<dealii::Point<dim>> &corners,
               const std::string &entry)
  {
    /** Distance over the largest one up to which corners are the same [-]. */
    constexpr double closeness = 1e-9;
    double size                = 0.;
    for (const auto &corner : corners)
      size = std::max(size, corner.distance(corners.front()));
    const auto are_same = [&](const unsigned int i, const unsigned int j) {
      return corners[i].distance(corners[j]) <= closeness * size;
    };
    if (corners.size() > 3 && are_same(0, corners.size() - 1))
      corners.pop_back();
    for (unsigned int i = 1; i < corners.size(); ++i)
      AssertThrow(!are_same(i - 1, i),
                  InputError("In the entry '" + entry + "' corner " +
                             std::to_string(i + 1) + " repeats corner " +
                             std::to_string(i) + "; leave one of them out."));
  }

  template void tidy_corners(std::vector<dealii::Point<2>> &,
                             const std::string &);
  template void tidy_corners(std::vector<dealii::Point<3>> &,
                             const std::string &);
} // namespace Keyblock

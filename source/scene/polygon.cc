// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/scene/polygon.h>

// no rescaling to integers: coordinates are metres, and small
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>

#include <algorithm>

namespace Keyblock
{
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

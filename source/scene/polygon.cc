// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/polygon.h>

// no rescaling to integers: coordinates are metres, and small
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>

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
} // namespace Keyblock

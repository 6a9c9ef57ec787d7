// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_snap_distance_h
#define keyblock_mesh_snap_distance_h

#include <deal.II/base/point.h>

#include <utility>
#include <vector>

namespace Keyblock
{
  /** How near a vertex must be to be moved onto a joint, over the target size:
   * a usual distance, and a quarter of it around places where moved faces have
   * changed a piece of rock. */
  template <int dim>
  class SnapDistance
  {
  public:
    /** The places, each with the radius around it [m]. */
    using Places = std::vector<std::pair<dealii::Point<dim>, double>>;

    explicit SnapDistance(const double usual, const Places &places = {})
      : usual(usual)
      , places(places)
    {}

    /** That at a place [-]. */
    double
    at(const dealii::Point<dim> &place) const
    {
      for (const auto &[center, radius] : places)
        if (place.distance_square(center) < radius * radius)
          return 0.25 * usual;
      return usual;
    }

    /** The largest of all [-]. */
    double
    largest() const
    {
      return usual;
    }

  private:
    const double usual;
    const Places places;
  };
} // namespace Keyblock

#endif

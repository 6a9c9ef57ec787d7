// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_snap_distance_h
#define keyblock_mesh_snap_distance_h

#include <deal.II/base/point.h>

#include <utility>
#include <vector>

namespace Keyblock
{
  /** How near a vertex must be to be moved onto a joint, over the target size:
   * a usual distance, and smaller ones around places where moved faces have
   * changed a piece of rock. */
  template <int dim>
  class SnapDistance
  {
  public:
    explicit SnapDistance(const double usual)
      : usual(usual)
    {}

    /** Let it be a quarter of what it is at each of some @p places, within the
     * radius [m] that stands with each. */
    void
    reduce(const std::vector<std::pair<dealii::Point<dim>, double>> &places)
    {
      std::vector<Ball> reduced;
      reduced.reserve(places.size());
      for (const auto &[center, radius] : places)
        reduced.push_back({center, radius, 0.25 * at(center)});
      balls.insert(balls.end(), reduced.begin(), reduced.end());
    }

    /** That at a place [-]. */
    double
    at(const dealii::Point<dim> &place) const
    {
      double least = usual;
      for (const Ball &ball : balls)
        if (ball.value < least &&
            place.distance_square(ball.center) < ball.radius * ball.radius)
          least = ball.value;
      return least;
    }

    /** The largest of all [-]. */
    double
    largest() const
    {
      return usual;
    }

  private:
    struct Ball
    {
      dealii::Point<dim> center;
      double radius, value;
    };

    const double usual;
    std::vector<Ball> balls;
  };
} // namespace Keyblock

#endif

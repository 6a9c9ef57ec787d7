// SPDX-License-Identifier: LGPL-2.1-or-later
// Bent joints as a whole: which of their facets is near, sides and rims.
#include <deal.II/numerics/rtree.h>

#include <keyblock/base/box.h>
#include <keyblock/mesh/joint_sheet.h>
#include <keyblock/mesh/sheet_ridges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace Keyblock
{
  namespace
  {
    namespace bgi = boost::geometry::index;

    /** Over the size of a sheet [-]: distances that are the same. */
    constexpr double closeness = 1e-9;

    template <int dim>
    Point<dim>
    nearest_on(const Ridge<dim> &ridge, const Point<dim> &p)
    {
      if constexpr (dim == 2)
        return ridge[0];
      else
        {
          const Tensor<1, dim> edge = ridge[1] - ridge[0];
          return ridge[0] +
                 std::clamp((p - ridge[0]) * edge / (edge * edge), 0., 1.) *
                   edge;
        }
    }
  } // namespace



  /** Boxes around facets, and what their ridges are. */
  template <int dim>
  struct JointSheet<dim>::Search
  {
    using Entry = std::pair<BoundingBox<dim>, unsigned int>;
    using Tree  = decltype(dealii::pack_rtree(std::vector<Entry>()));

    struct FacetRidge
    {
      Ridge<dim> place;
      bool is_rim;
    };

    /** What is nearest to a point. */
    struct Foot
    {
      unsigned int facet = 0;
      Point<dim> place;
      bool is_beyond_rim = false;
    };

    double tolerance = 0.; ///< [m]
    Tree tree;
    std::vector<std::vector<FacetRidge>> ridges; ///< of each facet
    std::vector<Ridge<dim>> rim;
    std::vector<bool> is_turned;

    Foot
    foot(const Point<dim> &p, const std::vector<JointExtent<dim>> &facets) const
    {
      Foot result;
      double least = 1e300, height = 0.;
      for (auto near = tree.qbegin(bgi::nearest(p, facets.size()));
           near != tree.qend() &&
           distance_from_box(near->first, p) <= least + tolerance;
           ++near)
        {
          const JointExtent<dim> &facet = facets[near->second];
          const double distance         = facet.distance_to_joint(p),
                       above            = std::abs(facet.distance(p));
          // of two that meet there the one that faces the point
          const bool is_nearer =
            distance < least - tolerance ||
            (distance < least + tolerance &&
             (above > height ||
              (above == height && near->second < result.facet)));
          least = std::min(least, distance);
          if (is_nearer)
            {
              height       = above;
              result.facet = near->second;
            }
        }
      const JointExtent<dim> &facet = facets[result.facet];
      result.place                  = p - facet.distance(p) * facet.normal;
      if (facet.depth_inside(p) >= 0.)
        return result;
      const Point<dim> shadow = result.place;
      least                   = 1e300;
      for (const FacetRidge &ridge : ridges[result.facet])
        {
          const Point<dim> place = nearest_on<dim>(ridge.place, shadow);
          const double distance  = place.distance(shadow);
          if (distance > least + tolerance)
            continue;
          result.is_beyond_rim =
            ridge.is_rim ||
            (distance > least - tolerance && result.is_beyond_rim);
          if (distance < least)
            {
              least        = distance;
              result.place = place;
            }
        }
      return result;
    }
  };



  template <int dim>
  JointSheet<dim>::JointSheet(const Scene<dim> &scene,
                              const std::vector<unsigned int> &joints)
    : joints(joints)
  {
    facets.reserve(joints.size());
    for (const unsigned int j : joints)
      facets.emplace_back(*scene.joints[j]);
    if (is_plane())
      return;
    auto made = std::make_unique<Search>();
    std::vector<typename Search::Entry> boxes;
    std::vector<std::vector<Point<dim>>> corners;
    FacetsAtRidge<dim> at_ridge;
    std::vector<std::vector<Ridge<dim>>> ridges;
    std::vector<Point<dim>> all;
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        corners.push_back(scene.joints[joints[f]]->vertices);
        all.insert(all.end(), corners[f].begin(), corners[f].end());
        boxes.emplace_back(BoundingBox<dim>(corners[f]), f);
        ridges.push_back(ridges_of<dim>(corners[f]));
        for (const Ridge<dim> &ridge : ridges[f])
          at_ridge[ridge].push_back(f);
      }
    made->tolerance = closeness * diagonal_of_box(all);
    made->tree      = dealii::pack_rtree(boxes);
    made->ridges.resize(facets.size());
    for (unsigned int f = 0; f < facets.size(); ++f)
      for (const Ridge<dim> &ridge : ridges[f])
        {
          const bool is_rim = at_ridge.at(ridge).size() == 1;
          made->ridges[f].push_back({ridge, is_rim});
          if (is_rim)
            made->rim.push_back(ridge);
        }
    made->is_turned = turn_facets_alike<dim>(facets, corners, ridges, at_ridge);
    search          = std::move(made);
  }

  template <int dim>
  JointSheet<dim>::~JointSheet() = default;



  template <int dim>
  double
  JointSheet<dim>::distance(const Point<dim> &p) const
  {
    if (is_plane())
      return facets[0].distance(p);
    const auto foot      = search->foot(p, facets);
    const double height  = facets[foot.facet].distance(p);
    const double nearest = foot.is_beyond_rim
                             ? height
                             : std::copysign(p.distance(foot.place), height);
    return search->is_turned[foot.facet] ? -nearest : nearest;
  }



  template <int dim>
  Tensor<1, dim>
  JointSheet<dim>::normal_at(const Point<dim> &p) const
  {
    if (is_plane())
      return facets[0].normal;
    const auto foot          = search->foot(p, facets);
    const double side        = search->is_turned[foot.facet] ? -1. : 1.;
    const Tensor<1, dim> way = p - foot.place;
    if (foot.is_beyond_rim || way.norm() <= search->tolerance)
      return side * facets[foot.facet].normal;
    return (facets[foot.facet].distance(p) < 0. ? -side : side) / way.norm() *
           way;
  }



  template <int dim>
  double
  JointSheet<dim>::depth_inside(const Point<dim> &p) const
  {
    if (is_plane())
      return facets[0].depth_inside(p);
    const auto foot = search->foot(p, facets);
    if (foot.is_beyond_rim)
      return facets[foot.facet].depth_inside(p);
    double least = 1e300;
    for (const Ridge<dim> &ridge : search->rim)
      least = std::min(least,
                       foot.place.distance(nearest_on<dim>(ridge, foot.place)));
    return least;
  }



  template <int dim>
  double
  JointSheet<dim>::crossing(const Point<dim> &a,
                            const Point<dim> &b,
                            const double distance_a,
                            const double distance_b) const
  {
    const double below = std::abs(distance_a), above = std::abs(distance_b);
    const double guess = below + above > 0. ? below / (below + above) : 0.5;
    if (is_plane())
      return guess;
    double best = -1.;
    std::vector<typename Search::Entry> near;
    search->tree.query(bgi::intersects(BoundingBox<dim>({a, b})),
                       std::back_inserter(near));
    for (const auto &[box, f] : near)
      {
        const double from = facets[f].distance(a), to = facets[f].distance(b);
        if ((from < 0.) == (to < 0.))
          continue;
        const double part = from / (from - to);
        if (facets[f].depth_inside(a + part * (b - a)) >= -search->tolerance &&
            (best < 0. || std::abs(part - guess) < std::abs(best - guess)))
          best = part;
      }
    return best < 0. ? guess : best;
  }



  template <int dim>
  unsigned int
  JointSheet<dim>::facet_along(const std::vector<Point<dim>> &corners) const
  {
    if (is_plane())
      return 0;
    Point<dim> center;
    for (const Point<dim> &p : corners)
      center += p / double(corners.size());
    std::vector<Point<dim>> places = {center};
    for (const Point<dim> &p : corners)
      places.push_back(center + 0.75 * (p - center));
    unsigned int best = 0;
    double least      = 1e300;
    for (const Point<dim> &place : places)
      {
        const unsigned int facet = search->foot(place, facets).facet;
        double height            = 0.;
        for (const Point<dim> &p : corners)
          height = std::max(height, std::abs(facets[facet].distance(p)));
        if (height < least - search->tolerance)
          {
            least = height;
            best  = facet;
          }
      }
    return best;
  }



  template <int dim>
  bool
  JointSheet<dim>::is_turned(const unsigned int facet) const
  {
    return !is_plane() && search->is_turned[facet];
  }



  template <int dim>
  std::vector<Point<dim>>
  JointSheet<dim>::outermost_points() const
  {
    std::vector<Point<dim>> points;
    if (!is_infinite())
      for (const JointExtent<dim> &facet : facets)
        for (const Point<dim> &p : facet.outermost_points())
          points.push_back(p);
    return points;
  }



  template <int dim>
  double
  JointSheet<dim>::area() const
  {
    double sum = 0.;
    for (const JointExtent<dim> &facet : facets)
      sum += facet.area();
    return sum;
  }



  template <int dim>
  double
  JointSheet<dim>::half_width() const
  {
    if (is_plane())
      return facets[0].half_width();
    // as of a strip with this area and rim
    double rim = 0.;
    if constexpr (dim == 3)
      for (const auto &ridge : search->rim)
        rim += ridge[0].distance(ridge[1]);
    return dim == 2 ? 0.5 * area() : (rim > 0. ? 2. * area() / rim : 1e300);
  }

  template class JointSheet<2>;
  template class JointSheet<3>;
} // namespace Keyblock

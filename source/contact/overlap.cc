// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the two sides of joints lie on each other, for strengths per area.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/overlap.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Faces further apart than this, over their size, do not touch [-]. */
    constexpr double farthest_gap = 0.1;

    /** Cosine of normals of faces that touch, at most. */
    constexpr double least_opposition = -0.9;

    /** Overlaps smaller than this, over the face, are rounding [-]. */
    constexpr double least_overlap = 1e-9;

    /** Depths smaller than this over the size of the block's faces are
     * rounding, and those that differ by less than this share are equal [-]. */
    constexpr double rounding = 1e-12, equal = 1e-6;

    /** Length or area, and centre. */
    template <int dim>
    struct Common
    {
      double area = 0.;
      Vector<dim> center{};
    };

    /** What two segments, or two convex quadrilaterals (corners as in a cell's
     * face), have in common along a plane with @p normal. */
    Common<2>
    intersect(const std::array<Vector<2>, 2> &a,
              const std::array<Vector<2>, 2> &b,
              const Vector<2> &)
    {
      const Vector<2> along = unit<2>(difference<2>(a[1], a[0]));
      const auto place      = [&](const Vector<2> &x) {
        return dot<2>(difference<2>(x, a[0]), along);
      };
      const double low = std::max(0., std::min(place(b[0]), place(b[1])));
      const double high =
        std::min(place(a[1]), std::max(place(b[0]), place(b[1])));
      Common<2> result;
      result.area   = std::max(0., high - low);
      result.center = add<2>(a[0], 0.5 * (low + high), along);
      return result;
    }

    /** The part of a convex polygon on the inner side of a plane through
     * @p on with normal @p outward. */
    std::vector<Vector<3>>
    clip(const std::vector<Vector<3>> &polygon,
         const Vector<3> &on,
         const Vector<3> &outward)
    {
      std::vector<Vector<3>> result;
      const auto height = [&](const Vector<3> &x) {
        return dot<3>(difference<3>(x, on), outward);
      };
      for (std::size_t i = 0; i < polygon.size(); ++i)
        {
          const Vector<3> &x = polygon[i];
          const Vector<3> &y = polygon[(i + 1) % polygon.size()];
          const double hx = height(x), hy = height(y);
          if (hx <= 0.)
            result.push_back(x);
          if ((hx < 0. && hy > 0.) || (hx > 0. && hy < 0.))
            result.push_back(add<3>(x, hx / (hx - hy), difference<3>(y, x)));
        }
      return result;
    }

    Common<3>
    intersect(const std::array<Vector<3>, 4> &a,
              const std::array<Vector<3>, 4> &b,
              const Vector<3> &normal)
    {
      std::vector<Vector<3>> common          = {a[0], a[1], a[3], a[2]};
      const std::array<Vector<3>, 4> clipper = {{b[0], b[1], b[3], b[2]}};
      for (unsigned int i = 0; i < 4; ++i)
        common =
          clip(common,
               clipper[i],
               cross(difference<3>(clipper[(i + 1) % 4], clipper[i]), normal));
      Common<3> result;
      for (std::size_t i = 1; i + 1 < common.size(); ++i)
        {
          const double area =
            0.5 *
            std::abs(dot<3>(cross(difference<3>(common[i], common[0]),
                                  difference<3>(common[i + 1], common[0])),
                            normal));
          result.area += area;
          for (const Vector<3> &corner : {common[0], common[i], common[i + 1]})
            result.center = add<3>(result.center, area / 3., corner);
        }
      if (result.area > 0.)
        result.center = add<3>(Vector<3>{}, 1. / result.area, result.center);
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<FaceOverlap<dim>>
  list_overlaps(const ContactSurface<dim> &surface,
                const std::vector<double> &position,
                const std::vector<bool> &joints)
  {
    const auto joint_of = [&](const unsigned int f) {
      return surface.interface.surface[f].joint;
    };
    const auto size_of = [&](const unsigned int f) {
      const auto x = surface.corners_of(position, f);
      return norm<dim>(difference<dim>(x[x.size() - 1], x[0]));
    };
    std::vector<std::pair<dealii::BoundingBox<dim>, unsigned int>> boxes;
    for (unsigned int f = 0; f < surface.nodes_of_face.size(); ++f)
      if (joint_of(f) != none && joints[joint_of(f)])
        boxes.emplace_back(
          surface.box_of(position, f, farthest_gap * size_of(f)), f);
    const auto tree = dealii::pack_rtree(boxes);

    std::vector<FaceOverlap<dim>> overlaps;
    const auto add_overlap = [&](const unsigned int f, const unsigned int g) {
      const Vector<dim> normal = surface.face_normal(position, g);
      const auto a             = surface.corners_of(position, f),
                 b             = surface.corners_of(position, g);
      if (dot<dim>(surface.face_normal(position, f), normal) > least_opposition)
        return;
      const Common<dim> common = intersect(a, b, normal);
      if (common.area <= least_overlap * std::pow(size_of(f), dim - 1))
        return;
      const Projection<dim> on_master =
        surface.project(position, common.center, g);
      if (std::abs(on_master.gap) > farthest_gap * on_master.size)
        return;
      overlaps.push_back({f,
                          g,
                          common.area,
                          surface.project(position, common.center, f).weight,
                          on_master.weight});
    };
    namespace bgi = boost::geometry::index;
    for (const auto &[box, f] : boxes)
      {
        std::vector<unsigned int> masters;
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::intersects(box)))
          {
            const unsigned int g = hit.second;
            const unsigned int a = surface.interface.surface[f].block,
                               b = surface.interface.surface[g].block;
            if (joint_of(g) == joint_of(f) &&
                !(surface.is_rigid_block[a] && surface.is_rigid_block[b]) &&
                (a == b ? f < g : surface.is_slave_block(a, b)))
              masters.push_back(g);
          }
        std::sort(masters.begin(), masters.end());
        for (const unsigned int g : masters)
          add_overlap(f, g);
      }
    return overlaps;
  }



  namespace
  {
    /** How deep a surface node is in a block with @p faces near it, beyond how
     * deep it was at the start [m]; not above 0 if it is outside, or if a pair
     * holds it on the plane of the face. */
    template <int dim>
    double
    overlap_with(const ContactSearch<dim> &search,
                 const std::vector<double> &position,
                 const unsigned int node,
                 const std::vector<unsigned int> &faces)
    {
      const ContactSurface<dim> &surface = search.surface;
      const Vector<dim> place            = at<dim>(position, node);
      const std::vector<Projection<dim>> paired =
        search.feet_on_pairs(position, node);
      double depth = 0., distance = std::numeric_limits<double>::max();
      bool is_in_front = false; // of the nearest joint
      bool is_on_joint = false;
      for (const unsigned int f : faces)
        {
          const Projection<dim> now = surface.project(position, place, f);
          const bool is_joint = surface.interface.surface[f].joint != none;
          if (is_joint && norm<dim>(now.offset) < distance)
            {
              distance    = norm<dim>(now.offset);
              is_in_front = now.is_inside && now.gap > 0.;
            }
          if (!now.is_inside ||
              now.gap <
                -search.make_candidate(position, node, f).largest_overlap ||
              !surface.opposes(position, node, now.normal))
            continue;
          // on the face that its pair is on it is at the block's surface
          if (std::any_of(paired.begin(),
                          paired.end(),
                          [&](const Projection<dim> &other) {
                            return is_coplanar(other, now);
                          }))
            return 0.;
          if (now.gap >= 0.)
            continue;
          const double deeper = -now.gap +
                                std::min(0., surface.start_distance(node, f)) -
                                surface.rounding_of_tip(node, f);
          if (deeper <= 0.)
            continue;
          depth       = depth == 0. ? deeper : std::min(depth, deeper);
          is_on_joint = is_on_joint || is_joint;
        }
      // below a free face, along a joint at its edge, it is still outside
      if (is_in_front && !is_on_joint)
        return 0.;
      // no deeper than to the nearest joint, as at a corner that it slides off
      return std::min(depth, distance);
    }
  } // namespace



  template <int dim>
  Overlap<dim>
  find_largest_overlap(const ContactSearch<dim> &search,
                       const std::vector<double> &position,
                       const std::vector<bool> &is_removed_block)
  {
    const ContactSurface<dim> &surface = search.surface;
    std::vector<std::pair<dealii::BoundingBox<dim>, unsigned int>> boxes;
    for (const unsigned int f : surface.faces_with_area)
      if (!is_removed_block[surface.interface.surface[f].block])
        boxes.emplace_back(surface.box_of(position, f, surface.skin()), f);
    const auto tree = dealii::pack_rtree(boxes);
    Overlap<dim> largest;
    namespace bgi = boost::geometry::index;
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      {
        const unsigned int block = surface.block_of_node[node];
        if (is_removed_block[block])
          continue;
        const Vector<dim> place = at<dim>(position, node);
        dealii::Point<dim> p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = place[d];
        std::map<unsigned int, std::vector<unsigned int>> faces_near;
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::intersects(p)))
          {
            const unsigned int f = hit.second;
            if (surface.may_meet(node, f))
              faces_near[surface.interface.surface[f].block].push_back(f);
          }
        for (const auto &[other, faces] : faces_near)
          {
            const double depth =
              overlap_with<dim>(search, position, node, faces);
            // of several that are equal but for rounding the first, on any
            // ranks
            if (depth > rounding * surface.block_face_size[block] &&
                depth > (1. + equal) * largest.depth)
              largest = {depth, place};
          }
      }
    return largest;
  }

  template std::vector<FaceOverlap<2>>
  list_overlaps<2>(const ContactSurface<2> &,
                   const std::vector<double> &,
                   const std::vector<bool> &);
  template Overlap<2> find_largest_overlap<2>(const ContactSearch<2> &,
                                              const std::vector<double> &,
                                              const std::vector<bool> &);
  template std::vector<FaceOverlap<3>>
  list_overlaps<3>(const ContactSurface<3> &,
                   const std::vector<double> &,
                   const std::vector<bool> &);
  template Overlap<3> find_largest_overlap<3>(const ContactSearch<3> &,
                                              const std::vector<double> &,
                                              const std::vector<bool> &);
} // namespace Keyblock

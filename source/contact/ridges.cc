// SPDX-License-Identifier: LGPL-2.1-or-later
// Ridges that cross in 3D: edge to edge contact.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/ridges.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Points of two segments nearest to each other on their lines. */
    struct Crossing
    {
      double s, t;      ///< parameters on the first and second [-]
      double sine;      ///< of the angle between them
      Vector<3> normal; ///< unit, perpendicular to both, either way
      Vector<3> offset; ///< from the first point to the second
    };

    Crossing
    cross_segments(const Vector<3> &a0,
                   const Vector<3> &a1,
                   const Vector<3> &b0,
                   const Vector<3> &b1)
    {
      const Vector<3> a = difference<3>(a1, a0), b = difference<3>(b1, b0);
      const Vector<3> w = difference<3>(b0, a0);
      const double aa = dot<3>(a, a), ab = dot<3>(a, b), bb = dot<3>(b, b);
      const double wa = dot<3>(w, a), wb = dot<3>(w, b);
      const double det = aa * bb - ab * ab;
      Crossing result{};
      result.sine = std::sqrt(std::max(0., det / (aa * bb)));
      if (det <= 0.)
        return result;
      result.s      = (wa * bb - wb * ab) / det;
      result.t      = (wa * ab - wb * aa) / det;
      result.normal = unit<3>(cross(a, b));
      result.offset = add<3>(add<3>(w, result.t, b), -result.s, a);
      return result;
    }

    /** Cosine of 20 degrees: faces that differ by more make a ridge. */
    constexpr double cosine_of_sharp = 0.9396926207859084;

    /** Ridges nearer to parallel than this (sine) meet by their nodes. */
    constexpr double least_sine = 0.02;

    /** Cosines nearer than this are equal but for rounding. */
    constexpr double equal_alignment = 1e-9;

    bool
    is_inside(const double s)
    {
      return s > 1e-6 && s < 1. - 1e-6;
    }
  } // namespace



  RidgeSearch::RidgeSearch(const ContactSurface<3> &surface)
    : surface(surface)
  {
    const std::vector<double> &position = surface.start_position;
    std::map<std::array<unsigned int, 2>, std::vector<unsigned int>> faces_at;
    for (const unsigned int f : surface.faces_with_area)
      for (const auto &[i, j] :
           {std::array<unsigned int, 2>{{0, 1}}, {{2, 3}}, {{0, 2}}, {{1, 3}}})
        faces_at[{{std::min(surface.nodes_of_face[f][i],
                            surface.nodes_of_face[f][j]),
                   std::max(surface.nodes_of_face[f][i],
                            surface.nodes_of_face[f][j])}}]
          .push_back(f);
    const auto center = [&](const unsigned int f) {
      Vector<3> sum{};
      for (const unsigned int node : surface.nodes_of_face[f])
        sum = add<3>(sum, 0.25, at<3>(position, node));
      return sum;
    };
    for (const auto &[surface_nodes, faces] : faces_at)
      if (faces.size() == 2)
        {
          const Vector<3> n = surface.face_normal(position, faces[0]);
          if (dot<3>(n, surface.face_normal(position, faces[1])) <
                cosine_of_sharp &&
              dot<3>(n, difference<3>(center(faces[1]), center(faces[0]))) < 0.)
            ridges.push_back({surface_nodes, {{faces[0], faces[1]}}});
        }
  }



  bool
  RidgeSearch::is_in_normal_cone(const std::vector<double> &position,
                                 const Ridge &ridge,
                                 const Vector<3> &direction) const
  {
    const Vector<3> n = surface.face_normal(position, ridge.faces[0]);
    const Vector<3> m = surface.face_normal(position, ridge.faces[1]);
    const double nm = dot<3>(n, m), nd = dot<3>(n, direction),
                 md = dot<3>(m, direction);
    // direction = alpha n + beta m; the determinant is positive at a ridge
    return nd - nm * md > -1e-6 && md - nm * nd > -1e-6 && nd + md > 0.;
  }



  void
  RidgeSearch::search(const std::vector<double> &position,
                      const IsPaired &is_paired)
  {
    using Box         = dealii::BoundingBox<3>;
    const auto box_of = [&](const Ridge &ridge, const double margin) {
      std::pair<dealii::Point<3>, dealii::Point<3>> corners;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double x    = position[3 * ridge.surface_nodes[0] + d];
          const double y    = position[3 * ridge.surface_nodes[1] + d];
          corners.first[d]  = std::min(x, y) - margin;
          corners.second[d] = std::max(x, y) + margin;
        }
      return Box(corners);
    };
    std::vector<std::pair<Box, unsigned int>> boxes;
    for (unsigned int r = 0; r < ridges.size(); ++r)
      boxes.emplace_back(box_of(ridges[r], surface.skin()), r);
    const auto tree = dealii::pack_rtree(boxes);

    pairs.clear();
    const auto block_of = [&](const unsigned int r) {
      return surface.block_of_node[ridges[r].surface_nodes[0]];
    };
    const auto touches_pair = [&](const Ridge &a, const Ridge &b) {
      for (const unsigned int node : a.surface_nodes)
        for (const unsigned int f : b.faces)
          if (is_paired(node, f))
            return true;
      return false;
    };
    namespace bgi = boost::geometry::index;
    for (unsigned int r = 0; r < ridges.size(); ++r)
      for (const auto &hit : tree | bgi::adaptors::queried(
                                      bgi::intersects(box_of(ridges[r], 0.))))
        {
          const unsigned int other = hit.second;
          const unsigned int a = block_of(other), b = block_of(r);
          // each pair once, the slave's ridge first
          if (a == b ||
              (surface.is_rigid_block[a] && surface.is_rigid_block[b]) ||
              !surface.is_slave_block(b, a))
            continue;
          const Crossing crossing =
            cross_segments(at<3>(position, ridges[other].surface_nodes[0]),
                           at<3>(position, ridges[other].surface_nodes[1]),
                           at<3>(position, ridges[r].surface_nodes[0]),
                           at<3>(position, ridges[r].surface_nodes[1]));
          const auto is_near = [](const double s) { return s > -1. && s < 2.; };
          if (crossing.sine < least_sine || !is_near(crossing.s) ||
              !is_near(crossing.t) || touches_pair(ridges[r], ridges[other]) ||
              touches_pair(ridges[other], ridges[r]))
            continue;
          pairs.push_back(
            {other, r, largest_overlap(ridges[other], ridges[r])});
        }
    std::sort(pairs.begin(),
              pairs.end(),
              [](const RidgePair &x, const RidgePair &y) {
                return std::array<unsigned int, 2>{{x.slave, x.master}} <
                       std::array<unsigned int, 2>{{y.slave, y.master}};
              });
  }



  void
  RidgeSearch::mark_nodes(std::vector<bool> &is_used) const
  {
    for (const RidgePair &pair : pairs)
      for (const unsigned int r : {pair.master, pair.slave})
        for (const unsigned int f : ridges[r].faces)
          for (const unsigned int node : surface.nodes_of_face[f])
            is_used[node] = true;
  }



  double
  RidgeSearch::largest_overlap(const Ridge &master, const Ridge &slave) const
  {
    const auto start = [&](const unsigned int node) {
      return at<3>(surface.start_position, node);
    };
    const Vector<3> a0      = start(master.surface_nodes[0]),
                    a1      = start(master.surface_nodes[1]);
    const double size       = norm<3>(difference<3>(a1, a0));
    const Crossing crossing = cross_segments(a0,
                                             a1,
                                             start(slave.surface_nodes[0]),
                                             start(slave.surface_nodes[1]));
    const double outward    = dot<3>(
      crossing.normal,
      add<3>(surface.face_normal(surface.start_position, master.faces[0]),
             1.,
             surface.face_normal(surface.start_position, master.faces[1])));
    const double behind =
      -std::copysign(1., outward) * dot<3>(crossing.normal, crossing.offset);
    return largest_overlap_of(behind, size);
  }



  unsigned int
  RidgeSearch::joint_between(const std::vector<double> &position,
                             const Ridge &master,
                             const Ridge &slave,
                             const Vector<3> &normal) const
  {
    unsigned int joint = none;
    double most        = -1.;
    for (const Ridge *ridge : {&master, &slave})
      for (const unsigned int f : ridge->faces)
        {
          const double alignment =
            std::abs(dot<3>(surface.face_normal(position, f), normal));
          if (surface.interface.surface[f].joint != none &&
              alignment > most + equal_alignment)
            {
              most  = alignment;
              joint = surface.interface.surface[f].joint;
            }
        }
    return joint;
  }



  void
  RidgeSearch::add_contacts(const std::vector<double> &position,
                            const double reach,
                            std::vector<SurfaceContact<3>> &contacts) const
  {
    for (const RidgePair &pair : pairs)
      {
        const Ridge &master = ridges[pair.master], &slave = ridges[pair.slave];
        const Vector<3> a0 = at<3>(position, master.surface_nodes[0]),
                        a1 = at<3>(position, master.surface_nodes[1]);
        const Crossing crossing =
          cross_segments(a0,
                         a1,
                         at<3>(position, slave.surface_nodes[0]),
                         at<3>(position, slave.surface_nodes[1]));
        if (crossing.sine < least_sine || !is_inside(crossing.s) ||
            !is_inside(crossing.t))
          continue;
        Vector<3> normal = crossing.normal;
        if (dot<3>(normal,
                   add<3>(surface.face_normal(position, master.faces[0]),
                          1.,
                          surface.face_normal(position, master.faces[1]))) < 0.)
          normal = difference<3>(Vector<3>{}, normal);
        const double gap = dot<3>(normal, crossing.offset);
        if (gap > reach || gap < -pair.largest_overlap ||
            !is_in_normal_cone(position, master, normal) ||
            !is_in_normal_cone(position,
                               slave,
                               difference<3>(Vector<3>{}, normal)))
          continue;
        SurfaceContact<3> contact;
        contact.slave        = slave.surface_nodes[0];
        contact.face         = master.faces[0];
        contact.is_ridge     = true;
        contact.joint        = joint_between(position, master, slave, normal);
        contact.master_block = surface.interface.surface[master.faces[0]].block;
        contact.point.n_nodes = 4;
        contact.point.node    = {{slave.surface_nodes[0],
                                  slave.surface_nodes[1],
                                  master.surface_nodes[0],
                                  master.surface_nodes[1]}};
        contact.point.weight  = {
           {1. - crossing.t, crossing.t, crossing.s - 1., -crossing.s}};
        contact.point.normal = normal;
        contact.point.gap    = gap;
        contacts.push_back(contact);
      }
  }
} // namespace Keyblock

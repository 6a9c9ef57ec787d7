// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/bounding_box.h>

#include <keyblock/blocks/plane_arrangement.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    /** Lengths over the size of a cell: up to which corners count as on a
     * plane, and by which faces may lie behind outlines and beyond rims [-]. */
    constexpr double same_vertex = 1e-9, touching = 1e-6;

    /** How far a joint without faces of the block may cut into it: such a one
     * lies on another, which rules, over the size of a cell [-]. */
    constexpr double thinnest_part = 1e-5;

    /** Rounding of a coordinate over the coordinate [-]. */
    constexpr double rounding = 1e-14;

    /** Part of a block's surface on a joint from which on it says on which side
     * the block is [-]. */
    constexpr double least_share = 0.02;
  } // namespace



  template <int dim>
  PlaneArrangement<dim>::PlaneArrangement(const Mesh<dim> &mesh,
                                          const Scene<dim> &scene)
    : mesh(mesh)
  {
    for (const auto &joint : scene.joints)
      {
        joints.emplace_back(*joint);
        std::pair<Point<dim>, double> ball;
        if (!joints.back().is_infinite())
          {
            const auto points = joints.back().outermost_points();
            for (const Point<dim> &p : points)
              ball.first += p / double(points.size());
            for (const Point<dim> &p : points)
              ball.second = std::max(ball.second, p.distance(ball.first));
            // (a disc reaches beyond the polygon of its outermost points)
            ball.second = std::max(ball.second, joint->radius);
          }
        balls.push_back(ball);
      }
    std::tie(low, high) =
      dealii::BoundingBox<dim>(mesh.vertices).get_boundary_points();
    std::set<typename Mesh<dim>::FaceVertices> is_there;
    for (const auto &face : mesh.marked_faces)
      {
        const Surface<dim> &plane = mesh.surfaces[face.surface];
        auto key                  = face.vertices;
        std::sort(key.begin(), key.end());
        if (!plane.is_joint() && is_there.insert(key).second)
          add_outline(face.vertices,
                      plane.point,
                      plane.radius > 0. ? Tensor<1, dim>() : plane.normal);
      }
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        if (mesh.neighbor[c][f] == none)
          {
            const Tensor<1, dim> area = mesh.face_area_vector(c, f);
            auto key                  = mesh.face_vertices(c, f);
            std::sort(key.begin(), key.end());
            if (is_there.insert(key).second)
              add_outline(mesh.face_vertices(c, f),
                          mesh.face_center(c, f),
                          area / area.norm());
          }
  }



  template <int dim>
  void
  PlaneArrangement<dim>::add_outline(
    const typename Mesh<dim>::FaceVertices &vertices,
    const Point<dim> &point,
    const Tensor<1, dim> &normal)
  {
    OutlineFace part{{}, point, normal};
    for (const unsigned int v : vertices)
      part.corners.push_back(mesh.vertices[v]);
    if (dim == 3)
      std::swap(part.corners[2], part.corners[3]);
    outline.push_back(part);
  }



  template <int dim>
  bool
  PlaneArrangement<dim>::reaches_over(const unsigned int joint,
                                      const std::vector<Point<dim>> &section,
                                      const double tolerance) const
  {
    return joints[joint].is_infinite() ||
           std::all_of(section.begin(),
                       section.end(),
                       [&](const Point<dim> &p) {
                         return joints[joint].depth_inside(p) >= -tolerance;
                       });
  }



  /** Cut off what lies outside of the block's own faces; false if these are not
   * plane or the block does not lie behind them. */
  template <int dim>
  bool
  PlaneArrangement<dim>::cut_by_faces(ConvexBody<dim> &body,
                                      const Block<dim> &block,
                                      const std::vector<OuterFace> &faces,
                                      const bool has_outlines,
                                      std::vector<bool> &is_done) const
  {
    const double reach = touching * cell_size(block);
    double surface     = 0.;
    std::map<unsigned int, double> on_joint, on_outline; // along the normal
    std::vector<std::pair<Point<dim>, Tensor<1, dim>>> outlines;
    for (const OuterFace &face : faces)
      {
        const Tensor<1, dim> area = mesh.face_area_vector(face.cell, face.face);
        surface += area.norm();
        if (face.surface == none)
          {
            const Point<dim> p     = mesh.face_center(face.cell, face.face);
            const Tensor<1, dim> n = area / area.norm();
            if (std::none_of(outlines.begin(),
                             outlines.end(),
                             [&](const auto &plane) {
                               return plane.second * n > 0. &&
                                      std::abs((p - plane.first) * n) < reach &&
                                      (n - plane.second).norm() < touching;
                             }))
              outlines.emplace_back(p, n);
            continue;
          }
        const Surface<dim> &plane = mesh.surfaces[face.surface];
        if (plane.is_joint())
          on_joint[plane.joint] += area * joints[plane.joint].normal;
        else if (plane.radius > 0.)
          return false;
        else if (has_outlines)
          on_outline[face.surface] += area * plane.normal;
      }
    for (const auto &[s, area] : on_outline)
      outlines.emplace_back(mesh.surfaces[s].point,
                            (area > 0. ? 1. : -1.) * mesh.surfaces[s].normal);
    for (const auto &[point, outward] : outlines)
      {
        for (const OuterFace &face : faces)
          for (const unsigned int v : mesh.face_vertices(face.cell, face.face))
            if (outward * (mesh.vertices[v] - point) > reach)
              return false;
        body.cut(point, outward, joints.size());
      }
    for (const auto &[j, area] : on_joint)
      {
        const double side = joints[j].distance(block.centroid);
        if (std::abs(area) > least_share * surface && area * side > 0.)
          return false;
        body.cut(joints[j].origin,
                 (side > 0. ? -1. : 1.) * joints[j].normal,
                 j);
        is_done[j] = true;
      }
    return true;
  }



  template <int dim>
  bool
  PlaneArrangement<dim>::is_in_rock(const ConvexBody<dim> &body,
                                    const double tolerance) const
  {
    Point<dim> least = high, most = low;
    for (const auto &face : body.get_faces())
      for (const Point<dim> &p : face.corners)
        for (unsigned int d = 0; d < dim; ++d)
          {
            least[d] = std::min(least[d], p[d]);
            most[d]  = std::max(most[d], p[d]);
          }
    std::map<const typename ConvexBody<dim>::Face *, double> bare;
    for (const auto &face : body.get_faces())
      if (face.name >= joints.size())
        bare[&face] = body.area(face);
    for (const OutlineFace &part : outline)
      {
        const auto all = [&](const auto &is_beyond) {
          return std::all_of(part.corners.begin(),
                             part.corners.end(),
                             is_beyond);
        };
        bool is_apart = false, is_on_surface = false;
        for (unsigned int d = 0; d < dim; ++d)
          is_apart = is_apart || all([&](const Point<dim> &p) {
                       return p[d] > most[d] + tolerance;
                     }) ||
                     all([&](const Point<dim> &p) {
                       return p[d] < least[d] - tolerance;
                     });
        if (is_apart)
          continue;
        for (const auto &face : body.get_faces())
          {
            const auto height = [&face](const Point<dim> &p) {
              return face.outward * (p - face.corners[0]);
            };
            if (!all([&](const auto &p) { return height(p) >= -tolerance; }))
              continue;
            is_on_surface   = true;
            const auto rest = bare.find(&face);
            if (rest != bare.end() &&
                all([&](const auto &p) { return height(p) <= tolerance; }))
              rest->second -=
                body.area_inside({face.name, face.outward, part.corners});
          }
        if (is_on_surface)
          continue;
        if (part.normal.norm_square() == 0.)
          return false;
        const auto [lowest, highest] = body.reach(part.point, part.normal);
        if (lowest < -tolerance && highest > tolerance)
          return false;
      }
    return std::all_of(bare.begin(), bare.end(), [&](const auto &rest) {
      return std::abs(rest.second) <= touching * body.area(*rest.first);
    });
  }



  template <int dim>
  std::optional<ConvexBody<dim>>
  PlaneArrangement<dim>::body_of(const Block<dim> &block,
                                 const std::vector<OuterFace> &faces,
                                 const bool has_outlines) const
  {
    const double size = cell_size(block);
    const double tolerance =
      std::max(same_vertex * size, rounding * (low.norm() + high.norm()));
    const Tensor<1, dim> margin = 0.5 * (high - low);
    ConvexBody<dim> body(low - margin, high + margin, tolerance);
    std::vector<bool> is_done(joints.size(), false);
    if (!cut_by_faces(body, block, faces, has_outlines, is_done))
      return {};
    for (const bool is_infinite : {true, false}) // rims where all is known
      for (unsigned int j = 0; j < joints.size() && !body.is_empty(); ++j)
        if (!is_done[j] && joints[j].is_infinite() == is_infinite)
          {
            const JointExtent<dim> &joint = joints[j];
            const auto [least, greatest] =
              body.reach(joint.origin, joint.normal);
            if (least >= -thinnest_part * size ||
                greatest <= thinnest_part * size)
              continue;
            if (!reaches_over(j,
                              body.section(joint.origin, joint.normal),
                              touching * size))
              continue;
            const double side = joint.distance(block.centroid);
            body.cut(joint.origin, (side > 0. ? -1. : 1.) * joint.normal, j);
          }
    if (body.is_empty())
      return {};
    for (const auto &face : body.get_faces())
      if (face.name == body.of_box ||
          (face.name < joints.size() &&
           !reaches_over(face.name, face.corners, touching * size)))
        return {};
    return body;
  }



  template <int dim>
  bool
  PlaneArrangement<dim>::is_cut(
    const std::vector<std::pair<Point<dim>, Point<dim>>> &edges,
    const double tolerance) const
  {
    const Point<dim> &middle = edges[0].first;
    double radius            = 0.;
    for (const auto &[a, b] : edges)
      radius = std::max({radius, a.distance(middle), b.distance(middle)});
    for (unsigned int j = 0; j < joints.size(); ++j)
      {
        const JointExtent<dim> &joint = joints[j];
        if (std::abs(joint.distance(middle)) > radius ||
            (!joint.is_infinite() &&
             balls[j].first.distance(middle) > radius + balls[j].second))
          continue;
        double least = 1e300, greatest = -1e300;
        std::vector<Point<dim>> section;
        for (const auto &[a, b] : edges)
          {
            const double from = joint.distance(a), to = joint.distance(b);
            least    = std::min({least, from, to});
            greatest = std::max({greatest, from, to});
            if (from * to < 0.)
              section.push_back(Point<dim>(a + from / (from - to) * (b - a)));
          }
        if (least < -tolerance && greatest > tolerance &&
            reaches_over(j, section, tolerance))
          return true;
      }
    return false;
  }

  template class PlaneArrangement<2>;
  template class PlaneArrangement<3>;
} // namespace Keyblock

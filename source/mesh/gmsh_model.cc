// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/gmsh_model.h>
#include <keyblock/mesh/polyhedron.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/joint_extent.h>
#include <keyblock/scene/section_axis.h>
#include <keyblock/scene/solid_file.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    namespace occ = gmsh::model::occ;
    using gmsh::vectorpair;

    /** Of the polygon that stands for a disc; Gmsh parts a circle in as many.
     */
    constexpr unsigned int least_sides = 8;

    template <int dim>
    Point<3>
    in_space(const Point<dim> &p)
    {
      Point<3> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = p[d];
      return result;
    }

    int
    add_point(const Point<3> &p)
    {
      return occ::addPoint(p[0], p[1], p[2]);
    }

    int
    add_polygon(const std::vector<Point<3>> &corners)
    {
      std::vector<int> points, lines;
      for (const Point<3> &corner : corners)
        points.push_back(add_point(corner));
      for (unsigned int i = 0; i < points.size(); ++i)
        lines.push_back(
          occ::addLine(points[i], points[(i + 1) % points.size()]));
      return occ::addPlaneSurface({occ::addCurveLoop(lines)});
    }

    int
    add_prism(const std::vector<Point<3>> &base, const Tensor<1, 3> &height)
    {
      vectorpair created;
      occ::extrude(
        {{2, add_polygon(base)}}, height[0], height[1], height[2], created);
      for (const auto &[dimension, tag] : created)
        if (dimension == 3)
          return tag;
      throw std::runtime_error("an extruded polygon has no volume");
    }

    /** A disc bounded by true arcs, by two perpendicular radius vectors. */
    int
    add_disc(const Point<3> &center,
             const Tensor<1, 3> &first,
             const Tensor<1, 3> &second)
    {
      const int middle              = add_point(center);
      const std::vector<int> points = {add_point(center + first),
                                       add_point(center + second),
                                       add_point(center - first),
                                       add_point(center - second)};
      std::vector<int> arcs;
      for (unsigned int i = 0; i < points.size(); ++i)
        arcs.push_back(
          occ::addCircleArc(points[i], middle, points[(i + 1) % 4]));
      const int disc = occ::addPlaneSurface({occ::addCurveLoop(arcs)});
      occ::remove({{0, middle}});
      return disc;
    }

    template <int dim>
    int
    add_parallelepiped(const Point<dim> &corner,
                       const std::vector<Tensor<1, dim>> &edges)
    {
      const std::vector<Point<3>> base = {in_space<dim>(corner),
                                          in_space<dim>(corner + edges[0]),
                                          in_space<dim>(corner + edges[0] +
                                                        edges[1]),
                                          in_space<dim>(corner + edges[1])};
      return dim == 2
               ? add_polygon(base)
               : add_prism(base, in_space<dim>(Point<dim>(edges.back())));
    }

    template <int dim>
    int
    add_box(const Point<dim> &corner, const std::vector<double> &size)
    {
      std::vector<Tensor<1, dim>> edges(dim);
      for (unsigned int d = 0; d < dim; ++d)
        edges[d][d] = size[d];
      return add_parallelepiped<dim>(corner, edges);
    }

    template <int dim>
    int
    add_domain(const Domain<dim> &domain)
    {
      if (domain.shape == DomainShape::box)
        return add_box<dim>(domain.corner, domain.size);
      if (domain.shape == DomainShape::parallelepiped)
        return add_parallelepiped<dim>(domain.corner,
                                       {domain.edges.begin(),
                                        domain.edges.end()});
      std::vector<Point<3>> corners;
      for (const Point<dim> &corner : domain.polygon)
        corners.push_back(in_space<dim>(corner));
      return add_polygon(corners);
    }

    template <int dim>
    int
    add_excavation(const Excavation<dim> &excavation)
    {
      if (excavation.shape == ExcavationShape::box)
        return add_box<dim>(excavation.corner, excavation.size);
      if (excavation.shape == ExcavationShape::circle)
        return add_disc(in_space<2>(excavation.center),
                        Point<3>(excavation.radius, 0., 0.),
                        Point<3>(0., excavation.radius, 0.));
      std::vector<Point<3>> corners;
      if constexpr (dim == 3)
        {
          for (const Point<2> &vertex : excavation.vertices)
            corners.push_back(
              from_section(excavation,
                           Point<3>(vertex[0], excavation.from, vertex[1])));
          const Point<3> end(0., excavation.to - excavation.from, 0.);
          return add_prism(corners,
                           from_section(excavation, end) -
                             from_section(excavation, Point<3>()));
        }
      for (const Point<2> &vertex : excavation.vertices)
        corners.push_back(in_space<2>(vertex));
      return add_polygon(corners);
    }

    /** The solids of a file: polyhedra of triangles, or as OpenCASCADE reads
     * them. */
    template <int dim>
    std::vector<int>
    add_solids(const Excavation<dim> &excavation, const Point<dim> &origin)
    {
      if (!is_stl(excavation.file))
        return import_solids(excavation.file,
                             excavation.scale,
                             in_space<dim>(origin));
      std::vector<int> tags;
      for (const auto &solid : excavation.solids)
        tags.push_back(add_polyhedron(solid->surface));
      return tags;
    }

    /** A trace, or what @p outline leaves of an infinite one; 0: nothing. */
    int
    add_joint(const Joint<2> &joint,
              const DomainOutline<2> &outline,
              const MeshSize<2> &,
              const double)
    {
      const Tensor<1, 2> half =
        joint.radius * directions_across<2>(joint.normal())[0];
      std::vector<Point<2>> ends = joint.vertices;
      if (joint.extent == JointShape::disc)
        ends = {joint.point - half, joint.point + half};
      if (joint.extent == JointShape::infinite)
        ends = outline.cut(joint);
      return ends.empty() ? 0
                          : occ::addLine(add_point(in_space<2>(ends[0])),
                                         add_point(in_space<2>(ends[1])));
    }

    /** A disc as a polygon of its area whose sides are about @p side [m] long:
     * Gmsh's cells have no arcs, and those of two discs that almost touch cross
     * each other. */
    std::vector<Point<3>>
    corners_of_disc(const Joint<3> &joint, const double side)
    {
      const double around = 2. * dealii::numbers::PI * joint.radius;
      const unsigned int n =
        std::max(least_sides, unsigned(std::ceil(around / side)));
      const double angle  = 2. * dealii::numbers::PI / n;
      const double radius = joint.radius * std::sqrt(angle / std::sin(angle));
      const auto across   = directions_across<3>(joint.normal());
      std::vector<Point<3>> corners;
      for (unsigned int i = 0; i < n; ++i)
        corners.push_back(joint.point +
                          radius * (std::cos(angle * i) * across[0] +
                                    std::sin(angle * i) * across[1]));
      return corners;
    }

    int
    add_joint(const Joint<3> &joint,
              const DomainOutline<3> &outline,
              const MeshSize<3> &size,
              const double coarsening)
    {
      std::vector<Point<3>> corners = joint.vertices;
      if (joint.extent == JointShape::disc)
        corners = corners_of_disc(joint, coarsening * size(joint.point));
      else if (joint.extent == JointShape::infinite)
        corners = outline.cut(joint);
      else if (joint.surface.empty())
        // (facets of one surface share their corners to the last digit)
        for (Point<3> &corner : corners)
          corner -= joint.distance(corner) * joint.normal();
      return corners.empty() ? 0 : add_polygon(corners);
    }

    /** Everything inside or on the boundary of @p entities. */
    std::set<std::pair<int, int>>
    closure(const vectorpair &entities)
    {
      std::set<std::pair<int, int>> found(entities.begin(), entities.end());
      vectorpair waiting = entities;
      while (!waiting.empty())
        {
          const std::pair<int, int> entity = waiting.back();
          waiting.pop_back();
          vectorpair parts, embedded;
          if (entity.first > 0)
            gmsh::model::getBoundary({entity}, parts, false, false, false);
          if (entity.first > 1)
            gmsh::model::mesh::getEmbedded(entity.first,
                                           entity.second,
                                           embedded);
          parts.insert(parts.end(), embedded.begin(), embedded.end());
          for (const auto &part : parts)
            if (found.insert(part).second)
              waiting.push_back(part);
        }
      return found;
    }

    /** Tags of what bounds the pieces of an excavation together. */
    std::set<int>
    outline_of(const vectorpair &pieces)
    {
      vectorpair boundary;
      gmsh::model::getBoundary(pieces, boundary, true, false, false);
      std::set<int> tags;
      for (const auto &[dimension, tag] : boundary)
        tags.insert(tag);
      return tags;
    }

    /** Remove all that is not part of the domain, from the model and from
     * @p model: joints and excavations may reach beyond. */
    template <int dim>
    void
    clip(GmshModel<dim> &model)
    {
      const auto inside     = closure(model.domain);
      const auto is_outside = [&inside](const std::pair<int, int> &entity) {
        return inside.count(entity) == 0;
      };
      vectorpair entities;
      gmsh::model::getEntities(entities);
      std::reverse(entities.begin(), entities.end());
      vectorpair outside;
      std::copy_if(entities.begin(),
                   entities.end(),
                   std::back_inserter(outside),
                   is_outside);
      gmsh::model::removeEntities(outside);
      for (vectorpair &list : model.joints)
        list.erase(std::remove_if(list.begin(), list.end(), is_outside),
                   list.end());
    }
  } // namespace



  template <int dim>
  GmshModel<dim>
  build_gmsh_model(const Scene<dim> &scene,
                   const bool with_joints,
                   const double tolerance,
                   const MeshSize<dim> &size,
                   const double coarsening)
  {
    GmshModel<dim> model;
    model.domain = {{dim, add_domain<dim>(scene.domain)}};
    vectorpair tools;
    for (const auto &excavation : scene.excavations)
      if (excavation->shape == ExcavationShape::file)
        for (const int tag : add_solids(*excavation, scene.domain.origin))
          tools.emplace_back(dim, tag);
      else
        tools.emplace_back(dim, add_excavation<dim>(*excavation));
    const std::size_t n_tools_of_excavations = tools.size();
    std::vector<unsigned int> joint_of_tool;
    const DomainOutline<dim> outline(scene.domain);
    const Point<dim> center =
      outline.lower + (outline.upper - outline.lower) / 2.;
    if (with_joints)
      for (unsigned int j = 0; j < scene.joints.size(); ++j)
        // (OpenCASCADE breaks down over some that are far away)
        if (JointExtent<dim>(*scene.joints[j]).distance_to_joint(center) <
            outline.lower.distance(outline.upper))
          if (const int tag =
                add_joint(*scene.joints[j], outline, size, coarsening);
              tag != 0)
            {
              tools.emplace_back(dim - 1, tag);
              joint_of_tool.push_back(j);
            }

    vectorpair all_pieces;
    std::vector<vectorpair> pieces_of;
    if (!tools.empty())
      {
        gmsh::option::setNumber("Geometry.ToleranceBoolean", tolerance);
        occ::fragment(model.domain, tools, all_pieces, pieces_of);
        model.domain = pieces_of[0];
      }
    // the excavations' pieces are known by their places
    if (with_joints)
      model.joints.resize(scene.joints.size());
    for (unsigned int i = 0; i < joint_of_tool.size(); ++i)
      model.joints[joint_of_tool[i]] =
        pieces_of[1 + n_tools_of_excavations + i];
    occ::synchronize();
    for (std::size_t i = 0; i < n_tools_of_excavations; ++i)
      model.outlines.merge(outline_of(pieces_of[1 + i]));
    clip(model);
    return model;
  }

  template GmshModel<2> build_gmsh_model(const Scene<2> &,
                                         const bool,
                                         const double,
                                         const MeshSize<2> &,
                                         const double);
  template GmshModel<3> build_gmsh_model(const Scene<3> &,
                                         const bool,
                                         const double,
                                         const MeshSize<3> &,
                                         const double);
} // namespace Keyblock

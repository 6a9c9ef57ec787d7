// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh that follows joints and excavations, made by Gmsh in this process.
#include <deal.II/base/tensor.h>

#include <gmsh.h>
#include <keyblock/errors.h>
#include <keyblock/mesh_cut.h>

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

    /** Size of the elements that Gmsh starts from over that of the pieces they
     * are cut into: halved edges in 2D; in 3D the cube root of the volume of a
     * quarter of a regular tetrahedron is 0.31 of its edge, and Gmsh's are not
     * regular. */
    template <int dim>
    constexpr double coarsening = (dim == 2) ? 2. : 3.;

    /** Bounds for the points that stand for a curve, or for the diagonal of a
     * surface, when distances from it are measured. */
    constexpr double least_samples = 20., most_samples = 1000.,
                     most_surface_samples = 200.;

    /** Gmsh's numbers of the mesh algorithms used. Its faster parallel one in
     * 3D, number 10, gives another mesh in every run. */
    constexpr int frontal_delaunay_2d = 6, delaunay_3d = 1;

    /** Gmsh's numbers of the ways to pair triangles to quadrilaterals: the best
     * pairing of all, which not every mesh has, and one pair after the other.
     */
    constexpr int blossom = 1, one_by_one = 0;

    /** What is left in the model after everything was cut by everything. */
    struct Pieces
    {
      vectorpair domain, excavations, joints;
    };

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
      if (domain.shape == "box")
        return add_box<dim>(domain.corner, domain.size);
      if (domain.shape == "parallelepiped")
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
      if (excavation.shape == "box")
        return add_box<dim>(excavation.corner, excavation.size);
      if (excavation.shape == "circle")
        return add_disc(in_space<2>(excavation.center),
                        Point<3>(excavation.radius, 0., 0.),
                        Point<3>(0., excavation.radius, 0.));
      std::vector<Point<3>> corners;
      for (const Point<2> &vertex : excavation.vertices)
        corners.push_back(dim == 2
                            ? in_space<2>(vertex)
                            : Point<3>(vertex[0], excavation.from, vertex[1]));
      return dim == 2
               ? add_polygon(corners)
               : add_prism(corners,
                           Point<3>(0., excavation.to - excavation.from, 0.));
    }

    /** A joint; an infinite one reaches beyond the ball of radius @p reach
     * about @p center. */
    int
    add_joint(const Joint<2> &joint, const Point<2> &center, const double reach)
    {
      const Tensor<1, 2> normal  = joint.normal();
      const Tensor<1, 2> along   = Point<2>(normal[1], -normal[0]);
      std::vector<Point<2>> ends = joint.vertices;
      if (joint.extent == "disc")
        ends = {joint.point - joint.radius * along,
                joint.point + joint.radius * along};
      if (joint.extent == "infinite")
        {
          const Point<2> middle = center - joint.distance(center) * normal;
          ends = {middle - reach * along, middle + reach * along};
        }
      return occ::addLine(add_point(in_space<2>(ends[0])),
                          add_point(in_space<2>(ends[1])));
    }

    int
    add_joint(const Joint<3> &joint, const Point<3> &center, const double reach)
    {
      const Tensor<1, 3> normal = joint.normal();
      const unsigned int axis =
        std::abs(normal[0]) < 0.6 ? 0 : (std::abs(normal[1]) < 0.6 ? 1 : 2);
      Tensor<1, 3> unit;
      unit[axis]                = 1.;
      Tensor<1, 3> first        = cross_product_3d(normal, unit);
      first                     = first / first.norm();
      const Tensor<1, 3> second = cross_product_3d(normal, first);
      if (joint.extent == "disc")
        return add_disc(joint.point,
                        joint.radius * first,
                        joint.radius * second);
      std::vector<Point<3>> corners;
      if (joint.extent == "infinite")
        {
          const Point<3> middle = center - joint.distance(center) * normal;
          corners               = {middle - reach * first - reach * second,
                                   middle + reach * first - reach * second,
                                   middle + reach * first + reach * second,
                                   middle - reach * first + reach * second};
        }
      else
        for (const Point<3> &vertex : joint.vertices)
          corners.push_back(vertex - joint.distance(vertex) * normal);
      return add_polygon(corners);
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

    /** Remove all that is not part of the domain, from the model and from
     * @p pieces: joints and excavations may reach beyond. */
    void
    clip(Pieces &pieces)
    {
      const auto inside     = closure(pieces.domain);
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
      for (vectorpair *list : {&pieces.excavations, &pieces.joints})
        list->erase(std::remove_if(list->begin(), list->end(), is_outside),
                    list->end());
    }

    /** The least box around the domain. */
    struct Extent
    {
      Point<3> low, high;
    };

    /** Domain, excavations and joints, cut by each other and clipped. */
    template <int dim>
    Pieces
    build_model(const Scene<dim> &scene, Extent &extent)
    {
      const vectorpair domain = {{dim, add_domain<dim>(scene.domain)}};
      Point<3> &low           = extent.low;
      Point<3> &high          = extent.high;
      occ::getBoundingBox(dim,
                          domain[0].second,
                          low[0],
                          low[1],
                          low[2],
                          high[0],
                          high[1],
                          high[2]);
      Point<dim> center;
      for (unsigned int d = 0; d < dim; ++d)
        center[d] = (low[d] + high[d]) / 2.;

      vectorpair tools;
      for (const auto &excavation : scene.excavations)
        tools.emplace_back(dim, add_excavation<dim>(*excavation));
      for (const auto &joint : scene.joints)
        tools.emplace_back(dim - 1,
                           add_joint(*joint, center, low.distance(high)));

      Pieces pieces{domain, {}, {}};
      vectorpair all_pieces;
      std::vector<vectorpair> pieces_of;
      if (!tools.empty())
        {
          occ::fragment(domain, tools, all_pieces, pieces_of);
          pieces.domain = pieces_of[0];
        }
      for (unsigned int i = 1; i < pieces_of.size(); ++i)
        {
          vectorpair &list = (i <= scene.excavations.size())
                               ? pieces.excavations
                               : pieces.joints;
          list.insert(list.end(), pieces_of[i].begin(), pieces_of[i].end());
        }
      occ::synchronize();
      clip(pieces);
      return pieces;
    }

    /** A size field that grows from @p size on @p entities (curves in 2D,
     * surfaces in 3D) to @p far_size at @p distance. Lengths in m. */
    template <int dim>
    int
    add_size_field(const vectorpair &entities,
                   const double size,
                   const double far_size,
                   const double distance)
    {
      namespace field = gmsh::model::mesh::field;
      std::vector<double> tags;
      double longest = 0.;
      for (const auto &[dimension, tag] : entities)
        {
          double measure;
          occ::getMass(dimension, tag, measure);
          longest = std::max(longest, std::pow(measure, 1. / dimension));
          tags.push_back(tag);
        }
      const int near = field::add("Distance");
      field::setNumbers(near, dim == 2 ? "CurvesList" : "SurfacesList", tags);
      field::setNumber(near,
                       "NumPointsPerCurve",
                       std::clamp(std::ceil(longest / size),
                                  least_samples,
                                  dim == 2 ? most_samples
                                           : most_surface_samples));
      const int growth = field::add("Threshold");
      field::setNumber(growth, "InField", near);
      field::setNumber(growth, "SizeMin", size);
      field::setNumber(growth, "SizeMax", far_size);
      field::setNumber(growth, "DistMin", 0.);
      field::setNumber(growth, "DistMax", distance);
      return growth;
    }

    /** Ask for the sizes of the section Mesh, no others. */
    template <int dim>
    void
    set_sizes(const Meshing<dim> &meshing,
              const Pieces &pieces,
              const Extent &extent)
    {
      for (const std::string source :
           {"ExtendFromBoundary", "FromPoints", "FromCurvature"})
        gmsh::option::setNumber("Mesh.MeshSize" + source, 0.);
      const double size = coarsening<dim> * meshing.size;
      gmsh::option::setNumber("Mesh.MeshSizeMax", size);

      double distance = meshing.grading_distance;
      if (distance == 0.)
        for (unsigned int d = 0; d < dim; ++d)
          distance = std::max(distance, (extent.high[d] - extent.low[d]) / 4.);
      vectorpair outline;
      if (!pieces.excavations.empty())
        gmsh::model::getBoundary(pieces.excavations, outline, true, false);

      std::vector<double> fields;
      if (meshing.size_at_excavation > 0. && !outline.empty())
        fields.push_back(
          add_size_field<dim>(outline,
                              coarsening<dim> * meshing.size_at_excavation,
                              size,
                              distance));
      if (meshing.size_at_joints > 0. && !pieces.joints.empty())
        fields.push_back(
          add_size_field<dim>(pieces.joints,
                              coarsening<dim> * meshing.size_at_joints,
                              size,
                              distance));
      if (fields.empty())
        return;
      const int least = gmsh::model::mesh::field::add("Min");
      gmsh::model::mesh::field::setNumbers(least, "FieldsList", fields);
      gmsh::model::mesh::field::setAsBackgroundMesh(least);
    }

    /** Mesh the current model; returns Gmsh's first error, empty if there was
     * none. Gmsh must not throw meanwhile: an exception in one of its threads
     * ends the program. */
    std::string
    mesh_model(const int dim)
    {
      gmsh::option::setNumber("General.AbortOnError", 0.);
      gmsh::logger::start();
      gmsh::model::mesh::generate(dim);
      std::vector<std::string> log;
      gmsh::logger::get(log);
      gmsh::logger::stop();
      gmsh::option::setNumber("General.AbortOnError", 2.);
      const std::string mark = "Error: ";
      for (const std::string &line : log)
        if (line.compare(0, mark.size(), mark) == 0)
          return line.substr(mark.size());
      return "";
    }

    /** Mesh the current model with quadrilaterals, or, if triangles cannot be
     * paired, with triangles, which are cut later. */
    std::string
    mesh_with_quadrilaterals()
    {
      std::string reason;
      gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 1);
      for (const int pairing : {blossom, one_by_one})
        {
          gmsh::option::setNumber("Mesh.RecombineAll", 1);
          gmsh::option::setNumber("Mesh.RecombinationAlgorithm", pairing);
          reason = mesh_model(2);
          if (reason.empty())
            return "";
          gmsh::model::mesh::clear();
        }
      gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 0);
      gmsh::option::setNumber("Mesh.RecombineAll", 0);
      return mesh_model(2);
    }

    template <int dim>
    MixedMesh
    generate(const Scene<dim> &scene)
    {
      const GmshSession session;
      Extent extent;
      const Pieces pieces = build_model<dim>(scene, extent);
      set_sizes<dim>(scene.meshing, pieces, extent);
      gmsh::option::setNumber("Mesh.Algorithm", frontal_delaunay_2d);
      gmsh::option::setNumber("Mesh.Algorithm3D", delaunay_3d);
      const std::string reason =
        dim == 2 ? mesh_with_quadrilaterals() : mesh_model(dim);
      if (!reason.empty())
        throw std::runtime_error(reason);
      return read_gmsh_model<dim>();
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  make_gmsh_mesh(const Scene<dim> &scene)
  {
    const std::string remedy =
      "change 'Mesh/Size' (" + std::to_string(scene.meshing.size) +
      " m) or move joints and excavations that almost touch each other";
    MixedMesh mixed;
    const std::string reason =
      reason_of_failure([&]() { mixed = generate(scene); });
    AssertThrow(reason.empty() && !mixed.cells.empty(),
                InputError(
                  "Gmsh could not mesh the scene with its " +
                  std::to_string(scene.joints.size()) + " joints and " +
                  std::to_string(scene.excavations.size()) + " excavations (" +
                  (reason.empty() ? "no cells" : reason) + "); " + remedy +
                  "."));
    const unsigned int n_wrong =
      std::count_if(mixed.cells.begin(),
                    mixed.cells.end(),
                    [](const MixedMesh::Element &cell) {
                      return cell.vertices.size() > 4;
                    });
    AssertThrow(n_wrong == 0,
                InputError("Gmsh left " + std::to_string(n_wrong) +
                           " cells with more than four corners; " + remedy +
                           "."));
    return cut_mesh<dim>(mixed, "The mesh made by Gmsh", remedy);
  }

  template Mesh<2> make_gmsh_mesh(const Scene<2> &);
  template Mesh<3> make_gmsh_mesh(const Scene<3> &);
} // namespace Keyblock

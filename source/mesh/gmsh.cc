// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh that follows joints and excavations, made by Gmsh in this process,
// exactly or with the joints cut into it.
#include <gmsh.h>
#include <keyblock/base/errors.h>
#include <keyblock/mesh/cut.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/gmsh_model.h>
#include <keyblock/mesh/improvement.h>
#include <keyblock/mesh/joint_cut.h>
#include <keyblock/mesh/size.h>
#include <keyblock/mesh/size_limit.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    using gmsh::vectorpair;

    /** Wanted edges of simplices over the size of the cells they are cut into:
     * the square root of the area of a third of a regular triangle is 0.38 of
     * its edge; the cube root of the volume of a quarter of a regular
     * tetrahedron 0.31, and Gmsh's are not regular. */
    template <int dim>
    constexpr double simplex_coarsening = (dim == 2) ? 2.6 : 3.;

    /** The same for Gmsh's quadrilaterals, which it halves. */
    constexpr double quadrilateral_coarsening = 2.;

    /** Gmsh's numbers of the mesh algorithms used. Its faster parallel one in
     * 3D, number 10, gives another mesh in every run. */
    constexpr int frontal_delaunay_2d = 6, delaunay_3d = 1;

    /** Gmsh's numbers of the ways to pair triangles to quadrilaterals: the best
     * pairing of all, which not every mesh has, and one pair after the other.
     */
    constexpr int blossom = 1, one_by_one = 0;

    /** With more joints the exact way is not tried: it takes long and small
     * features are certain. */
    template <int dim>
    constexpr unsigned int most_exact_joints = (dim == 2) ? 40 : 12;

    /** An exact mesh is taken if its thinnest cell has this part of the median
     * altitude [-]. */
    constexpr double least_thinness = 0.1;

    /** So is one whose thinnest cell has this part of what cuts would give:
     * its joints are where they should be. */
    constexpr double acceptable_part = 0.5;

    /** A mesh that takes a while, so that its size is told beforehand. */
    constexpr double many_cells = 1e5;

    /** Cells of exact meshes below this quality are mended. */
    constexpr double wanted_quality = 0.35;

    /** Mesh the current model up to entities of @p dimension; returns Gmsh's
     * first error, empty if there was none. Gmsh must not throw meanwhile: an
     * exception in one of its threads ends the program. */
    std::string
    mesh_entities(const int dimension)
    {
      gmsh::option::setNumber("General.AbortOnError", 0.);
      gmsh::logger::start();
      gmsh::model::mesh::generate(dimension);
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

    std::string
    mesh_surfaces()
    {
      return mesh_entities(2);
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
          reason = mesh_surfaces();
          if (reason.empty())
            return "";
          gmsh::model::mesh::clear();
        }
      gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 0);
      gmsh::option::setNumber("Mesh.RecombineAll", 0);
      return mesh_surfaces();
    }


    template <int dim>
    Point<dim>
    in_model(const Point<3> &p)
    {
      Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = p[d];
      return result;
    }

    /** Ask for the sizes of the section Mesh, no others, times @p coarsening.
     */
    template <int dim>
    void
    set_sizes(const MeshSize<dim> &size, const double coarsening)
    {
      for (const std::string source :
           {"ExtendFromBoundary", "FromPoints", "FromCurvature"})
        gmsh::option::setNumber("Mesh.MeshSize" + source, 0.);
      gmsh::option::setNumber("Mesh.Algorithm", frontal_delaunay_2d);
      gmsh::option::setNumber("Mesh.Algorithm3D", delaunay_3d);
      // (from Gmsh 4.9 on a sixth argument: the size wanted otherwise)
      gmsh::model::mesh::setSizeCallback([&size, coarsening](const int,
                                                             const int,
                                                             const double x,
                                                             const double y,
                                                             const double z,
                                                             const auto...) {
        return coarsening * size(in_model<dim>(Point<3>(x, y, z)));
      });
    }

    template <int dim>
    MeshSize<dim>
    wanted_size(const Scene<dim> &scene,
                const std::vector<SizeDemand<dim>> &demands,
                const GmshModel<dim> &model)
    {
      const Tensor<1, 3> sides = model.high - model.low;
      return MeshSize<dim>(scene,
                           std::max({sides[0], sides[1], sides[2]}),
                           demands);
    }

    /** Gmsh's elements with what they lie on. */
    template <int dim>
    struct MarkedMesh
    {
      MixedMesh mixed;
      std::vector<Surface<dim>> surfaces; ///< first those of the joints

      /** Vertices at points of the model and, in 3D, on the rims of joints. */
      std::vector<unsigned int> corners;
    };

    /** Line, plane or circle through an element of an outline. */
    template <int dim>
    Surface<dim>
    surface_through(const std::vector<Point<dim>> &element,
                    const bool is_circle,
                    const Scene<dim> &scene)
    {
      Surface<dim> surface;
      surface.point = element[0];
      if constexpr (dim == 2)
        {
          surface.normal = cross_product_2d(element[1] - element[0]);
          if (is_circle)
            for (const auto &excavation : scene.excavations)
              if (excavation->shape == ExcavationShape::circle &&
                  std::abs(depth_inside(*excavation, element[0])) +
                      std::abs(depth_inside(*excavation, element[1])) <
                    1e-6 * excavation->radius)
                {
                  surface.point  = excavation->center;
                  surface.radius = excavation->radius;
                }
        }
      else
        surface.normal =
          cross_product_3d(element[1] - element[0], element[2] - element[0]);
      surface.normal /= surface.normal.norm();
      return surface;
    }

    /** Reads Gmsh's current mesh. */
    template <int dim>
    class Reader
    {
    public:
      Reader(const GmshModel<dim> &model, const Scene<dim> &scene)
        : model(model)
        , scene(scene)
      {}

      MarkedMesh<dim>
      read()
      {
        result.mixed = read_gmsh_model<dim>(vertex_of_tag);
        if (!model.joints.empty())
          for (unsigned int j = 0; j < scene.joints.size(); ++j)
            {
              const JointExtent<dim> extent(*scene.joints[j]);
              result.surfaces.push_back({extent.origin, extent.normal, 0., j});
              for (const auto &[dimension, tag] : model.joints[j])
                joints_of_entity[tag].push_back(j);
            }
        vectorpair entities;
        gmsh::model::getEntities(entities, dim - 1);
        for (const auto &[dimension, tag] : entities)
          read_outline(tag);
        list_corners();
        return result;
      }

    private:
      void
      read_outline(const int tag)
      {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dim - 1, tag);
        std::string type;
        gmsh::model::getType(dim - 1, tag, type);
        const auto joints = joints_of_entity.find(tag);
        bool is_new       = (joints == joints_of_entity.end());
        for (unsigned int t = 0; t < types.size(); ++t)
          for (std::size_t i = 0; i + dim <= nodes[t].size(); i += dim)
            {
              MixedMesh::Element face;
              for (unsigned int k = 0; k < dim; ++k)
                {
                  const auto found = vertex_of_tag.find(nodes[t][i + k]);
                  if (found != vertex_of_tag.end())
                    face.vertices.push_back(found->second);
                }
              if (face.vertices.size() != dim)
                continue;
              std::vector<Point<dim>> places;
              for (const unsigned int v : face.vertices)
                places.push_back(in_model<dim>(result.mixed.vertices[v]));
              if (is_new)
                {
                  result.surfaces.push_back(
                    surface_through<dim>(places, type == "Circle", scene));
                  is_new = false;
                }
              if (joints == joints_of_entity.end())
                mark(face, result.surfaces.size() - 1, places);
              else
                for (const unsigned int j : joints->second)
                  mark(face, j, places);
            }
      }

      /** The plus side is where the surface's normal points to. */
      void
      mark(MixedMesh::Element face,
           const unsigned int surface,
           const std::vector<Point<dim>> &places)
      {
        Tensor<1, dim> left; // or the right-hand normal
        if constexpr (dim == 2)
          left = -cross_product_2d(places[1] - places[0]);
        else
          left = cross_product_3d(places[1] - places[0], places[2] - places[0]);
        if (left * result.surfaces[surface].normal < 0.)
          std::swap(face.vertices[0], face.vertices[1]);
        face.id = surface;
        result.mixed.marked_faces.push_back(face);
      }

      void
      list_corners()
      {
        for (int dimension = 0; dimension < dim - 1; ++dimension)
          {
            vectorpair entities;
            gmsh::model::getEntities(entities, dimension);
            for (const auto &[d, tag] : entities)
              if (d == 0 || bounds_one_surface(tag))
                {
                  std::vector<std::size_t> tags;
                  std::vector<double> coordinates, parameters;
                  gmsh::model::mesh::getNodes(
                    tags, coordinates, parameters, d, tag);
                  for (const std::size_t node : tags)
                    if (vertex_of_tag.count(node) > 0)
                      result.corners.push_back(vertex_of_tag.at(node));
                }
          }
      }

      /** Whether no second surface keeps the nodes of a curve in place. */
      static bool
      bounds_one_surface(const int tag)
      {
        std::vector<int> surfaces, lower;
        gmsh::model::getAdjacencies(1, tag, surfaces, lower);
        return surfaces.size() < 2;
      }

      const GmshModel<dim> &model;
      const Scene<dim> &scene;
      MarkedMesh<dim> result;
      std::unordered_map<std::size_t, unsigned int> vertex_of_tag;
      std::map<int, std::vector<unsigned int>> joints_of_entity;
    };

    /** Triangles or tetrahedra ready to be cut or mended. */
    template <int dim>
    SimplexMesh<dim>
    make_simplex_mesh(const MarkedMesh<dim> &marked, const MeshSize<dim> &size)
    {
      SimplexMesh<dim> mesh;
      mesh.surfaces = marked.surfaces;
      for (const Point<3> &vertex : marked.mixed.vertices)
        {
          const Point<dim> p = in_model<dim>(vertex);
          mesh.add_vertex(p, simplex_coarsening<dim> * size(p));
        }
      for (const unsigned int corner : marked.corners)
        mesh.is_fixed[corner] = true;
      for (const MixedMesh::Element &element : marked.mixed.cells)
        {
          typename SimplexMesh<dim>::CellVertices cell;
          std::copy(element.vertices.begin(),
                    element.vertices.end(),
                    cell.begin());
          if (mesh.volume(cell) < 0.)
            std::swap(cell[0], cell[1]);
          mesh.add_cell(cell);
        }
      for (const MixedMesh::Element &face : marked.mixed.marked_faces)
        {
          typename SimplexMesh<dim>::Facet facet;
          std::copy(face.vertices.begin(), face.vertices.end(), facet.begin());
          bool is_odd;
          facet = mesh.sorted(facet, is_odd);
          mesh.add_mark(facet, {face.id, !is_odd});
        }
      return mesh;
    }

    /** The live cells and marked facets of @p mesh. */
    template <int dim>
    MarkedMesh<dim>
    to_marked_mesh(const SimplexMesh<dim> &mesh)
    {
      MarkedMesh<dim> result;
      result.surfaces = mesh.surfaces;
      std::vector<unsigned int> number(mesh.vertices.size(), no_index);
      for (const auto &cell : mesh.cells)
        if (cell.is_alive)
          {
            MixedMesh::Element element{{}, 0};
            for (const unsigned int v : cell.vertices)
              {
                if (number[v] == no_index)
                  {
                    number[v] = result.mixed.vertices.size();
                    Point<3> p;
                    for (unsigned int d = 0; d < dim; ++d)
                      p[d] = mesh.vertices[v][d];
                    result.mixed.vertices.push_back(p);
                  }
                element.vertices.push_back(number[v]);
              }
            result.mixed.cells.push_back(element);
          }
      for (const auto &facet : mesh.marked_facets())
        for (const auto &mark : mesh.marks.at(facet))
          {
            MixedMesh::Element face{{}, mark.surface};
            for (const unsigned int v : facet)
              face.vertices.push_back(number[v]);
            if (!mark.plus_is_positive)
              std::swap(face.vertices[0], face.vertices[1]);
            result.mixed.marked_faces.push_back(face);
          }
      return result;
    }

    void
    require_meshed(const std::string &reason)
    {
      if (!reason.empty())
        throw std::runtime_error(reason);
    }

    /** Least altitude of the triangles of the current model over that of
     * a regular one of the wanted size [-]. */
    template <int dim>
    double
    thinnest_triangle(const MeshSize<dim> &size)
    {
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::unordered_map<std::size_t, Point<3>> place;
      for (std::size_t i = 0; i < tags.size(); ++i)
        place[tags[i]] = Point<3>(coordinates[3 * i],
                                  coordinates[3 * i + 1],
                                  coordinates[3 * i + 2]);
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(2, elements, nodes);
      double least = 1.;
      for (std::size_t i = 0; i + 3 <= nodes.size(); i += 3)
        {
          const Point<3> &a = place[nodes[i]], &b = place[nodes[i + 1]],
                         &c = place[nodes[i + 2]];
          const double area = cross_product_3d(b - a, c - a).norm();
          const double longest =
            std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
          least = std::min(least,
                           area / longest /
                             (0.866 * simplex_coarsening<dim> *
                              size(in_model<dim>(a + (Tensor<1, 3>(b - a) +
                                                      Tensor<1, 3>(c - a)) /
                                                       3.))));
        }
      return least;
    }

    /** Mesh the current model of volumes. Surfaces that are too thin already
     * are not gone on with unless they @p must_be: thin cells are certain, and
     * so are faults of Gmsh. */
    void
    mesh_volumes(const MeshSize<3> &size, const bool must_be)
    {
      require_meshed(mesh_surfaces());
      const double thinness = thinnest_triangle(size);
      if (!must_be && thinness < least_thinness)
        {
          std::ostringstream text;
          text << "the thinnest triangle on them would have "
               << std::setprecision(2) << thinness
               << " of the thickness wanted";
          throw std::runtime_error(text.str());
        }
      require_meshed(mesh_entities(3));
    }

    /** Joints and excavations as they are. In 3D bad cells are mended.
     * Throws what went wrong, also cells that are thin unless they @p must_be.
     */
    template <int dim>
    MarkedMesh<dim>
    mesh_exactly(const Scene<dim> &scene,
                 const std::vector<SizeDemand<dim>> &demands,
                 const bool must_be)
    {
      const GmshSession session;
      const GmshModel<dim> model = build_gmsh_model<dim>(scene, true);
      const MeshSize<dim> size   = wanted_size(scene, demands, model);
      set_sizes<dim>(size,
                     dim == 2 ? quadrilateral_coarsening
                              : simplex_coarsening<dim>);
      if constexpr (dim == 2)
        require_meshed(mesh_with_quadrilaterals());
      else
        mesh_volumes(size, must_be);
      MarkedMesh<dim> marked = Reader<dim>(model, scene).read();
      if (dim == 2)
        return marked;
      SimplexMesh<dim> mesh = make_simplex_mesh(marked, size);
      MeshImprovement<dim>(mesh, 0.).improve(wanted_quality, 8);
      return to_marked_mesh(mesh);
    }

    /** Joints cut into a mesh of domain and excavations. */
    template <int dim>
    MarkedMesh<dim>
    mesh_by_cuts(const Scene<dim> &scene,
                 const std::vector<SizeDemand<dim>> &demands,
                 MeshReport<dim> &report)
    {
      const GmshSession session;
      const GmshModel<dim> model = build_gmsh_model<dim>(scene, false);
      const MeshSize<dim> size   = wanted_size(scene, demands, model);
      set_sizes<dim>(size, simplex_coarsening<dim>);
      if constexpr (dim == 2)
        require_meshed(mesh_surfaces());
      else
        mesh_volumes(size, true);
      SimplexMesh<dim> mesh =
        make_simplex_mesh(Reader<dim>(model, scene).read(), size);
      report =
        cut_joints(mesh, scene, scene.meshing.snap, simplex_coarsening<dim>);
      return to_marked_mesh(mesh);
    }

    /** Put the new vertices in the middle of chords onto their circles, unless
     * that turns a thin cell beside them bad. */
    template <int dim>
    void
    bend_outlines(Mesh<dim> &mesh)
    {
      constexpr double least_jacobian = 0.05;
      std::map<unsigned int, Point<dim>> straight;
      for (const auto &face : mesh.marked_faces)
        if (mesh.surfaces[face.surface].radius > 0.)
          for (const unsigned int v : face.vertices)
            {
              const Surface<dim> &circle = mesh.surfaces[face.surface];
              const double distance      = circle.distance(mesh.vertices[v]);
              if (std::abs(distance) < 1e-12 * circle.radius)
                continue;
              straight[v] = mesh.vertices[v];
              mesh.vertices[v] -= distance * circle.normal_at(mesh.vertices[v]);
            }
      bool has_changed = !straight.empty();
      while (has_changed)
        {
          has_changed = false;
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (const unsigned int v : mesh.cells[c])
              {
                const auto entry = straight.find(v);
                if (entry != straight.end() &&
                    mesh.scaled_jacobian(c) < least_jacobian)
                  {
                    mesh.vertices[v] = entry->second;
                    straight.erase(entry);
                    has_changed = true;
                  }
              }
        }
    }

    /** Joints that lie on the same faces, the area they share, and the rock
     * that was between them. */
    template <int dim>
    void
    list_merged_joints(const MarkedMesh<dim> &marked,
                       const Scene<dim> &scene,
                       MeshReport<dim> &report)
    {
      std::map<std::vector<unsigned int>, std::vector<unsigned int>> on_face;
      for (const MixedMesh::Element &face : marked.mixed.marked_faces)
        if (marked.surfaces[face.id].is_joint())
          {
            std::vector<unsigned int> key = face.vertices;
            std::sort(key.begin(), key.end());
            on_face[key].push_back(face.id);
          }
      std::map<std::pair<unsigned int, unsigned int>, double> shared;
      std::vector<double> area_of(scene.joints.size(), 0.);
      for (auto &[vertices, surfaces] : on_face)
        {
          const auto joint_of = [&marked](const unsigned int s) {
            return marked.surfaces[s].joint;
          };
          std::sort(surfaces.begin(),
                    surfaces.end(),
                    [&](const unsigned int s, const unsigned int t) {
                      return rules(scene, joint_of(s), joint_of(t));
                    });
          const Point<3> &a = marked.mixed.vertices[vertices[0]],
                         &b = marked.mixed.vertices[vertices[1]],
                         &c = marked.mixed.vertices[vertices.back()];
          const double area = dim == 2
                                ? a.distance(b)
                                : 0.5 * cross_product_3d(b - a, c - a).norm();
          for (const unsigned int s : surfaces)
            area_of[joint_of(s)] += area;
          if (surfaces.size() < 2)
            continue;
          Tensor<1, dim> sum;
          for (const unsigned int v : vertices)
            sum += in_model<dim>(marked.mixed.vertices[v]);
          const Point<dim> center(sum / double(vertices.size()));
          double low = 1e300, high = -1e300;
          for (const unsigned int s : surfaces)
            {
              if (s != surfaces.front())
                shared[{joint_of(surfaces.front()), joint_of(s)}] += area;
              const double place =
                marked.surfaces[s].distance(center) *
                (marked.surfaces[s].normal *
                       marked.surfaces[surfaces.front()].normal <
                     0.
                   ? -1.
                   : 1.);
              low  = std::min(low, place);
              high = std::max(high, place);
            }
          report.lost_rock.push_back({center, high - low});
        }
      for (const auto &[pair, area] : shared)
        report.merged.push_back({pair.first,
                                 pair.second,
                                 area,
                                 area > (1. - 1e-9) * area_of[pair.second]});
    }

    /** Refuse a mesh that does not fit into memory before it is made. */
    template <int dim>
    void
    require_estimated_size(const Scene<dim> &scene,
                           const dealii::ConditionalOStream &out,
                           const std::vector<SizeDemand<dim>> &demands)
    {
      const DomainOutline<dim> outline(scene.domain);
      const Tensor<1, dim> sides = outline.upper - outline.lower;
      double longest = 0., volume_of_box = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          longest = std::max(longest, sides[d]);
          volume_of_box *= sides[d];
        }
      const MeshSize<dim> size(scene, longest, demands);
      const double part = volume_of(scene.domain) / volume_of_box;
      // more cannot be: mostly it is seen at once that all is well
      if (part * volume_of_box / std::pow(size.smallest(), double(dim)) <
          many_cells)
        return;
      const double n =
        part * estimate_cells(size,
                              outline.lower,
                              outline.upper,
                              std::numeric_limits<double>::max());
      if (n > many_cells)
        out << "Mesh    about " << std::setprecision(2) << n
            << " cells are to be made by Gmsh" << std::endl;
      require_size<dim>(n,
                        scene.joints.size(),
                        "'Mesh/Size' and the sizes at excavations and joints",
                        [](const double times) {
                          std::ostringstream text;
                          text << std::setprecision(2)
                               << "make the sizes of the section 'Mesh' "
                               << std::pow(times, 1. / dim)
                               << " times as large, or the domain smaller";
                          return text.str();
                        });
    }

    template <int dim>
    Mesh<dim>
    to_mesh(const MarkedMesh<dim> &marked,
            const Scene<dim> &scene,
            const std::string &remedy)
    {
      Mesh<dim> mesh =
        cut_mesh<dim>(marked.mixed, "The mesh made by Gmsh", remedy);
      list_merged_joints(marked, scene, mesh.report);
      mesh.surfaces = marked.surfaces;
      bend_outlines(mesh);
      return mesh;
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  make_gmsh_mesh(const Scene<dim> &scene,
                 const dealii::ConditionalOStream &out,
                 const std::vector<SizeDemand<dim>> &demands)
  {
    require_estimated_size(scene, out, demands);
    const double snap = scene.meshing.snap;
    std::ostringstream remedy;
    remedy << "change 'Mesh/Size' (" << scene.meshing.size
           << " m), move joints and excavations that almost touch each other"
           << (snap > 0. ? "" : ", or give 'Mesh/Snap' its default");

    std::string reason;
    Mesh<dim> exact;
    double thinness     = 0.; // of the exact mesh, if there is one
    const bool is_exact = snap == 0. || scene.joints.empty();
    if (is_exact || scene.joints.size() <= most_exact_joints<dim>)
      {
        reason = reason_of_failure([&]() {
          exact = to_mesh(mesh_exactly(scene, demands, is_exact),
                          scene,
                          remedy.str());
        });
        if (reason.empty())
          {
            exact.report.way = "exact";
            thinness         = least_over_median_thickness(exact);
            if (is_exact || thinness >= least_thinness)
              return exact;
            std::ostringstream text;
            text << "the thinnest cell would have " << std::setprecision(2)
                 << thinness << " of the usual thickness";
            reason = text.str();
          }
        AssertThrow(!is_exact,
                    InputError(
                      "Gmsh could not mesh the scene with its " +
                      std::to_string(scene.joints.size()) + " joints and " +
                      std::to_string(scene.excavations.size()) +
                      " excavations (" + reason + "); " + remedy.str() + "."));
      }
    else
      reason = std::to_string(scene.joints.size()) + " joints are more than " +
               std::to_string(most_exact_joints<dim>);
    Mesh<dim> mesh;
    MeshReport<dim> report;
    const std::string failure = reason_of_failure([&]() {
      mesh = to_mesh(mesh_by_cuts(scene, demands, report), scene, remedy.str());
    });
    if (thinness > 0. &&
        (!failure.empty() ||
         thinness >= acceptable_part * least_over_median_thickness(mesh)))
      return exact;
    AssertThrow(failure.empty(),
                InputError("Gmsh could not mesh the domain with its " +
                           std::to_string(scene.excavations.size()) +
                           " excavations (" + failure + "); " + remedy.str() +
                           "."));
    report.merged = mesh.report.merged;
    report.lost_rock.insert(report.lost_rock.end(),
                            mesh.report.lost_rock.begin(),
                            mesh.report.lost_rock.end());
    mesh.report        = report;
    mesh.report.reason = reason;
    return mesh;
  }

  template Mesh<2> make_gmsh_mesh(const Scene<2> &,
                                  const dealii::ConditionalOStream &,
                                  const std::vector<SizeDemand<2>> &);
  template Mesh<3> make_gmsh_mesh(const Scene<3> &,
                                  const dealii::ConditionalOStream &,
                                  const std::vector<SizeDemand<3>> &);
} // namespace Keyblock

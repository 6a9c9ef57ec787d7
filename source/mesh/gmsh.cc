// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh that follows joints and excavations, made by Gmsh in this process,
// exactly or with the joints cut into it.
#include <gmsh.h>
#include <keyblock/base/box.h>
#include <keyblock/base/errors.h>
#include <keyblock/mesh/cut.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/gmsh_file.h>
#include <keyblock/mesh/gmsh_model.h>
#include <keyblock/mesh/improvement.h>
#include <keyblock/mesh/joint_cut.h>
#include <keyblock/mesh/marked_mesh.h>
#include <keyblock/mesh/size.h>
#include <keyblock/mesh/size_limit.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/near_misses.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    using gmsh::vectorpair;

    /** The same for Gmsh's quadrilaterals, which it halves. */
    constexpr double quadrilateral_coarsening = 2.;

    /** Gmsh's numbers of the mesh algorithms used. Its faster parallel one in
     * 3D, number 10, gives another mesh in every run. */
    constexpr int frontal_delaunay_2d = 6, delaunay_2d = 5, delaunay_3d = 1;

    /** Gmsh's numbers of the ways to pair triangles to quadrilaterals: the best
     * pairing of all, which not every mesh has, and one pair after the other.
     */
    constexpr int blossom = 1, one_by_one = 0;

    /** The thinnest cell that an exact mesh may have over the median one [-].
     * In dynamic stages it sets the step; in the others and in trials all cells
     * have equal steps, but thinner ones than that do not come to rest. */
    constexpr double thinnest_of_dynamic = 0.01, thinnest = 1e-4;

    /** One of the ways to mesh a scene exactly that are tried in turn: over
     * faces and nodes that almost coincide Gmsh fails in one way and not in
     * another. */
    struct Attempt
    {
      bool is_tolerant; ///< what is nearer than the bridging is connected
      bool are_paired;  ///< triangles in 2D, to quadrilaterals
      int algorithm;    ///< Gmsh's number, for triangles
      double part;      ///< of the sizes wanted [-]
    };

    template <int dim>
    std::vector<Attempt>
    list_attempts()
    {
      if (dim == 2)
        return {{true, true, frontal_delaunay_2d, 1.},
                {true, false, frontal_delaunay_2d, 1.}};
      // (tolerance takes OpenCASCADE minutes where many planes cross)
      return {{false, false, frontal_delaunay_2d, 1.},
              {true, false, delaunay_2d, 1.},
              {true, false, delaunay_2d, 0.9},
              {true, false, delaunay_2d, 0.8}};
    }

    /** Gaps that OpenCASCADE closes by itself, over the size of the domain. */
    constexpr double rounding = 1e-8;

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
          reason = mesh_entities(2);
          if (reason.empty())
            return "";
          gmsh::model::mesh::clear();
        }
      gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 0);
      gmsh::option::setNumber("Mesh.RecombineAll", 0);
      return mesh_entities(2);
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

    /** What Gmsh makes in a process of its own of domain and excavations and,
     * if
     * @p with_joints, of joints; what is nearer to another joint than the @p
     * tolerance [m] ends on it. In 2D triangles that are not paired are cut
     * later. Throws what went wrong. */
    template <int dim>
    MarkedMesh<dim>
    mesh_model(const Scene<dim> &scene,
               const bool with_joints,
               const double tolerance,
               const MeshSize<dim> &size,
               const Attempt &attempt)
    {
      MarkedMesh<dim> marked;
      in_child_process(
        [&]() {
          const double coarsening =
            attempt.part * (attempt.are_paired ? quadrilateral_coarsening
                                               : simplex_coarsening<dim>);
          const GmshSession session;
          const GmshModel<dim> model = build_gmsh_model<dim>(
            scene, with_joints, tolerance, size, coarsening);
          set_sizes<dim>(size, coarsening);
          gmsh::option::setNumber("Mesh.Algorithm", attempt.algorithm);
          const std::string reason = attempt.are_paired
                                       ? mesh_with_quadrilaterals()
                                       : mesh_entities(dim);
          if (!reason.empty())
            throw std::runtime_error(reason);
          marked = read_marked_mesh(model, scene);
        },
        [&](const PipeEnd &pipe) {
          write_mixed_mesh(pipe, marked.mixed);
          pipe.write_list(marked.surfaces);
          pipe.write_list(marked.corners);
        },
        [&](const PipeEnd &pipe) {
          marked.mixed    = read_mixed_mesh(pipe);
          marked.surfaces = pipe.read_list<Surface<dim>>();
          marked.corners  = pipe.read_list<unsigned int>();
        });
      return marked;
    }

    /** Joints and excavations as they are; in 3D bad cells are mended. */
    template <int dim>
    MarkedMesh<dim>
    mesh_exactly(const Scene<dim> &scene,
                 const double tolerance,
                 const MeshSize<dim> &size,
                 const Attempt &attempt)
    {
      const MarkedMesh<dim> marked =
        mesh_model(scene, true, tolerance, size, attempt);
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
                 const MeshSize<dim> &size,
                 MeshReport<dim> &report)
    {
      SimplexMesh<dim> mesh =
        make_simplex_mesh(mesh_model(scene,
                                     false,
                                     0.,
                                     size,
                                     {false, false, frontal_delaunay_2d, 1.}),
                          size);
      report =
        cut_joints(mesh, scene, scene.meshing.snap, simplex_coarsening<dim>);
      return to_marked_mesh(mesh);
    }

    /** Refuse a mesh that does not fit into memory before it is made. */
    template <int dim>
    void
    require_estimated_size(const Scene<dim> &scene,
                           const dealii::ConditionalOStream &out,
                           const DomainOutline<dim> &outline,
                           const MeshSize<dim> &size)
    {
      const double volume_of_box =
        BoundingBox<dim>({outline.lower, outline.upper}).volume();
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
    const DomainOutline<dim> outline(scene.domain);
    const double longest =
      longest_side(BoundingBox<dim>({outline.lower, outline.upper}));
    const MeshSize<dim> size(scene, longest, demands);
    require_estimated_size(scene, out, outline, size);
    const double snap = scene.meshing.snap;
    std::ostringstream remedy;
    remedy << "change 'Mesh/Size' (" << scene.meshing.size
           << " m), move joints and excavations that almost touch each other"
           << (snap > 0. ? "" : ", or give 'Mesh/Snap' its default");

    const bool must_be_exact = snap == 0. || scene.joints.empty();
    const double least       = must_be_exact               ? 0.
                               : scene.has_dynamic_stage() ? thinnest_of_dynamic
                                                           : thinnest;
    std::string reason;
    Mesh<dim> exact;
    const double tolerance = bridging_length(scene.network.bridging, longest);
    const bool is_needed =
      !list_near_misses(scene, rounding * longest, tolerance).empty();
    for (const Attempt &attempt : list_attempts<dim>())
      {
        reason = reason_of_failure([&]() {
          exact =
            to_mesh(mesh_exactly(scene,
                                 is_needed || attempt.is_tolerant ? tolerance
                                                                  : 0.,
                                 size,
                                 attempt),
                    scene,
                    remedy.str());
        });
        if (reason.empty())
          break;
      }
    const bool is_made = reason.empty();
    if (is_made)
      {
        exact.report.way      = "exact";
        const double thinness = least_over_median_thickness(exact);
        if (thinness >= least)
          return exact;
        std::ostringstream text;
        text << "the thinnest cell would have " << std::setprecision(2)
             << thinness << " of the usual thickness";
        reason = text.str();
      }
    AssertThrow(!must_be_exact,
                InputError(
                  "Gmsh could not mesh the scene with its " +
                  std::to_string(scene.joints.size()) + " joints and " +
                  std::to_string(scene.excavations.size()) + " excavations (" +
                  reason + "); " + remedy.str() + "."));
    Mesh<dim> mesh;
    MeshReport<dim> report;
    const std::string failure = reason_of_failure([&]() {
      mesh = to_mesh(mesh_by_cuts(scene, size, report), scene, remedy.str());
    });
    if (is_made && (!failure.empty() || least_over_median_thickness(exact) >=
                                          least_over_median_thickness(mesh)))
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

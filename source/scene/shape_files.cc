// SPDX-License-Identifier: LGPL-2.1-or-later
// Excavations from files: solids in 3D, an outline in 2D.
#include <keyblock/base/digest.h>
#include <keyblock/base/find_file.h>
#include <keyblock/base/gmsh_session.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/dxf.h>
#include <keyblock/scene/polygon.h>
#include <keyblock/scene/shape_files.h>
#include <keyblock/scene/shape_place.h>
#include <keyblock/scene/solid_file.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** Chords of half a circle in a drawing if no number is given. */
    constexpr unsigned int default_segments = 24;

    template <int dim>
    class ShapeFileReader
    {
    public:
      ShapeFileReader(const Communicator &communicator,
                      const Scene<dim> &scene,
                      Excavation<dim> &excavation)
        : communicator(communicator)
        , scene(scene)
        , excavation(excavation)
        , section("Excavations/" + excavation.name)
        , subject("The file '" + excavation.file + "' of the entry '" +
                  section + "/File'")
        , suffix(boost::to_lower_copy(
            std::filesystem::path(excavation.file).extension().string()))
      {}

      void
      read()
      {
        check_suffix();
        communicator.on_root([&]() { find_and_read(); });
        excavation.file = communicator.text_of_root(excavation.file);
        excavation.file_digest =
          communicator.text_of_root(excavation.file_digest);
        communicator.broadcast(outline);
        std::vector<unsigned int> n_surfaces = {
          static_cast<unsigned int>(surfaces.size())};
        communicator.broadcast(n_surfaces);
        surfaces.resize(n_surfaces[0]);
        for (TriangleSurface &surface : surfaces)
          {
            communicator.broadcast(surface.vertices);
            communicator.broadcast(surface.triangles);
          }
        if (dim == 2)
          {
            excavation.shape    = ExcavationShape::polygon;
            excavation.vertices = outline;
          }
        for (TriangleSurface &surface : surfaces)
          excavation.solids.push_back(
            std::make_shared<Solid>(std::move(surface)));
        if (scene.domain.shape != DomainShape::file)
          check_place();
      }

    private:
      void
      check_suffix() const
      {
        require(!excavation.file.empty(),
                "The entry '" + section +
                  "/File' is empty, but 'Shape' is file; name the file of the "
                  "shape (only in a mesh from 'Domain/File' does it stand for "
                  "the physical group of the excavation's name).");
        const bool is_drawing = suffix == ".dxf";
        require(is_drawing || is_cad(suffix) || is_stl(suffix),
                subject + " has the extension '" + suffix +
                  "'; convert it to " +
                  (dim == 2 ? ".dxf." : "one of .step, .stp, .brep, .stl."));
        require(
          is_drawing == (dim == 2),
          subject +
            (is_drawing
               ? " is a drawing, but 'Dimension' is 3, where excavations are "
                 "solids: export the body as .stl, .step or .brep, or "
                 "give an extruded polygon (3DFACEs of a drawing serve "
                 "as joints, by 'Joints/NAME/File')."
               : " is a solid, but 'Dimension' is 2; give a closed "
                 "outline (.dxf)."));
        check_scale(section, excavation.file, excavation.scale);
      }

      /** On rank 0. */
      void
      find_and_read()
      {
        const std::string found = find_file(scene.file, excavation.file);
        require(!found.empty(),
                subject + " does not exist or cannot be read; give a path "
                          "relative to the scene file.");
        excavation.file = found;
        std::ifstream in(found, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in),
                               std::istreambuf_iterator<char>()};
        excavation.file_digest = digest_of(text);
        const std::string reason =
          reason_of_failure([&]() { read_content(text); });
        require(reason.empty(),
                subject + " cannot be used (" + reason +
                  "); correct it in the program that made it.");
        if (dim == 2)
          check_outline();
        else
          for (TriangleSurface &surface : surfaces)
            {
              const std::string fault = surface.orient();
              require(fault.empty(),
                      subject + " has a surface that " + fault +
                        "; close it in the program that made it.");
            }
      }

      void
      read_content(const std::string &text)
      {
        Point<3> origin;
        for (unsigned int d = 0; d < dim; ++d)
          origin[d] = scene.domain.origin[d];
        if (dim == 2)
          {
            outline =
              read_dxf_outline(text,
                               excavation.segments > 0 ? excavation.segments
                                                       : default_segments);
            for (Point<2> &p : outline)
              p = Point<2>(excavation.scale * p[0] - origin[0],
                           excavation.scale * p[1] - origin[1]);
          }
        else if (is_stl(suffix))
          {
            TriangleSurface surface = read_stl(text);
            for (Point<3> &p : surface.vertices)
              p = Point<3>(excavation.scale * p - origin);
            surfaces = surface.components();
          }
        else
          surfaces =
            triangulate_solids(excavation.file, excavation.scale, origin);
      }

      void
      check_outline() const
      {
        const std::string fault =
          outline.size() < 3 ? "has no area" : fault_of_polygon(outline);
        require(fault.empty(),
                subject + " has an outline that " + fault +
                  "; draw it as one closed line that does not cross itself.");
      }

      std::vector<Point<dim>>
      outermost_points() const
      {
        if constexpr (dim == 2)
          return outline;
        else
          {
            std::vector<Point<3>> points;
            for (const auto &solid : excavation.solids)
              points.insert(points.end(), {solid->low, solid->high});
            return points;
          }
      }

      /** The shape reaches into the domain and is of its order of size. */
      void
      check_place() const
      {
        const ShapePlace<dim> place(scene.domain,
                                    dealii::BoundingBox<dim>(
                                      outermost_points()),
                                    subject + " has a shape",
                                    section,
                                    suffix);
        place.require_smaller();
        place.require_size();
        place.require_inside(false);
      }

      const Communicator &communicator;
      const Scene<dim> &scene;
      Excavation<dim> &excavation;
      const std::string section, subject, suffix;
      std::vector<Point<2>> outline;
      std::vector<TriangleSurface> surfaces;
    };
  } // namespace



  template <int dim>
  void
  read_shape_files(const Communicator &communicator, Scene<dim> &scene)
  {
    for (const auto &excavation : scene.excavations)
      if (excavation->shape == ExcavationShape::file &&
          !(excavation->is_group() && scene.domain.shape == DomainShape::file))
        ShapeFileReader<dim>(communicator, scene, *excavation).read();
  }

  template <int dim>
  std::vector<std::string>
  warnings_of_nested_solids(const Scene<dim> &scene)
  {
    std::vector<std::string> found;
    for (const auto &excavation : scene.excavations)
      for (const auto &inner : excavation->solids)
        for (const auto &outer : excavation->solids)
          if (inner != outer && std::all_of(inner->surface.vertices.begin(),
                                            inner->surface.vertices.end(),
                                            [&](const Point<3> &p) {
                                              return outer->depth_inside(p) >
                                                     0.;
                                            }))
            {
              std::ostringstream place;
              place << inner->surface.vertices.front();
              found.push_back(
                "The file of 'Excavations/" + excavation->name +
                "/File' has a closed surface at (" + place.str() +
                ") m inside another: rock within it would float, and is "
                "excavated, too; draw rock that stays, such as a pillar, as "
                "part of the outer surface.");
            }
    return found;
  }

  template std::vector<std::string> warnings_of_nested_solids(const Scene<2> &);
  template std::vector<std::string> warnings_of_nested_solids(const Scene<3> &);
  template void read_shape_files(const Communicator &, Scene<2> &);
  template void read_shape_files(const Communicator &, Scene<3> &);
} // namespace Keyblock

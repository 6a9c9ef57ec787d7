// SPDX-License-Identifier: LGPL-2.1-or-later
// Solids and surfaces from files: triangles of .stl, and shapes that
// OpenCASCADE reads by way of Gmsh.
#include <gmsh.h>
#include <keyblock/base/box.h>
#include <keyblock/base/child_process.h>
#include <keyblock/base/gmsh_session.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/solid_file.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace Keyblock
{
  namespace
  {
    namespace occ = gmsh::model::occ;

    /** Distance of vertices of an .stl file that are one, over the size of the
     * surface [-]: its numbers have seven digits. */
    constexpr double same_vertex = 1e-7;

    /** Step of the numbers of an .stl file over the size of the surface that is
     * taken [-]. */
    constexpr double coarsest_step = 1e-3;

    /** Chords of a full circle where a curved surface becomes triangles. */
    constexpr double chords_of_circle = 96.;

    // binary STL: a head, the number of triangles, and of each the normal, the
    // corners and two bytes
    constexpr std::size_t head_of_stl = 80, bytes_of_triangle = 50;

    void
    add_triangle(TriangleSurface &surface,
                 const std::array<Point<3>, 3> &corners)
    {
      const unsigned int n = surface.vertices.size();
      surface.vertices.insert(surface.vertices.end(),
                              corners.begin(),
                              corners.end());
      surface.triangles.push_back({{n, n + 1, n + 2}});
    }

    bool
    is_binary_stl(const std::string &text)
    {
      std::uint32_t n = 0;
      if (text.size() < head_of_stl + sizeof n)
        return false;
      std::memcpy(&n, &text[head_of_stl], sizeof n);
      return text.size() == head_of_stl + sizeof n + n * bytes_of_triangle;
    }

    TriangleSurface
    read_binary_stl(const std::string &text)
    {
      TriangleSurface surface;
      for (std::size_t at = head_of_stl + sizeof(std::uint32_t);
           at < text.size();
           at += bytes_of_triangle)
        {
          float numbers[12];
          std::memcpy(numbers, &text[at], sizeof numbers);
          std::array<Point<3>, 3> corners;
          for (unsigned int i = 0; i < 9; ++i)
            corners[i / 3][i % 3] = numbers[3 + i];
          add_triangle(surface, corners);
        }
      return surface;
    }

    /** Throw if the numbers of 32 bits of binary STL are too coarse for a shape
     * so far from the origin. */
    void
    require_fine_steps(const TriangleSurface &surface)
    {
      const BoundingBox<3> box(surface.vertices);
      const double farthest = farthest_coordinate(box);
      const float place     = static_cast<float>(farthest);
      const double step =
        std::nextafter(place, std::numeric_limits<float>::infinity()) - place;
      if (step > coarsest_step * longest_side(box))
        throw std::runtime_error(
          "numbers of binary STL have steps of " + text_of(step, 3) + " at " +
          text_of(farthest, 8) +
          "; export it relative to 'Domain/Origin', as ASCII STL or as STEP");
    }

    TriangleSurface
    read_ascii_stl(const std::string &text)
    {
      TriangleSurface surface;
      std::array<Point<3>, 3> corners;
      unsigned int n = 0;
      bool is_whole  = false; // all solids that begin also end
      std::istringstream in(text);
      for (std::string word; in >> word;)
        if (boost::iequals(word, "vertex"))
          {
            is_whole = false;
            for (unsigned int d = 0; d < 3; ++d)
              if (!(in >> word) || !read_number(word, false, corners[n][d]))
                throw std::runtime_error("'" + word.substr(0, 30) +
                                         "' stands where a coordinate is "
                                         "expected");
            if (++n == 3)
              {
                add_triangle(surface, corners);
                n = 0;
              }
          }
        else if (boost::iequals(word, "endfacet") && n != 0)
          throw std::runtime_error("a facet has not three corners");
        else if (boost::iequals(word, "facet"))
          is_whole = false;
        else if (boost::iequals(word, "endsolid"))
          is_whole = n == 0;
      if (!is_whole)
        throw std::runtime_error("the file ends before its 'endsolid', as one "
                                 "that was cut off");
      return surface;
    }

    /** Make one of the corners that coincide up to the precision of files. */
    void
    weld_corners(TriangleSurface &surface)
    {
      for (const Point<3> &p : surface.vertices)
        for (unsigned int d = 0; d < 3; ++d)
          if (!std::isfinite(p[d]))
            throw std::runtime_error("it has a corner that is no finite "
                                     "number");
      surface.weld(same_vertex * diagonal_of_box(surface.vertices));
    }

    /** Let OpenCASCADE turn lengths of files that name a unit into metres. */
    void
    take_unit_of_file()
    {
      gmsh::option::setString("Geometry.OCCTargetUnit", "M");
    }
  } // namespace



  bool
  is_stl(const std::string &path)
  {
    return boost::iends_with(path, ".stl");
  }



  bool
  is_cad(const std::string &path)
  {
    return names_unit(path) || boost::iends_with(path, ".brep");
  }



  bool
  names_unit(const std::string &path)
  {
    return boost::iends_with(path, ".step") || boost::iends_with(path, ".stp");
  }



  void
  check_scale(const std::string &section,
              const std::string &path,
              const double scale)
  {
    require(!names_unit(path) || scale == 1.,
            "The entry '" + section + "/Scale' is " + text_of(scale) +
              ", but '" + path +
              "' is a STEP file, which names its unit; leave 'Scale' out.");
  }



  void
  require_few_triangles(const TriangleSurface &surface)
  {
    if (surface.triangles.size() > most_triangles)
      throw std::runtime_error(
        "it has " + std::to_string(surface.triangles.size()) +
        " triangles, more than " + std::to_string(most_triangles) +
        ", each of which cells would follow: make them larger");
  }



  TriangleSurface
  read_stl(const std::string &text)
  {
    const bool is_binary = is_binary_stl(text);
    const auto begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    const bool is_ascii = boost::istarts_with(text.substr(begin, 5), "solid") &&
                          text.find('\0') == std::string::npos;
    if (!is_binary && !is_ascii)
      throw std::runtime_error(
        "it is neither ASCII STL, which begins with 'solid', nor binary STL of "
        "the length that its number of triangles asks for");
    TriangleSurface surface =
      is_binary ? read_binary_stl(text) : read_ascii_stl(text);
    if (surface.triangles.empty())
      throw std::runtime_error("it has no triangles");
    require_few_triangles(surface);
    if (is_binary)
      require_fine_steps(surface);
    weld_corners(surface);
    return surface;
  }



  std::vector<int>
  import_solids(const std::string &path,
                const double scale,
                const Point<3> &origin)
  {
    gmsh::vectorpair shapes;
    take_unit_of_file();
    occ::importShapes(path, shapes);
    std::vector<int> solids;
    gmsh::vectorpair others;
    for (const auto &shape : shapes)
      if (shape.first == 3)
        solids.push_back(shape.second);
      else
        others.push_back(shape);
    if (solids.empty())
      throw std::runtime_error(
        shapes.empty() ? "it has no solid"
                       : "it has surfaces, but no solid that they close");
    occ::remove(others, true);
    gmsh::vectorpair bodies;
    for (const int solid : solids)
      bodies.emplace_back(3, solid);
    if (scale != 1.)
      occ::dilate(bodies, 0., 0., 0., scale, scale, scale);
    if (origin.norm() > 0.)
      occ::translate(bodies, -origin[0], -origin[1], -origin[2]);
    return solids;
  }



  namespace
  {
    /** Make triangles on all faces of Gmsh's model, on curved ones with
     * @p chords in a full circle. */
    void
    triangulate_model(const double chords)
    {
      occ::synchronize();
      for (const std::string source : {"ExtendFromBoundary", "FromPoints"})
        gmsh::option::setNumber("Mesh.MeshSize" + source, 0.);
      gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", chords);
      gmsh::model::mesh::generate(2);
    }

    /** The triangles on faces, by their dimension and tag. */
    TriangleSurface
    read_surface(const gmsh::vectorpair &faces)
    {
      TriangleSurface surface;
      std::unordered_map<std::size_t, unsigned int> number;
      const std::set<std::pair<int, int>> once(faces.begin(), faces.end());
      for (const auto &[dimension, face] : once)
        {
          std::vector<std::size_t> tags, elements, nodes;
          std::vector<double> coordinates, parameters;
          gmsh::model::mesh::getNodes(
            tags, coordinates, parameters, 2, face, true);
          for (std::size_t i = 0; i < tags.size(); ++i)
            if (number.try_emplace(tags[i], surface.vertices.size()).second)
              surface.vertices.emplace_back(coordinates[3 * i],
                                            coordinates[3 * i + 1],
                                            coordinates[3 * i + 2]);
          gmsh::model::mesh::getElementsByType(2, elements, nodes, face);
          for (std::size_t i = 0; i + 2 < nodes.size(); i += 3)
            surface.triangles.push_back({{number.at(nodes[i]),
                                          number.at(nodes[i + 1]),
                                          number.at(nodes[i + 2])}});
        }
      return surface;
    }

    std::vector<TriangleSurface>
    triangulate_here(const std::string &path,
                     const double scale,
                     const Point<3> &origin)
    {
      const GmshSession session;
      const std::vector<int> solids = import_solids(path, scale, origin);
      triangulate_model(chords_of_circle);
      std::vector<TriangleSurface> surfaces;
      for (const int solid : solids)
        {
          gmsh::vectorpair faces;
          gmsh::model::getBoundary({{3, solid}}, faces, false, false, false);
          surfaces.push_back(read_surface(faces));
        }
      return surfaces;
    }

    TriangleSurface
    triangulate_faces_here(const std::string &path,
                           const double chords,
                           const double least_edge)
    {
      const GmshSession session;
      take_unit_of_file();
      gmsh::option::setNumber("Geometry.OCCSewFaces", 1.);
      gmsh::vectorpair shapes, faces;
      occ::importShapes(path, shapes, false);
      occ::synchronize();
      gmsh::model::getEntities(faces, 2);
      if (faces.empty())
        throw std::runtime_error("it has no faces");
      gmsh::option::setNumber("Mesh.MeshSizeMin", least_edge);
      triangulate_model(chords);
      return read_surface(faces);
    }
  } // namespace



  std::vector<TriangleSurface>
  triangulate_solids(const std::string &path,
                     const double scale,
                     const Point<3> &origin)
  {
    std::vector<TriangleSurface> surfaces;
    in_child_process(
      [&]() { surfaces = triangulate_here(path, scale, origin); },
      [&](const PipeEnd &pipe) {
        pipe.write_number(surfaces.size());
        for (const TriangleSurface &surface : surfaces)
          {
            pipe.write_list(surface.vertices);
            pipe.write_list(surface.triangles);
          }
      },
      [&](const PipeEnd &pipe) {
        surfaces.resize(pipe.read_number());
        for (TriangleSurface &surface : surfaces)
          {
            surface.vertices  = pipe.read_list<Point<3>>();
            surface.triangles = pipe.read_list<TriangleSurface::Triangle>();
          }
      });
    return surfaces;
  }



  TriangleSurface
  triangulate_faces(const std::string &path,
                    const unsigned int chords,
                    const double least_edge)
  {
    TriangleSurface surface;
    in_child_process(
      [&]() { surface = triangulate_faces_here(path, chords, least_edge); },
      [&](const PipeEnd &pipe) {
        pipe.write_list(surface.vertices);
        pipe.write_list(surface.triangles);
      },
      [&](const PipeEnd &pipe) {
        surface.vertices  = pipe.read_list<Point<3>>();
        surface.triangles = pipe.read_list<TriangleSurface::Triangle>();
      });
    require_few_triangles(surface);
    weld_corners(surface);
    return surface;
  }
} // namespace Keyblock

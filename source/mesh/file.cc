// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh from a file: .msh is read by Gmsh.
#include <deal.II/base/bounding_box.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/find_file.h>
#include <keyblock/mesh/file_formats.h>
#include <keyblock/mesh/gmsh_file.h>
#include <keyblock/mesh/mark_groups.h>
#include <keyblock/mesh/size_limit.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  unsigned int
  next_count(std::istream &in, const std::string &what)
  {
    const auto count        = next<unsigned long long>(in, what);
    unsigned long long rest = 0;
    if (in.good())
      {
        const auto here = in.tellg();
        in.seekg(0, std::ios::end);
        rest = in.tellg() - here;
        in.seekg(here);
      }
    if (count > rest / 2 + 1 || count >= none)
      throw std::runtime_error("a " + what + " of " + std::to_string(count) +
                               ", more than the file has room for");
    return count;
  }



  unsigned long
  whole_number(const std::string &word)
  {
    unsigned long value = 0;
    const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      throw std::runtime_error("'" + word + "' where a number is expected");
    return value;
  }

  double
  real_number(const std::string &word)
  {
    std::istringstream in(word);
    in.imbue(std::locale::classic());
    double value;
    if (!(in >> value) || in.peek() != std::istringstream::traits_type::eof())
      throw std::runtime_error("'" + word + "' where a number is expected");
    return value;
  }

  void
  add_element(MixedMesh &mixed,
              const MixedMesh::Element &element,
              const unsigned int dimension,
              const unsigned int dim)
  {
    for (const unsigned int vertex : element.vertices)
      if (vertex >= mixed.vertices.size())
        throw std::runtime_error("an element names a vertex that does not "
                                 "exist");
    if (dimension == dim)
      mixed.cells.push_back(element);
    else if (dimension + 1 == dim && element.id != 0)
      mixed.faces.push_back(element);
  }



  namespace
  {
    /** Variation of z in a 2D mesh, relative to its size, that is still taken
     * for round-off [-]. */
    constexpr double flatness = 1e-8;

    /** More than any model is wide [m]; squares and products stay finite. */
    constexpr double largest_coordinate = 1e9;

    /** Points not used by cells would count as vertices of the mesh. */
    void
    drop_unused_vertices(MixedMesh &mixed)
    {
      std::vector<unsigned int> rank(mixed.vertices.size(), none);
      std::vector<Point<3>> used;
      for (MixedMesh::Element &cell : mixed.cells)
        for (unsigned int &vertex : cell.vertices)
          {
            if (rank[vertex] == none)
              {
                rank[vertex] = used.size();
                used.push_back(mixed.vertices[vertex]);
              }
            vertex = rank[vertex];
          }
      std::vector<MixedMesh::Element> faces;
      for (MixedMesh::Element face : mixed.faces)
        {
          for (unsigned int &vertex : face.vertices)
            vertex = rank[vertex];
          if (std::count(face.vertices.begin(), face.vertices.end(), none) == 0)
            faces.push_back(face);
        }
      mixed.vertices = std::move(used);
      mixed.faces    = std::move(faces);
    }

    template <int dim>
    MixedMesh
    read_file(const std::string &path, const std::string &extension)
    {
      std::ifstream in(path);
      if (extension == ".msh")
        {
          // Gmsh would take anything else for a script and execute it
          if ((in >> std::ws).peek() != '$')
            throw std::runtime_error("it does not begin with '$'");
          return read_gmsh_file<dim>(path);
        }
      MixedMesh mixed = extension == ".vtk"   ? read_vtk(in, dim)
                        : extension == ".inp" ? read_abaqus(in, dim)
                                              : read_ucd(in, dim);
      drop_unused_vertices(mixed);
      return mixed;
    }

    /** In 2D all vertices must lie in one plane of constant z. */
    void
    check_flat(const MixedMesh &mixed, const std::string &origin)
    {
      const dealii::BoundingBox<3> box(mixed.vertices);
      const auto &[low, high] = box.get_boundary_points();
      std::ostringstream text;
      text << origin << " has vertices between z = " << low[2] << " m and "
           << high[2] << " m, but 'Dimension' is 2; lay the mesh into the "
           << "x-y plane, or set 'Dimension' to 3.";
      AssertThrow(high[2] - low[2] <= flatness * low.distance(high),
                  InputError(text.str()));
    }

    void
    check_coordinates(const MixedMesh &mixed, const std::string &origin)
    {
      for (const Point<3> &vertex : mixed.vertices)
        for (unsigned int d = 0; d < 3; ++d)
          if (!(std::abs(vertex[d]) <= largest_coordinate))
            {
              std::ostringstream text;
              text << origin << " has a vertex at (" << vertex
                   << ") m; coordinates must be numbers of at most 1e9 m, "
                      "correct it.";
              AssertThrow(false, InputError(text.str()));
            }
    }

    /** How many cells cut_mesh() makes at most. */
    double
    n_pieces(const MixedMesh &mixed, const unsigned int dim)
    {
      double n     = 0.;
      bool is_pure = true;
      for (const MixedMesh::Element &cell : mixed.cells)
        {
          n += cell.vertices.size();
          is_pure = is_pure && cell.vertices.size() == (1u << dim);
        }
      return is_pure ? mixed.cells.size() : n;
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  read_mesh(const Scene<dim> &scene)
  {
    const std::string path = find_file(scene.file, scene.domain.file);
    const std::string origin =
      "The mesh file '" + scene.domain.file + "' of the entry 'Domain/File'";
    AssertThrow(!path.empty(),
                InputError(origin + " does not exist or cannot be read; give a "
                                    "path relative to the scene file."));
    const std::string extension = std::filesystem::path(path).extension();
    AssertThrow(extension == ".msh" || extension == ".inp" ||
                  extension == ".vtk" || extension == ".ucd",
                InputError(origin + " has the extension '" + extension +
                           "'; convert it to one of .msh (Gmsh), .inp "
                           "(Abaqus), .vtk (legacy VTK), .ucd (AVS UCD)."));
    MixedMesh mixed;
    const std::string reason =
      reason_of_failure([&]() { mixed = read_file<dim>(path, extension); });
    AssertThrow(reason.empty(),
                InputError(origin + " cannot be understood (" + reason +
                           "); write it again, for example as Gmsh .msh."));
    AssertThrow(!mixed.cells.empty(),
                InputError(origin + " has no cells of dimension " +
                           std::to_string(dim) +
                           "; check the entry 'Dimension' and whether the "
                           "cells were written to the file."));
    check_coordinates(mixed, origin);
    if (dim == 2)
      check_flat(mixed, origin);
    require_size<dim>(n_pieces(mixed, dim),
                      scene.joints.size(),
                      "the mesh file '" + scene.domain.file + "'",
                      [](double) { return "mesh with larger cells"; });
    std::vector<Surface<dim>> surfaces = mark_groups(mixed, scene, origin);
    Mesh<dim> mesh =
      cut_mesh<dim>(mixed,
                    origin,
                    "repair it in the program that made the mesh");
    mesh.surfaces = std::move(surfaces);
    return mesh;
  }

  template Mesh<2> read_mesh(const Scene<2> &);
  template Mesh<3> read_mesh(const Scene<3> &);
} // namespace Keyblock

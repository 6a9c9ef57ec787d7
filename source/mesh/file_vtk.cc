// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes from AVS UCD and legacy VTK files.
#include <keyblock/mesh/file_formats.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** Nodes of an element, at most: those of a hexahedron of second order. */
    constexpr unsigned int most_corners = 27;


    /** Connectivity of a legacy VTK file: `n v v v ...` for each element, or
     * since version 5 offsets and then all vertices. */
    std::vector<std::vector<unsigned int>>
    read_vtk_connectivity(std::istream &in)
    {
      unsigned int n_elements      = next_count(in, "element count");
      const unsigned int n_numbers = next_count(in, "list length");
      std::vector<std::vector<unsigned int>> elements;
      in >> std::ws;
      if (in.peek() != 'O')
        {
          elements.resize(n_elements);
          for (auto &element : elements)
            {
              const auto n = next<unsigned int>(in, "corner count");
              if (n > most_corners)
                throw std::runtime_error("a cell of " + std::to_string(n) +
                                         " corners");
              element.resize(n);
              for (unsigned int &vertex : element)
                vertex = next<unsigned int>(in, "vertex");
            }
          return elements;
        }
      next<std::string>(in, "OFFSETS");
      next<std::string>(in, "type");
      std::vector<unsigned int> offsets(n_elements);
      for (unsigned int &offset : offsets)
        offset = next<unsigned int>(in, "offset");
      next<std::string>(in, "CONNECTIVITY");
      next<std::string>(in, "type");
      for (unsigned int e = 0; e + 1 < n_elements; ++e)
        {
          elements.emplace_back();
          if (offsets[e + 1] - offsets[e] > most_corners)
            throw std::runtime_error("offsets that do not rise by the number "
                                     "of corners of a cell");
          for (unsigned int i = offsets[e]; i < offsets[e + 1]; ++i)
            elements.back().push_back(next<unsigned int>(in, "vertex"));
        }
      if (!offsets.empty() && offsets.back() != n_numbers)
        throw std::runtime_error("the offsets do not end at the list's length");
      return elements;
    }

    /** Material numbers of the elements: the first array among the cell data
     * that has a name used for them; zeros if there is none. */
    std::vector<unsigned int>
    read_vtk_ids(std::istream &in, const std::size_t n_elements)
    {
      std::vector<unsigned int> ids(n_elements, 0);
      std::string word, before;
      bool is_cell_data = false;
      for (; in >> word; before = word)
        {
          is_cell_data =
            (is_cell_data || word == "CELL_DATA") && word != "POINT_DATA";
          if (!is_cell_data ||
              (word != "MaterialID" && word != "CellEntityIds" &&
               word != "gmsh:physical"))
            continue;
          // SCALARS name type [1] LOOKUP_TABLE table, or name 1 n type
          if (before == "SCALARS")
            {
              while (next<std::string>(in, "LOOKUP_TABLE") != "LOOKUP_TABLE")
                {}
              next<std::string>(in, "name of a lookup table");
            }
          else
            for (unsigned int i = 0; i < 3; ++i)
              next<std::string>(in, "array header");
          for (unsigned int &id : ids)
            id = std::clamp(next<double>(in, "material number"), 0., 4e9);
          break;
        }
      return ids;
    }
  } // namespace



  MixedMesh
  read_ucd(std::istream &in, const unsigned int dim)
  {
    struct Shape
    {
      unsigned int dimension, n_corners;
    };
    const std::map<std::string, Shape> shapes = {{"pt", {0, 1}},
                                                 {"line", {1, 2}},
                                                 {"tri", {2, 3}},
                                                 {"quad", {2, 4}},
                                                 {"tet", {3, 4}},
                                                 {"pyr", {3, 5}},
                                                 {"prism", {3, 6}},
                                                 {"hex", {3, 8}}};
    while ((in >> std::ws).peek() == '#')
      in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    const unsigned int n_vertices = next_count(in, "vertex count");
    const unsigned int n_elements = next_count(in, "element count");
    for (unsigned int i = 0; i < 3; ++i)
      next<int>(in, "data count");

    MixedMesh mixed;
    std::map<int, unsigned int> vertex_of_number;
    for (unsigned int v = 0; v < n_vertices; ++v)
      {
        vertex_of_number[next<int>(in, "vertex number")] = v;
        Point<3> x;
        for (unsigned int d = 0; d < 3; ++d)
          x[d] = next<double>(in, "coordinate");
        mixed.vertices.push_back(x);
      }
    for (unsigned int e = 0; e < n_elements; ++e)
      {
        next<int>(in, "element number");
        MixedMesh::Element element;
        element.id       = next<unsigned int>(in, "material number");
        const auto name  = next<std::string>(in, "element type");
        const auto shape = shapes.find(name);
        if (shape == shapes.end())
          throw std::runtime_error("the element type '" + name +
                                   "' is unknown");
        for (unsigned int i = 0; i < shape->second.n_corners; ++i)
          {
            const auto vertex =
              vertex_of_number.find(next<int>(in, "vertex number"));
            element.vertices.push_back(
              vertex == vertex_of_number.end() ? none : vertex->second);
          }
        add_element(mixed, element, shape->second.dimension, dim);
      }
    return mixed;
  }



  MixedMesh
  read_vtk(std::istream &in, const unsigned int dim)
  {
    // VTK's number of the shape; quadratic ones are not among them
    const std::map<unsigned int, unsigned int> dimensions = {
      {1, 0}, {3, 1}, {5, 2}, {9, 2}, {10, 3}, {12, 3}, {13, 3}, {14, 3}};
    std::string version, title, format;
    std::getline(in, version);
    std::getline(in, title);
    std::getline(in, format);
    if (format.rfind("ASCII", 0) != 0)
      throw std::runtime_error("it is not a legacy VTK file in ASCII");

    MixedMesh mixed;
    std::vector<std::vector<unsigned int>> elements;
    std::string word;
    while (in >> word && word != "CELL_TYPES")
      if (word == "POINTS")
        {
          mixed.vertices.resize(next_count(in, "point count"));
          next<std::string>(in, "type of coordinates");
          for (Point<3> &vertex : mixed.vertices)
            for (unsigned int d = 0; d < 3; ++d)
              vertex[d] = next<double>(in, "coordinate");
        }
      else if (word == "CELLS")
        elements = read_vtk_connectivity(in);
    if (next<std::size_t>(in, "CELL_TYPES section") != elements.size())
      throw std::runtime_error("CELLS and CELL_TYPES differ in number");
    std::vector<unsigned int> types;
    for (std::size_t e = 0; e < elements.size(); ++e)
      types.push_back(next<unsigned int>(in, "cell type"));
    const auto ids = read_vtk_ids(in, elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e)
      {
        const auto dimension = dimensions.find(types[e]);
        if (dimension == dimensions.end())
          throw std::runtime_error("the VTK cell type " +
                                   std::to_string(types[e]) +
                                   " is not a linear cell");
        add_element(mixed, {elements[e], ids[e]}, dimension->second, dim);
      }
    return mixed;
  }
} // namespace Keyblock

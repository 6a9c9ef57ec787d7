// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh from a file: .msh read by Gmsh; .inp, .vtk and .ucd read here.
#include <keyblock/base/errors.h>
#include <keyblock/mesh/cut.h>
#include <keyblock/mesh/gmsh_file.h>
#include <keyblock/mesh/size_limit.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** Variation of z in a 2D mesh, relative to its size, that is still taken
     * for round-off [-]. */
    constexpr double flatness = 1e-8;

    /** More than any model is wide [m]; squares and products stay finite. */
    constexpr double largest_coordinate = 1e9;

    /** Nodes of an element, at most: those of a hexahedron of second order. */
    constexpr unsigned int most_corners = 27;

    /** Elements that one line of a file may name; more would not fit into
     * 32-bit numbers of corners. */
    constexpr unsigned long most_members = 1ul << 28;

    /** The next number or word. Throws std::runtime_error at the end. */
    template <typename Value>
    Value
    next(std::istream &in, const std::string &what)
    {
      Value value;
      if (!(in >> value))
        throw std::runtime_error("no " + what + " where one is expected");
      return value;
    }

    /** The same for how many items follow, each of at least a digit and a
     * blank: more than the rest of the file can hold is not allocated. */
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

    /** A word as a number. Throws std::runtime_error if it is none. */
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

    /** Put an element among the cells or the faces, or drop it. */
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

    /** AVS UCD: ids are the material numbers of the elements. */
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

    /** Legacy VTK of unstructured grids in ASCII. */
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

    /** The words between the commas of a line, in capitals, without blanks. */
    std::vector<std::string>
    split_abaqus_line(const std::string &line)
    {
      std::vector<std::string> words;
      std::istringstream in(line);
      for (std::string word; std::getline(in, word, ',');)
        {
          const auto is_blank = [](unsigned char c) { return std::isspace(c); };
          word.erase(std::remove_if(word.begin(), word.end(), is_blank),
                     word.end());
          std::transform(word.begin(), word.end(), word.begin(), ::toupper);
          words.push_back(word);
        }
      while (!words.empty() && words.back().empty())
        words.pop_back();
      return words;
    }

    /** The value of NAME=value among the words of a keyword line, or "". */
    std::string
    abaqus_parameter(const std::vector<std::string> &words,
                     const std::string &name)
    {
      for (const std::string &word : words)
        if (word.rfind(name + "=", 0) == 0)
          return word.substr(name.size() + 1);
      return "";
    }

    /** The number at the end of a set's name, as in EB5; 0 without one. */
    unsigned int
    number_of_set(const std::string &name)
    {
      const auto digits = name.find_last_not_of("0123456789") + 1;
      return digits == name.size() ? 0 : whole_number(name.substr(digits));
    }

    /** Dimension of an element type: C3D8 is a solid, T3D2 and B21 are lines,
     * the others (CPS4, CPE3, S4R, ...) surfaces. */
    unsigned int
    abaqus_dimension(const std::string &type)
    {
      if (type.rfind("C3D", 0) == 0)
        return 3;
      return type.rfind('T', 0) == 0 || type.rfind('B', 0) == 0 ? 1 : 2;
    }

    /** Number of corners of an element, which come first among its nodes. */
    unsigned int
    n_abaqus_corners(const unsigned int dimension, const unsigned int n_nodes)
    {
      if (dimension == 1)
        return 2;
      if (dimension == 2)
        return (n_nodes == 3 || n_nodes == 6) ? 3 : 4;
      const std::map<unsigned int, unsigned int> corners = {
        {10, 4}, {13, 5}, {15, 6}, {20, 8}, {27, 8}};
      const auto found = corners.find(n_nodes);
      return found == corners.end() ? n_nodes : found->second;
    }

    /** The elements that a line below *ELSET names. */
    std::vector<unsigned long>
    members_of_set(const std::vector<std::string> &words,
                   const bool is_generated)
    {
      std::vector<unsigned long> numbers;
      for (const std::string &word : words)
        if (word.find_first_not_of("0123456789") == std::string::npos)
          numbers.push_back(whole_number(word));
      if (is_generated && numbers.size() >= 2)
        {
          const unsigned long last = numbers[1];
          const unsigned long step =
            numbers.size() > 2 ? std::max(numbers[2], 1ul) : 1ul;
          numbers.resize(1);
          if (numbers[0] <= last && (last - numbers[0]) / step > most_members)
            throw std::runtime_error("a set of more than " +
                                     std::to_string(most_members) +
                                     " elements");
          while (numbers.back() + step <= last)
            numbers.push_back(numbers.back() + step);
        }
      return numbers;
    }

    /** An element of an Abaqus file. */
    struct AbaqusElement
    {
      unsigned int dimension;
      MixedMesh::Element element;
    };

    /** Abaqus input. Ids are the numbers at the end of the names of element
     * sets: that of *ELEMENT, or that of the last *ELSET naming the element. */
    MixedMesh
    read_abaqus(std::istream &in, const unsigned int dim)
    {
      MixedMesh mixed;
      std::map<unsigned long, unsigned int> vertex_of_node;
      std::map<unsigned long, AbaqusElement> elements;
      std::vector<std::string> keyword = {""};
      for (std::string line, more; std::getline(in, line);)
        {
          std::vector<std::string> words = split_abaqus_line(line);
          if (words.empty() || words[0].rfind("**", 0) == 0)
            continue;
          if (words[0][0] == '*')
            {
              keyword = words;
              continue;
            }
          const unsigned int id =
            number_of_set(abaqus_parameter(keyword, "ELSET"));
          if (keyword[0] == "*NODE")
            {
              words.resize(4, "0");
              vertex_of_node[whole_number(words[0])] = mixed.vertices.size();
              mixed.vertices.emplace_back(real_number(words[1]),
                                          real_number(words[2]),
                                          real_number(words[3]));
            }
          else if (keyword[0] == "*ELEMENT")
            {
              // a comma at the end: the nodes go on
              while (line.find_last_not_of(" \t\r") == line.rfind(',') &&
                     std::getline(in, more))
                words = split_abaqus_line(line += more);
              const unsigned int dimension =
                abaqus_dimension(abaqus_parameter(keyword, "TYPE"));
              const unsigned int n =
                n_abaqus_corners(dimension, words.size() - 1);
              AbaqusElement &record = elements[whole_number(words[0])];
              record                = {dimension, {{}, id}};
              if (words.size() <= n)
                throw std::runtime_error("element " + words[0] + " has " +
                                         std::to_string(words.size() - 1) +
                                         " nodes where its type has " +
                                         std::to_string(n));
              for (unsigned int i = 1; i <= n; ++i)
                {
                  const auto node = vertex_of_node.find(whole_number(words[i]));
                  if (node == vertex_of_node.end())
                    throw std::runtime_error("element " + words[0] +
                                             " names the node " + words[i] +
                                             ", which is not there");
                  record.element.vertices.push_back(node->second);
                }
            }
          else if (keyword[0] == "*ELSET" && id != 0)
            for (const unsigned long number :
                 members_of_set(words, keyword.back() == "GENERATE"))
              if (const auto found = elements.find(number);
                  found != elements.end())
                found->second.element.id = id;
        }
      for (const auto &[number, record] : elements)
        add_element(mixed, record.element, record.dimension, dim);
      return mixed;
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
      Point<3> low = mixed.vertices.front(), high = low;
      for (const Point<3> &vertex : mixed.vertices)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], vertex[d]);
            high[d] = std::max(high[d], vertex[d]);
          }
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

    /** The path as seen from the scene file if it exists, else as given. */
    std::string
    find_file(const std::string &scene_file, const std::string &file)
    {
      namespace fs = std::filesystem;
      for (const fs::path &path :
           {fs::path(scene_file).parent_path() / file, fs::path(file)})
        if (fs::is_regular_file(path) && std::ifstream(path))
          return path.string();
      AssertThrow(false,
                  InputError("The mesh file '" + file +
                             "' of the entry 'Domain/File' does not exist or "
                             "cannot be read; give a path relative to the "
                             "scene file."));
      return "";
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  read_mesh(const Scene<dim> &scene)
  {
    const std::string path = find_file(scene.file, scene.domain.file);
    const std::string origin =
      "The mesh file '" + scene.domain.file + "' of the entry 'Domain/File'";
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
    return cut_mesh<dim>(mixed,
                         origin,
                         "repair it in the program that made the mesh");
  }

  template Mesh<2> read_mesh(const Scene<2> &);
  template Mesh<3> read_mesh(const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Gmsh's files, read by Gmsh in a process of its own.
#include <gmsh.h>
#include <keyblock/base/child_process.h>
#include <keyblock/mesh/gmsh_file.h>

#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    void
    write_elements(const PipeEnd &pipe,
                   const std::vector<MixedMesh::Element> &elements)
    {
      pipe.write_number(elements.size());
      for (const MixedMesh::Element &element : elements)
        {
          pipe.write_number(element.id);
          pipe.write_list(element.vertices);
        }
    }

    std::vector<MixedMesh::Element>
    read_elements(const PipeEnd &pipe, const std::size_t n_vertices)
    {
      std::vector<MixedMesh::Element> elements(pipe.read_number());
      for (MixedMesh::Element &element : elements)
        {
          element.id       = pipe.read_number();
          element.vertices = pipe.read_list<unsigned int>();
          for (const unsigned int vertex : element.vertices)
            if (vertex >= n_vertices)
              throw std::runtime_error("an element names a vertex that does "
                                       "not exist");
        }
      return elements;
    }

    void
    write_names(const PipeEnd &pipe, const GroupNames &names)
    {
      pipe.write_number(names.size());
      for (const auto &[id, name] : names)
        {
          pipe.write_number(id);
          pipe.write_text(name);
        }
    }

    GroupNames
    read_names(const PipeEnd &pipe)
    {
      GroupNames names;
      for (std::uint64_t n = pipe.read_number(); n > 0; --n)
        {
          const unsigned int id = pipe.read_number();
          names[id]             = pipe.read_text();
        }
      return names;
    }
  } // namespace



  template <int dim>
  MixedMesh
  read_gmsh_file(const std::string &path)
  {
    MixedMesh mixed;
    in_child_process(
      [&]() {
        const GmshSession session;
        gmsh::open(path);
        mixed = read_gmsh_model<dim>();
      },
      [&](const PipeEnd &pipe) {
        pipe.write_list(mixed.vertices);
        write_elements(pipe, mixed.cells);
        write_elements(pipe, mixed.faces);
        write_names(pipe, mixed.cell_names);
        write_names(pipe, mixed.face_names);
      },
      [&](const PipeEnd &pipe) {
        mixed.vertices   = pipe.read_list<Point<3>>();
        mixed.cells      = read_elements(pipe, mixed.vertices.size());
        mixed.faces      = read_elements(pipe, mixed.vertices.size());
        mixed.cell_names = read_names(pipe);
        mixed.face_names = read_names(pipe);
      });
    return mixed;
  }

  template MixedMesh read_gmsh_file<2>(const std::string &);
  template MixedMesh read_gmsh_file<3>(const std::string &);
} // namespace Keyblock

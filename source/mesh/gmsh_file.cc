// SPDX-License-Identifier: LGPL-2.1-or-later
// Gmsh's files, read by Gmsh in a process of its own.
#include <gmsh.h>
#include <keyblock/mesh/gmsh_file.h>

#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** Their ids, how many vertices each has, and these in one list. */
    void
    write_elements(const PipeEnd &pipe,
                   const std::vector<MixedMesh::Element> &elements)
    {
      std::vector<unsigned int> ids, sizes, vertices;
      for (const MixedMesh::Element &element : elements)
        {
          ids.push_back(element.id);
          sizes.push_back(element.vertices.size());
          vertices.insert(vertices.end(),
                          element.vertices.begin(),
                          element.vertices.end());
        }
      for (const auto *list : {&ids, &sizes, &vertices})
        pipe.write_list(*list);
    }

    std::vector<MixedMesh::Element>
    read_elements(const PipeEnd &pipe, const std::size_t n_vertices)
    {
      const auto ids      = pipe.read_list<unsigned int>(),
                 sizes    = pipe.read_list<unsigned int>(),
                 vertices = pipe.read_list<unsigned int>();
      std::vector<MixedMesh::Element> elements(ids.size());
      auto next = vertices.begin();
      for (unsigned int i = 0; i < elements.size(); ++i)
        {
          elements[i] = {{next, next + sizes[i]}, ids[i]};
          next += sizes[i];
          for (const unsigned int vertex : elements[i].vertices)
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



  void
  write_mixed_mesh(const PipeEnd &pipe, const MixedMesh &mixed)
  {
    pipe.write_list(mixed.vertices);
    for (const auto *elements :
         {&mixed.cells, &mixed.faces, &mixed.marked_faces})
      write_elements(pipe, *elements);
    write_names(pipe, mixed.cell_names);
    write_names(pipe, mixed.face_names);
  }



  MixedMesh
  read_mixed_mesh(const PipeEnd &pipe)
  {
    MixedMesh mixed;
    mixed.vertices = pipe.read_list<Point<3>>();
    for (auto *elements : {&mixed.cells, &mixed.faces, &mixed.marked_faces})
      *elements = read_elements(pipe, mixed.vertices.size());
    mixed.cell_names = read_names(pipe);
    mixed.face_names = read_names(pipe);
    return mixed;
  }



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
      [&](const PipeEnd &pipe) { write_mixed_mesh(pipe, mixed); },
      [&](const PipeEnd &pipe) { mixed = read_mixed_mesh(pipe); });
    return mixed;
  }

  template MixedMesh read_gmsh_file<2>(const std::string &);
  template MixedMesh read_gmsh_file<3>(const std::string &);
} // namespace Keyblock

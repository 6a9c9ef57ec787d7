// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/face_marks.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  namespace
  {
    template <int dim, typename Face>
    typename Mesh<dim>::FaceVertices
    vertices_of(const Face &face)
    {
      typename Mesh<dim>::FaceVertices vertices;
      for (const unsigned int v : face->vertex_indices())
        vertices[v] = face->vertex_index(v);
      return vertices;
    }



    template <typename Vertices>
    Vertices
    sorted(Vertices vertices)
    {
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    }
  } // namespace



  template <int dim>
  FaceMarks<dim>::FaceMarks(const dealii::Triangulation<dim> &tree,
                            const Mesh<dim> &coarse)
    : tree(tree)
    , surfaces(coarse.surfaces)
    , list_of_face(tree.n_raw_faces(), 0)
    , marks(1)
  {
    std::map<typename Mesh<dim>::FaceVertices,
             std::vector<const typename Mesh<dim>::MarkedFace *>>
      marked;
    for (const auto &face : coarse.marked_faces)
      marked[sorted(face.vertices)].push_back(&face);
    if (marked.empty())
      return;
    for (const auto &face : tree.active_face_iterators())
      {
        const auto vertices = vertices_of<dim>(face);
        const auto found    = marked.find(sorted(vertices));
        if (found == marked.end())
          continue;
        std::vector<Mark> list;
        for (const auto *mark : found->second)
          list.push_back(
            {mark->surface, !turn_alike<dim>(vertices, mark->vertices)});
        list_of_face[face->index()] = marks.size();
        marks.push_back(list);
      }
  }



  template <int dim>
  void
  FaceMarks<dim>::pass_on()
  {
    list_of_face.resize(tree.n_raw_faces(), 0);
    for (auto face = tree.begin_face(); face != tree.end_face(); ++face)
      if (list_of_face[face->index()] > 0)
        pass_on_to_children(face);
  }



  template <int dim>
  void
  FaceMarks<dim>::pass_on_to_children(const Face &face)
  {
    if (face->has_children())
      for (unsigned int i = 0; i < face->n_children(); ++i)
        {
          list_of_face[face->child_index(i)] = list_of_face[face->index()];
          pass_on_to_children(face->child(i));
        }
  }



  template <int dim>
  bool
  FaceMarks<dim>::is_on_joint(const Face &face) const
  {
    const std::vector<Mark> &list = of(face);
    return std::any_of(list.begin(), list.end(), [&](const Mark &mark) {
      return surfaces[mark.surface].is_joint();
    });
  }



  template <int dim>
  std::vector<bool>
  FaceMarks<dim>::find_crossings() const
  {
    std::vector<bool> is_crossing(tree.n_raw_lines(), false);
    if constexpr (dim == 3)
      {
        std::vector<unsigned int> first(tree.n_raw_lines(), none);
        for (const auto &face : tree.active_face_iterators())
          for (const Mark &mark : of(face))
            if (surfaces[mark.surface].is_joint())
              for (unsigned int l = 0; l < face->n_lines(); ++l)
                {
                  const unsigned int line = face->line_index(l);
                  is_crossing[line] =
                    is_crossing[line] ||
                    (first[line] != none && first[line] != mark.surface);
                  first[line] = mark.surface;
                }
      }
    return is_crossing;
  }



  template <int dim>
  std::vector<typename Mesh<dim>::MarkedFace>
  FaceMarks<dim>::list() const
  {
    std::vector<typename Mesh<dim>::MarkedFace> faces;
    for (const auto &face : tree.active_face_iterators())
      for (const Mark &mark : of(face))
        {
          auto vertices = vertices_of<dim>(face);
          if (mark.is_turned)
            std::swap(vertices[dim - 2], vertices[dim - 1]);
          faces.push_back({vertices, mark.surface});
        }
    return faces;
  }



  template class FaceMarks<2>;
  template class FaceMarks<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells that lie on top of each other.
#include <keyblock/base/errors.h>
#include <keyblock/mesh/side_check.h>

#include <algorithm>
#include <sstream>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    /** A face as one of its cells sees it. */
    template <int dim>
    struct Side
    {
      typename Mesh<dim>::FaceVertices sorted_vertices;
      bool is_right_handed;
      unsigned int cell;
    };

    /** Whether the vertices of a face, from the smallest to the smaller of its
     * neighbours, turn clockwise around the normal that points out of the cell
     * (in 2D: whether they are passed clockwise). Cells on the two sides of a
     * face answer differently. */
    template <int dim>
    Side<dim>
    side_of_face(const Mesh<dim> &mesh,
                 const unsigned int c,
                 const unsigned int face)
    {
      auto vertices = mesh.face_vertices(c, face);
      const bool is_outward =
        (dim == 2) ? (face == 1 || face == 2) : (face % 2 == 1);
      bool is_ascending = vertices[0] < vertices[1];
      if (dim == 3)
        {
          std::swap(vertices[2], vertices.back());
          const unsigned int i =
            std::min_element(vertices.begin(), vertices.end()) -
            vertices.begin();
          is_ascending = vertices[(i + 1) % 4] < vertices[(i + 3) % 4];
        }
      std::sort(vertices.begin(), vertices.end());
      return {vertices, is_ascending == is_outward, c};
    }
  } // namespace



  template <int dim>
  void
  check_sides(const Mesh<dim> &mesh,
              const std::string &origin,
              const std::string &remedy)
  {
    std::vector<Side<dim>> sides;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int face = 0; face < Mesh<dim>::n_cell_faces; ++face)
        sides.push_back(side_of_face(mesh, c, face));
    std::sort(sides.begin(), sides.end(), [](const auto &a, const auto &b) {
      return std::tie(a.sorted_vertices, a.is_right_handed) <
             std::tie(b.sorted_vertices, b.is_right_handed);
    });
    const auto twice =
      std::adjacent_find(sides.begin(),
                         sides.end(),
                         [](const auto &a, const auto &b) {
                           return a.sorted_vertices == b.sorted_vertices &&
                                  a.is_right_handed == b.is_right_handed;
                         });
    if (twice == sides.end())
      return;
    std::ostringstream text;
    text << origin << " has two cells on the same side of a face, at ("
         << mesh.cell_center(twice->cell) << ") and ("
         << mesh.cell_center((twice + 1)->cell) << ") m; " << remedy << ".";
    AssertThrow(false, InputError(text.str()));
  }

  template void
  check_sides(const Mesh<2> &, const std::string &, const std::string &);
  template void
  check_sides(const Mesh<3> &, const std::string &, const std::string &);
} // namespace Keyblock

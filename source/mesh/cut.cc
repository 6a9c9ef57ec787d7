// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells of any shape, cut into quadrilaterals and hexahedra.
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <keyblock/base/errors.h>
#include <keyblock/mesh/cut.h>
#include <keyblock/mesh/side_check.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    using Corners = std::vector<unsigned int>;

    /** Below this a cell counts as flat or folded [-]. */
    constexpr double least_scaled_jacobian = 1e-8;

    /** Corners of each facet (2D: edge, 3D: face) of a cell, by the number of
     * its corners; empty for a shape that cannot be cut. */
    template <int dim>
    const std::vector<Corners> &
    facets_of_shape(const unsigned int n_corners)
    {
      static const std::map<unsigned int, std::vector<Corners>> facets =
        (dim == 2)
          ? std::map<unsigned int,
                     std::vector<Corners>>{{3, {{0, 1}, {1, 2}, {2, 0}}},
                                           {4,
                                            {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}}
          : std::map<unsigned int, std::vector<Corners>>{
              {4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}},
              {6,
               {{0, 1, 2},
                {3, 4, 5},
                {0, 1, 4, 3},
                {1, 2, 5, 4},
                {2, 0, 3, 5}}},
              {8,
               {{0, 1, 2, 3},
                {4, 5, 6, 7},
                {0, 1, 5, 4},
                {1, 2, 6, 5},
                {2, 3, 7, 6},
                {3, 0, 4, 7}}}};
      static const std::vector<Corners> unknown;
      const auto found = facets.find(n_corners);
      return found == facets.end() ? unknown : found->second;
    }

    Corners
    sorted(Corners corners)
    {
      std::sort(corners.begin(), corners.end());
      return corners;
    }

    /** Facets of a cell as vertices of the mesh, sorted. */
    template <int dim>
    std::vector<Corners>
    sorted_facets(const Corners &cell)
    {
      std::vector<Corners> facets = facets_of_shape<dim>(cell.size());
      for (Corners &facet : facets)
        {
          for (unsigned int &corner : facet)
            corner = cell[corner];
          std::sort(facet.begin(), facet.end());
        }
      return facets;
    }

    template <int dim>
    std::map<Corners, unsigned int>
    count_cells_at_facets(const MixedMesh &mixed)
    {
      std::map<Corners, unsigned int> n_cells;
      for (const MixedMesh::Element &cell : mixed.cells)
        for (const Corners &facet : sorted_facets<dim>(cell.vertices))
          ++n_cells[facet];
      return n_cells;
    }

    /** Those faces of @p mixed that are facets of exactly one cell. */
    template <int dim>
    std::vector<MixedMesh::Element>
    outer_faces(const MixedMesh &mixed)
    {
      std::vector<MixedMesh::Element> result;
      if (mixed.faces.empty())
        return result;
      std::map<Corners, unsigned int> n_cells =
        count_cells_at_facets<dim>(mixed);
      for (const MixedMesh::Element &face : mixed.faces)
        {
          const auto found = n_cells.find(sorted(face.vertices));
          if (found == n_cells.end() || found->second != 1)
            continue;
          result.push_back(face);
          // (of several groups that a face is in the first counts)
          n_cells.erase(found);
        }
      return result;
    }

    /** Cuts cells and faces; new vertices are known by the corners whose
     * centre they are, so that neighbours share them. */
    template <int dim>
    class Cutter
    {
    public:
      explicit Cutter(Mesh<dim> &mesh)
        : mesh(mesh)
      {}

      void
      cut_cell(const MixedMesh::Element &cell)
      {
        const std::vector<Corners> facets = sorted_facets<dim>(cell.vertices);
        for (const unsigned int corner : cell.vertices)
          {
            std::vector<Corners> here;
            for (const Corners &facet : facets)
              if (std::binary_search(facet.begin(), facet.end(), corner))
                here.push_back(facet);
            AssertDimension(here.size(), dim);
            typename Mesh<dim>::CellVertices piece;
            piece.front() = corner;
            piece.back()  = center_of(sorted(cell.vertices));
            if (dim == 2)
              {
                piece[1] = center_of(here[0]);
                piece[2] = center_of(here[1]);
              }
            else
              {
                piece[1] = center_of(common(here[0], here[1]));
                piece[2] = center_of(common(here[0], here[2]));
                piece[3] = center_of(here[0]);
                piece[4] = center_of(common(here[1], here[2]));
                piece[5] = center_of(here[1]);
                piece[6] = center_of(here[2]);
              }
            mesh.cells.push_back(piece);
            mesh.region.push_back(cell.id);
          }
      }

      /** The pieces of a face, turning around its normal as the face does. */
      std::vector<typename Mesh<dim>::FaceVertices>
      cut_face(const Corners &corners)
      {
        std::vector<typename Mesh<dim>::FaceVertices> pieces;
        const unsigned int n = corners.size();
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int before = corners[(i + n - 1) % n];
            const unsigned int after  = corners[(i + 1) % n];
            typename Mesh<dim>::FaceVertices piece;
            piece.front() = corners[i];
            piece.back()  = center_of(sorted(corners));
            if (dim == 3)
              {
                piece[1] = center_of(sorted({corners[i], after}));
                piece[2] = center_of(sorted({corners[i], before}));
              }
            else if (i == 1)
              std::swap(piece.front(), piece.back());
            pieces.push_back(piece);
          }
        return pieces;
      }

    private:
      static Corners
      common(const Corners &a, const Corners &b)
      {
        Corners result;
        std::set_intersection(
          a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
        return result;
      }

      unsigned int
      center_of(const Corners &corners)
      {
        const auto [entry, is_new] =
          centers.try_emplace(corners, mesh.vertices.size());
        if (is_new)
          {
            Point<dim> center;
            for (const unsigned int corner : corners)
              center += mesh.vertices[corner] / double(corners.size());
            mesh.vertices.push_back(center);
          }
        return entry->second;
      }

      Mesh<dim> &mesh;
      std::map<Corners, unsigned int> centers;
    };

    /** Corners of a quadrilateral, hexahedron or line in deal.II's order. */
    template <std::size_t n>
    std::array<unsigned int, n>
    in_lexicographic_order(const Corners &corners)
    {
      std::array<unsigned int, n> result;
      std::copy(corners.begin(), corners.end(), result.begin());
      for (unsigned int i = 2; i + 1 < n; i += 4)
        std::swap(result[i], result[i + 1]);
      return result;
    }

    template <int dim>
    void
    check_shape(const Corners &cell, const std::string &origin)
    {
      AssertThrow(!facets_of_shape<dim>(cell.size()).empty(),
                  InputError(origin + " has a cell with " +
                             std::to_string(cell.size()) +
                             " corners (in 3D, 5 is a pyramid), which cannot "
                             "be cut into " +
                             (dim == 2 ? "quadrilaterals" : "hexahedra") +
                             "; mesh with tetrahedra, wedges and hexahedra (in "
                             "2D triangles and quadrilaterals) only."));
      const Corners corners = sorted(cell);
      const auto twice = std::adjacent_find(corners.begin(), corners.end());
      AssertThrow(twice == corners.end(),
                  InputError(origin +
                             " has a cell that names one of its vertices "
                             "twice; replace collapsed cells by triangles, "
                             "wedges or tetrahedra."));
    }

    /** Mesh::scaled_jacobian, but 0 for a cell with coincident vertices [-]. */
    template <int dim>
    double
    least_jacobian(const Mesh<dim> &mesh, const unsigned int c)
    {
      const auto &cell = mesh.cells[c];
      for (unsigned int i = 0; i < cell.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          if (mesh.vertices[cell[i]] == mesh.vertices[cell[j]])
            return 0.;
      return mesh.scaled_jacobian(c);
    }

    /** Mirror what has the wrong handedness; refuse what is bad either way. */
    template <int dim>
    void
    make_positive(Mesh<dim> &mesh,
                  const std::string &origin,
                  const std::string &remedy)
    {
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          if (least_jacobian(mesh, c) > least_scaled_jacobian)
            continue;
          auto &cell = mesh.cells[c];
          if (dim == 2)
            std::swap(cell[1], cell[2]);
          else
            std::swap_ranges(cell.begin(), cell.begin() + 4, cell.begin() + 4);
          const double quality = least_jacobian(mesh, c);
          std::ostringstream text;
          text << origin << " has a cell at (" << mesh.cell_center(c)
               << ") m that is flat, folded or not convex (scaled Jacobian "
               << quality << "); " << remedy << ".";
          AssertThrow(quality > least_scaled_jacobian, InputError(text.str()));
        }
    }

    /** One refinement of inconsistently ordered quadrilaterals loses area. */
    void
    order_cells(Mesh<2> &mesh)
    {
      std::vector<dealii::CellData<2>> cells(mesh.cells.size());
      for (unsigned int c = 0; c < cells.size(); ++c)
        cells[c].vertices.assign(mesh.cells[c].begin(), mesh.cells[c].end());
      dealii::GridTools::consistently_order_cells(cells);
      for (unsigned int c = 0; c < cells.size(); ++c)
        std::copy(cells[c].vertices.begin(),
                  cells[c].vertices.end(),
                  mesh.cells[c].begin());
    }

    void
    order_cells(Mesh<3> &)
    {}
  } // namespace



  template <int dim>
  std::vector<MixedMesh::Element>
  loose_faces(const MixedMesh &mixed)
  {
    std::vector<MixedMesh::Element> result;
    if (mixed.marked_faces.empty())
      return result;
    const auto n_cells = count_cells_at_facets<dim>(mixed);
    for (const MixedMesh::Element &face : mixed.marked_faces)
      if (n_cells.count(sorted(face.vertices)) == 0)
        result.push_back(face);
    return result;
  }



  template <int dim>
  Mesh<dim>
  cut_mesh(const MixedMesh &mixed,
           const std::string &origin,
           const std::string &remedy)
  {
    Mesh<dim> mesh;
    for (const Point<3> &vertex : mixed.vertices)
      {
        mesh.vertices.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          mesh.vertices.back()[d] = vertex[d];
      }
    bool is_pure = true;
    for (const MixedMesh::Element &cell : mixed.cells)
      {
        check_shape<dim>(cell.vertices, origin);
        is_pure &= (cell.vertices.size() == Mesh<dim>::n_cell_vertices);
      }

    Cutter<dim> cutter(mesh);
    for (const MixedMesh::Element &cell : mixed.cells)
      if (is_pure)
        {
          mesh.cells.push_back(
            in_lexicographic_order<Mesh<dim>::n_cell_vertices>(cell.vertices));
          mesh.region.push_back(cell.id);
        }
      else
        cutter.cut_cell(cell);
    using FaceVertices   = typename Mesh<dim>::FaceVertices;
    const auto pieces_of = [&](const MixedMesh::Element &face) {
      return is_pure ? std::vector<FaceVertices>{in_lexicographic_order<
                         Mesh<dim>::n_face_vertices>(face.vertices)}
                     : cutter.cut_face(face.vertices);
    };
    for (const MixedMesh::Element &face : outer_faces<dim>(mixed))
      for (const FaceVertices &piece : pieces_of(face))
        mesh.boundary_faces.push_back({piece, face.id});
    for (const MixedMesh::Element &face : mixed.marked_faces)
      for (const FaceVertices &piece : pieces_of(face))
        mesh.marked_faces.push_back({piece, face.id});
    make_positive(mesh, origin, remedy);
    check_sides(mesh, origin, remedy);
    order_cells(mesh);
    mesh.region_names      = mixed.cell_names;
    mesh.boundary_id_names = mixed.face_names;
    return mesh;
  }

  template std::vector<MixedMesh::Element> loose_faces<2>(const MixedMesh &);
  template std::vector<MixedMesh::Element> loose_faces<3>(const MixedMesh &);
  template Mesh<2>
  cut_mesh(const MixedMesh &, const std::string &, const std::string &);
  template Mesh<3>
  cut_mesh(const MixedMesh &, const std::string &, const std::string &);
} // namespace Keyblock

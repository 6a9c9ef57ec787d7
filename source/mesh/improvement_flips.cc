// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells are mended by other ones between the same vertices.
#include <keyblock/mesh/improvement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Edges with more cells around them are not removed. */
    constexpr unsigned int most_cells_at_edge = 9;
  } // namespace



  template <int dim>
  bool
  MeshImprovement<dim>::flip_in_2d(const unsigned int cell)
  {
    if constexpr (dim == 2)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int other = mesh.neighbor(cell, i);
          if (other == no_index || mesh.marks.count(mesh.facet(cell, i)) > 0)
            continue;
          const CellVertices &v   = mesh.cells[cell].vertices;
          const unsigned int apex = v[i], a = v[(i + 1) % 3],
                             b  = v[(i + 2) % 3];
          unsigned int opposite = no_index;
          for (const unsigned int w : mesh.cells[other].vertices)
            if (w != a && w != b)
              opposite = w;
          const double before =
            std::min(mesh.quality_of(cell), mesh.quality_of(other));
          const CellVertices first{{apex, a, opposite}},
            second{{apex, opposite, b}};
          if (std::min(mesh.quality(first), mesh.quality(second)) >
              std::max(0., before * gain))
            {
              mesh.remove_cell(cell);
              mesh.remove_cell(other);
              mesh.add_cell(first);
              mesh.add_cell(second);
              return true;
            }
        }
    return false;
  }



  /** The vertices around an inner edge in the sense of rotation that makes
   * (a, b, one, next) positive; empty if it is no inner edge. */
  template <int dim>
  std::vector<unsigned int>
  MeshImprovement<dim>::ring_around(
    const unsigned int a,
    const unsigned int b,
    const std::vector<unsigned int> &cells) const
  {
    std::map<unsigned int, unsigned int> next;
    for (const unsigned int cell : cells)
      {
        std::vector<unsigned int> others;
        for (const unsigned int v : mesh.cells[cell].vertices)
          if (v != a && v != b)
            others.push_back(v);
        const CellVertices &v   = mesh.cells[cell].vertices;
        const unsigned int at_a = std::find(v.begin(), v.end(), a) - v.begin();
        const unsigned int at_b = std::find(v.begin(), v.end(), b) - v.begin();
        // bringing a and b to the front in this order takes so many exchanges
        const bool is_odd = (at_a + at_b + (at_b > at_a ? 1 : 0)) % 2 == 1;
        if (is_odd)
          std::swap(others[0], others[1]);
        next[others[0]] = others[1];
      }
    std::vector<unsigned int> ring = {next.begin()->first};
    while (ring.size() <= cells.size())
      {
        const auto found = next.find(ring.back());
        if (found == next.end())
          return {};
        if (found->second == ring[0])
          break;
        ring.push_back(found->second);
      }
    if (ring.size() != cells.size())
      ring.clear();
    return ring;
  }



  /** Fill the cavity around an edge with cells that do not use it: the best
   * triangulation of the ring, by dynamic programming (Klincsek 1980), each
   * triangle joined with both ends. */
  template <int dim>
  bool
  MeshImprovement<dim>::remove_edge(const unsigned int a, const unsigned int b)
  {
    if constexpr (dim == 3)
      {
        const std::vector<unsigned int> cells = mesh.cells_at_edge(a, b);
        const unsigned int n                  = cells.size();
        if (n < 3 || n > most_cells_at_edge)
          return false;
        double before = 1e300;
        for (const unsigned int cell : cells)
          {
            for (const unsigned int v : mesh.cells[cell].vertices)
              if (v != a && v != b &&
                  mesh.marks.count(mesh.sorted(Facet{{a, b, v}})) > 0)
                return false;
            before = std::min(before, mesh.quality_of(cell));
          }
        const std::vector<unsigned int> ring = ring_around(a, b, cells);
        if (ring.empty())
          return false;

        // best[i][j]: of the polygon ring[i..j], apex[i][j]: its triangle
        std::array<std::array<double, most_cells_at_edge>, most_cells_at_edge>
          best;
        std::array<std::array<unsigned int, most_cells_at_edge>,
                   most_cells_at_edge>
          apex;
        for (unsigned int i = 0; i + 1 < n; ++i)
          best[i][i + 1] = 1e300;
        for (unsigned int length = 2; length < n; ++length)
          for (unsigned int i = 0; i + length < n; ++i)
            {
              const unsigned int j = i + length;
              best[i][j]           = -1e300;
              for (unsigned int k = i + 1; k < j; ++k)
                {
                  double least = std::min(best[i][k], best[k][j]);
                  if (least > best[i][j])
                    least =
                      std::min(least,
                               mesh.quality({{ring[i], ring[k], ring[j], b}},
                                            best[i][j]));
                  if (least > best[i][j])
                    least =
                      std::min(least,
                               mesh.quality({{ring[i], ring[j], ring[k], a}},
                                            best[i][j]));
                  if (least > best[i][j])
                    {
                      best[i][j] = least;
                      apex[i][j] = k;
                    }
                }
            }
        if (best[0][n - 1] <= std::max(0., before * gain))
          return false;

        for (const unsigned int cell : cells)
          mesh.remove_cell(cell);
        std::vector<std::pair<unsigned int, unsigned int>> open = {{0, n - 1}};
        while (!open.empty())
          {
            const auto [i, j] = open.back();
            open.pop_back();
            if (j - i < 2)
              continue;
            const unsigned int k = apex[i][j];
            mesh.add_cell({{ring[i], ring[k], ring[j], b}});
            mesh.add_cell({{ring[i], ring[j], ring[k], a}});
            open.push_back({i, k});
            open.push_back({k, j});
          }
        return true;
      }
    return false;
  }



  /** Two cells become three around a new edge that crosses their facet. */
  template <int dim>
  bool
  MeshImprovement<dim>::exchange_facet(const unsigned int cell)
  {
    if constexpr (dim == 3)
      for (unsigned int i = 0; i < 4; ++i)
        {
          Facet f                  = mesh.facet(cell, i);
          const unsigned int other = mesh.neighbor(cell, i);
          if (other == no_index || mesh.marks.count(f) > 0)
            continue;
          const unsigned int top = mesh.cells[cell].vertices[i];
          unsigned int bottom    = no_index;
          for (const unsigned int v : mesh.cells[other].vertices)
            if (!mesh.has(cell, v))
              bottom = v;
          if (!mesh.cells_at_edge(top, bottom).empty())
            continue;
          if (mesh.volume({{top, bottom, f[0], f[1]}}) < 0.)
            std::swap(f[0], f[1]);
          const double before =
            std::min(mesh.quality_of(cell), mesh.quality_of(other));
          std::array<CellVertices, 3> created;
          double after = 1e300;
          for (unsigned int j = 0; j < 3; ++j)
            {
              created[j] = {{top, bottom, f[j], f[(j + 1) % 3]}};
              after      = std::min(after, mesh.quality(created[j]));
            }
          if (after > std::max(0., before * gain))
            {
              mesh.remove_cell(cell);
              mesh.remove_cell(other);
              for (const CellVertices &vertices : created)
                mesh.add_cell(vertices);
              return true;
            }
        }
    return false;
  }

  template bool MeshImprovement<2>::flip_in_2d(const unsigned int);
  template bool MeshImprovement<3>::flip_in_2d(const unsigned int);
  template bool MeshImprovement<2>::remove_edge(const unsigned int,
                                                const unsigned int);
  template bool MeshImprovement<3>::remove_edge(const unsigned int,
                                                const unsigned int);
  template bool MeshImprovement<2>::exchange_facet(const unsigned int);
  template bool MeshImprovement<3>::exchange_facet(const unsigned int);
} // namespace Keyblock

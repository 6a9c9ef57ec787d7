// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/simplex_mesh.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Sine between planes, below which a second joint locks no direction
     * [-]. */
    constexpr double least_joint_sine = 0.05;

  } // namespace



  template <int dim>
  unsigned int
  SimplexMesh<dim>::add_vertex(const Point<dim> &p, const double size)
  {
    vertices.push_back(p);
    target_size.push_back(size);
    is_fixed.push_back(false);
    bound_to.emplace_back();
    cells_at.emplace_back();
    return vertices.size() - 1;
  }



  template <int dim>
  unsigned int
  SimplexMesh<dim>::add_cell(const CellVertices &cell)
  {
    cells.push_back({cell, true});
    for (const unsigned int v : cell)
      cells_at[v].push_back(cells.size() - 1);
    return cells.size() - 1;
  }



  template <int dim>
  void
  SimplexMesh<dim>::remove_cell(const unsigned int cell)
  {
    cells[cell].is_alive = false;
    for (const unsigned int v : cells[cell].vertices)
      cells_at[v].erase(
        std::find(cells_at[v].begin(), cells_at[v].end(), cell));
  }



  template <int dim>
  bool
  SimplexMesh<dim>::is_bound(const unsigned int vertex,
                             const unsigned int surface) const
  {
    const auto &list = bound_to[vertex];
    return std::find(list.begin(), list.end(), surface) != list.end();
  }



  template <int dim>
  void
  SimplexMesh<dim>::add_mark(const Facet &facet, const Mark &mark)
  {
    auto &list = marks[facet];
    if (std::none_of(list.begin(), list.end(), [&mark](const Mark &other) {
          return other.surface == mark.surface;
        }))
      list.push_back(mark);
    for (const unsigned int v : facet)
      if (!is_bound(v, mark.surface))
        bound_to[v].push_back(mark.surface);
  }



  template <int dim>
  void
  SimplexMesh<dim>::bind_vertices()
  {
    for (auto &list : bound_to)
      list.clear();
    for (const Facet &facet : marked_facets())
      for (const Mark &mark : marks.at(facet))
        for (const unsigned int v : facet)
          if (!is_bound(v, mark.surface))
            bound_to[v].push_back(mark.surface);
  }



  template <int dim>
  typename SimplexMesh<dim>::Facet
  SimplexMesh<dim>::sorted(Facet facet, bool &is_odd)
  {
    is_odd             = false;
    const auto compare = [&](const unsigned int i, const unsigned int j) {
      if (facet[i] > facet[j])
        {
          std::swap(facet[i], facet[j]);
          is_odd = !is_odd;
        }
    };
    compare(0, 1);
    if constexpr (dim == 3)
      {
        compare(1, 2);
        compare(0, 1);
      }
    return facet;
  }



  template <int dim>
  typename SimplexMesh<dim>::Facet
  SimplexMesh<dim>::facet(const unsigned int cell, const unsigned int i) const
  {
    Facet result;
    for (unsigned int j = 0, n = 0; j <= dim; ++j)
      if (j != i)
        result[n++] = cells[cell].vertices[j];
    return sorted(result);
  }



  template <int dim>
  bool
  SimplexMesh<dim>::is_on_positive_side(const unsigned int cell,
                                        const unsigned int i) const
  {
    Facet result;
    for (unsigned int j = 0, n = 0; j <= dim; ++j)
      if (j != i)
        result[n++] = cells[cell].vertices[j];
    bool is_odd;
    sorted(result, is_odd);
    // moving vertex i behind the others takes dim - i exchanges
    return ((dim - i) % 2 == 0) != is_odd;
  }



  template <int dim>
  unsigned int
  SimplexMesh<dim>::neighbor(const unsigned int cell,
                             const unsigned int i) const
  {
    const Facet f = facet(cell, i);
    for (const unsigned int other : cells_at[f[0]])
      if (other != cell && has(other, f[1]) &&
          (dim == 2 || has(other, f[dim - 1])))
        return other;
    return no_index;
  }



  template <int dim>
  std::vector<unsigned int>
  SimplexMesh<dim>::cells_at_edge(const unsigned int a,
                                  const unsigned int b) const
  {
    std::vector<unsigned int> result;
    for (const unsigned int cell : cells_at[a])
      if (has(cell, b))
        result.push_back(cell);
    return result;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  SimplexMesh<dim>::locked_directions(const unsigned int v,
                                      const bool may_leave_joints) const
  {
    std::vector<Tensor<1, dim>> locked;
    for (const bool is_joint : {false, true})
      for (const unsigned int s : bound_to[v])
        if (surfaces[s].is_joint() == is_joint &&
            !(is_joint && may_leave_joints))
          {
            // twice, since the first time may leave little but rounding
            const Tensor<1, dim> n =
              free_part(free_part(surfaces[s].normal_at(vertices[v]), locked),
                        locked);
            if (n.norm() >
                (is_joint ? least_joint_sine : surfaces[s].least_sine()))
              locked.push_back(n / n.norm());
          }
    return locked;
  }



  template <int dim>
  void
  SimplexMesh<dim>::move(const unsigned int vertex, const Point<dim> &place)
  {
    vertices[vertex] = place;
    for (const unsigned int cell : cells_at[vertex])
      cells[cell].quality = unknown;
  }



  template <int dim>
  void
  SimplexMesh<dim>::return_to_circles(const unsigned int vertex)
  {
    for (const unsigned int s : bound_to[vertex])
      if (surfaces[s].radius > 0.)
        move(vertex,
             vertices[vertex] - surfaces[s].distance(vertices[vertex]) *
                                  surfaces[s].normal_at(vertices[vertex]));
  }



  template <int dim>
  void
  SimplexMesh<dim>::rename_marks(const Facet &facet,
                                 const std::vector<Mark> &list,
                                 const unsigned int from,
                                 const unsigned int to)
  {
    Facet renamed = facet;
    std::replace(renamed.begin(), renamed.end(), from, to);
    bool is_odd;
    renamed = sorted(renamed, is_odd);
    for (Mark mark : list)
      {
        mark.plus_is_positive = (mark.plus_is_positive != is_odd);
        add_mark(renamed, mark);
      }
  }



  template <int dim>
  unsigned int
  SimplexMesh<dim>::split_edge(const unsigned int a,
                               const unsigned int b,
                               const Point<dim> &p)
  {
    const unsigned int middle =
      add_vertex(p, 0.5 * (target_size[a] + target_size[b]));
    const auto split_marks = [&](const Facet &facet) {
      const auto found = marks.find(facet);
      if (found == marks.end())
        return;
      const std::vector<Mark> list = found->second;
      marks.erase(found);
      rename_marks(facet, list, b, middle);
      rename_marks(facet, list, a, middle);
    };
    const std::vector<unsigned int> ring = cells_at_edge(a, b);
    if constexpr (dim == 2)
      split_marks(sorted(Facet{{a, b}}));
    else
      for (const unsigned int cell : ring)
        for (const unsigned int v : cells[cell].vertices)
          if (v != a && v != b)
            split_marks(sorted(Facet{{a, b, v}}));
    for (const unsigned int cell : ring)
      {
        CellVertices at_a = cells[cell].vertices, at_b = at_a;
        std::replace(at_a.begin(), at_a.end(), b, middle);
        std::replace(at_b.begin(), at_b.end(), a, middle);
        remove_cell(cell);
        add_cell(at_a);
        add_cell(at_b);
      }
    return middle;
  }



  template <int dim>
  std::vector<typename SimplexMesh<dim>::Facet>
  SimplexMesh<dim>::marked_facets() const
  {
    std::vector<Facet> result;
    result.reserve(marks.size());
    for (const auto &entry : marks)
      result.push_back(entry.first);
    std::sort(result.begin(), result.end());
    return result;
  }



  template <int dim>
  Point<dim>
  SimplexMesh<dim>::center(const Facet &facet) const
  {
    Point<dim> result;
    for (const unsigned int v : facet)
      result += vertices[v] / double(dim);
    return result;
  }



  template <int dim>
  double
  SimplexMesh<dim>::measure(const Facet &facet) const
  {
    const Tensor<1, dim> e = vertices[facet[1]] - vertices[facet[0]];
    if constexpr (dim == 2)
      return e.norm();
    else
      return 0.5 * cross_product_3d(e, vertices[facet[2]] - vertices[facet[0]])
                     .norm();
  }

  template class SimplexMesh<2>;
  template class SimplexMesh<3>;
} // namespace Keyblock

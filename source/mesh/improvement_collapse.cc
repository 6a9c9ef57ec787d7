// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells are mended by joining two vertices.
#include <keyblock/mesh/improvement.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Collapses may lead surfaces of the model astray by rounding alone,
     * over the target size [-]. */
    constexpr double model_bend = 1e-9;

    /** By how much the area of a joint around a vertex on its rim may change if
     * the vertex goes [-]. */
    constexpr double allowed_area_change = 0.1;
  } // namespace



  template <int dim>
  bool
  MeshImprovement<dim>::collapse(const unsigned int gone,
                                 const unsigned int kept)
  {
    if (mesh.is_fixed[gone])
      return false;
    for (const unsigned int s : mesh.bound_to[gone])
      if (!mesh.is_bound(kept, s))
        return false;
    if (!is_better_without(gone, kept) || !keeps_topology(gone, kept) ||
        !keeps_surfaces(gone, kept) || merges_marks(gone, kept))
      return false;
    merge(gone, kept);
    return true;
  }



  template <int dim>
  bool
  MeshImprovement<dim>::is_better_without(const unsigned int gone,
                                          const unsigned int kept) const
  {
    const double before = mesh.least_quality_at(gone);
    bool has_living     = false;
    for (const unsigned int cell : mesh.cells_at[gone])
      if (!mesh.has(cell, kept))
        {
          has_living         = true;
          CellVertices moved = mesh.cells[cell].vertices;
          std::replace(moved.begin(), moved.end(), gone, kept);
          const double bound = std::max(0., before * gain);
          if (mesh.quality(moved, bound) <= bound)
            return false;
        }
    return has_living;
  }



  /** The link condition: what is next to both vertices is next to the edge
   * between them (Dey et al. 1999). */
  template <int dim>
  bool
  MeshImprovement<dim>::keeps_topology(const unsigned int gone,
                                       const unsigned int kept) const
  {
    std::set<unsigned int> around_gone, around_edge;
    for (const unsigned int cell : mesh.cells_at[gone])
      for (const unsigned int v : mesh.cells[cell].vertices)
        {
          around_gone.insert(v);
          if (mesh.has(cell, kept))
            around_edge.insert(v);
        }
    for (const unsigned int cell : mesh.cells_at[kept])
      for (const unsigned int v : mesh.cells[cell].vertices)
        if (around_gone.count(v) > 0 && around_edge.count(v) == 0)
          return false;
    if constexpr (dim == 3)
      {
        using Edge           = std::pair<unsigned int, unsigned int>;
        const auto for_edges = [&](const unsigned int cell,
                                   const unsigned int apex,
                                   const auto &action) {
          for (const unsigned int p : mesh.cells[cell].vertices)
            for (const unsigned int q : mesh.cells[cell].vertices)
              if (p < q && p != apex && q != apex)
                action(Edge(p, q));
        };
        std::set<Edge> edges;
        for (const unsigned int cell : mesh.cells_at[gone])
          if (!mesh.has(cell, kept))
            for_edges(cell, gone, [&](const Edge &e) {
              if (around_edge.count(e.first) > 0 &&
                  around_edge.count(e.second) > 0)
                edges.insert(e);
            });
        for (const unsigned int cell : mesh.cells_at[gone])
          if (mesh.has(cell, kept))
            for_edges(cell, gone, [&](const Edge &e) { edges.erase(e); });
        bool is_shared = false;
        for (const unsigned int cell : mesh.cells_at[kept])
          for_edges(cell, kept, [&](const Edge &e) {
            is_shared |=
              e.first != gone && e.second != gone && edges.count(e) > 0;
          });
        if (is_shared)
          return false;
      }
    return true;
  }



  template <int dim>
  std::vector<std::pair<typename SimplexMesh<dim>::Facet,
                        std::vector<typename SimplexMesh<dim>::Mark>>>
  MeshImprovement<dim>::marks_at(const unsigned int vertex) const
  {
    std::map<Facet, std::vector<Mark>> found;
    if (!mesh.bound_to[vertex].empty())
      for (const unsigned int cell : mesh.cells_at[vertex])
        for (unsigned int i = 0; i <= dim; ++i)
          if (mesh.cells[cell].vertices[i] != vertex)
            {
              const Facet f    = mesh.facet(cell, i);
              const auto entry = mesh.marks.find(f);
              if (entry != mesh.marks.end())
                found.insert(*entry);
            }
    return {found.begin(), found.end()};
  }



  /** Whether each surface of @p gone contains the edge to @p kept, is bent
   * little, and keeps its rim: a vertex on a rim goes along it only. */
  template <int dim>
  bool
  MeshImprovement<dim>::keeps_surfaces(const unsigned int gone,
                                       const unsigned int kept) const
  {
    const Tensor<1, dim> edge = mesh.vertices[kept] - mesh.vertices[gone];
    for (const unsigned int s : mesh.bound_to[gone])
      if (std::abs(mesh.surfaces[s].normal_at(mesh.vertices[gone]) * edge) >
          (mesh.surfaces[s].is_joint() ? allowed_bend : model_bend) *
            mesh.target_size[gone])
        return false;
    // number of facets of each surface at each edge from the vertex that goes
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> n_facets;
    for (const auto &[f, list] : marks_at(gone))
      for (const Mark &mark : list)
        for (const unsigned int v : f)
          if (v != gone)
            ++n_facets[{mark.surface, v}];
    for (const unsigned int s : mesh.bound_to[gone])
      {
        unsigned int n_at_edge = 0, n_ends = 0;
        bool is_rim = false;
        for (const auto &[key, n] : n_facets)
          if (key.first == s)
            {
              ++n_ends;
              if (key.second == kept)
                n_at_edge = n;
              if (dim == 3 && n > 2)
                return false;
              is_rim = is_rim || (dim == 3 && n == 1);
            }
        if (dim == 2 && n_ends != 2) // an end, or more than one line
          return false;
        if (n_at_edge == 0 ||
            (is_rim && (n_at_edge != 1 || !keeps_area(gone, kept, s))))
          return false;
      }
    return true;
  }



  /** Whether the facets of a surface around a vertex cover about the same area
   * after it went to another one on the rim. */
  template <int dim>
  bool
  MeshImprovement<dim>::keeps_area(const unsigned int gone,
                                   const unsigned int kept,
                                   const unsigned int surface) const
  {
    double before = 0., after = 0.;
    for (const auto &[f, list] : marks_at(gone))
      for (const Mark &mark : list)
        if (mark.surface == surface)
          {
            before += mesh.measure(f);
            if (std::find(f.begin(), f.end(), kept) != f.end())
              continue;
            Facet moved = f;
            std::replace(moved.begin(), moved.end(), gone, kept);
            after += mesh.measure(moved);
          }
    return std::abs(after - before) <= allowed_area_change * before;
  }



  /** Whether two marked facets would fall onto each other. */
  template <int dim>
  bool
  MeshImprovement<dim>::merges_marks(const unsigned int gone,
                                     const unsigned int kept) const
  {
    for (const unsigned int cell : mesh.cells_at[gone])
      if (mesh.has(cell, kept))
        {
          unsigned int n_marked = 0;
          for (unsigned int i = 0; i <= dim; ++i)
            if (mesh.cells[cell].vertices[i] == gone ||
                mesh.cells[cell].vertices[i] == kept)
              n_marked += mesh.marks.count(mesh.facet(cell, i));
          if (n_marked == 2)
            return true;
        }
    return false;
  }



  template <int dim>
  void
  MeshImprovement<dim>::merge(const unsigned int gone, const unsigned int kept)
  {
    const auto moved = marks_at(gone);
    for (const auto &entry : moved)
      mesh.marks.erase(entry.first);
    for (const auto &[f, list] : moved)
      if (std::find(f.begin(), f.end(), kept) == f.end())
        mesh.rename_marks(f, list, gone, kept);
    const std::vector<unsigned int> around = mesh.cells_at[gone];
    for (const unsigned int cell : around)
      {
        const bool is_living  = !mesh.has(cell, kept);
        CellVertices vertices = mesh.cells[cell].vertices;
        mesh.remove_cell(cell);
        std::replace(vertices.begin(), vertices.end(), gone, kept);
        if (is_living)
          mesh.add_cell(vertices);
      }
    mesh.bound_to[gone].clear();
  }

  template bool MeshImprovement<2>::collapse(const unsigned int,
                                             const unsigned int);
  template bool MeshImprovement<3>::collapse(const unsigned int,
                                             const unsigned int);
} // namespace Keyblock

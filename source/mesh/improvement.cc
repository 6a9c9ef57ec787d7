// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/improvement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** An operation counts as better if the quality rises by this factor. */
    constexpr double gain = 1.001;

    /** Collapses may lead surfaces of the model astray by rounding alone,
     * over the target size [-]. */
    constexpr double model_bend = 1e-9;

    /** By how much the area of a joint around a vertex on its rim may change if
     * the vertex goes [-]. */
    constexpr double allowed_area_change = 0.1;

    /** Moves that are tried on a vertex, and how long those after the first
     * two (to the middle of its neighbours) are, over the target size [-]. */
    constexpr unsigned int n_moves   = 16;
    constexpr double move_lengths[3] = {0.05, 0.015, 0.15};

    /** A vertex moves at most so far at once, over the target size [-]. */
    constexpr double longest_move = 0.5;

    /** Edges with more cells around them are not removed. */
    constexpr unsigned int most_cells_at_edge = 9;

    /** Vertices of no use to flattening: nearly parallel surfaces meet there
     * (sine), or it is flat already (distance over target size). */
    constexpr double least_sine = 0.15, flat_enough = 1e-9;
  } // namespace



  template <int dim>
  MeshImprovement<dim>::MeshImprovement(SimplexMesh<dim> &mesh,
                                        const double allowed_bend)
    : mesh(mesh)
    , allowed_bend(allowed_bend)
    , bits(1)
  {}



  template <int dim>
  void
  MeshImprovement<dim>::improve(const double wanted_quality,
                                const unsigned int n_passes,
                                const unsigned int first_cell)
  {
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        std::vector<std::pair<double, unsigned int>> bad;
        for (unsigned int c = first_cell; c < mesh.cells.size(); ++c)
          if (mesh.cells[c].is_alive)
            {
              const double quality = mesh.quality(mesh.cells[c].vertices);
              if (quality < wanted_quality)
                bad.emplace_back(quality, c);
            }
        std::sort(bad.begin(), bad.end());
        bool has_changed = false;
        for (const auto &[quality, cell] : bad)
          if (mesh.cells[cell].is_alive &&
              mesh.quality(mesh.cells[cell].vertices) < wanted_quality)
            has_changed |= mend(cell);
        if (!has_changed)
          return;
      }
  }



  template <int dim>
  bool
  MeshImprovement<dim>::mend(const unsigned int cell)
  {
    const CellVertices v = mesh.cells[cell].vertices;
    if constexpr (dim == 2)
      {
        if (flip_in_2d(cell))
          return true;
      }
    else
      {
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (remove_edge(v[i], v[j]))
              return true;
        if (exchange_facet(cell))
          return true;
      }
    std::vector<std::pair<double, std::pair<unsigned int, unsigned int>>> edges;
    for (const unsigned int a : v)
      for (const unsigned int b : v)
        if (a != b)
          edges.push_back(
            {mesh.vertices[a].distance(mesh.vertices[b]), {a, b}});
    std::sort(edges.begin(), edges.end());
    for (const auto &[length, edge] : edges)
      if (collapse(edge.first, edge.second))
        return true;
    bool has_moved = false;
    for (const unsigned int a : v)
      has_moved |= smooth(a);
    return has_moved;
  }



  template <int dim>
  Tensor<1, dim>
  MeshImprovement<dim>::random_direction()
  {
    // in the cube: the longer ones are cut to a length of their own anyway
    Tensor<1, dim> direction;
    for (unsigned int d = 0; d < dim; ++d)
      direction[d] = bits() / 2147483648. - 1.;
    return direction;
  }



  /** Normal of the facet opposite to @p vertex in the worst cell around it,
   * towards the vertex. */
  template <int dim>
  Tensor<1, dim>
  MeshImprovement<dim>::away_from_worst(const unsigned int vertex) const
  {
    unsigned int worst = no_index;
    double least       = 1e300;
    for (const unsigned int cell : mesh.cells_at[vertex])
      {
        const double quality = mesh.quality(mesh.cells[cell].vertices);
        if (quality < least)
          {
            least = quality;
            worst = cell;
          }
      }
    const CellVertices &v = mesh.cells[worst].vertices;
    const unsigned int i  = std::find(v.begin(), v.end(), vertex) - v.begin();
    const Facet f         = mesh.facet(worst, i);
    Tensor<1, dim> normal;
    if constexpr (dim == 2)
      normal = cross_product_2d(mesh.vertices[f[1]] - mesh.vertices[f[0]]);
    else
      normal = cross_product_3d(mesh.vertices[f[1]] - mesh.vertices[f[0]],
                                mesh.vertices[f[2]] - mesh.vertices[f[0]]);
    return normal * (mesh.vertices[vertex] - mesh.center(f)) < 0. ? -normal
                                                                  : normal;
  }



  template <int dim>
  bool
  MeshImprovement<dim>::smooth(const unsigned int vertex)
  {
    if (mesh.is_fixed[vertex])
      return false;
    const auto locked = mesh.locked_directions(vertex, may_leave_joints);
    if (locked.size() >= dim)
      return false;
    Point<dim> mean;
    double weight = 0.;
    for (const unsigned int cell : mesh.cells_at[vertex])
      for (const unsigned int v : mesh.cells[cell].vertices)
        {
          mean += mesh.vertices[v];
          weight += 1.;
        }
    mean /= weight;

    const double size  = mesh.target_size[vertex];
    const double start = mesh.least_quality_at(vertex);
    double best        = start;
    for (unsigned int move = 0; move < n_moves; ++move)
      {
        Tensor<1, dim> direction = move < 2   ? mean - mesh.vertices[vertex]
                                   : move < 5 ? away_from_worst(vertex)
                                              : random_direction();
        direction         = SimplexMesh<dim>::free_part(direction, locked);
        const double norm = direction.norm();
        if (norm < 1e-9 * size)
          continue;
        const double length =
          move < 2 ? norm / (move + 1) : move_lengths[move % 3] * size;
        const Point<dim> before = mesh.vertices[vertex];
        mesh.vertices[vertex] +=
          std::min(length, longest_move * size) / norm * direction;
        mesh.return_to_circles(vertex);
        const double now = mesh.least_quality_at(vertex, best);
        if (now > best && (!may_leave_joints || is_near_its_joints(vertex)))
          best = now;
        else
          mesh.vertices[vertex] = before;
      }
    return best > gain * start;
  }



  template <int dim>
  bool
  MeshImprovement<dim>::is_near_its_joints(const unsigned int vertex) const
  {
    for (const unsigned int s : mesh.bound_to[vertex])
      if (mesh.surfaces[s].is_joint() &&
          std::abs(mesh.surfaces[s].distance(mesh.vertices[vertex])) >
            allowed_bend * mesh.target_size[vertex])
        return false;
    return true;
  }



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
            std::min(mesh.quality(v), mesh.quality(mesh.cells[other].vertices));
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
            before = std::min(before, mesh.quality(mesh.cells[cell].vertices));
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
            std::min(mesh.quality(mesh.cells[cell].vertices),
                     mesh.quality(mesh.cells[other].vertices));
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



  template <int dim>
  void
  MeshImprovement<dim>::improve_by_bending(const double wanted_quality,
                                           const unsigned int n_passes,
                                           const double allowed_bend)
  {
    const double usual = this->allowed_bend;
    this->allowed_bend = allowed_bend;
    may_leave_joints   = true;
    improve(wanted_quality, n_passes);
    may_leave_joints   = false;
    this->allowed_bend = usual;
  }



  template <int dim>
  void
  MeshImprovement<dim>::flatten(const double least_quality)
  {
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      {
        if (mesh.is_fixed[v] || mesh.cells_at[v].empty())
          continue;
        const Point<dim> before = mesh.vertices[v];
        const double size       = mesh.target_size[v];
        const double quality    = mesh.least_quality_at(v);
        for (const double part : {1., 0.5})
          {
            std::vector<Tensor<1, dim>> locked;
            double height = 0.;
            for (const bool is_joint : {false, true})
              for (const unsigned int s : mesh.bound_to[v])
                if (mesh.surfaces[s].is_joint() == is_joint)
                  {
                    const Surface<dim> &surface = mesh.surfaces[s];
                    const double distance = surface.distance(mesh.vertices[v]);
                    const Tensor<1, dim> way = SimplexMesh<dim>::free_part(
                      surface.normal_at(mesh.vertices[v]), locked);
                    if (is_joint)
                      height =
                        std::max(height, std::abs(surface.distance(before)));
                    if (way.norm() < (is_joint ? least_sine : 1e-6))
                      continue;
                    if (is_joint)
                      mesh.vertices[v] -=
                        part * distance / way.norm_square() * way;
                    locked.push_back(way / way.norm());
                  }
            mesh.return_to_circles(v);
            if (height < flat_enough * size ||
                mesh.vertices[v].distance(before) > longest_move * size)
              {
                mesh.vertices[v] = before;
                break;
              }
            if (mesh.least_quality_at(v) >=
                std::min(quality / gain, least_quality))
              break;
            mesh.vertices[v] = before;
          }
      }
  }

  template class MeshImprovement<2>;
  template class MeshImprovement<3>;
} // namespace Keyblock

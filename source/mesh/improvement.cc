// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/improvement.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Moves that are tried on a vertex, and how long those after the first
     * two (to the middle of its neighbours) are, over the target size [-]. */
    constexpr unsigned int n_moves   = 16;
    constexpr double move_lengths[3] = {0.05, 0.015, 0.15};

    /** A vertex moves at most so far at once, over the target size [-]. */
    constexpr double longest_move = 0.5;

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
              const double quality = mesh.quality_of(c);
              if (quality < wanted_quality)
                bad.emplace_back(quality, c);
            }
        std::sort(bad.begin(), bad.end());
        bool has_changed = false;
        for (const auto &[quality, cell] : bad)
          if (mesh.cells[cell].is_alive &&
              mesh.quality_of(cell) < wanted_quality)
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



  /** Normal of the facet of a cell opposite to @p vertex, towards it. */
  template <int dim>
  Tensor<1, dim>
  MeshImprovement<dim>::away_from(const unsigned int cell,
                                  const unsigned int vertex) const
  {
    const CellVertices &v = mesh.cells[cell].vertices;
    const unsigned int i  = std::find(v.begin(), v.end(), vertex) - v.begin();
    const Facet f         = mesh.facet(cell, i);
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
    // moves along chords of a curved surface would add up
    const auto &bound = mesh.bound_to[vertex];
    if (mesh.is_fixed[vertex] ||
        std::any_of(bound.begin(), bound.end(), [this](const unsigned int s) {
          return mesh.surfaces[s].is_curved;
        }))
      return false;
    const bool may_leave =
      !may_leave_joints.empty() && may_leave_joints[vertex];
    const auto locked = mesh.locked_directions(vertex, may_leave);
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
    auto qualities     = mesh.qualities_at(vertex);
    const double start = qualities.front().first;
    for (unsigned int move = 0; move < n_moves; ++move)
      {
        Tensor<1, dim> direction =
          move < 2   ? mean - mesh.vertices[vertex]
          : move < 5 ? away_from(qualities.front().second, vertex)
                     : random_direction();
        direction         = SimplexMesh<dim>::free_part(direction, locked);
        const double norm = direction.norm();
        if (norm < 1e-9 * size)
          continue;
        const double length =
          move < 2 ? norm / (move + 1) : move_lengths[move % 3] * size;
        const Point<dim> before = mesh.vertices[vertex];
        mesh.move(vertex,
                  before +
                    std::min(length, longest_move * size) / norm * direction);
        mesh.return_to_circles(vertex);
        if (auto now = mesh.better_qualities(qualities);
            !now.empty() && (!may_leave || is_near_its_joints(vertex)))
          qualities = std::move(now);
        else
          mesh.move(vertex, before);
      }
    for (const auto &[quality, cell] : qualities)
      mesh.cells[cell].quality = quality;
    return qualities.front().first > gain * start;
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
  void
  MeshImprovement<dim>::improve_by_bending(
    const double wanted_quality,
    const unsigned int n_passes,
    const double allowed_bend,
    const std::vector<unsigned int> &fixed)
  {
    const double usual = this->allowed_bend;
    this->allowed_bend = allowed_bend;
    may_leave_joints.assign(mesh.vertices.size(), true);
    for (const unsigned int v : fixed)
      may_leave_joints[v] = false;
    improve(wanted_quality, n_passes);
    may_leave_joints.clear();
    this->allowed_bend = usual;
  }



  template <int dim>
  void
  MeshImprovement<dim>::flatten(const double least_quality)
  {
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      flatten_at(v, least_quality);
  }



  template <int dim>
  void
  MeshImprovement<dim>::flatten(const double least_quality,
                                const std::vector<unsigned int> &vertices)
  {
    for (const unsigned int v : vertices)
      flatten_at(v, least_quality);
  }



  template <int dim>
  void
  MeshImprovement<dim>::flatten_at(const unsigned int v,
                                   const double least_quality)
  {
    if (mesh.is_fixed[v] || mesh.cells_at[v].empty())
      return;
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
                const double distance    = surface.distance(mesh.vertices[v]);
                const Tensor<1, dim> way = SimplexMesh<dim>::free_part(
                  surface.normal_at(mesh.vertices[v]), locked);
                if (is_joint)
                  height = std::max(height, std::abs(surface.distance(before)));
                if (way.norm() < (is_joint ? least_sine : surface.least_sine()))
                  continue;
                if (is_joint)
                  mesh.move(v,
                            mesh.vertices[v] -
                              part * distance / way.norm_square() * way);
                locked.push_back(way / way.norm());
              }
        mesh.return_to_circles(v);
        if (height < flat_enough * size ||
            mesh.vertices[v].distance(before) > longest_move * size)
          {
            mesh.move(v, before);
            return;
          }
        if (mesh.least_quality_at(v) >= std::min(quality / gain, least_quality))
          return;
        mesh.move(v, before);
      }
  }

  template class MeshImprovement<2>;
  template class MeshImprovement<3>;
} // namespace Keyblock

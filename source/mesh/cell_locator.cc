// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/boost_adaptors/segment.h>

#include <keyblock/mesh/cell_locator.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Keyblock
{
  namespace
  {
    /** How far outside the unit cell a point still counts as inside [-]. */
    constexpr double margin = 1e-7;

    template <int dim>
    using Weights = std::array<double, Mesh<dim>::n_cell_vertices>;

    /** Linear shape functions at @p unit, and their slopes. */
    template <int dim>
    Weights<dim>
    shape_at(const Point<dim> &unit,
             std::array<Tensor<1, dim>, Mesh<dim>::n_cell_vertices> &slope)
    {
      Weights<dim> weight;
      for (unsigned int v = 0; v < weight.size(); ++v)
        {
          weight[v] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            slope[v][d] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const bool is_far = (v >> d) & 1;
              const double one  = is_far ? unit[d] : 1. - unit[d];
              weight[v] *= one;
              for (unsigned int e = 0; e < dim; ++e)
                slope[v][e] *= e == d ? (is_far ? 1. : -1.) : one;
            }
        }
      return weight;
    }

    /** Largest change of a Newton step: from beside a cell a whole one may lead
     * to where its mapping folds over [-]. */
    constexpr double longest_step = 0.5;

    /** Place of @p point in the unit cell by Newton's method; nothing if it is
     * far outside, where the mapping may have no such place. */
    template <int dim>
    std::optional<Point<dim>>
    unit_point(const Mesh<dim> &mesh,
               const unsigned int cell,
               const Point<dim> &point)
    {
      Point<dim> unit;
      for (unsigned int d = 0; d < dim; ++d)
        unit[d] = 0.5;
      // relative to a corner: far from the origin, sums of coordinates would
      // round by more than the method converges to
      const Point<dim> &corner = mesh.vertices[mesh.cells[cell][0]];
      std::array<Tensor<1, dim>, Mesh<dim>::n_cell_vertices> slope;
      for (unsigned int iteration = 0; iteration < 100; ++iteration)
        {
          const Weights<dim> weight = shape_at<dim>(unit, slope);
          Tensor<1, dim> miss       = point - corner;
          dealii::Tensor<2, dim> jacobian;
          for (unsigned int v = 0; v < weight.size(); ++v)
            {
              const Tensor<1, dim> x =
                mesh.vertices[mesh.cells[cell][v]] - corner;
              miss -= weight[v] * x;
              jacobian += outer_product(x, slope[v]);
            }
          const Tensor<1, dim> change = invert(jacobian) * miss;
          unit += std::min(1., longest_step / change.norm()) * change;
          if (change.norm() < 1e-12)
            return unit;
          if (!(unit.norm() < 10.))
            return {};
        }
      return {};
    }

    template <int dim>
    Weights<dim>
    weights_at(const Point<dim> &unit)
    {
      std::array<Tensor<1, dim>, Mesh<dim>::n_cell_vertices> slope;
      return shape_at<dim>(unit, slope);
    }

    /** Shares of the vertices of a cell in @p point; nothing if it is outside.
     */
    template <int dim>
    std::optional<Weights<dim>>
    weights_in(const Mesh<dim> &mesh,
               const unsigned int cell,
               const Point<dim> &point)
    {
      const std::optional<Point<dim>> unit = unit_point(mesh, cell, point);
      if (!unit)
        return {};
      for (unsigned int d = 0; d < dim; ++d)
        if (!((*unit)[d] >= -margin && (*unit)[d] <= 1. + margin))
          return {};
      return weights_at<dim>(*unit);
    }
  } // namespace



  template <int dim>
  CellLocator<dim>::CellLocator(
    const Mesh<dim> &mesh,
    const std::function<bool(unsigned int)> &is_there)
    : mesh(mesh)
  {
    std::vector<Entry> entries;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (is_there(c))
        {
          std::pair<Point<dim>, Point<dim>> corners{
            mesh.vertices[mesh.cells[c][0]], mesh.vertices[mesh.cells[c][0]]};
          for (const unsigned int v : mesh.cells[c])
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double x    = mesh.vertices[v][d];
                corners.first[d]  = std::min(corners.first[d], x);
                corners.second[d] = std::max(corners.second[d], x);
              }
          // the margin, in the size of the cell
          const double more = margin * corners.first.distance(corners.second);
          for (unsigned int d = 0; d < dim; ++d)
            {
              corners.first[d] -= more;
              corners.second[d] += more;
            }
          entries.emplace_back(dealii::BoundingBox<dim>(corners), c);
        }
    tree = dealii::pack_rtree(entries);
  }



  template <int dim>
  std::vector<CellPoint<dim>>
  CellLocator<dim>::find_all(const Point<dim> &point) const
  {
    std::vector<Entry> near;
    tree.query(boost::geometry::index::intersects(point),
               std::back_inserter(near));
    std::sort(near.begin(), near.end(), [](const Entry &a, const Entry &b) {
      return a.second < b.second;
    });
    std::vector<CellPoint<dim>> found;
    for (const Entry &entry : near)
      if (const auto weight = weights_in<dim>(mesh, entry.second, point))
        found.push_back({entry.second, *weight});
    return found;
  }



  template <int dim>
  CellPoint<dim>
  CellLocator<dim>::find(const Point<dim> &point) const
  {
    const std::vector<CellPoint<dim>> found = find_all(point);
    return found.empty() ? CellPoint<dim>() : found.front();
  }



  template <int dim>
  CellPoint<dim>
  CellLocator<dim>::find_in(const unsigned int cell,
                            const Point<dim> &point) const
  {
    if (cell == none)
      return {};
    if (const std::optional<Point<dim>> unit = unit_point(mesh, cell, point))
      return {cell, weights_at<dim>(*unit)};
    // beside a strongly warped face its mapping has no such place
    CellPoint<dim> nearest{cell, {}};
    unsigned int vertex = 0;
    for (unsigned int v = 1; v < nearest.weight.size(); ++v)
      if (mesh.vertices[mesh.cells[cell][v]].distance(point) <
          mesh.vertices[mesh.cells[cell][vertex]].distance(point))
        vertex = v;
    nearest.weight[vertex] = 1.;
    return nearest;
  }



  template <int dim>
  std::vector<unsigned int>
  CellLocator<dim>::list_along(const Point<dim> &a, const Point<dim> &b) const
  {
    std::vector<Entry> near;
    tree.query(boost::geometry::index::intersects(
                 boost::geometry::model::segment<Point<dim>>(a, b)),
               std::back_inserter(near));
    std::vector<unsigned int> cells;
    for (const Entry &entry : near)
      cells.push_back(entry.second);
    std::sort(cells.begin(), cells.end());
    return cells;
  }

  template class CellLocator<2>;
  template class CellLocator<3>;
} // namespace Keyblock

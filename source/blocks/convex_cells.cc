// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>

#include <keyblock/base/errors.h>
#include <keyblock/blocks/cell_cut.h>
#include <keyblock/blocks/convex_cells.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** More than the error of a vertex and of its distance from a plane. */
    constexpr double rounding_of_cells = 1e-12;

  } // namespace



  template <int dim>
  ConvexCells<dim>::ConvexCells(const BoundingBox<dim> &box)
  {
    std::vector<HalfSpace<dim>> sides(2 * dim);
    for (unsigned int s = 0; s < 2 * dim; ++s)
      {
        const auto &[low, high] = box.get_boundary_points();
        sides[s].point          = s % 2 == 0 ? low : high;
        sides[s].outward        = (s % 2 == 0 ? -1. : 1.) *
                           Tensor<1, dim>(Point<dim>::unit_vector(s / 2));
      }
    set_up(box, sides);
  }



  template <int dim>
  ConvexCells<dim>::ConvexCells(const BoundingBox<dim> &box,
                                const std::vector<HalfSpace<dim>> &sides)
  {
    set_up(box, sides);
  }



  template <int dim>
  void
  ConvexCells<dim>::set_up(const BoundingBox<dim> &box,
                           const std::vector<HalfSpace<dim>> &sides)
  {
    // a power of two: scaling does not round
    double half = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      half = std::max(half, 0.5 * box.side_length(d));
    unit_length = std::exp2(std::ceil(std::log2(half)));
    center      = box.center();
    make_box();
    fit_domain(sides);
  }



  /** The first cell is the box [-1, 1]. */
  template <int dim>
  void
  ConvexCells<dim>::make_box()
  {
    for (unsigned int s = 0; s < 2 * dim; ++s)
      {
        const Point<dim> normal =
          (s % 2 == 0 ? -1. : 1.) * Point<dim>::unit_vector(s / 2);
        planes.push_back(make_exact_plane<dim>(normal, normal));
        plane_of_key[planes.back().key()] = s;
      }
    Cell cell;
    for (unsigned int v = 0; v < (1u << dim); ++v)
      {
        std::array<unsigned int, dim> indices;
        for (unsigned int d = 0; d < dim; ++d)
          indices[d] = 2 * d + ((v >> d) & 1);
        cell.vertices.push_back(intersect<dim>(planes, indices));
      }
    for (unsigned int s = 0; s < 2 * dim; ++s)
      {
        const unsigned int size = 1u << (dim - 1), axis = s / 2;
        cell.facets.push_back({s, -1, nothing, nothing, s * size, size});
        // around the normal: two other axes in cyclic order
        const unsigned int u = (axis + 1) % dim, w = (axis + 2) % dim;
        for (unsigned int i = 0; i < size; ++i)
          {
            const unsigned int k = s % 2 == 1 ? i : size - 1 - i;
            unsigned int vertex  = (s % 2) << axis;
            if (dim == 2)
              vertex |= (axis == 0 ? k : 1 - k) << u;
            else
              vertex |= (k == 1 || k == 2) << u | (k >= 2) << w;
            cell.loops.push_back({vertex, nothing});
          }
        for (unsigned int i = 0; i < size && dim == 3; ++i)
          {
            auto &from     = cell.loops[s * size + i];
            const auto &to = cell.loops[s * size + (i + 1) % size];
            // the edge lies on the other plane that both ends share
            for (const unsigned int p : cell.vertices[from.vertex].planes)
              for (const unsigned int q : cell.vertices[to.vertex].planes)
                if (p == q && p != s)
                  from.edge = p;
          }
      }
    fit_box<dim>(cell);
    cells.push_back(cell);
    branch_of_cell.emplace_back(nothing, false);
  }



  template <int dim>
  void
  ConvexCells<dim>::fit_domain(const std::vector<HalfSpace<dim>> &sides)
  {
    const auto refuse = [](const bool holds) {
      if (!holds)
        throw InputError("The sides of the domain do not bound a convex body.");
    };
    for (unsigned int s = 0; s < sides.size(); ++s)
      {
        const PlaneSide outward = add_plane(sides[s].point, sides[s].outward);
        if (outward.plane == nothing)
          {
            refuse(outward.side < 0);
            continue;
          }
        const int is_at = side_of_cell(0, outward.plane);
        refuse(is_at != outward.side);
        if (is_at == 0)
          {
            split(0, outward.plane);
            if (outward.side > 0)
              cells[0] = cells[1];
            cells.resize(1);
            nodes.clear();
            branch_of_cell.assign(1, {nothing, false});
          }
        for (Facet &facet : cells[0].facets)
          if (facet.plane == outward.plane)
            {
              facet.node        = nothing;
              facet.domain_side = s;
            }
      }
    for (const Facet &facet : cells[0].facets)
      refuse(facet.domain_side != nothing);
  }



  template <int dim>
  typename ConvexCells<dim>::PlaneSide
  ConvexCells<dim>::add_plane(const Point<dim> &point,
                              const Tensor<1, dim> &normal,
                              const double near)
  {
    const Point<dim> x  = to_unit(point);
    const double origin = -(normal * x) / normal.norm();
    const int side      = origin > 0. ? 1 : -1;
    if (!(std::abs(origin) < 1.9))
      return {nothing, side};
    const ExactPlane<dim> plane = make_exact_plane<dim>(x, normal);
    if (!plane.meets_box())
      return {nothing, side};
    for (unsigned int i = 0; near > 0. && i < planes.size(); ++i)
      {
        const int way     = planes[i].normal * plane.normal > 0. ? 1 : -1;
        double difference = std::abs(planes[i].offset - way * plane.offset);
        for (unsigned int d = 0; d < dim; ++d)
          difference += std::abs(planes[i].normal[d] - way * plane.normal[d]);
        if (difference * unit_length < near)
          return {i, way};
      }
    const auto [entry, is_new] =
      plane_of_key.try_emplace(plane.key(), planes.size());
    if (is_new)
      planes.push_back(plane);
    return {entry->second,
            planes[entry->second].normal * plane.normal > 0. ? 1 : -1};
  }



  template <int dim>
  int
  ConvexCells<dim>::side_of_cell(const unsigned int cell,
                                 const unsigned int plane)
  {
    const ExactPlane<dim> &p = planes[plane];
    const Cell &c            = cells[cell];
    double reach             = rounding_of_cells;
    for (unsigned int d = 0; d < dim; ++d)
      reach += 0.5 * std::abs(p.normal[d]) * (c.high[d] - c.low[d]);
    const double middle = p.distance(c.low + 0.5 * (c.high - c.low));
    if (std::abs(middle) > reach)
      return middle > 0. ? 1 : -1;
    signs.clear();
    bool is_plus = false, is_minus = false;
    for (const auto &vertex : c.vertices)
      {
        signs.push_back(side_of(planes, vertex, plane));
        is_plus  = is_plus || signs.back() > 0;
        is_minus = is_minus || signs.back() < 0;
      }
    return int(is_plus) - int(is_minus);
  }



  template <int dim>
  unsigned int
  ConvexCells<dim>::cut_cell(const unsigned int cell, const unsigned int plane)
  {
    if (side_of_cell(cell, plane) != 0)
      return nothing;
    split(cell, plane);
    return n_cells() - 1;
  }



  /** Corners of the section of the cell last asked for, several times each and
   * in no order. */
  template <int dim>
  std::vector<Point<dim>>
  ConvexCells<dim>::section(const Cell &cell, const unsigned int plane) const
  {
    std::vector<Point<dim>> points;
    for (unsigned int v = 0; v < cell.vertices.size(); ++v)
      if (signs[v] == 0)
        points.push_back(cell.vertices[v].x);
    for (const Facet &facet : cell.facets)
      for (unsigned int i = 0; i < n_edges<dim>(facet.size); ++i)
        {
          const unsigned int v = cell.loops[facet.begin + i].vertex,
                             w = cell.loops[facet.begin + (i + 1) % facet.size]
                                   .vertex;
          // (two facets share an edge; in 2D it is one of them)
          if (signs[v] * signs[w] >= 0 || (dim == 3 && signs[v] < 0))
            continue;
          const Point<dim> &x = cell.vertices[v].x, &y = cell.vertices[w].x;
          const double a = planes[plane].distance(x),
                       b = planes[plane].distance(y);
          const double t = a != b ? std::clamp(a / (a - b), 0., 1.) : 0.5;
          points.push_back(x + t * (y - x));
        }
    return points;
  }



  template <int dim>
  void
  ConvexCells<dim>::split(const unsigned int index, const unsigned int plane)
  {
    const unsigned int node = nodes.size();
    CellCut<dim> cut(cells[index], planes, signs, plane);
    cut.close(node);
    cells[index] = std::move(cut.parts[1]);
    cells.push_back(std::move(cut.parts[0]));
    const int minus = n_cells() - 1;
    nodes.push_back({plane, ~minus, ~int(index)});
    const auto [parent, is_plus] = branch_of_cell[index];
    if (parent != nothing)
      (is_plus ? nodes[parent].plus : nodes[parent].minus) = node;
    branch_of_cell[index] = {node, true};
    branch_of_cell.emplace_back(node, false);
  }



  template <int dim>
  unsigned int
  ConvexCells<dim>::cell_at(const Point<dim> &point) const
  {
    const Point<dim> x = to_unit(point);
    int branch         = nodes.empty() ? ~0 : 0;
    while (branch >= 0)
      {
        const Node &node = nodes[branch];
        branch = planes[node.plane].distance(x) > 0. ? node.plus : node.minus;
      }
    return ~branch;
  }



  template <int dim>
  typename ConvexCells<dim>::Measures
  ConvexCells<dim>::measures(const unsigned int index) const
  {
    // simplices between a vertex and the facets, by the divergence theorem
    const Cell &c      = cells[index];
    const Point<dim> o = c.vertices[0].x;
    double sum         = 0.;
    Tensor<1, dim> moment;
    for (const Facet &facet : c.facets)
      {
        const auto corner = [&](const unsigned int i) {
          return c.vertices[c.loops[facet.begin + i].vertex].x - o;
        };
        const Tensor<1, dim> a = corner(0);
        for (unsigned int i = dim - 1; i < facet.size; ++i)
          {
            const Tensor<1, dim> b = corner(i);
            double size;
            if constexpr (dim == 2)
              size = a[0] * b[1] - a[1] * b[0];
            else
              {
                size = a * cross_product_3d(corner(i - 1), b);
                moment += size / (dim + 1) * corner(i - 1);
              }
            sum += size;
            moment += size / (dim + 1) * (a + b);
          }
      }
    const double volume = sum / (dim == 2 ? 2 : 6);
    // (of a cell as thin as rounding it is somewhere in the box around it)
    Point<dim> centroid = sum != 0. ? o + moment / sum : o;
    for (unsigned int d = 0; d < dim; ++d)
      centroid[d] = std::clamp(centroid[d], c.low[d], c.high[d]);
    return {std::pow(unit_length, dim) * volume, to_metres(centroid)};
  }



  template <int dim>
  void
  ConvexCells<dim>::get_polygon(const Cell &cell,
                                const Facet &facet,
                                Polygon &polygon) const
  {
    polygon.clear();
    for (unsigned int i = facet.begin; i < facet.begin + facet.size; ++i)
      polygon.push_back(
        {cell.vertices[cell.loops[i].vertex], cell.loops[i].edge});
  }



  template <int dim>
  void
  ConvexCells<dim>::for_each_contact(
    const std::function<void(const Contact &)> &visit) const
  {
    // facets by the node that made them, on its minus and plus sides
    using Facets = std::vector<std::pair<unsigned int, unsigned int>>;
    std::vector<std::array<Facets, 2>> facets(nodes.size());
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int f = 0; f < cells[c].facets.size(); ++f)
        if (const Facet &facet = cells[c].facets[f]; facet.node != nothing)
          facets[facet.node][facet.side > 0].emplace_back(c, f);
    // (polygons on the stack keep their memory)
    std::vector<std::pair<int, Polygon>> stack;
    unsigned int depth = 0;
    const auto push    = [&](const int branch) -> Polygon    &{
      if (depth == stack.size())
        stack.emplace_back();
      stack[depth].first = branch;
      return stack[depth++].second;
    };
    Polygon polygon;
    PolygonCut<dim> cut;
    for (unsigned int n = 0; n < nodes.size(); ++n)
      {
        // the fewer facets go down the tree on the other side
        const bool is_plus       = facets[n][1].size() <= facets[n][0].size();
        const unsigned int plane = nodes[n].plane;
        for (const auto &[own, f] : facets[n][is_plus])
          {
            get_polygon(cells[own],
                        cells[own].facets[f],
                        push(is_plus ? nodes[n].minus : nodes[n].plus));
            while (depth > 0)
              {
                --depth;
                int branch = stack[depth].first;
                polygon.swap(stack[depth].second);
                while (branch >= 0)
                  {
                    const Node &node = nodes[branch];
                    if (cut.cut(planes, plane, node.plane, polygon))
                      push(node.minus).swap(cut.minus);
                    branch = cut.side > 0 ? node.plus : node.minus;
                  }
                const unsigned int other = ~branch;
                visit({plane,
                       is_plus ? other : own,
                       is_plus ? own : other,
                       polygon});
              }
          }
      }
  }



  template class ConvexCells<2>;
  template class ConvexCells<3>;
} // namespace Keyblock

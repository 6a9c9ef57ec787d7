// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>

#include <keyblock/base/errors.h>
#include <keyblock/blocks/convex_cells.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** More than the error of a vertex and of its distance from a plane. */
    constexpr double rounding_of_cells = 1e-12;

    /** Number of edges of a facet: its corners are a loop, in 2D two ends. */
    template <int dim>
    unsigned int
    n_edges(const unsigned int n_corners)
    {
      return dim == 2 ? 1 : n_corners;
    }

    template <int dim>
    void
    fit_box(typename ConvexCells<dim>::Cell &cell)
    {
      cell.low = cell.high = cell.vertices[0].x;
      for (const auto &vertex : cell.vertices)
        for (unsigned int d = 0; d < dim; ++d)
          {
            cell.low[d]  = std::min(cell.low[d], vertex.x[d]);
            cell.high[d] = std::max(cell.high[d], vertex.x[d]);
          }
    }

    /** Keep the vertices that a cell's loops name, and number them anew. */
    template <int dim>
    void
    take_vertices(typename ConvexCells<dim>::Cell &cell,
                  const std::vector<ExactVertex<dim>> &points)
    {
      constexpr unsigned int nothing = ConvexCells<dim>::nothing;
      std::vector<unsigned int> number(points.size(), nothing);
      cell.vertices.reserve(points.size());
      for (auto &corner : cell.loops)
        {
          unsigned int &n = number[corner.vertex];
          if (n == nothing)
            {
              n = cell.vertices.size();
              cell.vertices.push_back(points[corner.vertex]);
            }
          corner.vertex = n;
        }
      fit_box<dim>(cell);
    }

    /** Planes that meet where a plane cuts an edge of a facet; in 2D a facet is
     * an edge. */
    template <int dim>
    std::array<unsigned int, dim>
    meeting_planes(const unsigned int facet,
                   const unsigned int edge,
                   const unsigned int plane)
    {
      if constexpr (dim == 2)
        return {{(void(edge), facet), plane}};
      else
        return {{facet, edge, plane}};
    }

    /** A cell that is being cut into two. */
    template <int dim>
    class CellCut
    {
    public:
      using Cells  = ConvexCells<dim>;
      using Corner = typename Cells::Cell::LoopCorner;

      /** @param signs of the cell's vertices: sides of the plane */
      CellCut(const typename Cells::Cell &cell,
              const std::vector<ExactPlane<dim>> &planes,
              const std::vector<int> &signs,
              const unsigned int plane)
        : cell(cell)
        , planes(planes)
        , signs(signs)
        , plane(plane)
        , points(cell.vertices)
      {
        for (const auto &facet : cell.facets)
          divide(facet);
      }

      /** Add the section to both parts as a facet that a node has made. */
      void close(const unsigned int node);

      std::array<typename Cells::Cell, 2> parts; // minus, plus

    private:
      bool
      lies_on_plane(const unsigned int point) const
      {
        return point >= signs.size() || signs[point] == 0;
      }

      void divide(const typename Cells::Facet &facet);
      void add_facet(const unsigned int part,
                     const typename Cells::Facet &facet,
                     const std::vector<Corner> &loop);
      unsigned int crossing(const unsigned int v,
                            const unsigned int w,
                            const unsigned int facet_plane,
                            const unsigned int edge);

      const typename Cells::Cell &cell;
      const std::vector<ExactPlane<dim>> &planes;
      const std::vector<int> &signs;
      const unsigned int plane;
      std::vector<ExactVertex<dim>> points; // vertices, then crossings

      struct Crossing
      {
        unsigned int v, w, point;
      };
      std::vector<Crossing> crossings;

      /** Edges of the section of the plus part. In 2D the section is one. */
      struct SectionEdge
      {
        unsigned int from, to, plane;
      };
      std::vector<SectionEdge> section;
    };



    /** Where an edge of a facet crosses the plane; the facets on both sides of
     * the edge get the same point. */
    template <int dim>
    unsigned int
    CellCut<dim>::crossing(const unsigned int v,
                           const unsigned int w,
                           const unsigned int facet_plane,
                           const unsigned int edge)
    {
      for (const Crossing &c : crossings)
        if (c.v == w && c.w == v)
          return c.point;
      crossings.push_back({v, w, (unsigned int)(points.size())});
      points.push_back(
        intersect<dim>(planes, meeting_planes<dim>(facet_plane, edge, plane)));
      return crossings.back().point;
    }



    template <int dim>
    void
    CellCut<dim>::divide(const typename Cells::Facet &facet)
    {
      std::array<std::vector<Corner>, 2> loop;
      std::array<bool, 2> is_there{{false, false}};
      for (unsigned int i = 0; i < facet.size; ++i)
        {
          const Corner &corner = cell.loops[facet.begin + i];
          const unsigned int v = corner.vertex,
                             w = cell.loops[facet.begin + (i + 1) % facet.size]
                                   .vertex;
          if (signs[v] <= 0)
            loop[0].push_back(corner);
          if (signs[v] >= 0)
            loop[1].push_back(corner);
          is_there[0] = is_there[0] || signs[v] < 0;
          is_there[1] = is_there[1] || signs[v] > 0;
          if (i < n_edges<dim>(facet.size) && signs[v] * signs[w] < 0)
            {
              const unsigned int u = crossing(v, w, facet.plane, corner.edge);
              loop[0].push_back({u, corner.edge});
              loop[1].push_back({u, corner.edge});
            }
        }
      for (unsigned int part = 0; part < 2; ++part)
        if (is_there[part])
          add_facet(part, facet, loop[part]);
    }



    template <int dim>
    void
    CellCut<dim>::add_facet(const unsigned int part,
                            const typename Cells::Facet &facet,
                            const std::vector<Corner> &loop)
    {
      auto &to             = parts[part];
      const unsigned int n = loop.size();
      to.facets.push_back(facet);
      to.facets.back().begin = to.loops.size();
      to.facets.back().size  = n;
      for (unsigned int i = 0; i < n; ++i)
        {
          Corner corner           = loop[i];
          const unsigned int next = loop[(i + 1) % n].vertex;
          if (dim == 3 && lies_on_plane(corner.vertex) && lies_on_plane(next))
            {
              corner.edge = plane;
              if (part == 1)
                section.push_back({next, corner.vertex, facet.plane});
            }
          to.loops.push_back(corner);
        }
      if (dim == 2 && part == 1)
        {
          // the section leads from the end of one edge to the begin of another
          if (section.empty())
            section.push_back({Cells::nothing, Cells::nothing, Cells::nothing});
          if (lies_on_plane(loop[1].vertex))
            section[0].from = loop[1].vertex;
          if (lies_on_plane(loop[0].vertex))
            section[0].to = loop[0].vertex;
        }
    }



    template <int dim>
    void
    CellCut<dim>::close(const unsigned int node)
    {
      std::vector<Corner> loop;
      if (dim == 2)
        loop = {{section[0].from, Cells::nothing},
                {section[0].to, Cells::nothing}};
      else
        for (auto edge = section.begin(); loop.size() < section.size();)
          {
            loop.push_back({edge->from, edge->plane});
            const unsigned int to = edge->to;
            edge                  = std::find_if(section.begin(),
                                section.end(),
                                [to](const auto &e) { return e.from == to; });
            Assert(edge != section.end(),
                   dealii::ExcMessage("section not closed"));
          }
      const unsigned int n = loop.size();
      for (unsigned int part = 0; part < 2; ++part)
        {
          auto &to = parts[part];
          to.facets.push_back({plane,
                               part == 1 ? 1 : -1,
                               node,
                               Cells::nothing,
                               (unsigned int)(to.loops.size()),
                               n});
          for (unsigned int i = 0; i < n; ++i)
            // the other way round an edge begins where it ended
            to.loops.push_back(part == 1
                                 ? loop[i]
                                 : Corner{loop[n - 1 - i].vertex,
                                          loop[(2 * n - 2 - i) % n].edge});
          take_vertices<dim>(to, points);
        }
    }
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
                              const Tensor<1, dim> &normal)
  {
    const Point<dim> x  = to_unit(point);
    const double origin = -(normal * x) / normal.norm();
    const int side      = origin > 0. ? 1 : -1;
    if (!(std::abs(origin) < 1.9))
      return {nothing, side};
    const ExactPlane<dim> plane = make_exact_plane<dim>(x, normal);
    if (!plane.meets_box())
      return {nothing, side};
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
  typename ConvexCells<dim>::Polygon
  ConvexCells<dim>::polygon_of(const Cell &cell, const Facet &facet) const
  {
    Polygon polygon;
    polygon.reserve(facet.size + 4);
    for (unsigned int i = facet.begin; i < facet.begin + facet.size; ++i)
      polygon.push_back(
        {cell.vertices[cell.loops[i].vertex], cell.loops[i].edge});
    return polygon;
  }



  /** Part a polygon, which lies on @p own_plane: its part on the plus side
   * stays. Returns whether it has parts on both sides; if not, @p side is that
   * on which it lies. */
  template <int dim>
  bool
  ConvexCells<dim>::clip(Polygon &polygon,
                         const unsigned int own_plane,
                         const unsigned int plane,
                         Polygon &minus,
                         int &side) const
  {
    const unsigned int n = polygon.size();
    std::vector<int> sign(n);
    bool is_plus = false, is_minus = false;
    for (unsigned int i = 0; i < n; ++i)
      {
        sign[i]  = side_of(planes, polygon[i].vertex, plane);
        is_plus  = is_plus || sign[i] > 0;
        is_minus = is_minus || sign[i] < 0;
      }
    side = is_plus ? 1 : -1;
    if (!is_plus || !is_minus)
      return false;
    Polygon plus;
    plus.reserve(n + 2);
    minus.clear();
    for (unsigned int i = 0; i < n; ++i)
      {
        const Corner &corner = polygon[i];
        const int a = sign[i], b = sign[(i + 1) % n];
        // the edge from here on is the cut, where the part leaves the polygon
        if (a >= 0)
          plus.push_back(
            {corner.vertex, a == 0 && b < 0 ? plane : corner.edge});
        if (a <= 0)
          minus.push_back(
            {corner.vertex, a == 0 && b > 0 ? plane : corner.edge});
        if (i < n_edges<dim>(n) && a * b < 0)
          {
            const auto vertex = intersect<dim>(
              planes, meeting_planes<dim>(own_plane, corner.edge, plane));
            plus.push_back({vertex, a > 0 ? plane : corner.edge});
            minus.push_back({vertex, a < 0 ? plane : corner.edge});
          }
      }
    polygon.swap(plus);
    return true;
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
    std::vector<std::pair<int, Polygon>> stack;
    Polygon minus;
    for (unsigned int n = 0; n < nodes.size(); ++n)
      {
        // the fewer facets go down the tree on the other side
        const bool is_plus       = facets[n][1].size() <= facets[n][0].size();
        const unsigned int plane = nodes[n].plane;
        for (const auto &[own, f] : facets[n][is_plus])
          {
            stack.emplace_back(is_plus ? nodes[n].minus : nodes[n].plus,
                               polygon_of(cells[own], cells[own].facets[f]));
            while (!stack.empty())
              {
                auto [branch, polygon] = std::move(stack.back());
                stack.pop_back();
                while (branch >= 0)
                  {
                    const Node &node = nodes[branch];
                    int side         = 0;
                    if (clip(polygon, plane, node.plane, minus, side))
                      stack.emplace_back(node.minus, minus);
                    branch = side > 0 ? node.plus : node.minus;
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

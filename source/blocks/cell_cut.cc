// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>

#include <keyblock/blocks/cell_cut.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
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
  } // namespace



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
    loop[0].clear();
    loop[1].clear();
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
          to.loops.push_back(
            part == 1
              ? loop[i]
              : Corner{loop[n - 1 - i].vertex, loop[(2 * n - 2 - i) % n].edge});
        take_vertices<dim>(to, points);
      }
  }



  template <int dim>
  bool
  PolygonCut<dim>::cut(const std::vector<ExactPlane<dim>> &planes,
                       const unsigned int own_plane,
                       const unsigned int plane,
                       Polygon &polygon)
  {
    const unsigned int n = polygon.size();
    signs.resize(n);
    bool is_plus = false, is_minus = false;
    for (unsigned int i = 0; i < n; ++i)
      {
        signs[i] = side_of(planes, polygon[i].vertex, plane);
        is_plus  = is_plus || signs[i] > 0;
        is_minus = is_minus || signs[i] < 0;
      }
    side = is_plus ? 1 : -1;
    if (!is_plus || !is_minus)
      return false;
    plus.clear();
    minus.clear();
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto &corner = polygon[i];
        const int a = signs[i], b = signs[(i + 1) % n];
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



#define INSTANTIATE(dim)                                                       \
  template class CellCut<dim>;                                                 \
  template class PolygonCut<dim>;                                              \
  template void fit_box<dim>(ConvexCells<dim>::Cell &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

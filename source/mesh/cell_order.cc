// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/bounding_box.h>

#include <keyblock/mesh/cell_order.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Axis along which the cells reach farthest; the last of equal ones. */
    template <int dim>
    unsigned int
    longest_axis(const std::vector<Point<dim>> &centers)
    {
      const dealii::BoundingBox<dim> box(centers);
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (box.side_length(d) >= (1. - 1e-9) * box.side_length(axis))
          axis = d;
      return axis;
    }

    /** Sort by rows of one cell's size: by the last axis, then the one before
     * it, ... */
    template <int dim>
    void
    sort_in_rows(std::vector<unsigned int> &cells,
                 const std::vector<Point<dim>> &centers,
                 const unsigned int first,
                 const double size)
    {
      std::sort(cells.begin(),
                cells.end(),
                [&](unsigned int a, unsigned int b) {
                  const Point<dim> &p = centers[a - first],
                                   &q = centers[b - first];
                  for (unsigned int d = dim - 1; d > 0; --d)
                    {
                      const double row   = std::floor(p[d] / size),
                                   other = std::floor(q[d] / size);
                      if (row != other)
                        return row < other;
                    }
                  return p[0] != q[0] ? p[0] < q[0] : a < b;
                });
    }
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  sweep_order(const Mesh<dim> &mesh,
              const unsigned int begin,
              const unsigned int end)
  {
    std::vector<unsigned int> order;
    if (begin == end)
      return order;
    order.reserve(end - begin);
    std::vector<Point<dim>> centers;
    double volume = 0.;
    for (unsigned int c = begin; c < end; ++c)
      {
        centers.push_back(mesh.cell_center(c));
        volume += mesh.cell_volume(c);
      }
    const auto is_here = [&](const unsigned int c) {
      return c != none && c >= begin && c < end;
    };

    // the first front: nothing before them along the axis
    const unsigned int axis = longest_axis<dim>(centers);
    for (unsigned int c = begin; c < end; ++c)
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        if (!is_here(mesh.neighbor[c][f]))
          {
            const Tensor<1, dim> area = mesh.face_area_vector(c, f);
            if (area[axis] < -0.8 * area.norm())
              {
                order.push_back(c);
                break;
              }
          }
    sort_in_rows(order,
                 centers,
                 begin,
                 std::pow(volume / (end - begin), 1. / dim));

    std::vector<bool> is_listed(end - begin, false);
    for (const unsigned int c : order)
      is_listed[c - begin] = true;
    unsigned int next_start = begin;
    for (unsigned int at = 0; order.size() < end - begin; ++at)
      {
        if (at == order.size())
          {
            while (is_listed[next_start - begin])
              ++next_start;
            order.push_back(next_start);
            is_listed[next_start - begin] = true;
          }
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          mesh.for_each_across(order[at], f, [&](const unsigned int other) {
            if (!is_here(other) || is_listed[other - begin])
              return;
            order.push_back(other);
            is_listed[other - begin] = true;
          });
      }
    return order;
  }

  template std::vector<unsigned int>
  sweep_order(const Mesh<2> &, const unsigned int, const unsigned int);
  template std::vector<unsigned int>
  sweep_order(const Mesh<3> &, const unsigned int, const unsigned int);
} // namespace Keyblock

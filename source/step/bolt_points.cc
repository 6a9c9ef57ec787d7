// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/step/bolt_points.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Nodes ahead of the present one whose values are asked of the memory:
     * those of all bolts together do not stay in the caches between steps. */
    constexpr unsigned int n_ahead = 48;
  } // namespace



  template <int dim>
  void
  BoltPoints<dim>::clear()
  {
    *this = BoltPoints();
  }



  template <int dim>
  void
  BoltPoints<dim>::add_bolt(const Tensor<1, dim> &way,
                            const std::vector<RockBinding<dim>> &points,
                            const unsigned int n)
  {
    std::vector<unsigned int> own;
    for (unsigned int i = 0; i < n; ++i)
      for (const auto &[node, share] : points[i].carriers)
        own.push_back(node);
    sort_unique(own);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (const auto &[node, share] : points[i].carriers)
          {
            slot.push_back(std::lower_bound(own.begin(), own.end(), node) -
                           own.begin());
            weight.push_back(share);
          }
        first_carrier.push_back(slot.size());
      }
    nodes.insert(nodes.end(), own.begin(), own.end());
    lines.push_back({way, static_cast<unsigned int>(nodes.size()), size()});
    work.resize(std::max(work.size(), own.size()));
  }



  template <int dim>
  void
  BoltPoints<dim>::gather(const std::vector<double> &displacement,
                          double *along)
  {
    unsigned int node = 0, point = 0, carrier = 0;
    for (const Line &line : lines)
      {
        for (double *u = work.data(); node < line.end_node; ++node, ++u)
          {
            if (node + n_ahead < nodes.size())
              __builtin_prefetch(displacement.data() +
                                 dim * nodes[node + n_ahead]);
            const double *of_node = displacement.data() + dim * nodes[node];
            *u                    = line.way[0] * of_node[0];
            for (unsigned int d = 1; d < dim; ++d)
              *u += line.way[d] * of_node[d];
          }
        for (; point < line.end_point; ++point)
          {
            // two sums at once: an addition waits for the one before it
            const unsigned int end = first_carrier[point + 1];
            double even = 0., odd = 0.;
            for (; carrier + 1 < end; carrier += 2)
              {
                even += weight[carrier] * work[slot[carrier]];
                odd += weight[carrier + 1] * work[slot[carrier + 1]];
              }
            if (carrier < end)
              {
                even += weight[carrier] * work[slot[carrier]];
                ++carrier;
              }
            along[point] = even + odd;
          }
      }
  }



  template <int dim>
  void
  BoltPoints<dim>::subtract(const double *along, std::vector<double> &forces)
  {
    unsigned int node = 0, point = 0, carrier = 0;
    for (const Line &line : lines)
      {
        std::fill_n(work.begin(), line.end_node - node, 0.);
        for (; point < line.end_point; ++point)
          for (; carrier < first_carrier[point + 1]; ++carrier)
            work[slot[carrier]] += weight[carrier] * along[point];
        for (const double *f = work.data(); node < line.end_node; ++node, ++f)
          {
            if (node + n_ahead < nodes.size())
              __builtin_prefetch(forces.data() + dim * nodes[node + n_ahead],
                                 1);
            for (unsigned int d = 0; d < dim; ++d)
              forces[dim * nodes[node] + d] -= *f * line.way[d];
          }
      }
  }

  template class BoltPoints<2>;
  template class BoltPoints<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/pair_cluster.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** A generalised inverse of a symmetric positive semidefinite matrix by the
     * sweep operator; dependent rows are left out. */
    void
    sweep_invert(std::vector<double> &a, const unsigned int n)
    {
      std::vector<bool> is_swept(n, false);
      std::vector<double> diagonal(n);
      for (unsigned int i = 0; i < n; ++i)
        diagonal[i] = a[n * i + i];
      for (unsigned int k = 0; k < n; ++k)
        {
          const double pivot = a[n * k + k];
          if (pivot <= 1e-10 * diagonal[k])
            continue;
          is_swept[k] = true;
          for (unsigned int j = 0; j < n; ++j)
            if (j != k)
              a[n * k + j] /= pivot;
          for (unsigned int i = 0; i < n; ++i)
            if (i != k)
              {
                const double factor = a[n * i + k];
                for (unsigned int j = 0; j < n; ++j)
                  if (j != k)
                    a[n * i + j] -= factor * a[n * k + j];
                a[n * i + k] = -factor / pivot;
              }
          a[n * k + k] = 1. / pivot;
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (!is_swept[i] || !is_swept[j])
            a[n * i + j] = 0.;
    }



    /** How much stiffer rock that joins two sides is than their joint: what it
     * carries goes through its weld, and not around it through other pairs [-].
     */
    constexpr double weld_stiffness = 1e3;



    /** Area by which @p pair takes its share of the forces in its group; a tie
     * has as much as the largest of the others [m^(dim-1)]. */
    template <int dim>
    double
    share_of(const PairTopology<dim> &topology,
             const std::vector<PairState<dim>> &state,
             const unsigned int pair)
    {
      const std::vector<Pair<dim>> &pairs = topology.interface.pairs;
      const double factor = state[pair].is_welded ? weld_stiffness : 1.;
      if (!pairs[pair].is_tie())
        return factor * pairs[pair].area;
      const auto [begin, end] =
        topology.pairs_of_group(topology.group_of_pair[pair]);
      double largest = 0.;
      for (unsigned int p = begin; p < end; ++p)
        largest = std::max(largest, pairs[p].area);
      return factor * largest;
    }
  } // namespace



  template <int dim>
  template <typename Index>
  bool
  PairCluster<dim>::joins_all_nodes(const PairTopology<dim> &topology,
                                    const std::vector<PairState<dim>> &state,
                                    const Index &index_of) const
  {
    std::vector<unsigned int> part(surface_nodes.size());
    std::iota(part.begin(), part.end(), 0u);
    for (unsigned int p = topology.interface.group_pairs_begin[group];
         p < topology.interface.group_pairs_begin[group + 1];
         ++p)
      if (!state[p].is_removed)
        {
          const unsigned int one =
            part[index_of(topology.interface.pairs[p].plus)];
          const unsigned int other =
            part[index_of(topology.interface.pairs[p].minus)];
          std::replace(part.begin(), part.end(), other, one);
        }
    return std::adjacent_find(part.begin(),
                              part.end(),
                              std::not_equal_to<unsigned int>()) == part.end();
  }



  template <int dim>
  void
  PairCluster<dim>::set_up(const PairTopology<dim> &topology,
                           const SurfaceNodes<dim> &nodes,
                           const std::vector<PairState<dim>> &state)
  {
    const unsigned int g = group;
    const unsigned int n = surface_nodes.size();
    const auto index_of  = [&](const unsigned int vertex) {
      return std::find(surface_nodes.begin(),
                       surface_nodes.end(),
                       topology.surface.node_of_vertex[vertex]) -
             surface_nodes.begin();
    };
    is_connected = joins_all_nodes(topology, state, index_of);
    is_oblique   = false;
    for (int d = 0; d < dim; ++d)
      {
        unsigned int n_free = 0;
        free_index[d].assign(n, -1);
        for (unsigned int i = 0; i < n; ++i)
          {
            const double *p = nodes.projection[surface_nodes[i]];
            if (p != nullptr)
              for (int e = 0; e < dim; ++e)
                is_oblique =
                  is_oblique || (e != d && std::abs(p[dim * d + e]) > 1e-12);
            if (nodes.inverse_mass[surface_nodes[i]] > 0. &&
                (p == nullptr || p[dim * d + d] > 0.5))
              free_index[d][i] = n_free++;
          }
        inverse[d].assign(n_free * n_free, 0.);
        for (unsigned int p = topology.interface.group_pairs_begin[g];
             p < topology.interface.group_pairs_begin[g + 1];
             ++p)
          {
            if (state[p].is_removed)
              continue;
            const double area = share_of(topology, state, p);
            const int plus =
              free_index[d][index_of(topology.interface.pairs[p].plus)];
            const int minus =
              free_index[d][index_of(topology.interface.pairs[p].minus)];
            if (plus >= 0)
              inverse[d][n_free * plus + plus] += area;
            if (minus >= 0)
              inverse[d][n_free * minus + minus] += area;
            if (plus >= 0 && minus >= 0)
              {
                inverse[d][n_free * plus + minus] -= area;
                inverse[d][n_free * minus + plus] -= area;
              }
          }
        sweep_invert(inverse[d], n_free);
      }
  }



  template <int dim>
  bool
  PairCluster<dim>::find_common_velocity(const SurfaceNodes<dim> &nodes,
                                         Vector<dim> &common) const
  {
    bool is_free = true;
    for (int d = 0; d < dim; ++d)
      {
        double mass = 0., momentum = 0., held = 0.;
        bool is_held = false;
        for (unsigned int i = 0; i < surface_nodes.size(); ++i)
          {
            const unsigned int node = surface_nodes[i];
            const double v          = nodes.velocity[dim * node + d];
            if (free_index[d][i] < 0)
              {
                is_held = true;
                held    = v;
              }
            else
              {
                const double m = 1. / nodes.inverse_mass[node];
                mass += m;
                momentum += m * v;
              }
          }
        is_free   = is_free && !is_held;
        common[d] = is_held ? held : momentum / mass;
      }

    return is_free;
  }



  template <int dim>
  void
  PairCluster<dim>::recover_impulses(const PairTopology<dim> &topology,
                                     const double *needed,
                                     std::vector<PairState<dim>> &state) const
  {
    const unsigned int g     = group;
    const unsigned int begin = topology.interface.group_pairs_begin[g];
    const unsigned int end   = topology.interface.group_pairs_begin[g + 1];
    const unsigned int n     = surface_nodes.size();
    const auto index         = [&](const unsigned int vertex) {
      return std::find(surface_nodes.begin(),
                       surface_nodes.end(),
                       topology.surface.node_of_vertex[vertex]) -
             surface_nodes.begin();
    };
    for (int d = 0; d < dim; ++d)
      {
        const unsigned int n_free =
          n - std::count(free_index[d].begin(), free_index[d].end(), -1);
        std::vector<double> rest(n_free, 0.), lambda(n_free, 0.);
        for (unsigned int i = 0; i < n; ++i)
          if (free_index[d][i] >= 0)
            rest[free_index[d][i]] = needed[dim * i + d];
        for (unsigned int p = begin; p < end; ++p)
          {
            if (state[p].is_removed)
              continue;
            const int plus =
              free_index[d][index(topology.interface.pairs[p].plus)];
            const int minus =
              free_index[d][index(topology.interface.pairs[p].minus)];
            if (plus >= 0)
              rest[plus] -= state[p].impulse[d];
            if (minus >= 0)
              rest[minus] += state[p].impulse[d];
          }
        for (unsigned int i = 0; i < n_free; ++i)
          for (unsigned int j = 0; j < n_free; ++j)
            lambda[i] += inverse[d][n_free * i + j] * rest[j];
        for (unsigned int p = begin; p < end; ++p)
          {
            if (state[p].is_removed)
              continue;
            const int plus =
              free_index[d][index(topology.interface.pairs[p].plus)];
            const int minus =
              free_index[d][index(topology.interface.pairs[p].minus)];
            state[p].impulse[d] += share_of(topology, state, p) *
                                   ((plus >= 0 ? lambda[plus] : 0.) -
                                    (minus >= 0 ? lambda[minus] : 0.));
          }
      }
  }

  template class PairCluster<2>;
  template class PairCluster<3>;
} // namespace Keyblock

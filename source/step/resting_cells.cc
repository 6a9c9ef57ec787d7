// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/partitioner.h>

#include <keyblock/base/vector.h>
#include <keyblock/step/resting_cells.h>

#include <algorithm>
#include <numeric>

namespace Keyblock
{
  template <int dim>
  RestingCells<dim>::RestingCells(const SplitMesh<dim> &split,
                                  const Numbering<dim> &numbering,
                                  const CellArrays<dim> &cells,
                                  Fields<dim> &fields,
                                  const ForceElements<dim> &elements)
    : split(split)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , elements(elements)
  {}



  template <int dim>
  void
  RestingCells<dim>::forget()
  {
    is_set_up    = false;
    rests        = false;
    n_steps_left = 0;
  }



  template <int dim>
  unsigned int
  RestingCells<dim>::n_batches() const
  {
    return (cells.nodes.size() + batch_size - 1) / batch_size;
  }



  template <int dim>
  unsigned int
  RestingCells<dim>::n_awake() const
  {
    if (!rests)
      return cells.nodes.size();
    unsigned int n = 0;
    for (const CellRange &range : awake)
      n += range.end - range.begin;
    return n;
  }



  template <int dim>
  void
  RestingCells<dim>::set_up()
  {
    is_set_up = true;
    never_rests.assign(numbering.n_local(), false);
    const auto take = [&](const unsigned int vertex) {
      split.for_each_carrier(vertex, [&](const unsigned int carrier, double) {
        if (numbering.local_node(carrier) != none)
          never_rests[numbering.local_node(carrier)] = true;
      });
    };
    for (const unsigned int v : split.interface.group_vertices)
      take(v);
    for (const unsigned int node : numbering.hanging_nodes)
      never_rests[node] = true;
    for (const auto &master : numbering.masters)
      never_rests[master.node] = true;
    for (const NodeSupport<dim> &support : fields.supports)
      if (support.is_moved())
        never_rests[support.node] = true;
    for (const auto &element : elements)
      for (const unsigned int node : element->nodes())
        never_rests[node] = true;
    std::fill(never_rests.begin() + numbering.n_owned(),
              never_rests.end(),
              true);
    for (const auto &range : numbering.partitioner->import_indices())
      for (unsigned int i = range.first; i < range.second; ++i)
        never_rests[i / dim] = true;

    // count, sum up, fill in
    batch_begin.assign(numbering.n_local() + 1, 0);
    const auto for_each_entry = [&](const auto &action) {
      std::vector<unsigned int> last(numbering.n_local(), none);
      for (unsigned int c = 0; c < cells.nodes.size(); ++c)
        for (const unsigned int node : cells.nodes[c])
          if (last[node] != c / batch_size)
            {
              last[node] = c / batch_size;
              action(node, c / batch_size);
            }
    };
    for_each_entry([&](const unsigned int node, const unsigned int) {
      ++batch_begin[node + 1];
    });
    std::partial_sum(batch_begin.begin(),
                     batch_begin.end(),
                     batch_begin.begin());
    batch.resize(batch_begin.back());
    std::vector<unsigned int> place(batch_begin);
    for_each_entry([&](const unsigned int node, const unsigned int b) {
      batch[place[node]++] = b;
    });
  }



  template <int dim>
  bool
  RestingCells<dim>::is_resting(const unsigned int node,
                                const RestLimit &limit) const
  {
    const double factor = limit.kick * fields.inverse_mass[node];
    std::array<double, dim> now, next;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int i = dim * node + d;
        double force         = fields.load[i] - fields.internal_force[i];
        if (limit.has_damping)
          force -= fields.damping_force[i];
        now[d]  = fields.velocity[i];
        next[d] = now[d] + factor * force;
      }
    if (const int s = fields.support_of_node[node]; s >= 0)
      for (unsigned int k = 0; k < fields.supports[s].n_directions; ++k)
        {
          const auto &direction = fields.supports[s].directions[k];
          const double held     = dot<dim>(direction, next);
          for (unsigned int d = 0; d < dim; ++d)
            next[d] -= held * direction[d];
        }
    const double square = limit.speed * limit.speed;
    return dot<dim>(now, now) <= square && dot<dim>(next, next) <= square;
  }



  template <int dim>
  void
  RestingCells<dim>::wake_around(const unsigned int node,
                                 std::vector<char> &is_awake,
                                 std::vector<unsigned int> &woken) const
  {
    for (unsigned int i = batch_begin[node]; i < batch_begin[node + 1]; ++i)
      if (!is_awake[batch[i]])
        {
          is_awake[batch[i]] = 1;
          woken.push_back(batch[i]);
        }
  }



  template <int dim>
  void
  RestingCells<dim>::spread(std::vector<unsigned int> &front,
                            std::vector<char> &is_awake) const
  {
    std::vector<unsigned int> next;
    std::vector<char> is_passed(numbering.n_local(), 0);
    for (unsigned int layer = 0; layer < n_steps && !front.empty(); ++layer)
      {
        next.clear();
        for (const unsigned int b : front)
          {
            const unsigned int end =
              std::min<std::size_t>((b + 1) * batch_size, cells.nodes.size());
            for (unsigned int c = b * batch_size; c < end; ++c)
              for (const unsigned int node : cells.nodes[c])
                if (!is_passed[node])
                  {
                    is_passed[node] = 1;
                    wake_around(node, is_awake, next);
                  }
          }
        std::swap(front, next);
      }
  }



  template <int dim>
  double
  RestingCells<dim>::divide_nodes(const std::vector<char> &is_awake)
  {
    double energy   = 0.;
    const auto stop = [&](const unsigned int node) {
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        {
          energy +=
            0.5 * fields.mass[node] * fields.velocity[i] * fields.velocity[i];
          fields.velocity[i] = 0.;
          if (!fields.rate.empty())
            fields.rate[i] = 0.;
        }
    };
    moving.clear();
    for (const NodeRun &run : fields.runs)
      for (unsigned int node = run.begin; node < run.end; ++node)
        {
          if (std::any_of(batch.begin() + batch_begin[node],
                          batch.begin() + batch_begin[node + 1],
                          [&](const unsigned int b) { return !is_awake[b]; }))
            {
              stop(node);
              continue;
            }
          if (moving.empty() || moving.back().end != node ||
              moving.back().is_inner != run.is_inner)
            moving.push_back({node, node, run.is_inner});
          ++moving.back().end;
        }
    return energy;
  }



  template <int dim>
  double
  RestingCells<dim>::check(const RestLimit &limit,
                           const std::vector<unsigned int> &touched)
  {
    rests = false;
    // mostly nothing rests: a few nodes tell whether one of so many does
    constexpr unsigned int stride = 61, one_of = 16;
    unsigned int n_looked = 0, n_resting = 0;
    for (unsigned int node = 0; node < numbering.n_owned(); node += stride)
      {
        ++n_looked;
        n_resting += is_resting(node, limit);
      }
    if (one_of * n_resting < n_looked)
      return 0.;

    if (!is_set_up)
      set_up();
    std::vector<char> is_awake(n_batches(), 0);
    std::vector<unsigned int> front;
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      if (never_rests[node] || !is_resting(node, limit))
        wake_around(node, is_awake, front);
    for (const unsigned int node : touched)
      wake_around(node, is_awake, front);
    spread(front, is_awake);
    awake.clear();
    for (unsigned int b = 0; b < is_awake.size(); ++b)
      if (is_awake[b])
        {
          if (awake.empty() || awake.back().end != b * batch_size)
            awake.push_back({b * batch_size, b * batch_size});
          awake.back().end =
            std::min<std::size_t>((b + 1) * batch_size, cells.nodes.size());
        }
    if (std::find(is_awake.begin(), is_awake.end(), 0) == is_awake.end())
      return 0.;
    rests = true;
    return divide_nodes(is_awake);
  }

  template class RestingCells<2>;
  template class RestingCells<3>;
} // namespace Keyblock

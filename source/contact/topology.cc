// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/contact/topology.h>

namespace Keyblock
{
  template <int dim>
  PairTopology<dim>::PairTopology(const Scene<dim> &scene,
                                  const SplitMesh<dim> &split,
                                  const Numbering<dim> &numbering,
                                  const ContactSurface<dim> &surface)
    : scene(scene)
    , split(split)
    , interface(split.interface)
    , numbering(numbering)
    , surface(surface)
    , group_of_pair(interface.pairs.size())
    , group_of_node(surface.n_nodes(), none)
  {
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        for (unsigned int i = interface.group_begin[g];
             i < interface.group_begin[g + 1];
             ++i)
          group_of_node[surface.node_of_vertex[interface.group_vertices[i]]] =
            g;
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          group_of_pair[p] = g;
      }
  }


  template <int dim>
  bool
  PairTopology<dim>::is_single(
    const unsigned int group,
    const std::vector<const double *> &projection) const
  {
    const auto [begin, end] = pairs_of_group(group);
    if (end - begin != 1)
      return false;
    for (unsigned int i = interface.group_begin[group];
         i < interface.group_begin[group + 1];
         ++i)
      if (projection[surface.node_of_vertex[interface.group_vertices[i]]])
        return false;
    return true;
  }



  template <int dim>
  std::array<unsigned int, 2>
  PairTopology<dim>::blocks_of_pair(const unsigned int pair) const
  {
    return {
      {surface
         .block_of_node[surface.node_of_vertex[interface.pairs[pair].minus]],
       surface
         .block_of_node[surface.node_of_vertex[interface.pairs[pair].plus]]}};
  }



  template <int dim>
  bool
  PairTopology<dim>::is_primary(const unsigned int group) const
  {
    return numbering.is_owned(
      interface.group_vertices[interface.group_begin[group]]);
  }



  template <int dim>
  std::vector<std::vector<unsigned int>>
  owned_nodes_of_blocks(const SplitMesh<dim> &split,
                        const Numbering<dim> &numbering,
                        const unsigned int n_blocks)
  {
    std::vector<std::vector<unsigned int>> nodes_of_block(n_blocks);
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (split.block_of_cell[c] != none)
        for (const unsigned int v : split.mesh.cells[c])
          if (numbering.is_owned(v))
            nodes_of_block[split.block_of_cell[c]].push_back(
              numbering.local_node(v));
    for (auto &nodes : nodes_of_block)
      sort_unique(nodes);
    return nodes_of_block;
  }

  template class PairTopology<2>;
  template class PairTopology<3>;
  template std::vector<std::vector<unsigned int>>
  owned_nodes_of_blocks(const SplitMesh<2> &,
                        const Numbering<2> &,
                        const unsigned int);
  template std::vector<std::vector<unsigned int>>
  owned_nodes_of_blocks(const SplitMesh<3> &,
                        const Numbering<3> &,
                        const unsigned int);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_measures.h>

#include <keyblock/scene/gravity.h>

#include <map>
#include <utility>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    class BlockMatcher
    {
    public:
      BlockMatcher(const Blocks<dim> &of_mesh,
                   const Mesh<dim> &mesh,
                   const PlaneBlocks<dim> &planes,
                   const Blocks<dim> &exact)
        : of_mesh(of_mesh)
        , exact(exact)
        , like(exact.blocks.size(), none)
        , number_of_mesh(of_mesh.blocks.size(), none)
        , number_of_planes(exact.blocks.size(), none)
      {
        std::map<std::pair<unsigned int, unsigned int>, double> common;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (const unsigned int b = of_mesh.block_of_cell[c]; b != none)
            if (const unsigned int p = planes.block_at(mesh.cell_center(c));
                p != PlaneBlocks<dim>::nothing)
              common[{b, p}] += mesh.cell_volume(c);
        for (const auto &[pair, volume] : common)
          if (const Block<dim> &b = of_mesh.blocks[pair.first],
              &p                  = exact.blocks[pair.second];
              b.is_infinite == p.is_infinite && 2. * volume > b.volume &&
              (p.is_infinite || 2. * volume > p.volume))
            like[pair.second] = pair.first;
      }

      void
      number()
      {
        result.is_known = true;
        for (unsigned int p = 0; p < exact.blocks.size(); ++p)
          if (!exact.blocks[p].is_infinite)
            add_exact(p);
        for (const bool is_infinite : {false, true})
          for (unsigned int b = 0; b < of_mesh.blocks.size(); ++b)
            if (number_of_mesh[b] == none &&
                of_mesh.blocks[b].is_infinite == is_infinite)
              {
                if (!is_infinite && of_mesh.blocks[b].exposed_stage != none)
                  result.unlike.push_back(blocks.size());
                number_of_mesh[b] = blocks.size();
                blocks.push_back(of_mesh.blocks[b]);
              }
        for (unsigned int p = 0; p < exact.blocks.size(); ++p)
          if (exact.blocks[p].is_infinite)
            number_of_planes[p] = number_of_infinite(p);
        for (unsigned int b = 0; b < blocks.size(); ++b)
          blocks[b].id = b + 1;
      }

      /** Put new numbers in place of indices. */
      static void
      renumber(const std::vector<unsigned int> &number,
               std::vector<unsigned int> &indices)
      {
        for (unsigned int &index : indices)
          if (index != none)
            index = number[index];
      }

      const Blocks<dim> &of_mesh, &exact;
      std::vector<unsigned int> like; ///< of each block between planes that of
                                      ///< the mesh; or none
      std::vector<Block<dim>> blocks;
      std::vector<unsigned int> number_of_mesh, number_of_planes;
      BlockComparison<dim> result;

    private:
      void
      add_exact(const unsigned int p)
      {
        const Block<dim> &own = exact.blocks[p];
        Block<dim> block      = own;
        if (like[p] != none)
          {
            block                = of_mesh.blocks[like[p]];
            block.exposed_stage  = own.exposed_stage;
            block.class_of_stage = own.class_of_stage;
            block.is_removable   = own.is_removable;

            number_of_mesh[like[p]] = blocks.size();
          }
        else
          block.n_cells = 0;
        block.exact = {
          true, own.volume, own.mass, own.joint_area, own.centroid};
        number_of_planes[p] = blocks.size();
        ++result.n_finite;
        if (own.exposed_stage != none)
          {
            ++result.n_exposed;
            if (like[p] == none)
              result.lost.push_back(blocks.size());
          }
        blocks.push_back(block);
      }

      /** Infinite rock is one or another part of the same. */
      unsigned int
      number_of_infinite(const unsigned int p)
      {
        if (like[p] != none)
          return number_of_mesh[like[p]];
        if (blocks.empty() || !blocks.back().is_infinite)
          {
            blocks.push_back(exact.blocks[p]);
            blocks.back().n_cells = 0;
          }
        return blocks.size() - 1;
      }
    };
  } // namespace



  template <int dim>
  void
  number_like_planes(Blocks<dim> &blocks,
                     const Mesh<dim> &mesh,
                     const PlaneBlocks<dim> &planes,
                     const Blocks<dim> &exact,
                     std::vector<unsigned int> &block_of_cell)
  {
    BlockMatcher<dim> matcher(blocks, mesh, planes, exact);
    matcher.number();
    matcher.renumber(matcher.number_of_mesh, blocks.block_of_cell);
    matcher.renumber(matcher.number_of_planes, block_of_cell);
    blocks.blocks     = matcher.blocks;
    blocks.comparison = matcher.result;
  }



  template <int dim>
  double
  weight_per_mass(const Scene<dim> &scene)
  {
    const Gravity<dim> gravity(scene);
    return gravity.is_given() ? gravity.at(Point<dim>(), 0.).norm()
                              : standard_gravity;
  }

#define INSTANTIATE(dim)                                                       \
  template double weight_per_mass(const Scene<dim> &);                         \
  template void number_like_planes(Blocks<dim> &,                              \
                                   const Mesh<dim> &,                          \
                                   const PlaneBlocks<dim> &,                   \
                                   const Blocks<dim> &,                        \
                                   std::vector<unsigned int> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/exact_blocks.h>

#include <keyblock/blocks/plane_mesh.h>
#include <keyblock/blocks/plane_scene.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/scene/joint_extent.h>

#include <map>
#include <utility>

namespace Keyblock
{
  template <int dim>
  std::variant<ExactBlocks<dim>, std::string>
  find_exact_blocks(const Scene<dim> &scene, const bool is_about_exposed)
  {
    const auto listed = list_planes(scene);
    if (std::holds_alternative<std::string>(listed))
      return std::get<std::string>(listed);
    const auto &list          = std::get<PlaneScene<dim>>(listed);
    PlaneBlockOptions options = plane_block_options(list);
    options.leave_out         = is_about_exposed;
    ExactBlocks<dim> found{find_plane_blocks(list, options), {}, {}};
    found.split  = make_plane_mesh(found.planes, scene);
    found.blocks = list_plane_blocks(found.planes, scene, found.split);
    return found;
  }



  template <int dim>
  BlockMatch<dim>::BlockMatch(const Blocks<dim> &of_mesh,
                              const Mesh<dim> &mesh,
                              const ExactBlocks<dim> &exact)
    : like(exact.blocks.blocks.size(), none)
    , most(of_mesh.blocks.size(), none)
  {
    std::map<std::pair<unsigned int, unsigned int>, double> common;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (const unsigned int b = of_mesh.block_of_cell[c]; b != none)
        if (const unsigned int p = exact.planes.block_at(mesh.cell_center(c));
            p != none)
          common[{b, p}] += mesh.cell_volume(c);
    for (const auto &[pair, volume] : common)
      {
        const auto [b, p]    = pair;
        const Block<dim> &of = of_mesh.blocks[b], &in = exact.blocks.blocks[p];
        if (most[b] == none || volume > common.at({b, most[b]}))
          most[b] = p;
        if (of.is_infinite == in.is_infinite && 2. * volume > of.volume &&
            (in.is_infinite || 2. * volume > in.volume))
          like[p] = b;
      }
  }



  namespace
  {
    /** Faces of a mesh that are on no joint between the planes. */
    template <int dim>
    class PhantomWelder
    {
    public:
      PhantomWelder(Mesh<dim> &mesh,
                    const Blocks<dim> &blocks,
                    const ExactBlocks<dim> &exact,
                    const BlockMatch<dim> &match,
                    const Scene<dim> &scene)
        : mesh(mesh)
        , blocks(blocks)
        , exact(exact)
        , match(match)
      {
        for (const auto &joint : scene.joints)
          extents.emplace_back(*joint);
      }

      /** Join a block of the mesh to what is beside it in the exact block that
       * has most of it. Returns whether there was something. */
      bool
      weld(const unsigned int block, const unsigned int part_of)
      {
        double least = 1e300;
        std::pair<unsigned int, unsigned int> nearest{none, none};
        bool is_welded = false;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (blocks.block_of_cell[c] == block)
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              if (is_within(c, f, block, part_of))
                {
                  const auto &joint = extents[mesh.joint[c][f]];
                  const double depth =
                    joint.depth_inside(mesh.face_center(c, f));
                  if (joint.is_infinite() ||
                      depth < exact.planes.options.bridging)
                    {
                      take_off_joint(c, f);
                      is_welded = true;
                    }
                  else if (depth < least)
                    {
                      least   = depth;
                      nearest = {c, f};
                    }
                }
        if (!is_welded && nearest.first != none)
          {
            take_off_joint(nearest.first, nearest.second);
            is_welded = true;
          }
        return is_welded;
      }

    private:
      /** Whether a face of a block on a joint lies within an exact block. */
      bool
      is_within(const unsigned int c,
                const unsigned int f,
                const unsigned int block,
                const unsigned int part_of) const
      {
        const unsigned int other = mesh.neighbor[c][f];
        return mesh.joint[c][f] != none && other != none &&
               blocks.block_of_cell[other] != none &&
               blocks.block_of_cell[other] != block &&
               match.most[blocks.block_of_cell[other]] == part_of &&
               exact.planes.block_at(mesh.cell_center(c)) == part_of &&
               exact.planes.block_at(mesh.cell_center(other)) == part_of;
      }

      void
      take_off_joint(const unsigned int c, const unsigned int f)
      {
        mesh.for_each_across(c, f, [&](const unsigned int other) {
          for (unsigned int g = 0; g < Mesh<dim>::n_cell_faces; ++g)
            if (mesh.neighbor[other][g] == c &&
                mesh.joint[other][g] == mesh.joint[c][f])
              {
                mesh.joint[other][g] = none;
                mesh.side[other][g]  = 0;
              }
        });
        mesh.joint[c][f] = none;
        mesh.side[c][f]  = 0;
      }

      Mesh<dim> &mesh;
      const Blocks<dim> &blocks;
      const ExactBlocks<dim> &exact;
      const BlockMatch<dim> &match;
      std::vector<JointExtent<dim>> extents; ///< of the joints
    };
  } // namespace



  template <int dim>
  unsigned int
  weld_phantoms(Mesh<dim> &mesh,
                Blocks<dim> &blocks,
                const ExactBlocks<dim> &exact,
                const Scene<dim> &scene)
  {
    const auto count = [&]() {
      return std::count_if(blocks.blocks.begin(),
                           blocks.blocks.end(),
                           [](const auto &b) { return !b.is_infinite; });
    };
    const unsigned int n_before = count();
    while (true)
      {
        const BlockMatch<dim> match(blocks, mesh, exact);
        PhantomWelder<dim> welder(mesh, blocks, exact, match, scene);
        bool is_welded = false;
        for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
          if (match.is_phantom(blocks, b) && match.most[b] != none)
            is_welded = welder.weld(b, match.most[b]) || is_welded;
        if (!is_welded)
          {
            // the mesh has lost the rock between these and the domain's end
            for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
              if (match.is_phantom(blocks, b) && match.most[b] != none &&
                  exact.blocks.blocks[match.most[b]].is_infinite)
                {
                  Block<dim> &block  = blocks.blocks[b];
                  block.is_infinite  = true;
                  block.is_removable = false;
                  block.width        = 0.;
                  std::fill(block.class_of_stage.begin(),
                            block.class_of_stage.end(),
                            BlockClass::infinite);
                }
            break;
          }
        blocks = find_blocks(mesh, scene);
      }
    return n_before - count();
  }



  namespace
  {
    template <int dim>
    class BlockNumbering
    {
    public:
      BlockNumbering(const Blocks<dim> &of_mesh,
                     const Blocks<dim> &exact,
                     const std::vector<unsigned int> &like)
        : of_mesh(of_mesh)
        , exact(exact)
        , like(like)
        , number_of_mesh(of_mesh.blocks.size(), none)
        , number_of_planes(exact.blocks.size(), none)
      {
        comparison.is_known = true;
        for (unsigned int p = 0; p < exact.blocks.size(); ++p)
          if (!exact.blocks[p].is_infinite)
            add_exact(p);
        for (const bool is_infinite : {false, true})
          for (unsigned int b = 0; b < of_mesh.blocks.size(); ++b)
            if (number_of_mesh[b] == none &&
                of_mesh.blocks[b].is_infinite == is_infinite)
              {
                if (!is_infinite && of_mesh.blocks[b].exposed_stage != none)
                  comparison.unlike.push_back(blocks.size());
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

    private:
      const Blocks<dim> &of_mesh, &exact;
      const std::vector<unsigned int> &like;

    public:
      std::vector<Block<dim>> blocks;
      std::vector<unsigned int> number_of_mesh, number_of_planes;
      BlockComparison<dim> comparison;

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
        ++comparison.n_finite;
        if (own.exposed_stage != none)
          {
            ++comparison.n_exposed;
            if (like[p] == none)
              comparison.lost.push_back(blocks.size());
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
                     ExactBlocks<dim> &exact)
  {
    const BlockMatch<dim> match(blocks, mesh, exact);
    const BlockNumbering<dim> numbers(blocks, exact.blocks, match.like);
    numbers.renumber(numbers.number_of_mesh, blocks.block_of_cell);
    numbers.renumber(numbers.number_of_planes, exact.split.block_of_cell);
    blocks.blocks              = numbers.blocks;
    blocks.comparison          = numbers.comparison;
    blocks.comparison.bridging = exact.planes.options.bridging;
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
  template std::variant<ExactBlocks<dim>, std::string> find_exact_blocks(      \
    const Scene<dim> &, const bool);                                           \
  template struct BlockMatch<dim>;                                             \
  template unsigned int weld_phantoms(Mesh<dim> &,                             \
                                      Blocks<dim> &,                           \
                                      const ExactBlocks<dim> &,                \
                                      const Scene<dim> &);                     \
  template double weight_per_mass(const Scene<dim> &);                         \
  template void number_like_planes(Blocks<dim> &,                              \
                                   const Mesh<dim> &,                          \
                                   ExactBlocks<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

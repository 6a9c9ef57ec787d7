// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/box.h>
#include <keyblock/base/errors.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/mesh/excavation_region.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** How often the scene is meshed again at most, and how many more cells
     * than asked for are aimed at: not every block gets what it is to get. */
    constexpr unsigned int most_passes = 3;
    constexpr double surplus           = 1.15;

    /** Cells across a block that the mesh has lost, where it is meshed again,
     * and the largest part of the size of its cells before. */
    constexpr double cells_across_lost = 2., smaller = 0.5;

    /** What the blocks that the mesh lacks may cost: times as many cells as in
     * the first mesh, or, in an exact one, times as thin cells. */
    constexpr double most_growth = 6., most_thinning = 20.;

    /** Finds where a mesh is too coarse for its blocks. */
    template <int dim>
    class CoarseBlocks
    {
    public:
      CoarseBlocks(const Scene<dim> &scene,
                   const Mesh<dim> &mesh,
                   const Blocks<dim> &blocks,
                   const std::vector<SizeDemand<dim>> &demands)
        : scene(scene)
        , mesh(mesh)
        , blocks(blocks)
        , demands_before(demands)
        , size(scene, longest_side(BoundingBox<dim>(mesh.vertices)), demands)
      {
        for (const auto &excavation : scene.excavations)
          if (excavation->has_outline())
            reach = std::max(reach, narrowest_side(*excavation) / 2.);
      }

      std::vector<SizeDemand<dim>>
      demands() const
      {
        std::vector<SizeDemand<dim>> result;
        if (scene.meshing.cells_across <= 0.)
          return result;
        std::vector<std::vector<Point<dim>>> centers(blocks.blocks.size());
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (blocks.block_of_cell[c] != none)
            centers[blocks.block_of_cell[c]].push_back(mesh.cell_center(c));
        for (unsigned int b = 0; b < centers.size(); ++b)
          if (is_too_coarse(blocks.blocks[b], scene) &&
              std::any_of(centers[b].begin(),
                          centers[b].end(),
                          [this](const auto &p) { return is_near(p); }))
            add(result,
                centers[b],
                blocks.blocks[b].cells_across() / scene.meshing.cells_across);
        for (const auto &rock : mesh.report.lost_rock)
          if (rock.thickness >= size.least() && is_near(rock.place))
            add(result,
                {rock.place},
                rock.thickness / scene.meshing.cells_across / size(rock.place));
        return result;
      }

      /** The exposed blocks between the planes that are not narrower than cells
       * may be, and that the mesh lacks or has otherwise (indices). */
      std::vector<unsigned int>
      list_wrong(const ExactBlocks<dim> &exact) const
      {
        std::vector<unsigned int> result;
        const BlockMatch<dim> match(blocks, mesh, exact);
        for (unsigned int p = 0; p < match.like.size(); ++p)
          if (const Block<dim> &block = exact.blocks.blocks[p];
              !block.is_infinite && block.exposed_stage != none &&
              block.width >= size.least() &&
              (match.like[p] == none || deviation(blocks.blocks[match.like[p]],
                                                  block.volume,
                                                  block.joint_area,
                                                  scene) > largest_difference))
            result.push_back(p);
        return result;
      }

      /** Smaller cells in and around these blocks. */
      std::vector<SizeDemand<dim>>
      demands_of(const std::vector<unsigned int> &wrong,
                 const ExactBlocks<dim> &exact) const
      {
        std::vector<SizeDemand<dim>> result;
        for (const unsigned int p : wrong)
          {
            const Block<dim> &block        = exact.blocks.blocks[p];
            std::vector<Point<dim>> places = {block.centroid};
            for (const auto &face : exact.planes.faces[p])
              for (const auto &outline : face.outlines)
                places.insert(places.end(), outline.begin(), outline.end());
            add(result,
                places,
                std::min(smaller,
                         block.width / cells_across_lost /
                           size(block.centroid)));
          }
        return result;
      }

      /** About how many cells the mesh would have with more demands. */
      double
      n_cells_with(const std::vector<SizeDemand<dim>> &more) const
      {
        auto all = demands_before;
        all.insert(all.end(), more.begin(), more.end());
        const MeshSize<dim> then(scene,
                                 longest_side(BoundingBox<dim>(mesh.vertices)),
                                 all);
        double n = 0.;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          n += std::pow(size(mesh.cell_center(c)) / then(mesh.cell_center(c)),
                        double(dim));
        return n;
      }

    private:
      /** Ask for a @p part of the size that is wanted now. */
      void
      add(std::vector<SizeDemand<dim>> &list,
          const std::vector<Point<dim>> &places,
          const double part) const
      {
        double now = 0.;
        for (const Point<dim> &p : places)
          now += size(p) / places.size();
        const double wanted = std::max(size.least(), now * part / surplus);
        if (wanted < 0.99 * now)
          list.push_back({places, wanted});
      }

      /** Whether a place is within half the width of the widest excavation of
       * an excavation; true if there is none. */
      bool
      is_near(const Point<dim> &p) const
      {
        bool has_outline = false;
        for (const auto &excavation : scene.excavations)
          if (excavation->has_outline())
            {
              has_outline = true;
              if (depth_inside(*excavation, p) > -reach)
                return true;
            }
        return !has_outline;
      }

      const Scene<dim> &scene;
      const Mesh<dim> &mesh;
      const Blocks<dim> &blocks;
      const std::vector<SizeDemand<dim>> &demands_before;
      const MeshSize<dim> size;
      double reach = 0.; ///< [m]
    };

    /** A mesh, its blocks, and the exposed ones between the planes that it
     * should have and has not. */
    template <int dim>
    struct MeshTrial
    {
      Mesh<dim> mesh;
      Blocks<dim> blocks;
      std::vector<unsigned int> wrong; ///< CoarseBlocks::list_wrong()
    };
  } // namespace



  template <int dim>
  std::pair<Mesh<dim>, Blocks<dim>>
  make_mesh_for_blocks(const Communicator &communicator,
                       const Scene<dim> &scene,
                       std::unique_ptr<ExactBlocks<dim>> &exact,
                       const dealii::ConditionalOStream &out)
  {
    MeshWishes<dim> wishes;
    if (!scene.joints.empty())
      if (auto found = find_exact_blocks(scene, false);
          std::holds_alternative<ExactBlocks<dim>>(found))
        {
          exact = std::make_unique<ExactBlocks<dim>>(
            std::move(std::get<ExactBlocks<dim>>(found)));
          for (const Block<dim> &block : exact->blocks.blocks)
            if (!block.is_infinite)
              wishes.narrowest = std::min(wishes.narrowest, block.width);
        }
    unsigned int n_made = 0;
    const auto make     = [&]() {
      MeshTrial<dim> trial;
      trial.mesh   = make_mesh(communicator, scene, out, wishes);
      trial.blocks = find_blocks(trial.mesh, scene);
      ++n_made;
      if (exact)
        {
          trial.mesh.report.n_welded =
            weld_phantoms(trial.mesh, trial.blocks, *exact, scene);
          trial.wrong =
            CoarseBlocks<dim>(scene, trial.mesh, trial.blocks, wishes.demands)
              .list_wrong(*exact);
        }
      return trial;
    };
    // what Gmsh cannot mesh in another way stays as it was
    const auto try_again = [&]() {
      MeshTrial<dim> trial;
      try
        {
          trial = make();
        }
      catch (const InputError &)
        {}
      return trial;
    };

    MeshTrial<dim> best = make();
    if (scene.meshing.generator == MeshGenerator::gmsh)
      {
        const double n_first = best.mesh.n_cells();
        // exact cells are as thin as the narrowest block
        const double side = longest_side(BoundingBox<dim>(best.mesh.vertices));
        if (!best.wrong.empty() && most_thinning * wishes.narrowest >=
                                     least_over_median_thickness(best.mesh) *
                                       MeshSize<dim>(scene, side).smallest())
          {
            wishes.must_be_exact = true;
            MeshTrial<dim> trial = try_again();
            wishes.must_be_exact = false;
            if (trial.mesh.n_cells() > 0 &&
                trial.wrong.size() < best.wrong.size() &&
                most_thinning * least_over_median_thickness(trial.mesh) >=
                  least_over_median_thickness(best.mesh))
              best = std::move(trial);
          }
        for (unsigned int pass = 0; pass < most_passes; ++pass)
          {
            std::vector<unsigned int> n_new(1, 0);
            communicator.on_root([&]() {
              const CoarseBlocks<dim> coarse(scene,
                                             best.mesh,
                                             best.blocks,
                                             wishes.demands);
              auto more = coarse.demands();
              if (!best.wrong.empty())
                {
                  const auto there = coarse.demands_of(best.wrong, *exact);
                  if (coarse.n_cells_with(there) <= most_growth * n_first)
                    more.insert(more.end(), there.begin(), there.end());
                }
              wishes.demands.insert(wishes.demands.end(),
                                    more.begin(),
                                    more.end());
              n_new[0] = more.size();
            });
            communicator.broadcast(n_new);
            if (n_new[0] == 0)
              break;
            MeshTrial<dim> trial = try_again();
            const bool mends     = trial.wrong.size() < best.wrong.size();
            if (trial.mesh.n_cells() > 0 &&
                trial.wrong.size() <= best.wrong.size())
              best = std::move(trial);
            else
              break;
            if (!mends && scene.meshing.cells_across <= 0.)
              break;
          }
      }
    best.mesh.report.n_passes = n_made;
    return {std::move(best.mesh), std::move(best.blocks)};
  }

  template std::pair<Mesh<2>, Blocks<2>>
  make_mesh_for_blocks(const Communicator &,
                       const Scene<2> &,
                       std::unique_ptr<ExactBlocks<2>> &,
                       const dealii::ConditionalOStream &);
  template std::pair<Mesh<3>, Blocks<3>>
  make_mesh_for_blocks(const Communicator &,
                       const Scene<3> &,
                       std::unique_ptr<ExactBlocks<3>> &,
                       const dealii::ConditionalOStream &);
} // namespace Keyblock

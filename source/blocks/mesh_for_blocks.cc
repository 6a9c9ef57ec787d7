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
      const MeshSize<dim> size;
      double reach = 0.; ///< [m]
    };
  } // namespace



  template <int dim>
  std::pair<Mesh<dim>, Blocks<dim>>
  make_mesh_for_blocks(const Communicator &communicator,
                       const Scene<dim> &scene,
                       std::unique_ptr<ExactBlocks<dim>> &exact,
                       const dealii::ConditionalOStream &out)
  {
    if (!scene.joints.empty())
      if (auto found = find_exact_blocks(scene, false);
          std::holds_alternative<ExactBlocks<dim>>(found))
        exact = std::make_unique<ExactBlocks<dim>>(
          std::move(std::get<ExactBlocks<dim>>(found)));
    std::vector<SizeDemand<dim>> demands;
    Mesh<dim> mesh = make_mesh(communicator, scene, out);
    for (unsigned int pass = 0;; ++pass)
      {
        Blocks<dim> blocks   = find_blocks(mesh, scene);
        mesh.report.n_passes = pass + 1;
        if (exact)
          mesh.report.n_welded = weld_phantoms(mesh, blocks, *exact, scene);
        std::vector<unsigned int> n_new(1, 0);
        if (scene.meshing.generator == MeshGenerator::gmsh &&
            scene.meshing.cells_across > 0. && pass < most_passes)
          communicator.on_root([&]() {
            const auto more =
              CoarseBlocks<dim>(scene, mesh, blocks, demands).demands();
            demands.insert(demands.end(), more.begin(), more.end());
            n_new[0] = more.size();
          });
        communicator.broadcast(n_new);
        if (n_new[0] > 0)
          try
            {
              mesh = make_mesh(communicator, scene, out, demands);
              continue;
            }
          catch (const InputError &)
            {} // what Gmsh cannot mesh in another way stays as it was
        return {std::move(mesh), std::move(blocks)};
      }
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

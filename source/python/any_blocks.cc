// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/python/any_blocks.h>
#include <keyblock/safety/block_cascade.h>
#include <keyblock/safety/hanging_group.h>
#include <keyblock/scene/entries.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <set>

namespace Keyblock::Python
{
  namespace
  {
    template <int dim>
    std::shared_ptr<const AnyBlocks>
    find_in(const std::shared_ptr<const SceneOf<dim>> &scene,
            const bool is_verbose)
    {
      const Communicator communicator = scene->source.communicator();
      const dealii::ConditionalOStream out(std::cout,
                                           is_verbose &&
                                             communicator.is_root());
      return std::make_shared<BlocksOf<dim>>(
        scene, make_block_geometry(communicator, scene->scene, out));
    }

    template <int dim, typename Vector>
    std::vector<double>
    list_of(const Vector &vector)
    {
      std::vector<double> list;
      for (unsigned int d = 0; d < dim; ++d)
        list.push_back(vector[d]);
      return list;
    }

    /** The corners of a face so that they go around it, seen from outside the
     * cell anticlockwise; in 2D the cell is on their left. */
    template <int dim>
    std::vector<unsigned int>
    go_around(const Mesh<dim> &mesh,
              const unsigned int cell,
              const unsigned int face)
    {
      const auto corners           = mesh.face_vertices(cell, face);
      const Tensor<1, dim> outward = mesh.face_area_vector(cell, face);
      const Tensor<1, dim> first =
        mesh.vertices[corners[1]] - mesh.vertices[corners[0]];
      if constexpr (dim == 2)
        {
          if (cross_product_2d(first) * outward < 0.)
            return {corners[1], corners[0]};
          return {corners[0], corners[1]};
        }
      else
        {
          const Tensor<1, dim> second =
            mesh.vertices[corners[2]] - mesh.vertices[corners[0]];
          if (cross_product_3d(first, second) * outward < 0.)
            return {corners[0], corners[2], corners[3], corners[1]};
          return {corners[0], corners[1], corners[3], corners[2]};
        }
    }

    /** Whether limit equilibrium does not look at an @p entry. */
    bool
    is_idle(const std::string &entry)
    {
      static const std::set<std::string> sections = {
        "Title", "Check", "Monitors", "Output", "Study", "Time stepping"};
      return sections.count(entry.substr(0, entry.find('/'))) > 0;
    }

    /** The first entry in which two scenes differ so that blocks of the one
     * cannot be judged by the other; empty: none. */
    std::string
    find_other_geometry(const AnyScene &own, const AnyScene &other)
    {
      std::map<std::string, std::string> before, now;
      for (const auto &[entry, value] : list_entries(own.used_entries()))
        before[entry] = value;
      for (const auto &[entry, value] : list_entries(other.used_entries()))
        now[entry] = value;
      now.insert(before.begin(), before.end()); // what it does not have
      for (const auto &[entry, value] : now)
        if (const auto same = before.find(entry);
            (same == before.end() || same->second != value) &&
            !is_idle(entry) &&
            (!leaves_geometry(entry) || entry == "Stages/Names"))
          return entry;
      return "";
    }

    /** What a block that others uncover asks for once they have gone. */
    template <int dim>
    SupportDemand
    demand_of_uncovered(const Ground<dim> &ground,
                        const Blocks<dim> &blocks,
                        const JudgedBlock<dim> &judged,
                        const double time,
                        const double wanted)
    {
      std::vector<bool> is_gone(blocks.blocks.size(), false);
      for (unsigned int b = 0; b < is_gone.size(); ++b)
        is_gone[b] = std::count(judged.once_gone.blocks.begin(),
                                judged.once_gone.blocks.end(),
                                blocks.blocks[b].id) > 0;
      const Ground<dim> later{ground.scene,
                              ground.split,
                              ground.stage_number,
                              &is_gone};
      return find_unshared_demand(later,
                                  FreeFaces<dim>(later),
                                  blocks,
                                  judged.block,
                                  time,
                                  wanted,
                                  judged.statics);
    }

    template <int dim>
    Judgement
    describe(const Ground<dim> &ground,
             const FreeFaces<dim> &free,
             const Blocks<dim> &blocks,
             const JudgedBlock<dim> &judged,
             const double wanted,
             const double time)
    {
      const unsigned int block           = judged.block;
      const BlockStatics<dim> &statics   = judged.statics;
      const LimitEquilibrium<dim> &limit = statics.limit;
      Judgement result;
      result.block         = blocks.blocks[block].id;
      result.stage         = ground.stage_number == 1
                               ? "start"
                               : ground.scene.stages[ground.stage_number - 2]->name;
      result.factor        = limit.factor;
      result.least_factor  = judged.least_factor;
      result.mode          = statics.mode();
      result.weight        = statics.around.loads.weight.norm();
      result.driving_force = limit.driving_force;
      result.direction     = list_of<dim>(limit.direction);
      for (unsigned int i = 0; i < limit.normal_forces.size(); ++i)
        result.normal_forces.emplace_back(
          statics.around.faces[limit.faces[i]].name, limit.normal_forces[i]);
      result.remarks = statics.remarks;
      if (wanted > 0.)
        {
          const SupportDemand demand =
            judged.is_uncovered && !judged.once_gone.blocks.empty()
              ? demand_of_uncovered(ground, blocks, judged, time, wanted)
              : find_unshared_demand(
                  ground, free, blocks, block, time, wanted, statics);
          result.support_force    = demand.force;
          result.support_pressure = demand.pressure;
          for (const auto &[set, number] : demand.numbers)
            if (number > 0)
              result.bolts.emplace_back(set, number);
        }
      return result;
    }
  } // namespace



  std::shared_ptr<const AnyBlocks>
  AnyBlocks::find(const std::shared_ptr<const AnyScene> &scene,
                  const bool is_verbose)
  {
    if (const auto plane = std::dynamic_pointer_cast<const SceneOf<2>>(scene))
      return find_in(plane, is_verbose);
    return find_in(std::static_pointer_cast<const SceneOf<3>>(scene),
                   is_verbose);
  }



  template <int dim>
  BlocksOf<dim>::BlocksOf(const std::shared_ptr<const SceneOf<dim>> &scene,
                          BlockGeometry<dim> geometry)
    : source(scene)
    , scene(scene->scene)
    , geometry(std::move(geometry))
    , blocks(this->geometry.blocks)
    , split(this->geometry.split)
  {}



  template <int dim>
  std::vector<BlockRow>
  BlocksOf<dim>::rows() const
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const double gravity     = weight_per_mass(scene);
    std::vector<BlockRow> list;
    for (const Block<dim> &block : blocks.blocks)
      {
        BlockRow row;
        row.id           = block.id;
        row.is_infinite  = block.is_infinite;
        row.is_rigid     = block.is_rigid;
        row.is_removable = block.is_removable;
        row.n_cells      = block.n_cells;
        row.volume       = block.volume;
        row.mass         = block.mass;
        row.weight       = gravity * block.mass;
        row.size         = block.size;
        row.width        = block.is_infinite ? unknown : block.width;
        row.exact_volume = row.exact_weight = unknown;
        if (block.exact.is_known)
          {
            row.exact_volume = block.exact.volume;
            row.exact_weight = gravity * block.best_mass();
          }
        row.centroid = list_of<dim>(block.centroid);
        for (unsigned int n = 1; n < scene.stages.size() + 2; ++n)
          row.classes.push_back(
            to_string(block.class_of_stage[std::min<std::size_t>(
              n, block.class_of_stage.size() - 1)]));
        if (block.exposed_stage != none)
          row.exposed_in = block.exposed_stage < 2
                             ? "start"
                             : scene.stages[block.exposed_stage - 2]->name;
        for (const auto &[joint, area] : block.joint_area)
          row.joint_areas.emplace_back(scene.joints[joint]->name, area);
        list.push_back(row);
      }
    return list;
  }



  template <int dim>
  Surface
  BlocksOf<dim>::surface(const unsigned int id) const
  {
    AssertThrow(id > 0 && id <= blocks.blocks.size(),
                InputError("There is no block " + std::to_string(id) +
                           " whose surface could be shown; the ids of blocks "
                           "are 1 to " +
                           std::to_string(blocks.blocks.size()) + "."));
    Surface result;
    std::map<unsigned int, int> number_of;
    const Mesh<dim> &mesh = split.mesh;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        {
          const unsigned int other = mesh.neighbor[c][f];
          if (split.block_of_cell[c] != id - 1 ||
              (other != none && split.block_of_cell[other] == id - 1))
            continue;
          for (const unsigned int vertex : go_around(mesh, c, f))
            {
              const auto [entry, is_new] =
                number_of.emplace(vertex, number_of.size());
              if (is_new)
                for (unsigned int d = 0; d < dim; ++d)
                  result.vertices.values.push_back(mesh.vertices[vertex][d]);
              result.faces.values.push_back(entry->second);
            }
          const unsigned int joint = mesh.joint[c][f];
          result.joints.push_back(joint == none ? ""
                                                : scene.joints[joint]->name);
        }
    result.vertices.shape = {number_of.size(), dim};
    result.faces.shape    = {result.joints.size(), Mesh<dim>::n_face_vertices};
    return result;
  }



  template <int dim>
  std::vector<Judgement>
  BlocksOf<dim>::judge(const std::shared_ptr<const AnyScene> &other,
                       const double wanted,
                       const double time) const
  {
    const auto same = std::dynamic_pointer_cast<const SceneOf<dim>>(other);
    AssertThrow(!other ||
                  (same && same->scene.joints.size() == scene.joints.size()),
                InputError("The scene '" +
                           (other ? other->source.file : std::string()) +
                           "' has other joints than the one whose blocks are "
                           "to be judged by it; find its own blocks."));
    if (same)
      {
        const std::string entry = find_other_geometry(*source, *same);
        AssertThrow(entry.empty(),
                    InputError("The entry '" + entry + "' of '" +
                               other->source.file +
                               "' is not that of the scene whose blocks are to "
                               "be judged by it, and is none of those that "
                               "leave mesh, blocks and support as they are; "
                               "find its own blocks."));
      }
    std::vector<Judgement> list;
    for_each_changed_ground<dim>(
      same ? same->scene : scene,
      split,
      [&](const Ground<dim> &ground, const FreeFaces<dim> &free) {
        for (const JudgedBlock<dim> &one :
             judge_leaning_blocks(ground, free, blocks, time, wanted))
          list.push_back(describe(ground, free, blocks, one, wanted, time));
      });
    return list;
  }



  template <int dim>
  Array<double>
  BlocksOf<dim>::vertices() const
  {
    Array<double> result{{split.mesh.vertices.size(), dim}, {}};
    for (const Point<dim> &vertex : split.mesh.vertices)
      for (unsigned int d = 0; d < dim; ++d)
        result.values.push_back(vertex[d]);
    return result;
  }



  template <int dim>
  Array<int>
  BlocksOf<dim>::cells() const
  {
    Array<int> result{{split.mesh.cells.size(), 1u << dim}, {}};
    for (const auto &cell : split.mesh.cells)
      result.values.insert(result.values.end(), cell.begin(), cell.end());
    return result;
  }



  template <int dim>
  Array<int>
  BlocksOf<dim>::block_of_cell() const
  {
    Array<int> result{{split.mesh.cells.size()}, {}};
    for (const unsigned int b : split.block_of_cell)
      result.values.push_back(b == none ? 0 : blocks.blocks[b].id);
    return result;
  }



  template <int dim>
  std::vector<std::string>
  BlocksOf<dim>::lost_joints() const
  {
    std::vector<std::string> names;
    for (const auto *list : {&geometry.report.lost, &geometry.report.outside})
      for (const unsigned int joint : *list)
        names.push_back(scene.joints[joint]->name);
    return names;
  }

  template class BlocksOf<2>;
  template class BlocksOf<3>;
} // namespace Keyblock::Python

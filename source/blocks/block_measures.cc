// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_measures.h>

#include <keyblock/base/errors.h>
#include <keyblock/blocks/plane_scene.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <map>
#include <utility>

namespace Keyblock
{
  namespace
  {
    /** Areas on the joints as the mesh has them, of each block. */
    template <int dim>
    std::vector<std::map<unsigned int, double>>
    areas_in_mesh(const Blocks<dim> &blocks, const Mesh<dim> &mesh)
    {
      std::vector<std::map<unsigned int, double>> areas(blocks.blocks.size());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (const unsigned int b = blocks.block_of_cell[c]; b != none)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (const unsigned int other = mesh.neighbor[c][f];
                mesh.joint[c][f] != none &&
                (other == none || blocks.block_of_cell[other] != b))
              areas[b][mesh.joint[c][f]] += mesh.face_area_vector(c, f).norm();
      return areas;
    }

    /** For each block of the mesh the finite one between the planes which has
     * more than half of it, and of which it has more than half; else `none`. */
    template <int dim>
    std::vector<unsigned int>
    match_blocks(const Blocks<dim> &blocks,
                 const Mesh<dim> &mesh,
                 const PlaneBlocks<dim> &planes)
    {
      std::map<std::pair<unsigned int, unsigned int>, double> common; // volume
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (const unsigned int b = blocks.block_of_cell[c]; b != none)
          if (const unsigned int p = planes.block_at(mesh.cell_center(c));
              p != PlaneBlocks<dim>::nothing)
            common[{b, p}] += mesh.cell_volume(c);
      std::vector<unsigned int> match(blocks.blocks.size(), none);
      for (const auto &[pair, volume] : common)
        if (!planes.blocks[pair.second].is_infinite &&
            2. * volume > blocks.blocks[pair.first].volume &&
            2. * volume > planes.blocks[pair.second].volume)
          match[pair.first] = pair.second;
      return match;
    }

    /** @param match of each block of the mesh that between the planes */
    template <int dim>
    BlockComparison<dim>
    compare(const Blocks<dim> &blocks,
            const PlaneBlocks<dim> &planes,
            const std::vector<unsigned int> &match)
    {
      BlockComparison<dim> result;
      result.is_known = true;
      for (unsigned int p = 0; p < planes.blocks.size(); ++p)
        if (const Block<dim> &block = planes.blocks[p]; !block.is_infinite)
          {
            ++result.n_finite;
            if (block.exposed_stage == none)
              continue;
            ++result.n_exposed;
            const auto same = std::find(match.begin(), match.end(), p);
            if (same == match.end() ||
                (blocks.blocks[same - match.begin()].is_infinite &&
                 !blocks.blocks[same - match.begin()].is_rigid))
              result.lost.push_back({block.volume, block.centroid});
          }
      for (unsigned int b = 0; b < match.size(); ++b)
        if (!blocks.blocks[b].is_infinite &&
            blocks.blocks[b].exposed_stage != none && match[b] == none)
          result.unlike.push_back(b);
      return result;
    }

    /** What a block between planes measures. Joints reach beyond their rims by
     * @p bridging [m]: faces that may be due to this alone are left out. */
    template <int dim>
    typename Block<dim>::Measures
    measures_of(const PlaneBlocks<dim> &planes,
                const unsigned int p,
                const double bridging)
    {
      const auto is_due_to_bridging = [&](const auto &outline) {
        return is_narrow(outline, 2. * bridging);
      };
      typename Block<dim>::Measures exact;
      exact.is_known = true;
      exact.volume   = planes.blocks[p].volume;
      exact.centroid = planes.blocks[p].centroid;
      for (const auto &face : planes.faces[p])
        {
          if (std::all_of(face.outlines.begin(),
                          face.outlines.end(),
                          is_due_to_bridging))
            continue;
          exact.joint_area[face.joint] += face.area;
          auto &polygons = exact.joint_faces[face.joint];
          polygons.insert(polygons.end(),
                          face.outlines.begin(),
                          face.outlines.end());
        }
      for (const auto &face : planes.free_faces[p])
        if (face.joint != PlaneBlocks<dim>::nothing &&
            !is_due_to_bridging(face.outline))
          {
            exact.joint_area[face.joint] += face.area;
            exact.joint_faces[face.joint].push_back(face.outline);
          }
      return exact;
    }
  } // namespace



  template <int dim>
  void
  measure_exactly(Blocks<dim> &blocks,
                  const Mesh<dim> &mesh,
                  const Scene<dim> &scene)
  {
    if (mesh.surfaces.empty() || scene.joints.empty())
      return;
    const auto listed = list_planes(scene);
    if (!std::holds_alternative<PlaneScene<dim>>(listed))
      return;
    const auto &list                = std::get<PlaneScene<dim>>(listed);
    const PlaneBlockOptions options = plane_block_options(list);
    const PlaneBlocks<dim> planes   = find_plane_blocks(list, options);
    const auto match                = match_blocks(blocks, mesh, planes);
    blocks.comparison               = compare(blocks, planes, match);
    const auto areas                = areas_in_mesh(blocks, mesh);
    for (unsigned int b = 0; b < match.size(); ++b)
      if (Block<dim> &block = blocks.blocks[b];
          !block.is_infinite && match[b] != none)
        {
          block.exact = measures_of(planes, match[b], options.bridging);
          block.exact.bent_area = areas[b];
          for (const auto &entry : areas[b])
            block.exact.joint_area.try_emplace(entry.first, 0.);
          for (const auto &entry : block.exact.joint_area)
            block.exact.bent_area.try_emplace(entry.first, 0.);
        }
  }



  template <int dim>
  double
  weight_per_mass(const Scene<dim> &scene)
  {
    const Gravity<dim> gravity(scene);
    return gravity.is_given() ? gravity.at(Point<dim>(), 0.).norm()
                              : standard_gravity;
  }

  template double weight_per_mass(const Scene<2> &);
  template double weight_per_mass(const Scene<3> &);
  template void measure_exactly(Blocks<2> &, const Mesh<2> &, const Scene<2> &);
  template void measure_exactly(Blocks<3> &, const Mesh<3> &, const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/cluster_numbering.h>
#include <keyblock/blocks/nodal_areas.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Drop cells that are not there from the start; returns the new index of
     * each cell, or `none`. */
    template <int dim>
    std::vector<unsigned int>
    keep_cells(const Mesh<dim> &mesh,
               const Blocks<dim> &blocks,
               SplitMesh<dim> &result)
    {
      result.mesh.region_names      = mesh.region_names;
      result.mesh.boundary_id_names = mesh.boundary_id_names;
      std::vector<unsigned int> kept(mesh.n_cells(), none);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (mesh.excavation_stage[c] != 1)
          {
            kept[c] = result.mesh.cells.size();
            result.mesh.cells.push_back(mesh.cells[c]);
            result.mesh.region.push_back(mesh.region[c]);
            result.mesh.material.push_back(mesh.material[c]);
            if (!mesh.later_materials.empty())
              result.mesh.later_materials.push_back(mesh.later_materials[c]);
            result.mesh.joint.push_back(mesh.joint[c]);
            result.mesh.boundary.push_back(mesh.boundary[c]);
            result.mesh.boundary_id.push_back(mesh.boundary_id[c]);
            result.mesh.excavation_stage.push_back(mesh.excavation_stage[c]);
            result.mesh.excavation.push_back(mesh.excavation[c]);
            result.block_of_cell.push_back(blocks.block_of_cell[c]);
          }
      for (auto hanging : mesh.hanging_faces)
        {
          hanging.coarse_cell = kept[hanging.coarse_cell];
          hanging.fine_cell   = kept[hanging.fine_cell];
          if (hanging.coarse_cell != none && hanging.fine_cell != none)
            result.mesh.hanging_faces.push_back(hanging);
        }
      return kept;
    }



    /** Pairs by vertex before the split, joint, minus and plus vertex. */
    template <int dim>
    using PairMap = std::map<std::array<unsigned int, 4>, Pair<dim>>;



    /** Drop pairs of hanging vertices: with their masters' gaps closed theirs
     * is closed, so the masters' pairs carry their area. */
    template <int dim>
    void
    give_hanging_area_to_masters(const std::vector<unsigned int> &before,
                                 const SplitMesh<dim> &split,
                                 PairMap<dim> &pairs)
    {
      for (auto entry = pairs.begin(); entry != pairs.end();)
        {
          const Pair<dim> pair = entry->second;
          if (!split.is_hanging(pair.minus) && !split.is_hanging(pair.plus))
            {
              ++entry;
              continue;
            }
          Assert(split.is_hanging(pair.minus) && split.is_hanging(pair.plus),
                 dealii::ExcInternalError());
          entry = pairs.erase(entry);
          split.for_each_carrier(
            pair.minus, [&](const unsigned int minus, const double weight) {
              split.for_each_carrier(
                pair.plus, [&](const unsigned int plus, const double) {
                  const auto found =
                    pairs.find({{before[minus], pair.joint, minus, plus}});
                  if (found != pairs.end())
                    {
                      found->second.area += weight * pair.area;
                      found->second.area_vector += weight * pair.area_vector;
                    }
                });
            });
        }
    }



    /** Pairs without an area of clusters that meet across no joint, with the
     * joint and the size of a pair beside them. */
    template <int dim>
    void
    add_ties(const ClusterNumbering<dim> &clusters,
             const SplitMesh<dim> &split,
             PairMap<dim> &pairs)
    {
      for (const auto &tie : clusters.ties)
        {
          const unsigned int minus  = clusters.new_vertex_of(tie[0]),
                             plus   = clusters.new_vertex_of(tie[1]),
                             vertex = clusters.before[minus];
          const auto beside         = pairs.lower_bound({{vertex, 0, 0, 0}});
          // what holds hanging vertices holds their masters
          if (beside == pairs.end() || beside->first[0] != vertex ||
              split.is_hanging(minus) || split.is_hanging(plus))
            continue;
          Pair<dim> pair;
          pair.minus           = minus;
          pair.plus            = plus;
          pair.joint           = beside->second.joint;
          pair.normal          = beside->second.normal;
          pair.face_size       = beside->second.face_size;
          pair.unwelding_stage = clusters.unwelding_stage.at({{minus, plus}});
          pairs[{{vertex, pair.joint, minus, plus}}] = pair;
        }
    }



    /** What part of a face's area its shadow on the plane with @p normal has;
     * exactly 1 for a face that lies on it up to rounding [-]. */
    template <int dim>
    double
    part_in_plane(const Tensor<1, dim> &area, const Tensor<1, dim> &normal)
    {
      const double part = std::abs(area * normal) / area.norm();
      return part > 1. - 1e-9 ? 1. : part;
    }



    template <int dim>
    void
    make_pairs(const Scene<dim> &scene,
               const ClusterNumbering<dim> &clusters,
               SplitMesh<dim> &result)
    {
      const std::vector<unsigned int> &before = clusters.before;
      Interface<dim> &interface               = result.interface;
      PairMap<dim> pairs;
      for (const JointFace &face : interface.joint_faces)
        {
          const auto areas =
            nodal_areas(result.mesh, face.minus_cell, face.minus_face);
          const auto minus =
            result.mesh.face_vertices(face.minus_cell, face.minus_face);
          const auto plus =
            result.mesh.face_vertices(face.plus_cell, face.plus_face);
          const double size =
            std::pow(std::accumulate(areas.begin(), areas.end(), 0.),
                     1. / (dim - 1));
          const Tensor<1, dim> area_vector =
            result.mesh.face_area_vector(face.minus_cell, face.minus_face);
          const Tensor<1, dim> direction = area_vector / area_vector.norm();
          const double in_plane =
            part_in_plane(area_vector, scene.joints[face.joint]->normal());
          for (unsigned int v = 0; v < minus.size(); ++v)
            for (const unsigned int p : plus)
              if (p != minus[v] && before[p] == before[minus[v]])
                {
                  Pair<dim> &pair =
                    pairs[{{before[p], face.joint, minus[v], p}}];
                  pair.minus  = minus[v];
                  pair.plus   = p;
                  pair.joint  = face.joint;
                  pair.normal = scene.joints[face.joint]->normal();
                  const auto welded =
                    clusters.unwelding_stage.find({{minus[v], p}});
                  if (welded != clusters.unwelding_stage.end())
                    pair.unwelding_stage = welded->second;
                  pair.area += in_plane * areas[v];
                  pair.area_vector += areas[v] * direction;
                  pair.face_size = std::max(pair.face_size, size);
                }
        }
      give_hanging_area_to_masters(before, result, pairs);
      add_ties(clusters, result, pairs);
      unsigned int last = none;
      for (const auto &[key, pair] : pairs)
        {
          if (key[0] != last)
            {
              interface.group_pairs_begin.push_back(interface.pairs.size());
              interface.group_begin.push_back(interface.group_vertices.size());
              last = key[0];
            }
          interface.pairs.push_back(pair);
          for (const unsigned int v : {pair.minus, pair.plus})
            if (std::find(interface.group_vertices.begin() +
                            interface.group_begin.back(),
                          interface.group_vertices.end(),
                          v) == interface.group_vertices.end())
              interface.group_vertices.push_back(v);
        }
      interface.group_pairs_begin.push_back(interface.pairs.size());
      interface.group_begin.push_back(interface.group_vertices.size());
    }



    template <int dim>
    void
    list_surface(SplitMesh<dim> &result)
    {
      const Mesh<dim> &mesh = result.mesh;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          if (mesh.excavation_stage[c] == 0 &&
              (mesh.neighbor[c][f] == none ||
               mesh.excavation_stage[mesh.neighbor[c][f]] > 0))
            {
              SurfaceFace<dim> face;
              face.vertices = mesh.face_vertices(c, f);
              face.cell     = c;
              face.face     = f;
              face.block    = result.block_of_cell[c];
              face.joint    = mesh.joint[c][f];
              // 2D: rock to the left of v0 -> v1; 3D: (v1-v0) x (v2-v0) outward
              const Tensor<1, dim> outward = mesh.face_area_vector(c, f);
              if constexpr (dim == 2)
                {
                  const Tensor<1, dim> along = mesh.vertices[face.vertices[1]] -
                                               mesh.vertices[face.vertices[0]];
                  if (cross_product_2d(along) * outward < 0.)
                    std::swap(face.vertices[0], face.vertices[1]);
                }
              else
                {
                  const Tensor<1, dim> a = mesh.vertices[face.vertices[1]] -
                                           mesh.vertices[face.vertices[0]];
                  const Tensor<1, dim> b = mesh.vertices[face.vertices[2]] -
                                           mesh.vertices[face.vertices[0]];
                  if (cross_product_3d(a, b) * outward < 0.)
                    std::swap(face.vertices[1], face.vertices[2]);
                }
              result.interface.surface.push_back(face);
            }
    }
  } // namespace



  template <int dim>
  SplitMesh<dim>
  split_mesh(const Mesh<dim> &mesh,
             const Blocks<dim> &blocks,
             const Scene<dim> &scene)
  {
    SplitMesh<dim> result;
    const std::vector<unsigned int> kept = keep_cells(mesh, blocks, result);
    Blocks<dim> welded                   = blocks;
    const bool is_active = scene.contact.method != ContactMethod::none;
    if (!is_active)
      for (auto &block : welded.blocks)
        block.is_infinite = true;
    const ClusterNumbering<dim> clusters(mesh,
                                         welded,
                                         kept,
                                         !is_active ||
                                           scene.contact.weld_infinite_blocks,
                                         result);
    find_neighbors(result.mesh);
    result.hanging = list_hanging_vertices(result.mesh);
    make_pairs(scene, clusters, result);
    list_surface(result);
    return result;
  }

  template SplitMesh<2>
  split_mesh(const Mesh<2> &, const Blocks<2> &, const Scene<2> &);
  template SplitMesh<3>
  split_mesh(const Mesh<3> &, const Blocks<3> &, const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/blocks/interface.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    unsigned int
    local_vertex(const Mesh<dim> &mesh,
                 const unsigned int cell,
                 const unsigned int vertex)
    {
      for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
        if (mesh.cells[cell][v] == vertex)
          return v;
      return none;
    }



    /** Integral of each vertex's shape function over a face [m^(dim-1)]. */
    template <int dim>
    std::array<double, Mesh<dim>::n_face_vertices>
    nodal_areas(const Mesh<dim> &mesh,
                const unsigned int cell,
                const unsigned int face)
    {
      std::array<double, Mesh<dim>::n_face_vertices> areas;
      const auto f = mesh.face_vertices(cell, face);
      if constexpr (dim == 2)
        areas.fill(0.5 * mesh.vertices[f[0]].distance(mesh.vertices[f[1]]));
      else
        {
          areas.fill(0.);
          const double g = 0.5 / std::sqrt(3.);
          for (const double s : {0.5 - g, 0.5 + g})
            for (const double t : {0.5 - g, 0.5 + g})
              {
                const Tensor<1, dim> a =
                  (1. - t) * (mesh.vertices[f[1]] - mesh.vertices[f[0]]) +
                  t * (mesh.vertices[f[3]] - mesh.vertices[f[2]]);
                const Tensor<1, dim> b =
                  (1. - s) * (mesh.vertices[f[2]] - mesh.vertices[f[0]]) +
                  s * (mesh.vertices[f[3]] - mesh.vertices[f[1]]);
                const double weight = 0.25 * cross_product_3d(a, b).norm();
                for (unsigned int v = 0; v < 4; ++v)
                  areas[v] +=
                    weight * ((v & 1) ? s : 1. - s) * ((v & 2) ? t : 1. - t);
              }
        }
      return areas;
    }



    /** Drop cells that are not there from the start; returns the new index of
     * each cell, or `none`. */
    template <int dim>
    std::vector<unsigned int>
    keep_cells(const Mesh<dim> &mesh,
               const Blocks<dim> &blocks,
               SplitMesh<dim> &result)
    {
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



    /** Corners of cells (cell times vertices per cell plus vertex), joined
     * through the faces of which @p joins(cell, face, neighbour) holds. */
    template <int dim, typename Condition>
    DisjointSets
    join_corners(const Mesh<dim> &mesh, const Condition &joins)
    {
      constexpr unsigned int n = Mesh<dim>::n_cell_vertices;
      DisjointSets corners(mesh.n_cells() * n);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const unsigned int other = mesh.neighbor[c][f];
            if (other == none || !joins(c, f, other))
              continue;
            for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
              {
                const unsigned int a =
                  GeometryInfo<dim>::face_to_cell_vertices(f, v);
                const unsigned int b =
                  local_vertex(mesh, other, mesh.cells[c][a]);
                if (b != none) // a vertex hanging on a larger cell is apart
                  corners.join(c * n + a, other * n + b);
              }
          }
      return corners;
    }



    /**
     * Renumber the corners of the kept cells by cluster, and list the joint
     * faces.
     *
     * Clusters are those of the rock that is left at the end. Cells that are
     * excavated later go with one of the clusters that they join, and the pairs
     * between these clusters are welded until no unexcavated cell joins them
     * any more.
     */
    template <int dim>
    class ClusterNumbering
    {
    public:
      ClusterNumbering(const Mesh<dim> &mesh,
                       const Blocks<dim> &blocks,
                       const std::vector<unsigned int> &kept,
                       const bool weld_infinite_blocks,
                       SplitMesh<dim> &result)
        : mesh(mesh)
        , blocks(blocks)
        , kept(kept)
        , weld(weld_infinite_blocks)
        , result(result)
        , rock(join_alive(none - 1))
        , early(blocks.n_stages > 1 ? join_alive(1) : rock)
      {
        choose_vertices();
        number_vertices();
        for (unsigned int s = 2; s <= blocks.n_stages; ++s)
          alive.push_back(join_alive(s));
        list_joint_faces();
      }

      /** Vertex before the split of each new vertex. */
      std::vector<unsigned int> before;

      /** Stage that unwelds a pair of new vertices (minus, plus); absent: they
       * never were. */
      std::map<std::array<unsigned int, 2>, unsigned int> unwelding_stage;

    private:
      static constexpr unsigned int n = Mesh<dim>::n_cell_vertices;

      bool
      is_split(const unsigned int cell, const unsigned int face) const
      {
        return blocks.is_split(mesh, cell, face, weld);
      }

      /** Corners joined through cells that are there after @p stage. */
      DisjointSets
      join_alive(const unsigned int stage) const
      {
        const auto is_there = [&](const unsigned int c) {
          return mesh.excavation_stage[c] == 0 ||
                 mesh.excavation_stage[c] > stage;
        };
        return join_corners(mesh,
                            [&](const unsigned int c,
                                const unsigned int f,
                                const unsigned int other) {
                              return is_there(c) && is_there(other) &&
                                     !is_split(c, f);
                            });
      }

      /** Corners on the two sides of a split face, by vertex of the face. */
      std::array<unsigned int, 2>
      facing_corners(const unsigned int c,
                     const unsigned int f,
                     const unsigned int v) const
      {
        const unsigned int a = GeometryInfo<dim>::face_to_cell_vertices(f, v);
        const unsigned int other = mesh.neighbor[c][f];
        return {
          {c * n + a, other * n + local_vertex(mesh, other, mesh.cells[c][a])}};
      }

      template <typename Action>
      void
      for_each_split_face(const Action &action) const
      {
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              const unsigned int other = mesh.neighbor[c][f];
              if (other != none && kept[c] != none && kept[other] != none &&
                  is_split(c, f))
                action(c, f, other);
            }
      }

      /** Which clusters of rock need a vertex of their own: of clusters that
       * face each other across a joint and are one cluster early, all but the
       * first. */
      void
      choose_vertices()
      {
        is_apart.assign(mesh.n_cells() * n, false);
        DisjointSets facing(mesh.n_cells() * n);
        std::vector<unsigned int> clusters;
        for_each_split_face(
          [&](const unsigned int c, const unsigned int f, const unsigned int) {
            for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
              {
                const auto corners   = facing_corners(c, f, v);
                const unsigned int a = rock.root(corners[0]),
                                   b = rock.root(corners[1]);
                if (a == b || early.root(a) != early.root(b))
                  continue;
                facing.join(a, b);
                clusters.push_back(a);
                clusters.push_back(b);
              }
          });
        for (const unsigned int cluster : clusters)
          is_apart[cluster] = facing.root(cluster) != cluster;
      }

      void
      number_vertices()
      {
        std::vector<unsigned int> new_vertex(mesh.n_cells() * n, none),
          apart_vertex(new_vertex);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (kept[c] != none)
            for (unsigned int v = 0; v < n; ++v)
              {
                const unsigned int cluster = rock.root(c * n + v);
                const unsigned int root =
                  is_apart[cluster] ? cluster : early.root(c * n + v);
                // an early cluster and a cluster apart may have the same root
                unsigned int &vertex =
                  is_apart[cluster] ? apart_vertex[root] : new_vertex[root];
                if (vertex == none)
                  {
                    vertex = before.size();
                    before.push_back(mesh.cells[c][v]);
                    result.mesh.vertices.push_back(
                      mesh.vertices[mesh.cells[c][v]]);
                  }
                result.mesh.cells[kept[c]][v] = vertex;
              }
      }

      void
      list_joint_faces()
      {
        for_each_split_face([&](const unsigned int c,
                                const unsigned int f,
                                const unsigned int other) {
          const unsigned int joint = mesh.joint[c][f];
          if (mesh.side[c][f] > 0)
            return;
          unsigned int other_face = 0;
          while (mesh.neighbor[other][other_face] != c)
            ++other_face;
          result.interface.joint_faces.push_back(
            {kept[c], f, kept[other], other_face, joint});
          for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
            note_unwelding(facing_corners(c, f, v));
        });
      }

      void
      note_unwelding(const std::array<unsigned int, 2> &corners)
      {
        if (early.root(corners[0]) != early.root(corners[1]))
          return;
        unsigned int stage = 2;
        while (stage <= blocks.n_stages && alive[stage - 2].root(corners[0]) ==
                                             alive[stage - 2].root(corners[1]))
          ++stage;
        const auto vertex = [&](const unsigned int corner) {
          return result.mesh.cells[kept[corner / n]][corner % n];
        };
        unwelding_stage[{{vertex(corners[0]), vertex(corners[1])}}] = stage;
      }

      const Mesh<dim> &mesh;
      const Blocks<dim> &blocks;
      const std::vector<unsigned int> &kept;
      const bool weld;
      SplitMesh<dim> &result;

      DisjointSets rock;               ///< clusters of the rock left at the end
      DisjointSets early;              ///< clusters at the start
      std::vector<DisjointSets> alive; ///< clusters after stage 2, 3, ...
      std::vector<bool> is_apart;      ///< by root in rock
    };



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

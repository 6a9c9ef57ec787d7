// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_cluster_numbering_h
#define keyblock_blocks_cluster_numbering_h

#include <keyblock/base/disjoint_sets.h>
#include <keyblock/blocks/interface.h>

#include <algorithm>
#include <map>
#include <vector>

namespace Keyblock
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
   * any more. Clusters of different blocks that such cells join without facing
   * each other across a joint, as two wedges that meet at a point of the
   * outline, are tied by a pair without an area until then.
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
      for (const auto &tie : ties)
        note_unwelding(tie);
    }

    /** Corners of clusters that are tied by a pair without an area. */
    std::vector<std::array<unsigned int, 2>> ties;

    /** New vertex of a corner. */
    unsigned int
    new_vertex_of(const unsigned int corner) const
    {
      return result.mesh.cells[kept[corner / n]][corner % n];
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
      const unsigned int a     = GeometryInfo<dim>::face_to_cell_vertices(f, v);
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
      tie_clusters(facing, clusters);
      for (const unsigned int cluster : clusters)
        is_apart[cluster] = facing.root(cluster) != cluster;
    }

    /** Join clusters of different blocks around a vertex that are one cluster
     * early, too, where they face none of each other, and a joint ends there.
     */
    void
    tie_clusters(DisjointSets &facing, std::vector<unsigned int> &clusters)
    {
      std::vector<bool> has_joint(mesh.vertices.size(), false);
      for_each_split_face(
        [&](const unsigned int c, const unsigned int f, const unsigned int) {
          for (const unsigned int vertex : mesh.face_vertices(c, f))
            has_joint[vertex] = true;
        });
      // by vertex and early cluster, a corner of each cluster of rock
      std::map<std::array<unsigned int, 2>, std::vector<unsigned int>> meeting;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (mesh.excavation_stage[c] == 0)
          for (unsigned int v = 0; v < n; ++v)
            if (has_joint[mesh.cells[c][v]] &&
                rock.root(c * n + v) == c * n + v)
              meeting[{{mesh.cells[c][v], early.root(c * n + v)}}].push_back(
                c * n + v);
      for (const auto &[place, roots] : meeting)
        for (unsigned int i = 1; i < roots.size(); ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (facing.root(roots[i]) != facing.root(roots[j]) &&
                are_split(roots[i] / n, roots[j] / n))
              {
                facing.join(roots[i], roots[j]);
                ties.push_back({{roots[i], roots[j]}});
                clusters.push_back(roots[i]);
                clusters.push_back(roots[j]);
              }
    }

    /** Whether two cells are of blocks that are split where they meet. */
    bool
    are_split(const unsigned int c, const unsigned int d) const
    {
      const unsigned int a = blocks.block_of_cell[c],
                         b = blocks.block_of_cell[d];
      return a != none && b != none && a != b &&
             !(weld && blocks.blocks[a].is_infinite &&
               blocks.blocks[b].is_infinite);
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
      unwelding_stage[{
        {new_vertex_of(corners[0]), new_vertex_of(corners[1])}}] = stage;
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
} // namespace Keyblock

#endif

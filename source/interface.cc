// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/interface.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Sets that grow together; the root of a set is its least member. */
    class DisjointSets
    {
    public:
      explicit DisjointSets(const unsigned int n)
        : parent(n)
      {
        std::iota(parent.begin(), parent.end(), 0);
      }

      unsigned int
      root(unsigned int i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }

      void
      join(const unsigned int a, const unsigned int b)
      {
        const unsigned int ra = root(a), rb = root(b);
        parent[std::max(ra, rb)] = std::min(ra, rb);
      }

    private:
      std::vector<unsigned int> parent;
    };



    template <int dim>
    unsigned int
    local_vertex(const Mesh<dim> &mesh,
                 const unsigned int cell,
                 const unsigned int vertex)
    {
      for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
        if (mesh.cells[cell][v] == vertex)
          return v;
      Assert(false, dealii::ExcInternalError());
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



    /** Drop excavated cells; returns the new index of each cell, or `none`. */
    template <int dim>
    std::vector<unsigned int>
    keep_rock(const Mesh<dim> &mesh,
              const Blocks<dim> &blocks,
              SplitMesh<dim> &result)
    {
      std::vector<unsigned int> kept(mesh.n_cells(), none);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (blocks.block_of_cell[c] != none)
          {
            kept[c] = result.mesh.cells.size();
            result.mesh.cells.push_back(mesh.cells[c]);
            result.mesh.region.push_back(mesh.region[c]);
            result.mesh.material.push_back(mesh.material[c]);
            result.mesh.joint.push_back(mesh.joint[c]);
            result.mesh.boundary.push_back(mesh.boundary[c]);
            result.mesh.boundary_id.push_back(mesh.boundary_id[c]);
            result.block_of_cell.push_back(blocks.block_of_cell[c]);
          }
      result.mesh.excavation_stage.assign(result.mesh.n_cells(), 0);
      return kept;
    }



    /** Renumber the corners of the kept cells by fan; returns for each new
     * vertex the one it was before. */
    template <int dim>
    std::vector<unsigned int>
    number_fans(const Mesh<dim> &mesh,
                const Blocks<dim> &blocks,
                const std::vector<unsigned int> &kept,
                const bool weld,
                SplitMesh<dim> &result)
    {
      constexpr unsigned int n = Mesh<dim>::n_cell_vertices;
      DisjointSets corners(mesh.n_cells() * n);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const unsigned int other = mesh.neighbor[c][f];
            if (other == none || other < c || kept[c] == none ||
                kept[other] == none || blocks.is_split(mesh, c, f, weld))
              continue;
            for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
              {
                const unsigned int a =
                  GeometryInfo<dim>::face_to_cell_vertices(f, v);
                const unsigned int b =
                  local_vertex(mesh, other, mesh.cells[c][a]);
                corners.join(c * n + a, other * n + b);
              }
          }
      std::vector<unsigned int> new_vertex(mesh.n_cells() * n, none), before;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (kept[c] != none)
          for (unsigned int v = 0; v < n; ++v)
            {
              const unsigned int root = corners.root(c * n + v);
              if (new_vertex[root] == none)
                {
                  new_vertex[root] = before.size();
                  before.push_back(mesh.cells[c][v]);
                  result.mesh.vertices.push_back(
                    mesh.vertices[mesh.cells[c][v]]);
                }
              result.mesh.cells[kept[c]][v] = new_vertex[root];
            }
      return before;
    }



    template <int dim>
    void
    list_joint_faces(const Mesh<dim> &mesh,
                     const Blocks<dim> &blocks,
                     const Scene<dim> &scene,
                     const std::vector<unsigned int> &kept,
                     std::vector<JointFace> &joint_faces)
    {
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const unsigned int other = mesh.neighbor[c][f];
            if (kept[c] == none || other == none || kept[other] == none ||
                !blocks.is_split(
                  mesh, c, f, scene.contact.weld_infinite_blocks))
              continue;
            const unsigned int joint = mesh.joint[c][f];
            if (scene.joints[joint]->distance(mesh.cell_center(c)) > 0.)
              continue;
            unsigned int other_face = 0;
            while (mesh.neighbor[other][other_face] != c)
              ++other_face;
            joint_faces.push_back({kept[c], f, kept[other], other_face, joint});
          }
    }



    template <int dim>
    void
    make_pairs(const Scene<dim> &scene,
               const std::vector<unsigned int> &before,
               SplitMesh<dim> &result)
    {
      Interface<dim> &interface = result.interface;
      std::map<std::array<unsigned int, 4>, Pair<dim>> pairs;
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
                  pair.area += areas[v];
                  pair.face_size = std::max(pair.face_size, size);
                }
        }
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
          if (mesh.neighbor[c][f] == none)
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
    const std::vector<unsigned int> kept = keep_rock(mesh, blocks, result);
    const bool active                    = scene.contact.method != "none";
    std::vector<unsigned int> before;
    if (active)
      before = number_fans(
        mesh, blocks, kept, scene.contact.weld_infinite_blocks, result);
    else
      {
        Blocks<dim> welded = blocks;
        for (auto &block : welded.blocks)
          block.is_infinite = true;
        before = number_fans(mesh, welded, kept, true, result);
      }
    find_neighbors(result.mesh);
    if (active)
      list_joint_faces(mesh, blocks, scene, kept, result.interface.joint_faces);
    make_pairs(scene, before, result);
    list_surface(result);
    return result;
  }

  template SplitMesh<2>
  split_mesh(const Mesh<2> &, const Blocks<2> &, const Scene<2> &);
  template SplitMesh<3>
  split_mesh(const Mesh<3> &, const Blocks<3> &, const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/blocks/lined_faces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace Keyblock
{
  template <int dim>
  std::vector<unsigned int>
  groups_of_vertices(const SplitMesh<dim> &split)
  {
    std::vector<unsigned int> group(split.mesh.vertices.size(), none);
    for (unsigned int g = 0; g < split.interface.n_groups(); ++g)
      for (unsigned int i = split.interface.group_begin[g];
           i < split.interface.group_begin[g + 1];
           ++i)
        group[split.interface.group_vertices[i]] = g;
    return group;
  }



  namespace
  {
    /** Outer faces that supports hold along their normals. */
    template <int dim>
    class HeldFaces
    {
    public:
      explicit HeldFaces(const Scene<dim> &scene)
        : scene(scene)
      {
        for (const auto &support : scene.supports)
          regions.push_back(
            support->region.empty()
              ? nullptr
              : std::make_unique<Expression<dim>>(
                  support->region, 1, "Supports/" + support->name + "/Region"));
      }

      bool
      has(const Mesh<dim> &mesh,
          const CellFace &f,
          const Tensor<1, dim> &normal) const
      {
        unsigned int axis = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (std::abs(normal[d]) > std::abs(normal[axis]))
            axis = d;
        for (unsigned int s = 0; s < scene.supports.size(); ++s)
          if (scene.supports[s]->names_axis(axis) && is_under(mesh, f, s))
            return true;
        return false;
      }

    private:
      bool
      is_under(const Mesh<dim> &mesh,
               const CellFace &f,
               const unsigned int support) const
      {
        for (const std::string &name : scene.supports[support]->boundaries)
          if (mesh.is_on(f.cell, f.face, name))
            return true;
        if (!regions[support])
          return false;
        const auto vertices = mesh.face_vertices(f.cell, f.face);
        return std::all_of(
          vertices.begin(), vertices.end(), [&](const unsigned int v) {
            return regions[support]->value(mesh.vertices[v], 0., 0) > 0.;
          });
      }

      const Scene<dim> &scene;
      std::vector<std::unique_ptr<Expression<dim>>> regions; ///< by support
    };

    /** Places of vertices: the same for those that were one before the
     * split. */
    template <int dim>
    struct Places
    {
      explicit Places(const SplitMesh<dim> &split)
        : of_vertex(groups_of_vertices(split))
      {
        const unsigned int n_groups = split.interface.n_groups();
        for (unsigned int v = 0; v < of_vertex.size(); ++v)
          if (of_vertex[v] == none)
            of_vertex[v] = n_groups + v;
      }

      std::vector<unsigned int> of_vertex;
    };

    /** Vertices (2D) or edges (3D) of a face from each of its vertices, which
     * stand in a row around it, to the next, by their places. */
    template <int dim>
    std::vector<std::vector<unsigned int>>
    rims_by_place(const std::array<unsigned int, LinedFace<dim>::n> &vertices,
                  const Places<dim> &places)
    {
      std::vector<std::vector<unsigned int>> rims;
      for (unsigned int i = 0; i < vertices.size(); ++i)
        {
          rims.push_back({places.of_vertex[vertices[i]]});
          if (dim == 3)
            rims.back().push_back(
              places.of_vertex[vertices[(i + 1) % vertices.size()]]);
          std::sort(rims.back().begin(), rims.back().end());
        }
      return rims;
    }

    /** Vertices of a face in a row around it, seen from outside of its cell
     * counterclockwise; in 2D with the outside on the left. */
    template <int dim>
    std::array<unsigned int, LinedFace<dim>::n>
    turn_outward(const Mesh<dim> &mesh, const CellFace &f)
    {
      const auto v              = mesh.face_vertices(f.cell, f.face);
      const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
      const auto way            = [&](const unsigned int i) {
        return Tensor<1, dim>(mesh.vertices[v[i]] - mesh.vertices[v[0]]);
      };
      std::array<unsigned int, LinedFace<dim>::n> row;
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        {
          row    = {{v[0], v[1]}};
          normal = -cross_product_2d(way(1));
        }
      else
        {
          row    = {{v[0], v[1], v[3], v[2]}};
          normal = cross_product_3d(way(1), way(2)) +
                   cross_product_3d(way(1), way(3)) +
                   cross_product_3d(way(3), way(2));
        }
      if (normal * area < 0.)
        std::reverse(row.begin(), row.end());
      return row;
    }

    /** Rims of held outer faces, by their places. */
    template <int dim>
    std::set<std::vector<unsigned int>>
    find_mirrors(const Scene<dim> &scene,
                 const Mesh<dim> &mesh,
                 const Places<dim> &places)
    {
      std::set<std::vector<unsigned int>> mirrors;
      const HeldFaces<dim> held(scene);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            if (mesh.neighbor[c][f] != none)
              continue;
            const Tensor<1, dim> area   = mesh.face_area_vector(c, f);
            const Tensor<1, dim> normal = area / area.norm();
            if (held.has(mesh, {c, f}, normal))
              for (const auto &rim :
                   rims_by_place(turn_outward(mesh, {c, f}), places))
                mirrors.insert(rim);
          }
      return mirrors;
    }
  } // namespace



  template <int dim>
  std::vector<LinedFace<dim>>
  lay_out_faces(const Scene<dim> &scene,
                const SplitMesh<dim> &split,
                const unsigned int liner,
                const std::vector<CellFace> &faces)
  {
    const Places<dim> places(split);
    const auto mirrors = find_mirrors(scene, split.mesh, places);
    std::map<unsigned int, unsigned int> points;
    std::vector<LinedFace<dim>> result;
    for (const CellFace &f : faces)
      {
        LinedFace<dim> face;
        face.vertices   = turn_outward(split.mesh, f);
        face.cell       = f.cell;
        face.area       = split.mesh.face_area_vector(f.cell, f.face).norm();
        const auto rims = rims_by_place(face.vertices, places);
        for (unsigned int i = 0; i < LinedFace<dim>::n; ++i)
          {
            const unsigned int v = face.vertices[i];
            AssertThrow(dim == 2 || !split.is_hanging(v),
                        InputError(
                          "The shotcrete 'Shotcrete/" +
                          scene.liners[liner]->name +
                          "' has a 'Young modulus', and cells of two sizes "
                          "meet under it; let the levels of refinement be the "
                          "same along its faces ('Mesh/Refine at excavations', "
                          "'Refinement levels')."));
            face.points[i] =
              points.try_emplace(places.of_vertex[v], points.size())
                .first->second;
            face.is_mirrored[i] = mirrors.count(rims[i]) > 0;
          }
        result.push_back(face);
      }
    return result;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<unsigned int> groups_of_vertices(                       \
    const SplitMesh<dim> &);                                                   \
  template std::vector<LinedFace<dim>> lay_out_faces(                          \
    const Scene<dim> &,                                                        \
    const SplitMesh<dim> &,                                                    \
    const unsigned int,                                                        \
    const std::vector<CellFace> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

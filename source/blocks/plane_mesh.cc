// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/material_shares.h>
#include <keyblock/blocks/plane_mesh.h>
#include <keyblock/mesh/material_region.h>
#include <keyblock/mesh/mesh_marks.h>

#include <algorithm>
#include <deque>
#include <set>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    class PlaneMesher
    {
    public:
      PlaneMesher(const PlaneBlocks<dim> &planes, const Scene<dim> &scene)
        : planes(planes)
        , scene(scene)
        , apex(planes.cells.n_cells(), none)
      {
        self.fill(none);
      }

      SplitMesh<dim>
      run()
      {
        list_narrow_faces();
        unsigned int contact = 0;
        planes.cells.for_each_contact([&](const auto &c) {
          add_contact(c, planes.joint_of_contact[contact++]);
        });
        for (unsigned int c = 0; c < planes.cells.n_cells(); ++c)
          if (is_there(c))
            add_domain_sides(c);
        if (mesh.n_cells() > 0)
          mark_boundaries(mesh, scene);
        result.is_between_planes = true;
        mark_places();
        result.interface.group_begin       = {0};
        result.interface.group_pairs_begin = {0};
        return std::move(result);
      }

    private:
      using Row = std::vector<unsigned int>; ///< vertices around a polygon

      /** Blocks, and the joint between them. */
      using Between = std::array<unsigned int, 3>;

      Between
      between(const unsigned int a,
              const unsigned int b,
              const unsigned int joint) const
      {
        return {{std::min(a, b), std::max(a, b), joint}};
      }

      /** Note faces that joints have only as they reach beyond their rims. */
      void
      list_narrow_faces()
      {
        for (unsigned int b = 0; b < planes.faces.size(); ++b)
          for (const auto &face : planes.faces[b])
            if (std::all_of(face.outlines.begin(),
                            face.outlines.end(),
                            [&](const auto &outline) {
                              return is_narrow(outline,
                                               2. * planes.options.bridging);
                            }))
              narrow.insert(between(b, face.neighbour, face.joint));
      }

      /** The face of a pyramid that is none within a convex cell. */
      static constexpr unsigned int base = 2 * (dim - 1);

      unsigned int
      stage_of(const unsigned int cell) const
      {
        const unsigned int e = planes.excavation_of_cell[cell];
        return e == none ? 0
               : e < scene.excavations.size()
                 ? scene.stage_number(scene.excavations[e]->stage)
                 : 1;
      }

      /** Whether there is rock in a convex cell when the first stage begins. */
      bool
      is_there(const unsigned int cell) const
      {
        return stage_of(cell) != 1;
      }

      Row
      add_vertices(const typename ConvexCells<dim>::Polygon &polygon)
      {
        Row row;
        for (const auto &corner : polygon)
          {
            row.push_back(mesh.vertices.size());
            mesh.vertices.push_back(planes.cells.to_metres(corner.vertex.x));
          }
        return row;
      }

      /** A vertex inside a convex cell. */
      unsigned int
      apex_of(const unsigned int cell)
      {
        if (apex[cell] == none)
          {
            Tensor<1, dim> sum;
            const auto &vertices = planes.cells.cell(cell).vertices;
            for (const auto &vertex : vertices)
              sum += vertex.x;
            apex[cell] = mesh.vertices.size();
            mesh.vertices.push_back(planes.cells.to_metres(
              Point<dim>(sum / double(vertices.size()))));
          }
        return apex[cell];
      }

      /** Convex polygons in parts, as corners of faces in deal.II's order. */
      static std::vector<typename Mesh<dim>::FaceVertices>
      divide(const Row &row)
      {
        if constexpr (dim == 2)
          return {{{row[0], row[1]}}};
        else
          {
            std::vector<typename Mesh<dim>::FaceVertices> parts;
            for (unsigned int i = 1; i + 1 < row.size(); i += 2)
              parts.push_back(
                {{row[0],
                  row[i],
                  row[std::min<std::size_t>(i + 2, row.size() - 1)],
                  row[i + 1]}});
            return parts;
          }
      }

      /** Add the pyramid of a convex cell on a part of its surface. */
      unsigned int
      add_pyramid(const unsigned int cell,
                  typename Mesh<dim>::FaceVertices part)
      {
        const unsigned int top = apex_of(cell), index = mesh.n_cells();
        const auto way = [&](const unsigned int v) {
          return Tensor<1, dim>(mesh.vertices[v] - mesh.vertices[part[0]]);
        };
        double volume;
        if constexpr (dim == 2)
          volume =
            way(part[1])[0] * way(top)[1] - way(part[1])[1] * way(top)[0];
        else
          volume = (cross_product_3d(way(part[1]), way(part[3])) +
                    cross_product_3d(way(part[3]), way(part[2]))) *
                   way(top);
        if (volume < 0.)
          std::swap(part[1], part[dim == 2 ? 0 : 2]);
        typename Mesh<dim>::CellVertices vertices;
        vertices.fill(top);
        std::copy(part.begin(), part.end(), vertices.begin());
        mesh.cells.push_back(vertices);
        mesh.neighbor.emplace_back();
        mesh.neighbor.back().fill(index);
        mesh.neighbor.back()[base] = none;
        mesh.joint.push_back(self);
        mesh.side.emplace_back();
        mesh.side.back().fill(0);
        convex_cell.push_back(cell);
        return index;
      }

      /** Whether a polygon between two convex cells is due to rounding, or to
       * joints that reach beyond their rims, and so joins and parts nothing.
       */
      bool
      is_nothing(const std::array<unsigned int, 2> &cells,
                 const unsigned int joint,
                 const Row &row) const
      {
        const unsigned int a = planes.block_of_cell[cells[0]],
                           b = planes.block_of_cell[cells[1]];
        if (joint != none)
          return narrow.count(between(a, b, joint)) > 0;
        std::vector<Point<dim>> outline;
        for (const unsigned int v : row)
          outline.push_back(mesh.vertices[v]);
        return a != b && ((a != none && b != none) ||
                          is_narrow(outline, planes.options.narrow));
      }

      void
      add_contact(const typename ConvexCells<dim>::Contact &contact,
                  const unsigned int joint)
      {
        std::array<unsigned int, 2> cells = {{contact.minus, contact.plus}};
        if (joint != none && planes.cells.plane(contact.plane).normal *
                                 scene.joints[joint]->normal() <
                               0.)
          std::swap(cells[0], cells[1]);
        if (!is_there(cells[0]) && !is_there(cells[1]))
          return;
        const Row row      = add_vertices(contact.polygon);
        const bool is_none = is_nothing(cells, joint, row);
        for (const auto &part : divide(row))
          {
            std::array<unsigned int, 2> pyramid;
            for (unsigned int i = 0; i < 2; ++i)
              {
                pyramid[i] =
                  is_there(cells[i]) ? add_pyramid(cells[i], part) : none;
                if (pyramid[i] != none && joint != none)
                  {
                    mesh.joint[pyramid[i]][base] = joint;
                    mesh.side[pyramid[i]][base]  = i == 0 ? -1 : 1;
                  }
                if (pyramid[i] != none && is_none)
                  mesh.neighbor[pyramid[i]][base] = pyramid[i];
              }
            if (is_none || pyramid[0] == none || pyramid[1] == none)
              continue;
            if (joint == none)
              {
                mesh.neighbor[pyramid[0]][base] = pyramid[1];
                mesh.neighbor[pyramid[1]][base] = pyramid[0];
              }
            else
              result.interface.joint_faces.push_back(
                {pyramid[0], base, pyramid[1], base, joint});
          }
      }

      void
      add_domain_sides(const unsigned int cell)
      {
        const auto &cells = planes.cells;
        for (const auto &facet : cells.cell(cell).facets)
          if (facet.domain_side != none)
            for (const auto &part : divide(
                   add_vertices(cells.polygon_of(cells.cell(cell), facet))))
              add_pyramid(cell, part);
      }

      /** Blocks, excavations and materials of the cells. */
      void
      mark_places()
      {
        std::deque<MaterialRegion<dim>> regions;
        for (const auto &material : scene.materials)
          regions.emplace_back(scene, *material);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          {
            const unsigned int cell = convex_cell[c];
            result.block_of_cell.push_back(planes.block_of_cell[cell]);
            mesh.excavation_stage.push_back(stage_of(cell));
            mesh.excavation.push_back(planes.excavation_of_cell[cell]);
            mesh.region.push_back(0);
            mesh.material.push_back(0);
            for (unsigned int m = 0; m < regions.size(); ++m)
              if (regions[m].contains(mesh.cell_center(c)))
                {
                  if (scene.materials[m]->stage.empty())
                    mesh.material[c] = m;
                  else
                    {
                      mesh.later_materials.resize(mesh.n_cells());
                      mesh.later_materials[c].push_back(m);
                    }
                }
          }
      }

      const PlaneBlocks<dim> &planes;
      const Scene<dim> &scene;
      SplitMesh<dim> result;
      Mesh<dim> &mesh = result.mesh;
      std::set<Between> narrow;
      std::vector<unsigned int> apex;        ///< of each convex cell; or none
      std::vector<unsigned int> convex_cell; ///< of each cell of the mesh
      std::array<unsigned int, Mesh<dim>::n_cell_faces> self;
    };
  } // namespace



  template <int dim>
  SplitMesh<dim>
  make_plane_mesh(const PlaneBlocks<dim> &planes, const Scene<dim> &scene)
  {
    return PlaneMesher<dim>(planes, scene).run();
  }



  template <int dim>
  Blocks<dim>
  list_plane_blocks(const PlaneBlocks<dim> &planes,
                    const Scene<dim> &scene,
                    const SplitMesh<dim> &split)
  {
    const Mesh<dim> &mesh         = split.mesh;
    std::vector<Block<dim>> found = planes.blocks;
    std::vector<double> rigid_volume(found.size(), 0.);
    const DensityOfPlaces<dim> density(scene);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (const unsigned int b = split.block_of_cell[c]; b != none)
        {
          const Material<dim> &material = *scene.materials[mesh.material[c]];
          const double volume           = mesh.cell_volume(c);
          found[b].mass += volume * density.mean(mesh, c, material.density);
          if (material.is_rigid())
            rigid_volume[b] += volume;
        }
    // (rounding may put a sliver of a block beyond a material's boundary)
    for (unsigned int b = 0; b < found.size(); ++b)
      found[b].is_rigid = rigid_volume[b] > planes.options.dust;
    for (Block<dim> &block : found)
      if (block.is_rigid)
        {
          block.is_infinite = true;
          std::fill(block.class_of_stage.begin(),
                    block.class_of_stage.end(),
                    BlockClass::rigid);
        }
    Blocks<dim> result;
    result.n_stages      = planes.n_stages;
    result.blocks        = found;
    result.block_of_cell = split.block_of_cell;
    measure_widths(result, mesh, scene);
    return result;
  }

#define INSTANTIATE(dim)                                                       \
  template SplitMesh<dim> make_plane_mesh(const PlaneBlocks<dim> &,            \
                                          const Scene<dim> &);                 \
  template Blocks<dim> list_plane_blocks(const PlaneBlocks<dim> &,             \
                                         const Scene<dim> &,                   \
                                         const SplitMesh<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

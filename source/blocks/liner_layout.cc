// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/numerics/rtree.h>

#include <keyblock/blocks/excavation_parts.h>
#include <keyblock/blocks/lined_faces.h>
#include <keyblock/blocks/liner_layout.h>
#include <keyblock/blocks/nodal_areas.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace Keyblock
{
  template <int dim>
  std::vector<CellFace>
  list_excavation_faces(const Ground<dim> &ground,
                        const std::vector<std::string> &names)
  {
    const Mesh<dim> &mesh = ground.split.mesh;
    std::vector<CellFace> found;
    for (const CellFace &f : list_free_faces(ground))
      {
        if (mesh.boundary[f.cell][f.face] != none)
          continue;
        const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
        const double depth = 1e-3 * std::pow(area.norm(), 1. / (dim - 1));
        const Point<dim> outside =
          mesh.face_center(f.cell, f.face) + depth / area.norm() * area;
        const unsigned int across = mesh.neighbor[f.cell][f.face];
        for (unsigned int e = 0; e < ground.scene.excavations.size(); ++e)
          {
            const auto &excavation = *ground.scene.excavations[e];
            if (std::find(names.begin(), names.end(), excavation.name) ==
                names.end())
              continue;
            if ((across != none && mesh.excavation_stage[across] > 0 &&
                 mesh.excavation[across] == e) ||
                (excavation.has_outline() &&
                 depth_inside(excavation, outside) > 0.))
              {
                found.push_back(f);
                break;
              }
          }
      }
    return found;
  }



  namespace
  {
    /** Its faces: of its parts and its region. */
    template <int dim>
    std::vector<CellFace>
    list_lined_faces(const Liner &liner, const Ground<dim> &ground)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      std::unique_ptr<Expression<dim>> region;
      if (!liner.region.empty())
        region = std::make_unique<Expression<dim>>(
          liner.region, 1, "Shotcrete/" + liner.name + "/Region");
      std::vector<CellFace> faces =
        list_excavation_faces(ground, liner.excavations);
      const Tensor<1, dim> up = upward(ground.scene);
      faces.erase(
        std::remove_if(
          faces.begin(),
          faces.end(),
          [&](const CellFace &f) {
            const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
            return !is_of_parts<dim>(-area / area.norm(), up, liner.parts) ||
                   (region &&
                    region->value(mesh.face_center(f.cell, f.face), 0., 0) <=
                      0.);
          }),
        faces.end());
      AssertThrow(!faces.empty(),
                  InputError("The shotcrete 'Shotcrete/" + liner.name +
                             "' has no place: after stage '" + liner.stage +
                             "' there is no free face of its excavations, "
                             "'Parts' and 'Region'; correct these, or its "
                             "'Stage'."));
      return faces;
    }

    /** Rims of a face: its vertices in 2D, its edges in 3D. */
    template <int dim>
    std::vector<std::vector<unsigned int>>
    rims_of(const typename Mesh<dim>::FaceVertices &v)
    {
      if constexpr (dim == 2)
        return {{v[0]}, {v[1]}};
      else
        return {{v[0], v[1]}, {v[1], v[3]}, {v[3], v[2]}, {v[2], v[0]}};
    }

    /** A rim of a lined face and what it is of. */
    template <int dim>
    struct Rim
    {
      std::vector<unsigned int> vertices; ///< in the order of their groups
      unsigned int block, cell;
      Tensor<1, dim> outward; ///< unit normal of the face
    };

    /** Normal of the section along the rim of two faces. */
    template <int dim>
    Tensor<1, dim>
    normal_of_section(const std::vector<Point<dim>> &places,
                      const Rim<dim> &a,
                      const Rim<dim> &b)
    {
      const Tensor<1, dim> out = a.outward + b.outward;
      Tensor<1, dim> across;
      if constexpr (dim == 2)
        across = dealii::cross_product_2d(out);
      else
        across = dealii::cross_product_3d(out,
                                          places[a.vertices.back()] -
                                            places[a.vertices.front()]);
      return across.norm() > 0. ? across / across.norm() : across;
    }

    /** Add the trace where the rims of two blocks lie on each other. */
    template <int dim>
    void
    add_trace(const std::vector<Point<dim>> &places,
              const Rim<dim> &a,
              const Rim<dim> &b,
              std::vector<LinerTrace<dim>> &traces)
    {
      const double share = dim == 2 ? 1.
                                    : 0.5 * places[a.vertices.front()].distance(
                                              places[a.vertices.back()]);
      for (unsigned int i = 0; i < a.vertices.size(); ++i)
        if (a.vertices[i] != b.vertices[i]) // not at the tip of a joint
          traces.push_back({{{a.vertices[i], b.vertices[i]}},
                            {{a.block, b.block}},
                            {{a.cell, b.cell}},
                            none,
                            share,
                            normal_of_section(places, a, b)});
    }

    /** Tell traces their joints. */
    template <int dim>
    void
    find_joints(const std::vector<Pair<dim>> &pairs,
                std::vector<LinerTrace<dim>> &traces)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> joints;
      for (const Pair<dim> &pair : pairs)
        joints.emplace(std::minmax(pair.minus, pair.plus), pair.joint);
      for (LinerTrace<dim> &trace : traces)
        if (const auto found =
              joints.find(std::minmax(trace.vertex[0], trace.vertex[1]));
            found != joints.end())
          trace.joint = found->second;
    }

    template <int dim>
    std::vector<LinerTrace<dim>>
    find_traces(const SplitMesh<dim> &split, const std::vector<CellFace> &faces)
    {
      const std::vector<unsigned int> group = groups_of_vertices(split);
      std::map<std::vector<unsigned int>, std::vector<Rim<dim>>> rims;
      for (const CellFace &f : faces)
        for (std::vector<unsigned int> vertices :
             rims_of<dim>(split.mesh.face_vertices(f.cell, f.face)))
          {
            std::sort(vertices.begin(),
                      vertices.end(),
                      [&](const unsigned int v, const unsigned int w) {
                        return group[v] < group[w];
                      });
            std::vector<unsigned int> place;
            for (const unsigned int v : vertices)
              place.push_back(group[v]);
            const Tensor<1, dim> area =
              split.mesh.face_area_vector(f.cell, f.face);
            if (std::find(place.begin(), place.end(), none) == place.end())
              rims[place].push_back({vertices,
                                     split.block_of_cell[f.cell],
                                     f.cell,
                                     area / area.norm()});
          }
      std::vector<LinerTrace<dim>> traces;
      for (const auto &[place, here] : rims)
        for (unsigned int i = 0; i < here.size(); ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (here[i].block != here[j].block)
              add_trace<dim>(split.mesh.vertices, here[j], here[i], traces);
      find_joints(split.interface.pairs, traces);
      return traces;
    }
    /** An edge of a lined face, in 2D an end of one. */
    template <int dim>
    struct Edge
    {
      Point<dim> begin, end;
      unsigned int cell;
      Tensor<1, dim> outward; ///< unit normal of the face

      /** Length of what it has in common with another one, and its middle; in
       * 2D 1 for the same point. */
      std::pair<double, Point<dim>>
      overlap(const Edge &other) const
      {
        constexpr double near = 1e-6; // over the length of the edge
        if constexpr (dim == 2)
          return {begin.distance(other.begin) <=
                    near * (other.end - other.begin).norm(),
                  begin};
        else
          {
            const double length      = begin.distance(end);
            const Tensor<1, 3> along = (end - begin) / length;
            double low = length, high = 0.;
            for (const Point<3> &p : {other.begin, other.end})
              {
                const double place = (p - begin) * along;
                if ((p - begin - place * along).norm() > near * length)
                  return {0., begin};
                low  = std::min(low, place);
                high = std::max(high, place);
              }
            low  = std::max(low, 0.);
            high = std::min(high, length);
            return {high - low > near * length ? high - low : 0.,
                    begin + 0.5 * (low + high) * along};
          }
      }
    };

    template <int dim>
    std::vector<Edge<dim>>
    list_edges(const Mesh<dim> &mesh, const std::vector<CellFace> &faces)
    {
      std::vector<Edge<dim>> edges;
      for (const CellFace &f : faces)
        {
          const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
          const auto v              = mesh.face_vertices(f.cell, f.face);
          const std::vector<unsigned int> around =
            dim == 2 ? std::vector<unsigned int>{v[0], v[1]}
                     : std::vector<unsigned int>{v[0], v[1], v.back(), v[2]};
          for (unsigned int i = 0; i < around.size(); ++i)
            if (const unsigned int next = around[(i + 1) % around.size()];
                mesh.vertices[around[i]].distance(mesh.vertices[next]) > 0.)
              edges.push_back({mesh.vertices[around[i]],
                               mesh.vertices[next],
                               f.cell,
                               area / area.norm()});
        }
      return edges;
    }

    /** The traces of joints on a mesh between planes, whose faces have edges
     * that are parts of others. */
    template <int dim>
    std::vector<LinerTrace<dim>>
    find_traces_between_planes(const Scene<dim> &scene,
                               const SplitMesh<dim> &split,
                               const std::vector<CellFace> &faces)
    {
      std::map<std::pair<unsigned int, unsigned int>, std::set<unsigned int>>
        joints; // between two blocks
      for (const JointFace &face : split.interface.joint_faces)
        joints[std::minmax(split.block_of_cell[face.minus_cell],
                           split.block_of_cell[face.plus_cell])]
          .insert(face.joint);
      const std::vector<Edge<dim>> edges = list_edges(split.mesh, faces);
      std::vector<LinerTrace<dim>> traces;
      const auto add_trace = [&](const Edge<dim> &a, const Edge<dim> &b) {
        const unsigned int own   = split.block_of_cell[a.cell],
                           other = split.block_of_cell[b.cell];
        const auto between       = joints.find(std::minmax(own, other));
        if (own == other || between == joints.end())
          return;
        const auto [length, middle] = a.overlap(b);
        if (length == 0.)
          return;
        unsigned int joint = none;
        for (const unsigned int j : between->second)
          if (joint == none ||
              std::abs(scene.joints[j]->distance(middle)) <
                std::abs(scene.joints[joint]->distance(middle)))
            joint = j;
        const Tensor<1, dim> out = a.outward + b.outward;
        Tensor<1, dim> across;
        if constexpr (dim == 2)
          across = cross_product_2d(out);
        else
          across = cross_product_3d(out, a.end - a.begin);
        if (across.norm() > 0.)
          across /= across.norm();
        traces.push_back({{{none, none}},
                          {{own, other}},
                          {{a.cell, b.cell}},
                          joint,
                          length,
                          across});
      };
      using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;
      std::vector<Entry> boxes;
      for (unsigned int e = 0; e < edges.size(); ++e)
        boxes.emplace_back(dealii::BoundingBox<dim>(std::vector<Point<dim>>{
                             edges[e].begin,
                             dim == 2 ? edges[e].begin : edges[e].end}),
                           e);
      const auto tree = dealii::pack_rtree(boxes);
      for (unsigned int e = 0; e < edges.size(); ++e)
        {
          dealii::BoundingBox<dim> box = boxes[e].first;
          box.extend(1e-6 * edges[e].begin.distance(edges[e].end));
          std::vector<Entry> near;
          tree.query(boost::geometry::index::intersects(box),
                     std::back_inserter(near));
          std::sort(near.begin(),
                    near.end(),
                    [](const Entry &a, const Entry &b) {
                      return a.second < b.second;
                    });
          for (const Entry &entry : near)
            if (entry.second < e)
              add_trace(edges[entry.second], edges[e]);
        }
      return traces;
    }
  } // namespace



  template <int dim>
  std::vector<LaidLiner<dim>>
  lay_out_liners(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    std::vector<LaidLiner<dim>> liners;
    for (unsigned int i = 0; i < scene.liners.size(); ++i)
      {
        const Liner &liner = *scene.liners[i];
        const Ground<dim> ground{scene, split, scene.stage_number(liner.stage)};
        const std::vector<CellFace> faces = list_lined_faces(liner, ground);
        liners.push_back({split.is_between_planes
                            ? find_traces_between_planes(scene, split, faces)
                            : find_traces(split, faces),
                          {},
                          {}});
        if (liner.is_structural() && !split.is_between_planes)
          liners.back().faces = lay_out_faces(scene, split, i, faces);
        for (const CellFace &f : faces)
          {
            const auto areas    = nodal_areas(split.mesh, f.cell, f.face);
            const auto vertices = split.mesh.face_vertices(f.cell, f.face);
            for (unsigned int v = 0; v < vertices.size(); ++v)
              liners.back().areas.push_back(
                {vertices[v], split.block_of_cell[f.cell], f.cell, areas[v]});
          }
      }
    return liners;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<CellFace> list_excavation_faces(                        \
    const Ground<dim> &, const std::vector<std::string> &);                    \
  template std::vector<LaidLiner<dim>> lay_out_liners(const Scene<dim> &,      \
                                                      const SplitMesh<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// What a block touches, weighs and bears: input of limit equilibrium.
#include <keyblock/base/expression.h>
#include <keyblock/blocks/nodal_areas.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/block_faces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Keyblock
{
  template <int dim>
  Tensor<1, dim>
  sum_of(const std::vector<PointForce<dim>> &forces)
  {
    Tensor<1, dim> sum;
    for (const PointForce<dim> &force : forces)
      sum += force.force;
    return sum;
  }



  template <int dim>
  std::vector<PointForce<dim>>
  BlockLoads<dim>::all() const
  {
    std::vector<PointForce<dim>> list = {{centroid, weight + seismic}};
    list.insert(list.end(), tractions.begin(), tractions.end());
    list.insert(list.end(), water.begin(), water.end());
    return list;
  }



  namespace
  {
    /** Distance of faces that touch, and cosine of the angle between them, over
     * the size of a face, and up to which they face each other [-]. */
    constexpr double touching = 1e-6, opposed = -0.999;
    constexpr double degree = dealii::numbers::PI / 180.;

    /** The faces of one block, filled one face of a cell after the other. */
    template <int dim>
    class Collector
    {
    public:
      Collector(const Ground<dim> &ground,
                const Block<dim> &block,
                const double time)
        : ground(ground)
        , mesh(ground.split.mesh)
        , block(block)
        , index(block.id - 1)
        , time(time)
        , pressure(ground.scene.joints.size())
      {}

      void
      add_joint_face(const JointFace &face)
      {
        const auto &block_of_cell = ground.split.block_of_cell;
        const bool is_plus        = block_of_cell[face.plus_cell] == index;
        // (some only the mesh has)
        if ((block_of_cell[face.minus_cell] == index) == is_plus ||
            ground.is_excavated(face.minus_cell) ||
            ground.is_excavated(face.plus_cell) ||
            (block.exact.is_known && block.area_ratio(face.joint) == 0.))
          return;
        const Joint<dim> &joint  = *ground.scene.joints[face.joint];
        const CellFace own       = is_plus
                                     ? CellFace{face.plus_cell, face.plus_face}
                                     : CellFace{face.minus_cell, face.minus_face};
        const unsigned int entry = joint_entry(face.joint, is_plus);
        const Tensor<1, dim> inward =
          (is_plus ? 1. : -1.) *
          mesh.face_area_vector(face.minus_cell, face.minus_face);
        BlockFace<dim> &into = result.faces[entry];
        const double across  = std::abs(inward * into.inward);
        const double area    = block.exact.is_known
                                 ? block.area_ratio(face.joint) * inward.norm()
                                 : across;
        add_area(entry,
                 own,
                 area,
                 block_of_cell[is_plus ? face.minus_cell : face.plus_cell]);
        const double bend =
          std::acos(std::min(1., across / inward.norm())) / degree;
        if (bend > result.largest_bend)
          {
            result.largest_bend = bend;
            result.bent         = joint.name;
          }
        if (const auto *pressure = pressure_in(face.joint))
          add_water(*pressure,
                    own,
                    block.exact.is_known ? area * into.inward : inward,
                    into);
      }

      /** Faces on joints that cut corners off which the mesh has left on. */
      void
      add_faces_without_mesh()
      {
        for (const auto &[joint, area] : block.exact.joint_area)
          if (area > 0. && block.exact.bent_area.at(joint) == 0.)
            result
              .faces[joint_entry(joint,
                                 ground.scene.joints[joint]->distance(
                                   block.centroid) > 0.)]
              .area += area;
      }

      /** Put the faces into the order of the joints. */
      void
      sort_faces()
      {
        BlockSurroundings<dim> sorted = result;
        sorted.faces.clear();
        sorted.others.clear();
        for (auto &[key, entry] : entries)
          {
            sorted.faces.push_back(result.faces[entry]);
            sorted.others.push_back(result.others[entry]);
            entry = sorted.faces.size() - 1;
          }
        result = sorted;
      }

      /** Tell apart what stays joined to the block, and look for what lies
       * against its free faces. */
      void
      add_other_faces(const FreeFaces<dim> &free)
      {
        for (const unsigned int c : free.cells_of_block(index))
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (const unsigned int other = mesh.neighbor[c][f];
                other != none && ground.split.block_of_cell[other] != index &&
                !ground.is_excavated(other))
              (ground.is_filled(other) ? result.is_on_fill
                                       : result.is_attached) = true;
        for (const unsigned int i : free.of_block(index))
          add_touching_face(free, free.faces[i]);
      }

      /** Its faces close a surface: what the joints leave is free. */
      void
      measure_free_area(const FreeFaces<dim> &free)
      {
        if (!block.exact.is_known || result.is_attached || result.is_on_fill)
          return;
        Tensor<1, dim> between_planes, in_mesh;
        for (const auto &[key, entry] : entries)
          between_planes +=
            result.faces[entry].area * result.faces[entry].inward;
        for (const unsigned int i : free.of_block(index))
          in_mesh +=
            mesh.face_area_vector(free.faces[i].cell, free.faces[i].face);
        const double ratio = between_planes * in_mesh / in_mesh.norm_square();
        result.free_area_ratio = ratio > 0. ? ratio : 1.;
      }

      BlockSurroundings<dim> result;

    private:
      unsigned int
      new_entry(const Tensor<1, dim> &inward,
                const std::string &name,
                const std::shared_ptr<const JointLaw> &law)
      {
        const StrengthEnvelope strength = law->envelope(JointPointState());
        BlockFace<dim> face;
        face.inward           = inward;
        face.name             = name;
        face.tangent_friction = strength.static_tangent;
        face.cohesion         = strength.cohesion;
        face.tensile_strength = strength.tensile_strength;
        if (law->depends_on_pressure())
          face.law = law;
        result.faces.push_back(face);
        result.others.emplace_back();
        return result.faces.size() - 1;
      }

      unsigned int
      joint_entry(const unsigned int j, const bool is_plus)
      {
        const auto found = entries.find({j, is_plus});
        if (found != entries.end())
          return found->second;
        const Joint<dim> &joint = *ground.scene.joints[j];
        const unsigned int entry =
          new_entry((is_plus ? 1. : -1.) * joint.normal(),
                    joint.name,
                    make_joint_law(joint));
        return entries[{j, is_plus}] = entry;
      }

      void
      add_area(const unsigned int entry,
               const CellFace &own,
               const double area,
               const unsigned int other)
      {
        result.faces[entry].area += area;
        for (const unsigned int v : mesh.face_vertices(own.cell, own.face))
          result.faces[entry].vertices.push_back(mesh.vertices[v]);
        if (other != none)
          result.others[entry].insert(other);
      }

      /** The pressure of water in a joint, or none. */
      const Expression<dim> *
      pressure_in(const unsigned int joint)
      {
        const std::string formula =
          ground.scene.water_pressure(joint, ground.stage_number);
        if (formula.empty())
          return nullptr;
        if (!pressure[joint])
          pressure[joint] =
            std::make_unique<Expression<dim>>(formula,
                                              1,
                                              "Joints/*/Water pressure");
        return pressure[joint].get();
      }

      /** The water beside a face with the vector area @p inward. */
      void
      add_water(const Expression<dim> &pressure,
                const CellFace &own,
                const Tensor<1, dim> &inward,
                BlockFace<dim> &into)
      {
        const auto areas    = nodal_areas(mesh, own.cell, own.face);
        const auto vertices = mesh.face_vertices(own.cell, own.face);
        const double sum    = std::accumulate(areas.begin(), areas.end(), 0.);
        for (unsigned int i = 0; i < vertices.size(); ++i)
          {
            const Point<dim> &place = mesh.vertices[vertices[i]];
            const Tensor<1, dim> force =
              pressure.value(place, time, 0) * areas[i] / sum * inward;
            result.loads.water.push_back({place, force});
            into.water_force += force * into.inward;
            result.loads.water_along +=
              force - (force * into.inward) * into.inward;
          }
      }

      void
      add_touching_face(const FreeFaces<dim> &free, const CellFace &own)
      {
        const Tensor<1, dim> area = mesh.face_area_vector(own.cell, own.face);
        const Tensor<1, dim> outward = area / area.norm();
        const double reach = touching * std::pow(area.norm(), 1. / (dim - 1));
        const auto meeting = free.first_ahead(
          mesh.face_center(own.cell, own.face), outward, reach, reach, index);
        if (!meeting)
          return;
        const CellFace &other = meeting->face;
        const Tensor<1, dim> across =
          mesh.face_area_vector(other.cell, other.face);
        if (across * outward > opposed * across.norm())
          return;
        unsigned int entry = entries.size();
        while (entry < result.faces.size() &&
               (result.faces[entry].inward + outward).norm() > touching)
          ++entry;
        if (entry == result.faces.size())
          new_entry(-outward,
                    "a free face",
                    make_friction_law(
                      ground.scene.contact.default_friction_angle));
        add_area(entry,
                 own,
                 area.norm(),
                 ground.split.block_of_cell[other.cell]);
        result.has_free_face = true;
      }

      const Ground<dim> &ground;
      const Mesh<dim> &mesh;
      const Block<dim> &block;
      const unsigned int index;
      const double time;
      std::vector<std::unique_ptr<Expression<dim>>> pressure; ///< by joint

      /** Of faces, by joint and side; free faces come after them. */
      std::map<std::pair<unsigned int, bool>, unsigned int> entries;
    };

    /** Present mass over that of the materials of the start [-]. */
    template <int dim>
    double
    mass_ratio(const Ground<dim> &ground,
               const std::vector<unsigned int> &cells)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      if (mesh.later_materials.empty())
        return 1.;
      double now = 0., first = 0.;
      for (const unsigned int c : cells)
        {
          const auto &materials = ground.scene.materials;
          const double volume   = mesh.cell_volume(c);
          now += volume * materials[ground.material_of(c)]->density;
          first += volume * materials[mesh.material[c]]->density;
        }
      return now / first;
    }

    template <int dim>
    void
    add_body_forces(const Ground<dim> &ground,
                    const FreeFaces<dim> &free,
                    const Block<dim> &block,
                    const double time,
                    BlockLoads<dim> &loads)
    {
      const Scene<dim> &scene = ground.scene;
      const double mass       = block.exact_mass() *
                          mass_ratio(ground, free.cells_of_block(block.id - 1));
      loads.centroid = block.centroid;
      if (!scene.initial_state.gravity.empty())
        loads.weight = mass * Expression<dim>(scene.initial_state.gravity,
                                              dim,
                                              "Initial state/Gravity")
                                .vector(Point<dim>(), time);
      loads.seismic = mass * seismic_acceleration(ground);
    }

    template <int dim>
    void
    add_tractions(const Ground<dim> &ground,
                  const FreeFaces<dim> &free,
                  const unsigned int block,
                  const double time,
                  BlockSurroundings<dim> &around)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      std::vector<CellFace> own;
      for (const unsigned int i : free.of_block(block))
        own.push_back(free.faces[i]);
      for (const auto &traction : ground.scene.tractions)
        {
          const Expression<dim> value(traction->expression,
                                      dim,
                                      "Tractions/*/Traction");
          for (const CellFace &f : list_loaded_faces(ground, own, *traction))
            {
              const Point<dim> center = mesh.face_center(f.cell, f.face);
              around.loads.tractions.push_back(
                {center,
                 around.free_area_ratio *
                   mesh.face_area_vector(f.cell, f.face).norm() *
                   value.vector(center, time)});
            }
        }
    }
  } // namespace



  template <int dim>
  BlockSurroundings<dim>
  look_around(const Ground<dim> &ground,
              const FreeFaces<dim> &free,
              const Block<dim> &block,
              const double time)
  {
    Collector<dim> collector(ground, block, time);
    for (const unsigned int i : free.joint_faces_of_block(block.id - 1))
      collector.add_joint_face(ground.split.interface.joint_faces[i]);
    collector.add_faces_without_mesh();
    collector.sort_faces();
    collector.add_other_faces(free);
    collector.measure_free_area(free);
    add_body_forces(ground, free, block, time, collector.result.loads);
    add_tractions(ground, free, block.id - 1, time, collector.result);
    return collector.result;
  }

#define INSTANTIATE(dim)                                                       \
  template struct BlockLoads<dim>;                                             \
  template Tensor<1, dim> sum_of(const std::vector<PointForce<dim>> &);        \
  template BlockSurroundings<dim> look_around(const Ground<dim> &,             \
                                              const FreeFaces<dim> &,          \
                                              const Block<dim> &,              \
                                              const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

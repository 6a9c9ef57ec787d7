// SPDX-License-Identifier: LGPL-2.1-or-later
// What a block touches, weighs and bears: input of limit equilibrium.
#include <keyblock/base/expression.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/block_faces.h>
#include <keyblock/safety/reduced_joints.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
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
        , reduced(list_reduced_joints(ground.scene))
      {}

      void
      add_joint_face(const JointFace &face)
      {
        const auto &block_of_cell = ground.split.block_of_cell;
        const bool is_plus        = block_of_cell[face.plus_cell] == index;
        if ((block_of_cell[face.minus_cell] == index) == is_plus)
          return;
        if (ground.is_excavated(face.minus_cell) ||
            ground.is_excavated(face.plus_cell))
          return;
        const CellFace own       = is_plus
                                     ? CellFace{face.plus_cell, face.plus_face}
                                     : CellFace{face.minus_cell, face.minus_face};
        const unsigned int entry = joint_entry(face.joint, is_plus);
        const Tensor<1, dim> inward =
          (is_plus ? 1. : -1.) *
          mesh.face_area_vector(face.minus_cell, face.minus_face);
        add_area(entry,
                 own,
                 std::abs(inward * result.faces[entry].inward),
                 block_of_cell[is_plus ? face.minus_cell : face.plus_cell]);
        if (pressure_in(face.joint))
          wet_faces.push_back({face.joint,
                               is_plus,
                               face_corners(mesh, own.cell, own.face),
                               inward / inward.norm()});
      }

      void
      add_water()
      {
        for (const WetFace &face : wet_faces)
          add_pressure(face.joint,
                       face.corners,
                       face.inward,
                       result.faces[entries.at({face.joint, face.is_plus})]);
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

      BlockSurroundings<dim> result;

    private:
      unsigned int
      new_entry(const Tensor<1, dim> &inward,
                const std::string &name,
                const std::shared_ptr<const JointLaw> &law,
                const unsigned int joint)
      {
        result.faces.push_back(make_block_face<dim>(
          inward, name, law, joint, has_reduced(reduced, joint)));
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
                    make_joint_law(joint),
                    j);
        return entries[{j, is_plus}] = entry;
      }

      void
      add_area(const unsigned int entry,
               const CellFace &own,
               const double area,
               const unsigned int other)
      {
        BlockFace<dim> &face = result.faces[entry];
        face.area += area;
        for (const unsigned int v : mesh.face_vertices(own.cell, own.face))
          face.vertices.push_back(mesh.vertices[v]);
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

      /** The water beside a face of a joint: see pressure_on(). */
      void
      add_pressure(const unsigned int joint,
                   const FaceCorners<dim> &corners,
                   const Tensor<1, dim> &inward,
                   BlockFace<dim> &into)
      {
        for (const PointForce<dim> &water :
             pressure_on(corners, *pressure_in(joint), time, inward))
          {
            result.loads.water.push_back(water);
            into.water_force += water.force * into.inward;
            result.loads.water_along +=
              water.force - (water.force * into.inward) * into.inward;
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
                      ground.scene.contact.default_friction_angle),
                    none);
        add_area(entry,
                 own,
                 area.norm(),
                 ground.split.block_of_cell[other.cell]);
        result.has_free_face = true;
      }

      /** A face on a joint that holds water. */
      struct WetFace
      {
        unsigned int joint;
        bool is_plus; ///< the block is on the joint's positive side
        FaceCorners<dim> corners;
        Tensor<1, dim> inward; ///< see pressure_on()
      };

      const Ground<dim> &ground;
      const Mesh<dim> &mesh;
      const Block<dim> &block;
      const unsigned int index;
      const double time;
      std::vector<std::unique_ptr<Expression<dim>>> pressure; ///< by joint
      const std::vector<bool> reduced; ///< joints, list_reduced_joints()
      std::vector<WetFace> wet_faces;

      /** Of faces, by joint and side; free faces come after them. */
      std::map<std::pair<unsigned int, bool>, unsigned int> entries;
    };
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
    collector.add_water();
    collector.sort_faces();
    collector.add_other_faces(free);
    BlockLoads<dim> &loads = collector.result.loads;
    BlockLoads<dim> body   = body_forces_on(ground, free, block, time);
    body.water             = loads.water;
    body.water_along       = loads.water_along;
    body.tractions         = tractions_on(ground, free, block.id - 1, time);
    loads                  = body;
    return collector.result;
  }

#define INSTANTIATE(dim)                                                       \
  template BlockSurroundings<dim> look_around(const Ground<dim> &,             \
                                              const FreeFaces<dim> &,          \
                                              const Block<dim> &,              \
                                              const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

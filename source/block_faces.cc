// SPDX-License-Identifier: LGPL-2.1-or-later
// What a block touches, weighs and bears: input of limit equilibrium.
#include <keyblock/block_faces.h>
#include <keyblock/expression.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  template <int dim>
  std::vector<BlockFace<dim>>
  list_faces(const Scene<dim> &scene,
             const SplitMesh<dim> &split,
             const Conditions<dim> &conditions,
             const Block<dim> &block)
  {
    const unsigned int index = block.id - 1;
    // one face per joint and side
    std::map<std::pair<unsigned int, bool>, BlockFace<dim>> faces;
    const Mesh<dim> &mesh = split.mesh;
    for (const JointFace &face : split.interface.joint_faces)
      {
        const bool is_plus = split.block_of_cell[face.plus_cell] == index;
        if ((split.block_of_cell[face.minus_cell] == index) == is_plus)
          continue;
        if (conditions.is_dug(face.minus_cell) ||
            conditions.is_dug(face.plus_cell))
          continue;
        const Joint<dim> &joint = *scene.joints[face.joint];
        BlockFace<dim> &entry   = faces[{face.joint, is_plus}];
        const double area =
          block.area_ratio(face.joint) *
          mesh.face_area_vector(face.minus_cell, face.minus_face).norm();
        entry.inward = (is_plus ? 1. : -1.) * joint.normal();
        entry.area += area;
        entry.tangent_friction =
          std::tan(joint.friction_angle * dealii::numbers::PI / 180.);
        entry.cohesion = joint.cohesion;
        entry.name     = joint.name;
        if (!joint.water_pressure.empty())
          entry.water_force +=
            area *
            Expression<dim>(joint.water_pressure,
                            1,
                            "Joints/" + joint.name + "/Water pressure")
              .value(mesh.face_center(face.minus_cell, face.minus_face), 0., 0);
      }
    std::vector<BlockFace<dim>> list;
    for (const auto &[key, face] : faces)
      list.push_back(face);
    return list;
  }



  template <int dim>
  Tensor<1, dim>
  weight_of(const Scene<dim> &scene, const Block<dim> &block, const double time)
  {
    Tensor<1, dim> acceleration;
    if (!scene.initial_state.gravity.empty())
      acceleration = Expression<dim>(scene.initial_state.gravity,
                                     dim,
                                     "Initial state/Gravity")
                       .vector(block.centroid, time);
    for (unsigned int d = 0; d < scene.safety.seismic_coefficient.size(); ++d)
      acceleration[d] += 9.81 * scene.safety.seismic_coefficient[d];
    return block.exact_mass() * acceleration;
  }



  template <int dim>
  double
  stress_ratio(const Scene<dim> &scene,
               const std::vector<BlockFace<dim>> &faces,
               const std::vector<unsigned int> &sliding,
               const std::vector<JointSums<dim>> &sums)
  {
    double strength = 0.;
    Vector<dim> shear{};
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        if (!sliding.empty() &&
            std::find(sliding.begin(), sliding.end(), i) == sliding.end())
          continue;
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          if (scene.joints[j]->name == faces[i].name)
            {
              double normal = 0.;
              for (unsigned int d = 0; d < dim; ++d)
                normal += sums[j].force[d] * faces[i].inward[d];
              for (unsigned int d = 0; d < dim; ++d)
                shear[d] += sums[j].force[d] - normal * faces[i].inward[d];
              strength += faces[i].cohesion * faces[i].area +
                          faces[i].tangent_friction * normal;
            }
      }
    const double force = norm<dim>(shear);
    return force > 0. && strength > 0. ? strength / force : 0.;
  }

  template std::vector<BlockFace<2>> list_faces<2>(const Scene<2> &,
                                                   const SplitMesh<2> &,
                                                   const Conditions<2> &,
                                                   const Block<2> &);
  template Tensor<1, 2>
  weight_of<2>(const Scene<2> &, const Block<2> &, const double);
  template double stress_ratio<2>(const Scene<2> &,
                                  const std::vector<BlockFace<2>> &,
                                  const std::vector<unsigned int> &,
                                  const std::vector<JointSums<2>> &);
  template std::vector<BlockFace<3>> list_faces<3>(const Scene<3> &,
                                                   const SplitMesh<3> &,
                                                   const Conditions<3> &,
                                                   const Block<3> &);
  template Tensor<1, 3>
  weight_of<3>(const Scene<3> &, const Block<3> &, const double);
  template double stress_ratio<3>(const Scene<3> &,
                                  const std::vector<BlockFace<3>> &,
                                  const std::vector<unsigned int> &,
                                  const std::vector<JointSums<3>> &);
} // namespace Keyblock

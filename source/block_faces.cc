// SPDX-License-Identifier: LGPL-2.1-or-later
// What a block touches, weighs and bears: input of limit equilibrium.
#include <keyblock/block_faces.h>
#include <keyblock/expression.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <ostream>

namespace Keyblock
{
  template <int dim>
  std::vector<BlockFace<dim>>
  list_faces(const Scene<dim> &scene,
             const SplitMesh<dim> &split,
             const IsDug &is_dug,
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
        if (is_dug(face.minus_cell) || is_dug(face.plus_cell))
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
          {
            const Expression<dim> pressure(joint.water_pressure,
                                           1,
                                           "Joints/" + joint.name +
                                             "/Water pressure");
            for (const unsigned int v :
                 mesh.face_vertices(face.minus_cell, face.minus_face))
              entry.water_force += area / Mesh<dim>::n_face_vertices *
                                   pressure.value(mesh.vertices[v], 0., 0);
          }
      }
    std::vector<BlockFace<dim>> list;
    for (const auto &[key, face] : faces)
      list.push_back(face);
    return list;
  }



  namespace
  {
    template <int dim>
    Tensor<1, dim>
    weight_of(const Scene<dim> &scene,
              const Block<dim> &block,
              const double time)
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

    /** Call @p action(cell, face) for the free faces of a block. */
    template <int dim, typename Action>
    void
    for_each_free_face(const SplitMesh<dim> &split,
                       const IsDug &is_dug,
                       const Block<dim> &block,
                       const Action &action)
    {
      const Mesh<dim> &mesh = split.mesh;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (split.block_of_cell[c] == block.id - 1 && !is_dug(c))
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              const unsigned int other = mesh.neighbor[c][f];
              // faces on joints have rock behind them
              if ((other == none && mesh.joint[c][f] == none) ||
                  (other != none && is_dug(other)))
                action(c, f);
            }
    }

    template <int dim>
    Tensor<1, dim>
    tractions_on(const Scene<dim> &scene,
                 const SplitMesh<dim> &split,
                 const IsDug &is_dug,
                 const Block<dim> &block,
                 const unsigned int number,
                 const double time)
    {
      Tensor<1, dim> sum;
      const Mesh<dim> &mesh = split.mesh;
      for (const auto &traction : scene.tractions)
        {
          if (scene.stage_number(traction->stage) > number)
            continue;
          const Expression<dim> inside(traction->region.empty()
                                         ? "-1"
                                         : traction->region,
                                       1,
                                       "Tractions/*/Region");
          const Expression<dim> force(traction->expression,
                                      dim,
                                      "Tractions/*/Traction");
          for_each_free_face(split,
                             is_dug,
                             block,
                             [&](const unsigned int c, const unsigned int f) {
                               const Point<dim> center = mesh.face_center(c, f);
                               bool is_loaded =
                                 inside.value(center, 0., 0) > 0.;
                               for (const std::string &name :
                                    traction->boundaries)
                                 is_loaded =
                                   is_loaded || mesh.is_on(c, f, name);
                               if (is_loaded)
                                 sum += mesh.face_area_vector(c, f).norm() *
                                        force.vector(center, time);
                             });
        }
      return sum;
    }

    /** Whether a support holds a free face of the block, which limit
     * equilibrium does not know. */
    template <int dim>
    bool
    is_supported(const Scene<dim> &scene,
                 const SplitMesh<dim> &split,
                 const IsDug &is_dug,
                 const Block<dim> &block)
    {
      bool result = false;
      for (const auto &support : scene.supports)
        for_each_free_face(split,
                           is_dug,
                           block,
                           [&](const unsigned int c, const unsigned int f) {
                             for (const std::string &name : support->boundaries)
                               result = result || split.mesh.is_on(c, f, name);
                           });
      return result;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  load_on(const Scene<dim> &scene,
          const SplitMesh<dim> &split,
          const IsDug &is_dug,
          const Block<dim> &block,
          const unsigned int number,
          const double time)
  {
    return weight_of(scene, block, time) +
           tractions_on(scene, split, is_dug, block, number, time);
  }



  template <int dim>
  void
  print_limit_equilibria(std::ostream &out,
                         const Scene<dim> &scene,
                         const SplitMesh<dim> &split,
                         const Blocks<dim> &blocks)
  {
    for (unsigned int s = 0; s < scene.stages.size(); ++s)
      {
        const unsigned int number = s + 2;
        const auto is_dug         = [&](const unsigned int c) {
          const unsigned int stage = split.mesh.excavation_stage[c];
          return stage != 0 && stage <= number;
        };
        for (const Block<dim> &block : blocks.blocks)
          {
            const auto &classes = block.class_of_stage;
            if (block.is_infinite || block.is_rigid ||
                classes[std::min<std::size_t>(number, classes.size() - 1)] !=
                  BlockClass::exposed ||
                (s > 0 && classes[std::min<std::size_t>(number - 1,
                                                        classes.size() - 1)] ==
                            BlockClass::exposed))
              continue;
            const auto faces = list_faces(scene, split, is_dug, block);
            const Tensor<1, dim> load =
              load_on(scene, split, is_dug, block, number, 0.);
            const auto limit = solve_limit_equilibrium(faces, load);
            double water     = 0.;
            for (const BlockFace<dim> &face : faces)
              water += std::abs(face.water_force);
            const double tractions =
              tractions_on(scene, split, is_dug, block, number, 0.).norm();
            out << "Limit   block " << block.id << " after "
                << scene.stages[s]->name << ": ";
            if (std::isfinite(limit.factor))
              out << std::setprecision(5) << limit.factor << ", ";
            out << limit.describe(faces) << "; load " << std::setprecision(4)
                << 1e-3 * load.norm() << " kN";
            if (tractions > 0.)
              out << " with tractions of " << 1e-3 * tractions << " kN";
            if (!scene.safety.seismic_coefficient.empty())
              out << ", seismic";
            if (water > 0.)
              out << ", water " << 1e-3 * water << " kN on the joints";
            for (unsigned int i = 0; i < limit.normal_forces.size(); ++i)
              out << (i == 0 ? ", normal force " : " and ")
                  << 1e-3 * limit.normal_forces[i] << " kN on "
                  << faces[limit.faces[i]].name;
            if (is_supported(scene, split, is_dug, block))
              out << "; a support that holds it is left out";
            out << '\n';
          }
      }
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
                                                   const IsDug &,
                                                   const Block<2> &);
  template Tensor<1, 2> load_on<2>(const Scene<2> &,
                                   const SplitMesh<2> &,
                                   const IsDug &,
                                   const Block<2> &,
                                   const unsigned int,
                                   const double);
  template void print_limit_equilibria<2>(std::ostream &,
                                          const Scene<2> &,
                                          const SplitMesh<2> &,
                                          const Blocks<2> &);
  template double stress_ratio<2>(const Scene<2> &,
                                  const std::vector<BlockFace<2>> &,
                                  const std::vector<unsigned int> &,
                                  const std::vector<JointSums<2>> &);
  template std::vector<BlockFace<3>> list_faces<3>(const Scene<3> &,
                                                   const SplitMesh<3> &,
                                                   const IsDug &,
                                                   const Block<3> &);
  template Tensor<1, 3> load_on<3>(const Scene<3> &,
                                   const SplitMesh<3> &,
                                   const IsDug &,
                                   const Block<3> &,
                                   const unsigned int,
                                   const double);
  template void print_limit_equilibria<3>(std::ostream &,
                                          const Scene<3> &,
                                          const SplitMesh<3> &,
                                          const Blocks<3> &);
  template double stress_ratio<3>(const Scene<3> &,
                                  const std::vector<BlockFace<3>> &,
                                  const std::vector<unsigned int> &,
                                  const std::vector<JointSums<3>> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/blocks/nodal_areas.h>
#include <keyblock/step/free_field.h>
#include <keyblock/step/quiet_boundary.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    bool
    stands_on_bottom(const Support<dim> &support)
    {
      return std::any_of(support.boundaries.begin(),
                         support.boundaries.end(),
                         [](const std::string &name) {
                           return name == "bottom" || name == "all";
                         });
    }

    template <int dim>
    bool
    holds_axis_of_bottom(const Support<dim> &support, const unsigned int d)
    {
      return support.directions == SupportDirections::all ||
             support.is_far_field() || support.names_axis(d) ||
             (support.directions == SupportDirections::normal && d == dim - 1);
    }



    /** Call @p action(cell, face) for the faces of a boundary that are not of
     * rigid bodies, nor empty from the start. */
    template <int dim, typename Action>
    void
    for_each_side_face(const Scene<dim> &scene,
                       const Mesh<dim> &mesh,
                       const std::string &boundary,
                       const Action &action)
    {
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          if (mesh.is_on(c, f, boundary) && mesh.excavation_stage[c] != 1 &&
              !scene.materials[mesh.material[c]]->is_rigid())
            action(c, f);
    }



    /** Of the rock at the foot of a side, per area [Pa s/m]. */
    template <int dim>
    Tensor<2, dim>
    impedance_of_foot(const std::vector<SideFace<dim>> &faces)
    {
      Tensor<1, dim> down;
      down[dim - 1] = -1.;
      return quiet_impedance(*std::min_element(faces.begin(),
                                               faces.end(),
                                               [](const auto &a,
                                                  const auto &b) {
                                                 return a.bottom < b.bottom;
                                               })
                                ->material,
                             down);
    }
  } // namespace



  template <int dim>
  FreeField<dim>::FreeField(const Scene<dim> &scene,
                            const SplitMesh<dim> &split,
                            const Numbering<dim> &numbering)
    : scene(scene)
    , split(split)
    , numbering(numbering)
  {
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      if (scene.supports[s]->is_free_field())
        for (const std::string &boundary : scene.supports[s]->boundaries)
          sides.push_back(make_side(s, boundary));
  }



  template <int dim>
  typename FreeField<dim>::Side
  FreeField<dim>::make_side(const unsigned int support,
                            const std::string &boundary) const
  {
    const Mesh<dim> &mesh = split.mesh;
    Point<dim> foot;
    foot[dim - 1] = std::numeric_limits<double>::max();
    for_each_side_face(
      scene, mesh, boundary, [&](const unsigned int c, const unsigned int f) {
        for (const unsigned int v : mesh.face_vertices(c, f))
          if (mesh.vertices[v][dim - 1] < foot[dim - 1])
            foot = mesh.vertices[v];
        const Tensor<1, dim> area = mesh.face_area_vector(c, f);
        AssertThrow(std::abs(area[dim - 1]) < 1e-6 * area.norm(),
                    InputError("The support '" + scene.supports[support]->name +
                               "' is a free field on the boundary '" +
                               boundary +
                               "', which is not plumb; name side boundaries, "
                               "or set 'Kind' to quiet."));
      });
    const std::vector<SideFace<dim>> faces =
      list_faces(boundary, {scene, split});
    AssertThrow(!faces.empty(),
                InputError("The support '" + scene.supports[support]->name +
                           "' is a free field on the boundary '" + boundary +
                           "', where there is no rock that deforms; name "
                           "another one in 'Supports/" +
                           scene.supports[support]->name + "/Boundaries'."));
    return {support,
            boundary,
            FreeFieldColumn<dim>(faces, scene.time_stepping.least_step),
            foot,
            impedance_of_foot(faces)};
  }



  template <int dim>
  std::vector<SideFace<dim>>
  FreeField<dim>::list_faces(const std::string &boundary,
                             const Ground<dim> &ground) const
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<SideFace<dim>> faces;
    for_each_side_face(
      scene, mesh, boundary, [&](const unsigned int c, const unsigned int f) {
        SideFace<dim> face{std::numeric_limits<double>::max(),
                           std::numeric_limits<double>::lowest(),
                           scene.materials[ground.natural_material_of(c)].get(),
                           scene.materials[mesh.material[c]]->p_wave_speed()};
        for (const unsigned int v : mesh.face_vertices(c, f))
          {
            face.bottom = std::min(face.bottom, mesh.vertices[v][dim - 1]);
            face.top    = std::max(face.top, mesh.vertices[v][dim - 1]);
          }
        if (!mesh.later_materials.empty())
          for (const unsigned int later : mesh.later_materials[c])
            face.largest_speed =
              std::max(face.largest_speed,
                       scene.materials[later]->p_wave_speed());
        faces.push_back(face);
      });
    return faces;
  }



  template <int dim>
  void
  FreeField<dim>::take_ground(const Ground<dim> &ground)
  {
    if (split.mesh.later_materials.empty())
      return;
    for (Side &side : sides)
      {
        const auto faces = list_faces(side.boundary, ground);
        side.column.take_materials(faces);
        side.foot_impedance = impedance_of_foot(faces);
      }
  }



  template <int dim>
  void
  FreeField<dim>::find_sides(
    const std::vector<bool> &acts,
    const std::vector<unsigned int> &material,
    const std::function<unsigned int(unsigned int node)> &entry_of_node)
  {
    const Mesh<dim> &mesh = split.mesh;
    shares.clear();
    for (unsigned int i = 0; i < sides.size(); ++i)
      if (acts[sides[i].support])
        for_each_side_face(
          scene,
          mesh,
          sides[i].boundary,
          [&](const unsigned int c, const unsigned int f) {
            if (material[c] == none)
              return;
            const Tensor<1, dim> outward = mesh.face_area_vector(c, f);
            const Tensor<2, dim> impedance =
              quiet_impedance(*scene.materials[material[c]],
                              outward / outward.norm());
            const auto areas    = nodal_areas(mesh, c, f);
            const auto vectors  = nodal_area_vectors(mesh, c, f);
            const auto vertices = mesh.face_vertices(c, f);
            for (unsigned int v = 0; v < vertices.size(); ++v)
              for_each_owned_carrier(
                split,
                numbering,
                vertices[v],
                [&](const unsigned int node, const double weight) {
                  shares.push_back({i,
                                    entry_of_node(node),
                                    mesh.vertices[vertices[v]][dim - 1],
                                    mesh.face_center(c, f)[dim - 1],
                                    weight * areas[v] * impedance,
                                    weight * vectors[v]});
                });
          });
  }



  template <int dim>
  FootMotion<dim>
  FreeField<dim>::foot_motion(const Side &side,
                              const std::vector<bool> &acts,
                              const Motion &motion,
                              const MotionOfStep<dim> &step) const
  {
    FootMotion<dim> foot;
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      {
        const Support<dim> &support = *scene.supports[s];
        if (support.is_free_field() || !stands_on_bottom(support))
          continue;
        if (support.is_quiet() && acts[s])
          {
            const Tensor<1, dim> wave = motion(s, side.foot, step.time);
            foot.impedance += side.foot_impedance;
            foot.incoming +=
              lets_in_stress(support) ? wave : side.foot_impedance * wave;
          }
        else
          {
            // a quiet bottom is at rest until it lets its wave in
            const bool is_moved =
              !support.is_quiet() &&
              (!support.velocity.empty() || support.history);
            const Tensor<1, dim> velocity =
              is_moved ? motion(s, side.foot, step.time + 0.5 * step.step)
                       : Tensor<1, dim>();
            // of several supports the last that moves an axis, as at nodes
            for (unsigned int d = 0; d < dim; ++d)
              if (holds_axis_of_bottom(support, d) &&
                  (is_moved || !foot.is_held[d]))
                {
                  foot.is_held[d]  = true;
                  foot.velocity[d] = velocity[d];
                }
          }
      }
    return foot;
  }



  template <int dim>
  void
  FreeField<dim>::advance(const MotionOfStep<dim> &step,
                          const std::vector<bool> &acts,
                          const Motion &motion)
  {
    for (Side &side : sides)
      if (acts[side.support])
        side.column.advance(
          {step.step, step.kick, step.mass_damping, step.stiffness_damping},
          foot_motion(side, acts, motion, step));
  }



  template <int dim>
  void
  FreeField<dim>::add_drive(std::vector<Tensor<1, dim>> &drive) const
  {
    for (const Share &share : shares)
      {
        const FreeFieldColumn<dim> &column = sides[share.side].column;
        drive[share.entry] +=
          share.impedance * column.velocity(share.elevation) +
          column.stress(share.face_elevation) * share.area;
      }
  }



  template <int dim>
  void
  FreeField<dim>::stop_motion()
  {
    for (Side &side : sides)
      side.column.stop_motion();
  }



  template <int dim>
  std::vector<double>
  FreeField<dim>::remember() const
  {
    std::vector<double> numbers;
    for (const Side &side : sides)
      {
        const std::vector<double> of_side = side.column.remember();
        numbers.insert(numbers.end(), of_side.begin(), of_side.end());
      }
    return numbers;
  }



  template <int dim>
  void
  FreeField<dim>::recall(const double *numbers)
  {
    for (Side &side : sides)
      {
        side.column.recall(numbers);
        numbers += side.column.n_numbers();
      }
  }

  template class FreeField<2>;
  template class FreeField<3>;
} // namespace Keyblock

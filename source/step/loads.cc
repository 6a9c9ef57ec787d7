// SPDX-License-Identifier: LGPL-2.1-or-later
// Gravity, tractions, and ramps of what is out of balance.
#include <keyblock/base/errors.h>
#include <keyblock/blocks/nodal_areas.h>
#include <keyblock/step/loads.h>

namespace Keyblock
{
  template <int dim>
  Loads<dim>::Loads(const Scene<dim> &scene,
                    const SplitMesh<dim> &split,
                    const Numbering<dim> &numbering,
                    Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , fields(fields)
  {
    read_formulas();
  }



  template <int dim>
  void
  Loads<dim>::set_up(const Ground<dim> &ground)
  {
    set_up_water(ground);
    set_up_tractions(ground);
    seismic_acceleration =
      standard_gravity * scene.seismic_coefficient(ground.stage_number);
    forget_load();
  }



  template <int dim>
  void
  Loads<dim>::read_formulas()
  {
    for (const auto &traction : scene.tractions)
      {
        tractions.push_back(std::make_unique<Expression<dim>>(
          traction->expression, dim, "Tractions/*/Traction"));
        is_constant = is_constant && !depends_on_time(traction->expression);
      }
    if (!scene.initial_state.gravity.empty())
      {
        gravity = std::make_unique<Expression<dim>>(scene.initial_state.gravity,
                                                    dim,
                                                    "Initial state/Gravity");
        is_constant =
          is_constant && !depends_on_time(scene.initial_state.gravity);
      }
  }



  template <int dim>
  void
  Loads<dim>::set_up_tractions(const Ground<dim> &ground)
  {
    const Mesh<dim> &mesh = split.mesh;
    nodal_tractions.clear();
    std::vector<CellFace> free;
    if (!scene.tractions.empty())
      free = list_free_faces(ground);
    for (unsigned int t = 0; t < scene.tractions.size(); ++t)
      {
        const Traction<dim> &traction = *scene.tractions[t];
        if (scene.stage_number(traction.stage) > ground.stage_number)
          continue;
        const std::vector<CellFace> loaded =
          list_loaded_faces(ground, free, traction);
        for (const CellFace &face : loaded)
          {
            const Point<dim> center = mesh.face_center(face.cell, face.face);
            const auto areas        = nodal_areas(mesh, face.cell, face.face);
            const auto vertices     = mesh.face_vertices(face.cell, face.face);
            for (unsigned int v = 0; v < vertices.size(); ++v)
              split.for_each_carrier(
                vertices[v],
                [&](const unsigned int carrier, const double weight) {
                  if (numbering.is_owned(carrier))
                    nodal_tractions.push_back({numbering.local_node(carrier),
                                               t,
                                               weight * areas[v],
                                               center});
                });
          }
        AssertThrow(!loaded.empty() || ground.stage_number > 1,
                    InputError("The traction '" + traction.name +
                               "' loads no face; check 'Tractions/" +
                               traction.name +
                               "/Boundaries' or 'Region' against the domain."));
      }
  }



  template <int dim>
  void
  Loads<dim>::set_up_water(const Ground<dim> &ground)
  {
    water_forces.clear();
    water.clear();
    water_pressures.clear();
    const Interface<dim> &interface = split.interface;
    std::vector<bool> is_varying;
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      {
        const std::string formula =
          scene.water_pressure(j, ground.stage_number);
        water_pressures.push_back(formula.empty()
                                    ? nullptr
                                    : std::make_unique<Expression<dim>>(
                                        formula, 1, "Joints/*/Water pressure"));
        is_varying.push_back(!formula.empty() && depends_on_time(formula));
      }
    for (const JointFace &face : interface.joint_faces)
      {
        if (!water_pressures[face.joint] ||
            ground.is_excavated(face.minus_cell) ||
            ground.is_excavated(face.plus_cell))
          continue;
        for (const CellFace &side : {CellFace{face.minus_cell, face.minus_face},
                                     CellFace{face.plus_cell, face.plus_face}})
          add_water(side, face.joint, is_varying[face.joint]);
      }
  }



  template <int dim>
  void
  Loads<dim>::add_water(const CellFace &side,
                        const unsigned int joint,
                        const bool is_varying)
  {
    const auto areas    = nodal_area_vectors(split.mesh, side.cell, side.face);
    const auto vertices = split.mesh.face_vertices(side.cell, side.face);
    for (unsigned int v = 0; v < vertices.size(); ++v)
      split.for_each_carrier(
        vertices[v], [&](const unsigned int carrier, const double weight) {
          if (!numbering.is_owned(carrier))
            return;
          const Point<dim> &place    = split.mesh.vertices[vertices[v]];
          const Tensor<1, dim> share = -weight * areas[v];
          const unsigned int node    = numbering.local_node(carrier);
          if (is_varying)
            {
              water.push_back({node, joint, share, place});
              return;
            }
          const double p = water_pressures[joint]->value(place, 0., 0);
          for (unsigned int d = 0; d < dim; ++d)
            water_forces.emplace_back(dim * node + d, p * share[d]);
        });
  }



  template <int dim>
  bool
  Loads<dim>::set_load(const double time)
  {
    const double left = ramp.share_left();
    if (is_set && is_constant && water.empty() && left == share_set)
      return false;
    is_set           = true;
    share_set        = left;
    Tensor<1, dim> g = seismic_acceleration;
    if (gravity)
      g += gravity->vector(Point<dim>(), time);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.load[dim * node + d] = fields.weighing_mass[node] * g[d];
    for (const auto &[dof, force] : water_forces)
      fields.load[dof] += force;
    for (const NodalWater<dim> &entry : water)
      {
        const double p =
          water_pressures[entry.joint]->value(entry.place, time, 0);
        for (int d = 0; d < dim; ++d)
          fields.load[dim * entry.node + d] += p * entry.area[d];
      }
    for (const NodalTraction<dim> &entry : nodal_tractions)
      {
        const Tensor<1, dim> t =
          tractions[entry.traction]->vector(entry.place, time);
        for (int d = 0; d < dim; ++d)
          fields.load[dim * entry.node + d] += entry.area * t[d];
      }
    for (unsigned int i = 0; i < out_of_balance_force.size(); ++i)
      fields.load[i] += left * out_of_balance_force[i];
    return true;
  }



  template <int dim>
  void
  Loads<dim>::start_ramp(const std::vector<double> &force,
                         const double duration,
                         const bool moves_supports)
  {
    out_of_balance_force = force;
    ramp                 = Ramp::over(duration);
    displacement_ramped  = moves_supports ? displacement_left : 0.;
    forget_load();
  }



  template <int dim>
  void
  Loads<dim>::advance_ramp(const double step)
  {
    const bool was_ramping = is_ramping();
    displacement_left -= displacement_share_of_step(step);
    ramp.advance(step);
    // the shares of all steps are one but for rounding
    if (was_ramping && !is_ramping() && displacement_ramped > 0.)
      displacement_left = 0.;
  }

  template class Loads<2>;
  template class Loads<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Gravity, tractions, and ramps of what is out of balance.
#include <keyblock/base/mpi.h>
#include <keyblock/step/set_up.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace Keyblock
{
  namespace
  {
    bool
    depends_on_time(const std::string &formula)
    {
      return std::regex_search(formula, std::regex("\\bt\\b"));
    }
  } // namespace



  template <int dim>
  void
  Conditions<dim>::read_formulas()
  {
    for (const auto &traction : scene.tractions)
      {
        tractions.push_back(std::make_unique<Expression<dim>>(
          traction->expression, dim, "Tractions/*/Traction"));
        is_load_constant =
          is_load_constant && !depends_on_time(traction->expression);
      }
    if (!scene.initial_state.gravity.empty())
      {
        gravity = std::make_unique<Expression<dim>>(scene.initial_state.gravity,
                                                    dim,
                                                    "Initial state/Gravity");
        is_load_constant =
          is_load_constant && !depends_on_time(scene.initial_state.gravity);
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_tractions()
  {
    const Mesh<dim> &mesh = split.mesh;
    set_up_water();
    nodal_tractions.clear();
    is_load_set = false;
    std::vector<CellFace> free;
    if (!scene.tractions.empty())
      free = list_free_faces(ground());
    for (unsigned int t = 0; t < scene.tractions.size(); ++t)
      {
        const Traction<dim> &traction = *scene.tractions[t];
        if (scene.stage_number(traction.stage) > stage_number)
          continue;
        const std::vector<CellFace> loaded =
          list_loaded_faces(ground(), free, traction);
        for (const CellFace &face : loaded)
          {
            const Point<dim> center = mesh.face_center(face.cell, face.face);
            const double area =
              mesh.face_area_vector(face.cell, face.face).norm() /
              Mesh<dim>::n_face_vertices;
            for (const unsigned int v :
                 mesh.face_vertices(face.cell, face.face))
              split.for_each_carrier(
                v, [&](const unsigned int carrier, const double weight) {
                  if (numbering.is_owned(carrier))
                    nodal_tractions.push_back({numbering.local_node(carrier),
                                               t,
                                               weight * area,
                                               center});
                });
          }
        AssertThrow(!loaded.empty() || stage_number > 1,
                    InputError("The traction '" + traction.name +
                               "' loads no face; check 'Tractions/" +
                               traction.name +
                               "/Boundaries' or 'Region' against the domain."));
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_water()
  {
    water_forces.clear();
    const Interface<dim> &interface = split.interface;
    std::vector<std::unique_ptr<Expression<dim>>> pressure(scene.joints.size());
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      if (!scene.joints[j]->water_pressure.empty())
        pressure[j] =
          std::make_unique<Expression<dim>>(scene.joints[j]->water_pressure,
                                            1,
                                            "Joints/*/Water pressure");
    for (const JointFace &face : interface.joint_faces)
      {
        if (!pressure[face.joint] || is_dug(face.minus_cell) ||
            is_dug(face.plus_cell))
          continue;
        const Tensor<1, dim> area =
          split.mesh.face_area_vector(face.minus_cell, face.minus_face);
        for (const bool is_plus : {false, true})
          for (const unsigned int v :
               is_plus
                 ? split.mesh.face_vertices(face.plus_cell, face.plus_face)
                 : split.mesh.face_vertices(face.minus_cell, face.minus_face))
            split.for_each_carrier(
              v, [&](const unsigned int carrier, const double weight) {
                if (!numbering.is_owned(carrier))
                  return;
                const double p =
                  pressure[face.joint]->value(split.mesh.vertices[v], 0., 0);
                for (unsigned int d = 0; d < dim; ++d)
                  water_forces.emplace_back(
                    dim * numbering.local_node(carrier) + d,
                    (is_plus ? weight : -weight) * p * area[d] /
                      Mesh<dim>::n_face_vertices);
              });
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_load(const double time)
  {
    const double left = share_left_at(ramp_progress);
    if (is_load_set && is_load_constant && left == share_carried)
      return;
    is_load_set   = true;
    share_carried = left;
    Tensor<1, dim> g;
    if (gravity)
      g = gravity->vector(Point<dim>(), time);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.load[dim * node + d] = fields.weighing_mass[node] * g[d];
    for (const auto &[dof, force] : water_forces)
      fields.load[dof] += force;
    for (const NodalTraction<dim> &entry : nodal_tractions)
      {
        const Tensor<1, dim> t =
          tractions[entry.traction]->vector(entry.place, time);
        for (int d = 0; d < dim; ++d)
          fields.load[dim * entry.node + d] += entry.area * t[d];
      }
    for (unsigned int i = 0; i < carried_force.size(); ++i)
      fields.load[i] += left * carried_force[i];
    for (unsigned int i = 0; i < far_field_force.size(); ++i)
      fields.load[i] += far_field_force[i];
  }



  template <int dim>
  double
  Conditions<dim>::share_left_at(const double progress) const
  {
    return 0.5 * (1. + std::cos(dealii::numbers::PI * progress));
  }



  template <int dim>
  void
  Conditions<dim>::start_ramp(const std::vector<double> &force,
                              const double duration)
  {
    carried_force = force;
    ramp_duration = duration;
    ramp_progress = duration > 0. ? 0. : 1.;
    ramp_pace     = 1.;
    is_load_set   = false;
  }



  template <int dim>
  void
  Conditions<dim>::advance_ramp(const double step)
  {
    if (is_ramping())
      ramp_progress = std::min(1., ramp_progress + next_progress(step));
  }



  template <int dim>
  double
  Conditions<dim>::next_progress(const double step) const
  {
    return is_ramping() ? ramp_pace * step / ramp_duration : 0.;
  }



  template void Conditions<2>::read_formulas();
  template void Conditions<3>::read_formulas();
  template void Conditions<2>::set_up_tractions();
  template void Conditions<3>::set_up_tractions();
  template void Conditions<2>::set_load(const double);
  template void Conditions<3>::set_load(const double);
  template double Conditions<2>::share_left_at(const double) const;
  template double Conditions<3>::share_left_at(const double) const;
  template double Conditions<2>::next_progress(const double) const;
  template double Conditions<3>::next_progress(const double) const;
  template void Conditions<2>::advance_ramp(const double);
  template void Conditions<3>::advance_ramp(const double);
  template void Conditions<2>::start_ramp(const std::vector<double> &,
                                          const double);
  template void Conditions<3>::start_ramp(const std::vector<double> &,
                                          const double);
} // namespace Keyblock

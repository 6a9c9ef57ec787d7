// SPDX-License-Identifier: LGPL-2.1-or-later
// Gravity, tractions, and ramps of what is out of balance.
#include <keyblock/base/errors.h>
#include <keyblock/step/loads.h>

#include <algorithm>
#include <map>

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
    , acceleration(scene)
  {
    read_formulas();
  }



  template <int dim>
  void
  Loads<dim>::set_up(const Ground<dim> &ground)
  {
    steady_forces.clear();
    set_up_water(ground);
    set_up_tractions(ground);
    sum_steady_forces();
    acceleration.take_ground(ground);
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
    is_constant = is_constant && !acceleration.gravity.is_varying;
  }



  template <int dim>
  void
  Loads<dim>::set_up_tractions(const Ground<dim> &ground)
  {
    varying_tractions.clear();
    std::vector<CellFace> free;
    if (!scene.tractions.empty())
      free = list_free_faces(ground);
    for (unsigned int t = 0; t < scene.tractions.size(); ++t)
      {
        const Traction<dim> &traction = *scene.tractions[t];
        if (scene.stage_number(traction.stage) > ground.stage_number)
          continue;
        const std::vector<LoadedFace> loaded =
          list_loaded_faces(ground, free, traction);
        const LoadedRegion<dim> region(traction);
        const bool is_varying = depends_on_time(traction.expression);
        for (const LoadedFace &face : loaded)
          {
            const Point<dim> center =
              split.mesh.face_center(face.cell, face.face);
            const auto is_covered = [&](const Point<dim> &p) {
              return face.is_whole || region.has(center, p);
            };
            if (is_varying && !face.is_whole)
              add_part(face, t, is_covered);
            else
              add_load(
                face,
                t,
                is_varying,
                [&](const Point<dim> &p) {
                  return is_covered(p) ? tractions[t]->vector(p, 0.)
                                       : Tensor<1, dim>();
                },
                [](const FacePoint<dim> &point) { return point.area.norm(); },
                varying_tractions);
          }
        AssertThrow(!loaded.empty() || ground.stage_number > 1,
                    InputError("The traction '" + traction.name +
                               "' loads no face; check 'Tractions/" +
                               traction.name +
                               "/Boundaries' or 'Region' against the domain."));
      }
  }



  template <int dim>
  template <typename Action>
  void
  Loads<dim>::for_each_share(const CellFace &face,
                             const FacePoint<dim> &point,
                             const Action &action) const
  {
    const auto vertices = split.mesh.face_vertices(face.cell, face.face);
    for (unsigned int v = 0; v < vertices.size(); ++v)
      for_each_owned_carrier(split,
                             numbering,
                             vertices[v],
                             [&](const unsigned int node, const double weight) {
                               action(node, weight * point.shape[v]);
                             });
  }



  template <int dim>
  bool
  Loads<dim>::has_owned_node(const CellFace &face) const
  {
    bool is_any = false;
    for (const unsigned int v : split.mesh.face_vertices(face.cell, face.face))
      for_each_owned_carrier(split, numbering, v, [&](unsigned int, double) {
        is_any = true;
      });
    return is_any;
  }



  template <int dim>
  void
  Loads<dim>::sum_steady_forces()
  {
    std::map<unsigned int, double> sums;
    for (const auto &[dof, force] : steady_forces)
      sums[dof] += force;
    steady_forces.assign(sums.begin(), sums.end());
  }



  template <int dim>
  template <typename Value, typename AreaOf, typename Area>
  void
  Loads<dim>::add_load(const CellFace &face,
                       const unsigned int formula,
                       const bool is_varying,
                       const Value &value_at,
                       const AreaOf &area_of,
                       std::vector<LoadPoint<dim, Area>> &varying)
  {
    if (!has_owned_node(face))
      return;
    const auto corners = face_corners(split.mesh, face.cell, face.face);
    auto points        = is_varying ? gauss_points<dim>(corners)
                                    : adapted_points<dim>(corners, value_at);
    turn_outward(points, split.mesh.face_area_vector(face.cell, face.face));
    for (const FacePoint<dim> &point : points)
      {
        const Area area = area_of(point);
        if (is_varying)
          {
            varying.push_back({formula, point.place, {}});
            for_each_share(
              face, point, [&](const unsigned int node, const double share) {
                varying.back().areas.emplace_back(node, share * area);
              });
            continue;
          }
        const auto value = value_at(point.place);
        for_each_share(face,
                       point,
                       [&](const unsigned int node, const double share) {
                         const Tensor<1, dim> force = value * (share * area);
                         for (unsigned int d = 0; d < dim; ++d)
                           steady_forces.emplace_back(dim * node + d, force[d]);
                       });
      }
  }



  template <int dim>
  void
  Loads<dim>::add_part(
    const CellFace &face,
    const unsigned int traction,
    const std::function<bool(const Point<dim> &)> &is_covered)
  {
    if (!has_owned_node(face))
      return;
    const auto share = [&](const Point<dim> &p) {
      return is_covered(p) ? 1. : 0.;
    };
    const auto points =
      adapted_points<dim>(face_corners(split.mesh, face.cell, face.face),
                          share);
    Tensor<1, dim> moment;
    double area = 0.;
    std::map<unsigned int, double> areas;
    for (const FacePoint<dim> &point : points)
      {
        const double part = share(point.place) * point.area.norm();
        area += part;
        moment += part * Tensor<1, dim>(point.place);
        for_each_share(face,
                       point,
                       [&](const unsigned int node, const double of_node) {
                         areas[node] += of_node * part;
                       });
      }
    if (area > 0.)
      varying_tractions.push_back(
        {traction, Point<dim>(moment / area), {areas.begin(), areas.end()}});
  }



  template <int dim>
  void
  Loads<dim>::set_up_water(const Ground<dim> &ground)
  {
    varying_water.clear();
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
    is_water_varying =
      std::find(is_varying.begin(), is_varying.end(), true) != is_varying.end();
    for (const JointFace &face : interface.joint_faces)
      {
        if (!water_pressures[face.joint] ||
            ground.is_excavated(face.minus_cell) ||
            ground.is_excavated(face.plus_cell))
          continue;
        const Expression<dim> &pressure = *water_pressures[face.joint];
        for (const CellFace &side : {CellFace{face.minus_cell, face.minus_face},
                                     CellFace{face.plus_cell, face.plus_face}})
          add_load(
            side,
            face.joint,
            is_varying[face.joint],
            [&pressure](const Point<dim> &p) {
              return pressure.value(p, 0., 0);
            },
            [](const FacePoint<dim> &point) { return -point.area; },
            varying_water);
      }
  }



  template <int dim>
  bool
  Loads<dim>::set_load(const double time)
  {
    const double left = ramp.share_left();
    if (is_set && is_constant && !is_water_varying && left == share_set)
      return false;
    is_set                 = true;
    share_set              = left;
    const Tensor<1, dim> g = acceleration.at(time);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.load[dim * node + d] = fields.weighing_mass[node] * g[d];
    for (const auto &[dof, force] : steady_forces)
      fields.load[dof] += force;
    const auto add_varying = [&](const auto &points, const auto &value_at) {
      for (const auto &point : points)
        {
          const auto value = value_at(point);
          for (const auto &[node, area] : point.areas)
            {
              const Tensor<1, dim> force = value * area;
              for (int d = 0; d < dim; ++d)
                fields.load[dim * node + d] += force[d];
            }
        }
    };
    add_varying(varying_water, [&](const auto &point) {
      return water_pressures[point.formula]->value(point.place, time, 0);
    });
    add_varying(varying_tractions, [&](const auto &point) {
      return tractions[point.formula]->vector(point.place, time);
    });
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

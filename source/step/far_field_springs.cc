// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/far_field_springs.h>

#include <deal.II/lac/full_matrix.h>

#include <keyblock/blocks/nodal_areas.h>

#include <algorithm>
#include <utility>

namespace Keyblock
{
  template <int dim>
  FarFieldSprings<dim>::FarFieldSprings(const Scene<dim> &scene,
                                        const SplitMesh<dim> &split,
                                        const Numbering<dim> &numbering,
                                        const Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , fields(fields)
    , far_field(numbering.communicator)
  {}



  template <int dim>
  bool
  FarFieldSprings<dim>::is_wanted(const Scene<dim> &scene)
  {
    return std::any_of(scene.supports.begin(),
                       scene.supports.end(),
                       [](const auto &s) { return s->is_far_field(); });
  }



  template <int dim>
  void
  FarFieldSprings<dim>::set_up()
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<typename FarField<dim>::Face> faces;
    for (const Side &side : list_sides(stage))
      {
        const auto &[c, f]        = side.face;
        const Material<dim> &rock = *scene.materials[side.material];
        faces.push_back({mesh.face_vertices(c, f),
                         mesh.face_center(c, f),
                         nodal_area_vectors(mesh, c, f),
                         side.support->center,
                         rock.lame_lambda(),
                         rock.shear_modulus()});
      }
    far_field = FarField<dim>(faces, split, numbering);
  }



  template <int dim>
  std::vector<typename FarFieldSprings<dim>::Side>
  FarFieldSprings<dim>::list_sides(const unsigned int stage) const
  {
    const Mesh<dim> &mesh = split.mesh;
    const Ground<dim> ground{scene, split, stage};
    std::vector<Side> sides;
    for (const auto &support : scene.supports)
      if (support->is_far_field())
        for (const std::string &name : support->boundaries)
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              if (mesh.is_on(c, f, name) && mesh.excavation_stage[c] != 1)
                sides.push_back(
                  {support.get(), {c, f}, ground.natural_material_of(c)});
    return sides;
  }



  template <int dim>
  void
  FarFieldSprings<dim>::take_ground(const Ground<dim> &ground)
  {
    const unsigned int stage_before = std::exchange(stage, ground.stage_number);
    if (!acts || split.mesh.later_materials.empty())
      return;
    const std::vector<Side> before = list_sides(stage_before),
                            now    = list_sides(stage);
    if (std::equal(before.begin(),
                   before.end(),
                   now.begin(),
                   [](const Side &a, const Side &b) {
                     return a.material == b.material;
                   }))
      return;
    const auto force = [&]() {
      std::vector<double> sum(fields.displacement.size(), 0.);
      far_field.add_force(fields.displacement, sum);
      return sum;
    };
    const auto energy = [&]() {
      return numbering.communicator.sum(
        far_field.stored_energy(fields.displacement));
    };
    const std::vector<double> force_before = force();
    energy_before += energy();
    set_up();
    const std::vector<double> force_now = force();
    energy_before -= energy();
    for (unsigned int i = 0; i < dead_load.size(); ++i)
      dead_load[i] += force_now[i] - force_before[i];
  }



  template <int dim>
  void
  FarFieldSprings<dim>::release(const std::vector<double> &reaction)
  {
    set_up();
    dead_load.assign(dim * numbering.n_owned(), 0.);
    for (const auto &spring : far_field.springs)
      for (unsigned int i = dim * spring.node; i < dim * (spring.node + 1); ++i)
        dead_load[i] = reaction[i];
    acts = true;
  }



  template <int dim>
  std::vector<unsigned int>
  FarFieldSprings<dim>::nodes() const
  {
    std::vector<unsigned int> list;
    for (const auto &spring : far_field.springs)
      list.push_back(spring.node);
    return list;
  }



  template <int dim>
  void
  FarFieldSprings<dim>::add_force(const std::vector<double> &displacement,
                                  std::vector<double> &force)
  {
    far_field.add_force(displacement, force);
  }



  template <int dim>
  void
  FarFieldSprings<dim>::add_load(const double, std::vector<double> &load) const
  {
    for (unsigned int i = 0; i < dead_load.size(); ++i)
      load[i] += dead_load[i];
  }



  template <int dim>
  StepBound
  FarFieldSprings<dim>::step_bound(
    const std::vector<double> &inverse_mass) const
  {
    StepBound bound;
    bound.squared_frequency = far_field.frequency_bound(inverse_mass);
    return bound;
  }



  template <int dim>
  double
  FarFieldSprings<dim>::stored_energy(
    const std::vector<double> &displacement) const
  {
    return far_field.stored_energy(displacement) +
           (numbering.communicator.is_root() ? energy_before : 0.);
  }



  template <int dim>
  void
  FarFieldSprings<dim>::for_each_stiffness(
    const typename ForceElement<dim>::AddStiffness &add) const
  {
    std::vector<unsigned int> dofs(1);
    dealii::FullMatrix<double> stiffness(1, 1);
    for (const auto &spring : far_field.springs)
      for (unsigned int d = 0; d < dim; ++d)
        {
          dofs[0]         = dim * spring.node + d;
          stiffness(0, 0) = spring.stiffness;
          add(dofs, stiffness);
        }
  }



  template <int dim>
  CoupledStiffness
  FarFieldSprings<dim>::coupled_stiffness() const
  {
    CoupledStiffness result;
    const unsigned int n = far_field.n_columns();
    result.coupling      = far_field.coupling;
    result.columns.assign(n,
                          std::vector<double>(dim * numbering.n_owned(), 0.));
    for (unsigned int i = 0; i < dim * far_field.springs.size(); ++i)
      for (unsigned int m = 0; m < n; ++m)
        result.columns[m][dim * far_field.springs[i / dim].node + i % dim] =
          far_field.columns[i * n + m];
    return result;
  }



  template <int dim>
  ForceElementState
  FarFieldSprings<dim>::remember() const
  {
    return {name(), {acts ? 1. : 0., double(stage), energy_before}, dead_load};
  }



  template <int dim>
  void
  FarFieldSprings<dim>::recall(const ForceElementState &state)
  {
    const bool did_act              = acts;
    const unsigned int stage_before = stage;
    acts                            = state.numbers.at(0) != 0.;
    stage                           = state.numbers.at(1);
    energy_before                   = state.numbers.at(2);
    dead_load                       = state.nodal;
    if (acts && (!did_act || stage != stage_before))
      set_up();
    else if (!acts)
      far_field = FarField<dim>(numbering.communicator);
  }

  template class FarFieldSprings<2>;
  template class FarFieldSprings<3>;
} // namespace Keyblock

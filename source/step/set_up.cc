// SPDX-License-Identifier: LGPL-2.1-or-later
// From the scene to arrays: cells, frequencies, initial state.
#include <keyblock/step/set_up.h>

#include <keyblock/base/mpi.h>
#include <keyblock/rock/cell_geometry.h>
#include <keyblock/rock/initial_stress.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    double
    radians(const double degrees)
    {
      return degrees * dealii::numbers::PI / 180.;
    }

    /** Strength with tan(phi), c and tension multiplied by @p share. */
    template <int dim>
    MohrCoulomb
    strength_of(const Material<dim> &material, const double share)
    {
      const auto or_peak = [](const double residual, const double peak) {
        return residual < 0. ? peak : residual;
      };
      const auto reduced = [share](const double angle) {
        return std::atan(share * std::tan(radians(angle)));
      };
      const double friction = material.friction_angle;
      const double dilation =
        material.dilation_angle < 0. ? friction : material.dilation_angle;
      const double residual_friction =
        or_peak(material.residual_friction_angle, friction);
      const auto tension = [&](const double value) {
        return value < 0. ? value : share * value;
      };
      MohrCoulomb strength;
      strength.peak = YieldStrength::from(share * material.cohesion,
                                          reduced(friction),
                                          reduced(dilation),
                                          tension(material.tensile_strength));
      strength.residual =
        YieldStrength::from(share * or_peak(material.residual_cohesion,
                                            material.cohesion),
                            reduced(residual_friction),
                            reduced(std::min(dilation, residual_friction)),
                            tension(or_peak(material.residual_tensile_strength,
                                            material.tensile_strength)));
      strength.softening_strain = material.softening_strain;
      strength.has_residual     = material.residual_cohesion >= 0. ||
                              material.residual_friction_angle >= 0. ||
                              material.residual_tensile_strength >= 0.;
      return strength;
    }

    template <int dim>
    CellKind
    kind_of(const Material<dim> &material)
    {
      return material.is_plastic()            ? CellKind::plastic
             : material.has_mean_dilatation() ? CellKind::mean_dilatation
                                              : CellKind::elastic;
    }
  } // namespace



  template <int dim>
  double
  StableStep<dim>::limit(const Stage &stage) const
  {
    // y = omega dt / 2 with (1 + alpha) (y^2 + 2 c y) = 1
    const double c = stage.damping_ratio + 0.5 * stage.mass_damping / frequency;
    return 2. / frequency *
           (std::sqrt(c * c + 1. / (1. + stage.local_damping)) - c);
  }



  template <int dim>
  double
  StableStep<dim>::mass_damping_left(const Stage &stage, const double dt) const
  {
    const double y = 0.5 * frequency * dt;
    const double c = stage.damping_ratio + 0.5 * stage.mass_damping / frequency;
    return std::max(0., 1. / (1. + stage.local_damping) - y * (y + 2. * c)) *
           frequency / y;
  }



  template <int dim>
  Conditions<dim>::Conditions(const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Numbering<dim> &numbering,
                              CellArrays<dim> &cells,
                              Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
  {
    const std::size_t n_dofs = std::size_t(dim) * numbering.n_local();
    for (auto *field : {&fields.reference,
                        &fields.displacement,
                        &fields.velocity,
                        &fields.old_velocity,
                        &fields.internal_force,
                        &fields.load,
                        &fields.contact_force})
      field->assign(n_dofs, 0.);
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.reference[dim * node + d] =
          split.mesh.vertices[numbering.vertex_of_node[node]][d];
    fields.is_in_cluster.assign(numbering.n_local(), 0);
    cell_of_local.assign(numbering.mesh_cell.size(), none);
    reduce_strength(1.);
    read_formulas();
    dig(1);
    set_up_initial_state();
    if (scene.time_stepping.is_large())
      {
        fields.position = fields.reference;
        fields.rate     = fields.velocity;
      }
  }



  template <int dim>
  bool
  Conditions<dim>::changes(const unsigned int number) const
  {
    return is_changing(scene, number);
  }



  template <int dim>
  void
  Conditions<dim>::dig(const unsigned int number)
  {
    stage_number = number;
    list_cells();
    set_up_frequencies();
    set_up_mass_scaling();
    set_up_mass();
    set_up_supports();
    set_up_tractions();
  }



  template <int dim>
  void
  Conditions<dim>::remove_block(const unsigned int block)
  {
    if (is_removed.empty())
      for (const unsigned int b : split.block_of_cell)
        if (b != none && b >= is_removed.size())
          is_removed.resize(b + 1, false);
    is_removed[block] = true;
  }



  template <int dim>
  void
  Conditions<dim>::freeze(const std::vector<bool> &is_frozen_cell)
  {
    is_frozen = is_frozen_cell;
    dig(stage_number);
    is_load_set = false;
  }



  template <int dim>
  void
  Conditions<dim>::hold_frozen_nodes()
  {
    if (is_frozen.empty())
      return;
    // of all ranks' cells: those at the rim belong to several
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (is_frozen[c] && !is_dug(c))
        for (const unsigned int vertex : split.mesh.cells[c])
          if (const unsigned int node = numbering.local_node(vertex);
              node != none)
            fields.inverse_mass[node] = 0.;
  }



  template <int dim>
  void
  Conditions<dim>::recall(const StageState &state)
  {
    const bool has_other_cells = stage_number != state.stage_number ||
                                 is_removed != state.is_removed ||
                                 is_frozen != state.is_frozen;
    StageState::operator=(state);
    if (has_other_cells)
      dig(stage_number);
    is_load_set = false;
  }



  template <int dim>
  void
  Conditions<dim>::resume(const StageState &state)
  {
    StageState::operator=(state);
    if (is_far_field_free)
      set_up_far_field();
    dig(stage_number);
  }



  template <int dim>
  void
  Conditions<dim>::reduce_strength(const double share)
  {
    cells.strengths.clear();
    for (const auto &material : scene.materials)
      cells.strengths.push_back(strength_of(*material, share));
  }



  template <int dim>
  void
  Conditions<dim>::list_cells()
  {
    const CellArrays<dim> old      = std::move(cells);
    const unsigned int old_plastic = old.first_plastic();
    cells                          = CellArrays<dim>();
    cells.strengths                = old.strengths;
    cells.plastic_work             = old.plastic_work;
    std::vector<unsigned int> new_place(cell_of_local.size(), none);
    cells.nodes.reserve(new_place.size());
    cells.mesh_cell.reserve(new_place.size());
    cells.lambda.reserve(new_place.size());
    cells.mu.reserve(new_place.size());
    for (unsigned int kind = 0; kind < n_cell_kinds; ++kind)
      {
        cells.kind_begin[kind] = cells.nodes.size();
        for (unsigned int i = 0; i < numbering.mesh_cell.size(); ++i)
          {
            const unsigned int mesh_cell  = numbering.mesh_cell[i];
            const unsigned int m          = material_of(mesh_cell);
            const Material<dim> &material = *scene.materials[m];
            if (is_dug(mesh_cell) ||
                (!is_frozen.empty() && is_frozen[mesh_cell]) ||
                unsigned(kind_of(material)) != kind)
              continue;
            new_place[i] = cells.nodes.size();
            cells.nodes.push_back(
              numbering.nodes_of_cell(split.mesh, mesh_cell));
            cells.mesh_cell.push_back(mesh_cell);
            cells.lambda.push_back(material.lame_lambda());
            cells.mu.push_back(material.shear_modulus());
            const unsigned int before = cell_of_local[i];
            if (!material.is_plastic())
              continue;
            cells.strength.push_back(m);
            for (unsigned int q = 0; q < (1 << dim); ++q)
              cells.plastic_strain.push_back(
                before == none || before < old_plastic
                  ? 0.
                  : old
                      .plastic_strain[(before - old_plastic) * (1 << dim) + q]);
          }
      }
    cells.kind_begin[n_cell_kinds] = cells.nodes.size();
    for (unsigned int kind = 0; kind < n_cell_kinds; ++kind)
      {
        const unsigned int first = cells.kind_begin[kind];
        cells.is_uniform[kind]   = true;
        for (unsigned int c = first; c < cells.kind_begin[kind + 1]; ++c)
          cells.is_uniform[kind] = cells.is_uniform[kind] &&
                                   cells.lambda[c] == cells.lambda[first] &&
                                   cells.mu[c] == cells.mu[first];
      }
    cells.stress.reinit(cells.nodes.size());
    for (unsigned int i = 0; i < new_place.size(); ++i)
      if (new_place[i] != none && cell_of_local[i] != none)
        for (unsigned int q = 0; q < (1 << dim); ++q)
          cells.set_stress(new_place[i], q, old.stress_at(cell_of_local[i], q));
    cell_of_local = new_place;
  }



  template <int dim>
  std::array<std::array<double, dim>, 1 << dim>
  Conditions<dim>::corners_of(const unsigned int mesh_cell) const
  {
    std::array<std::array<double, dim>, 1 << dim> corners;
    for (int v = 0; v < (1 << dim); ++v)
      for (int d = 0; d < dim; ++d)
        corners[v][d] = split.mesh.vertices[split.mesh.cells[mesh_cell][v]][d];
    return corners;
  }



  template <int dim>
  void
  Conditions<dim>::set_up_frequencies()
  {
    Corners<dim, double> last_edges{};
    unsigned int last_material = none;
    double lowest              = std::numeric_limits<double>::max();
    frequency.resize(cells.nodes.size());
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int mesh_cell  = cells.mesh_cell[c];
        const unsigned int m          = material_of(mesh_cell);
        const Material<dim> &material = *scene.materials[m];
        // congruent cells, as in structured meshes, have equal frequencies
        const auto corners = corners_of(mesh_cell);
        auto edges         = corners;
        bool is_congruent  = m == last_material;
        for (int v = 0; v < (1 << dim); ++v)
          for (int d = 0; d < dim; ++d)
            edges[v][d] -= corners[0][d];
        for (int v = 0; v < (1 << dim) && is_congruent; ++v)
          for (int d = 0; d < dim; ++d)
            is_congruent = is_congruent &&
                           std::abs(edges[v][d] - last_edges[v][d]) <
                             1e-12 * std::abs(edges[(1 << dim) - 1][d]) + 1e-14;
        frequency[c]  = is_congruent ? frequency[c - 1]
                                     : highest_frequency<dim>(corners,
                                                             cells.lambda[c],
                                                             cells.mu[c],
                                                             material.density);
        last_edges    = edges;
        last_material = m;
        lowest        = std::min(lowest, frequency[c]);
      }
    lowest_frequency = min_over_ranks(lowest);
  }



  template <int dim>
  void
  Conditions<dim>::list_moving_nodes()
  {
    std::vector<bool> is_outer(numbering.n_local(), false);
    const auto take = [&](const unsigned int vertex) {
      split.for_each_carrier(vertex, [&](const unsigned int carrier, double) {
        for (const unsigned int v : {vertex, carrier})
          if (numbering.is_owned(v))
            is_outer[numbering.local_node(v)] = true;
      });
    };
    for (const unsigned int v : split.interface.group_vertices)
      take(v);
    for (const SurfaceFace<dim> &face : split.interface.surface)
      for (const unsigned int v : face.vertices)
        take(v);
    for (const unsigned int node : numbering.hanging_nodes)
      is_outer[node] = true;
    for (const NodeSupport<dim> &support : fields.supports)
      is_outer[support.node] = true;

    fields.runs.clear();
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (is_outer[node] || fields.inverse_mass[node] > 0.)
        {
          if (fields.runs.empty() || fields.runs.back().end != node ||
              fields.runs.back().is_inner == is_outer[node])
            fields.runs.push_back({node, node, !is_outer[node]});
          ++fields.runs.back().end;
        }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_initial_state()
  {
    if (!scene.initial_state.stress.empty() ||
        scene.initial_state.has_depth_stress())
      {
        const InitialStress<dim> stress(scene.initial_state);
        for (unsigned int c = 0; c < cells.nodes.size(); ++c)
          for (int q = 0; q < (1 << dim); ++q)
            {
              Point<dim> place;
              for (int v = 0; v < (1 << dim); ++v)
                place +=
                  shape<dim>.value[q][v] *
                  split.mesh.vertices[split.mesh.cells[cells.mesh_cell[c]][v]];
              typename StressArray<dim>::Stress value;
              stress.evaluate(place, value.data());
              cells.set_stress(c, q, value);
            }
      }
    if (!scene.initial_state.velocity.empty())
      {
        const Expression<dim> velocity(scene.initial_state.velocity,
                                       dim,
                                       "Initial state/Velocity");
        for (unsigned int node = 0; node < numbering.n_local(); ++node)
          if (fields.inverse_mass[node] > 0.)
            for (int d = 0; d < dim; ++d)
              fields.velocity[dim * node + d] = velocity.value(
                split.mesh.vertices[numbering.vertex_of_node[node]], 0., d);
        numbering.interpolate_hanging(fields.velocity);
      }
  }



  template struct StableStep<2>;
  template struct StableStep<3>;
  template class Conditions<2>;
  template class Conditions<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// From the scene to arrays: cells and their frequencies.
#include <keyblock/step/active_cells.h>

#include <keyblock/rock/cell_geometry.h>

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



  bool
  CellState::operator==(const CellState &other) const
  {
    return stage_number == other.stage_number &&
           is_removed == other.is_removed && is_frozen == other.is_frozen;
  }



  template <int dim>
  ActiveCells<dim>::ActiveCells(const Scene<dim> &scene,
                                const SplitMesh<dim> &split,
                                const Numbering<dim> &numbering,
                                CellArrays<dim> &cells,
                                Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , cell_of_local(numbering.mesh_cell.size(), none)
  {
    reduce_strength(1.);
  }



  template <int dim>
  void
  ActiveCells<dim>::excavate(const unsigned int number)
  {
    stage_number = number;
    list_cells();
    set_up_frequencies();
    set_up_mass_scaling();
    set_up_weighing_mass();
  }



  template <int dim>
  void
  ActiveCells<dim>::remove_block(const unsigned int block)
  {
    if (is_removed.empty())
      for (const unsigned int b : split.block_of_cell)
        if (b != none && b >= is_removed.size())
          is_removed.resize(b + 1, false);
    is_removed[block] = true;
  }



  template <int dim>
  void
  ActiveCells<dim>::reduce_strength(const double share)
  {
    cells.strengths.clear();
    for (const auto &material : scene.materials)
      cells.strengths.push_back(strength_of(*material, share));
  }



  template <int dim>
  const Material<dim> &
  ActiveCells<dim>::material_of(const unsigned int mesh_cell) const
  {
    return *scene.materials[ground().material_of(mesh_cell)];
  }



  template <int dim>
  void
  ActiveCells<dim>::list_cells()
  {
    const CellArrays<dim> old = std::move(cells);
    cells                     = CellArrays<dim>();
    cells.strengths           = old.strengths;
    cells.plastic_work        = old.plastic_work;
    const Ground<dim> ground  = this->ground();
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
            const unsigned int mesh_cell = numbering.mesh_cell[i];
            if (ground.is_excavated(mesh_cell) ||
                (!is_frozen.empty() && is_frozen[mesh_cell]) ||
                unsigned(kind_of(material_of(mesh_cell))) != kind)
              continue;
            new_place[i] = cells.nodes.size();
            add_cell(i, old);
          }
      }
    cells.kind_begin[n_cell_kinds] = cells.nodes.size();
    mark_uniform_kinds();
    cells.stress.reinit(cells.nodes.size());
    for (unsigned int i = 0; i < new_place.size(); ++i)
      if (new_place[i] != none && cell_of_local[i] != none)
        for (unsigned int q = 0; q < (1 << dim); ++q)
          cells.set_stress(new_place[i], q, old.stress_at(cell_of_local[i], q));
    cell_of_local = new_place;
  }



  template <int dim>
  void
  ActiveCells<dim>::add_cell(const unsigned int i, const CellArrays<dim> &old)
  {
    const unsigned int mesh_cell  = numbering.mesh_cell[i];
    const unsigned int m          = ground().material_of(mesh_cell);
    const Material<dim> &material = *scene.materials[m];
    cells.nodes.push_back(numbering.nodes_of_cell(split.mesh, mesh_cell));
    cells.mesh_cell.push_back(mesh_cell);
    cells.lambda.push_back(material.lame_lambda());
    cells.mu.push_back(material.shear_modulus());
    if (!material.is_plastic())
      return;
    cells.strength.push_back(m);
    const unsigned int before = cell_of_local[i], first = old.first_plastic();
    const bool was_plastic = before != none && before >= first;
    for (unsigned int q = 0; q < (1 << dim); ++q)
      cells.plastic_strain.push_back(
        was_plastic ? old.plastic_strain[(before - first) * (1 << dim) + q]
                    : 0.);
  }



  template <int dim>
  void
  ActiveCells<dim>::mark_uniform_kinds()
  {
    for (unsigned int kind = 0; kind < n_cell_kinds; ++kind)
      {
        const unsigned int first = cells.kind_begin[kind];
        cells.is_uniform[kind]   = true;
        for (unsigned int c = first; c < cells.kind_begin[kind + 1]; ++c)
          cells.is_uniform[kind] = cells.is_uniform[kind] &&
                                   cells.lambda[c] == cells.lambda[first] &&
                                   cells.mu[c] == cells.mu[first];
      }
  }



  template <int dim>
  std::array<std::array<double, dim>, 1 << dim>
  ActiveCells<dim>::corners_of(const unsigned int mesh_cell) const
  {
    std::array<std::array<double, dim>, 1 << dim> corners;
    for (int v = 0; v < (1 << dim); ++v)
      for (int d = 0; d < dim; ++d)
        corners[v][d] = split.mesh.vertices[split.mesh.cells[mesh_cell][v]][d];
    return corners;
  }



  template <int dim>
  void
  ActiveCells<dim>::set_up_frequencies()
  {
    Corners<dim, double> last_edges{};
    unsigned int last_material = none;
    double lowest              = std::numeric_limits<double>::max();
    const Ground<dim> ground   = this->ground();
    frequency.resize(cells.nodes.size());
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int mesh_cell = cells.mesh_cell[c];
        const unsigned int m         = ground.material_of(mesh_cell);
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
        frequency[c]  = is_congruent
                          ? frequency[c - 1]
                          : highest_frequency<dim>(corners,
                                                  cells.lambda[c],
                                                  cells.mu[c],
                                                  scene.materials[m]->density);
        last_edges    = edges;
        last_material = m;
        lowest        = std::min(lowest, frequency[c]);
      }
    lowest = numbering.communicator.min(lowest);
    lowest_frequency =
      lowest < std::numeric_limits<double>::max() ? lowest : 0.;
  }



  template class ActiveCells<2>;
  template class ActiveCells<3>;
} // namespace Keyblock

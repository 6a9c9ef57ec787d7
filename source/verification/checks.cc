// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/verification/tools.h>

#include <functional>
#include <map>

namespace Keyblock
{
  template <int dim>
  RockState<dim>
  gather_rock(const SplitMesh<dim> &split,
              const Numbering<dim> &numbering,
              const CellArrays<dim> &cells,
              const Fields<dim> &fields)
  {
    const Mesh<dim> &mesh           = split.mesh;
    constexpr unsigned int n_values = n_stress<dim> + 2; // and strain, presence
    std::vector<double> by_cell(n_values * mesh.n_cells(), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        double *const value = by_cell.data() + n_values * cells.mesh_cell[c];
        for (unsigned int q = 0; q < (1 << dim); ++q)
          {
            const auto stress = cells.stress_at(c, q);
            for (int k = 0; k < n_stress<dim>; ++k)
              value[k] += stress[k] / (1 << dim);
            if (c >= cells.first_plastic() &&
                cells.plastic_strain[(c - cells.first_plastic()) * (1 << dim) +
                                     q] > 0.)
              value[n_stress<dim>] += 1. / (1 << dim);
          }
        value[n_stress<dim> + 1] = 1.;
      }
    numbering.communicator.sum_lists(by_cell);
    std::vector<double> by_vertex(dim * mesh.vertices.size(), 0.);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        by_vertex[dim * numbering.vertex_of_node[node] + d] =
          fields.displacement[dim * node + d];
    numbering.communicator.sum_lists(by_vertex);

    RockState<dim> rock;
    rock.vertices = mesh.vertices;
    rock.displacements.resize(mesh.vertices.size());
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        rock.displacements[v][d] = by_vertex[dim * v + d];
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const double *const value = by_cell.data() + n_values * c;
        if (value[n_stress<dim> + 1] == 0.)
          continue;
        typename RockState<dim>::Cell cell;
        cell.vertices      = mesh.cells[c];
        cell.material      = mesh.material[c];
        cell.volume        = mesh.cell_volume(c);
        cell.center        = mesh.cell_center(c);
        cell.plastic_share = value[n_stress<dim>];
        std::copy(value, value + n_stress<dim>, cell.stress.begin());
        rock.cells.push_back(cell);
      }
    return rock;
  }

  template RockState<2> gather_rock(const SplitMesh<2> &,
                                    const Numbering<2> &,
                                    const CellArrays<2> &,
                                    const Fields<2> &);
  template RockState<3> gather_rock(const SplitMesh<3> &,
                                    const Numbering<3> &,
                                    const CellArrays<3> &,
                                    const Fields<3> &);



  template <int dim>
  CheckValues
  evaluate_checks(const CheckInput<dim> &input)
  {
    using Check = std::function<CheckValues(const CheckInput<dim> &)>;
    static const std::map<ClosedForm, Check> closed_forms = {
      {ClosedForm::incline, check_incline<dim>},
      {ClosedForm::resting, check_resting<dim>},
      {ClosedForm::bar_impact, check_bar_impact<dim>},
      {ClosedForm::oblique_impact, check_oblique_impact<dim>},
      {ClosedForm::bond_break, check_bond_break<dim>},
      {ClosedForm::gravity_column, check_gravity_column<dim>},
      {ClosedForm::kirsch, check_kirsch<dim>},
      {ClosedForm::salencon, check_salencon<dim>},
      {ClosedForm::spherical_cavity, check_spherical_cavity<dim>},
      {ClosedForm::footing, check_footing<dim>},
      {ClosedForm::value, check_value<dim>},
      {ClosedForm::newmark, check_newmark<dim>},
      {ClosedForm::toppling, check_toppling<dim>},
      {ClosedForm::rotation, check_rotation<dim>},
      {ClosedForm::joint_wave, check_joint_wave<dim>}};
    const auto found = closed_forms.find(input.scene.checks.closed_form);
    return found == closed_forms.end() || !input.history.has_last_stage()
             ? CheckValues()
             : found->second(input);
  }

  template CheckValues evaluate_checks(const CheckInput<2> &);
  template CheckValues evaluate_checks(const CheckInput<3> &);
} // namespace Keyblock

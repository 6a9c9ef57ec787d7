// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/joint_point.h>
#include <keyblock/python/any_run.h>

namespace Keyblock::Python
{
  template <int dim>
  JointPointTable
  RunOf<dim>::joint_points() const
  {
    const Model<dim> &model = open().state();
    const Mesh<dim> &mesh   = model.split.mesh;
    JointPointTable table;
    const std::vector<double> u =
      model.values_by_vertex(model.fields.displacement);
    std::vector<PairState<dim>> states;
    if (model.contact)
      states = model.contact->gather_pairs();
    std::vector<unsigned int> block(mesh.vertices.size(), 0);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (const unsigned int b = model.split.block_of_cell[c]; b != none)
        for (const unsigned int vertex : mesh.cells[c])
          block[vertex] = model.blocks.blocks[b].id;
    const auto append = [](Array<double> &array, const auto &vector) {
      for (int d = 0; d < dim; ++d)
        array.values.push_back(vector[d]);
    };
    for (unsigned int p = 0; p < states.size(); ++p)
      {
        const Pair<dim> &pair = model.split.interface.pairs[p];
        if (pair.is_tie() || states[p].is_removed)
          continue;
        Vector<dim> jump;
        for (int d = 0; d < dim; ++d)
          jump[d] = u[dim * pair.plus + d] - u[dim * pair.minus + d];
        const JointPoint<dim> point(pair,
                                    states[p],
                                    jump,
                                    model.contact->present_kick());
        table.joint.push_back(model.scene.joints[pair.joint]->name);
        table.state.push_back(
          joint_state_names()[static_cast<unsigned int>(point.state)]);
        table.blocks.values.push_back(block[pair.minus]);
        table.blocks.values.push_back(block[pair.plus]);
        append(table.place, mesh.vertices[pair.minus]);
        append(table.normal, point.normal);
        append(table.slip, point.slip());
        append(table.shear, point.shear());
        table.area.values.push_back(pair.area);
        table.gap.values.push_back(point.gap());
        table.pressure.values.push_back(point.pressure());
      }
    const std::size_t n = table.joint.size();
    table.blocks.shape  = {n, 2};
    for (Array<double> *array :
         {&table.place, &table.normal, &table.slip, &table.shear})
      array->shape = {n, dim};
    for (Array<double> *array : {&table.area, &table.gap, &table.pressure})
      array->shape = {n};
    return table;
  }

  template JointPointTable RunOf<2>::joint_points() const;
  template JointPointTable RunOf<3>::joint_points() const;
} // namespace Keyblock::Python

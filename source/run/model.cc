// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_geometry.h>
#include <keyblock/run/model.h>
#include <keyblock/scene/step_count.h>

#include <iostream>

namespace Keyblock
{
  template <int dim>
  Model<dim>::Model(const Communicator &communicator,
                    const std::string &scene_file,
                    const std::vector<std::string> &overrides)
    : communicator(communicator)
    , out(std::cout, communicator.is_root())
    , warnings(out)
  {
    scene.read(communicator, scene_file, overrides);
  }



  template <int dim>
  void
  Model<dim>::make_geometry()
  {
    BlockGeometry<dim> made = make_block_geometry(communicator, scene, out);
    quality                 = made.quality;
    mesh_report             = made.report;
    blocks                  = std::move(made.blocks);
    split                   = std::move(made.split);
  }



  template <int dim>
  void
  Model<dim>::set_up()
  {
    numbering  = std::make_unique<Numbering<dim>>(communicator, scene, split);
    conditions = std::make_unique<Conditions<dim>>(
      scene, split, *numbering, cells, fields);
    if (scene.contact.method != ContactMethod::none)
      contact = std::make_unique<Contact<dim>>(
        scene, split, blocks, *numbering, cells, fields);
    step = std::make_unique<ExplicitStep<dim>>(scene,
                                               split,
                                               blocks,
                                               *numbering,
                                               *conditions,
                                               cells,
                                               fields,
                                               contact.get());
    if (!scene.initial_state.measured_points.empty())
      geostress =
        invert_measured_stress(scene, split, *numbering, cells, fields);
    count_cells();
    check_durations();
  }



  template <int dim>
  void
  Model<dim>::count_cells()
  {
    n_cells_global =
      communicator.sum(static_cast<unsigned long long>(cells.nodes.size()));
  }



  template <int dim>
  void
  Model<dim>::check_durations() const
  {
    for (const auto &stage : scene.stages)
      if (stage->duration > 0. && n_cells_global > 0)
        count_steps(*stage, step->longest_step(*stage));
  }



  template <int dim>
  std::vector<double>
  Model<dim>::values_by_vertex(const std::vector<double> &field) const
  {
    std::vector<double> values(dim * split.mesh.vertices.size(), 0.);
    for (unsigned int node = 0; node < numbering->n_owned(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        values[dim * numbering->vertex_of_node[node] + d] =
          field[dim * node + d];
    communicator.sum_lists(values);
    return values;
  }

  template class Model<2>;
  template class Model<3>;
} // namespace Keyblock

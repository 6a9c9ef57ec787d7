// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/cell_order.h>
#include <keyblock/rock/dofs.h>

#include <deal.II/base/partitioner.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/grid/tria_description.h>


#include <algorithm>
#include <numeric>
#include <set>

namespace Keyblock
{
  template <int dim>
  Numbering<dim>::Numbering(const Communicator &communicator,
                            const Scene<dim> &scene,
                            const SplitMesh<dim> &split)
    : communicator(communicator)
  {
    create_triangulation(scene, split.mesh);
    dof_handler = std::make_unique<dealii::DoFHandler<dim>>(*triangulation);
    dof_handler->distribute_dofs(
      dealii::FESystem<dim>(dealii::FE_Q<dim>(1), dim));
    put_interface_last(split);
    create_numbering(scene, split);
  }



  template <int dim>
  Numbering<dim>::~Numbering() = default;



  template <int dim>
  void
  Numbering<dim>::create_triangulation(const Scene<dim> &scene,
                                       const Mesh<dim> &mesh)
  {
    // equal numbers of deformable cells, in chunks of the mesh's order
    std::vector<double> before(mesh.n_cells() + 1, 0.);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      before[c + 1] =
        before[c] + (scene.materials[mesh.material[c]]->is_rigid() ? 1e-3 : 1.);
    const auto rank_of = [&](const unsigned int c) {
      return std::min<unsigned int>(communicator.size() - 1,
                                    before[c] * communicator.size() /
                                      before.back());
    };
    mesh_cell_of_coarse.clear();
    for (unsigned int c = 0, end; c < mesh.n_cells(); c = end)
      {
        for (end = c; end < mesh.n_cells() && rank_of(end) == rank_of(c);)
          ++end;
        const auto chunk = sweep_order(mesh, c, end);
        mesh_cell_of_coarse.insert(mesh_cell_of_coarse.end(),
                                   chunk.begin(),
                                   chunk.end());
      }

    const auto make_serial = [&](dealii::Triangulation<dim> &serial) {
      std::vector<dealii::CellData<dim>> cells(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        std::copy(mesh.cells[mesh_cell_of_coarse[c]].begin(),
                  mesh.cells[mesh_cell_of_coarse[c]].end(),
                  cells[c].vertices.begin());
      serial.create_triangulation(mesh.vertices, cells, dealii::SubCellData());
    };
    if (communicator.size() == 1)
      {
        triangulation = std::make_unique<dealii::Triangulation<dim>>();
        make_serial(*triangulation);
        return;
      }
    const auto partition = [&](dealii::Triangulation<dim> &serial,
                               const MPI_Comm,
                               const unsigned int) {
      for (const auto &cell : serial.active_cell_iterators())
        cell->set_subdomain_id(
          rank_of(mesh_cell_of_coarse[cell->active_cell_index()]));
    };
    const auto description = dealii::TriangulationDescription::Utilities::
      create_description_from_triangulation_in_groups<dim, dim>(
        make_serial, partition, communicator, communicator.size());
    auto distributed =
      std::make_unique<dealii::parallel::fullydistributed::Triangulation<dim>>(
        communicator);
    distributed->create_triangulation(description);
    triangulation = std::move(distributed);
  }



  template <int dim>
  void
  Numbering<dim>::put_interface_last(const SplitMesh<dim> &split)
  {
    const dealii::IndexSet &owned = dof_handler->locally_owned_dofs();
    std::vector<unsigned int> owned_node(split.mesh.vertices.size(), none);
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (cell->is_locally_owned())
        for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
          {
            const auto dof = cell->vertex_dof_index(v, 0);
            if (owned.is_element(dof))
              owned_node[split.mesh.cells[mesh_cell_of(cell)][v]] =
                owned.index_within_set(dof) / dim;
          }
    const unsigned int n_nodes = owned.n_elements() / dim;
    std::vector<bool> is_on_joint(n_nodes, false);
    for (const unsigned int v : split.interface.group_vertices)
      if (owned_node[v] != none)
        is_on_joint[owned_node[v]] = true;
    std::vector<unsigned int> order(n_nodes);
    std::iota(order.begin(), order.end(), 0);
    std::stable_partition(order.begin(),
                          order.end(),
                          [&](const unsigned int node) {
                            return !is_on_joint[node];
                          });
    std::vector<dealii::types::global_dof_index> number(owned.n_elements());
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        number[dim * order[i] + d] = owned.nth_index_in_set(dim * i + d);
    dof_handler->renumber_dofs(number);
  }



  template <int dim>
  void
  Numbering<dim>::create_numbering(const Scene<dim> &scene,
                                   const SplitMesh<dim> &split)
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<unsigned int> found(mesh.vertices.size(), 0);
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int c = mesh_cell_of(cell);
          for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
            found[mesh.cells[c][v]] = cell->vertex_dof_index(v, 0) / dim + 1;
        }
    communicator.max_lists(found);
    node_of_vertex = std::move(found);
    for (unsigned int &node : node_of_vertex)
      --node;

    const dealii::IndexSet &owned = dof_handler->locally_owned_dofs();
    std::set<unsigned int> ghosts;
    const auto is_ghost = [&owned](const unsigned int node) {
      return !owned.is_element(dim * node);
    };
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : mesh.cells[mesh_cell_of(cell)])
          split.for_each_carrier(v, [&](const unsigned int carrier, double) {
            for (const unsigned int node :
                 {node_of_vertex[v], node_of_vertex[carrier]})
              if (is_ghost(node))
                ghosts.insert(node);
          });
    const Interface<dim> &interface    = split.interface;
    std::set<unsigned int> cell_ghosts = ghosts;
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        const auto begin =
          interface.group_vertices.begin() + interface.group_begin[g];
        const auto end =
          interface.group_vertices.begin() + interface.group_begin[g + 1];
        if (std::any_of(begin, end, [&](const unsigned int v) {
              return !is_ghost(node_of_vertex[v]) ||
                     cell_ghosts.count(node_of_vertex[v]);
            }))
          for (auto v = begin; v != end; ++v)
            if (is_ghost(node_of_vertex[*v]))
              ghosts.insert(node_of_vertex[*v]);
      }
    dealii::IndexSet ghost_dofs(owned.size());
    for (const unsigned int node : ghosts)
      ghost_dofs.add_range(dim * node, dim * (node + 1));
    partitioner =
      std::make_shared<dealii::Utilities::MPI::Partitioner>(owned,
                                                            ghost_dofs,
                                                            communicator);
    n_owned_nodes  = partitioner->locally_owned_size() / dim;
    n_local_nodes  = n_owned_nodes + partitioner->n_ghost_indices() / dim;
    n_global_nodes = partitioner->size() / dim;

    vertex_of_node.assign(n_local(), none);
    for (unsigned int v = 0; v < node_of_vertex.size(); ++v)
      if (local_node(v) != none)
        vertex_of_node[local_node(v)] = v;
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int c = mesh_cell_of(cell);
          if (!scene.materials[mesh.material[c]]->is_rigid())
            mesh_cell.push_back(c);
        }
    list_hanging_nodes(split);
  }



  template <int dim>
  void
  Numbering<dim>::list_hanging_nodes(const SplitMesh<dim> &split)
  {
    masters_begin = {0};
    for (const HangingVertex &hanging : split.hanging)
      {
        if (local_node(hanging.vertex) == none)
          continue;
        hanging_nodes.push_back(local_node(hanging.vertex));
        for (const auto &[master, weight] : hanging.masters)
          masters.push_back({local_node(master), weight});
        masters_begin.push_back(masters.size());
      }
  }



  template <int dim>
  void
  Numbering<dim>::add_hanging_to_masters(std::vector<double> &field) const
  {
    for (unsigned int h = 0; h < hanging_nodes.size(); ++h)
      for (unsigned int d = 0; d < dim; ++d)
        {
          double &value = field[dim * hanging_nodes[h] + d];
          for (unsigned int m = masters_begin[h]; m < masters_begin[h + 1]; ++m)
            field[dim * masters[m].node + d] += masters[m].weight * value;
          value = 0.;
        }
  }



  template <int dim>
  void
  Numbering<dim>::interpolate_hanging(std::vector<double> &field) const
  {
    for (unsigned int h = 0; h < hanging_nodes.size(); ++h)
      for (unsigned int d = 0; d < dim; ++d)
        {
          double value = 0.;
          for (unsigned int m = masters_begin[h]; m < masters_begin[h + 1]; ++m)
            value += masters[m].weight * field[dim * masters[m].node + d];
          field[dim * hanging_nodes[h] + d] = value;
        }
  }



  template <int dim>
  unsigned int
  Numbering<dim>::local_node(const unsigned int vertex) const
  {
    const auto dof = dim * node_of_vertex[vertex];
    if (!partitioner->in_local_range(dof) && !partitioner->is_ghost_entry(dof))
      return none;
    return partitioner->global_to_local(dof) / dim;
  }



  template <int dim>
  void
  Numbering<dim>::add_ghosts_to_owners(std::vector<double> &field) const
  {
    if (communicator.size() == 1)
      return;
    const unsigned int n_owned_dofs = partitioner->locally_owned_size();
    const unsigned int n_ghost_dofs = partitioner->n_ghost_indices();
    exchange_buffer.resize(partitioner->n_import_indices());
    const dealii::ArrayView<double> ghosts(field.data() + n_owned_dofs,
                                           n_ghost_dofs);
    const dealii::ArrayView<double> owned(field.data(), n_owned_dofs);
    const dealii::ArrayView<double> buffer(exchange_buffer.data(),
                                           exchange_buffer.size());
    partitioner->import_from_ghosted_array_start(
      dealii::VectorOperation::add, 0, ghosts, buffer, exchange_requests);
    partitioner->import_from_ghosted_array_finish(
      dealii::VectorOperation::add,
      dealii::ArrayView<const double>(exchange_buffer.data(),
                                      exchange_buffer.size()),
      owned,
      ghosts,
      exchange_requests);
  }



  template <int dim>
  void
  Numbering<dim>::update_ghosts(std::vector<double> &field) const
  {
    if (communicator.size() == 1)
      return;
    const unsigned int n_owned_dofs = partitioner->locally_owned_size();
    exchange_buffer.resize(partitioner->n_import_indices());
    const dealii::ArrayView<double> ghosts(field.data() + n_owned_dofs,
                                           partitioner->n_ghost_indices());
    partitioner->export_to_ghosted_array_start(
      0,
      dealii::ArrayView<const double>(field.data(), n_owned_dofs),
      dealii::ArrayView<double>(exchange_buffer.data(), exchange_buffer.size()),
      ghosts,
      exchange_requests);
    partitioner->export_to_ghosted_array_finish(ghosts, exchange_requests);
  }

  template class Numbering<2>;
  template class Numbering<3>;
} // namespace Keyblock

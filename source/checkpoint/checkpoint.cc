// SPDX-License-Identifier: LGPL-2.1-or-later
// The state of a run from the ranks to lists over the whole mesh, and back.
#include <keyblock/checkpoint/checkpoint.h>
#include <keyblock/checkpoint/contact_numbers.h>

#include <keyblock/checkpoint/state_rows.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Add @p list over all ranks, on rank 0. */
    void
    sum_to_root(const Communicator &communicator, std::vector<double> &list)
    {
      if (communicator.size() > 1)
        MPI_Reduce(communicator.is_root() ? MPI_IN_PLACE : list.data(),
                   list.data(),
                   list.size(),
                   MPI_DOUBLE,
                   MPI_SUM,
                   0,
                   communicator);
    }

    /** A list that was read must be as long as mesh and ranks want it. */
    void
    assert_length(const std::string &entry,
                  const std::size_t found,
                  const std::size_t wanted)
    {
      AssertThrow(found == wanted,
                  InputError("The entry '" + entry +
                             "' of the checkpoint has " +
                             std::to_string(found) + " numbers instead of " +
                             std::to_string(wanted) +
                             "; name another by --restart, or leave --restart "
                             "out to start anew."));
    }
  } // namespace



  template <int dim>
  StateExchange<dim>::StateExchange(StateFile &file,
                                    const SplitMesh<dim> &split,
                                    const Numbering<dim> &numbering)
    : file(file)
    , split(split)
    , numbering(numbering)
  {}



  template <int dim>
  void
  StateExchange<dim>::save(const std::string &group, Snapshot<dim> &snapshot)
  {
    exchange(group, snapshot.stage);
    exchange(group, snapshot.fields);
    exchange(group, snapshot.cells);
    exchange(group, snapshot.contact);
    snapshot.step.exchange(file, group + "step/");
  }



  template <int dim>
  void
  StateExchange<dim>::restore(const std::string &group,
                              const RunParts<dim> &run)
  {
    StageState stage = run.conditions.remember(); // with the elements' names
    exchange(group, stage);
    exchange(group, run.fields);
    run.conditions.resume(stage);
    exchange(group, run.cells);
    if (run.contact)
      {
        ContactMemory<dim> memory;
        exchange(group, memory);
        run.contact->resume(memory);
      }
    StepState step;
    step.exchange(file, group + "step/");
    run.step.recall(step);
  }



  template <int dim>
  void
  StateExchange<dim>::exchange_nodes(const std::string &entry,
                                     std::vector<double> &field,
                                     const unsigned int n_values,
                                     const unsigned int n_nodes)
  {
    const auto is_empty =
      numbering.communicator.max(static_cast<unsigned int>(field.size())) == 0;
    std::vector<double> list;
    if (!file.is_read() && !is_empty)
      {
        list.assign(n_values * split.mesh.vertices.size(), 0.);
        for (unsigned int node = 0; node < numbering.n_owned(); ++node)
          std::copy_n(field.begin() + n_values * node,
                      n_values,
                      list.begin() + n_values * numbering.vertex_of_node[node]);
        sum_to_root(numbering.communicator, list);
      }
    file.exchange(entry, list);
    if (!file.is_read())
      return;
    if (!list.empty())
      assert_length(entry, list.size(), n_values * split.mesh.vertices.size());
    field.assign(list.empty() ? 0 : n_values * n_nodes, 0.);
    for (unsigned int node = 0; node < n_nodes && !list.empty(); ++node)
      std::copy_n(list.begin() + n_values * numbering.vertex_of_node[node],
                  n_values,
                  field.begin() + n_values * node);
  }



  template <int dim>
  void
  StateExchange<dim>::exchange_cells(const std::string &entry,
                                     const CellArrays<dim> &cells,
                                     const unsigned int first,
                                     const unsigned int n_values,
                                     std::vector<double> &values)
  {
    std::vector<double> list;
    const auto place = [&](const unsigned int cell) {
      return list.begin() + std::size_t(n_values) * cells.mesh_cell[cell];
    };
    const auto begin = [&](const unsigned int cell) {
      return values.begin() + std::size_t(n_values) * (cell - first);
    };
    if (!file.is_read())
      {
        list.assign(std::size_t(n_values) * split.mesh.n_cells(), 0.);
        for (unsigned int c = first; c < cells.mesh_cell.size(); ++c)
          std::copy_n(begin(c), n_values, place(c));
        sum_to_root(numbering.communicator, list);
      }
    file.exchange(entry, list);
    if (!file.is_read())
      return;
    assert_length(entry,
                  list.size(),
                  std::size_t(n_values) * split.mesh.n_cells());
    for (unsigned int c = first; c < cells.mesh_cell.size(); ++c)
      std::copy_n(place(c), n_values, begin(c));
  }



  template <int dim>
  void
  StateExchange<dim>::exchange(const std::string &group, StageState &state)
  {
    file.exchange(group + "stage_number", state.cells.stage_number);
    file.exchange(group + "is_removed", state.cells.is_removed);
    file.exchange(group + "ramp_duration", state.loads.ramp.duration);
    file.exchange(group + "ramp_progress", state.loads.ramp.progress);
    file.exchange(group + "ramp_pace", state.loads.ramp.pace);
    file.exchange(group + "displacement_left", state.loads.displacement_left);
    file.exchange(group + "displacement_ramped",
                  state.loads.displacement_ramped);
    file.exchange(group + "stage_begins", state.stage_begins);
    exchange_nodes(group + "out_of_balance_force",
                   state.loads.out_of_balance_force,
                   dim,
                   numbering.n_owned());
    for (ForceElementState &element : state.elements)
      {
        file.exchange(group + element.name + "/numbers", element.numbers);
        exchange_nodes(group + element.name + "/nodal",
                       element.nodal,
                       dim,
                       numbering.n_owned());
      }
  }



  template <int dim>
  void
  StateExchange<dim>::exchange(const std::string &group, Fields<dim> &fields)
  {
    const unsigned int n_local = numbering.n_local();
    const std::map<std::string, std::vector<double> *> by_name = {
      {"displacement", &fields.displacement},
      {"position", &fields.position},
      {"velocity", &fields.velocity},
      {"rate", &fields.rate},
      {"internal_force", &fields.internal_force},
      {"load", &fields.load},
      {"contact_force", &fields.contact_force}};
    for (const auto &[name, field] : by_name)
      exchange_nodes(group + name, *field, dim, n_local);
    std::vector<double> flags(fields.is_in_cluster.begin(),
                              fields.is_in_cluster.end());
    exchange_nodes(group + "is_in_cluster", flags, 1, n_local);
    fields.is_in_cluster.assign(flags.begin(), flags.end());
  }



  template <int dim>
  void
  StateExchange<dim>::exchange(const std::string &group, CellArrays<dim> &cells)
  {
    constexpr unsigned int n_points = 1 << dim;
    // cell by cell: other ranks have other batches
    constexpr unsigned int n_values = n_points * n_stress<dim>;
    std::vector<double> stress(std::size_t(n_values) * cells.nodes.size());
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          // as it is kept, to the last digit (CellArrays::stress)
          const auto s = cells.stress.at(c, q);
          std::copy(s.begin(),
                    s.end(),
                    stress.begin() + std::size_t(n_values) * c +
                      n_stress<dim> * q);
        }
    exchange_cells(group + "stress", cells, 0, n_values, stress);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          typename StressArray<dim>::Stress s;
          std::copy_n(stress.begin() + std::size_t(n_values) * c +
                        n_stress<dim> * q,
                      n_stress<dim>,
                      s.begin());
          cells.stress.set(c, q, s);
        }
    exchange_cells(group + "plastic_strain",
                   cells,
                   cells.first_plastic(),
                   n_points,
                   cells.plastic_strain);
    double n_yielding = cells.n_yielding;
    file.exchange_shares(group + "plastic", {&cells.plastic_work, &n_yielding});
    cells.n_yielding = n_yielding;
  }



  template <int dim>
  template <typename T>
  void
  StateExchange<dim>::exchange_pairs(const std::string &entry,
                                     std::vector<T> &state)
  {
    // of each group from the owner of its first vertex, who solves it
    const Interface<dim> &interface = split.interface;
    const std::size_t n             = numbers_of(T()).size();
    std::vector<double> rows(n * state.size(), 0.);
    for (unsigned int g = 0; g < interface.n_groups() && !state.empty(); ++g)
      if (numbering.is_owned(
            interface.group_vertices[interface.group_begin[g]]))
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          {
            const std::vector<double> row = numbers_of(state[p]);
            std::copy(row.begin(), row.end(), rows.begin() + n * p);
          }
    if (!file.is_read())
      sum_to_root(numbering.communicator, rows);
    file.exchange(entry, rows);
    if (!file.is_read())
      return;
    if (!rows.empty())
      assert_length(entry, rows.size(), n * interface.pairs.size());
    state.clear();
    for (std::size_t i = 0; i < rows.size(); i += n)
      state.push_back(from_numbers<T>(rows.data() + i));
  }



  template <int dim>
  void
  StateExchange<dim>::exchange(const std::string &group,
                               ContactMemory<dim> &memory)
  {
    exchange_pairs(group + "pairs", memory.state);
    exchange_pairs(group + "pair_histories", memory.pair_histories);
    exchange_rows(file, group + "surface_contacts", memory.contacts);
    exchange_rows(file, group + "node_histories", memory.node_histories);
    exchange_pairs(group + "pair_springs", memory.pair_springs);
    exchange_rows(file, group + "node_springs", memory.node_springs);
    std::vector<double> normals;
    for (const Vector<dim> &n : memory.normal)
      normals.insert(normals.end(), n.begin(), n.end());
    file.exchange(group + "pair_normals", normals);
    memory.normal.resize(normals.size() / dim);
    for (std::size_t i = 0; i < normals.size(); ++i)
      memory.normal[i / dim][i % dim] = normals[i];
    file.exchange(group + "is_removed_block", memory.is_removed_block);
    file.exchange(group + "is_surface_contact_group",
                  memory.is_surface_contact_group);
    file.exchange(group + "is_surface_contact_node",
                  memory.is_surface_contact_node);
    file.exchange(group + "surface_contact_nodes",
                  memory.surface_contact_nodes);
    file.exchange(group + "surface_contact_groups",
                  memory.surface_contact_groups);
    file.exchange(group + "contact_steps", memory.n_steps);
    file.exchange(group + "last_kick", memory.last_kick);
    file.exchange(group + "searched_position", memory.searched_position);
    std::vector<double> gap = {memory.searched_gap};
    file.exchange(group + "searched_gap", gap);
    memory.searched_gap = gap.at(0);
    file.exchange(group + "is_search_due", memory.is_search_due);
    file.exchange(group + "next_normal_check", memory.next_motion_check);
  }

  template class StateExchange<2>;
  template class StateExchange<3>;
} // namespace Keyblock

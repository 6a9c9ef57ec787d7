// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/data_out_base.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <deal.II/numerics/data_out.h>

#include <keyblock/output/output.h>
#include <keyblock/output/patches.h>

#include <fstream>

namespace Keyblock
{
  template <int dim>
  Output<dim>::Output(const Scene<dim> &scene,
                      const SplitMesh<dim> &split,
                      const Blocks<dim> &blocks,
                      const Numbering<dim> &numbering,
                      const CellArrays<dim> &cells,
                      const Fields<dim> &fields,
                      const Contact<dim> *contact,
                      const std::string &folder)
    : scene(scene)
    , split(split)
    , blocks(blocks)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , contact(contact)
    , folder(folder)
  {}



  template <int dim>
  template <typename Data>
  void
  Output<dim>::write(Data &data, const std::string &base, const double time)
  {
    const std::string number =
      dealii::Utilities::int_to_string(records.size() / 2, 4);
    data.set_flags(vtk_flags(time));
    std::string name = base + "_" + number;
    if (numbering.communicator.size() == 1)
      {
        name += ".vtu";
        numbering.communicator.assert_written(write_file(data, folder + name),
                                              folder + name);
      }
    else
      {
        bool is_written =
          write_file(data,
                     folder + name + "." +
                       std::to_string(numbering.communicator.rank()) + ".vtu");
        if (numbering.communicator.is_root())
          {
            std::vector<std::string> pieces;
            for (unsigned int r = 0; r < numbering.communicator.size(); ++r)
              pieces.push_back(name + "." + std::to_string(r) + ".vtu");
            std::ofstream record(folder + name + ".pvtu");
            data.write_pvtu_record(record, pieces);
            is_written = record.flush() && is_written;
          }
        name += ".pvtu";
        numbering.communicator.assert_written(is_written, folder + name);
      }
    records.emplace_back(time, name);
  }



  template <int dim>
  std::vector<typename Output<dim>::NamedValues>
  Output<dim>::cell_values(
    const std::map<unsigned int, unsigned int> &local_cell) const
  {
    const unsigned int n = numbering.triangulation->n_active_cells();
    dealii::Vector<double> block(n), material(n);
    const std::vector<std::string> components =
      dim == 2 ? std::vector<std::string>{"xx", "yy", "zz", "xy"}
               : std::vector<std::string>{"xx", "yy", "zz", "yz", "xz", "xy"};
    std::vector<dealii::Vector<double>> stress(components.size(),
                                               dealii::Vector<double>(n));
    const bool has_plastic =
      std::any_of(scene.materials.begin(),
                  scene.materials.end(),
                  [](const auto &m) { return m->is_plastic(); });
    dealii::Vector<double> plastic_strain(n);
    for (const auto &cell : numbering.triangulation->active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const unsigned int mesh_cell = numbering.mesh_cell_of(cell);
        const unsigned int i         = cell->active_cell_index();
        const unsigned int b         = split.block_of_cell[mesh_cell];
        block[i]                     = b == none ? 0 : blocks.blocks[b].id;
        material[i]                  = split.mesh.material[mesh_cell];
        const auto found             = local_cell.find(mesh_cell);
        if (found != local_cell.end())
          for (unsigned int q = 0; q < (1 << dim); ++q)
            {
              const auto at_point = cells.stress_at(found->second, q);
              for (unsigned int k = 0; k < components.size(); ++k)
                stress[k][i] += at_point[k] / (1 << dim);
            }
        if (found != local_cell.end() && found->second >= cells.first_plastic())
          for (unsigned int q = 0; q < (1 << dim); ++q)
            plastic_strain[i] +=
              cells.plastic_strain[(found->second - cells.first_plastic()) *
                                     (1 << dim) +
                                   q] /
              (1 << dim);
      }
    std::vector<NamedValues> values = {{"block", block},
                                       {"material", material}};
    for (unsigned int k = 0; k < components.size(); ++k)
      values.emplace_back("stress_" + components[k], stress[k]);
    if (has_plastic)
      values.emplace_back("plastic_strain", plastic_strain);
    return values;
  }



  template <int dim>
  void
  Output<dim>::write_rock(const double time)
  {
    dealii::DataOut<dim> rock;
    rock.attach_dof_handler(*numbering.dof_handler);
    const dealii::IndexSet &owned = numbering.dof_handler->locally_owned_dofs();
    using DofVector = dealii::LinearAlgebra::distributed::Vector<double>;
    DofVector displacement(numbering.partitioner),
      velocity(numbering.partitioner);
    for (unsigned int i = 0; i < owned.n_elements(); ++i)
      {
        displacement.local_element(i) = fields.displacement[i];
        velocity.local_element(i)     = fields.velocity[i];
      }
    displacement.update_ghost_values();
    velocity.update_ghost_values();
    using Interpretation =
      dealii::DataComponentInterpretation::DataComponentInterpretation;
    const std::vector<Interpretation> is_vector(
      dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
    rock.add_data_vector(displacement,
                         std::vector<std::string>(dim, "displacement"),
                         dealii::DataOut<dim>::type_dof_data,
                         is_vector);
    rock.add_data_vector(velocity,
                         std::vector<std::string>(dim, "velocity"),
                         dealii::DataOut<dim>::type_dof_data,
                         is_vector);
    std::map<unsigned int, unsigned int> local_cell;
    for (unsigned int c = 0; c < cells.mesh_cell.size(); ++c)
      local_cell[cells.mesh_cell[c]] = c;
    const std::vector<NamedValues> values = cell_values(local_cell);
    for (const auto &[name, list] : values)
      rock.add_data_vector(list, name);
    rock.set_cell_selection([&](const auto &cell) {
      // not those that are excavated
      if (!cell->is_locally_owned())
        return false;
      const unsigned int c = numbering.mesh_cell_of(cell);
      return local_cell.count(c) > 0 ||
             scene.materials[split.mesh.material[c]]->is_rigid();
    });
    rock.build_patches();
    write(rock, "rock", time);
  }



  template <int dim>
  void
  Output<dim>::write_interface(const double time)
  {
    // the owner of the minus cell holds the nodes of both sides
    std::vector<bool> is_local(split.mesh.n_cells(), false);
    for (const auto &cell : numbering.triangulation->active_cell_iterators())
      if (cell->is_locally_owned())
        is_local[numbering.mesh_cell_of(cell)] = true;

    PatchOutput<dim - 1, dim> faces;
    faces.names = {
      "status", "is_intact", "gap", "slip", "pressure", "shear", "joint"};
    if (contact)
      {
        const auto states = contact->gather_pairs();
        const double kick = contact->present_kick();
        std::map<std::array<unsigned int, 3>, unsigned int> pair_at;
        for (unsigned int p = 0; p < states.size(); ++p)
          pair_at[{{split.interface.pairs[p].minus,
                    split.interface.pairs[p].plus,
                    split.interface.pairs[p].joint}}] = p;
        for (const JointFace &face : split.interface.joint_faces)
          {
            const auto minus =
              split.mesh.face_vertices(face.minus_cell, face.minus_face);
            const auto plus =
              split.mesh.face_vertices(face.plus_cell, face.plus_face);
            const bool is_here = is_local[face.minus_cell];
            if (!is_here)
              continue;
            auto &patch = faces.add();
            for (unsigned int v = 0; v < minus.size(); ++v)
              {
                const unsigned int nm = numbering.local_node(minus[v]);
                Vector<dim> jump{}, n;
                unsigned int p = none;
                for (const unsigned int other : plus)
                  {
                    const auto found =
                      pair_at.find({{minus[v], other, face.joint}});
                    if (found == pair_at.end())
                      continue;
                    p                     = found->second;
                    const unsigned int np = numbering.local_node(other);
                    for (int d = 0; d < dim; ++d)
                      jump[d] = fields.displacement[dim * np + d] -
                                fields.displacement[dim * nm + d];
                  }
                for (int d = 0; d < dim; ++d)
                  patch.vertices[v][d] = fields.reference[dim * nm + d] +
                                         fields.displacement[dim * nm + d];
                if (p == none)
                  continue;
                for (int d = 0; d < dim; ++d)
                  n[d] = split.interface.pairs[p].normal[d];
                const double gap      = dot<dim>(jump, n);
                const double pressure = dot<dim>(states[p].impulse, n);
                const double scale =
                  1. / (kick * split.interface.pairs[p].area);
                patch.data(0, v) = static_cast<int>(states[p].status);
                patch.data(1, v) = states[p].is_intact;
                patch.data(2, v) = gap;
                patch.data(3, v) = norm<dim>(add<dim>(jump, -gap, n));
                patch.data(4, v) = pressure * scale;
                patch.data(5, v) =
                  scale * norm<dim>(add<dim>(states[p].impulse, -pressure, n));
                patch.data(6, v) = face.joint;
              }
          }
      }
    write(faces, "interface", time);
  }



  template <int dim>
  void
  Output<dim>::write_collection() const
  {
    bool is_written = true;
    if (numbering.communicator.is_root())
      {
        std::ofstream pvd(folder + "solution.pvd");
        pvd << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
               "version=\"0.1\">\n  <Collection>\n";
        for (unsigned int i = 0; i < records.size(); ++i)
          pvd << "    <DataSet timestep=\"" << records[i].first << "\" part=\""
              << i % 2 << "\" name=\"" << (i % 2 ? "interface" : "rock")
              << "\" file=\"" << records[i].second << "\"/>\n";
        pvd << "  </Collection>\n</VTKFile>\n";
        is_written = bool(pvd.flush());
      }
    numbering.communicator.assert_written(is_written, folder + "solution.pvd");
  }



  template <int dim>
  void
  Output<dim>::write_vtu(const double time)
  {
    write_rock(time);
    write_interface(time);
    write_collection();
  }

  template class Output<2>;
  template class Output<3>;
} // namespace Keyblock

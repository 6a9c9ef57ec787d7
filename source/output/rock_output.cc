// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/dofs/dof_handler.h>

#include <deal.II/grid/tria.h>

#include <keyblock/output/output.h>
#include <keyblock/rock/mohr_coulomb.h>

#include <limits>

namespace Keyblock
{
  namespace
  {
    using Matrix = double[3][3];

    /** Sort principal stresses, the greatest first, with their directions, the
     * columns of @p vector. */
    void
    sort_principal(double (&value)[3], Matrix &vector)
    {
      for (const auto &[i, j] : {std::pair<int, int>(0, 1), {1, 2}, {0, 1}})
        if (value[i] < value[j])
          {
            std::swap(value[i], value[j]);
            for (double(&row)[3] : vector)
              std::swap(row[i], row[j]);
          }
    }



    /** Stresses of cells: the means over their Gauss points. */
    struct StressArrays
    {
      VtuArray tensor    = VtuArray::tensor("stress (Pa)");
      VtuArray principal = {"principal stress (Pa)",
                            {"1", "2", "3"},
                            VtuArray::Reals()};
      VtuArray direction = VtuArray::vector("direction of principal stress 3");

      /** Add @p mean, n_stress<dim> values [Pa]. */
      template <int dim>
      void
      add(const double *mean)
      {
        const double yz = dim == 3 ? mean[3] : 0.,
                     xz = dim == 3 ? mean[n_stress<dim> - 2] : 0.,
                     xy = mean[n_stress<dim> - 1];
        Matrix s = {{mean[0], xy, xz}, {xy, mean[1], yz}, {xz, yz, mean[2]}};
        for (const double(&row)[3] : s)
          for (const double component : row)
            tensor.add(component);
        double value[3];
        Matrix vector;
        diagonalize(s, value, vector);
        sort_principal(value, vector);
        for (const double v : value)
          principal.add(v);
        for (const double(&row)[3] : vector)
          direction.add(row[2]);
      }
    };



    /** What of plastic cells is written. */
    struct PlasticArrays
    {
      VtuArray strain  = VtuArray::scalar("plastic strain");
      VtuArray yielded = VtuArray::ids("yielded");

      /** Add the cell @p cell of @p cells; `none`: a rigid one. */
      template <int dim>
      void
      add(const CellArrays<dim> &cells, const unsigned int cell)
      {
        double sum      = 0.;
        bool is_yielded = false;
        if (cell != none && cell >= cells.first_plastic())
          for (unsigned int q = 0; q < (1 << dim); ++q)
            {
              const double at_point =
                cells
                  .plastic_strain[(cell - cells.first_plastic()) * (1 << dim) +
                                  q];
              sum += at_point;
              is_yielded = is_yielded || at_point > 0.;
            }
        strain.add(sum / (1 << dim));
        yielded.add_id(is_yielded);
      }
    };



    /** Safety factors by block: value, and SafetyFactor::Outcome from 1 on. */
    class FactorArrays
    {
      using Outcome = SafetyFactor::Outcome;

    public:
      VtuArray factor  = VtuArray::scalar("safety factor");
      VtuArray outcome = VtuArray::ids("safety factor outcome");

      /** Of @p factors the last of each block counts. */
      FactorArrays(const std::vector<SafetyFactor> &factors,
                   const unsigned int n_blocks)
        : last(n_blocks, nullptr)
      {
        for (const SafetyFactor &one : factors)
          last[one.block] = &one;
      }

      /** Names of the ids, in their order. */
      static std::vector<std::string>
      outcomes()
      {
        std::vector<std::string> names = {"none"};
        for (std::string name = name_of(Outcome()); !name.empty();
             name             = name_of(static_cast<Outcome>(names.size() - 1)))
          names.push_back(name);
        return names;
      }

      /** Add what is known of @p block, or not a number. */
      void
      add(const unsigned int block)
      {
        const SafetyFactor *found = block == none ? nullptr : last[block];
        const bool is_number =
          found && (found->outcome == Outcome::bracketed ||
                    found->outcome == Outcome::falls_freely ||
                    found->outcome == Outcome::immovable);
        const bool is_by_statics = found &&
                                   found->outcome == Outcome::by_statics &&
                                   std::isfinite(found->limit_factor);
        const bool is_carried = found && found->outcome == Outcome::carried;
        factor.add(is_by_statics ? found->limit_factor
                   : is_carried  ? found->value_of_group()
                   : is_number   ? found->value()
                                 : std::numeric_limits<double>::quiet_NaN());
        outcome.add_id(found ? static_cast<int>(found->outcome) + 1 : 0);
      }

    private:
      static std::string
      name_of(const Outcome outcome)
      {
        switch (outcome) // (no default: the compiler asks for new ones)
          {
            case Outcome::bracketed:
              return "value";
            case Outcome::falls_freely:
              return "falls freely";
            case Outcome::immovable:
              return "immovable";
            case Outcome::clamped:
              return "clamped";
            case Outcome::undecided:
              return "undecided";
            case Outcome::met:
              return "as wanted";
            case Outcome::by_statics:
              return "limit equilibrium";
            case Outcome::carried:
              return "carried along";
          }
        return "";
      }

      std::vector<const SafetyFactor *> last;
    };



    /** Ids of what cells belong to. */
    template <int dim>
    struct IdArrays
    {
      VtuArray block    = VtuArray::ids("block");
      VtuArray kind     = VtuArray::ids("block class");
      VtuArray material = VtuArray::ids("material");
      VtuArray dug_in   = VtuArray::ids("excavation stage");

      /** BlockClass, then that of cells without a block. */
      static std::vector<std::string>
      classes()
      {
        std::vector<std::string> names;
        for (const BlockClass c : {BlockClass::attached,
                                   BlockClass::exposed,
                                   BlockClass::hidden,
                                   BlockClass::infinite,
                                   BlockClass::rigid})
          names.push_back(to_string(c));
        names.emplace_back("dug later");
        return names;
      }

      void
      add(const Ground<dim> &ground,
          const Blocks<dim> &blocks,
          const unsigned int mesh_cell)
      {
        const SplitMesh<dim> &split = ground.split;
        const unsigned int stage    = ground.stage_number;
        const unsigned int b        = split.block_of_cell[mesh_cell];
        unsigned int c = static_cast<unsigned int>(BlockClass::rigid) + 1;
        if (b != none)
          {
            const auto &by_stage = blocks.blocks[b].class_of_stage;
            c                    = static_cast<unsigned int>(
              by_stage[std::min<std::size_t>(stage, by_stage.size() - 1)]);
          }
        block.add_id(b == none ? 0 : blocks.blocks[b].id);
        kind.add_id(c);
        material.add_id(ground.material_of(mesh_cell));
        dug_in.add_id(split.mesh.excavation_stage[mesh_cell]);
      }
    };



    /** Mean stress over the Gauss points of a cell; zero for a rigid one. */
    template <int dim>
    std::array<double, n_stress<dim>>
    mean_stress(const CellArrays<dim> &cells, const unsigned int cell)
    {
      std::array<double, n_stress<dim>> mean{};
      if (cell != none)
        for (unsigned int q = 0; q < (1 << dim); ++q)
          {
            const auto at_point = cells.stress_at(cell, q);
            for (int k = 0; k < n_stress<dim>; ++k)
              mean[k] += at_point[k] / (1 << dim);
          }
      return mean;
    }
  } // namespace



  template <int dim>
  VtuGrid
  Output<dim>::make_rock(const double time) const
  {
    VtuGrid grid = make_grid(time);
    // cells that are there, with their indices in `cells` or none if rigid
    std::vector<unsigned int> local_cell(split.mesh.n_cells(), none), shown;
    for (unsigned int c = 0; c < cells.mesh_cell.size(); ++c)
      local_cell[cells.mesh_cell[c]] = c;
    for (const auto &cell : numbering.triangulation->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int c = numbering.mesh_cell_of(cell);
          if (local_cell[c] != none ||
              scene.materials[split.mesh.material[c]]->is_rigid())
            shown.push_back(c);
        }

    // their nodes in the order of the numbering
    std::vector<double> displacement = fields.displacement,
                        velocity     = fields.velocity;
    numbering.update_ghosts(displacement);
    numbering.update_ghosts(velocity);
    std::vector<unsigned int> point_of_node(numbering.n_local(), none);
    for (const unsigned int c : shown)
      for (const unsigned int node : numbering.nodes_of_cell(split.mesh, c))
        point_of_node[node] = 0;
    VtuArray u = VtuArray::vector("displacement (m)"),
             v = VtuArray::vector("velocity (m/s)");
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      if (point_of_node[node] != none)
        {
          point_of_node[node] =
            grid.add_point(&fields.reference[dim * node], dim);
          u.add_vector(&displacement[dim * node], dim);
          v.add_vector(&velocity[dim * node], dim);
        }
    grid.point_data = {std::move(u), std::move(v)};

    IdArrays<dim> ids;
    StressArrays stresses;
    PlasticArrays plastic;
    FactorArrays by_block(factors, blocks.blocks.size());
    for (const unsigned int c : shown)
      {
        std::vector<unsigned int> corners;
        for (const unsigned int node : numbering.nodes_of_cell(split.mesh, c))
          corners.push_back(point_of_node[node]);
        grid.add_lattice_cell(corners);
        ids.add({scene, split, stage}, blocks, c);
        stresses.template add<dim>(mean_stress(cells, local_cell[c]).data());
        plastic.add(cells, local_cell[c]);
        by_block.add(split.block_of_cell[c]);
      }
    grid.cell_data = {ids.block,
                      ids.kind,
                      ids.material,
                      ids.dug_in,
                      stresses.tensor,
                      stresses.principal,
                      stresses.direction};
    grid.texts.emplace_back("block class names", IdArrays<dim>::classes());
    if (std::any_of(scene.materials.begin(),
                    scene.materials.end(),
                    [](const auto &m) { return m->is_plastic(); }))
      {
        grid.cell_data.push_back(plastic.strain);
        grid.cell_data.push_back(plastic.yielded);
      }
    if (contact && std::any_of(scene.stages.begin(),
                               scene.stages.end(),
                               [&](const auto &s) {
                                 return scene.safety.wants_stage(s->name);
                               }))
      {
        grid.cell_data.push_back(by_block.factor);
        grid.cell_data.push_back(by_block.outcome);
        grid.texts.emplace_back("safety factor outcome names",
                                FactorArrays::outcomes());
      }
    return grid;
  }

  template VtuGrid Output<2>::make_rock(const double) const;
  template VtuGrid Output<3>::make_rock(const double) const;
} // namespace Keyblock

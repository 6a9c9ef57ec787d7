// SPDX-License-Identifier: LGPL-2.1-or-later
// blocks.csv and factors.csv, for spreadsheets.
#include <keyblock/base/delimited_text.h>
#include <keyblock/base/number_text.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/blocks/excavation_parts.h>
#include <keyblock/blocks/free_faces.h>
#include <keyblock/output/output.h>
#include <keyblock/safety/least_factor.h>
#include <keyblock/scene/gravity.h>

#include <cmath>
#include <fstream>
#include <map>

namespace Keyblock
{
  namespace
  {
    using Outcome = SafetyFactor::Outcome;
    using Fields  = std::vector<std::string>;

    /** A number, or nothing if it is not positive. */
    std::string
    positive(const double value)
    {
      return value > 0. ? exact_text(value) : "";
    }

    std::string
    limit_factor_of(const SafetyFactor &factor)
    {
      return std::isfinite(factor.limit_factor)
               ? exact_text(factor.limit_factor)
               : "stable";
    }

    /** Titles of what factor_fields() gives. */
    Fields
    factor_titles()
    {
      return {"outcome",
              "factor",
              "lower",
              "upper",
              "undecided lower",
              "undecided upper",
              "failure mode",
              "limit equilibrium",
              "limit equilibrium mode",
              "remark",
              "stress ratio",
              "group",
              "group factor",
              "group lower",
              "group upper"};
    }

    /** Titles of what demand_fields() gives. */
    template <int dim>
    Fields
    demand_titles()
    {
      return {"support for factor",
              std::string("support (N") + (dim == 2 ? " per m)" : ")"),
              "support pressure (Pa)",
              "support bolts"};
    }

    /** Numbers of bolts of each set, without those that have none. */
    std::string
    list_bolts(const std::vector<std::pair<std::string, unsigned int>> &numbers)
    {
      std::string bolts;
      for (const auto &[set, number] : numbers)
        if (number > 0)
          bolts +=
            (bolts.empty() ? "" : "; ") + std::to_string(number) + " " + set;
      return bolts;
    }

    Fields
    demand_fields(const SupportDemand &demand)
    {
      const std::string bolts = list_bolts(demand.numbers);
      if (demand.factor > 0. && std::isinf(demand.force))
        return {exact_text(demand.factor),
                "out of reach",
                "out of reach",
                bolts};
      if (demand.factor > 0.)
        return {exact_text(demand.factor),
                exact_text(demand.force),
                exact_text(demand.pressure),
                bolts};
      return Fields(4);
    }

    /** Titles of what tried_demand_fields() gives. */
    template <int dim>
    Fields
    tried_demand_titles()
    {
      return {"support by trials",
              std::string("support by trials (N") +
                (dim == 2 ? " per m)" : ")"),
              "pressure by trials (Pa)",
              "lower pressure (Pa)",
              "upper pressure (Pa)",
              "bolts by trials"};
    }

    Fields
    tried_demand_fields(const TriedDemand &demand)
    {
      const bool is_closed = demand.outcome == TriedDemand::Outcome::bracketed;
      return {describe_outcome(demand),
              is_closed ? exact_text(demand.force()) : "",
              is_closed ? exact_text(demand.pressure()) : "",
              positive(demand.lower),
              positive(demand.upper),
              list_bolts(demand.numbers)};
    }

    Fields
    factor_fields(const SafetyFactor &factor)
    {
      const bool is_closed = factor.outcome == Outcome::bracketed;
      std::string group;
      for (const unsigned int id : factor.group)
        group += (group.empty() ? "" : " ") + std::to_string(id);
      return {describe_outcome(factor),
              is_closed ? exact_text(factor.value()) : "",
              positive(factor.lower),
              positive(factor.upper),
              factor.undecided_upper > 0. ? positive(factor.undecided_lower)
                                          : "",
              positive(factor.undecided_upper),
              factor.failure_mode.text(),
              limit_factor_of(factor),
              factor.limit_mode.text(),
              factor.limit_remark,
              positive(factor.stress_ratio),
              group,
              group.empty() ? "" : positive(factor.value_of_group()),
              group.empty() ? "" : positive(factor.group_lower),
              group.empty() ? "" : positive(factor.group_upper)};
    }

    void
    append(Fields &fields, const Fields &more)
    {
      fields.insert(fields.end(), more.begin(), more.end());
    }

    /** Size and place of a block's free faces in the stage that exposes it. */
    template <int dim>
    class Exposure
    {
    public:
      Exposure(const Scene<dim> &scene, const SplitMesh<dim> &split)
        : scene(scene)
        , split(split.rigid())
        , gravity(scene)
      {}

      /** Area of the free faces, and roof, wall or floor by their mean outward
       * normal; empty without. */
      Fields
      describe(const Block<dim> &block, const unsigned int index)
      {
        if (block.exposed_stage == none)
          return {"", ""};
        std::unique_ptr<FreeFaces<dim>> &free = by_stage[block.exposed_stage];
        if (free == nullptr)
          free = std::make_unique<FreeFaces<dim>>(
            Ground<dim>{scene, split, block.exposed_stage, nullptr});
        double area = 0.;
        Tensor<1, dim> sum;
        for (const unsigned int i : free->of_block(index))
          {
            const Tensor<1, dim> part =
              split.mesh.face_area_vector(free->faces[i].cell,
                                          free->faces[i].face);
            area += part.norm();
            sum += part;
          }
        return {exact_text(area), place_of(sum, block.centroid)};
      }

    private:
      std::string
      place_of(const Tensor<1, dim> &normal, const Point<dim> &at) const
      {
        const Tensor<1, dim> down = gravity.at(at, 0.);
        if (normal.norm() == 0. || down.norm() == 0.)
          return "";
        const double along     = normal * down / (normal.norm() * down.norm());
        const std::string part = part_of_excavation(along);
        return part == "walls" ? "wall" : part;
      }

      const Scene<dim> &scene;
      const SplitMesh<dim> &split;
      const Gravity<dim> gravity;
      std::map<unsigned int, std::unique_ptr<FreeFaces<dim>>> by_stage;
    };

    /** Titles of what place_fields() gives. */
    template <int dim>
    Fields
    place_titles()
    {
      Fields titles;
      for (unsigned int d = 0; d < dim; ++d)
        titles.push_back(std::string(1, "xyz"[d]) + " (m)");
      return titles;
    }

    template <int dim>
    Fields
    place_fields(const Point<dim> &place)
    {
      Fields fields;
      for (unsigned int d = 0; d < dim; ++d)
        fields.push_back(exact_text(place[d]));
      return fields;
    }

    template <int dim>
    std::string
    name_of_stage(const Scene<dim> &scene, const unsigned int number)
    {
      return number < 2 ? "the start" : scene.stages[number - 2]->name;
    }

    template <int dim>
    bool
    is_listed(const Block<dim> &block)
    {
      return !block.is_infinite && !block.is_rigid;
    }

    template <int dim>
    std::string
    blocks_table(const Scene<dim> &scene,
                 const SplitMesh<dim> &split,
                 const Blocks<dim> &blocks,
                 const std::vector<SafetyFactor> &factors,
                 const std::vector<unsigned int> &removal_stage)
    {
      const std::string per_metre = dim == 2 ? " per m" : "";
      Fields titles               = {"block",
                                     "class",
                                     "exposed since",
                                     "place",
                                     "free area (m2" + per_metre + ")",
                                     "removable",
                                     "volume (m3" + per_metre + ")",
                                     "volume of mesh (m3" + per_metre + ")",
                                     "weight (N" + per_metre + ")",
                                     "width (m)",
                                     "cells across",
                                     "joints",
                                     "removed in",
                                     "factor after"};
      append(titles, factor_titles());
      append(titles, demand_titles<dim>());
      titles.emplace_back("support after");
      append(titles, tried_demand_titles<dim>());
      titles.emplace_back("by trials after");
      append(titles, place_titles<dim>());
      std::string text    = csv_line(titles);
      const double weight = weight_per_mass(scene);
      Exposure<dim> exposure(scene, split);
      for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
        {
          const Block<dim> &block = blocks.blocks[b];
          if (!is_listed(block))
            continue;
          std::string joints;
          for (const auto &[joint, area] : block.joint_area)
            joints += (joints.empty() ? "" : " ") + scene.joints[joint]->name;
          const Fields exposed       = exposure.describe(block, b);
          const SafetyFactor *factor = least_factor(factors, b);
          Fields fields              = {std::to_string(block.id),
                                        to_string(block.class_of_stage.back()),
                           block.exposed_stage == none
                                          ? ""
                                          : name_of_stage(scene, block.exposed_stage),
                                        exposed[1],
                                        exposed[0],
                           block.is_removable ? "yes" : "no",
                                        exact_text(block.best_volume()),
                                        exact_text(block.volume),
                                        exact_text(weight * block.best_mass()),
                                        exact_text(block.width),
                                        exact_text(block.cells_across()),
                                        joints,
                           b < removal_stage.size() && removal_stage[b] > 1
                                          ? name_of_stage(scene, removal_stage[b])
                                          : "",
                           factor == nullptr ? "" : factor->stage};
          append(fields,
                 factor == nullptr ? Fields(factor_titles().size())
                                   : factor_fields(*factor));
          const SafetyFactor *asking = largest_demand(factors, b);
          append(fields,
                 demand_fields(asking == nullptr ? SupportDemand()
                                                 : asking->support_demand));
          fields.push_back(asking == nullptr ? "" : asking->stage);
          const SafetyFactor *tried = largest_tried_demand(factors, b);
          append(fields,
                 tried == nullptr ? Fields(tried_demand_titles<dim>().size())
                                  : tried_demand_fields(tried->tried_demand));
          fields.push_back(tried == nullptr ? "" : tried->stage);
          append(fields, place_fields<dim>(block.centroid));
          text += csv_line(fields);
        }
      return text;
    }

    template <int dim>
    std::string
    factors_table(const Blocks<dim> &blocks,
                  const std::vector<SafetyFactor> &factors)
    {
      Fields titles = {"block", "stage"};
      append(titles, factor_titles());
      append(titles, demand_titles<dim>());
      titles.emplace_back("trials");
      append(titles, tried_demand_titles<dim>());
      titles.emplace_back("trials of support");
      std::string text = csv_line(titles);
      for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
        for (const SafetyFactor &factor : factors)
          if (factor.block == b)
            {
              Fields fields = {std::to_string(blocks.blocks[b].id),
                               factor.stage};
              append(fields, factor_fields(factor));
              append(fields, demand_fields(factor.support_demand));
              fields.push_back(std::to_string(factor.trials.size()));
              const TriedDemand &tried = factor.tried_demand;
              append(fields, tried_demand_fields(tried));
              fields.push_back(tried.outcome == TriedDemand::Outcome::not_sought
                                 ? ""
                                 : std::to_string(tried.trials.size()));
              text += csv_line(fields);
            }
      return text;
    }
  } // namespace



  template <int dim>
  void
  Output<dim>::write_tables(
    const std::vector<unsigned int> &removal_stage) const
  {
    const auto write = [&](const std::string &name, const auto &table) {
      const std::string file_name = folder + name;
      bool is_written             = true;
      if (numbering.communicator.is_root())
        {
          std::ofstream out(file_name, std::ios::binary);
          out << table();
          is_written = bool(out.flush());
        }
      numbering.communicator.assert_written(is_written, file_name);
    };
    write("blocks.csv", [&]() {
      return blocks_table(scene, split, blocks, factors, removal_stage);
    });
    write("factors.csv", [&]() { return factors_table(blocks, factors); });
  }

  template void
  Output<2>::write_tables(const std::vector<unsigned int> &) const;
  template void
  Output<3>::write_tables(const std::vector<unsigned int> &) const;
} // namespace Keyblock

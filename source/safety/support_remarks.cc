// SPDX-License-Identifier: LGPL-2.1-or-later
// What is said of the support of a block, and of what it asks for besides.
#include <keyblock/safety/block_remarks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** "block 2" or "blocks 2, 3" of indices. */
    template <int dim>
    std::string
    text_of_blocks(const std::vector<unsigned int> &indices,
                   const Blocks<dim> &blocks)
    {
      std::string text = indices.size() == 1 ? "block" : "blocks";
      for (const unsigned int b : indices)
        text += (b == indices.front() ? " " : ", ") +
                std::to_string(blocks.blocks[b].id);
      return text;
    }

    /** That bolts may break before those of another kind, which stretch
     * otherwise, bear what they can; empty: all are alike, or none breaks. */
    template <int dim>
    std::string
    remark_on_rupture(const Scene<dim> &scene, const BlockSupport<dim> &support)
    {
      using Kind = std::array<double, 6>;
      std::set<std::string> brittle;
      std::set<Kind> kinds;
      for (const auto &pull : support.pulls)
        {
          const BoltSet<dim> &set = *scene.bolts[pull.set];
          kinds.insert(Kind{{set.rupture_strain,
                             set.yield_force,
                             set.young_modulus * set.area,
                             set.free_length,
                             set.bond_stiffness,
                             set.bond_strength}});
          if (set.rupture_strain > 0.)
            brittle.insert(set.name);
        }
      if (brittle.empty() || kinds.size() < 2)
        return "";
      std::string text =
        brittle.size() == 1 ? "bolts of the set" : "bolts of the sets";
      for (const std::string &name : brittle)
        text += (name == *brittle.begin() ? " " : ", ") + name;
      return text + " may break before others bear what they can: all are "
                    "counted at once, trials may find less";
    }

    /** What a wanted factor asks for. */
    template <int dim>
    std::string
    describe_demand(const Scene<dim> &scene,
                    const Blocks<dim> &blocks,
                    const SupportDemand &demand)
    {
      std::ostringstream out;
      out.precision(4);
      const bool is_in_reach  = std::isfinite(demand.force);
      const std::string faces = demand.others.empty()
                                  ? " its free faces"
                                  : " the free faces of it and " +
                                      text_of_blocks(demand.others, blocks) +
                                      " together";
      out << "a factor of " << demand.factor;
      if (is_in_reach)
        out << " asks for " << 1e-3 * demand.force << " kN"
            << (dim == 2 ? "/m" : "") << " against" << faces << ", "
            << 1e-3 * demand.pressure << " kPa";
      else
        out << " is in reach of no pressure on" << faces;
      for (const auto &[name, number] : demand.numbers)
        if (number > 0)
          out << (is_in_reach ? ", or " : ", but of ")
              << describe_bolts(scene, name, number);
        else
          out << (is_in_reach
                    ? ", which no number of bolts like those of the set " +
                        name + " gives"
                    : ", nor of any number of bolts like those of the set " +
                        name)
              << (demand.loose_sets.count(name) > 0
                    ? ", as they end in a block that goes with it"
                    : "");
      return out.str();
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  list_support_remarks(const Ground<dim> &ground,
                       const Blocks<dim> &blocks,
                       const BlockStatics<dim> &statics)
  {
    const BlockSupport<dim> &support = statics.support;
    std::vector<std::string> remarks;
    std::ostringstream out;
    out.precision(4);
    if (support.shotcrete_load.norm() > 0.)
      {
        out << "with " << 1e-3 * support.shotcrete_load.norm() << " kN"
            << (dim == 2 ? "/m" : "") << " of shotcrete on it";
        remarks.push_back(out.str());
      }
    if (support.holds())
      remarks.push_back(
        "with " + support.describe() + ", " +
        name_of(ground.scene.safety.bolt_convention) +
        (statics.limit.is_borne ? ", which bears all that drives it" : ""));
    if (const std::string text = remark_on_rupture(ground.scene, support);
        !text.empty())
      remarks.push_back(text);
    std::vector<unsigned int> carried;
    for (const unsigned int b : support.shared_with)
      if (!blocks.blocks[b].is_infinite && !blocks.blocks[b].is_rigid &&
          std::count(statics.others.begin(), statics.others.end(), b) == 0)
        carried.push_back(b);
    if (!carried.empty())
      remarks.push_back("its bolts also go through " +
                        text_of_blocks(carried, blocks) +
                        ", together with which it has no less");
    if (support.n_broken > 0)
      remarks.push_back(std::to_string(support.n_broken) +
                        (support.n_broken == 1 ? " bolt has" : " bolts have") +
                        " broken");
    if (statics.demand.force > 0.)
      remarks.push_back(describe_demand(ground.scene, blocks, statics.demand));
    return remarks;
  }



  void
  SupportDemand::include(const SupportDemand &other)
  {
    if (other.force == 0.)
      return;
    SupportDemand all = other.force > force ? other : *this;
    if (force > 0.)
      {
        all.numbers.clear();
        for (const auto &[set, number] : numbers)
          for (const auto &[other_set, other_number] : other.numbers)
            if (set == other_set)
              all.numbers.emplace_back(set,
                                       number == 0 || other_number == 0
                                         ? 0
                                         : std::max(number, other_number));
      }
    all.loose_sets.insert(loose_sets.begin(), loose_sets.end());
    all.loose_sets.insert(other.loose_sets.begin(), other.loose_sets.end());
    *this = all;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<std::string> list_support_remarks(                      \
    const Ground<dim> &, const Blocks<dim> &, const BlockStatics<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

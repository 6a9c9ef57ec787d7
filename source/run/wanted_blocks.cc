// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/blocks/free_faces.h>
#include <keyblock/run/wanted_blocks.h>

#include <map>

namespace Keyblock
{
  template <int dim>
  void
  check_wanted_blocks(const std::string &wanted, const Blocks<dim> &blocks)
  {
    for (const std::string &word : dealii::Utilities::split_string_list(wanted))
      {
        if (word.empty() ||
            word.find_first_not_of("0123456789") != std::string::npos)
          continue;
        const std::size_t n = blocks.blocks.size();
        const bool is_one =
          word.size() < 10 && std::stoul(word) <= n && std::stoul(word) > 0;
        std::string what;
        if (!is_one)
          what = n == 0 ? "but there are no blocks"
                        : "but there are only " + std::to_string(n) +
                            " in the block table";
        else if (blocks.blocks[std::stoul(word) - 1].is_infinite)
          what = "which is infinite: it touches a boundary beyond which the "
                 "rock goes on";
        else if (blocks.blocks[std::stoul(word) - 1].is_rigid)
          what = "which is rigid";
        AssertThrow(what.empty(),
                    InputError("The entry 'Safety factor/Blocks' asks for "
                               "block " +
                               word + ", " + what +
                               "; give numbers of finite blocks (they change "
                               "with the mesh), or exposed."));
      }
  }



  namespace
  {
    /** Ids of the wanted blocks that are attached after the stage @p number. */
    template <int dim>
    std::vector<unsigned int>
    list_attached_blocks(const Scene<dim> &scene,
                         const SplitMesh<dim> &split,
                         const Blocks<dim> &blocks,
                         const unsigned int number)
    {
      const Ground<dim> ground{scene, split.rigid(), number, nullptr};
      std::unique_ptr<FreeFaces<dim>> free; // where it matters
      if (scene.safety.wants_exposed_only())
        free = std::make_unique<FreeFaces<dim>>(ground);
      std::vector<unsigned int> ids;
      for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
        if (const Block<dim> &block = blocks.blocks[b];
            scene.safety.wants_block(block.id) &&
            block.class_of_stage[number] == BlockClass::attached &&
            (!free || !free->of_block(b).empty()))
          ids.push_back(block.id);
      return ids;
    }

    std::string
    list_of(const std::vector<unsigned int> &ids)
    {
      std::string text;
      for (const unsigned int id : ids)
        text += (text.empty() ? "" : ", ") + std::to_string(id);
      return (ids.size() == 1 ? "Block " : "Blocks ") + text;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_attached_blocks(const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Blocks<dim> &blocks)
  {
    if (scene.contact.method == ContactMethod::none)
      return {};
    std::map<std::vector<unsigned int>, std::string> stages_of;
    for (const auto &stage : scene.stages)
      if (const unsigned int number = scene.stage_number(stage->name);
          scene.safety.wants_stage(stage->name) && number <= blocks.n_stages)
        {
          std::string &stages =
            stages_of[list_attached_blocks(scene, split, blocks, number)];
          stages += (stages.empty() ? "'" : ", '") + stage->name + "'";
        }
    std::vector<std::string> warnings;
    for (const auto &[ids, stages] : stages_of)
      if (!ids.empty())
        {
          const bool is_one = ids.size() == 1;
          warnings.push_back(
            list_of(ids) + (is_one ? " has" : " have") +
            " no safety factor after " + stages + ": " +
            (is_one ? "it is" : "they are") +
            " one with rock there that a later stage digs; for the factor of "
            "both together leave that excavation out.");
        }
    return warnings;
  }

  template void check_wanted_blocks(const std::string &, const Blocks<2> &);
  template void check_wanted_blocks(const std::string &, const Blocks<3> &);
  template std::vector<std::string>
  warnings_of_attached_blocks(const Scene<2> &,
                              const SplitMesh<2> &,
                              const Blocks<2> &);
  template std::vector<std::string>
  warnings_of_attached_blocks(const Scene<3> &,
                              const SplitMesh<3> &,
                              const Blocks<3> &);
} // namespace Keyblock

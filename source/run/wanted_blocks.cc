// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/run/wanted_blocks.h>

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

  template void check_wanted_blocks(const std::string &, const Blocks<2> &);
  template void check_wanted_blocks(const std::string &, const Blocks<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// What mass scaling did, in words.
#include <keyblock/rock/mass_scaling.h>

#include <iomanip>
#include <sstream>

namespace Keyblock
{
  double
  total_added_fraction(const std::vector<MassScaling> &scaling)
  {
    MassScaling all;
    for (const MassScaling &block : scaling)
      {
        all.added += block.added;
        all.mass += block.mass;
      }
    return all.added_fraction();
  }



  template <int dim>
  std::string
  describe_mass_scaling(const std::vector<MassScaling> &scaling,
                        const Blocks<dim> &blocks,
                        const double least_step)
  {
    if (!is_any_scaled(scaling))
      return "";
    std::ostringstream text, warnings;
    text << std::setprecision(3) << "Masses  added to cells with a step below "
         << least_step << " s: " << 100. * total_added_fraction(scaling)
         << " % of all\n";
    warnings << std::setprecision(3);
    for (unsigned int b = 0; b < scaling.size(); ++b)
      {
        const MassScaling &block = scaling[b];
        if (block.square == 0.)
          continue;
        const std::string name =
          b < blocks.blocks.size()
            ? "block " + std::to_string(blocks.blocks[b].id)
            : "rock that is excavated later";
        text << "        " << name << ": " << 100. * block.added_fraction()
             << " % to " << block.n_cells << " cells\n";
        if (block.is_at_bound)
          warnings << "Warning: The stable step of " << name << " is "
                   << 2. / std::sqrt(block.square)
                   << " s, below 'Time stepping/Least step' (" << least_step
                   << " s): more mass would have to be moved than 'Largest "
                      "added mass' allows; improve the mesh there, or raise "
                      "that entry.\n";
      }
    return text.str() + warnings.str();
  }

  template std::string describe_mass_scaling(const std::vector<MassScaling> &,
                                             const Blocks<2> &,
                                             const double);
  template std::string describe_mass_scaling(const std::vector<MassScaling> &,
                                             const Blocks<3> &,
                                             const double);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// What mass scaling did, in words.
#include <keyblock/rock/mass_scaling.h>

#include <cmath>
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



  namespace
  {
    /** What an entry of the list of scaled masses is called. */
    template <int dim>
    std::string
    name_of_scaled(const Blocks<dim> &blocks, const unsigned int b)
    {
      return b < blocks.blocks.size()
               ? "block " + std::to_string(blocks.blocks[b].id)
               : "rock that is excavated later";
    }
  } // namespace



  template <int dim>
  std::string
  describe_mass_scaling(const std::vector<MassScaling> &scaling,
                        const Blocks<dim> &blocks,
                        const double least_step)
  {
    if (!is_any_scaled(scaling))
      return "";
    std::ostringstream text;
    text << std::setprecision(3) << "Masses  added to cells with a step below "
         << least_step << " s: " << 100. * total_added_fraction(scaling)
         << " % of all\n";
    for (unsigned int b = 0; b < scaling.size(); ++b)
      if (const MassScaling &block = scaling[b]; block.square != 0.)
        text << "        " << name_of_scaled(blocks, b) << ": "
             << 100. * block.added_fraction() << " % to " << block.n_cells
             << " cells\n";
    return text.str();
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_mass_scaling(const std::vector<MassScaling> &scaling,
                           const Blocks<dim> &blocks,
                           const double least_step)
  {
    std::vector<std::string> warnings;
    for (unsigned int b = 0; b < scaling.size(); ++b)
      if (const MassScaling &block = scaling[b];
          block.square != 0. && block.is_at_bound)
        {
          std::ostringstream text;
          text << std::setprecision(3) << "The stable step of "
               << name_of_scaled(blocks, b) << " is "
               << 2. / std::sqrt(block.square)
               << " s, below 'Time stepping/Least step' (" << least_step
               << " s): more mass would have to be moved than 'Largest added "
                  "mass' allows; improve the mesh there, or raise that entry.";
          warnings.push_back(text.str());
        }
    return warnings;
  }

#define INSTANTIATE(dim)                                                       \
  template std::string describe_mass_scaling(const std::vector<MassScaling> &, \
                                             const Blocks<dim> &,              \
                                             const double);                    \
  template std::vector<std::string> warnings_of_mass_scaling(                  \
    const std::vector<MassScaling> &, const Blocks<dim> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

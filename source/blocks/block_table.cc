// SPDX-License-Identifier: LGPL-2.1-or-later
// The table of blocks on the screen.
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/blocks.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/scene/near_misses.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <vector>

namespace Keyblock
{
  namespace
  {
    /** So many joints of an infinite block are named. */
    constexpr unsigned int most_joints_of_infinite = 8;

    /** So many gaps beyond the bridging are listed. */
    constexpr unsigned int most_misses = 5;

    /** So many blocks are listed. */
    constexpr unsigned int most_blocks = 40;

    /** Blocks as they are listed: first those that may fall into an opening,
     * then those behind them, then what reaches the end of the model. */
    template <int dim>
    std::vector<const Block<dim> *>
    exposed_first(const Blocks<dim> &blocks)
    {
      std::vector<const Block<dim> *> list;
      for (const auto &block : blocks.blocks)
        list.push_back(&block);
      const auto rank = [](const Block<dim> &block) {
        return block.is_infinite || block.is_rigid ? 2
               : block.exposed_stage == none       ? 1
                                                   : 0;
      };
      std::stable_sort(list.begin(),
                       list.end(),
                       [&](const auto *one, const auto *other) {
                         return rank(*one) < rank(*other);
                       });
      return list;
    }
  } // namespace



  std::string
  to_string(const BlockClass block_class)
  {
    switch (block_class)
      {
        case BlockClass::attached:
          return "attached";
        case BlockClass::exposed:
          return "exposed";
        case BlockClass::hidden:
          return "hidden";
        case BlockClass::infinite:
          return "infinite";
        default:
          return "rigid";
      }
  }



  template <int dim>
  void
  print_block_table(std::ostream &out,
                    const Blocks<dim> &blocks,
                    const Scene<dim> &scene)
  {
    out << "Blocks\n  id  class      removable  "
        << (dim == 2 ? "area [m2]   weight [kN/m]"
                     : "volume [m3]   weight [kN]")
        << "  centroid [m]                 joints\n";
    const double weight = weight_per_mass(scene);
    const auto list     = exposed_first(blocks);
    unsigned int n_rows = 0;
    for (const Block<dim> *pointer : list)
      {
        if (n_rows++ == most_blocks)
          {
            out << "      and " << list.size() - most_blocks
                << " more; a run writes all finite ones to blocks.csv\n";
            break;
          }
        const Block<dim> &block = *pointer;
        out << std::setw(4) << block.id << "  " << std::left << std::setw(11)
            << to_string(block.class_of_stage.back()) << std::setw(9)
            << (block.is_removable ? "yes" : "no") << std::right
            << std::setprecision(6) << std::setw(12) << block.volume
            << std::setw(13) << 1e-3 * block.mass * weight << "  (";
        // digits enough to tell places in it apart, also far from the origin
        double farthest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          farthest = std::max(farthest, std::abs(block.centroid[d]));
        const bool is_far = farthest > 1000. * block.size;
        out << std::setprecision(
          is_far ? 2 + int(std::ceil(std::log10(farthest / block.size))) : 4);
        const double round_off = 1e-12 * std::max(farthest, block.size);
        for (unsigned int d = 0; d < dim; ++d)
          out << (d ? ", " : "")
              << (std::abs(block.centroid[d]) < round_off ? 0.
                                                          : block.centroid[d]);
        out << ")  ";
        unsigned int n_named = 0;
        for (const auto &[joint, area] : block.joint_area)
          if (!block.is_infinite || n_named++ < most_joints_of_infinite)
            out << scene.joints[joint]->name << ' ';
        if (n_named > most_joints_of_infinite)
          out << "and " << n_named - most_joints_of_infinite << " more ";
        if (block.n_cells == 0 && !block.is_infinite)
          out << " (not in the mesh)";
        else if (block.exact.is_known &&
                 std::abs(block.exact.volume - block.volume) >
                   1e-9 * block.volume)
          out << " (by its planes " << std::setprecision(6)
              << block.exact.volume << (dim == 2 ? " m2)" : " m3)");
        if (blocks.is_unlike(block.id - 1))
          out << " (none of those between the planes)";
        if (block.exposed_stage != none && is_too_coarse(block, scene))
          out << " (only " << std::setprecision(2) << block.cells_across()
              << " cells across)";
        out << '\n';
      }
    const unsigned int n_finite =
      std::count_if(blocks.blocks.begin(),
                    blocks.blocks.end(),
                    [](const auto &block) {
                      return !block.is_infinite && block.n_cells > 0;
                    });
    const auto &planes = blocks.comparison;
    if (planes.is_known)
      {
        out << "      Joints that end within " << std::setprecision(3)
            << planes.bridging
            << " m before another one close against it ('Joints/Bridging').\n";
        const auto misses = list_near_misses(scene,
                                             planes.bridging,
                                             just_beyond * planes.bridging);
        for (unsigned int i = 0; i < misses.size() && i < most_misses; ++i)
          out << (i == 0 ? "      Farther away, and open: " : ", ")
              << scene.joints[misses[i].joint]->name << " ends "
              << misses[i].gap << " m before "
              << scene.joints[misses[i].other]->name;
        if (misses.size() > most_misses)
          out << ", and " << misses.size() - most_misses << " more";
        if (!misses.empty())
          out << ".\n";
      }
    // (where exposed blocks differ, a warning has the numbers)
    if (planes.is_known && planes.n_finite != n_finite && planes.lost.empty() &&
        planes.unlike.empty())
      out << "      The planes of the joints bound " << planes.n_finite
          << " finite blocks, the mesh has " << n_finite << ".\n";
  }

  template void
  print_block_table(std::ostream &, const Blocks<2> &, const Scene<2> &);
  template void
  print_block_table(std::ostream &, const Blocks<3> &, const Scene<3> &);
} // namespace Keyblock

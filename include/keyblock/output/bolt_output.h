// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_bolt_output_h
#define keyblock_output_bolt_output_h

#include <nlohmann/json_fwd.hpp>

#include <keyblock/base/vtu_file.h>
#include <keyblock/step/bolts.h>

namespace Keyblock
{
  /** A bolt in summary.json. */
  struct BoltFigures
  {
    std::string set;
    std::vector<double> head, end;   ///< [m]
    double largest_axial_force = 0.; ///< tension positive [N]
    double place               = 0.; ///< of that, from the head [m]
    double plate_force         = 0.; ///< [N]
    double largest_slip        = 0.; ///< of the grout [m]
    double dowel_force         = 0.; ///< largest [N]
    unsigned int n_crossings   = 0;  ///< of joints between blocks
    bool is_broken             = false;
    double cut_length          = 0.; ///< dug with the rock around it [m]
    std::string limit; ///< what governs it where it crosses; empty: it does not
  };

  template <int dim>
  std::vector<BoltFigures>
  list_figures(const std::vector<BoltReport<dim>> &reports,
               const Scene<dim> &scene);

  /**
   * Write bolts as lines where they were installed, with forces and slips, for
   * the last of @p records (Output::records), and bolts.pvd with all
   * of them; nothing if there are no bolts. Rank 0 only.
   */
  template <int dim>
  void write_bolts(const std::string &folder,
                   const std::vector<VtuRecord> &records,
                   const std::vector<BoltReport<dim>> &reports,
                   const Scene<dim> &scene);

  /** They stand in summary.json so. */
  nlohmann::ordered_json bolts_as_json(const std::vector<BoltFigures> &bolts);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_liner_output_h
#define keyblock_output_liner_output_h

#include <nlohmann/json_fwd.hpp>

#include <keyblock/base/vtu_file.h>
#include <keyblock/step/shotcrete.h>
#include <keyblock/step/structural_liner.h>

namespace Keyblock
{
  /** A structural liner in summary.json and on the screen. */
  struct LinerFigures
  {
    unsigned int liner;              ///< index into Scene::liners
    double area                = 0.; ///< that is there [m2]
    double largest_compression = 0.; ///< thrust, positive [N/m]
    double largest_tension     = 0.; ///< thrust, positive [N/m]
    double largest_moment      = 0.; ///< of either sign [N]
    double largest_shear       = 0.; ///< in 2D, of either sign [N/m]
    SectionCheck check;              ///< of the worst section
    std::vector<double> place;       ///< of that, middle of its face [m]
    double exceeded_area = 0.;       ///< of faces with a factor below 1 [m2]
  };

  template <int dim>
  LinerFigures list_figures(const LinerLoads<dim> &loads);

  /** Shotcrete stands in summary.json so, with what structural liners among it
   * bear. */
  template <int dim>
  nlohmann::ordered_json
  liners_as_json(const std::vector<LinerReport> &liners,
                 const std::vector<LinerFigures> &structural,
                 const Scene<dim> &scene);

  /** A line for people. */
  std::string describe(const LinerFigures &figures, const Liner &liner);

  /** A sentence if a section is beyond its strength, or empty. */
  std::string warning_of(const LinerFigures &figures, const Liner &liner);

  /**
   * Write the faces of structural liners with thrusts and moments, for the last
   * of @p records (Output::records), and liners.pvd with all of them;
   * nothing if there is none. Rank 0 only.
   */
  template <int dim>
  void write_liners(const std::string &folder,
                    const std::vector<VtuRecord> &records,
                    const std::vector<LinerLoads<dim>> &loads,
                    const Scene<dim> &scene);
} // namespace Keyblock

#endif

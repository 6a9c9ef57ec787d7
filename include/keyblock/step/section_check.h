// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_section_check_h
#define keyblock_step_section_check_h

#include <keyblock/rock/liner_shell.h>
#include <keyblock/scene/liner.h>

#include <limits>

namespace Keyblock
{
  /** How far thrust and moment of a section are from its strength. */
  struct SectionCheck
  {
    /** Both times this reach the strength; infinite: nothing to compare. */
    double factor = std::numeric_limits<double>::infinity();

    bool is_tension = false; ///< the tensile strength is what they reach
  };

  /**
   * Factor of safety of the section of @p liner under thrust and moment: the
   * elastic stress of its outer fibres, N / t +- 6 M / t^2, in 3D the principal
   * ones, reaches its compressive or its tensile strength. In a diagram of
   * moments and thrusts these are the straight bounds of Carranza-Torres and
   * Diederichs (2009), drawn for every factor.
   */
  template <int dim>
  SectionCheck check_section(const Liner &liner, const LinerForce<dim> &force);
} // namespace Keyblock

#endif

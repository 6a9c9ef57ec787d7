// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_bolt_warnings_h
#define keyblock_run_bolt_warnings_h

#include <keyblock/blocks/ground.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Sets of bolts whose segments are too long for their grout, as sentences.
   */
  template <int dim>
  std::vector<std::string>
  warnings_of_coarse_bolts(const Scene<dim> &scene,
                           const SplitMesh<dim> &split);

  /** Sets of bolts that break at an opening which their segments decide on, as
   * sentences. */
  template <int dim>
  std::vector<std::string>
  warnings_of_brittle_bolts(const Scene<dim> &scene,
                            const SplitMesh<dim> &split);

  /** Sets of bolts of which later stages dig something, as sentences. */
  template <int dim>
  std::vector<std::string> warnings_of_cut_bolts(const Scene<dim> &scene,
                                                 const SplitMesh<dim> &split);

  /** Sets of bolts of which none crosses a joint that is cut, as sentences, in
   * scenes with joints. */
  template <int dim>
  std::vector<std::string> warnings_of_idle_bolts(const Scene<dim> &scene,
                                                  const SplitMesh<dim> &split);

  /** Sets of bolts with heads in the air, farther before the free face than a
   * head is moved onto it, as sentences. */
  template <int dim>
  std::vector<std::string>
  warnings_of_heads_in_air(const Scene<dim> &scene,
                           const SplitMesh<dim> &split);

  /** Sets of bolts that the stage of @p ground installs partly where blocks
   * have been taken away before, as sentences. */
  template <int dim>
  std::vector<std::string> warnings_of_bolts_in_void(const Ground<dim> &ground);
} // namespace Keyblock

#endif

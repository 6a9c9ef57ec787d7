// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_kept_states_h
#define keyblock_run_kept_states_h

#include <keyblock/base/communicator.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** A file with the end of a stage. */
  struct KeptState
  {
    std::string file;
    unsigned int stage = 0;    ///< index into Scene::stages
    bool is_wanted     = true; ///< by Safety factor/Stages
  };

  /**
   * The states from which factors are found: those of the stages that the
   * scene asks for and, for the report, the last one, in the order of stages.
   * Throws InputError if they cannot answer (collective).
   * @param source folder of a run that has kept them, or one of its files
   */
  template <int dim>
  std::vector<KeptState> list_kept_states(const Communicator &communicator,
                                          const std::string &source,
                                          const Scene<dim> &scene);
} // namespace Keyblock

#endif

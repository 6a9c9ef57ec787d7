// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_once_gone_h
#define keyblock_safety_once_gone_h

#include <string>
#include <vector>

namespace Keyblock
{
  /** What limit equilibrium says of a block once neighbours that fail have
   * gone. */
  struct OnceGone
  {
    std::vector<unsigned int> blocks; ///< ids of these, ascending; empty: their
                                      ///< going lowers no factor
    double factor = 0.;               ///< [-]
    std::string mode;
  };
} // namespace Keyblock

#endif

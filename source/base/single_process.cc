// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/single_process.h>

#include <cstdlib>

namespace Keyblock
{
  void
  start_no_daemon()
  {
    const int replace = 0;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", replace);
  }
} // namespace Keyblock

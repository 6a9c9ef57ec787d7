// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_slow_mode_h
#define keyblock_safety_slow_mode_h

#include <keyblock/base/communicator.h>
#include <keyblock/rock/fields.h>

#include <vector>

namespace Keyblock
{
  /**
   * Tells the frequency of the mode by which some nodes creep to rest: the
   * Rayleigh quotient of how far they moved within a check interval, and of how
   * the forces on them changed (Underwood 1983: adaptive dynamic relaxation).
   */
  template <int dim>
  class SlowMode
  {
  public:
    /** Check owned @p nodes (local numbers), now for the first time. */
    SlowMode(const Communicator &communicator,
             const Fields<dim> &fields,
             const std::vector<unsigned int> &nodes);

    /** Angular frequency [rad/s], with the masses in use, of a mode that the
     * last checks agree on; 0 if they do not (collective). */
    double check();

  private:
    struct Sample
    {
      std::vector<double> displacement; ///< dim x nodes [m]
      std::vector<double> unbalanced;   ///< force, damping apart [N]
    };

    Sample take_sample() const;

    const Communicator communicator;
    const Fields<dim> &fields;
    const std::vector<unsigned int> &nodes;
    Sample before;
    double last_frequency = 0.;
    unsigned int n_alike  = 0; ///< checks in a row
  };
} // namespace Keyblock

#endif

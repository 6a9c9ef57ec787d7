// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_slip_record_h
#define keyblock_safety_slip_record_h

#include <cstdint>
#include <vector>

namespace Keyblock
{
  /**
   * How far blocks had gone after n, n/2 and n/4 steps, n being a power of
   * two times a first number: tells blocks that slide
   * steadily, under whatever damping, from such as come to rest.
   */
  class SlipRecord
  {
  public:
    /** Forget everything and begin at step @p n_steps, as while a ramp is still
     * going on. */
    void restart(const std::uint64_t n_steps);

    /** Offer the way [m] of all blocks after @p n_steps; whether it is taken.
     */
    bool offer(const std::uint64_t n_steps, const std::vector<double> &ways);

    /** Whether a block went on, in the half of the time that ended with the
     * last record, by at least @p way [m] and at a @p share of its speed in the
     * quarter before. */
    bool is_steady(const unsigned int block,
                   const double way,
                   const double share) const;

    /** Way of a block since the last record but one [m], and steps, up to now;
     * zero without records. */
    struct Motion
    {
      double way;
      std::uint64_t n_steps;
    };
    Motion motion_since(const unsigned int block,
                        const std::uint64_t n_steps,
                        const double way) const;

    /** For checkpoints: the records, newest first. */
    std::uint64_t begin = 0; ///< step from which steps are counted
    std::vector<std::uint64_t> steps;
    std::vector<double> slips; ///< ways of all blocks, record by record [m]

  private:
    double
    slip_at(const unsigned int record, const unsigned int block) const
    {
      return slips[record * (slips.size() / steps.size()) + block];
    }
  };
} // namespace Keyblock

#endif

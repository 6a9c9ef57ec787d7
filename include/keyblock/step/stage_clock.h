// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_stage_clock_h
#define keyblock_step_stage_clock_h

#include <limits>
#include <vector>

namespace Keyblock
{
  /** When each stage began: motions of histories are counted from there, since
   * nobody knows beforehand how long a quasi-static stage will take. */
  class StageClock
  {
  public:
    /** Stage @p number (Scene::stage_number) begins at @p time [s], unless it
     * has begun before. */
    void
    begin(const unsigned int number, const double time)
    {
      if (number > begins.size())
        begins.resize(number, time);
    }

    /** Time from the beginning of stage @p number to @p time [s]; if it has not
     * begun, before all that it has. */
    double
    since(const unsigned int number, const double time) const
    {
      return number <= begins.size() ? time - begins[number - 1]
                                     : std::numeric_limits<double>::lowest();
    }

    /** Whether time stands: what is given by formulas in t and by histories
     * stays as it is, and motions that are given are at rest. */
    bool
    stands() const
    {
      return is_standing;
    }

    void
    stand(const bool stands)
    {
      is_standing = stands;
    }

    const std::vector<double> &
    state() const
    {
      return begins;
    }

    void
    recall(const std::vector<double> &state)
    {
      begins = state;
    }

  private:
    std::vector<double> begins; ///< of stages 1, 2, ... [s]
    bool is_standing = false;
  };
} // namespace Keyblock

#endif

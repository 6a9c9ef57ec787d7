// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/slip_record.h>

namespace Keyblock
{
  namespace
  {
    constexpr unsigned int most_records = 3, first_record = 400;
  } // namespace



  void
  SlipRecord::restart(const std::uint64_t n_steps)
  {
    begin = n_steps;
    steps.clear();
    slips.clear();
  }



  bool
  SlipRecord::offer(const std::uint64_t n_steps,
                    const std::vector<double> &ways)
  {
    const std::uint64_t n = n_steps - begin;
    if (n < (steps.empty() ? first_record : 2 * steps[0]))
      return false;
    steps.insert(steps.begin(), n);
    slips.insert(slips.begin(), ways.begin(), ways.end());
    if (steps.size() > most_records)
      {
        steps.resize(most_records);
        slips.resize(most_records * ways.size());
      }
    return true;
  }



  bool
  SlipRecord::is_steady(const unsigned int block,
                        const double way,
                        const double share) const
  {
    if (steps.size() < most_records)
      return false;
    const double late  = slip_at(0, block) - slip_at(1, block);
    const double early = slip_at(1, block) - slip_at(2, block);
    return early > 0. && late > way &&
           late * (steps[1] - steps[2]) > share * early * (steps[0] - steps[1]);
  }



  SlipRecord::Motion
  SlipRecord::motion_since(const unsigned int block,
                           const std::uint64_t n_steps,
                           const double way) const
  {
    const unsigned int record = steps.size() > 1 ? 1 : 0;
    if (steps.empty() || n_steps - begin <= steps[record])
      return {0., 0};
    return {way - slip_at(record, block), n_steps - begin - steps[record]};
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_history_columns_h
#define keyblock_base_history_columns_h

#include <keyblock/base/delimited_text.h>
#include <keyblock/base/time_series.h>

namespace Keyblock
{
  /** What the columns of a history hold: the time, then one for each axis. */
  struct HistoryColumns
  {
    /** Read it from the header: units in brackets behind names, and axes by
     * names: x, y, z, also as their last letters, or east, north, up and the
     * like. Throws InputError for units that are not known or are none of
     * times or of values in @p si_unit (m/s, m/s2, Pa), for names of another
     * quantity or that are not known, and for an axis that is there twice. */
    HistoryColumns(const DelimitedText &table,
                   const std::string &si_unit,
                   const std::string &entry);

    std::vector<double> factors;       ///< of each column, to units of SI
    std::vector<unsigned int> columns; ///< of each axis
  };

  /** As TimeSeries::read(), of values in @p si_unit where the header names no
   * unit. Times may be uneven by as much as their digits leave open. */
  TimeSeries read_history(const std::string &file_name,
                          const std::string &entry,
                          const unsigned int n_components,
                          const std::string &si_unit);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_time_series_h
#define keyblock_base_time_series_h

#include <string>
#include <vector>

namespace Keyblock
{
  /** Values of a few components at even times. */
  class TimeSeries
  {
  public:
    /** @param values one list of equal length per component */
    TimeSeries(const double start,
               const double interval,
               std::vector<std::vector<double>> values);

    /**
     * Read a CSV file: a header, then rows of the time [s] and one value per
     * component. Throws InputError with file, line and value for rows that are
     * no numbers, times that do not grow evenly (to 1e-3 of the interval), and
     * other than @p n_components values; @p entry names the file in the scene.
     */
    static TimeSeries read(const std::string &file_name,
                           const std::string &entry,
                           const unsigned int n_components);

    /** Value at @p time [s], linear between the rows; 0 before the first and
     * after the last. */
    double value(const double time, const unsigned int component) const;

    /** Its integral over time, by the trapezoidal rule, from 0 at the start. */
    TimeSeries integral() const;

    /** With rows of the last value up to the time @p until [s], or the first
     * one after it. */
    TimeSeries held_until(const double until) const;

    TimeSeries operator*(const double factor) const;

    /** Value of the last row. */
    double
    last(const unsigned int component) const
    {
      return values[component].back();
    }

    double largest_magnitude() const;

    /** Frequency [Hz] below which @p share of the energy (square of the values,
     * all components) lies, by a discrete Fourier transform. */
    double frequency_below(const double share) const;

    double
    start_time() const
    {
      return start;
    }

    double
    end_time() const
    {
      return start + interval * (values.front().size() - 1);
    }

    unsigned int
    n_components() const
    {
      return values.size();
    }

  private:
    double start, interval; ///< [s]
    std::vector<std::vector<double>> values;
  };
} // namespace Keyblock

#endif

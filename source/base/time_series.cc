// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/delimited_text.h>
#include <keyblock/base/errors.h>
#include <keyblock/base/history_columns.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/time_series.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>

namespace Keyblock
{
  namespace
  {
    /** Times may differ from even ones by this share of the interval. */
    constexpr double largest_unevenness = 1e-3;

    /** The same of times that are rounded. */
    constexpr double largest_rounding = 0.2;

    /** Fourier transform of 2^n values, in place. */
    void
    transform(std::vector<std::complex<double>> &x)
    {
      const std::size_t n = x.size();
      if (n < 2)
        return;
      std::vector<std::complex<double>> even(n / 2), odd(n / 2);
      for (std::size_t i = 0; i < n / 2; ++i)
        {
          even[i] = x[2 * i];
          odd[i]  = x[2 * i + 1];
        }
      transform(even);
      transform(odd);
      for (std::size_t k = 0; k < n / 2; ++k)
        {
          const std::complex<double> turned =
            std::polar(1., -2. * std::acos(-1.) * k / n) * odd[k];
          x[k]         = even[k] + turned;
          x[k + n / 2] = even[k] - turned;
        }
    }

    double
    number_at(const DelimitedText &table,
              const DelimitedText::Row &row,
              const unsigned int column)
    {
      double value = 0.;
      AssertThrow(
        read_number(row.fields[column], table.has_decimal_comma(), value) &&
          std::isfinite(value),
        InputError("Line " + std::to_string(row.line) + " of the history '" +
                   table.file_name + "' has '" + row.fields[column] +
                   "' in column " + std::to_string(column + 1) +
                   ", which is not a number; write digits with a decimal "
                   "point."));
      return value;
    }

    /** Worth of the last digit of the time that has most digits behind the
     * point. */
    double
    last_digit_of_times(const DelimitedText &table)
    {
      double least = 1.;
      for (const DelimitedText::Row &row : table.rows)
        {
          const std::string &text = row.fields[0];
          const auto exponent     = text.find_first_of("eE");
          const auto point        = text.find_first_of(".,");
          double digit            = 1.;
          if (point != std::string::npos)
            digit = std::pow(10., 1. + point - std::min(exponent, text.size()));
          if (exponent != std::string::npos)
            digit *= std::pow(10., std::atof(text.c_str() + exponent + 1));
          least = std::min(least, digit);
        }
      return least;
    }
  } // namespace



  TimeSeries::TimeSeries(const double start,
                         const double interval,
                         std::vector<std::vector<double>> values)
    : start(start)
    , interval(interval)
    , values(std::move(values))
  {}



  TimeSeries
  TimeSeries::read(const std::string &file_name,
                   const std::string &entry,
                   const unsigned int n_components)
  {
    return read_history(file_name, entry, n_components, "m/s");
  }



  TimeSeries
  read_history(const std::string &file_name,
               const std::string &entry,
               const unsigned int n_components,
               const std::string &si_unit)
  {
    const DelimitedText table = read_delimited_text(file_name, entry);
    AssertThrow(table.header.fields.size() == n_components + 1,
                InputError("The history '" + file_name + "' of the entry '" +
                           entry + "' has " +
                           count_text(table.header.fields.size(), "column") +
                           "; it needs " + std::to_string(n_components + 1) +
                           ": the time and one for each axis."));
    const auto is_number = [&](const std::string &field) {
      double value = 0.;
      return read_number(field, table.has_decimal_comma(), value);
    };
    AssertThrow(!std::all_of(table.header.fields.begin(),
                             table.header.fields.end(),
                             is_number),
                InputError("The history '" + file_name + "' of the entry '" +
                           entry +
                           "' begins with numbers; give it a first line with "
                           "names of its columns, as time,x,y."));
    AssertThrow(table.rows.size() >= 2,
                InputError("The history '" + file_name + "' of the entry '" +
                           entry + "' has " +
                           count_text(table.rows.size(), "row") +
                           "; give at least two."));
    const HistoryColumns header(table, si_unit, entry);
    std::vector<double> time;
    std::vector<std::vector<double>> values(n_components);
    for (const DelimitedText::Row &row : table.rows)
      {
        time.push_back(header.factors[0] * number_at(table, row, 0));
        for (unsigned int c = 0; c < n_components; ++c)
          {
            const unsigned int column = header.columns[c];
            values[c].push_back(header.factors[column] *
                                number_at(table, row, column));
          }
      }
    const auto place = [&](const unsigned int i) {
      return "Line " + std::to_string(table.rows[i].line) +
             " of the history '" + file_name + "' has the time " +
             text_of(time[i]) + " s";
    };
    for (unsigned int i = 1; i < time.size(); ++i)
      AssertThrow(time[i] > time[i - 1],
                  InputError(place(i) + " after " + text_of(time[i - 1]) +
                             " s; give times that grow evenly."));
    const double interval = (time.back() - time.front()) / (time.size() - 1);
    // both the row and the ends may be rounded
    const double rounding =
      std::min(header.factors[0] * last_digit_of_times(table),
               largest_rounding * interval);
    for (unsigned int i = 1; i < time.size(); ++i)
      AssertThrow(std::abs(time[i] - time[0] - i * interval) <=
                    largest_unevenness * interval + rounding,
                  InputError(place(i) + ", where rows are " +
                             text_of(interval) +
                             " s apart in the mean; give even times."));
    return TimeSeries(time.front(), interval, std::move(values));
  }



  double
  TimeSeries::value(const double time, const unsigned int component) const
  {
    const std::vector<double> &v = values[component];
    const double place           = (time - start) / interval;
    if (!(place >= 0.) || place > v.size() - 1.)
      return 0.;
    const std::size_t i = std::min<std::size_t>(place, v.size() - 2);
    return v[i] + (place - i) * (v[i + 1] - v[i]);
  }



  TimeSeries
  TimeSeries::integral() const
  {
    std::vector<std::vector<double>> sums;
    for (const std::vector<double> &v : values)
      {
        std::vector<double> sum(v.size(), 0.);
        for (std::size_t i = 1; i < v.size(); ++i)
          sum[i] = sum[i - 1] + 0.5 * interval * (v[i - 1] + v[i]);
        sums.push_back(sum);
      }
    return TimeSeries(start, interval, sums);
  }



  TimeSeries
  TimeSeries::held_until(const double until) const
  {
    constexpr double rounding = 1e-6; // of an interval
    TimeSeries result(*this);
    const double n_rows = std::ceil((until - start) / interval - rounding) + 1.;
    for (std::vector<double> &v : result.values)
      if (n_rows > v.size())
        v.resize(n_rows, v.back());
    return result;
  }



  TimeSeries
  TimeSeries::operator*(const double factor) const
  {
    TimeSeries result(*this);
    for (std::vector<double> &v : result.values)
      for (double &x : v)
        x *= factor;
    return result;
  }



  double
  TimeSeries::largest_magnitude() const
  {
    double largest = 0.;
    for (const std::vector<double> &v : values)
      for (const double x : v)
        largest = std::max(largest, std::abs(x));
    return largest;
  }



  double
  TimeSeries::frequency_below(const double share) const
  {
    std::size_t n = 1;
    while (n < 2 * values.front().size())
      n *= 2;
    std::vector<double> energy(n / 2 + 1, 0.);
    for (const std::vector<double> &v : values)
      {
        std::vector<std::complex<double>> x(v.begin(), v.end());
        x.resize(n);
        transform(x);
        for (std::size_t k = 0; k < energy.size(); ++k)
          energy[k] += std::norm(x[k]);
      }
    double total = 0.;
    for (const double e : energy)
      total += e;
    double sum    = 0.;
    std::size_t k = 0;
    while (k + 1 < energy.size() && sum + energy[k] < share * total)
      sum += energy[k++];
    return k / (n * interval);
  }
} // namespace Keyblock

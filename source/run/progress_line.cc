// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/run/progress_line.h>

#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace Keyblock
{
  double
  time_left(const StageAdvance &before, const StageAdvance &now)
  {
    const double seconds = now.time - before.time;
    const double steps   = now.steps - before.steps;
    if (seconds <= 0. || steps <= 0.)
      return -1.;
    const double by_steps =
      now.largest_steps > 0. ? (now.largest_steps - now.steps) * seconds / steps
                             : -1.;
    if (now.planned > 0.)
      return std::max(0., now.planned - now.steps) * seconds / steps;
    if (now.ramp_left > 0. || before.ramp_left > 0. || now.target <= 0. ||
        now.ratio <= 0. || before.ratio <= now.ratio)
      return -1.;
    const double left = std::max(0., std::log(now.ratio / now.target)) *
                        seconds / std::log(before.ratio / now.ratio);
    return by_steps >= 0. ? std::min(left, by_steps) : left;
  }



  std::string
  duration_text(const double seconds)
  {
    if (seconds < 100.)
      return std::to_string(std::lround(seconds)) + " s";
    if (seconds < 6000.)
      return text_of(seconds / 60., 2) + " min";
    return text_of(seconds / 3600., 2) + " h";
  }



  unsigned int
  terminal_width(const int file_descriptor)
  {
    winsize size{};
    return ioctl(file_descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
  }



  double
  progress_interval(const unsigned int width)
  {
    return width > 0 ? 0.5 : 30.;
  }



  std::string
  fit_fields(std::vector<ProgressField> fields, const unsigned int width)
  {
    const auto join = [&]() {
      std::string line;
      for (const ProgressField &field : fields)
        line += field.text;
      return line;
    };
    while (width > 0 && fields.size() > 1 && join().size() > width)
      fields.erase(
        std::max_element(fields.begin(),
                         fields.end(),
                         [](const ProgressField &a, const ProgressField &b) {
                           return a.rank < b.rank;
                         }));
    return width > 0 ? join().substr(0, width) : join();
  }



  void
  print_fields(std::ostream &out,
               const std::vector<ProgressField> &fields,
               const unsigned int width)
  {
    if (width == 0)
      {
        out << fit_fields(fields, 0) << '\n' << std::flush;
        return;
      }
    // text in the last column would begin a new line
    std::string text = fit_fields(fields, width - 1);
    text.resize(width - 1, ' ');
    out << '\r' << text << std::flush;
  }



  void
  clear_progress(std::ostream &out)
  {
    if (const unsigned int width = terminal_width(); width > 0)
      out << '\r' << std::string(width - 1, ' ') << '\r' << std::flush;
  }
} // namespace Keyblock

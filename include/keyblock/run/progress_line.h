// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_progress_line_h
#define keyblock_run_progress_line_h

#include <iosfwd>
#include <string>
#include <vector>

namespace Keyblock
{
  /** How far a stage is, as a line of progress tells it. */
  struct StageAdvance
  {
    double time          = 0.; ///< wall time [s]
    double steps         = 0.; ///< of the stage
    double planned       = 0.; ///< the same; 0: it ends by its ratio
    double ratio         = 0.; ///< unbalanced [-]
    double target        = 0.; ///< of the ratio [-]
    double ramp_left     = 0.; ///< share of the ramp [-]
    double largest_steps = 0.; ///< after which it ends in any case
  };

  /**
   * Wall time [s] that the stage will take from @p now on, as it went since
   * @p before: by the number of steps, or by how fast the unbalanced ratio
   * falls. Below zero if that cannot be told: during the ramp, and while the
   * ratio does not fall.
   */
  double time_left(const StageAdvance &before, const StageAdvance &now);

  /** That many seconds for people: 45 s, 3.5 min, 2.1 h. */
  std::string duration_text(const double seconds);

  /**
   * Columns of the terminal that a file (standard output) is, or 0 if it is
   * none or has no size: Open MPI gives its ranks pseudo-terminals with the
   * size of its own terminal, and without one if its output goes to a file or a
   * pipe.
   */
  unsigned int terminal_width(const int file_descriptor = 1);

  /** Wall time from one line of progress to the next [s], on a terminal of that
   * width, where it is drawn over the last one, and elsewhere, where it is a
   * line of its own. */
  double progress_interval(const unsigned int width);

  /** A part of a line of progress. */
  struct ProgressField
  {
    std::string text;  ///< with what separates it from those before it
    unsigned int rank; ///< those of the highest are left out first
  };

  /** The fields one after the other, without those that do not fit into
   * @p width columns; 0: all of them. */
  std::string fit_fields(std::vector<ProgressField> fields,
                         const unsigned int width);

  /** Draw a line of progress over the last one, on a terminal, or write it as a
   * line of its own. */
  void print_fields(std::ostream &out,
                    const std::vector<ProgressField> &fields,
                    const unsigned int width);

  /** Let what follows begin where the line of progress did, if standard output
   * is a terminal. */
  void clear_progress(std::ostream &out);
} // namespace Keyblock

#endif

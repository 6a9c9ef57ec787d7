// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/run/factor_progress.h>

#include <mpi.h>

#include <algorithm>

namespace Keyblock
{
  std::vector<ProgressField>
  fields_of_search(const SearchAdvance &now,
                   const unsigned int index,
                   const unsigned int n_blocks,
                   const unsigned int id,
                   const double seconds)
  {
    std::vector<ProgressField> fields = {
      {"Factor  block " + std::to_string(index) + " of " +
         std::to_string(n_blocks),
       0},
      {" (id " + std::to_string(id) + ")", 4}};
    if (now.n_trials > 0)
      fields.push_back({", trial " + std::to_string(now.n_trials), 1});
    const std::string lower = text_of(now.lower, 4),
                      upper = text_of(now.upper, 4);
    if (now.lower > 0. && now.upper > 0.)
      fields.push_back({", bracket so far [" + lower + ", " + upper + "]", 3});
    else if (now.lower > 0.)
      fields.push_back({", holds at " + lower, 3});
    else if (now.upper > 0.)
      fields.push_back({", fails at " + upper, 3});
    if (seconds >= 0.)
      fields.push_back({"  left " + duration_text(seconds), 2});
    return fields;
  }



  double
  time_left_of_blocks(const unsigned int n_begun,
                      const unsigned int n_blocks,
                      const double before,
                      const double in_block)
  {
    if (n_begun < 2)
      return -1.;
    const double mean = before / (n_begun - 1);
    if (n_begun == n_blocks && in_block > mean)
      return -1.;
    return mean * (n_blocks - n_begun) + std::max(0., mean - in_block);
  }



  FactorProgress::FactorProgress(const dealii::ConditionalOStream &out,
                                 const unsigned int n_blocks)
    : out(out)
    , n_blocks(n_blocks)
    , start(MPI_Wtime())
    , block_start(start)
    , last_printed(start)
  {}



  FactorProgress::~FactorProgress()
  {
    clear();
  }



  void
  FactorProgress::begin_block(const unsigned int id)
  {
    this->id    = id;
    block_start = MPI_Wtime();
    ++n_begun;
    show(SearchAdvance());
  }



  void
  FactorProgress::show(const SearchAdvance &now)
  {
    if (!out.is_active())
      return;
    const double time        = MPI_Wtime();
    const unsigned int width = terminal_width();
    if (time - last_printed < progress_interval(width))
      return;
    print_fields(out.get_stream(),
                 fields_of_search(now,
                                  n_begun,
                                  n_blocks,
                                  id,
                                  time_left_of_blocks(n_begun,
                                                      n_blocks,
                                                      block_start - start,
                                                      time - block_start)),
                 width);
    last_printed = time;
    is_on_screen = true;
  }



  void
  FactorProgress::clear()
  {
    if (is_on_screen)
      clear_progress(out.get_stream());
    is_on_screen = false;
  }

} // namespace Keyblock

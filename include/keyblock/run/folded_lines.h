// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_folded_lines_h
#define keyblock_run_folded_lines_h

#include <functional>
#include <ostream>
#include <streambuf>
#include <string>

namespace Keyblock
{
  /** A line as lines of at most @p width columns, 0: any, that go on below
   * what stands beside its head. They part at blanks; words stay whole. */
  std::string fold(const std::string &line, const unsigned int width);

  /**
   * Lets a stream fold its lines while it lives. What is flushed before its
   * line ends, and what the cursor goes back over, as it does over progress,
   * stays as it is.
   */
  class FoldedLines : public std::streambuf
  {
  public:
    /** @param width of the terminal now; 0: it is none, nothing is folded */
    FoldedLines(std::ostream &out, const std::function<unsigned int()> &width);
    FoldedLines(const FoldedLines &) = delete;
    ~FoldedLines() override;

  protected:
    int_type overflow(int_type letter) override;
    int sync() override;

  private:
    bool write(const std::string &text);

    std::ostream &out;
    std::streambuf *const target; ///< of the stream before
    const std::function<unsigned int()> width;
    std::string line;    ///< so far
    bool is_cut = false; ///< a part of the line has been flushed
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/folded_lines.h>

#include <algorithm>

namespace Keyblock
{
  std::string
  fold(const std::string &line, const unsigned int width)
  {
    constexpr unsigned int indent = 8, least_width = 40;
    if (width < least_width || line.size() <= width)
      return line;
    std::string folded;
    std::size_t begin = 0, room = width;
    while (line.size() - begin > room)
      {
        std::size_t end = line.rfind(' ', begin + room);
        // not in what the line begins with, nor in a word
        if (end == std::string::npos || end <= begin ||
            line.find_first_not_of(' ', begin) >= end)
          end = line.find(' ', begin + room);
        if (end == std::string::npos)
          break;
        folded +=
          line.substr(begin, line.find_last_not_of(' ', end) + 1 - begin);
        const std::size_t next = line.find_first_not_of(' ', end);
        if (next == std::string::npos)
          return folded;
        folded += '\n' + std::string(indent, ' ');
        begin = next;
        room  = width - indent;
      }
    return folded + line.substr(begin);
  }



  FoldedLines::FoldedLines(std::ostream &out,
                           const std::function<unsigned int()> &width)
    : out(out)
    , target(out.rdbuf())
    , width(width)
  {
    out.rdbuf(this);
  }



  FoldedLines::~FoldedLines()
  {
    sync();
    out.rdbuf(target);
  }



  bool
  FoldedLines::write(const std::string &text)
  {
    const std::streamsize n = text.size();
    return target->sputn(text.data(), n) == n;
  }



  FoldedLines::int_type
  FoldedLines::overflow(int_type letter)
  {
    if (traits_type::eq_int_type(letter, traits_type::eof()))
      return traits_type::not_eof(letter);
    const char c = traits_type::to_char_type(letter);
    if (c != '\n' && c != '\r')
      {
        line += c;
        return letter;
      }
    if (c == '\n' && !is_cut)
      line = fold(line, width());
    line += c;
    is_cut             = false;
    const bool is_done = write(line);
    line.clear();
    return is_done ? letter : traits_type::eof();
  }



  int
  FoldedLines::sync()
  {
    is_cut             = is_cut || !line.empty();
    const bool is_done = write(line);
    line.clear();
    return is_done ? target->pubsync() : -1;
  }
} // namespace Keyblock

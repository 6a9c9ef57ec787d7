// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_delimited_text_h
#define keyblock_base_delimited_text_h

#include <string>
#include <vector>

namespace Keyblock
{
  /** A table as spreadsheets write it: a header and rows of as many fields. */
  struct DelimitedText
  {
    struct Row
    {
      unsigned int line; ///< where it begins in the file, from 1
      std::vector<std::string> fields;
    };

    std::string file_name;
    char separator = ',';
    Row header;
    std::vector<Row> rows;

    /** Whether numbers may have a decimal comma. */
    bool
    has_decimal_comma() const
    {
      return separator != ',';
    }
  };

  /**
   * Read a table from @p file_name. A first line 'sep=;' tells what separates
   * fields, else the header: a tab, else ';', else ','. Line breaks in quoted
   * titles are blanks. Fields may be quoted ("a ""quoted"" field"); a
   * byte order mark, CR LF, empty lines and lines that begin with '#' do not
   * count, nor do empty fields at the end of a row. Throws InputError, with
   * the line, for files that cannot be read, quotes without an end, and rows
   * that have not as many fields as the header; @p entry is the entry of the
   * scene that names the file.
   */
  DelimitedText read_delimited_text(const std::string &file_name,
                                    const std::string &entry);

  /** How many there are of something, for people: 1 row, 2 rows. */
  std::string count_text(const std::size_t n, const std::string &noun);

  /** A line of a table as RFC 4180 has it: commas between @p fields, quotes
   * where they are needed, CR LF at the end. */
  std::string csv_line(const std::vector<std::string> &fields);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/delimited_text.h>
#include <keyblock/base/errors.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** The file's text with '\n' at the end of each line, without byte order
     * mark. */
    std::string
    read_lines(const std::string &file_name, const std::string &entry)
    {
      std::ifstream in(file_name, std::ios::binary);
      AssertThrow(in && !std::filesystem::is_directory(file_name),
                  InputError("The file '" + file_name + "' of the entry '" +
                             entry + "' cannot be read; check its path."));
      std::ostringstream content;
      content << in.rdbuf();
      const std::string raw = content.str();
      AssertThrow(raw.compare(0, 2, "\xFF\xFE") != 0 &&
                    raw.compare(0, 2, "\xFE\xFF") != 0,
                  InputError("The file '" + file_name + "' of the entry '" +
                             entry +
                             "' is written in UTF-16; save it as CSV in "
                             "UTF-8."));
      std::string text;
      text.reserve(raw.size());
      std::size_t i = raw.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
      for (; i < raw.size(); ++i)
        if (raw[i] != '\r')
          text += raw[i];
        else if (i + 1 == raw.size() || raw[i + 1] != '\n')
          text += '\n';
      return text;
    }

    /** Splits text into rows of fields. */
    class RowSplitter
    {
    public:
      RowSplitter(const std::string &text, const std::string &file_name)
        : text(text)
        , file_name(file_name)
      {}

      /** Read the next row that is neither empty nor a comment into @p row;
       * false at the end of the text. */
      bool
      next(DelimitedText::Row &row)
      {
        if (place == 0)
          take_separator_line();
        while (place < text.size())
          {
            if (is_comment())
              skip_line();
            else
              {
                if (separator == '\0')
                  separator = find_separator();
                row = split_row();
                if (!std::all_of(row.fields.begin(),
                                 row.fields.end(),
                                 [](const auto &f) { return f.empty(); }))
                  return true;
                separator = has_header ? separator : '\0';
              }
          }
        return false;
      }

      void
      keep_separator()
      {
        has_header = true;
      }

      char separator = '\0';

    private:
      bool
      is_blank(const std::size_t i) const
      {
        return text[i] == ' ' || (text[i] == '\t' && separator != '\t');
      }

      bool
      is_comment() const
      {
        const auto first = text.find_first_not_of(" \t", place);
        return first != std::string::npos && text[first] == '#';
      }

      void
      skip_line()
      {
        place = std::min(text.find('\n', place), text.size() - 1) + 1;
        ++line;
      }

      /** Skip a first line 'sep=;', by which spreadsheets are told what
       * separates fields. */
      void
      take_separator_line()
      {
        std::string first = text.substr(0, text.find('\n'));
        first.erase(std::remove(first.begin(), first.end(), '"'), first.end());
        if (first.size() < 5 ||
            (first.compare(0, 4, "sep=") != 0 &&
             first.compare(0, 4, "SEP=") != 0) ||
            first.find_first_not_of(" ;,\t", 5) != std::string::npos ||
            std::string(";,\t").find(first[4]) == std::string::npos)
          return;
        given = first[4];
        skip_line();
      }

      /** What separates the fields of the present line. */
      char
      find_separator() const
      {
        if (given != '\0')
          return given;
        bool is_quoted = false, has_semicolon = false;
        for (std::size_t i = place;
             i < text.size() && (text[i] != '\n' || is_quoted);
             ++i)
          {
            if (text[i] == '"')
              is_quoted = !is_quoted;
            if (text[i] == '\t' && !is_quoted)
              return '\t';
            has_semicolon |= text[i] == ';' && !is_quoted;
          }
        return has_semicolon ? ';' : ',';
      }

      DelimitedText::Row
      split_row()
      {
        DelimitedText::Row row{line, {}};
        for (bool is_last = false; !is_last;)
          {
            while (place < text.size() && is_blank(place))
              ++place;
            const bool is_quoted = place < text.size() && text[place] == '"';
            row.fields.push_back(is_quoted ? quoted_field() : plain_field());
            is_last = place >= text.size() || text[place] == '\n';
            ++place;
          }
        ++line;
        return row;
      }

      std::string
      plain_field()
      {
        const auto begin = place;
        while (place < text.size() && text[place] != '\n' &&
               text[place] != separator)
          ++place;
        auto end = place;
        while (end > begin && (text[end - 1] == ' ' || text[end - 1] == '\t'))
          --end;
        return text.substr(begin, end - begin);
      }

      std::string
      quoted_field()
      {
        const unsigned int first_line = line;
        std::string field;
        for (++place; place < text.size(); ++place)
          {
            if (text[place] == '"' && text[place + 1] != '"')
              break;
            if (text[place] == '"')
              ++place;
            line += text[place] == '\n';
            field += text[place];
          }
        AssertThrow(place < text.size(),
                    InputError("Line " + std::to_string(first_line) +
                               " of the table '" + file_name +
                               "' has a quote without an end; close the "
                               "field by '\"'."));
        ++place;
        const std::string rest = plain_field();
        AssertThrow(rest.empty(),
                    InputError("Line " + std::to_string(first_line) +
                               " of the table '" + file_name + "' has '" +
                               rest +
                               "' after the end of a quoted field; write "
                               "quotes in a field twice."));
        return field;
      }

      const std::string &text;
      const std::string &file_name;
      std::size_t place = 0;
      unsigned int line = 1;
      bool has_header   = false;
      char given        = '\0'; ///< by a line 'sep='
    };

    /** Drop empty fields at the end down to @p n of them. */
    void
    drop_empty_end(std::vector<std::string> &fields, const std::size_t n)
    {
      while (fields.size() > n && fields.back().empty())
        fields.pop_back();
    }
  } // namespace



  DelimitedText
  read_delimited_text(const std::string &file_name, const std::string &entry)
  {
    const std::string text = read_lines(file_name, entry);
    RowSplitter splitter(text, file_name);
    DelimitedText table;
    table.file_name = file_name;
    AssertThrow(splitter.next(table.header),
                InputError("The table '" + file_name + "' of the entry '" +
                           entry +
                           "' is empty; begin with a line that names the "
                           "columns."));
    splitter.keep_separator();
    drop_empty_end(table.header.fields, 0);
    for (std::string &title : table.header.fields)
      std::replace(title.begin(), title.end(), '\n', ' ');
    const std::size_t n_columns = table.header.fields.size();
    for (DelimitedText::Row row; splitter.next(row);)
      {
        drop_empty_end(row.fields, n_columns);
        AssertThrow(row.fields.size() == n_columns,
                    InputError("Line " + std::to_string(row.line) +
                               " of the table '" + file_name + "' has " +
                               count_text(row.fields.size(), "value") +
                               " where the header names " +
                               count_text(n_columns, "column") +
                               "; give one value for each, or leave "
                               "it empty between two separators."));
        table.rows.push_back(std::move(row));
      }
    table.separator = splitter.separator;
    return table;
  }



  std::string
  count_text(const std::size_t n, const std::string &noun)
  {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
  }



  std::string
  csv_line(const std::vector<std::string> &fields)
  {
    std::string line;
    for (const std::string &field : fields)
      {
        if (&field != &fields.front())
          line += ',';
        if (field.find_first_of(",\"\r\n") == std::string::npos)
          {
            line += field;
            continue;
          }
        line += '"';
        for (const char letter : field)
          line += letter == '"' ? std::string("\"\"") : std::string(1, letter);
        line += '"';
      }
    return line + "\r\n";
  }
} // namespace Keyblock

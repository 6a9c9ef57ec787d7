// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checkpoint_state_rows_h
#define keyblock_checkpoint_state_rows_h

#include <keyblock/checkpoint/state_file.h>

namespace Keyblock
{
  // Lists of structs as rows of numbers. A struct T takes part by a function
  // for_each_number(T &, action) beside it, which calls the action with each of
  // its numbers by reference, in the order of the columns.

  /** Numbers of one item. */
  template <typename T>
  std::vector<double>
  numbers_of(T item)
  {
    std::vector<double> numbers;
    for_each_number(item, [&](const auto &value) {
      numbers.push_back(static_cast<double>(value));
    });
    return numbers;
  }

  template <typename T>
  T
  from_numbers(const double *numbers)
  {
    T item{};
    for_each_number(item, [&](auto &value) {
      value = static_cast<std::decay_t<decltype(value)>>(*numbers++);
    });
    return item;
  }

  /** Save or read a list of items, a row of numbers each. */
  template <typename T>
  void
  exchange_rows(StateFile &file,
                const std::string &entry,
                std::vector<T> &items)
  {
    std::vector<double> rows;
    for (const T &item : items)
      for (const double number : numbers_of(item))
        rows.push_back(number);
    file.exchange(entry, rows);
    if (!file.is_read())
      return;
    items.clear();
    const std::size_t n = numbers_of(T()).size();
    for (std::size_t i = 0; i + n <= rows.size(); i += n)
      items.push_back(from_numbers<T>(rows.data() + i));
  }

  /** One member, a text, of each item of a list. */
  template <typename T>
  void
  exchange_texts(StateFile &file,
                 const std::string &entry,
                 std::vector<T> &items,
                 std::string T::*const member)
  {
    std::vector<std::string> texts;
    texts.reserve(items.size());
    for (const T &item : items)
      texts.push_back(item.*member);
    file.exchange(entry, texts);
    for (std::size_t i = 0; i < items.size(); ++i)
      items[i].*member = texts.at(i);
  }
} // namespace Keyblock

#endif

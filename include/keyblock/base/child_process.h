// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_child_process_h
#define keyblock_base_child_process_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace Keyblock
{
  /** One end of a pipe, which carries plain data. */
  class PipeEnd
  {
  public:
    explicit PipeEnd(const int descriptor)
      : descriptor(descriptor)
    {}

    ~PipeEnd();
    PipeEnd(const PipeEnd &)            = delete;
    PipeEnd &operator=(const PipeEnd &) = delete;

    void write_bytes(const void *data, const std::size_t n) const;

    void read_bytes(void *data, const std::size_t n) const;

    void write_number(const std::uint64_t number) const;

    std::uint64_t read_number() const;

    void write_text(const std::string &text) const;

    std::string read_text() const;

    /** A list of plain data. */
    template <typename T>
    void
    write_list(const std::vector<T> &list) const
    {
      static_assert(std::is_trivially_copyable<T>::value ||
                      std::is_standard_layout<T>::value,
                    "Only plain data can be written.");
      write_number(list.size());
      write_bytes(list.data(), list.size() * sizeof(T));
    }

    template <typename T>
    std::vector<T>
    read_list() const
    {
      std::vector<T> list(read_number());
      read_bytes(list.data(), list.size() * sizeof(T));
      return list;
    }

  private:
    const int descriptor;
  };

  /**
   * Let a child process @p work and @p send what it has found, and @p receive
   * it in this one: a damaged file, or faces that almost coincide, can make
   * Gmsh stop or write where it must not. Throws std::runtime_error with why @p
   * work failed, or with how the child ended. The child takes no part in MPI.
   */
  void in_child_process(const std::function<void()> &work,
                        const std::function<void(const PipeEnd &)> &send,
                        const std::function<void(const PipeEnd &)> &receive);
} // namespace Keyblock

#endif

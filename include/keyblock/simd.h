// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_simd_h
#define keyblock_simd_h

/** For functions that are compiled for several instruction sets: no copy of
 * them may stay that the linker could choose for a processor without it. */
#define KEYBLOCK_ALWAYS_INLINE inline __attribute__((always_inline))

namespace Keyblock
{
  // Several doubles in one register (vector types of GCC and Clang).
  typedef double Lanes2 __attribute__((vector_size(16)));
  typedef double Lanes4 __attribute__((vector_size(32)));
  typedef double Lanes8 __attribute__((vector_size(64)));

  /** Cells whose values stand side by side in memory, whatever the width of
   * the registers. */
  constexpr unsigned int batch_size = 8;

  template <typename Number>
  constexpr unsigned int n_lanes = sizeof(Number) / sizeof(double);

  template <typename Number>
  KEYBLOCK_ALWAYS_INLINE Number
  load(const double *from)
  {
    Number value;
    __builtin_memcpy(&value, from, sizeof(Number));
    return value;
  }

  template <typename Number>
  KEYBLOCK_ALWAYS_INLINE void
  store(const Number value, double *to)
  {
    __builtin_memcpy(to, &value, sizeof(Number));
  }
} // namespace Keyblock

#endif

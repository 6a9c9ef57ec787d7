// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_simd_h
#define keyblock_base_simd_h

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

  /** Mask of the lanes that are not negative (nor NaN). */
  template <typename Number>
  KEYBLOCK_ALWAYS_INLINE auto
  is_positive(const Number value)
  {
    return value >= 0.;
  }

  /** Whether a mask of @p width lanes is true in one of them. */
  template <unsigned int width, typename Mask>
  KEYBLOCK_ALWAYS_INLINE bool
  is_true(const Mask mask, const unsigned int lane)
  {
    if constexpr (width == 1)
      return mask;
    else
      return mask[lane] != 0;
  }

  /** Whether a mask is true in all lanes. */
  template <unsigned int width, typename Mask>
  KEYBLOCK_ALWAYS_INLINE bool
  is_true(const Mask mask)
  {
    bool all = true;
    for (unsigned int l = 0; l < width; ++l)
      all = all & is_true<width>(mask, l);
    return all;
  }
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_random_numbers_h
#define keyblock_base_random_numbers_h

#include <boost/multiprecision/cpp_bin_float.hpp>
#if __has_include(<quadmath.h>)
#  include <boost/multiprecision/float128.hpp>
#endif

#include <cmath>
#include <cstdint>
#include <random>

namespace Keyblock
{
  /** Floating point of 113 bits in software, by the compiler's library or
   * several times slower by Boost's: rounded to double, the same on every
   * machine, where the logarithms and sines of C libraries differ in their last
   * bits. */
#if __has_include(<quadmath.h>)
  using Real = boost::multiprecision::float128;
#else
  using Real = boost::multiprecision::cpp_bin_float_quad;
#endif

  /** The nearest double of @p value. */
  inline double
  rounded(const Real &value)
  {
    return value.convert_to<double>();
  }

  /**
   * Random numbers that are the same to the last bit for the same seed on any
   * machine and with any compiler: raw bits of the 64-bit Mersenne twister,
   * whose sequence the C++ standard fixes, and transforms of our own, because
   * it does not fix its distributions.
   */
  class RandomNumbers
  {
  public:
    explicit RandomNumbers(const std::uint64_t seed)
      : bits(seed)
    {}

    /** Uniform in [0, 1): the upper 53 bits over 2^53. */
    double
    uniform()
    {
      return static_cast<double>(bits() >> 11) * 0x1p-53;
    }

    /** Uniform in (0, 1], without rounding. */
    double
    positive_uniform()
    {
      return 1. - uniform();
    }

    /** Exponential with mean 1, by inversion: -log(1 - u). */
    double
    exponential()
    {
      return rounded(-log(Real(positive_uniform())));
    }

    /** Two uniform numbers, of which Box and Muller make a normal one. */
    struct Pair
    {
      double u; ///< in (0, 1]
      double v; ///< in [0, 1)

      /** Standard normal: sqrt(-2 log u) cos(2 pi v), by doubles with an error
       * of some 1e-14, or by Real. */
      template <typename Number>
      Number
      normal() const
      {
        using std::cos, std::log, std::sqrt;
        return sqrt(-2 * log(Number(u))) *
               cos(2 * boost::math::constants::pi<Number>() * Number(v));
      }
    };

    Pair
    pair()
    {
      const double u = positive_uniform();
      return {u, uniform()};
    }

    /** Poisson: how many exponential steps fit into @p mean. */
    unsigned int
    poisson(const double mean)
    {
      unsigned int count = 0;
      for (double sum = exponential(); sum <= mean; sum += exponential())
        ++count;
      return count;
    }

    static Real
    two_pi()
    {
      return 2 * boost::math::constants::pi<Real>();
    }

  private:
    std::mt19937_64 bits;
  };
} // namespace Keyblock

#endif

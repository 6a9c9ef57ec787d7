// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>

#include <keyblock/base/exact_sign.h>

#include <cstdlib>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    __extension__ using Integer = __int128;
    __extension__ using Natural = unsigned __int128;

    constexpr double coefficient_unit = 0x1p-52; ///< of coefficients

    /** Determinant of normals above which doubles give the place of a vertex:
     * its error is then below this one over the determinant. */
    constexpr double well_conditioned = 0.05, error_of_doubles = 6e-15;

    /** Error of the quotient of two sums of integers below 1. */
    constexpr double error_of_quotient = 2e-15;

    /** A sum of products of integers, in 256 bits with the two's complement.
     * Determinants of coefficients stay below 2^214. */
    class WideSum
    {
    public:
      void
      add(const Integer a, const Integer b)
      {
        const Natural x  = a < 0 ? -Natural(a) : Natural(a),
                      y  = b < 0 ? -Natural(b) : Natural(b);
        const Natural x0 = std::uint64_t(x), x1 = x >> 64,
                      y0 = std::uint64_t(y), y1 = y >> 64;
        const Natural low = x0 * y0;
        const Natural middle =
          (low >> 64) + std::uint64_t(x0 * y1) + std::uint64_t(x1 * y0);
        const Natural high =
          x1 * y1 + ((x0 * y1) >> 64) + ((x1 * y0) >> 64) + (middle >> 64);
        const bool is_negative = (a < 0) != (b < 0);
        add({{std::uint64_t(low),
              std::uint64_t(middle),
              std::uint64_t(high),
              std::uint64_t(high >> 64)}},
            is_negative);
      }

      int
      sign() const
      {
        if (words[3] >> 63)
          return -1;
        return (words[0] | words[1] | words[2] | words[3]) != 0 ? 1 : 0;
      }

      /** The nearest double but for some roundings. */
      double
      value() const
      {
        WideSum size;
        size.add(words, sign() < 0);
        double sum = 0.;
        for (unsigned int i = 4; i-- > 0;)
          sum = 0x1p64 * sum + double(size.words[i]);
        return sign() * sum;
      }

    private:
      using Words = std::array<std::uint64_t, 4>; // lowest first

      void
      add(const Words &others, const bool is_negative)
      {
        Natural carry = is_negative;
        for (unsigned int i = 0; i < 4; ++i)
          {
            carry += Natural(words[i]) + (is_negative ? ~others[i] : others[i]);
            words[i] = std::uint64_t(carry);
            carry >>= 64;
          }
      }

      Words words{{0, 0, 0, 0}};
    };

    /** Determinant of two columns of two planes. */
    template <int dim>
    Integer
    minor_of(const ExactPlane<dim> &p,
             const ExactPlane<dim> &q,
             const unsigned int i,
             const unsigned int j)
    {
      return Integer(p.multiples[i]) * q.multiples[j] -
             Integer(p.multiples[j]) * q.multiples[i];
    }

    /** Determinant of three columns of three planes. */
    template <int dim>
    WideSum
    determinant(const ExactPlane<dim> &p,
                const ExactPlane<dim> &q,
                const ExactPlane<dim> &r,
                const std::array<unsigned int, 3> &columns)
    {
      const auto [i, j, k] = columns;
      WideSum sum;
      sum.add(minor_of(p, q, j, k), r.multiples[i]);
      sum.add(minor_of(p, q, k, i), r.multiples[j]);
      sum.add(minor_of(p, q, i, j), r.multiples[k]);
      return sum;
    }

    /** Determinant of all columns of four planes. */
    WideSum
    determinant_of_four(const ExactPlane<3> &p,
                        const ExactPlane<3> &q,
                        const ExactPlane<3> &r,
                        const ExactPlane<3> &s)
    {
      WideSum sum;
      sum.add(minor_of(p, q, 0, 1), minor_of(r, s, 2, 3));
      sum.add(minor_of(p, q, 2, 0), minor_of(r, s, 1, 3));
      sum.add(minor_of(p, q, 0, 3), minor_of(r, s, 1, 2));
      sum.add(minor_of(p, q, 1, 2), minor_of(r, s, 0, 3));
      sum.add(minor_of(p, q, 3, 1), minor_of(r, s, 0, 2));
      sum.add(minor_of(p, q, 2, 3), minor_of(r, s, 0, 1));
      return sum;
    }

    /** Determinant of the normals, of which column @p replaced is that of the
     * offsets; none is if it is dim. */
    template <int dim>
    WideSum
    cramer(const std::vector<ExactPlane<dim>> &planes,
           const std::array<unsigned int, dim> &indices,
           const unsigned int replaced)
    {
      const auto column = [&](const unsigned int d) {
        return d == replaced ? (unsigned int)(dim) : d;
      };
      const ExactPlane<dim> &p = planes[indices[0]], &q = planes[indices[1]];
      if constexpr (dim == 2)
        {
          WideSum sum;
          sum.add(minor_of(p, q, column(0), column(1)), 1);
          return sum;
        }
      else
        return determinant(p,
                           q,
                           planes[indices[2]],
                           {{column(0), column(1), column(2)}});
    }
  } // namespace



  template <int dim>
  bool
  ExactPlane<dim>::meets_box() const
  {
    std::int64_t reach = 0;
    for (unsigned int d = 0; d < dim; ++d)
      reach += std::abs(multiples[d]);
    return std::abs(multiples[dim]) <= reach;
  }



  template <int dim>
  std::array<std::int64_t, dim + 1>
  ExactPlane<dim>::key() const
  {
    std::array<std::int64_t, dim + 1> result = multiples;
    std::int64_t divisor                     = 0;
    for (const std::int64_t m : multiples)
      divisor = std::gcd(divisor, m);
    for (const std::int64_t m : multiples)
      if (m != 0)
        {
          divisor = m < 0 ? -divisor : divisor;
          break;
        }
    for (std::int64_t &m : result)
      m /= divisor;
    return result;
  }



  template <int dim>
  ExactPlane<dim>
  make_exact_plane(const Point<dim> &point, const Tensor<1, dim> &normal)
  {
    const Tensor<1, dim> n = normal / normal.norm();
    const double d         = -(n * point);
    Assert(std::abs(d) < 2., dealii::ExcMessage("plane far from the box"));
    ExactPlane<dim> plane;
    for (unsigned int i = 0; i <= dim; ++i)
      plane.multiples[i] =
        std::llround((i < dim ? n[i] : d) / coefficient_unit);
    for (unsigned int i = 0; i < dim; ++i)
      plane.normal[i] = coefficient_unit * double(plane.multiples[i]);
    plane.offset = coefficient_unit * double(plane.multiples[dim]);
    return plane;
  }



  template <int dim>
  ExactVertex<dim>
  intersect(const std::vector<ExactPlane<dim>> &planes,
            const std::array<unsigned int, dim> &indices)
  {
    ExactVertex<dim> vertex;
    vertex.planes            = indices;
    const ExactPlane<dim> &p = planes[indices[0]], &q = planes[indices[1]];
    double size = 0.; // determinant of the normals
    Tensor<1, dim> sum;
    if constexpr (dim == 2)
      {
        size = p.normal[0] * q.normal[1] - p.normal[1] * q.normal[0];
        sum =
          dealii::cross_product_2d(p.offset * q.normal - q.offset * p.normal);
      }
    else
      {
        const ExactPlane<dim> &r = planes[indices[2]];
        const auto pq            = cross_product_3d(p.normal, q.normal);
        size                     = pq * r.normal;
        sum = p.offset * cross_product_3d(q.normal, r.normal) +
              q.offset * cross_product_3d(r.normal, p.normal) + r.offset * pq;
      }
    if (std::abs(size) > well_conditioned)
      {
        vertex.x           = Point<dim>(-sum / size);
        vertex.error       = error_of_doubles / std::abs(size);
        vertex.orientation = size > 0. ? 1 : -1;
        return vertex;
      }
    const WideSum exact = cramer<dim>(planes, indices, dim);
    vertex.orientation  = exact.sign();
    Assert(vertex.orientation != 0, dealii::ExcMessage("planes do not meet"));
    for (unsigned int d = 0; d < dim; ++d)
      vertex.x[d] = -cramer<dim>(planes, indices, d).value() / exact.value();
    vertex.error = error_of_quotient;
    return vertex;
  }



  template <int dim>
  int
  side_by_integers(const std::vector<ExactPlane<dim>> &planes,
                   const ExactVertex<dim> &vertex,
                   const unsigned int plane)
  {
    const ExactPlane<dim> &p = planes[vertex.planes[0]],
                          &q = planes[vertex.planes[1]], &s = planes[plane];
    if constexpr (dim == 2)
      return vertex.orientation * determinant(p, q, s, {{0, 1, 2}}).sign();
    else
      return vertex.orientation *
             determinant_of_four(p, q, planes[vertex.planes[2]], s).sign();
  }



#define INSTANTIATE(dim)                                                       \
  template struct ExactPlane<dim>;                                             \
  template ExactPlane<dim> make_exact_plane(const Point<dim> &,                \
                                            const Tensor<1, dim> &);           \
  template ExactVertex<dim> intersect<dim>(                                    \
    const std::vector<ExactPlane<dim>> &,                                      \
    const std::array<unsigned int, dim> &);                                    \
  template int side_by_integers(const std::vector<ExactPlane<dim>> &,          \
                                const ExactVertex<dim> &,                      \
                                const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

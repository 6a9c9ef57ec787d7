// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/radius_law.h>

namespace Keyblock
{
  namespace
  {
    using D = RadiusDistribution;

    /** Integral of r^p from @p a to @p b. */
    double
    integral_of_power(const double p, const double a, const double b)
    {
      return p == -1. ? std::log(b / a)
                      : (std::pow(b, p + 1.) - std::pow(a, p + 1.)) / (p + 1.);
    }

    /** Integral of x^k exp(-x) from @p x to infinity, k = 0, 1, 2. */
    double
    upper_gamma(const int k, const double x)
    {
      const double polynomial = k == 0   ? 1.
                                : k == 1 ? 1. + x
                                         : 2. + x * (2. + x);
      return polynomial * std::exp(-x);
    }

    double
    normal_distribution(const double z)
    {
      return 0.5 * std::erfc(-z / std::sqrt(2.));
    }
  } // namespace



  template <int dim>
  RadiusLaw::RadiusLaw(const JointSet<dim> &set)
    : law(set.radius_law)
    , mean(set.radius_mean)
    , deviation(set.radius_deviation)
    , exponent(set.radius_exponent)
    , lower(law == D::constant ? mean : set.radius_minimum)
    , upper(law == D::constant                             ? mean
            : set.radius_maximum > 0.                      ? set.radius_maximum
            : law == D::exponential || law == D::lognormal ? 10. * mean
                                                           : 0.)
  {
    const auto require = [&](const bool condition,
                             const std::string &entry,
                             const double value,
                             const std::string &sentence) {
      AssertThrow(condition,
                  InputError("The entry 'Joint sets/" + set.name + "/" + entry +
                             "' is " + exact_text(value) + sentence));
    };
    if (law != D::uniform && law != D::power_law)
      require(mean > 0.,
              "Radius mean",
              mean,
              ", but the radius law " + name_of(law) +
                " needs a positive one [m].");
    if (law == D::power_law)
      require(lower > 0.,
              "Radius minimum",
              lower,
              ", but a power law needs a positive one [m].");
    if (law != D::constant)
      require(upper > lower,
              "Radius maximum",
              upper,
              ", which is not above 'Radius minimum' = " + exact_text(lower) +
                "; give a larger one [m].");
    if (law != D::lognormal)
      return;
    require(deviation > 0.,
            "Radius deviation",
            deviation,
            ", but a lognormal law needs a positive one [m].");
    const double ratio  = deviation / mean;
    log_deviation       = std::sqrt(std::log1p(ratio * ratio));
    log_mean            = std::log(mean) - 0.5 * log_deviation * log_deviation;
    const Real of_mean  = Real(deviation) / mean;
    const Real variance = log(1 + of_mean * of_mean);
    sigma               = sqrt(variance);
    mu                  = log(Real(mean)) - variance / 2;
    require(share_within_bounds(0) > 0.01,
            "Radius maximum",
            upper,
            ", and with 'Radius minimum' = " + exact_text(lower) +
              " it leaves less than one in a hundred radii of the law; widen "
              "the bounds.");
  }



  double
  RadiusLaw::share_within_bounds(const int k) const
  {
    const auto below = [&](const double r) {
      return normal_distribution((std::log(r) - log_mean) / log_deviation -
                                 k * log_deviation);
    };
    return below(upper) - (lower > 0. ? below(lower) : 0.);
  }



  double
  RadiusLaw::moment(const int k) const
  {
    if (law == D::constant)
      return std::pow(mean, k);
    if (law == D::uniform)
      return integral_of_power(k, lower, upper) / (upper - lower);
    if (law == D::power_law)
      return integral_of_power(k - exponent, lower, upper) /
             integral_of_power(-exponent, lower, upper);
    if (law == D::exponential)
      {
        const auto integral = [&](const int n) {
          return upper_gamma(n, lower / mean) - upper_gamma(n, upper / mean);
        };
        return std::pow(mean, k) * integral(k) / integral(0);
      }
    return std::exp(k * log_mean +
                    0.5 * k * k * log_deviation * log_deviation) *
           share_within_bounds(k) / share_within_bounds(0);
  }



  template <typename Number>
  Number
  RadiusLaw::radius_of(const RandomNumbers::Pair &numbers) const
  {
    using std::exp, std::log, std::pow;
    const Number a = lower, b = upper, m = mean, u = numbers.u;
    if (law == D::constant)
      return m;
    if (law == D::lognormal)
      return exp(static_cast<Number>(mu) +
                 static_cast<Number>(sigma) * numbers.normal<Number>());
    if (law == D::uniform)
      return a + u * (b - a);
    if (law == D::exponential)
      return a - m * log(1 - u * (1 - exp((a - b) / m)));
    const Number p = 1 - Number(exponent);
    if (p == 0)
      return a * pow(b / a, u);
    const Number from = pow(a, p), to = pow(b, p);
    return pow(from + u * (to - from), 1 / p);
  }



  RadiusLaw::Draw
  RadiusLaw::draw(RandomNumbers &random) const
  {
    constexpr double safe = 1e-9; // error of an estimate, at most [-]
    Draw drawn{{0., 0.}, mean};
    if (law == D::constant)
      return drawn;
    if (law != D::lognormal)
      {
        drawn.numbers.u = random.uniform();
        drawn.estimate  = radius_of<double>(drawn.numbers);
        return drawn;
      }
    while (true)
      {
        drawn.numbers  = random.pair();
        const double r = radius_of<double>(drawn.numbers);
        drawn.estimate = r;
        const bool is_near =
          std::abs(r - lower) <= safe * r || std::abs(r - upper) <= safe * r;
        if (is_near)
          {
            const Real exact = radius_of<Real>(drawn.numbers);
            if (exact >= lower && exact <= upper)
              return drawn;
          }
        else if (r >= lower && r <= upper)
          return drawn;
      }
  }

  template double RadiusLaw::radius_of(const RandomNumbers::Pair &) const;
  template Real RadiusLaw::radius_of(const RandomNumbers::Pair &) const;
  template RadiusLaw::RadiusLaw(const JointSet<2> &);
  template RadiusLaw::RadiusLaw(const JointSet<3> &);
} // namespace Keyblock

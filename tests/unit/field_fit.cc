// SPDX-License-Identifier: LGPL-2.1-or-later
// Least squares of measured stresses by unit fields.
#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/geostress/geostress.h>

#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(field_fit)

using namespace Keyblock;

namespace
{
  const std::vector<std::string> names   = {"gravity",
                                            "push x",
                                            "push y",
                                            "shear xy",
                                            "graded x"};
  const std::vector<double> coefficients = {1., 3.2, 1.1, 0.6, 0.8};

  /** Six components at six depths of a flat block, in MPa: gravity, two pushes,
   * shear, and a push that grows by 1 MPa per 100 m. */
  std::vector<std::vector<double>>
  flat_block()
  {
    const double nu = 0.25, k0 = nu / (1. - nu), weight = 0.027;
    std::vector<std::vector<double>> rows;
    for (const double d : {80., 150., 200., 240., 310., 420.})
      {
        rows.push_back({-k0 * weight * d, -1., -nu, 0., -d / 100.});
        rows.push_back({-k0 * weight * d, -nu, -1., 0., -nu * d / 100.});
        rows.push_back({-weight * d, 0., 0., 0., 0.});
        rows.push_back({0., 0., 0., 0., 0.});
        rows.push_back({0., 0., 0., 0., 0.});
        rows.push_back({0., 0., 0., 1., 0.});
      }
    return rows;
  }

  std::vector<double>
  stresses_of(const std::vector<std::vector<double>> &rows)
  {
    std::vector<double> values;
    for (const auto &row : rows)
      {
        values.push_back(0.);
        for (unsigned int j = 0; j < coefficients.size(); ++j)
          values.back() += row[j] * coefficients[j];
      }
    return values;
  }
} // namespace

BOOST_AUTO_TEST_CASE(fields_without_noise_are_found_again)
{
  const auto rows   = flat_block();
  const auto values = stresses_of(rows);
  const FieldFit fit =
    fit_fields(rows, values, std::vector<double>(values.size(), 1.), names);
  for (unsigned int j = 0; j < names.size(); ++j)
    BOOST_TEST(std::abs(fit.coefficients[j] - coefficients[j]) < 1e-10);
  BOOST_TEST(std::abs(fit.r_squared - 1.) < 1e-12);
  // the stress at 200 m
  const double expected[] = {-6.875, -4.1, -5.4, 0., 0., 0.6};
  for (unsigned int k = 0; k < 6; ++k)
    BOOST_TEST(std::abs(fit.fitted[12 + k] - expected[k]) < 1e-9);
}

BOOST_AUTO_TEST_CASE(standard_errors_are_those_of_repeated_noise)
{
  const auto rows  = flat_block();
  const auto exact = stresses_of(rows);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0., 0.3);
  const unsigned int n_repeats = 400;
  std::vector<double> sum(names.size(), 0.), square(sum), error(sum);
  for (unsigned int r = 0; r < n_repeats; ++r)
    {
      std::vector<double> values = exact;
      for (double &value : values)
        value += noise(random);
      const FieldFit fit =
        fit_fields(rows, values, std::vector<double>(values.size(), 1.), names);
      for (unsigned int j = 0; j < names.size(); ++j)
        {
          sum[j] += fit.coefficients[j] / n_repeats;
          square[j] += fit.coefficients[j] * fit.coefficients[j] / n_repeats;
          error[j] += fit.standard_errors[j] / n_repeats;
        }
    }
  for (unsigned int j = 0; j < names.size(); ++j)
    {
      const double scatter = std::sqrt(square[j] - sum[j] * sum[j]);
      BOOST_TEST_MESSAGE(names[j] << ": standard error " << error[j]
                                  << ", scatter " << scatter);
      BOOST_TEST(std::abs(error[j] / scatter - 1.) < 0.15);
    }
}

BOOST_AUTO_TEST_CASE(fields_that_data_cannot_separate_are_named)
{
  auto rows         = flat_block();
  const auto values = stresses_of(rows);
  for (auto &row : rows)
    row[2] = 2. * row[1];
  try
    {
      fit_fields(rows, values, std::vector<double>(values.size(), 1.), names);
      BOOST_ERROR("no complaint");
    }
  catch (const InputError &error)
    {
      BOOST_TEST(error.message.find("'push x', 'push y'") != std::string::npos);
    }
}

BOOST_AUTO_TEST_SUITE_END()

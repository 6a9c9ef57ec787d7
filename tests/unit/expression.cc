// SPDX-License-Identifier: LGPL-2.1-or-later
// Formulas of scenes: their values, and what is said of those that are none.
#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <vector>

BOOST_AUTO_TEST_SUITE(expression)

using namespace Keyblock;

namespace
{
  /** Value of a formula of one component at (2, 3) or (2, 3, 5) m, 0.5 s. */
  template <int dim>
  double
  value_of(const std::string &text)
  {
    dealii::Point<dim> p;
    p[0] = 2.;
    p[1] = 3.;
    if (dim == 3)
      p[dim - 1] = 5.;
    return Expression<dim>(text, 1, "Section/Entry").value(p, 0.5, 0);
  }

  /** Whether the message about this formula is one sentence with all parts,
   * and nothing else is printed. */
  template <int dim>
  void
  check_refused(const std::string &text,
                const unsigned int n_components,
                const std::vector<std::string> &parts)
  {
    std::ostringstream printed;
    std::streambuf *const screen = std::cerr.rdbuf(printed.rdbuf());
    std::string message;
    try
      {
        Expression<dim>(text, n_components, "Section/Entry");
      }
    catch (const InputError &error)
      {
        message = error.message;
      }
    std::cerr.rdbuf(screen);
    BOOST_TEST_CONTEXT(message)
    {
      BOOST_TEST(printed.str().empty());
      BOOST_REQUIRE(!message.empty());
      BOOST_TEST(message.find('\n') == std::string::npos);
      BOOST_TEST(message.rfind("The formula '" + text +
                                 "' of the entry 'Section/Entry' ",
                               0) == 0u);
      BOOST_TEST(message.back() == '.');
      for (const std::string &part : parts)
        BOOST_TEST(message.find(part) != std::string::npos,
                   "'" << part << "' is missing");
    }
  }
} // namespace

BOOST_AUTO_TEST_CASE(values_of_formulas)
{
  const double close = 1e-14;
  BOOST_TEST(value_of<2>("7") == 7.);
  BOOST_TEST(value_of<2>("x + 2 * y * t") == 5.);
  BOOST_TEST(value_of<2>("-x^2 / 8") == -0.5);
  BOOST_TEST(value_of<2>("1e3 * (x - y)") == -1000.);
  BOOST_TEST(value_of<3>("x * y * z") == 30.);
  BOOST_TEST(std::abs(value_of<2>("cos(pi * t)")) < close);
  BOOST_TEST(std::abs(value_of<2>("sqrt(x)^2") - 2.) < close);
  BOOST_TEST(value_of<2>("if(x > 1, 10, 20)") == 10.);
  BOOST_TEST(value_of<2>("if(x > 3, 10, 20)") == 20.);
  // comparisons are numbers, as the formulas of regions use them
  BOOST_TEST(value_of<2>("(x > 1) * (y < 4) - 0.5") == 0.5);
  BOOST_TEST(value_of<2>("min(x, y) + max(x, y) + abs(-1)") == 6.);
}

BOOST_AUTO_TEST_CASE(components_of_formulas)
{
  const Expression<3> formula("x; y * t; -9.81", 3, "Section/Entry");
  const dealii::Point<3> p(1., 2., 3.);
  BOOST_TEST(formula.value(p, 4., 0) == 1.);
  BOOST_TEST(formula.value(p, 4., 1) == 8.);
  BOOST_TEST(formula.value(p, 4., 2) == -9.81);
  const auto vector = formula.vector(p, 0.25);
  BOOST_TEST(vector[0] == 1.);
  BOOST_TEST(vector[1] == 0.5);
  BOOST_TEST(vector[2] == -9.81);
  // time may go back
  BOOST_TEST(formula.value(p, 0., 1) == 0.);
}

BOOST_AUTO_TEST_CASE(formulas_that_are_refused)
{
  check_refused<2>("1", 2, {"has 1 component(s) where 2 are needed", "';'"});
  check_refused<3>("0; 0; 0; 0", 3, {"has 4 component(s) where 3 are needed"});
  check_refused<2>("x +", 1, {"cannot be understood", "variables x,y,t,"});
  check_refused<3>("a * x", 1, {"cannot be understood", "x,y,z,t,"});
  check_refused<2>("", 1, {"cannot be understood"});
  check_refused<2>("z", 1, {"cannot be understood"});
  check_refused<2>("x; sin(", 2, {"cannot be understood"});
  check_refused<2>("rand()", 1, {"contains rand()", "of x, y and t"});
  check_refused<3>("x + rand_seed (1)",
                   1,
                   {"contains rand()", "of x, y, z and t"});
  // a longer name is another one
  check_refused<2>("brand(x)", 1, {"cannot be understood"});
}

BOOST_AUTO_TEST_SUITE_END()

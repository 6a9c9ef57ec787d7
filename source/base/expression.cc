// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/expression.h>

#include <deal.II/base/function_parser.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/text_parts.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <mutex>
#include <regex>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Keeps what is written to the standard error stream from it as long as
     * this lives; one thread at a time. */
    class MutedErrors
    {
    public:
      MutedErrors()
        : lock(mutex)
        , screen(std::cerr.rdbuf(nothing.rdbuf()))
      {}

      ~MutedErrors()
      {
        std::cerr.rdbuf(screen);
      }

      MutedErrors(const MutedErrors &)            = delete;
      MutedErrors &operator=(const MutedErrors &) = delete;

    private:
      static std::mutex mutex;
      const std::lock_guard<std::mutex> lock;
      std::ostringstream nothing;
      std::streambuf *const screen;
    };

    std::mutex MutedErrors::mutex;

    /** Whether a formula calls rand() or rand_seed(). */
    bool
    calls_random(const std::string &formula)
    {
      const std::string name = "rand", seed = "_seed";
      for (auto place = formula.find(name); place != std::string::npos;
           place      = formula.find(name, place + 1))
        {
               const char before = place > 0 ? formula[place - 1] : ' ';
               auto next         = place + name.size();
               if (formula.compare(next, seed.size(), seed) == 0)
            next += seed.size();
          next = formula.find_first_not_of(" \t\n", next);
               if (next != std::string::npos && formula[next] == '(' &&
              before != '_' &&
              !std::isalnum(static_cast<unsigned char>(before)))
            return true;
        }
      return false;
    }
  } // namespace



  template <int dim>
  Expression<dim>::Expression(const std::string &text,
                              const unsigned int n_components,
                              const std::string &entry)
    : function(std::make_unique<dealii::FunctionParser<dim>>(n_components))
    , n_components(n_components)
  {
    const unsigned int found = 1 + std::count(text.begin(), text.end(), ';');
    AssertThrow(found == n_components,
                InputError("The formula '" + excerpt(text) +
                           "' of the entry '" + entry + "' has " +
                           std::to_string(found) + " component(s) where " +
                           std::to_string(n_components) +
                           " are needed; separate components by ';'."));
    AssertThrow(!calls_random(text),
                InputError("The formula '" + excerpt(text) +
                           "' of the entry '" + entry +
                           "' contains rand(), which gives another number each "
                           "time it is asked and on each rank; write a formula "
                           "of " +
                           std::string(dim == 2 ? "x, y" : "x, y, z") +
                           " and t instead."));
    const std::string variables =
      (dim == 2) ? std::string("x,y,t") : std::string("x,y,z,t");
    // muParser's own complaint would stand beside our sentence
    bool is_understood = true;
    try
      {
        const MutedErrors muted;
        function->initialize(variables,
                             text,
                             {{"pi", dealii::numbers::PI}},
                             true);
        // each is parsed only when it is asked for
        for (unsigned int c = 0; c < n_components; ++c)
          value(dealii::Point<dim>(), 0., c);
      }
    catch (const dealii::ExceptionBase &)
      {
        is_understood = false;
      }
    AssertThrow(is_understood,
                InputError(
                  "The formula '" + excerpt(text) + "' of the entry '" + entry +
                  "' cannot be understood; use the variables " + variables +
                  ", numbers, + - * / ^ and functions such as sin, "
                  "sqrt, if."));
  }



  template <int dim>
  Expression<dim>::~Expression() = default;



  template <int dim>
  double
  Expression<dim>::value(const dealii::Point<dim> &p,
                         const double time,
                         const unsigned int component) const
  {
    function->set_time(time);
    return function->value(p, component);
  }



  template <int dim>
  dealii::Tensor<1, dim>
  Expression<dim>::vector(const dealii::Point<dim> &p, const double time) const
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int c = 0; c < n_components; ++c)
      result[c] = value(p, time, c);
    return result;
  }

  bool
  depends_on_time(const std::string &formula)
  {
    return std::regex_search(formula, std::regex("\\bt\\b"));
  }

  template class Expression<2>;
  template class Expression<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_expression_h
#define keyblock_base_expression_h

#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace dealii
{
  template <int>
  class FunctionParser;
}

namespace Keyblock
{
  /**
   * A formula in x, y, (z) and t as written in the scene, components separated
   * by semicolons, for example `0; -9.81*cos(t)`. Throws InputError when the
   * formula cannot be understood or has the wrong number of components.
   */
  template <int dim>
  class Expression
  {
  public:
    Expression(const std::string &text,
               const unsigned int n_components,
               const std::string &entry);
    ~Expression();

    double value(const dealii::Point<dim> &p,
                 const double time,
                 const unsigned int component) const;

    dealii::Tensor<1, dim> vector(const dealii::Point<dim> &p,
                                  const double time) const;

  private:
    std::unique_ptr<dealii::FunctionParser<dim>> function;
    unsigned int n_components;
  };

  /** Whether a formula names the time t. */
  bool depends_on_time(const std::string &formula);
} // namespace Keyblock

#endif

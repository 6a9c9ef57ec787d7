// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_tests_unit_random_tensor_h
#define keyblock_tests_unit_random_tensor_h

#include <deal.II/base/tensor.h>

#include <random>

/** A vector with components between -1 and 1. */
template <int dim>
dealii::Tensor<1, dim>
random_tensor(std::mt19937 &random)
{
  std::uniform_real_distribution<> coordinate(-1., 1.);
  dealii::Tensor<1, dim> t;
  for (unsigned int d = 0; d < dim; ++d)
    t[d] = coordinate(random);
  return t;
}

#endif

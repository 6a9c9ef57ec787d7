// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/mpi.h>

#include <deal.II/base/mpi.h>

namespace Keyblock
{
  using dealii::ArrayView;



  unsigned int
  n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(world());
  }



  unsigned int
  this_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(world());
  }



  template <typename Number>
  Number
  sum_over_ranks(const Number value)
  {
    return dealii::Utilities::MPI::sum(value, world());
  }



  template <typename Number>
  Number
  max_over_ranks(const Number value)
  {
    return dealii::Utilities::MPI::max(value, world());
  }



  template <typename Number>
  Number
  min_over_ranks(const Number value)
  {
    return dealii::Utilities::MPI::min(value, world());
  }



  template <typename Number>
  void
  sum_over_ranks(Number *first, const std::size_t n)
  {
    dealii::Utilities::MPI::sum(ArrayView<const Number>(first, n),
                                world(),
                                ArrayView<Number>(first, n));
  }



  template <typename Number>
  void
  max_over_ranks(Number *first, const std::size_t n)
  {
    dealii::Utilities::MPI::max(ArrayView<const Number>(first, n),
                                world(),
                                ArrayView<Number>(first, n));
  }



  std::string
  text_of_root(const std::string &text)
  {
    return dealii::Utilities::MPI::broadcast(world(), text, 0);
  }



  std::string
  any_text(const std::string &text)
  {
    const unsigned int first =
      min_over_ranks(text.empty() ? n_ranks() : this_rank());
    return first == n_ranks()
             ? ""
             : dealii::Utilities::MPI::broadcast(world(), text, first);
  }

#define INSTANTIATE(Number)                                                    \
  template Number sum_over_ranks(const Number);                                \
  template Number max_over_ranks(const Number);                                \
  template Number min_over_ranks(const Number);                                \
  template void sum_over_ranks(Number *, const std::size_t);                   \
  template void max_over_ranks(Number *, const std::size_t);

  INSTANTIATE(int)
  INSTANTIATE(unsigned int)
  INSTANTIATE(unsigned long long)
  INSTANTIATE(double)

#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/communicator.h>

#include <deal.II/base/mpi.h>

namespace Keyblock
{
  using dealii::ArrayView;



  unsigned int
  Communicator::size() const
  {
    return dealii::Utilities::MPI::n_mpi_processes(communicator);
  }



  unsigned int
  Communicator::rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(communicator);
  }



  template <typename Number>
  Number
  Communicator::sum(const Number value) const
  {
    return dealii::Utilities::MPI::sum(value, communicator);
  }



  template <typename Number>
  Number
  Communicator::max(const Number value) const
  {
    return dealii::Utilities::MPI::max(value, communicator);
  }



  template <typename Number>
  Number
  Communicator::min(const Number value) const
  {
    return dealii::Utilities::MPI::min(value, communicator);
  }



  template <typename Number>
  void
  Communicator::sum(Number *first, const std::size_t n) const
  {
    dealii::Utilities::MPI::sum(ArrayView<const Number>(first, n),
                                communicator,
                                ArrayView<Number>(first, n));
  }



  template <typename Number>
  void
  Communicator::max(Number *first, const std::size_t n) const
  {
    dealii::Utilities::MPI::max(ArrayView<const Number>(first, n),
                                communicator,
                                ArrayView<Number>(first, n));
  }



  std::string
  Communicator::text_of_root(const std::string &text) const
  {
    return dealii::Utilities::MPI::broadcast(communicator, text, 0);
  }



  std::string
  Communicator::any_text(const std::string &text) const
  {
    const unsigned int first = min(text.empty() ? size() : rank());
    return first == size()
             ? ""
             : dealii::Utilities::MPI::broadcast(communicator, text, first);
  }

#define INSTANTIATE(Number)                                                    \
  template Number Communicator::sum(const Number) const;                       \
  template Number Communicator::max(const Number) const;                       \
  template Number Communicator::min(const Number) const;                       \
  template void Communicator::sum(Number *, const std::size_t) const;          \
  template void Communicator::max(Number *, const std::size_t) const;

  INSTANTIATE(int)
  INSTANTIATE(unsigned int)
  INSTANTIATE(unsigned long long)
  INSTANTIATE(double)

#undef INSTANTIATE
} // namespace Keyblock

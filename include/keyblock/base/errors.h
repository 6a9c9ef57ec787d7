// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_errors_h
#define keyblock_base_errors_h

#include <deal.II/base/exceptions.h>

#include <string>
#include <utility>

namespace Keyblock
{
  /**
   * The user's input cannot be used. The message is one sentence that names
   * what is wrong, the value found, the entry, and the remedy. main() prints
   * it without any decoration and ends with exit code 1.
   */
  class InputError : public dealii::ExceptionBase
  {
  public:
    explicit InputError(std::string message)
      : message(std::move(message))
    {}

    const std::string message;
  };

  /**
   * The computation failed (not finite, no convergence where the scene demands
   * it). main() prints the message and ends with exit code 2.
   */
  class ComputationError : public dealii::ExceptionBase
  {
  public:
    explicit ComputationError(std::string message)
      : message(std::move(message))
    {}

    const std::string message;
  };
} // namespace Keyblock

#endif

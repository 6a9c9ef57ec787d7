// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/last_resort.h>

#include <boost/algorithm/string/trim_all.hpp>

#include <unistd.h>

#include <cctype>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>

namespace Keyblock
{
  std::string
  in_one_line(std::string message)
  {
    for (char &letter : message)
      if (std::iscntrl(static_cast<unsigned char>(letter)))
        letter = ' ';
    return message;
  }



  namespace
  {
    std::string
    our_bug(const std::string &words)
    {
      return "An internal check failed (" +
             boost::trim_all_copy(in_one_line(words)) +
             "); this is a fault of the program: please report it with the "
             "scene.";
    }
  } // namespace



  std::string
  describe_present_exception()
  {
    try
      {
        throw;
      }
    catch (const InputError &error)
      {
        return in_one_line(error.message);
      }
    catch (const ComputationError &error)
      {
        return in_one_line(error.message);
      }
    catch (const std::bad_alloc &)
      {
        return "The memory is used up; use fewer cells ('Mesh/Size' or "
               "'Mesh/Cells'), fewer joints, or a machine with more memory.";
      }
    catch (const dealii::ExceptionBase &exception)
      {
        std::ostringstream words;
        exception.print_info(words);
        return our_bug(std::string(exception.get_exc_name()) + ":" +
                       words.str());
      }
    catch (const std::exception &exception)
      {
        return our_bug(exception.what());
      }
    catch (const std::string &message)
      {
        return our_bug(message);
      }
    catch (...)
      {
        return our_bug("an exception of unknown type");
      }
  }



  void
  end_with_a_sentence()
  {
    std::cerr << "Failed: "
              << (std::current_exception() ? describe_present_exception()
                                           : our_bug("no exception"))
              << std::endl;
    // nothing else is in order any more
    _exit(2);
  }
} // namespace Keyblock

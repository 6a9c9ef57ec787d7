// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmsh.h>
#include <keyblock/base/errors.h>
#include <keyblock/base/gmsh_session.h>

#include <cctype>
#include <exception>
#include <new>

namespace Keyblock
{
  GmshSession::GmshSession()
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0.);
    gmsh::option::setNumber("General.NumThreads", 1.);
    gmsh::option::setNumber("Mesh.MaxNumThreads1D", 1.);
    gmsh::option::setNumber("Mesh.MaxNumThreads2D", 1.);
    gmsh::option::setNumber("Mesh.MaxNumThreads3D", 1.);
  }



  GmshSession::~GmshSession()
  {
    gmsh::finalize();
  }



  std::string
  reason_of_failure(const std::function<void()> &action)
  {
    std::string reason;
    try
      {
        action();
        return "";
      }
    catch (const InputError &error)
      {
        reason = error.message;
      }
    catch (const std::bad_alloc &)
      {
        reason = "there is not enough memory for it";
      }
    catch (const std::exception &exception)
      {
        reason = exception.what();
      }
    catch (const std::string &message)
      {
        reason = message;
      }
    catch (...)
      {
        // OpenCASCADE's exceptions are of no standard type
        reason = "";
      }
    // one sentence, whatever a file makes others quote
    for (char &letter : reason)
      if (std::iscntrl(static_cast<unsigned char>(letter)))
        letter = ' ';
    return reason.empty() ? "unknown reason" : reason;
  }
} // namespace Keyblock

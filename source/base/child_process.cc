// SPDX-License-Identifier: LGPL-2.1-or-later
// Work in a process of its own, and the pipe through which it sends.
#include <keyblock/base/child_process.h>
#include <keyblock/base/gmsh_session.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <stdexcept>

namespace Keyblock
{
  PipeEnd::~PipeEnd()
  {
    close(descriptor);
  }



  void
  PipeEnd::write_bytes(const void *data, const std::size_t n) const
  {
    const auto *at = static_cast<const char *>(data);
    for (std::size_t done = 0; done < n;)
      {
        const ssize_t written = ::write(descriptor, at + done, n - done);
        if (written < 0 && errno != EINTR)
          throw std::runtime_error("the pipe is broken");
        done += std::max<ssize_t>(written, 0);
      }
  }



  void
  PipeEnd::read_bytes(void *data, const std::size_t n) const
  {
    auto *at = static_cast<char *>(data);
    for (std::size_t done = 0; done < n;)
      {
        const ssize_t got = ::read(descriptor, at + done, n - done);
        if (got == 0 || (got < 0 && errno != EINTR))
          throw std::runtime_error("Gmsh sent less than it announced");
        done += std::max<ssize_t>(got, 0);
      }
  }



  void
  PipeEnd::write_number(const std::uint64_t number) const
  {
    write_bytes(&number, sizeof number);
  }



  std::uint64_t
  PipeEnd::read_number() const
  {
    std::uint64_t number;
    read_bytes(&number, sizeof number);
    return number;
  }



  void
  PipeEnd::write_text(const std::string &text) const
  {
    write_number(text.size());
    write_bytes(text.data(), text.size());
  }



  std::string
  PipeEnd::read_text() const
  {
    std::string text(read_number(), ' ');
    read_bytes(text.data(), text.size());
    return text;
  }



  namespace
  {
    /** Signals as they were before MPI took them, nothing on the screen, and no
     * core file. */
    void
    leave_the_run()
    {
      for (const int signal :
           {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL, SIGINT, SIGTERM, SIGUSR1})
        std::signal(signal, SIG_DFL);
      const rlimit none_at_all = {0, 0};
      setrlimit(RLIMIT_CORE, &none_at_all);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
    }

    int
    wait_for(const pid_t child)
    {
      int status = 0;
      while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        {}
      return status;
    }
  } // namespace



  void
  in_child_process(const std::function<void()> &work,
                   const std::function<void(const PipeEnd &)> &send,
                   const std::function<void(const PipeEnd &)> &receive)
  {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error("no pipe to a process that reads it");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0)
      {
        close(ends[0]);
        const std::string failure = reason_of_failure([&]() {
          const PipeEnd to_parent(ends[1]);
          leave_the_run();
          // an empty text and what was found, or why there is nothing
          const std::string reason = reason_of_failure(work);
          to_parent.write_text(reason);
          if (reason.empty())
            send(to_parent);
        });
        // nothing of this process's copy may run at its end
        _exit(failure.empty() ? 0 : 1);
      }
    close(ends[1]);
    const PipeEnd from_child(ends[0]);
    if (child < 0)
      throw std::runtime_error("no process that reads it");
    const std::string failure = reason_of_failure([&]() {
      const std::string reason = from_child.read_text();
      if (!reason.empty())
        throw std::runtime_error(reason);
      receive(from_child);
    });
    const int status          = wait_for(child);
    if (WIFSIGNALED(status) || WEXITSTATUS(status) != 0)
      throw std::runtime_error("Gmsh breaks down over it");
    if (!failure.empty())
      throw std::runtime_error(failure);
  }
} // namespace Keyblock

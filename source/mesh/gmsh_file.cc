// SPDX-License-Identifier: LGPL-2.1-or-later
// Gmsh's files, read by Gmsh in a process of its own.
#include <gmsh.h>
#include <keyblock/mesh/gmsh_file.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** One end of a pipe, which carries plain data. */
    class PipeEnd
    {
    public:
      explicit PipeEnd(const int descriptor)
        : descriptor(descriptor)
      {}

      ~PipeEnd()
      {
        close(descriptor);
      }

      PipeEnd(const PipeEnd &)            = delete;
      PipeEnd &operator=(const PipeEnd &) = delete;

      void
      write_bytes(const void *data, const std::size_t n) const
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
      read_bytes(void *data, const std::size_t n) const
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
      write_number(const std::uint64_t number) const
      {
        write_bytes(&number, sizeof number);
      }

      std::uint64_t
      read_number() const
      {
        std::uint64_t number;
        read_bytes(&number, sizeof number);
        return number;
      }

      void
      write_text(const std::string &text) const
      {
        write_number(text.size());
        write_bytes(text.data(), text.size());
      }

      std::string
      read_text() const
      {
        std::string text(read_number(), ' ');
        read_bytes(text.data(), text.size());
        return text;
      }

    private:
      const int descriptor;
    };

    void
    write_elements(const PipeEnd &pipe,
                   const std::vector<MixedMesh::Element> &elements)
    {
      pipe.write_number(elements.size());
      for (const MixedMesh::Element &element : elements)
        {
          pipe.write_number(element.id);
          pipe.write_number(element.vertices.size());
          pipe.write_bytes(element.vertices.data(),
                           element.vertices.size() * sizeof(unsigned int));
        }
    }

    std::vector<MixedMesh::Element>
    read_elements(const PipeEnd &pipe, const std::size_t n_vertices)
    {
      std::vector<MixedMesh::Element> elements(pipe.read_number());
      for (MixedMesh::Element &element : elements)
        {
          element.id = pipe.read_number();
          element.vertices.resize(pipe.read_number());
          pipe.read_bytes(element.vertices.data(),
                          element.vertices.size() * sizeof(unsigned int));
          for (const unsigned int vertex : element.vertices)
            if (vertex >= n_vertices)
              throw std::runtime_error("an element names a vertex that does "
                                       "not exist");
        }
      return elements;
    }

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

    /** What the child does: an empty text and the mesh, or why there is none.
     */
    template <int dim>
    void
    read_and_send(const std::string &path, const PipeEnd &pipe)
    {
      leave_the_run();
      MixedMesh mixed;
      const std::string reason = reason_of_failure([&]() {
        const GmshSession session;
        gmsh::open(path);
        mixed = read_gmsh_model<dim>();
      });
      pipe.write_text(reason);
      if (!reason.empty())
        return;
      pipe.write_number(mixed.vertices.size());
      for (const Point<3> &vertex : mixed.vertices)
        pipe.write_bytes(vertex.begin_raw(), 3 * sizeof(double));
      write_elements(pipe, mixed.cells);
      write_elements(pipe, mixed.faces);
    }

    MixedMesh
    receive(const PipeEnd &pipe)
    {
      const std::string reason = pipe.read_text();
      if (!reason.empty())
        throw std::runtime_error(reason);
      MixedMesh mixed;
      mixed.vertices.resize(pipe.read_number());
      for (Point<3> &vertex : mixed.vertices)
        pipe.read_bytes(vertex.begin_raw(), 3 * sizeof(double));
      mixed.cells = read_elements(pipe, mixed.vertices.size());
      mixed.faces = read_elements(pipe, mixed.vertices.size());
      return mixed;
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



  template <int dim>
  MixedMesh
  read_gmsh_file(const std::string &path)
  {
    int ends[2];
    if (pipe(ends) != 0)
      throw std::runtime_error("no pipe to a process that reads it");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0)
      {
        close(ends[0]);
        const std::string failure = reason_of_failure(
          [&]() { read_and_send<dim>(path, PipeEnd(ends[1])); });
        // nothing of this process's copy may run at its end
        _exit(failure.empty() ? 0 : 1);
      }
    close(ends[1]);
    const PipeEnd from_child(ends[0]);
    if (child < 0)
      throw std::runtime_error("no process that reads it");
    MixedMesh mixed;
    const std::string failure =
      reason_of_failure([&]() { mixed = receive(from_child); });
    const int status = wait_for(child);
    if (WIFSIGNALED(status))
      throw std::runtime_error("Gmsh breaks down over it, as it does over "
                               "files that are damaged");
    if (!failure.empty())
      throw std::runtime_error(failure);
    return mixed;
  }

  template MixedMesh read_gmsh_file<2>(const std::string &);
  template MixedMesh read_gmsh_file<3>(const std::string &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Gmsh at work, here or in a process of its own.
#include <deal.II/base/utilities.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <gmsh.h>
#include <keyblock/mesh/gmsh_process.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

namespace Keyblock
{
  namespace
  {
    /** The nodes and elements of one entity of a model. */
    struct MeshOfEntity
    {
      int dimension, tag;
      std::vector<std::size_t> nodes;
      std::vector<double> places; ///< of the nodes, three each [m]
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, corners; ///< by type

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &dimension &tag &nodes &places &types &elements &corners;
      }
    };

    /** Gmsh's error, and the mesh if there was none. */
    using Outcome = std::pair<std::string, std::vector<MeshOfEntity>>;

    std::vector<MeshOfEntity>
    read_mesh_of_model()
    {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities);
      std::vector<MeshOfEntity> result;
      for (const auto &[dimension, tag] : entities)
        {
          MeshOfEntity mesh{dimension, tag, {}, {}, {}, {}, {}};
          std::vector<double> parameters;
          gmsh::model::mesh::getNodes(
            mesh.nodes, mesh.places, parameters, dimension, tag);
          gmsh::model::mesh::getElements(
            mesh.types, mesh.elements, mesh.corners, dimension, tag);
          result.push_back(mesh);
        }
      return result;
    }

    void
    write_mesh_of_model(const std::vector<MeshOfEntity> &meshes)
    {
      gmsh::model::mesh::clear();
      for (const MeshOfEntity &mesh : meshes)
        gmsh::model::mesh::addNodes(mesh.dimension,
                                    mesh.tag,
                                    mesh.nodes,
                                    mesh.places);
      for (const MeshOfEntity &mesh : meshes)
        gmsh::model::mesh::addElements(
          mesh.dimension, mesh.tag, mesh.types, mesh.elements, mesh.corners);
    }

    /** Mesh the model, send what came of it, and end this process. */
    [[noreturn]] void
    mesh_and_send(const int dimension, const int pipe)
    {
      for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE})
        std::signal(signal, SIG_DFL);
      Outcome outcome{mesh_entities(dimension), {}};
      if (outcome.first.empty())
        outcome.second = read_mesh_of_model();
      const std::vector<char> bytes = dealii::Utilities::pack(outcome, false);
      for (std::size_t sent = 0; sent < bytes.size();)
        {
          const auto n = write(pipe, bytes.data() + sent, bytes.size() - sent);
          if (n <= 0)
            _exit(EXIT_FAILURE);
          sent += n;
        }
      _exit(EXIT_SUCCESS);
    }

    std::vector<char>
    read_all(const int pipe)
    {
      std::vector<char> bytes, piece(1 << 16);
      for (auto n = read(pipe, piece.data(), piece.size()); n > 0;
           n      = read(pipe, piece.data(), piece.size()))
        bytes.insert(bytes.end(), piece.begin(), piece.begin() + n);
      return bytes;
    }
  } // namespace



  std::string
  mesh_entities(const int dimension)
  {
    // an exception in one of Gmsh's threads would end the program
    gmsh::option::setNumber("General.AbortOnError", 0.);
    gmsh::logger::start();
    gmsh::model::mesh::generate(dimension);
    std::vector<std::string> log;
    gmsh::logger::get(log);
    gmsh::logger::stop();
    gmsh::option::setNumber("General.AbortOnError", 2.);
    const std::string mark = "Error: ";
    for (const std::string &line : log)
      if (line.compare(0, mark.size(), mark) == 0)
        return line.substr(mark.size());
    return "";
  }



  std::string
  mesh_entities_apart(const int dimension)
  {
    int ends[2];
    if (pipe(ends) != 0)
      return "no pipe to another process could be opened";
    const pid_t child = fork();
    if (child == 0)
      {
        close(ends[0]);
        mesh_and_send(dimension, ends[1]);
      }
    close(ends[1]);
    const std::vector<char> bytes = read_all(ends[0]);
    close(ends[0]);
    if (child < 0)
      return "no other process could be started";
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
      return std::string("Gmsh crashed: ") + strsignal(WTERMSIG(status));
    if (WEXITSTATUS(status) != EXIT_SUCCESS)
      return "Gmsh ended early";
    const auto outcome = dealii::Utilities::unpack<Outcome>(bytes, false);
    if (outcome.first.empty())
      write_mesh_of_model(outcome.second);
    return outcome.first;
  }
} // namespace Keyblock

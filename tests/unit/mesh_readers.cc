// SPDX-License-Identifier: LGPL-2.1-or-later
// Mesh files of each kind: what is read, and what is said of bad ones.
#include <boost/test/unit_test.hpp>

#include <keyblock/base/communicator.h>
#include <keyblock/base/errors.h>
#include <keyblock/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

BOOST_AUTO_TEST_SUITE(mesh_readers)

using namespace Keyblock;

namespace
{
  /** The mesh in a file of this content, of each rank its own. */
  template <int dim>
  Mesh<dim>
  read(const std::string &extension, const std::string &content)
  {
    Scene<dim> scene;
    const Communicator world(MPI_COMM_WORLD);
    scene.domain.file = "mesh_" + std::to_string(world.size()) + "_" +
                        std::to_string(world.rank()) + extension;
    std::ofstream(scene.domain.file, std::ios::binary) << content;
    return read_mesh(scene);
  }

  /** Whether the message about this file is one sentence with all parts. */
  template <int dim>
  void
  check_refused(const std::string &extension,
                const std::string &content,
                const std::vector<std::string> &parts)
  {
    std::string message;
    try
      {
        read<dim>(extension, content);
      }
    catch (const InputError &error)
      {
        message = error.message;
      }
    BOOST_TEST_CONTEXT(message)
    {
      BOOST_REQUIRE(!message.empty());
      BOOST_TEST(message.find('\n') == std::string::npos);
      BOOST_TEST(message.rfind("The mesh file 'mesh_", 0) == 0u);
      BOOST_TEST(message.back() == '.');
      for (const std::string &part : parts)
        BOOST_TEST(message.find(part) != std::string::npos,
                   "'" << part << "' is missing");
    }
  }

  template <int dim>
  double
  volume_of(const Mesh<dim> &mesh)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      sum += mesh.cell_volume(c);
    return sum;
  }

  template <int dim>
  Point<dim>
  center_of(const Mesh<dim> &mesh, const typename Mesh<dim>::BoundaryFace &face)
  {
    Point<dim> sum;
    for (const unsigned int vertex : face.vertices)
      sum += mesh.vertices[vertex];
    return sum / double(face.vertices.size());
  }

  /** Two unit squares, of the regions 11 on the left and 12 on the right, and
   * boundaries 3 on the left and 7 on the right. */
  void
  check_two_squares(const Mesh<2> &mesh)
  {
    BOOST_TEST(mesh.vertices.size() == 6u);
    BOOST_REQUIRE(mesh.n_cells() == 2u);
    BOOST_REQUIRE(mesh.region.size() == 2u);
    for (unsigned int c = 0; c < 2; ++c)
      {
        BOOST_TEST(std::abs(mesh.cell_volume(c) - 1.) < 1e-12);
        BOOST_TEST(mesh.region[c] == (mesh.cell_center(c)[0] < 1. ? 11u : 12u));
      }
    std::map<unsigned int, Point<2>> centers;
    for (const auto &face : mesh.boundary_faces)
      centers[face.id] = center_of(mesh, face);
    BOOST_TEST(mesh.boundary_faces.size() == 2u);
    BOOST_REQUIRE((centers.count(3) == 1 && centers.count(7) == 1));
    BOOST_TEST(centers[3].distance(Point<2>(0., 0.5)) < 1e-12);
    BOOST_TEST(centers[7].distance(Point<2>(2., 0.5)) < 1e-12);
  }

  // the seventh point belongs to no cell

  const std::string squares_msh = "$MeshFormat\n"
                                  "2.2 0 8\n"
                                  "$EndMeshFormat\n"
                                  "$Nodes\n"
                                  "7\n"
                                  "1 0 0 0\n"
                                  "2 1 0 0\n"
                                  "3 2 0 0\n"
                                  "4 0 1 0\n"
                                  "5 1 1 0\n"
                                  "6 2 1 0\n"
                                  "7 9 9 0\n"
                                  "$EndNodes\n"
                                  "$Elements\n"
                                  "4\n"
                                  "1 1 2 3 1 1 4\n"
                                  "2 1 2 7 2 3 6\n"
                                  "3 3 2 11 1 1 2 5 4\n"
                                  "4 3 2 12 2 2 3 6 5\n"
                                  "$EndElements\n";

  const std::string squares_inp = "*HEADING\n"
                                  "** two squares\n"
                                  "*NODE, NSET=ALL\n"
                                  "1, 0., 0., 0.\n"
                                  "2, 1., 0., 0.\n"
                                  "3, 2., 0., 0.\n"
                                  "4, 0., 1., 0.\n"
                                  "5, 1., 1., 0.\n"
                                  "6, 2., 1., 0.\n"
                                  "7, 9., 9., 0.\n"
                                  "*ELEMENT, TYPE=CPS4, ELSET=EB11\n"
                                  "1, 1, 2, 5, 4\n"
                                  "2, 2, 3,\n"
                                  "6, 5\n"
                                  "*ELEMENT, TYPE=T3D2, ELSET=SS3\n"
                                  "3, 1, 4\n"
                                  "4, 3, 6\n"
                                  "*ELSET, ELSET=EB12\n"
                                  "2,\n"
                                  "*ELSET, ELSET=SS7, GENERATE\n"
                                  "4, 4, 1\n";

  const std::string squares_vtk = "# vtk DataFile Version 2.0\n"
                                  "two squares\n"
                                  "ASCII\n"
                                  "DATASET UNSTRUCTURED_GRID\n"
                                  "POINTS 7 double\n"
                                  "0 0 0  1 0 0  2 0 0\n"
                                  "0 1 0  1 1 0  2 1 0\n"
                                  "9 9 0\n"
                                  "CELLS 4 16\n"
                                  "4 0 1 4 3\n"
                                  "4 1 2 5 4\n"
                                  "2 0 3\n"
                                  "2 2 5\n"
                                  "CELL_TYPES 4\n"
                                  "9 9 3 3\n"
                                  "CELL_DATA 4\n"
                                  "SCALARS MaterialID int 1\n"
                                  "LOOKUP_TABLE default\n"
                                  "11 12 3 7\n";

  const std::string squares_ucd = "# two squares\n"
                                  "7 4 0 0 0\n"
                                  "1 0 0 0\n"
                                  "2 1 0 0\n"
                                  "3 2 0 0\n"
                                  "4 0 1 0\n"
                                  "5 1 1 0\n"
                                  "6 2 1 0\n"
                                  "7 9 9 0\n"
                                  "1 11 quad 1 2 5 4\n"
                                  "2 12 quad 2 3 6 5\n"
                                  "3 3 line 1 4\n"
                                  "4 7 line 3 6\n";

  std::string
  replaced(std::string text, const std::string &from, const std::string &to)
  {
    const auto at = text.find(from);
    BOOST_REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
  }
} // namespace

BOOST_AUTO_TEST_CASE(two_squares_of_each_kind_of_file)
{
  check_two_squares(read<2>(".msh", squares_msh));
  check_two_squares(read<2>(".inp", squares_inp));
  check_two_squares(read<2>(".vtk", squares_vtk));
  check_two_squares(read<2>(".ucd", squares_ucd));
}

// a tetrahedron is cut into four hexahedra: its corners, the centres of edges
// and faces, and its own
BOOST_AUTO_TEST_CASE(tetrahedra_of_msh_and_vtk)
{
  const Mesh<3> of_msh = read<3>(".msh",
                                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                                 "$Nodes\n4\n"
                                 "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
                                 "$EndNodes\n"
                                 "$Elements\n2\n"
                                 "1 2 2 5 1 1 2 3\n"
                                 "2 4 2 8 1 1 2 3 4\n"
                                 "$EndElements\n");
  // the connectivity of version 5
  const Mesh<3> of_vtk = read<3>(".vtk",
                                 "# vtk DataFile Version 5.1\n"
                                 "a tetrahedron\n"
                                 "ASCII\n"
                                 "DATASET UNSTRUCTURED_GRID\n"
                                 "POINTS 4 float\n"
                                 "0 0 0  1 0 0  0 1 0  0 0 1\n"
                                 "CELLS 3 7\n"
                                 "OFFSETS vtktypeint64\n"
                                 "0 3 7\n"
                                 "CONNECTIVITY vtktypeint64\n"
                                 "0 1 2  0 1 2 3\n"
                                 "CELL_TYPES 2\n"
                                 "5 10\n"
                                 "CELL_DATA 2\n"
                                 "FIELD FieldData 1\n"
                                 "CellEntityIds 1 2 int\n"
                                 "5 8\n");
  for (const Mesh<3> *mesh : {&of_msh, &of_vtk})
    {
      BOOST_TEST(mesh->vertices.size() == 15u);
      BOOST_TEST(mesh->n_cells() == 4u);
      BOOST_TEST(std::abs(volume_of(*mesh) - 1. / 6.) < 1e-12);
      for (const unsigned int region : mesh->region)
        BOOST_TEST(region == 8u);
      BOOST_TEST(mesh->boundary_faces.size() == 3u);
      for (const auto &face : mesh->boundary_faces)
        {
          BOOST_TEST(face.id == 5u);
          BOOST_TEST(std::abs(center_of(*mesh, face)[2]) < 1e-12);
        }
    }
}

BOOST_AUTO_TEST_CASE(hexahedron_of_ucd)
{
  const Mesh<3> mesh = read<3>(".ucd",
                               "8 3 0 0 0\n"
                               "10 0 0 0\n20 2 0 0\n30 2 1 0\n40 0 1 0\n"
                               "50 0 0 1\n60 2 0 1\n70 2 1 1\n80 0 1 1\n"
                               "1 4 hex 10 20 30 40 50 60 70 80\n"
                               "2 6 quad 50 60 70 80\n"
                               // a boundary without a number is none
                               "3 0 quad 10 20 30 40\n");
  BOOST_TEST(mesh.vertices.size() == 8u);
  BOOST_REQUIRE(mesh.n_cells() == 1u);
  BOOST_TEST(std::abs(mesh.cell_volume(0) - 2.) < 1e-12);
  BOOST_TEST(mesh.region[0] == 4u);
  BOOST_REQUIRE(mesh.boundary_faces.size() == 1u);
  BOOST_TEST(mesh.boundary_faces[0].id == 6u);
  BOOST_TEST(
    center_of(mesh, mesh.boundary_faces[0]).distance(Point<3>(1., 0.5, 1.)) <
    1e-12);
}

// of elements of second order the corners; a wedge is cut into six
BOOST_AUTO_TEST_CASE(wedge_of_inp)
{
  const Mesh<3> mesh = read<3>(".inp",
                               "*Node\n"
                               "1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n"
                               "4, 0, 0, 1\n5, 1, 0, 1\n6, 0, 1, 1\n"
                               "7, 0.5, 0, 0\n8, 0.5, 0.5, 0\n9, 0, 0.5, 0\n"
                               "*Element, type=C3D6, elset=rock\n"
                               "1, 1, 2, 3, 4, 5, 6\n"
                               "*Element, type=STRI65, elset=bottom2\n"
                               "2, 1, 2, 3, 7, 8, 9\n");
  BOOST_TEST(mesh.n_cells() == 6u);
  BOOST_TEST(std::abs(volume_of(mesh) - 0.5) < 1e-12);
  // six corners, nine edges, five faces, the cell
  BOOST_TEST(mesh.vertices.size() == 21u);
  BOOST_TEST(mesh.region[0] == 0u);
  BOOST_TEST(mesh.boundary_faces.size() == 3u);
  for (const auto &face : mesh.boundary_faces)
    BOOST_TEST(face.id == 2u);
}

BOOST_AUTO_TEST_CASE(mesh_files_that_are_refused)
{
  check_refused<2>(".msh",
                   "Point(1) = {0, 0, 0};\n",
                   {"cannot be understood (it does not begin with '$')"});
  check_refused<2>(".inp",
                   replaced(squares_inp, "1, 1, 2, 5, 4", "1, 1, 2, 5, 8"),
                   {"(element 1 names the node 8, which is not there)"});
  check_refused<2>(".vtk",
                   replaced(squares_vtk, "ASCII", "BINARY"),
                   {"(it is not a legacy VTK file in ASCII)"});
  check_refused<2>(".ucd",
                   replaced(squares_ucd, "12 quad", "12 square"),
                   {"(the element type 'square' is unknown)"});
  // of any kind
  check_refused<2>(".stl", "solid\n", {"extension '.stl'", ".msh (Gmsh)"});
  check_refused<3>(".ucd", squares_ucd, {"no cells of dimension 3"});
  check_refused<2>(".ucd",
                   replaced(squares_ucd, "6 2 1 0", "6 2 1 0.5"),
                   {"between z = 0 m and 0.5 m", "'Dimension' is 2"});
  check_refused<2>(".vtk",
                   replaced(squares_vtk, "2 1 0\n", "2 1e10 0\n"),
                   {"has a vertex at", "at most 1e9 m"});
  check_refused<2>(".ucd",
                   replaced(squares_ucd, "1 2 5 4", "1 5 2 4"),
                   {"flat, folded or not convex", "repair it"});
}

BOOST_AUTO_TEST_SUITE_END()

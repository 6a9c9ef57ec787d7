// SPDX-License-Identifier: LGPL-2.1-or-later
// Local refinement: linear motions pass through hanging nodes exactly, and a
// wave that crosses them keeps its energy.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/run/simulation.h>

#include <cmath>
#include <fstream>

BOOST_AUTO_TEST_SUITE(refinement)

using namespace Keyblock;

namespace
{
  std::string
  write_scene(const std::string &text)
  {
    const std::string name = "refinement_" + std::to_string(world.size());
    if (world.is_root())
      std::ofstream(name + ".prm") << text;
    MPI_Barrier(world);
    return name;
  }

  const std::string material =
    "subsection Materials\n set Names = rock\n subsection rock\n set Young "
    "modulus = 1e9\n set Poisson ratio = 0.25\n end\nend\nsubsection Output\n "
    "set Write VTU = false\n set History interval = 1000\nend\n";

  /** Largest deviation of the displacements from the linear field that the
   * outer boundary is given, relative to its largest. */
  template <int dim>
  double
  deviation(const std::string &stage, const std::string &refinement)
  {
    const std::string field =
      dim == 2 ? "1e-3*x + 2e-3*y; -5e-4*x + 1e-3*y"
               : "1e-3*x + 2e-3*y - z*1e-3; -5e-4*x + 1e-3*y; 7e-4*z + 3e-4*x";
    const std::string size = dim == 2 ? "4, 4" : "4, 4, 4";
    const std::string name = write_scene(
      "set Dimension = " + std::to_string(dim) +
      "\nsubsection Domain\n set Size = " + size +
      "\nend\nsubsection Mesh\n set Cells = " + size +
      "\n set Refinement levels = " + refinement + "\nend\n" + material +
      "subsection Supports\n set Names = outer\n subsection outer\n set "
      "Boundaries = all\n set Displacement = " +
      field +
      "\n end\nend\nsubsection Stages\n set Names = load\n subsection load\n" +
      stage + " end\nend\n");
    Simulation<dim> simulation(world, name + ".prm", {}, name);
    simulation.run();
    BOOST_TEST(simulation.state().split.hanging.size() > 4);
    const auto &mesh                = simulation.state().split.mesh;
    const std::vector<double> found = simulation.state().values_by_vertex(
      simulation.state().fields.displacement);
    double largest = 0.;
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      {
        const Point<dim> &p               = mesh.vertices[v];
        const double z                    = dim == 3 ? p[dim - 1] : 0.;
        const std::array<double, 3> exact = {
          {1e-3 * p[0] + 2e-3 * p[1] - 1e-3 * z,
           -5e-4 * p[0] + 1e-3 * p[1],
           7e-4 * z + 3e-4 * p[0]}};
        for (unsigned int d = 0; d < dim; ++d)
          largest = std::max(largest, std::abs(found[dim * v + d] - exact[d]));
      }
    return largest / 0.012;
  }

  const std::string static_stage = " set Kind = static\n";
  const std::string damped_stage =
    " set Kind = quasi-static\n set Unbalanced ratio = 1e-13\n set Maximum "
    "steps = 20000\n";
} // namespace

BOOST_AUTO_TEST_CASE(hanging_nodes_pass_linear_fields_in_2d)
{
  const std::string levels = "3*(x + y < 2.1) + (x > 3)";
  BOOST_TEST(deviation<2>(static_stage, levels) < 1e-11);
  BOOST_TEST(deviation<2>(damped_stage, levels) < 1e-10);
}

BOOST_AUTO_TEST_CASE(hanging_nodes_pass_linear_fields_in_3d)
{
  const std::string levels = "2*(x + y + z < 3.1) + (x > 3)*(y > 2)";
  BOOST_TEST(deviation<3>(static_stage, levels) < 1e-11);
  BOOST_TEST(deviation<3>(damped_stage, levels) < 1e-10);
}

BOOST_AUTO_TEST_SUITE_END()

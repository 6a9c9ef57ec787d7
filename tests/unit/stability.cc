// SPDX-License-Identifier: LGPL-2.1-or-later
// The time step against the true limit of a mesh, and rest under initial
// stress.
#include "mesh_frequency.h"

#include <keyblock/base/errors.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

BOOST_AUTO_TEST_SUITE(stability)

using namespace Keyblock;

namespace
{
  /** A free plate of 8 x 8 cells that vibrates. */
  std::string
  write_plate(const double safety, const unsigned int n_steps)
  {
    const std::string name = "plate_" + std::to_string(world.size());
    if (world.is_root())
      std::ofstream(name + ".prm")
        << "subsection Domain\n set Size = 8, 8\n set Truncated boundaries = "
           "none\nend\nsubsection Mesh\n set Cells = 8, 8\nend\nsubsection "
           "Materials\n set Names = rock\n subsection rock\n set Young modulus "
           "= 1e9\n set Poisson ratio = 0.3\n set Density = 2500\n "
           "end\nend\nsubsection Initial state\n set Velocity = 1e-3*sin(7*x + "
           "3*y); 1e-3*cos(5*x*y)\nend\nsubsection Time stepping\n set Safety "
           "= "
        << std::setprecision(17) << safety
        << "\nend\nsubsection Stages\n set Names = ring\n subsection ring\n "
           "set Maximum steps = "
        << n_steps
        << "\n end\nend\nsubsection Output\n set Write VTU = false\n set "
           "History interval = 1000\nend\n";
    MPI_Barrier(world);
    return name;
  }
} // namespace

BOOST_AUTO_TEST_CASE(time_step_limit)
{
  double bound = 0., limit = 0.;
  {
    const std::string name = write_plate(0.9, 1);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    simulation.run();
    bound = simulation.state().stable_step();
    limit = 2. / highest_frequency_of_mesh(simulation, 20000);
  }
  // h sqrt(1 - nu) / c_p is the bound of a square cell, and a free plate of
  // 8 x 8 cells allows 0.99018 h / c_p
  const double c_p = std::sqrt(1e9 * 0.7 / (1.3 * 0.4) / 2500.);
  BOOST_TEST_MESSAGE("bound " << bound * c_p << ", true limit " << limit * c_p
                              << " of h / c_p; ratio " << limit / bound);
  BOOST_TEST(std::abs(bound * c_p - std::sqrt(0.7)) < 1e-4);
  BOOST_TEST(std::abs(limit * c_p - 0.99018) < 1e-4);
  BOOST_TEST(bound <= limit);
  {
    const std::string name = write_plate(0.99 * limit / bound, 100000);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    simulation.run();
    double largest = 0.;
    for (const double v : simulation.state().values_by_vertex(
           simulation.state().fields.velocity))
      largest = std::max(largest, std::abs(v));
    BOOST_TEST(largest < 0.1);
  }
  {
    const std::string name = write_plate(1.01 * limit / bound, 100000);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    BOOST_CHECK_THROW(simulation.run(), ComputationError);
  }
}

BOOST_AUTO_TEST_CASE(jointed_rock_in_equilibrium_stays_at_rest)
{
  const std::string name = "rest_" + std::to_string(world.size());
  if (world.is_root())
    std::ofstream(name + ".prm")
      << "subsection Domain\n set Corner = -10, -10\n set Size = 20, "
         "20\nend\nsubsection Mesh\n set Generator = gmsh\n set Size = "
         "1.5\nend\nsubsection Excavations\n set Names = hole\n subsection "
         "hole\n set Vertices = -3, -3; 3, -3; 3, 3; -3, 3\n set Stage = "
         "excavate\n end\nend\nsubsection Joints\n set Names = a, b\n "
         "subsection "
         "a\n set Extent = polygon\n set Vertices = -2.5, 3; 0, 7\n set "
         "Friction angle = 40\n end\n subsection b\n set Extent = polygon\n "
         "set Vertices = 2.5, 3; 0, 7\n set Friction angle = 40\n "
         "end\nend\nsubsection Materials\n set Names = rock\n subsection "
         "rock\n "
         "set Young modulus = 1e9\n end\nend\nsubsection Supports\n set Names "
         "= "
         "sides, bottom\n subsection sides\n set Boundaries = left, right\n "
         "set "
         "Directions = x\n end\n subsection bottom\n set Boundaries = "
         "bottom\n end\nend\nsubsection Initial state\n set Gravity = 0; "
         "-9.81\n set Surface elevation = 10\n set Surface stress = 0\n set "
         "Vertical stress gradient = 26487\n set Equilibrium = "
         "static\nend\nsubsection Stages\n set Names = rest, excavate\n "
         "subsection "
         "rest\n set Maximum steps = 1000\n end\n subsection excavate\n set "
         "Maximum "
         "steps = 300\n end\nend\nsubsection Monitors\n set Names = all\n "
         "subsection all\n set Kind = region\n end\nend\nsubsection Output\n "
         "set Write VTU = false\nend\n";
  MPI_Barrier(world);
  Simulation<2> simulation(world, name + ".prm", {}, name);
  simulation.run();
  if (world.is_root())
    {
      const History &history = simulation.measured();
      const auto kinetic     = history.column("energy.kinetic", 0);
      const double rest      = kinetic[history.stage_begin[1] - 1];
      const double peak =
        *std::max_element(kinetic.begin() + history.stage_begin[1],
                          kinetic.end());
      BOOST_TEST_MESSAGE("velocity at rest over the peak of digging "
                         << std::sqrt(rest / peak));
      BOOST_TEST(std::sqrt(rest / peak) < 1e-9);
    }
  BOOST_TEST(simulation.state().split.interface.pairs.size() > 5);
}

BOOST_AUTO_TEST_SUITE_END()

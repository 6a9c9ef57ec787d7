// SPDX-License-Identifier: LGPL-2.1-or-later
// Two square bars stand on their edges, one across the other: ridges meet
// between their nodes, so that only contact of edge with edge can hold them
// apart.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/run/simulation.h>

#include <cmath>
#include <fstream>
#include <sstream>

BOOST_AUTO_TEST_SUITE(ridges)

using namespace Keyblock;

namespace
{
  constexpr unsigned int n_along = 5; // odd: the ridges cross inside an edge
  constexpr double gap           = 1e-3;

  /** A bar with a square section of diagonal 2 m on its edge, 5 m long: along
   * x below the origin, or along y above it. */
  void
  write_bar(std::ostream &vertices, std::ostream &cells, const unsigned int bar)
  {
    const unsigned int first = bar * 4 * (n_along + 1);
    for (unsigned int i = 0; i <= n_along; ++i)
      for (unsigned int corner = 0; corner < 4; ++corner)
        {
          const double along  = double(i) - 0.5 * n_along;
          const double across = corner == 1 ? 1. : corner == 3 ? -1. : 0.;
          const double down   = corner == 0 ? 0. : corner == 2 ? 2. : 1.;
          vertices << first + 4 * i + corner + 1 << ' '
                   << (bar == 0 ? along : across) << ' '
                   << (bar == 0 ? across : along) << ' '
                   << (bar == 0 ? -down : gap + down) << '\n';
        }
    for (unsigned int i = 0; i < n_along; ++i)
      {
        cells << bar * n_along + i + 1 << " 0 hex";
        for (const unsigned int layer : {i, i + 1})
          for (unsigned int corner = 0; corner < 4; ++corner)
            cells << ' ' << first + 4 * layer + corner + 1;
        cells << '\n';
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(crossed_ridges_rebound)
{
  const std::string name = "ridges_" + std::to_string(world.size());
  if (world.is_root())
    {
      std::ostringstream vertices, cells;
      write_bar(vertices, cells, 0);
      write_bar(vertices, cells, 1);
      std::ofstream(name + ".ucd")
        << 8 * (n_along + 1) << ' ' << 2 * n_along << " 0 0 0\n"
        << vertices.str() << cells.str();
      std::ofstream(name + ".prm")
        << "set Dimension = 3\nsubsection Domain\n set Shape = file\n set File "
           "= "
        << name
        << ".ucd\n set Truncated boundaries = none\nend\nsubsection Mesh\n set "
           "Generator = file\nend\nsubsection Materials\n set Names = rock\n "
           "subsection rock\n set Young modulus = 1e8\n set Poisson ratio = "
           "0.2\n set Density = 2000\n end\nend\nsubsection Time stepping\n "
           "set Kinematics = large\nend\nsubsection Initial state\n set "
           "Velocity = 0; 0; if(z > 0, -0.1, 0.1)\nend\nsubsection Stages\n "
           "set Names = meet\n subsection meet\n set Duration = 0.2\n "
           "end\nend\nsubsection Monitors\n set Names = upper, lower\n "
           "subsection upper\n set Kind = block\n set Location = 0.1, 0.2, "
           "1\n end\n subsection lower\n set Kind = block\n set Location = "
           "0.1, 0.2, -1\n end\nend\nsubsection Output\n set Write VTU = "
           "false\nend\n";
    }
  MPI_Barrier(world);
  Simulation<3> simulation(world, name + ".prm", {}, name);
  simulation.run();

  const History &history = simulation.measured();
  bool is_kept_apart = true, is_momentum_kept = true;
  double rebound = 0.;
  if (world.is_root())
    {
      const auto upper = history.column("upper.u_z", 0);
      const auto lower = history.column("lower.u_z", 0);
      const auto fast  = history.column("upper.v_z", 0);
      const auto slow  = history.column("lower.v_z", 0);
      for (unsigned int i = 0; i < upper.size(); ++i)
        {
          is_momentum_kept =
            is_momentum_kept && std::abs(fast[i] + slow[i]) < 1e-12;
          // centres come closer than the gap by what the bars are compressed
          is_kept_apart = is_kept_apart && gap + upper[i] - lower[i] > -0.01;
        }
      rebound = fast.back();
      BOOST_TEST_MESSAGE("crossed ridges rebound at "
                         << rebound << " m/s after an impact at 0.1 m/s");
      BOOST_TEST(is_momentum_kept);
      BOOST_TEST(is_kept_apart);
      // the rest of the energy is in the vibration of the bars
      const auto kinetic  = history.column("energy.kinetic", 0);
      const auto residual = history.column("energy.residual", 0);
      BOOST_TEST_MESSAGE("energy residual " << residual.back() / kinetic[0]);
      BOOST_TEST(rebound > 0.);
      BOOST_TEST(std::abs(residual.back()) < 1e-4 * kinetic[0]);
    }
}

BOOST_AUTO_TEST_SUITE_END()

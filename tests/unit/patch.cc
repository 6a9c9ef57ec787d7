// SPDX-License-Identifier: LGPL-2.1-or-later
// A column with an inclined joint under a uniform pressure: the stress must be
// uniform to round-off, whether the joint is bonded or only pressed.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/run/simulation.h>

#include <cmath>
#include <fstream>
#include <sstream>

BOOST_AUTO_TEST_SUITE(patch)

using namespace Keyblock;

namespace
{
  /** Largest deviation of any stress from (0, -1 MPa, -nu MPa, 0), relative. */
  double
  deviation(const double dip, const std::string &strength)
  {
    const std::string name = "patch_" + std::to_string(world.size());
    if (world.is_root())
      std::ofstream(name + ".prm")
        << "subsection Domain\n set Size = 1, 2\n set Truncated boundaries = "
           "none\nend\nsubsection Mesh\n set Generator = gmsh\n set Size = "
           "0.25\nend\nsubsection Joints\n set Names = seam\n subsection "
           "seam\n set Point = 0.5, 1\n set Dip = "
        << dip << "\n"
        << strength
        << " end\nend\nsubsection Materials\n set Names = rock\n subsection "
           "rock\n set Young modulus = 1e9\n set Poisson ratio = 0.25\n end\n"
           "end\nsubsection Supports\n set Names = bottom, pin\n subsection "
           "bottom\n set Boundaries = bottom\n set Directions = y\n end\n "
           "subsection pin\n set Region = 1e-9 - x - y\n end\nend\n"
           "subsection Tractions\n set Names = top\n subsection top\n set "
           "Boundaries = top\n set Traction = 0; -1e6*0.5*(1 - cos(pi*min(1, "
           "t/0.3)))\n end\nend\n"
           "subsection Stages\n set Names = load\n subsection load\n set "
           "Maximum steps = 100000\n set Local damping = 0.8\n set Unbalanced "
           "ratio = 1e-13\n end\nend\nsubsection Output\n set Write VTU = "
           "false\n set History interval = 50\nend\n";
    MPI_Barrier(world);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    simulation.run();
    const std::array<double, 4> exact = {{0., -1e6, -0.25e6, 0.}};
    double largest                    = 0.;
    const auto &cells                 = simulation.state().cells;
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (unsigned int i = 0; i < 16; ++i)
        largest =
          std::max(largest,
                   std::abs(cells.stress_at(c, i / 4)[i % 4] - exact[i % 4]));
    return world.max(largest) / 1e6;
  }

  /** Largest deviation of any stress from @p exact along z and none elsewhere,
   * over that, in a box of Gmsh's cells whose top is pushed down. */
  double
  deviation_in_box(const double exact,
                   const std::string &joints,
                   const std::string &stage)
  {
    const std::string name = "patch_in_3d_" + std::to_string(world.size());
    if (world.is_root())
      std::ofstream(name + ".prm")
        << "set Dimension = 3\nsubsection Domain\n set Corner = 0, 0, -1\n set "
           "Size = 1.6, 1.5, 2\n set Truncated boundaries = none\nend\n"
           "subsection Mesh\n set Generator = gmsh\n set Size = 0.8\nend\n"
           "subsection Materials\n set Names = rock\n subsection rock\n set "
           "Young modulus = 1e9\n set Poisson ratio = 0\n end\nend\n"
           "subsection Supports\n set Names = bottom, sides\n subsection "
           "bottom\n set Boundaries = bottom\n set Directions = z\n end\n "
           "subsection sides\n set Boundaries = left, front\n set Directions = "
           "normal\n end\nend\nsubsection Tractions\n set Names = top\n "
           "subsection top\n set Boundaries = top\n set Traction = 0; 0; "
        << exact << "\n set Stage = load\n end\nend\n"
        << joints << "subsection Stages\n set Names = load\n subsection load\n"
        << stage
        << " end\nend\nsubsection Output\n set Write VTU = false\n set History "
           "interval = 50\nend\n";
    MPI_Barrier(world);
    Simulation<3> simulation(world, name + ".prm", {}, name);
    simulation.run();
    double largest    = 0.;
    const auto &cells = simulation.state().cells;
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (unsigned int q = 0; q < 8; ++q)
        for (unsigned int i = 0; i < 6; ++i)
          largest = std::max(largest,
                             std::abs(cells.stress_at(c, q)[i] -
                                      (i == 2 ? exact : 0.)));
    return world.max(largest) / std::abs(exact);
  }

  /** Largest and root-mean-square deviation of the vertical stress from -1 MPa,
   * relative, in two squares one above the other, @p n_below and @p n_above
   * cells wide. */
  std::array<double, 2>
  deviation_across_unlike_meshes(const unsigned int n_below,
                                 const unsigned int n_above)
  {
    const std::string name = "unlike_" + std::to_string(world.size());
    if (world.is_root())
      {
        std::ostringstream vertices, cells;
        unsigned int n_vertices = 0, n_cells = 0;
        for (const unsigned int part : {0, 1})
          {
            const unsigned int n = part == 0 ? n_below : n_above;
            for (unsigned int j = 0; j <= n; ++j)
              for (unsigned int i = 0; i <= n; ++i)
                vertices << n_vertices + 1 + j * (n + 1) + i << ' '
                         << double(i) / n << ' ' << part + double(j) / n
                         << " 0\n";
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int i = 0; i < n; ++i)
                {
                  const unsigned int v = n_vertices + 1 + j * (n + 1) + i;
                  cells << ++n_cells << " 0 quad " << v << ' ' << v + 1 << ' '
                        << v + n + 2 << ' ' << v + n + 1 << '\n';
                }
            n_vertices += (n + 1) * (n + 1);
          }
        std::ofstream(name + ".ucd")
          << n_vertices << ' ' << n_cells << " 0 0 0\n"
          << vertices.str() << cells.str();
        std::ofstream(name + ".prm")
          << "subsection Domain\n set Shape = file\n set File = " << name
          << ".ucd\n set Truncated boundaries = none\nend\n"
             "subsection Mesh\n set Generator = file\nend\nsubsection "
             "Contact\n set Default friction angle = "
             "60\nend\nsubsection Materials\n set Names = rock\n subsection "
             "rock\n set Young modulus = 1e9\n set Poisson ratio = 0\n "
             "end\nend\nsubsection Supports\n set Names = bottom\n "
             "subsection bottom\n set Region = 1e-9 - y\n end\nend\n"
             "subsection Tractions\n set Names = top\n subsection top\n set "
             "Region = y - 2 + 1e-9\n set Traction = 0; -1e6*0.5*(1 - "
             "cos(pi*min(1, t/0.3)))\n end\nend\nsubsection Stages\n set "
             "Names = load\n subsection load\n set Maximum steps = 100000\n "
             "set Local damping = 0.8\n set Unbalanced ratio = 1e-10\n "
             "end\nend\nsubsection Output\n set Write VTU = false\n set "
             "History interval = 50\nend\n";
      }
    MPI_Barrier(world);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    simulation.run();
    const auto &cells = simulation.state().cells;
    double largest = 0., square = 0., n_points = 0.;
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (unsigned int q = 0; q < 4; ++q)
        {
          const double error = std::abs(cells.stress_at(c, q)[1] + 1e6) / 1e6;
          largest            = std::max(largest, error);
          square += error * error;
          n_points += 1.;
        }
    square   = world.sum(square);
    n_points = world.sum(n_points);
    return {{world.max(largest), std::sqrt(square / n_points)}};
  }
} // namespace

BOOST_AUTO_TEST_CASE(inclined_joint_transmits_uniform_stress)
{
  for (const double dip : {15., 30., 37., 45.})
    {
      const double bonded =
        deviation(dip,
                  " set Friction angle = 10\n set Cohesion = 1e7\n set "
                  "Tensile strength = 1e7\n");
      const double pressed = deviation(dip, " set Friction angle = 60\n");
      BOOST_TEST_MESSAGE("dip " << dip << ": bonded " << bonded << ", pressed "
                                << pressed);
      BOOST_TEST(bonded <= 1e-10);
      BOOST_TEST(pressed <= 1e-10);
    }
}

// Quadrilaterals of Gmsh have nodal areas that are not alike: equal shares of a
// traction, or of the water in a joint, gave stresses that are 12 % wrong.
BOOST_AUTO_TEST_CASE(unstructured_box_transmits_uniform_stress)
{
  BOOST_TEST(deviation_in_box(-1e6, "", " set Kind = static\n") <= 1e-10);
  // water in the joint bears nine tenths of the load; friction would lock in
  // what the ramp does on the way
  const double above_water = deviation_in_box(
    -4e4,
    "subsection Joints\n set Names = level\n subsection level\n set Point = 0, "
    "0, 0\n set Friction angle = 0\n set Water pressure = 36000\n end\nend\n",
    " set Kind = quasi-static\n set Maximum steps = 100000\n set Unbalanced "
    "ratio = 1e-12\n");
  BOOST_TEST_MESSAGE("above water: " << above_water);
  BOOST_TEST(above_water <= 1e-9);
}

// Node-to-segment contact cannot pass this test exactly: its nodal areas are
// wrong by a share that does not depend on the cell size, in the cells at the
// interface, so that the largest error stays and the mean square one falls.
BOOST_AUTO_TEST_CASE(unlike_meshes_transmit_stress_approximately)
{
  double before = 1.;
  for (const unsigned int n : {2, 4, 8})
    {
      const auto error = deviation_across_unlike_meshes(n, 3 * n / 2);
      BOOST_TEST_MESSAGE(3 * n / 2 << " cells on " << n << ": largest "
                                   << error[0] << ", mean square " << error[1]);
      BOOST_TEST(error[0] < 0.07);
      BOOST_TEST(error[1] < 0.8 * before);
      before = error[1];
    }
}

BOOST_AUTO_TEST_SUITE_END()

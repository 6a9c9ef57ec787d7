// SPDX-License-Identifier: LGPL-2.1-or-later
// A column with an inclined joint under a uniform pressure: the stress must be
// uniform to round-off, whether the joint is bonded or only pressed.
#include <boost/test/unit_test.hpp>

#include <keyblock/mpi.h>
#include <keyblock/simulation.h>

#include <cmath>
#include <fstream>

using namespace Keyblock;

namespace
{
  /** Largest deviation of any stress from (0, -1 MPa, -nu MPa, 0), relative. */
  double
  deviation(const double dip, const std::string &strength)
  {
    const std::string name = "patch_" + std::to_string(n_ranks());
    if (is_root())
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
    MPI_Barrier(world());
    Simulation<2> simulation(name + ".prm", {}, name);
    simulation.run();
    const std::array<double, 4> exact = {{0., -1e6, -0.25e6, 0.}};
    double largest                    = 0.;
    const auto &cells                 = simulation.cell_arrays();
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (unsigned int i = 0; i < 16; ++i)
        largest =
          std::max(largest, std::abs(cells.stress_of(c)[i] - exact[i % 4]));
    return dealii::Utilities::MPI::max(largest, world()) / 1e6;
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

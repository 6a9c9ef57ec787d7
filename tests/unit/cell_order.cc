// SPDX-License-Identifier: LGPL-2.1-or-later
// The order of the loop over cells: all of them once, and of a structured box
// its rows one after the other.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/mesh/cell_order.h>
#include <keyblock/run/simulation.h>

#include <fstream>

BOOST_AUTO_TEST_SUITE(cell_order)

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(sweep_order_of_box)
{
  const std::string name = "cell_order_" + std::to_string(world.size());
  if (world.is_root())
    std::ofstream(name + ".prm")
      << "set Dimension = 2\nsubsection Domain\n set Size = 5, 8\nend\n"
         "subsection Mesh\n set Cells = 5, 8\nend\nsubsection Materials\n "
         "set Names = rock\nend\nsubsection Stages\n set Names = none\n "
         "subsection none\n  set Maximum steps = 1\n end\nend\n";
  MPI_Barrier(world);
  Simulation<2> simulation(world, name + ".prm", {}, name);
  simulation.validate();
  const Mesh<2> &mesh = simulation.state().split.mesh;

  const auto order = sweep_order<2>(mesh, 0, mesh.n_cells());
  BOOST_REQUIRE(order.size() == 40u);
  for (unsigned int i = 0; i < 40; ++i)
    {
      const Point<2> center = mesh.cell_center(order[i]);
      BOOST_TEST(std::abs(center[0] - (i % 5 + 0.5)) < 1e-12);
      BOOST_TEST(std::abs(center[1] - (i / 5 + 0.5)) < 1e-12);
    }

  auto part = sweep_order<2>(mesh, 7, 30);
  std::sort(part.begin(), part.end());
  BOOST_REQUIRE(part.size() == 23u);
  for (unsigned int i = 0; i < part.size(); ++i)
    BOOST_TEST(part[i] == 7 + i);
  BOOST_TEST(sweep_order<2>(mesh, 7, 7).empty());
}

BOOST_AUTO_TEST_SUITE_END()

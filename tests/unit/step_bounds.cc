// SPDX-License-Identifier: LGPL-2.1-or-later
// The bound of the time step is below the limit of the mesh in every scene of
// prm/verification (by --run_test=step_bounds/bounds_of_all_scenes: minutes).
#include "mesh_frequency.h"

#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <iostream>

BOOST_AUTO_TEST_SUITE(step_bounds)

using namespace Keyblock;

namespace
{
  template <int dim>
  void
  check_scene(const std::string &file, const std::string &name)
  {
    Simulation<dim> simulation(world, file, {}, "bounds");
    std::cout.setstate(std::ios::failbit);
    simulation.validate();
    std::cout.clear();
    if (simulation.state().cells.nodes.empty())
      return;
    const double bound = simulation.state().stable_step();
    const double limit = 2. / highest_frequency_of_mesh(simulation, 1000);
    BOOST_TEST_MESSAGE(name << ": bound over limit " << bound / limit);
    BOOST_TEST(bound <= limit * (1. + 1e-9), name);
  }
} // namespace

BOOST_AUTO_TEST_CASE(bounds_of_all_scenes, *boost::unit_test::disabled())
{
  std::vector<std::filesystem::path> files;
  for (const auto &entry :
       std::filesystem::directory_iterator(KEYBLOCK_VERIFICATION_SCENES))
    if (entry.path().extension() == ".prm")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  BOOST_TEST(files.size() > 50);
  for (const auto &file : files)
    if (read_dimension(world, file.string(), {}) == 2)
      check_scene<2>(file.string(), file.stem().string());
    else
      check_scene<3>(file.string(), file.stem().string());
}

BOOST_AUTO_TEST_SUITE_END()

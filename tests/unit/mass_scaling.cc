// SPDX-License-Identifier: LGPL-2.1-or-later
// Inertia moved to stiff cells: shares in closed form, and a bar with thin
// cells that falls, vibrates and keeps its energy.
#include "mesh_frequency.h"

#include <keyblock/rock/mass_scaling.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <numeric>
#include <sstream>

BOOST_AUTO_TEST_SUITE(mass_scaling)

using namespace Keyblock;

namespace
{
  const double young = 1e9, density = 2500., gravity = 9.81;
  const double wave_speed = std::sqrt(young / density);

  /** Length of a bar of unit cells but two, which are thin [m]. */
  constexpr unsigned int n_along   = 120;
  constexpr double width_of_thin   = 0.4;
  constexpr double length          = n_along - 2. * (1. - width_of_thin);
  constexpr double own_step_factor = 0.9; ///< wanted over that of unit cells

  /** The step that is asked for: unit squares without lateral strain have h /
   * c_p. */
  const double wanted_step = own_step_factor / wave_speed;

  void
  write_mesh(const std::string &file_name)
  {
    std::ofstream out(file_name);
    out << std::setprecision(17) << 2 * (n_along + 1) << ' ' << n_along
        << " 0 0 0\n";
    double x = 0.;
    for (unsigned int i = 0; i <= n_along; ++i)
      {
        out << 2 * i + 1 << ' ' << x << " 0 0\n"
            << 2 * i + 2 << ' ' << x << " 1 0\n";
        x += i == 30 || i == 77 ? width_of_thin : 1.;
      }
    for (unsigned int i = 0; i < n_along; ++i)
      out << i + 1 << " 0 quad " << 2 * i + 1 << ' ' << 2 * i + 3 << ' '
          << 2 * i + 4 << ' ' << 2 * i + 2 << '\n';
  }

  /** A free bar; @p motion: entries of its initial state. */
  std::string
  write_bar(const std::string &motion,
            const double least_step,
            const double largest_added,
            const double duration)
  {
    const std::string name = "mass_scaling_" + std::to_string(world.size());
    if (world.is_root())
      {
        write_mesh(name + ".ucd");
        std::ofstream(name + ".prm")
          << std::setprecision(17)
          << "subsection Domain\n set Shape = file\n set File = " << name
          << ".ucd\n set Truncated boundaries = none\nend\nsubsection Mesh\n "
             "set Generator = file\nend\nsubsection Materials\n set Names = "
             "rock\n subsection rock\n set Young modulus = "
          << young << "\n set Poisson ratio = 0\n set Density = " << density
          << "\n end\nend\nsubsection Initial state\n"
          << motion
          << "end\nsubsection Time stepping\n set Least step = " << least_step
          << "\n set Largest added mass = " << largest_added
          << "\nend\nsubsection Stages\n set Names = move\n subsection move\n "
             "set Duration = "
          << duration
          << "\n end\nend\nsubsection Monitors\n set Names = end\n subsection "
             "end\n set Location = 0, 0\n end\nend\nsubsection Output\n set "
             "Write VTU = false\nend\n";
      }
    MPI_Barrier(world);
    return name;
  }

  /** Added mass over true mass, and momentum over true mass [m/s] upwards. */
  std::array<double, 2>
  mass_and_velocity(const Simulation<2> &simulation)
  {
    const Fields<2> &fields = simulation.state().fields;
    std::vector<double> sums(3, 0.);
    for (unsigned int i = 0; i < simulation.state().numbering->n_owned(); ++i)
      {
        sums[0] += fields.weighing_mass[i];
        sums[1] += fields.mass[i] - fields.weighing_mass[i];
        sums[2] += fields.mass[i] * fields.velocity[2 * i + 1];
      }
    world.sum_lists(sums);
    return {{sums[1] / sums[0], sums[2] / sums[0]}};
  }

  /** Half a period of the longest wave along the free bar [s]. */
  double
  half_period(const double least_step, double &residual, double &steps)
  {
    const double k = dealii::numbers::PI / length;
    std::ostringstream motion;
    motion << std::setprecision(17) << " set Velocity = cos(" << k
           << "*x); 0\n";
    const std::string name =
      write_bar(motion.str(), least_step, 0.05, 1.2 * length / wave_speed);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    simulation.run();
    if (!world.is_root())
      return 0.;
    const History &history            = simulation.measured();
    const std::vector<double> time    = history.column("time");
    const std::vector<double> u       = history.column("end.u_x");
    const std::vector<double> residua = history.column("energy.residual");
    const std::vector<double> kinetic = history.column("energy.kinetic");
    residual                          = 0.;
    for (const double value : residua)
      residual = std::max(residual, std::abs(value) / kinetic.front());
    steps = time.size();
    // back where it began, between two samples
    unsigned int n = 2;
    while (n < u.size() && u[n] > 0.)
      ++n;
    BOOST_REQUIRE(n < u.size());
    return time[n] - (time[n] - time[n - 1]) * u[n] / (u[n] - u[n - 1]);
  }
} // namespace

BOOST_AUTO_TEST_CASE(shares_of_mass)
{
  // three blocks: one stiff cell of 0.1 kg in 9.1 kg; none; too many of them
  const std::vector<double> all_frequencies  = {1., 2., 1.4, 3., 1., 3.},
                            all_masses       = {8., 0.1, 1., 1., 5., 4.};
  const std::vector<unsigned int> all_blocks = {0, 0, 1, 2, 2, 2};
  std::vector<double> frequency, mass;
  std::vector<unsigned int> block;
  for (unsigned int c = 0; c < all_blocks.size(); ++c)
    if (c % world.size() == world.rank())
      {
        frequency.push_back(all_frequencies[c]);
        mass.push_back(all_masses[c]);
        block.push_back(all_blocks[c]);
      }
  const auto found = scale_masses(world, frequency, mass, block, 3, 1.5, 0.1);
  BOOST_REQUIRE(found.size() == 3u);
  const double factor = 4. / 2.25, added = 0.1 * (factor - 1.);
  BOOST_TEST(found[0].square == 2.25);
  BOOST_TEST(std::abs(found[0].factor(2.) - factor) < 1e-14);
  BOOST_TEST(std::abs(found[0].factor(1.) - (1. - added / 8.)) < 1e-14);
  BOOST_TEST(std::abs(found[0].added - added) < 1e-14);
  BOOST_TEST(std::abs(found[0].added_fraction() - added / 8.1) < 1e-14);
  BOOST_TEST(found[0].n_cells == 1u);
  BOOST_TEST(!found[0].is_at_bound);
  BOOST_TEST(std::abs(found[0].scaled(2.) - 1.5) < 1e-14);
  BOOST_TEST(found[1].factor(1.4) == 1.);
  BOOST_TEST(found[1].n_cells == 0u);
  // 5 kg at 9 / y, with 5 kg at 0.9: 10 kg
  BOOST_TEST(found[2].is_at_bound);
  BOOST_TEST(std::abs(found[2].square - 9. / 1.1) < 1e-13);
  BOOST_TEST(std::abs(found[2].factor(1.) - 0.9) < 1e-13);
  BOOST_TEST(std::abs(found[2].factor(3.) - 1.1) < 1e-13);
  BOOST_TEST(std::abs(found[2].added_fraction() - 0.05) < 1e-13);

  Blocks<2> blocks;
  blocks.blocks.resize(2);
  blocks.blocks[0].id    = 7;
  blocks.blocks[1].id    = 8;
  const std::string text = describe_mass_scaling(found, blocks, 2. / 1.5);
  BOOST_TEST(text.find("block 7: 0.96 % to 1 cells") != std::string::npos);
  BOOST_TEST(text.find("block 8") == std::string::npos);
  const auto warnings = warnings_of_mass_scaling(found, blocks, 2. / 1.5);
  BOOST_REQUIRE(warnings.size() == 1u);
  BOOST_TEST(warnings[0].find(
               "The stable step of rock that is excavated later is 0.699 s") ==
             0u);
  BOOST_TEST(describe_mass_scaling({found[1]}, blocks, 1.).empty());
}

BOOST_AUTO_TEST_CASE(bar_with_thin_cells_falls_freely)
{
  const double duration = 0.02;
  std::ostringstream motion;
  motion << " set Gravity = 0; " << -gravity << '\n';
  double step_before = 0.;
  for (const bool is_scaled : {false, true})
    {
      const std::string name =
        write_bar(motion.str(), is_scaled ? wanted_step : 0., 0.05, duration);
      Simulation<2> simulation(world, name + ".prm", {}, name);
      simulation.run();
      const auto [added, velocity] = mass_and_velocity(simulation);
      BOOST_TEST(std::abs(added) < 1e-14);
      // the first row is the state before the first step
      std::vector<double> n(
        1, world.is_root() ? simulation.measured().rows.size() - 1. : 0.);
      world.broadcast(n);
      // at the last half step
      const double expected = -gravity * duration * (1. - 0.5 / n[0]);
      BOOST_TEST(std::abs(velocity / expected - 1.) < 1e-12);
      BOOST_TEST(simulation.state().stable_step() <=
                 2. / highest_frequency_of_mesh(simulation, 2000));
      if (!is_scaled)
        step_before = simulation.state().stable_step();
      else
        BOOST_TEST(std::abs(simulation.state().stable_step() / wanted_step -
                            1.) < 1e-14);
    }
  BOOST_TEST(step_before < 0.5 * wanted_step);
}

BOOST_AUTO_TEST_CASE(added_mass_within_its_bound)
{
  const std::string name = write_bar("", wanted_step, 0.01, 0.01);
  Simulation<2> simulation(world, name + ".prm", {}, name);
  simulation.run();
  const MassScaling &block =
    simulation.state().conditions->active_cells.mass_scaling.front();
  BOOST_TEST_MESSAGE("added " << block.added_fraction() << ", step "
                              << simulation.state().stable_step() / wanted_step
                              << " of the wanted one");
  BOOST_TEST(block.is_at_bound);
  BOOST_TEST(block.n_cells == 2u);
  BOOST_TEST(block.added_fraction() <= 0.01);
  BOOST_TEST(block.added_fraction() > 0.009);
  BOOST_TEST(simulation.state().stable_step() < 0.9 * wanted_step);
  BOOST_TEST(simulation.state().stable_step() > 0.5 * wanted_step);
  BOOST_TEST(std::abs(mass_and_velocity(simulation)[0]) < 1e-14);
}

BOOST_AUTO_TEST_CASE(wave_in_a_bar_with_thin_cells)
{
  double residual = 0., scaled_residual = 0., steps = 0., scaled_steps = 0.;
  const double own    = half_period(0., residual, steps);
  const double scaled = half_period(wanted_step, scaled_residual, scaled_steps);
  if (!world.is_root())
    return;
  const double exact = length / wave_speed;
  BOOST_TEST_MESSAGE("half period over the closed form: "
                     << own / exact - 1. << " in " << steps << " steps, scaled "
                     << scaled / exact - 1. << " in " << scaled_steps
                     << "; energy residual " << residual << ", "
                     << scaled_residual);
  BOOST_TEST(std::abs(own / exact - 1.) < 1e-3);
  BOOST_TEST(std::abs(scaled / exact - 1.) < 1e-3);
  BOOST_TEST(scaled_steps < 0.5 * steps);
  BOOST_TEST(scaled_residual < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()

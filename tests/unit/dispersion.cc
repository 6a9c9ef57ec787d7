// SPDX-License-Identifier: LGPL-2.1-or-later
// Wave speed of the explicit step: the frequencies of standing waves against
// the dispersion of square cells with lumped masses.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/run/simulation.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>

BOOST_AUTO_TEST_SUITE(dispersion)

using namespace Keyblock;

namespace
{
  const double young = 1e9, density = 2500.;

  /** Standing wave in a box of unit cells on rollers, displacement
   * (sin(kx x) cos(ky y), +-cos(kx x) sin(ky y)): a P wave with +, for kx = ky
   * an S wave with -. */
  struct Mode
  {
    unsigned int n_cells_x, n_cells_y;
    unsigned int half_waves_x, half_waves_y;
    double poisson, courant; ///< courant = c_p dt / h
    bool is_shear;

    double
    wave_number_x() const
    {
      return dealii::numbers::PI * half_waves_x / n_cells_x;
    }
    double
    wave_number_y() const
    {
      return dealii::numbers::PI * half_waves_y / n_cells_y;
    }
    double
    wave_number() const
    {
      return std::hypot(wave_number_x(), wave_number_y());
    }
    double
    lame_lambda() const
    {
      return young * poisson / (1. + poisson) / (1. - 2. * poisson);
    }
    double
    shear_modulus() const
    {
      return 0.5 * young / (1. + poisson);
    }
    double
    pressure_speed() const
    {
      return std::sqrt((lame_lambda() + 2. * shear_modulus()) / density);
    }
    double
    speed() const
    {
      return is_shear ? std::sqrt(shear_modulus() / density) : pressure_speed();
    }
  };

  /** What a history tells of a mode; deviation: of the history from one
   * frequency, relative to its largest value. */
  struct Measurement
  {
    double time_step = 0., frequency = 0., phase_error = 0., deviation = 0.;
  };

  const std::string rollers =
    "subsection Supports\n set Names = sides, ends\n subsection sides\n set "
    "Boundaries = left, right\n set Directions = x\n end\n subsection ends\n "
    "set Boundaries = bottom, top\n set Directions = y\n end\nend\nsubsection "
    "Output\n set Write VTU = false\nend\n";

  std::string
  write_box(const Mode &mode, const unsigned int n_steps)
  {
    const std::string name = "dispersion_" + std::to_string(world.size());
    const double kx = mode.wave_number_x(), ky = mode.wave_number_y();
    if (world.is_root())
      std::ofstream(name + ".prm")
        << std::setprecision(17) << rollers
        << "subsection Domain\n set Truncated boundaries = none\n set Size = "
        << mode.n_cells_x << ", " << mode.n_cells_y
        << "\nend\nsubsection Mesh\n set Cells = " << mode.n_cells_x << ", "
        << mode.n_cells_y
        << "\nend\nsubsection Materials\n set Names = rock\n subsection "
           "rock\n set Integration = full\n set Young modulus = "
        << young << "\n set Poisson ratio = " << mode.poisson
        << "\n set Density = " << density
        << "\n end\nend\nsubsection Initial state\n set Velocity = 1e-3*sin("
        << kx << "*x)*cos(" << ky << "*y); "
        << (mode.is_shear ? "-1e-3*cos(" : "1e-3*cos(") << kx << "*x)*sin("
        << ky
        << "*y)\nend\nsubsection Time stepping\n set Safety = 1\n set Maximum "
           "step = "
        << mode.courant / mode.pressure_speed()
        << "\nend\nsubsection Stages\n set Names = ring\n subsection ring\n "
           "set Maximum steps = "
        << n_steps
        << "\n end\nend\nsubsection Monitors\n set Names = crest\n subsection "
           "crest\n set Location = "
        << std::round(0.5 * dealii::numbers::PI / kx) << ", 0\n end\nend\n";
    MPI_Barrier(world);
    return name;
  }

  /** Fit u(n + 1) + u(n - 1) = 2 cos(w dt) u(n) to a history. */
  Measurement
  fit_frequency(const Mode &mode, const History &history)
  {
    const std::vector<double> time = history.column("time");
    const std::vector<double> u    = history.column("crest.u_x");
    double products = 0., squares = 0., largest = 0.;
    for (unsigned int n = 1; n + 1 < u.size(); ++n)
      {
        products += u[n] * (u[n + 1] + u[n - 1]);
        squares += u[n] * u[n];
        largest = std::max(largest, std::abs(u[n]));
      }
    const double cosine = 0.5 * products / squares;
    Measurement result;
    result.time_step   = (time.back() - time.front()) / (time.size() - 1);
    result.frequency   = std::acos(cosine) / result.time_step;
    result.phase_error = result.frequency / mode.wave_number() / mode.speed();
    result.phase_error -= 1.;
    for (unsigned int n = 1; n + 1 < u.size(); ++n)
      result.deviation =
        std::max(result.deviation,
                 std::abs(u[n + 1] + u[n - 1] - 2. * cosine * u[n]) / largest);
    return result;
  }

  /** Frequency w of the explicit step on unit cells with full integration and
   * lumped masses: sin(w dt / 2) = w0 dt / 2, where w0 is that in continuous
   * time. */
  double
  discrete_frequency(const Mode &mode, const double time_step)
  {
    const double lambda = mode.lame_lambda(), mu = mode.shear_modulus();
    const double x = mode.wave_number_x(), y = mode.wave_number_y();
    const double stiffness_x = 2. * (1. - std::cos(x)) * (2. + std::cos(y)) / 3;
    const double stiffness_y = 2. * (1. - std::cos(y)) * (2. + std::cos(x)) / 3;
    const double coupling =
      (lambda + mu) * std::sin(x) * std::sin(y) * (mode.is_shear ? -1. : 1.);
    const double square =
      ((lambda + 2. * mu) * stiffness_x + mu * stiffness_y + coupling) /
      density;
    return 2. / time_step * std::asin(0.5 * time_step * std::sqrt(square));
  }

  /** Run @p mode and compare its phase error with @p percent. */
  void
  check_mode(const Mode &mode, const double percent)
  {
    const std::string name = write_box(mode, 60);
    Simulation<2> simulation(world, name + ".prm", {}, name);
    simulation.run();
    const double c_p   = mode.pressure_speed();
    const double bound = simulation.state().stable_step() * c_p;
    BOOST_TEST(std::abs(bound - std::sqrt(1. - mode.poisson)) < 1e-4);
    if (!world.is_root())
      return;
    const Measurement found = fit_frequency(mode, simulation.measured());
    const double courant    = found.time_step * c_p;
    const double difference =
      found.frequency / discrete_frequency(mode, found.time_step) - 1.;
    BOOST_TEST_MESSAGE(
      (mode.is_shear ? "S" : "P")
      << " wave, " << 2. * dealii::numbers::PI / mode.wave_number()
      << " cells per wavelength, c_p dt / h " << courant << ": phase error "
      << 100. * found.phase_error << " %, expected " << percent
      << " %; from the closed form " << difference << ", from one frequency "
      << found.deviation << "; bound " << bound << " of h / c_p");
    BOOST_TEST(std::abs(courant - mode.courant) < 1e-4);
    BOOST_TEST(std::abs(100. * found.phase_error - percent) < 0.005);
    BOOST_TEST(std::abs(difference) < 1e-10);
    BOOST_TEST(found.deviation < 1e-10);
  }
} // namespace

BOOST_AUTO_TEST_CASE(phase_error_along_a_bar)
{
  check_mode({5, 1, 2, 0, 0., 0.8, false}, -2.607);
  check_mode({8, 1, 2, 0, 0., 0.8, false}, -0.960);
  check_mode({10, 1, 2, 0, 0., 0.8, false}, -0.606);
  check_mode({15, 1, 2, 0, 0., 0.8, false}, -0.266);
  check_mode({20, 1, 2, 0, 0., 0.8, false}, -0.149);
  check_mode({10, 1, 2, 0, 0., 1., false}, 0.);
}

BOOST_AUTO_TEST_CASE(phase_error_at_45_degrees)
{
  // 14 half waves on 99 cells: 10.0005 cells per wavelength
  check_mode({99, 99, 14, 14, 0.25, 0.8, false}, -1.71);
  check_mode({99, 99, 14, 14, 0.25, 0.8, true}, -1.29);
}

BOOST_AUTO_TEST_SUITE_END()

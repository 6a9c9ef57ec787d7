// SPDX-License-Identifier: LGPL-2.1-or-later
// The bound of the time step is below the limit of the mesh in every scene of
// prm/verification (by --run_test=bounds_of_all_scenes: minutes).
#include <keyblock/internal_force.h>
#include <keyblock/mpi.h>
#include <keyblock/simulation.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>

using namespace Keyblock;

namespace
{
  /** Estimate of the highest frequency of the mesh without supports, which is
   * at least that with them: power iteration on M^-1 K, from below [rad/s]. */
  template <int dim>
  double
  highest_frequency_of_mesh(const Simulation<dim> &simulation)
  {
    CellArrays<dim> cells        = simulation.cell_arrays();
    const Fields<dim> &fields    = simulation.nodal_fields();
    const Numbering<dim> &number = simulation.node_numbering();
    for (MohrCoulomb &strength : cells.strengths)
      strength.peak.uniaxial       = strength.peak.tension =
        strength.residual.uniaxial = strength.residual.tension = 1e100;
    std::vector<double> x(fields.velocity.size()), y(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = std::sin(3. + 11. * number.vertex_of_node[i / dim] + i % dim);
    number.interpolate_hanging(x);
    double eigenvalue = 0.;
    for (unsigned int iteration = 0; iteration < 1000; ++iteration)
      {
        cells.stress.reinit(cells.nodes.size());
        std::fill(y.begin(), y.end(), 0.);
        ForcePass pass;
        pass.step = 1.;
        add_internal_force<dim>(
          pass, cells, fields.reference.data(), x.data(), y.data(), nullptr);
        number.add_hanging_to_masters(y);
        double xy = 0., xx = 0.;
        for (unsigned int i = 0; i < x.size(); ++i)
          {
            const double mass = fields.weighing_mass[i / dim];
            y[i]              = mass > 0. ? y[i] / mass : 0.;
            xy += x[i] * y[i] * mass;
            xx += x[i] * x[i] * mass;
          }
        eigenvalue = xy / xx;
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] = y[i] / eigenvalue;
        number.interpolate_hanging(x);
      }
    return std::sqrt(eigenvalue);
  }

  template <int dim>
  void
  check_scene(const std::string &file, const std::string &name)
  {
    Simulation<dim> simulation(file, {}, "bounds");
    std::cout.setstate(std::ios::failbit);
    simulation.validate();
    std::cout.clear();
    if (simulation.cell_arrays().nodes.empty())
      return;
    const double bound = simulation.stable_step();
    const double limit = 2. / highest_frequency_of_mesh(simulation);
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
    if (read_dimension(file.string(), {}) == 2)
      check_scene<2>(file.string(), file.stem().string());
    else
      check_scene<3>(file.string(), file.stem().string());
}

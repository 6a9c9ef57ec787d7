// SPDX-License-Identifier: LGPL-2.1-or-later
// Structural liners on rock: energy and momentum stay, they are free of force
// where they are installed and on the shape of that moment, and only shorten
// the step where they have to; what sections bear against their strength.
#include "plate.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(structural_liner)

using namespace Keyblock;

namespace
{
  /** A plate with a slot in its lower side that is dug and lined, and moves. */
  std::string
  slot(const std::string &liner)
  {
    return "subsection Excavations\n set Names = slot\n subsection slot\n  set "
           "Vertices = 0.5, 0; 1.5, 0; 1.5, 0.5; 0.5, 0.5\n  set Stage = "
           "rest\n "
           "end\nend\nsubsection Shotcrete\n set Names = shell\n subsection "
           "shell\n  set Stage = rest\n  set Excavations = slot\n  set "
           "Thickness "
           "= 0.1\n  set Poisson ratio = 0.2\n" +
           liner +
           " end\nend\nsubsection Initial state\n set Velocity = 1 + y; "
           "x^2\nend\n" +
           one_stage;
  }
} // namespace

BOOST_AUTO_TEST_CASE(structural_liner_keeps_energy_and_momentum)
{
  Plate plate(slot("  set Young modulus = 5e9\n"));
  plate.step->keeps_ledger = true;
  plate.step->excavate(2);
  plate.step->begin_stage(Stage(), 2);
  BOOST_TEST(plate.split.liners[0].faces.size() == 4);
  const auto momentum = [&]() {
    std::vector<double> product(plate.fields.velocity);
    for (unsigned int i = 0; i < 2 * plate.numbering->n_owned(); ++i)
      product[i] *= plate.fields.mass[i / 2];
    return plate.sum_of(product);
  };
  const Tensor<1, 2> before = momentum();
  for (unsigned int i = 0; i < 200; ++i)
    plate.step->advance(i == 0 || i % 50 == 49);
  const Energies &energies = plate.step->energies;
  BOOST_TEST(std::abs(energies.residual()) < 1e-11 * energies.start);
  BOOST_TEST((momentum() - before).norm() < 1e-10 * before.norm());
  const auto loads = plate.conditions->report_structural_liners();
  BOOST_TEST(loads.size() == 1);
  double thrust = 0., moment = 0.;
  for (const auto &force : loads[0].forces)
    {
      thrust = std::max(thrust, std::abs(trace(force.thrust)));
      moment = std::max(moment, std::abs(trace(force.moment)));
    }
  BOOST_TEST(thrust > 0.);
  BOOST_TEST(moment > 0.);
}

BOOST_AUTO_TEST_CASE(structural_liner_and_its_state)
{
  Plate plate(slot("  set Young modulus = 5e9\n"));
  StructuralLiners<2> liners(plate.scene,
                             plate.split,
                             *plate.numbering,
                             plate.conditions->active_cells);
  std::vector<double> u(plate.fields.displacement.size());
  const auto force_at = [&](const double time) {
    for (unsigned int i = 0; i < u.size(); ++i)
      {
        const Point<2> x = plate.place_of(i / 2);
        u[i] = (1. + time) * (i % 2 == 0 ? 1e-3 * x[0] * x[0] : 1e-3 * x[0]);
      }
    std::vector<double> force(u.size(), 0.);
    liners.add_force(u, force);
    double sum = 0.;
    for (unsigned int i = 0; i < 2 * plate.numbering->n_owned(); ++i)
      sum += std::abs(force[i]);
    return world.sum(sum);
  };
  // not sprayed yet
  liners.take_ground({plate.scene, plate.split, 1});
  BOOST_TEST(force_at(0.) == 0.);
  liners.take_ground({plate.scene, plate.split, 2});
  BOOST_TEST(force_at(1.) < 1e-6);
  const double force            = force_at(3.);
  const ForceElementState state = liners.remember();
  BOOST_TEST(force > 1e5);
  const double energy = world.sum(liners.stored_energy(u));
  // linear: twice the force, four times the energy
  BOOST_TEST(std::abs(force_at(5.) / force - 2.) < 1e-9);
  BOOST_TEST(std::abs(world.sum(liners.stored_energy(u)) / energy - 4.) < 1e-9);
  // another one goes on from the state, from the same reference
  StructuralLiners<2> other(plate.scene,
                            plate.split,
                            *plate.numbering,
                            plate.conditions->active_cells);
  other.recall(state);
  other.take_ground({plate.scene, plate.split, 2});
  BOOST_TEST(std::abs(world.sum(other.stored_energy(u)) / energy - 1.) < 1e-12);
}

BOOST_AUTO_TEST_CASE(structural_liner_and_the_step)
{
  // beside cells that are as stiff as any: the step is that of the node with
  // the highest sum; a soft one of a tenth changes it by less
  const auto ratio = [](const std::string &modulus) {
    Plate plate(slot("  set Young modulus = " + modulus + "\n"));
    plate.step->excavate(2);
    return plate.conditions->frequency_ratio_of_liners;
  };
  const double stiff = ratio("10e9"), soft = ratio("1e8");
  BOOST_TEST(stiff > 1.2);
  BOOST_TEST(soft >= 1.);
  BOOST_TEST(soft < 1.03);
}

BOOST_AUTO_TEST_CASE(springs_along_traces_and_the_step)
{
  // a joint that crosses the roof of the slot
  const std::string joint = "subsection Joints\n set Names = seam\n subsection "
                            "seam\n  set Point = 1, 0\n  set Dip = 90\n "
                            "end\nend\n";
  const auto ratios = [&](const std::string &shear, const std::string &young) {
    Plate plate(joint +
                slot("  set Shear strength = 1e6\n  set Shear modulus "
                     "= " +
                     shear + "\n  set Young modulus = " + young + "\n"));
    plate.step->excavate(2);
    return std::array<double, 2>{{plate.conditions->frequency_ratio_of_liners,
                                  plate.conditions->frequency_ratio_of_traces}};
  };
  const auto stiff = ratios("1e12", "0"), soft = ratios("1e6", "0"),
             shell = ratios("1e6", "1e11");
  BOOST_TEST(stiff[0] > 2.);
  BOOST_TEST(stiff[1] == stiff[0]);
  BOOST_TEST(soft[0] < 1.01);
  BOOST_TEST(shell[0] > 1.2);
  BOOST_TEST(shell[1] < 1.01);
}

BOOST_AUTO_TEST_CASE(structural_liner_has_mass)
{
  const auto mass_of = [](const Plate &plate) {
    double sum = 0.;
    for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
      sum += plate.fields.mass[node];
    return world.sum(sum);
  };
  for (const std::string modulus : {"10e9", "0"})
    {
      Plate plate(slot("  set Young modulus = " + modulus +
                       "\n  set Shear strength = 1e6\n"));
      const double rock = Plate::density * (2. - 0.5), shell = 2400. * 0.1 * 2.;
      plate.step->excavate(2);
      BOOST_TEST(std::abs(mass_of(plate) / (rock + shell) - 1.) < 1e-12);
      // as heavy as keeps the step that all cells take
      plate.conditions->scale_density(true);
      BOOST_TEST(plate.conditions->stable_step.frequency <
                 (1. + 1e-12) *
                   plate.conditions->active_cells.stable_step.frequency);
      plate.conditions->scale_density(false);
      BOOST_TEST(std::abs(mass_of(plate) / (rock + shell) - 1.) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(section_of_a_liner)
{
  Liner liner;
  liner.thickness            = 0.2;
  liner.compressive_strength = 20e6;
  liner.tensile_strength     = 2e6;
  LinerForce<2> force;
  force.thrust[0][0] = -1e6; // -5 MPa
  force.moment[0][0] = 20e3; // +-3 MPa
  SectionCheck check = check_section(liner, force);
  BOOST_TEST(std::abs(check.factor - 2.5) < 1e-12);
  BOOST_TEST(!check.is_tension);
  force.moment[0][0] = -40e3; // +-6 MPa: 1 MPa of tension, 11 of compression
  check              = check_section(liner, force);
  BOOST_TEST(std::abs(check.factor - 20. / 11.) < 1e-12);
  force.moment[0][0] = 60e3; // 4 of tension, 14 of compression
  check              = check_section(liner, force);
  BOOST_TEST(std::abs(check.factor - 0.5) < 1e-12);
  BOOST_TEST(check.is_tension);
  liner.compressive_strength = liner.tensile_strength = 0.;
  BOOST_TEST(std::isinf(check_section(liner, force).factor));
}

BOOST_AUTO_TEST_SUITE_END()

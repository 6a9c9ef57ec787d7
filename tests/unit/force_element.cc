// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements of other kinds than the far field: dashpots drag, the ledger books
// them, the step is bounded by them; springs hold a body in the static solver
// and in the step.
#include "plate.h"

#include <deal.II/lac/full_matrix.h>

#include <keyblock/step/equilibrium.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(force_element)

using namespace Keyblock;

namespace
{
  /** Springs at nodes to the ground, and dashpots beside them. */
  class Mounts : public ForceElement<2>
  {
  public:
    std::vector<unsigned int> at; ///< owned nodes
    double stiffness = 0.;        ///< [N/m]
    double viscosity = 0.;        ///< [N s/m]
    double n_stages  = 0.;        ///< that it has seen

    std::string
    name() const override
    {
      return "mounts";
    }
    void
    take_ground(const Ground<2> &) override
    {
      ++n_stages;
    }
    std::vector<unsigned int>
    nodes() const override
    {
      return at;
    }
    void
    add_force(const std::vector<double> &displacement,
              std::vector<double> &force) override
    {
      add(stiffness, displacement, force);
    }
    bool
    is_viscous() const override
    {
      return viscosity > 0.;
    }
    void
    add_damping_force(const MotionOfStep<2> &motion,
                      std::vector<double> &force) override
    {
      add(viscosity, motion.fields.velocity, force);
    }
    StepBound
    step_bound(const std::vector<double> &inverse_mass) const override
    {
      double largest = 0.;
      for (const unsigned int node : at)
        largest = std::max(largest, inverse_mass[node]);
      largest = world.max(largest);
      return {largest * stiffness, largest * viscosity};
    }
    double
    stored_energy(const std::vector<double> &displacement) const override
    {
      std::vector<double> force(displacement.size(), 0.);
      add(stiffness, displacement, force);
      double twice = 0.;
      for (unsigned int i = 0; i < force.size(); ++i)
        twice += force[i] * displacement[i];
      return 0.5 * twice;
    }
    void
    for_each_stiffness(const AddStiffness &visit) const override
    {
      dealii::FullMatrix<double> matrix(2, 2);
      matrix(0, 0) = matrix(1, 1) = stiffness;
      for (const unsigned int node : at)
        visit({2 * node, 2 * node + 1}, matrix);
    }
    ForceElementState
    remember() const override
    {
      return {name(), {n_stages}, {}};
    }
    void
    recall(const ForceElementState &state) override
    {
      n_stages = state.numbers.at(0);
    }

  private:
    void
    add(const double factor,
        const std::vector<double> &values,
        std::vector<double> &force) const
    {
      for (const unsigned int node : at)
        for (unsigned int i = 2 * node; i < 2 * node + 2; ++i)
          force[i] += factor * values[i];
    }
  };

  /** Mounts at the nodes with x up to @p extent [m]. */
  Mounts &
  add_mounts(Plate &plate, const double extent)
  {
    auto mounts = std::make_unique<Mounts>();
    for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
      if (plate.place_of(node)[0] < extent + 1e-9)
        mounts->at.push_back(node);
    plate.conditions->elements.push_back(std::move(mounts));
    return static_cast<Mounts &>(*plate.conditions->elements.back());
  }
} // namespace

BOOST_AUTO_TEST_CASE(viscous_element)
{
  Plate plate("subsection Initial state\n set Velocity = 1 + y; x^2\nend\n" +
              one_stage);
  Mounts &dashpots         = add_mounts(plate, 0.);
  dashpots.viscosity       = 2e5;
  plate.step->keeps_ledger = true;
  const double free_step   = plate.conditions->stable_step.limit(Stage());
  plate.step->begin_stage(Stage(), 2);
  BOOST_TEST(plate.step->dt < 0.9 * free_step);
  for (unsigned int i = 0; i < 200; ++i)
    plate.step->advance(i == 0 || i % 50 == 49);
  // as much is lost as the dashpots took, to round-off
  const Energies &energies = plate.step->energies;
  BOOST_TEST(energies.stiffness_damping > 0.1 * energies.start);
  BOOST_TEST(std::abs(energies.residual()) < 1e-12 * energies.start);
}

BOOST_AUTO_TEST_CASE(elastic_element)
{
  Plate plate("subsection Initial state\n set Velocity = 1 + y; x^2\nend\n" +
              one_stage);
  Mounts &springs          = add_mounts(plate, 0.5);
  springs.stiffness        = 1e9;
  plate.step->keeps_ledger = true;
  plate.step->begin_stage(Stage(), 2);
  for (unsigned int i = 0; i < 200; ++i)
    plate.step->advance(i == 0 || i % 50 == 49);
  const Energies &energies = plate.step->energies;
  BOOST_TEST(std::abs(energies.residual()) < 1e-12 * energies.start);
  BOOST_TEST(energies.kinetic < energies.start);
}

// held by springs at its left side alone, which carry all of the load
BOOST_AUTO_TEST_CASE(springs_of_the_static_solver)
{
  Plate plate(one_stage);
  Mounts &springs   = add_mounts(plate, 0.);
  springs.stiffness = 1e6;
  std::vector<double> force(plate.fields.load.size(), 0.);
  for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
    if (plate.place_of(node)[0] > 1.9)
      force[2 * node] = 1e3;
  StaticSolver<2> solver(plate.split,
                         *plate.numbering,
                         plate.cells,
                         plate.fields,
                         plate.fields.supports,
                         plate.conditions->elements);
  const auto u =
    solver.solve(force, [](const NodeSupport<2> &) { return Tensor<1, 2>(); });
  std::vector<double> carried(u.size(), 0.);
  springs.add_force(u, carried);
  const Tensor<1, 2> sum = plate.sum_of(carried);
  BOOST_TEST(std::abs(sum[0] - 3e3) < 1e-6); // three nodes
  BOOST_TEST(std::abs(sum[1]) < 1e-6);
}

BOOST_AUTO_TEST_CASE(state_of_elements)
{
  Plate plate(one_stage);
  Mounts &mounts         = add_mounts(plate, 0.);
  const StageState state = plate.conditions->remember();
  BOOST_TEST(state.elements.size() == 1);
  plate.conditions->excavate(2);
  BOOST_TEST(mounts.n_stages == 1.);
  plate.conditions->recall(state);
  // the ground of the state's stage is handed to the element again
  BOOST_TEST(mounts.n_stages == 1.);
}

BOOST_AUTO_TEST_SUITE_END()

// SPDX-License-Identifier: LGPL-2.1-or-later
// All instruction sets give the same forces and stresses.
#include <keyblock/rock/internal_force.h>

#include <keyblock/rock/cell_geometry.h>
#include <keyblock/rock/cell_kernels.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(cell_kernels)

using namespace Keyblock;

namespace
{
  constexpr unsigned int n_of_kind = 21; // not a multiple of any batch

  template <int dim>
  struct Problem
  {
    CellArrays<dim> cells;
    std::vector<double> position, rate;
  };

  /** Distorted cells that share no order with their nodes, under a stress that
   * some of the plastic ones cannot bear. */
  template <int dim>
  Problem<dim>
  make_problem()
  {
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> random(-1., 1.);
    Problem<dim> problem;
    CellArrays<dim> &cells     = problem.cells;
    const unsigned int n_cells = 3 * n_of_kind;
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        std::array<unsigned int, 1 << dim> nodes;
        for (unsigned int v = 0; v < (1 << dim); ++v)
          {
            nodes[v] = problem.position.size() / dim;
            for (unsigned int d = 0; d < dim; ++d)
              {
                problem.position.push_back(((v >> d) & 1) +
                                           0.2 * random(engine));
                problem.rate.push_back(random(engine));
              }
          }
        // vertices shared with the cell before
        if (c > 0)
          nodes[0] = cells.nodes.back()[1];
        cells.nodes.push_back(nodes);
        cells.mesh_cell.push_back(c);
        cells.lambda.push_back(1e9 * (2. + random(engine)));
        cells.mu.push_back(1e9 * (2. + random(engine)));
        cells.beta.push_back(1e-3 * (2. + random(engine)));
      }
    cells.kind_begin = {{0, n_of_kind, 2 * n_of_kind, n_cells}};
    cells.stress.reinit(n_cells);
    for (unsigned int c = 0; c < n_cells; ++c)
      for (unsigned int q = 0; q < (1 << dim); ++q)
        {
          typename StressArray<dim>::Stress stress;
          for (double &s : stress)
            s = 1e6 * random(engine);
          cells.set_stress(c, q, stress);
        }
    cells.strengths.resize(2);
    cells.strengths[0].peak =
      YieldStrength::from(1e6, 35. * std::acos(-1.) / 180., 0.1, 5e5);
    cells.strengths[1].peak         = YieldStrength::from(2e6, 0.5, 0.5, -1.);
    cells.strengths[1].residual     = YieldStrength::from(1e6, 0.4, 0.2, -1.);
    cells.strengths[1].has_residual = true;
    cells.strengths[1].softening_strain = 1e-3;
    for (unsigned int c = 0; c < n_of_kind; ++c)
      cells.strength.push_back(c % 2);
    cells.plastic_strain.assign(n_of_kind * (1 << dim), 0.);
    return problem;
  }

  template <int dim>
  std::vector<double>
  compute(const std::string &kernels, const bool is_large)
  {
    choose_kernels(kernels);
    Problem<dim> problem = make_problem<dim>();
    std::vector<double> forces(2 * problem.position.size(), 0.);
    ForcePass pass;
    pass.step        = 1e-3;
    pass.is_large    = is_large;
    pass.has_damping = true;
    add_internal_force<dim>(pass,
                            problem.cells,
                            problem.position.data(),
                            problem.rate.data(),
                            forces.data(),
                            forces.data() + problem.position.size());
    choose_kernels("");
    const auto &stress = problem.cells.stress.values;
    forces.insert(forces.end(), stress.begin(), stress.end());
    BOOST_TEST(problem.cells.n_yielding > 0);
    BOOST_TEST(problem.cells.n_yielding < n_of_kind * (1 << dim));
    forces.push_back(problem.cells.plastic_work);
    return forces;
  }

  template <int dim>
  void
  compare_all(const bool is_large)
  {
    const auto expected = compute<dim>("portable", is_large);
    for (const CellKernels &kernels : available_kernels())
      {
        const auto found = compute<dim>(kernels.name, is_large);
        double largest = 0., scale = 0.;
        for (unsigned int i = 0; i < found.size(); ++i)
          {
            largest = std::max(largest, std::abs(found[i] - expected[i]));
            scale   = std::max(scale, std::abs(expected[i]));
          }
        BOOST_TEST_MESSAGE(dim << "D " << kernels.name << ": "
                               << largest / scale);
        BOOST_TEST(largest < 1e-13 * scale, kernels.name << " differ");
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(kernels_of_all_instruction_sets_agree)
{
  for (const bool is_large : {false, true})
    {
      compare_all<2>(is_large);
      compare_all<3>(is_large);
    }
}

namespace
{
  /** Energy of a uniform stress in cells of one material: volume by volume. */
  template <int dim>
  void
  check_energy()
  {
    Problem<dim> problem   = make_problem<dim>();
    CellArrays<dim> &cells = problem.cells;
    typename StressArray<dim>::Stress stress;
    for (int k = 0; k < n_stress<dim>; ++k)
      stress[k] = 1e6 * (k + 1.);
    double expected = 0.;
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        cells.lambda[c] = 2e9;
        cells.mu[c]     = 1e9;
        Corners<dim, double> x, gradient;
        for (int a = 0; a < (1 << dim); ++a)
          std::copy_n(problem.position.data() + dim * cells.nodes[c][a],
                      dim,
                      x[a].begin());
        for (int q = 0; q < (1 << dim); ++q)
          {
            cells.set_stress(c, q, stress);
            expected += gradients_times_determinant<dim>(q, x, gradient) *
                        Shape<dim>::weight;
          }
      }
    // strain = (stress - nu / (1 + nu) trace) / (2 mu), nu = 1/3
    double trace = 0., work = 0.;
    for (int k = 0; k < 3; ++k)
      trace += stress[k];
    for (int k = 0; k < n_stress<dim>; ++k)
      work += stress[k] * (k < 3 ? stress[k] - trace / 4. : 2. * stress[k]);
    expected *= 0.5 * work / 2e9;
    for (const CellKernels &kernels : available_kernels())
      {
        choose_kernels(kernels.name);
        const double found =
          elastic_energy<dim>(cells, problem.position.data());
        BOOST_TEST(std::abs(found / expected - 1.) < 1e-13, kernels.name);
      }
    choose_kernels("");
  }
} // namespace

BOOST_AUTO_TEST_CASE(energy_of_uniform_stress)
{
  check_energy<2>();
  check_energy<3>();
}

BOOST_AUTO_TEST_CASE(unknown_kernels_are_refused)
{
  BOOST_CHECK_THROW(choose_kernels("abacus"), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

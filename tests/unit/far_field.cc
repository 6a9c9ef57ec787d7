// SPDX-License-Identifier: LGPL-2.1-or-later
// Kelvin's fields: gradients are derivatives of the displacements, stresses are
// in equilibrium, and a single force is carried by any surface around it. The
// boundary's stiffness carries them through. What it carries stays when a stage
// changes the rock.
#include "plate.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/nodal_areas.h>
#include <keyblock/run/simulation.h>

#include <fstream>

BOOST_AUTO_TEST_SUITE(far_field)

using namespace Keyblock;

namespace
{
  template <int dim>
  void
  check_fields()
  {
    const KelvinFields<dim> fields{2., 3.};
    const double step = 1e-4;
    Point<dim> x;
    for (int d = 0; d < dim; ++d)
      x[d] = 0.7 - 0.45 * d;
    for (unsigned int m = 0; m < KelvinFields<dim>::n; ++m)
      {
        const auto gradient = fields.gradient(m, x);
        Tensor<1, dim> divergence;
        for (int d = 0; d < dim; ++d)
          {
            Tensor<1, dim> shift;
            shift[d]                   = step;
            const Tensor<1, dim> slope = (fields.displacement(m, x + shift) -
                                          fields.displacement(m, x - shift)) /
                                         (2. * step);
            for (int i = 0; i < dim; ++i)
              BOOST_TEST(std::abs(slope[i] - gradient[i][d]) < 1e-6);
            divergence += (fields.stress(m, x + shift)[d] -
                           fields.stress(m, x - shift)[d]) /
                          (2. * step);
          }
        BOOST_TEST(divergence.norm() < 1e-5 * fields.stress(m, x).norm());
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(kelvin_fields)
{
  check_fields<2>();
  check_fields<3>();
}

// a force of 8 pi mu (1 - nu) * 2 along each axis: midpoint rule on a sphere
BOOST_AUTO_TEST_CASE(kelvin_force)
{
  const KelvinFields<3> fields{2., 3.};
  const unsigned int n = 100;
  const double pi      = dealii::numbers::PI;
  for (unsigned int j = 0; j < 3; ++j)
    {
      Tensor<1, 3> carried;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < 2 * n; ++b)
          {
            const double polar = pi * (a + 0.5) / n, turn = pi * (b + 0.5) / n;
            const Point<3> x(std::sin(polar) * std::cos(turn),
                             std::sin(polar) * std::sin(turn),
                             std::cos(polar));
            carried -=
              fields.stress(j, x) * x * std::sin(polar) * (pi / n) * (pi / n);
          }
      carried[j] -= 16. * pi * fields.mu * (1. - fields.poisson_ratio());
      BOOST_TEST(carried.norm() < 0.05); // of 105.6, the rule 0.011
    }
}

namespace
{
  /** A box of n cells a side around the origin, two wide. */
  template <int dim>
  std::unique_ptr<Simulation<dim>>
  make_box(const unsigned int n)
  {
    const std::string name = "far_field_" + std::to_string(dim) + "_" +
                             std::to_string(world.size()),
                      side = std::to_string(n);
    if (world.is_root())
      std::ofstream(name + ".prm")
        << "set Dimension = " << dim << "\nsubsection Domain\n set Corner = -1"
        << (dim == 2 ? ", -1" : ", -1, -1") << "\n set Size = 2"
        << (dim == 2 ? ", 2" : ", 2, 2")
        << "\nend\nsubsection Mesh\n set Cells = " << side << ", " << side
        << (dim == 2 ? "" : ", " + side)
        << "\nend\nsubsection Materials\n set Names = rock\nend\n"
           "subsection Stages\n set Names = none\n subsection none\n  set "
           "Maximum steps = 1\n end\nend\n";
    MPI_Barrier(world);
    auto simulation = std::make_unique<Simulation<dim>>(
      world, name + ".prm", std::vector<std::string>(), name);
    simulation->validate();
    return simulation;
  }

  /** Compare the force of the far field under each of Kelvin's fields with the
   * nodal forces of their tractions, one point per face. */
  template <int dim>
  void
  check_stiffness(const unsigned int n, const double tolerance)
  {
    const auto simulation = make_box<dim>(n);
    const auto &numbering = *simulation->state().numbering;
    const auto &mesh      = simulation->state().split.mesh;
    const KelvinFields<dim> kelvin{2., 3.};
    std::vector<typename FarField<dim>::Face> faces;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        if (mesh.neighbor[c][f] == none)
          faces.push_back({mesh.face_vertices(c, f),
                           mesh.face_center(c, f),
                           nodal_area_vectors(mesh, c, f),
                           Point<dim>(),
                           kelvin.lambda,
                           kelvin.mu});
    const FarField<dim> far_field(faces, simulation->state().split, numbering);
    BOOST_TEST(far_field.is_coupled());
    for (unsigned int m = 0; m < KelvinFields<dim>::n; ++m)
      {
        std::vector<double> displacement(dim * numbering.n_local(), 0.),
          force(displacement), expected(displacement);
        for (const auto &face : faces)
          for (const unsigned int v : face.vertices)
            {
              const unsigned int node = numbering.local_node(v);
              if (node == none)
                continue;
              const auto u    = kelvin.displacement(m, mesh.vertices[v]);
              const auto load = kelvin.stress(m, face.place) * face.area();
              for (unsigned int d = 0; d < dim; ++d)
                {
                  displacement[dim * node + d] = u[d];
                  expected[dim * node + d] -=
                    load[d] / Mesh<dim>::n_face_vertices;
                }
            }
        far_field.add_force(displacement, force);
        double error = 0., square = 0.;
        for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
          {
            error += std::pow(force[i] - expected[i], 2);
            square += std::pow(expected[i], 2);
          }
        error  = world.sum(error);
        square = world.sum(square);
        BOOST_TEST(std::sqrt(error / square) < tolerance);
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(far_field_stiffness)
{
  check_stiffness<2>(32, 0.01);
  check_stiffness<3>(12, 0.06);
}

BOOST_AUTO_TEST_CASE(far_field_of_rock_that_changes)
{
  Plate plate(
    "subsection Supports\n set Names = far\n subsection far\n  set Boundaries "
    "= all\n  set Kind = far field\n  set Center = 0.9, 0.4\n end\nend\n"
    "subsection Stages\n set Names = rest\n subsection rest\n  set Maximum "
    "steps = 1\n end\nend\n",
    "subsection Materials\n set Names = rock, hard\n subsection hard\n  set "
    "Young modulus = 3e9\n  set Poisson ratio = 0.25\n  set Stage = rest\n "
    "end\nend\n");
  plate.conditions->release_supports();
  ForceElement<2> &springs = *plate.conditions->elements.front();
  const auto displacement  = [&](const double size) {
    std::vector<double> u(2 * plate.numbering->n_local());
    for (unsigned int node = 0; node < plate.numbering->n_local(); ++node)
      {
        const Point<2> x = plate.place_of(node);
        u[2 * node]      = size * (1. + x[1]);
        u[2 * node + 1]  = size * x[0] * x[0];
      }
    return u;
  };
  // what the springs do to the owned nodes
  const auto force = [&](const double size) {
    std::vector<double> load(2 * plate.numbering->n_owned(), 0.),
      sum(2 * plate.numbering->n_local(), 0.);
    springs.add_load(0., load);
    springs.add_force(displacement(size), sum);
    for (unsigned int i = 0; i < load.size(); ++i)
      load[i] -= sum[i];
    return load;
  };
  const auto energy = [&](const double size) {
    return world.sum(springs.stored_energy(displacement(size)));
  };
  const auto expect_near = [](const std::vector<double> &a,
                              const std::vector<double> &b,
                              const double factor) {
    double error = 0., largest = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      {
        error   = std::max(error, std::abs(a[i] - factor * b[i]));
        largest = std::max(largest, std::abs(a[i]));
      }
    BOOST_TEST(world.max(largest) > 0.);
    BOOST_TEST(world.max(error) < 1e-10 * world.max(largest));
  };
  plate.fields.displacement      = displacement(1e-3);
  const ForceElementState before = springs.remember();
  const std::vector<double> soft = force(1e-3);
  const double stored            = energy(1e-3);
  plate.conditions->excavate(2);
  expect_near(force(1e-3), soft, 1.);
  BOOST_TEST(std::abs(energy(1e-3) / stored - 1.) < 1e-10);
  // from there on they are three times as stiff
  std::vector<double> further = force(2e-3);
  for (unsigned int i = 0; i < further.size(); ++i)
    further[i] -= soft[i];
  expect_near(further, soft, 3.);
  // back to the state before, and to that of the stage
  const ForceElementState after = springs.remember();
  springs.recall(before);
  expect_near(force(1e-3), soft, 1.);
  expect_near(force(2e-3), soft, 2.);
  springs.recall(after);
  expect_near(force(1e-3), soft, 1.);
}

BOOST_AUTO_TEST_SUITE_END()

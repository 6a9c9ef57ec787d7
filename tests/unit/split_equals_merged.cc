// SPDX-License-Identifier: LGPL-2.1-or-later
// A mesh that is split along joints which hold must move like the unsplit one,
// and rest under in-situ stress with the tractions that the stress demands.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/run/simulation.h>

#include <fstream>

BOOST_AUTO_TEST_SUITE(split_equals_merged)

using namespace Keyblock;

namespace
{
  /** X, Y and T corners in 2D, on an unstructured mesh. */
  const std::string joints_2d = R"(
set Dimension = 2
subsection Domain
  set Size = 4, 3
  set Truncated boundaries = none
end
subsection Mesh
  set Generator = gmsh
  set Size = 0.35
end
subsection Joints
  set Names = cross_a, cross_b, tee, leg_a, leg_b, leg_c
  subsection cross_a
    set Extent = polygon
    set Vertices = 1, 0; 1, 3
  end
  subsection cross_b
    set Extent = polygon
    set Vertices = 0, 1.5; 2.2, 1.7
  end
  subsection tee
    set Extent = polygon
    set Vertices = 1, 0.7; 0, 0.7
  end
  subsection leg_a
    set Extent = polygon
    set Vertices = 2.8, 1.4; 2.9, 0
  end
  subsection leg_b
    set Extent = polygon
    set Vertices = 2.8, 1.4; 4, 2.2
  end
  subsection leg_c
    set Extent = polygon
    set Vertices = 2.8, 1.4; 1.8, 3
  end
end
)";

  /** Three planes and one that ends on another: edges and corners in 3D. */
  const std::string joints_3d = R"(
set Dimension = 3
subsection Domain
  set Size = 2, 2, 2
  set Truncated boundaries = none
end
subsection Mesh
  set Cells = 4, 4, 4
end
subsection Joints
  set Names = x, y, z, tee
  subsection x
    set Point = 1, 0, 0
    set Dip = 90
    set Dip direction = 90
  end
  subsection y
    set Point = 0, 1, 0
    set Dip = 90
    set Dip direction = 0
  end
  subsection z
    set Point = 0, 0, 1
  end
  subsection tee
    set Extent = polygon
    set Vertices = 0, 0, 0.5; 1, 0, 0.5; 1, 2, 0.5; 0, 2, 0.5
  end
end
)";

  const std::string rock = R"(
subsection Materials
  set Names = rock
  subsection rock
    set Young modulus = 15e9
    set Poisson ratio = 0.25
    set Density = 2700
  end
end
subsection Output
  set Write VTU = false
  set History interval = 100
end
subsection Stages
  set Names = run
  subsection run
    set Maximum steps = 1000
  end
end
)";

  /** Run a scene given as text; the folder and file are made unique. */
  template <int dim>
  std::unique_ptr<Simulation<dim>>
  run(const std::string &text, const std::vector<std::string> &overrides)
  {
    const std::string name = "unit_scene_" + std::to_string(world.size());
    if (world.is_root())
      std::ofstream(name + ".prm") << text;
    MPI_Barrier(world);
    auto simulation =
      std::make_unique<Simulation<dim>>(world, name + ".prm", overrides, name);
    simulation->run();
    return simulation;
  }

  double
  largest(const std::vector<double> &values)
  {
    double result = 0.;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }

  template <int dim>
  void
  compare_split_with_merged(const std::string &joints,
                            const std::string &gravity)
  {
    const std::string text = joints + rock +
                             "subsection Supports\n set Names = bottom\n "
                             "subsection bottom\n set Boundaries = bottom\n "
                             "end\nend\nsubsection Initial state\n set "
                             "Gravity = " +
                             gravity + "\nend\n";
    const auto split = run<dim>(text, {"Contact/Tie all joints=true"});
    const auto u =
      split->state().values_by_vertex(split->state().fields.displacement);
    const auto merged = run<dim>(text, {"Contact/Method=none"});
    const auto w =
      merged->state().values_by_vertex(merged->state().fields.displacement);
    BOOST_TEST(split->state().split.mesh.vertices.size() >
               merged->state().split.mesh.vertices.size());
    double difference = 0.;
    for (unsigned int c = 0; c < split->state().split.mesh.n_cells(); ++c)
      for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          difference =
            std::max(difference,
                     std::abs(
                       u[dim * split->state().split.mesh.cells[c][v] + d] -
                       w[dim * merged->state().split.mesh.cells[c][v] + d]));
    BOOST_TEST_MESSAGE("split against merged: " << difference / largest(w));
    BOOST_TEST(difference <= 1e-12 * largest(w));
  }

  /** The integral of N stress . n over the faces of each pair, by position. */
  template <int dim>
  std::vector<Vector<dim>>
  exact_forces(const SplitMesh<dim> &split, const Expression<dim> &stress)
  {
    const Interface<dim> &interface = split.interface;
    std::vector<Vector<dim>> forces(interface.pairs.size());
    constexpr unsigned int n = Mesh<dim>::n_face_vertices;
    for (const JointFace &face : interface.joint_faces)
      {
        const auto minus =
          split.mesh.face_vertices(face.minus_cell, face.minus_face);
        const auto plus =
          split.mesh.face_vertices(face.plus_cell, face.plus_face);
        const Tensor<1, dim> area =
          split.mesh.face_area_vector(face.minus_cell, face.minus_face);
        for (unsigned int p = 0; p < forces.size(); ++p)
          for (unsigned int v = 0; v < n; ++v)
            if (interface.pairs[p].minus == minus[v] &&
                interface.pairs[p].joint == face.joint &&
                std::find(plus.begin(), plus.end(), interface.pairs[p].plus) !=
                  plus.end())
              for (unsigned int q = 0; q < n; ++q)
                {
                  Point<dim> place;
                  double weight = 0.;
                  for (unsigned int w = 0; w < n; ++w)
                    {
                      double value = 1.;
                      for (unsigned int d = 0; d + 1 < dim; ++d)
                        {
                          const double s = ((q >> d) & 1)
                                             ? Shape<dim>::gauss_hi
                                             : Shape<dim>::gauss_lo;
                          value *= ((w >> d) & 1) ? s : 1. - s;
                        }
                      place += value * split.mesh.vertices[minus[w]];
                      if (w == v)
                        weight = value;
                    }
                  std::array<double, n_stress<dim>> sigma;
                  for (int k = 0; k < n_stress<dim>; ++k)
                    sigma[k] = stress.value(place, 0., k);
                  std::array<double, dim> direction;
                  for (unsigned int d = 0; d < dim; ++d)
                    direction[d] = -area[d] * weight / n;
                  const auto f =
                    apply_stress<dim, double>(sigma.data(), direction);
                  for (unsigned int d = 0; d < dim; ++d)
                    forces[p][d] += f[d];
                }
      }
    return forces;
  }

  template <int dim>
  void
  rest_in_situ(const std::string &joints,
               const std::string &gravity,
               const std::string &stress)
  {
    const std::string text =
      joints + rock +
      "subsection Supports\n set Names = all\n subsection all\n set "
      "Boundaries = all\n end\nend\nsubsection Initial state\n set Gravity = " +
      gravity + "\n set Stress = " + stress + "\nend\n";
    const auto simulation = run<dim>(text, {});
    // velocity that the stress of 2 MPa would drive: stress / (rho c)
    const double scale = 2e6 / (2700. * 2581.);
    BOOST_TEST_MESSAGE(
      "velocity in situ: " << largest(simulation->state().values_by_vertex(
                                simulation->state().fields.velocity)) /
                                scale);
    BOOST_TEST(largest(simulation->state().values_by_vertex(
                 simulation->state().fields.velocity)) <= 1e-11 * scale);
    const auto states = simulation->state().contact->gather_pairs();
    const auto forces =
      exact_forces(simulation->state().split,
                   Expression<dim>(stress, n_stress<dim>, "stress"));
    const double kick    = simulation->state().contact->present_kick();
    const auto &pairs    = simulation->state().split.interface.pairs;
    double error         = 0.;
    unsigned int n_slips = 0;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        n_slips += states[p].status != ContactStatus::sticking;
        bool is_held = false; // on the outer boundary the support takes a share
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double x =
              simulation->state().split.mesh.vertices[pairs[p].minus][d];
            const double length = dim == 3 ? 2. : (d == 0 ? 4. : 3.);
            is_held             = is_held || x < 1e-9 || x > length - 1e-9;
          }
        if (!is_held)
          error =
            std::max(error,
                     norm<dim>(add<dim>(states[p].impulse, -kick, forces[p])) /
                       (kick * pairs[p].area));
      }
    BOOST_TEST(pairs.size() > 0u);
    BOOST_TEST(n_slips == 0u);
    BOOST_TEST_MESSAGE("traction in situ: " << error / 2e6);
    BOOST_TEST(error <= 1e-10 * 2e6);
  }
} // namespace

BOOST_AUTO_TEST_CASE(split_equals_merged_2d)
{
  compare_split_with_merged<2>(joints_2d, "3; -9.81");
}

BOOST_AUTO_TEST_CASE(split_equals_merged_3d)
{
  compare_split_with_merged<3>(joints_3d, "3; 1; -9.81");
}

BOOST_AUTO_TEST_CASE(cohesionless_joints_rest_in_uniform_stress_2d)
{
  rest_in_situ<2>(joints_2d, "0; 0", "-2e6; -1.8e6; -1.5e6; 0.1e6");
}

BOOST_AUTO_TEST_CASE(cohesionless_joints_rest_in_graded_stress_2d)
{
  rest_in_situ<2>(joints_2d,
                  "0; -9.81",
                  "-1.8e6 + 0.9*2700*9.81*(y - 3); -1.8e6 + "
                  "2700*9.81*(y - 3); -1.5e6; 0");
}

BOOST_AUTO_TEST_CASE(cohesionless_joints_rest_in_uniform_stress_3d)
{
  rest_in_situ<3>(joints_3d,
                  "0; 0; 0",
                  "-2e6; -1.8e6; -1.5e6; 0.1e6; 0.1e6; 0.2e6");
}

BOOST_AUTO_TEST_CASE(cohesionless_joints_rest_in_graded_stress_3d)
{
  rest_in_situ<3>(joints_3d,
                  "0; 0; -9.81",
                  "-1.8e6 + 0.9*2700*9.81*(z - 2); -1.5e6 + "
                  "0.8*2700*9.81*(z - 2); -1.8e6 + 2700*9.81*(z - 2); 0; 0; 0");
}

BOOST_AUTO_TEST_SUITE_END()

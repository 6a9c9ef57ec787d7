// SPDX-License-Identifier: LGPL-2.1-or-later
// What a quiet boundary sends back of plane waves at any angle, and that it
// carries what its supports carried.
#include "plate.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <complex>

BOOST_AUTO_TEST_SUITE(quiet_boundary)

using namespace Keyblock;

namespace
{
  using Complex  = std::complex<double>;
  using Complex2 = std::array<Complex, 2>;

  Material<2>
  rock()
  {
    Material<2> material;
    material.young_modulus = 2.5e10;
    material.poisson_ratio = 0.25;
    material.density       = 2500.;
    return material;
  }

  /** Plane wave of unit velocity along `moves`, of slowness `slowness`. */
  struct Wave
  {
    Complex2 slowness, moves;
  };

  /** Waves of horizontal slowness @p s that go up or down (the boundary is the
   * top), of compression or shear. */
  Wave
  wave(const double speed, const double s, const bool is_shear, const double up)
  {
    const Complex vertical =
      std::sqrt(Complex(1. / (speed * speed) - s * s, 0.));
    // what decays away from the boundary: exp(i w (s x + q y - t)) below it
    const Complex q = up * vertical;
    Wave result{{{s, q}}, {{s * speed, q * speed}}};
    if (is_shear)
      result.moves = {{-q * speed, s * speed}};
    return result;
  }

  /** Traction of the wave on the boundary, plus what the dashpots give. */
  Complex2
  imbalance(const Material<2> &material, const Wave &w)
  {
    const double lambda = material.lame_lambda(), G = material.shear_modulus();
    Tensor<1, 2> n;
    n[1]                 = 1.;
    const Tensor<2, 2> C = quiet_impedance(material, n);
    const Complex dilation =
      w.slowness[0] * w.moves[0] + w.slowness[1] * w.moves[1];
    // strain rate is -sym(slowness x acceleration): per velocity, -sym(s v)
    const Complex2 traction = {
      {-G * (w.slowness[0] * w.moves[1] + w.slowness[1] * w.moves[0]),
       -(lambda * dilation + 2. * G * w.slowness[1] * w.moves[1])}};
    return {{traction[0] + C[0][0] * w.moves[0] + C[0][1] * w.moves[1],
             traction[1] + C[1][0] * w.moves[0] + C[1][1] * w.moves[1]}};
  }

  /** Share of the energy of a wave at @p angle [deg] that comes back. */
  double
  reflected_energy(const bool is_shear, const double angle)
  {
    const Material<2> material = rock();
    const double cs = std::sqrt(material.shear_modulus() / material.density);
    const double cp =
      std::sqrt((material.lame_lambda() + 2. * material.shear_modulus()) /
                material.density);
    const double speed = is_shear ? cs : cp;
    const double s     = std::sin(angle * dealii::numbers::PI / 180.) / speed;
    const Complex2 in  = imbalance(material, wave(speed, s, is_shear, 1.));
    const Wave down_p  = wave(cp, s, false, -1.),
               down_s  = wave(cs, s, true, -1.);
    const Complex2 p   = imbalance(material, down_p),
                   q   = imbalance(material, down_s);
    const Complex det  = p[0] * q[1] - p[1] * q[0];
    const Complex a    = -(in[0] * q[1] - in[1] * q[0]) / det;
    const Complex b    = -(p[0] * in[1] - p[1] * in[0]) / det;
    // flux through the boundary: rho c^2 times the vertical slowness
    const auto flux = [&](const double c, const Complex amplitude) {
      return c * c * std::norm(amplitude) *
             std::sqrt(Complex(1. / (c * c) - s * s, 0.)).real();
    };
    return (flux(cp, a) + flux(cs, b)) / flux(speed, 1.);
  }
} // namespace

BOOST_AUTO_TEST_CASE(quiet_boundary_reflects_little)
{
  BOOST_TEST(reflected_energy(false, 0.) < 1e-20);
  BOOST_TEST(reflected_energy(true, 0.) < 1e-20);
  // Lysmer and Kuhlemeyer (1969), Poisson ratio 0.25
  BOOST_TEST(std::abs(reflected_energy(false, 40.) - 0.0016) < 6e-5);
  BOOST_TEST(std::abs(reflected_energy(false, 60.) - 0.0359) < 6e-5);
  BOOST_TEST(std::abs(reflected_energy(true, 30.) - 0.0359) < 6e-5);
  BOOST_TEST(std::abs(reflected_energy(true, 60.) - 0.1133) < 6e-5);
}

BOOST_AUTO_TEST_CASE(quiet_boundary_carries_on)
{
  // stress of 1 MPa along x, held at the right until the stage
  Plate plate("subsection Supports\n set Names = end\n subsection end\n  set "
              "Boundaries = right\n  set Kind = quiet\n  set Stage = rest\n "
              "end\nend\nsubsection Initial state\n set Stress = -1e6; 0; 0; "
              "0\nend\n" +
              one_stage);
  plate.step->begin_stage(*plate.scene.stages[0], 1);
  const auto n_held = [&]() {
    return world.sum(double(plate.fields.nodes_of_support[0].size()));
  };
  BOOST_TEST(n_held() == 3.);
  plate.step->excavate(2);
  BOOST_TEST(n_held() == 0.);
  plate.conditions->set_load(0.);
  const Tensor<1, 2> sum = plate.sum_of(plate.fields.load);
  BOOST_TEST(std::abs(sum[0] + 1e6) < 1e-3);
  BOOST_TEST(std::abs(sum[1]) < 1e-3);
  BOOST_TEST(plate.conditions->has_viscous_elements());
}

BOOST_AUTO_TEST_SUITE_END()

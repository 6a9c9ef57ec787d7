// SPDX-License-Identifier: LGPL-2.1-or-later
// Motion of random blocks against an independent search for it.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/limit_equilibrium.h>

#include <array>
#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(limit_equilibrium_motion)

using namespace Keyblock;
using dealii::Tensor;

namespace
{
  using Mode = LimitEquilibrium<3>::Mode;

  /** What the faces of a block without friction leave of the load. */
  struct Relaxation
  {
    Tensor<1, 3> force; ///< [N]
    std::vector<double> normal_forces;
    bool is_converged = false; ///< slow where faces almost close a block in

    Relaxation(const std::vector<BlockFace<3>> &faces, const Tensor<1, 3> &load)
      : force(load)
      , normal_forces(faces.size())
    {
      for (unsigned int i = 0; i < 20000 && !is_converged; ++i)
        {
          double change = 0.;
          for (unsigned int f = 0; f < faces.size(); ++f)
            {
              const double relaxed =
                std::max(0., normal_forces[f] - force * faces[f].inward);
              force += (relaxed - normal_forces[f]) * faces[f].inward;
              change += std::abs(relaxed - normal_forces[f]);
              normal_forces[f] = relaxed;
            }
          is_converged = change < 1e-14;
        }
    }
  };
} // namespace

BOOST_AUTO_TEST_CASE(random_blocks_move_as_frictionless_ones_would)
{
  std::mt19937 random(3);
  std::normal_distribution<double> component;
  std::array<unsigned int, 5> n_of_mode{};
  unsigned int n_left = 0;
  for (unsigned int trial = 0; trial < 2000; ++trial)
    {
      const auto direction = [&]() {
        const Tensor<1, 3> v(
          {component(random), component(random), component(random)});
        return v / v.norm();
      };
      std::vector<BlockFace<3>> faces;
      for (unsigned int i = 0; i < 1 + trial % 5; ++i)
        {
          faces.emplace_back();
          faces.back().inward = direction();
        }
      const Tensor<1, 3> load = direction();
      const auto result       = solve_limit_equilibrium<3>(faces, load);
      ++n_of_mode[static_cast<int>(result.mode)];
      const Relaxation search(faces, load);
      n_left += !search.is_converged;
      if (!search.is_converged)
        continue;
      BOOST_TEST((result.mode == Mode::stable) == (search.force.norm() < 1e-9));
      if (result.mode == Mode::stable)
        continue;
      BOOST_TEST(
        (search.force - result.driving_force * result.direction).norm() < 1e-9);
      for (unsigned int i = 0; i < result.faces.size(); ++i)
        BOOST_TEST(std::abs(search.normal_forces[result.faces[i]] -
                            result.normal_forces[i]) <= 1e-6);
    }
  BOOST_TEST(n_left < 40);
  for (const unsigned int n : n_of_mode)
    BOOST_TEST(n > 50);
}

BOOST_AUTO_TEST_SUITE_END()

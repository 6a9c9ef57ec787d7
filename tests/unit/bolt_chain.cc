// SPDX-License-Identifier: LGPL-2.1-or-later
// A grouted bolt pulled out of rigid rock against the closed form of a bar on
// springs that slip.
#include <boost/test/unit_test.hpp>

#include <keyblock/rock/bolt_chain.h>

#include <cmath>
#include <limits>
#include <random>

BOOST_AUTO_TEST_SUITE(bolt_chain)

using namespace Keyblock;

namespace
{
  /** Bond stiffness [N/m/m], strength [N/m], axial stiffness [N]. */
  constexpr double bond = 112e6, strength = 0.175e6, bar = 181e-6 * 98.6e9;

  BoltProperties
  properties()
  {
    BoltProperties p;
    p.axial_stiffness = bar;
    p.yield_force     = 0.5e6;
    p.bond_stiffness  = bond;
    p.bond_strength   = strength;
    p.plate_stiffness = 1e13;
    p.plate_strength  = 1e15;
    return p;
  }

  /** A bolt of which nothing holds the head but a plate, which is pulled. */
  class Pull
  {
  public:
    Pull(const double length, const unsigned int n_segments)
      : chain(properties(), places(length, n_segments))
      , rock(n_segments + 1, 0.)
      , bonded_head(bond * 0.5 * length / n_segments)
      , head_strength(strength * 0.5 * length / n_segments)
    {}

    /** Force at the head displaced by @p u [N]. */
    double
    to(const double u)
    {
      // the plate is pulled out, and the grout of the first node stays with
      // it: its share is what the rock there would bear
      rock[0] = -u;
      chain.follow(rock.data());
      return chain.axial_force_of(0) + std::min(bonded_head * u, head_strength);
    }

    BoltChain chain;

  private:
    static std::vector<double>
    places(const double length, const unsigned int n_segments)
    {
      std::vector<double> s;
      for (unsigned int i = 0; i <= n_segments; ++i)
        s.push_back(length * i / n_segments);
      return s;
    }

    std::vector<double> rock;
    double bonded_head, head_strength;
  };

  const double lambda = std::sqrt(bond / bar);
} // namespace

BOOST_AUTO_TEST_CASE(bolt_pull_out_elastic)
{
  BOOST_TEST(std::abs(lambda - 2.50514) < 1e-5);
  // 20 segments per 1/lambda, and second order
  for (const double length : {17.7, 0.25, 0.5, 1.})
    {
      std::vector<double> errors;
      const double exact = bar * lambda * std::tanh(lambda * length);
      for (const unsigned int per_length : {20u, 40u})
        {
          Pull pull(length, std::ceil(per_length * lambda * length));
          errors.push_back(pull.to(1e-5) / 1e-5 / exact - 1.);
        }
      BOOST_TEST_MESSAGE("stiffness " << exact << ", errors " << errors[0]
                                      << " " << errors[1]);
      BOOST_TEST(std::abs(errors[0]) < 5e-4);
      BOOST_TEST(std::abs(errors[0]) > 3. * std::abs(errors[1]));
    }
}

BOOST_AUTO_TEST_CASE(bolt_pull_out_slip)
{
  const double length = 17.7;
  for (const unsigned int per_length : {20u, 80u})
    {
      Pull pull(length, std::ceil(per_length * lambda * length));
      double before = 0.;
      for (const double debonded : {0., 0.5, 1., 2.})
        {
          const double rest  = std::tanh(lambda * (length - debonded));
          const double force = strength * debonded + strength / lambda * rest;
          const double u     = strength / bond +
                           strength / lambda * rest * debonded / bar +
                           strength * debonded * debonded / (2. * bar);
          double found = 0.;
          for (unsigned int i = 1; i <= 20; ++i)
            found = pull.to(before + (u - before) * i / 20);
          before = u;
          BOOST_TEST_MESSAGE("debonded " << debonded << ": " << u << " m, "
                                         << force << " N, found " << found);
          BOOST_TEST(std::abs(found / force - 1.) < 0.01 / per_length);
        }
      // yields where its force reaches the yield force
      for (unsigned int i = 1; i <= 100; ++i)
        pull.to(before + (0.0412 - before) * i / 100);
      BOOST_TEST(std::abs(pull.chain.axial_force_of(0) / 0.5e6 - 1.) < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(bolt_yields_where_it_should)
{
  Pull pull(17.7, 1774);
  double u = 0.;
  while (pull.to(u) < 0.5e6 * (1. - 1e-9) && u < 0.06)
    u += 1e-4;
  BOOST_TEST(std::abs(u / 0.0408049 - 1.) < 5e-3);
}

BOOST_AUTO_TEST_CASE(bolt_ultimate)
{
  for (const double length : {0.25, 0.5, 1.})
    {
      Pull pull(length, 40);
      for (unsigned int i = 1; i <= 50; ++i)
        pull.to(0.001 * i);
      BOOST_TEST(std::abs(pull.to(0.05) / (strength * length) - 1.) < 1e-9);
      BOOST_TEST(std::abs(pull.chain.capacity(0.).force / (strength * length) -
                          1.) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(bolt_work_is_stored_or_dissipated)
{
  Pull pull(2., 100);
  double work = 0., force_before = 0., u_before = 0.;
  const unsigned int n = 4000;
  for (unsigned int i = 1; i <= n; ++i)
    {
      // out, back, and out again
      const double u = 0.006 * std::sin(4. * i / n);
      pull.to(u);
      const double force = pull.chain.force_on_rock(0);
      work += 0.5 * (force + force_before) * (u - u_before);
      u_before     = u;
      force_before = force;
    }
  const double total =
    pull.chain.stored_energy() + pull.chain.dissipated_energy();
  BOOST_TEST_MESSAGE("work " << work << ", stored and dissipated " << total);
  BOOST_TEST(pull.chain.dissipated_energy() > 0.);
  BOOST_TEST(std::abs(work / total - 1.) < 1e-12);
}

BOOST_AUTO_TEST_CASE(bolt_work_in_large_steps_is_stored_or_dissipated)
{
  // with forces taken at the mean of each step, however large: grout slips, the
  // bar yields and breaks, the plate slips, comes off and bears again
  BoltProperties p              = properties();
  p.yield_force                 = 0.15e6;
  p.rupture_strain              = 0.004;
  p.plate_stiffness             = 10. * bar;
  p.plate_strength              = 0.05e6;
  const unsigned int n_segments = 20;
  std::vector<double> places;
  for (unsigned int i = 0; i <= n_segments; ++i)
    places.push_back(0.1 * i);
  BoltChain chain(p, places);
  std::vector<double> rock(n_segments + 1, 0.), rock_before = rock,
                                                force_before = rock;
  double work = 0., largest = 0., slip = 0.;
  for (unsigned int i = 1; i <= 60; ++i)
    {
      for (unsigned int k = 0; k <= n_segments; ++k)
        rock[k] = (k < 8 ? -1. : 0.1) * 0.0002 * i * std::sin(0.7 * i);
      chain.follow(rock.data());
      for (unsigned int k = 0; k <= n_segments; ++k)
        {
          work -= 0.5 * (chain.force_on_rock(k) + force_before[k]) *
                  (rock[k] - rock_before[k]);
          force_before[k] = chain.force_on_rock(k);
          slip            = std::max(slip, std::abs(chain.slip_of(k)));
        }
      rock_before = rock;
      largest     = std::max(largest, std::abs(work));
    }
  BOOST_TEST(chain.is_broken());
  BOOST_TEST(slip > 0.);
  BOOST_TEST_MESSAGE("largest work " << largest << " J, lost "
                                     << chain.stored_energy() +
                                          chain.dissipated_energy() - work);
  // what equilibrium is found to in steps as large as these: 4e-10
  BOOST_TEST(std::abs(chain.stored_energy() + chain.dissipated_energy() -
                      work) < 1e-9 * largest);
}

BOOST_AUTO_TEST_CASE(bolt_pretension_and_rupture)
{
  BoltProperties p  = properties();
  p.free_length     = 2.;
  p.pretension      = 50e3;
  p.plate_stiffness = 100. * bar;
  p.rupture_strain  = 0.01;
  p.bond_strength   = 1e6;
  std::vector<double> places;
  for (unsigned int i = 0; i <= 40; ++i)
    places.push_back(0.1 * i);
  BoltChain chain(p, places);
  chain.tension();
  for (unsigned int j = 0; j < 20; ++j)
    BOOST_TEST(std::abs(chain.axial_force_of(j) / 50e3 - 1.) < 1e-10);
  BOOST_TEST(std::abs(chain.plate_force() / 50e3 - 1.) < 1e-10);

  // rock that comes towards the anchor loosens it
  std::vector<double> rock(41, 0.);
  std::fill(rock.begin(), rock.begin() + 10, 0.02);
  chain.follow(rock.data());
  BOOST_TEST(std::abs(chain.plate_force()) < 1e-6);

  // and a wide crack breaks it
  for (unsigned int i = 1; i <= 60; ++i)
    {
      std::fill(rock.begin(), rock.begin() + 10, -0.001 * i);
      chain.follow(rock.data());
    }
  chain.follow(rock.data());
  BOOST_TEST(chain.is_broken());
  BOOST_TEST(std::abs(chain.plate_force()) < 1.);
}

BOOST_AUTO_TEST_CASE(bolt_breaks_by_the_strain_of_its_whole_free_length)
{
  // 4 m of free bar in a few or many segments, the last ones short
  for (const std::vector<double> &free_places :
       {std::vector<double>{0.},
        std::vector<double>{0., 1., 2., 3.},
        std::vector<double>{0., 0.5, 1., 1.5, 2., 2.5, 3., 3.5, 3.8, 3.9}})
    {
      BoltProperties p           = properties();
      p.free_length              = 4.;
      p.yield_force              = 100e3;
      p.rupture_strain           = 0.01;
      p.bond_strength            = 1e6;
      p.plate_stiffness          = 1e12;
      p.plate_strength           = 1e9;
      std::vector<double> places = free_places;
      const unsigned int n_nodes = 31 + free_places.size();
      for (unsigned int i = 0; i <= 30; ++i)
        places.push_back(4. + 0.1 * i);
      BoltChain chain(p, places);
      std::vector<double> rock(n_nodes, 0.);
      const double step = 1e-5;
      unsigned int k    = 0;
      while (!chain.is_broken() && k < 10000)
        {
          rock[0] = -step * ++k;
          chain.follow(rock.data());
        }
      BOOST_TEST_MESSAGE(places.size() << " nodes: broken at " << k * step
                                       << " m, dissipated "
                                       << chain.dissipated_energy() << " J");
      // the grout gives way a little
      const double way = k * step, plastic = 0.04 - 4. * p.yield_force / bar;
      BOOST_TEST(std::abs(way - 0.041) < 0.002);
      const double work = p.yield_force * 0.5 * (plastic + way);
      BOOST_TEST(std::abs(chain.dissipated_energy() / work - 1.) < 0.01);
    }
}

BOOST_AUTO_TEST_CASE(bolt_rupture_dissipates_all_that_it_lets_go)
{
  // soft grout and the other segments store more than the one that breaks
  for (const double yield : {1e9, 45e3})
    {
      BoltProperties p  = properties();
      p.yield_force     = yield;
      p.bond_stiffness  = 1e6;
      p.plate_stiffness = 10. * bar;
      p.rupture_strain  = 0.003;
      std::vector<double> places, rock(41, 0.);
      for (unsigned int i = 0; i <= 40; ++i)
        places.push_back(0.1 * i);
      BoltChain chain(p, places);
      double work = 0., largest = 0., stored = 0.;
      const auto force = [&]() {
        double sum = 0.;
        for (unsigned int i = 20; i <= 40; ++i)
          sum -= chain.force_on_rock(i);
        return sum;
      };
      const double step = 1e-6;
      unsigned int k    = 1;
      for (; k < 200000 && !chain.is_broken(); ++k)
        {
          const double before = force();
          stored              = chain.stored_energy();
          std::fill(rock.begin() + 20, rock.end(), k * step);
          chain.follow(rock.data());
          work += 0.5 * (before + force()) * step;
          largest = std::max(largest, before);
        }
      BOOST_TEST(chain.is_broken());
      const double lost =
        work - chain.stored_energy() - chain.dissipated_energy();
      BOOST_TEST_MESSAGE("broken after "
                         << k << " steps at " << largest << " N: stored "
                         << stored << " J before, " << chain.stored_energy()
                         << " J behind, of " << work << " J are lost " << lost);
      // the force falls somewhere in a step
      BOOST_TEST(std::abs(lost) < largest * step);
      BOOST_TEST(chain.stored_energy() < 1e-9 * stored);
    }
}

BOOST_AUTO_TEST_CASE(bolt_moves_with_its_rock)
{
  // far, without a force beyond round-off, and without a search for it
  BoltChain chain(properties(), {0., 0.5, 1., 1.5, 2.});
  for (unsigned int i = 1; i <= 100000; ++i)
    chain.follow(std::vector<double>(5, 1e-5 * i).data());
  for (unsigned int i = 0; i < 5; ++i)
    BOOST_TEST(std::abs(chain.force_on_rock(i)) < 1e-12 * bar);
  BOOST_TEST(chain.dissipated_energy() == 0.);
}

BOOST_AUTO_TEST_CASE(bolt_cut_in_the_middle)
{
  // 4 m in 40 segments; the rock from 1.5 m to 2.5 m is dug
  BoltProperties p  = properties();
  p.yield_force     = 1e9;
  p.plate_strength  = 20e3;
  p.plate_stiffness = 10. * bar;
  std::vector<double> places;
  for (unsigned int i = 0; i <= 40; ++i)
    places.push_back(0.1 * i);
  std::vector<bool> is_held(41, true), is_cut(40, false);
  for (unsigned int i = 15; i <= 25; ++i)
    {
      is_held[i]    = false;
      is_cut[i - 1] = is_cut[i] = true;
    }
  BoltChain chain(p, places);
  BOOST_TEST(std::abs(chain.capacity(1.).force / (20e3 + strength) - 1.) <
             1e-12);
  chain.set_ground(is_held, is_cut);
  // grout from s to 1.45 m, half a segment before the first node without rock,
  // and beyond 2.55 m
  using Limit = BoltChain::Capacity::Limit;
  BOOST_TEST(std::abs(chain.capacity(1.).force / (0.45 * strength) - 1.) <
             1e-12);
  BOOST_TEST((chain.capacity(1.).limit == Limit::anchor));
  BOOST_TEST(std::abs(chain.capacity(3.).force / (0.45 * strength) - 1.) <
             1e-12);
  BOOST_TEST((chain.capacity(3.).limit == Limit::head));
  BOOST_TEST(chain.capacity(2.).force == 0.);

  // rock from 1 m on moves away: the outer part follows it without a force,
  // the inner one bears what the grout between 1 m and the cut does
  std::vector<double> rock(41, 0.);
  for (unsigned int k = 1; k <= 50; ++k)
    {
      std::fill(rock.begin() + 10, rock.end(), 0.001 * k);
      chain.follow(rock.data());
    }
  // the node at 1 m moves with the rock: its grout counts as beyond
  BOOST_TEST(std::abs(chain.axial_force_of(9) / (0.5 * strength) - 1.) < 1e-9);
  for (unsigned int j = 14; j < 40; ++j)
    BOOST_TEST(std::abs(chain.axial_force_of(j)) < 1e-9 * strength);
  BOOST_TEST(std::abs(chain.force_on_rock(30)) < 1e-9 * strength);
}

BOOST_AUTO_TEST_CASE(bolt_goes_on_from_its_state)
{
  // slipping, then elastic again: a copy that takes the state up goes the same
  // way to the last digit
  std::vector<double> places, rock(21, 0.), kept;
  for (unsigned int i = 0; i <= 20; ++i)
    places.push_back(0.1 * i);
  BoltChain chain(properties(), places), copy(properties(), places);
  const auto pull = [&](BoltChain &bolt, const unsigned int k) {
    std::fill(rock.begin() + 8, rock.end(), 0.004 * std::sin(0.1 * k));
    bolt.follow(rock.data());
  };
  for (unsigned int k = 0; k <= 25; ++k)
    pull(chain, k);
  BOOST_TEST(chain.dissipated_energy() > 0.);
  chain.remember(kept);
  std::size_t at = 0;
  copy.recall(kept, at);
  BOOST_TEST(at == kept.size());
  for (unsigned int k = 26; k <= 120; ++k)
    {
      pull(chain, k);
      pull(copy, k);
      for (unsigned int i = 0; i <= 20; ++i)
        BOOST_TEST(chain.force_on_rock(i) == copy.force_on_rock(i));
    }
  BOOST_TEST(chain.dissipated_energy() == copy.dissipated_energy());
}

BOOST_AUTO_TEST_CASE(bolt_product_is_the_change_of_its_forces)
{
  // elastic, with a plate that pushes or not, and where the grout slips
  std::mt19937 random(3);
  std::uniform_real_distribution<double> between(-1., 1.);
  for (const double size : {1e-6, 1e-4, 3e-3})
    for (unsigned int trial = 0; trial < 8; ++trial)
      {
        BoltProperties p  = properties();
        p.plate_stiffness = 1e9;
        BoltChain chain(p, {0., 0.7, 1.1, 2., 2.4, 3.});
        std::vector<double> rock(chain.n_nodes()), way(rock.size());
        for (unsigned int i = 0; i < rock.size(); ++i)
          {
            rock[i] = size * between(random);
            way[i]  = between(random);
          }
        chain.follow(rock.data());
        std::vector<double> before, product = way;
        for (unsigned int i = 0; i < rock.size(); ++i)
          before.push_back(chain.force_on_rock(i));
        chain.multiply(product.data());
        // backwards along the way where what slips would slip on
        double least = std::numeric_limits<double>::max(), scale = 0.;
        for (const double sign : {1., -1.})
          {
            BoltChain moved            = chain;
            std::vector<double> beside = rock;
            const double step          = 1e-4 * size * sign;
            for (unsigned int i = 0; i < rock.size(); ++i)
              beside[i] += step * way[i];
            moved.follow(beside.data());
            double off = 0.;
            for (unsigned int i = 0; i < rock.size(); ++i)
              {
                const double change =
                  (moved.force_on_rock(i) - before[i]) / step;
                off   = std::max(off, std::abs(change - product[i]));
                scale = std::max(scale, std::abs(change));
              }
            least = std::min(least, off);
          }
        if (size < 1e-3)
          BOOST_TEST(least < 1e-3 * scale);
        // symmetric
        std::vector<double> other(rock.size()), answer;
        for (double &value : other)
          value = between(random);
        answer = other;
        chain.multiply(answer.data());
        double a = 0., b = 0.;
        for (unsigned int i = 0; i < rock.size(); ++i)
          {
            a += product[i] * other[i];
            b += answer[i] * way[i];
          }
        BOOST_TEST(std::abs(a - b) < 1e-9 * (std::abs(a) + std::abs(b)));
      }
}

BOOST_AUTO_TEST_SUITE_END()

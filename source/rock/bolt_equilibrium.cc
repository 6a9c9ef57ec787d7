// SPDX-License-Identifier: LGPL-2.1-or-later
// The equilibrium of a bolt's nodes in every step.
#include <keyblock/rock/bolt_chain.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    constexpr unsigned int maximum_iterations = 100;

    /** Residual that counts as none, over the largest force in the bolt, and
     * over what its stiffest spring would bear at the largest displacement: the
     * round-off of that stays. */
    constexpr double tolerance = 1e-13, round_off = 1e-15;

    /** Stiffness that keeps a bolt in place which nothing else holds, over
     * that of the stiffest spring. */
    constexpr double least_stiffness = 1e-13;

    /** Stiffness of a spring that slips or yields over that before, in the
     * matrix of Newton's method alone. */
    constexpr double plastic_stiffness = 1e-5;

    /** Steps by which the least energy on a way is bracketed. */
    constexpr std::uintmax_t maximum_cuts = 40;
  } // namespace



  void
  BoltChain::respond(const double *rock)
  {
    set_trial_forces(rock);
    double *b = row(bond_force), *axial = row(axial_force);
    const double *strength = row(bond_strength);
    const double most      = properties.yield_force;
    for (unsigned int i = 0; i < n; ++i)
      {
        bond_is_elastic[i] = std::abs(b[i]) <= strength[i];
        b[i] = std::max(-strength[i], std::min(strength[i], b[i]));
      }
    for (unsigned int j = 0; j + 1 < n; ++j)
      {
        segment_is_elastic[j] = std::abs(axial[j]) <= most;
        axial[j]              = std::max(-most, std::min(most, axial[j]));
      }
    plate_on_rock    = 0.;
    is_plate_elastic = false;
    if (!is_plate_held)
      return;
    const double force = trial_plate_force(rock[0]);
    plate_on_rock      = std::clamp(force, 0., properties.plate_strength);
    is_plate_elastic   = force == plate_on_rock;
  }



  void
  BoltChain::set_trial_forces(const double *rock)
  {
    const double *w = row(displacement), *g = row(slip), *e = row(elongation),
                 *k = row(bond_stiffness), *s = row(segment_stiffness);
    double *b = row(bond_force), *axial = row(axial_force);
    for (unsigned int i = 0; i < n; ++i)
      b[i] = k[i] * (rock[i] - w[i] - g[i]);
    for (unsigned int j = 0; j + 1 < n; ++j)
      axial[j] = s[j] * (w[j + 1] - w[j] - e[j]);
  }



  double
  BoltChain::find_residual(const double jack)
  {
    const double *b = row(bond_force), *axial = row(axial_force);
    double *r      = row(residual);
    double largest = 0.;
    // the force of the last segment, of which there is none, is 0
    for (unsigned int i = 0; i < n; ++i)
      r[i] = b[i] + axial[i];
    r[0] -= jack >= 0. ? jack : plate_on_rock;
    for (unsigned int i = 1; i < n; ++i)
      r[i] -= axial[i - 1];
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, std::abs(r[i]));
    return largest;
  }



  void
  BoltChain::factorise(const double jack)
  {
    const double *k = row(bond_stiffness), *s = row(segment_stiffness);
    double carried = 0., coupled = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        double diagonal = k[i] * (bond_is_elastic[i] ? 1. : plastic_stiffness) +
                          least_stiffness * stiffest - coupled + carried;
        if (i == 0 && jack < 0. && is_plate_elastic)
          diagonal += properties.plate_stiffness;
        const double stiffness =
          i + 1 < n ? s[i] * (segment_is_elastic[i] ? 1. : plastic_stiffness)
                    : 0.;
        diagonal += stiffness;
        row(inverse)[i] = 1. / diagonal;
        if (i + 1 == n)
          break;
        row(factor)[i + 1] = -stiffness / diagonal;
        carried            = stiffness;
        coupled            = stiffness * stiffness / diagonal;
      }
  }



  void
  BoltChain::find_change()
  {
    const double *r = row(residual), *f = row(factor), *d = row(inverse);
    double *c = row(change);
    double y  = r[0];
    c[0]      = y;
    for (unsigned int i = 1; i < n; ++i)
      c[i] = y = r[i] - f[i] * y;
    c[n - 1] = y *= d[n - 1];
    for (unsigned int i = n - 1; i-- > 0;)
      c[i] = y = c[i] * d[i] - f[i + 1] * y;
  }



  double
  BoltChain::negligible_residual(const double *rock, const double jack) const
  {
    double scale = std::max(0., jack), farthest = 0.;
    const double *b = row(bond_force), *axial = row(axial_force),
                 *w = row(displacement);
    for (unsigned int i = 0; i < n; ++i)
      {
        scale    = std::max({scale, std::abs(b[i]), std::abs(axial[i])});
        farthest = std::max({farthest, std::abs(w[i]), std::abs(rock[i])});
      }
    return tolerance * scale + round_off * stiffest * farthest;
  }



  void
  BoltChain::find_equilibrium(const double *rock, const double jack)
  {
    double *w = row(displacement), *c = row(change), *start = row(before);
    respond(rock);
    double size = find_residual(jack);
    for (unsigned int i = 0; i < maximum_iterations; ++i)
      {
        if (size <= negligible_residual(rock, jack))
          break;
        factorise(jack);
        find_change();
        // the energy is convex: go on where it still falls at the end of the
        // way, else to its least value on the way
        std::copy_n(w, n, start);
        const auto slope_at = [&](const double share) {
          for (unsigned int k = 0; k < n; ++k)
            w[k] = start[k] + share * c[k];
          respond(rock);
          size         = find_residual(jack);
          double slope = 0.;
          for (unsigned int k = 0; k < n; ++k)
            slope += row(residual)[k] * c[k];
          return slope;
        };
        if (slope_at(1.) < 0.)
          {
            std::uintmax_t n_cuts = maximum_cuts;
            const auto least      = boost::math::tools::bisect(
              slope_at,
              0.,
              1.,
              [](const double a, const double b) { return b - a < 0.1 * b; },
              n_cuts);
            slope_at(least.first > 0. ? least.first : least.second);
          }
      }
  }



  void
  BoltChain::solve(const double *rock, const double jack)
  {
    find_equilibrium(rock, jack);
    commit(rock);
    while (break_segments())
      {
        find_equilibrium(rock, jack);
        commit(rock);
      }
    const auto all = [&](const std::vector<char> &is_elastic) {
      return std::find(is_elastic.begin(), is_elastic.end(), false) ==
             is_elastic.end();
    };
    was_elastic = (is_plate_elastic || plate_on_rock == 0.) &&
                  all(bond_is_elastic) && all(segment_is_elastic);
    is_factorised = false;
  }



  bool
  BoltChain::follow_elastically(const double *rock)
  {
    if (!was_elastic)
      return false;
    if (!is_factorised)
      factorise(-1.);
    is_factorised = true;
    double *w = row(displacement), *start = row(before);
    const double *c = row(change), *b = row(bond_force),
                 *axial = row(axial_force), *strength = row(bond_strength);
    std::copy_n(w, n, start);
    set_trial_forces(rock);
    plate_on_rock = is_plate_elastic ? trial_plate_force(rock[0]) : 0.;
    find_residual(-1.);
    find_change();
    for (unsigned int i = 0; i < n; ++i)
      w[i] += c[i];
    set_trial_forces(rock);
    bool is_elastic = true;
    for (unsigned int i = 0; i < n; ++i)
      is_elastic = is_elastic & (std::abs(b[i]) <= strength[i]);
    for (unsigned int j = 0; j + 1 < n; ++j)
      is_elastic = is_elastic & (std::abs(axial[j]) <= properties.yield_force);
    if (properties.rupture_strain > 0.)
      for (const Stretch &stretch : stretches)
        is_elastic = is_elastic && !is_over_rupture(stretch);
    if (is_plate_held)
      {
        const double force = trial_plate_force(rock[0]);
        is_elastic =
          is_elastic &&
          (is_plate_elastic ? force >= 0. && force <= properties.plate_strength
                            : force < 0.);
        plate_on_rock = is_plate_elastic ? force : 0.;
      }
    if (!is_elastic)
      {
        std::copy_n(start, n, w);
        set_trial_forces(row(followed));
        plate_on_rock =
          is_plate_elastic ? trial_plate_force(row(followed)[0]) : 0.;
      }
    return is_elastic;
  }



  void
  BoltChain::multiply(double *rock)
  {
    factorise(-1.);
    is_factorised      = was_elastic;
    const double plate = is_plate_elastic ? properties.plate_stiffness : 0.;
    double *load       = row(residual);
    const auto stiffness_of_bond = [&](const unsigned int i) {
      return row(bond_stiffness)[i] *
             (bond_is_elastic[i] ? 1. : plastic_stiffness);
    };
    for (unsigned int i = 0; i < n; ++i)
      load[i] = stiffness_of_bond(i) * rock[i];
    load[0] += plate * rock[0];
    find_change();
    const double *w     = row(change);
    const double pushed = plate * (w[0] - rock[0]);
    for (unsigned int i = 0; i < n; ++i)
      rock[i] = stiffness_of_bond(i) * (w[i] - rock[i]);
    rock[0] += pushed;
  }



  bool
  BoltChain::is_over_rupture(const Stretch &stretch) const
  {
    const auto [first, last] = stretch;
    const double *w          = row(displacement);
    return row(segment_stiffness)[first] > 0. &&
           w[last] - w[first] >
             properties.rupture_strain * (place[last] - place[first]);
  }



  void
  BoltChain::commit(const double *rock)
  {
    const double *w = row(displacement), *b = row(bond_force),
                 *axial = row(axial_force), *stiffness = row(segment_stiffness);
    for (unsigned int i = 0; i < n; ++i)
      if (!bond_is_elastic[i])
        row(slip)[i] = rock[i] - w[i] - b[i] / row(bond_stiffness)[i];
    for (unsigned int j = 0; j + 1 < n; ++j)
      if (!segment_is_elastic[j])
        row(elongation)[j] = w[j + 1] - w[j] - axial[j] / stiffness[j];
    for (const Stretch &stretch : stretches)
      spread_elongation(stretch);
    if (is_plate_held && !is_plate_elastic && plate_on_rock > 0.)
      plate_shift = w[0] - rock[0] - plate_on_rock / properties.plate_stiffness;
  }



  void
  BoltChain::spread_elongation(const Stretch &stretch)
  {
    const auto [first, last] = stretch;
    const auto is_elastic    = segment_is_elastic.begin();
    if (std::find(is_elastic + first, is_elastic + last, false) ==
        is_elastic + last)
      return;
    double *w = row(displacement), *e = row(elongation);
    const double length = place[last] - place[first], way = w[last] - w[first],
                 total = std::accumulate(e + first, e + last, 0.);
    for (unsigned int j = first; j < last; ++j)
      {
        e[j] = total * segment_length(j) / length;
        if (j > first)
          w[j] = w[first] + way * (place[j] - place[first]) / length;
      }
  }



  bool
  BoltChain::break_segments()
  {
    bool is_any = false;
    if (properties.rupture_strain > 0.)
      for (const Stretch &stretch : stretches)
        if (is_over_rupture(stretch))
          {
            const auto [first, last] = stretch;
            std::fill(row(broken) + first, row(broken) + last, 1.);
            std::fill(row(segment_stiffness) + first,
                      row(segment_stiffness) + last,
                      0.);
            is_any = true;
          }
    return is_any;
  }



  void
  BoltChain::tension()
  {
    if (properties.pretension == 0.)
      return;
    const std::vector<double> rock(n, 0.);
    solve(rock.data(), properties.pretension);
    plate_shift =
      row(displacement)[0] - properties.pretension / properties.plate_stiffness;
    follow(rock.data());
  }



  void
  BoltChain::follow(const double *rock)
  {
    if (!follow_elastically(rock))
      {
        // by the mean of the forces before and behind, as all work of a step;
        // so what a break lets go, in the grout and in other segments, too,
        // stays here
        dissipated += stored_energy() + half_work_on_way(rock);
        solve(rock, -1.);
        dissipated += half_work_on_way(rock) - stored_energy();
      }
    std::copy_n(rock, n, row(followed));
  }



  double
  BoltChain::half_work_on_way(const double *rock) const
  {
    double work = 0.;
    for (unsigned int i = 0; i < n; ++i)
      work -= 0.5 * force_on_rock(i) * (rock[i] - row(followed)[i]);
    return work;
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/bolt_chain.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    constexpr unsigned int maximum_iterations = 100;

    /** Residual that counts as none, over the largest force in the bolt, and
     * over what its stiffest spring would bear at the largest displacement: the
     * round-off of that stays. */
    constexpr double tolerance = 1e-13, round_off = 1e-15;

    /** Stiffness of a plate for which the scene gives none, over that of a
     * metre of the bar. */
    constexpr double plate_over_bar = 10.;

    /** Stiffness that keeps a bolt in place which nothing else holds, over
     * that of the stiffest spring. */
    constexpr double least_stiffness = 1e-13;

    /** Stiffness of a spring that slips or yields over that before, in the
     * matrix of Newton's method alone. */
    constexpr double plastic_stiffness = 1e-5;

    /** Steps by which the least energy on a way is bracketed. */
    constexpr std::uintmax_t maximum_cuts = 40;

    /** Solve a symmetric tridiagonal system, in place; @p off: beside the
     * diagonal. */
    void
    solve_tridiagonal(std::vector<double> &diagonal,
                      const std::vector<double> &off,
                      std::vector<double> &right)
    {
      const unsigned int n = diagonal.size();
      for (unsigned int i = 1; i < n; ++i)
        {
          const double factor = off[i - 1] / diagonal[i - 1];
          diagonal[i] -= factor * off[i - 1];
          right[i] -= factor * right[i - 1];
        }
      right[n - 1] /= diagonal[n - 1];
      for (unsigned int i = n - 1; i-- > 0;)
        right[i] = (right[i] - off[i] * right[i + 1]) / diagonal[i];
    }
  } // namespace



  BoltChain::BoltChain(const BoltProperties &properties,
                       const std::vector<double> &places)
    : properties(properties)
    , place(places)
    , bonds(places.size())
    , segments(places.size() - 1)
    , rock_force(places.size(), 0.)
    , residual(places.size())
    , diagonal(places.size())
    , off(places.size() - 1)
    , change(places.size())
  {
    const unsigned int n = n_nodes();
    state.displacement.assign(n, 0.);
    state.slip.assign(n, 0.);
    state.elongation.assign(n - 1, 0.);
    state.is_broken.assign(n - 1, 0.);
    state.bond_force.assign(n, 0.);
    state.axial_force.assign(n - 1, 0.);
    stiffest = properties.bond_stiffness * place.back();
    for (unsigned int j = 0; j + 1 < n; ++j)
      {
        segments.stiffness[j] = properties.axial_stiffness / segment_length(j);
        segments.strength[j]  = properties.yield_force;
        stiffest              = std::max(stiffest, segments.stiffness[j]);
      }
    set_ground(std::vector<bool>(n, true));
  }



  double
  BoltChain::grouted_length(const unsigned int i,
                            const double from,
                            const double to) const
  {
    const double begin = i > 0 ? 0.5 * (place[i - 1] + place[i]) : place[0];
    const double end =
      i + 1 < n_nodes() ? 0.5 * (place[i] + place[i + 1]) : place[i];
    return std::max(0.,
                    std::min(end, to) -
                      std::max({begin, from, properties.free_length}));
  }



  void
  BoltChain::set_ground(const std::vector<bool> &is_held)
  {
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        const double length =
          is_held[i] ? grouted_length(i, 0., place.back()) : 0.;
        bonds.stiffness[i] = properties.bond_stiffness * length;
        bonds.strength[i]  = properties.bond_strength * length;
      }
    is_plate_held = is_held[0] && properties.plate_strength > 0.;
  }



  void
  BoltChain::respond(const std::vector<double> &rock)
  {
    const std::vector<double> &w = state.displacement;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      state.bond_force[i] =
        bonds.limit(i, bonds.stiffness[i] * (rock[i] - w[i] - state.slip[i]));
    for (unsigned int j = 0; j + 1 < n_nodes(); ++j)
      state.axial_force[j] =
        segments.limit(j,
                       state.is_broken[j] != 0.
                         ? 0.
                         : segments.stiffness[j] *
                             (w[j + 1] - w[j] - state.elongation[j]));
    state.plate_force = 0.;
    is_plate_elastic  = false;
    if (!is_plate_held)
      return;
    const double force =
      properties.plate_stiffness * (w[0] - rock[0] - state.plate_shift);
    state.plate_force = std::clamp(force, 0., properties.plate_strength);
    is_plate_elastic  = force == state.plate_force;
  }



  double
  BoltChain::find_residual(const double jack)
  {
    double largest = 0.;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        residual[i] =
          state.bond_force[i] + (i + 1 < n_nodes() ? state.axial_force[i] : 0.);
        residual[i] -= i > 0        ? state.axial_force[i - 1]
                       : jack >= 0. ? jack
                                    : state.plate_force;
        largest = std::max(largest, std::abs(residual[i]));
      }
    return largest;
  }



  void
  BoltChain::find_change(const double jack)
  {
    for (unsigned int i = 0; i < n_nodes(); ++i)
      diagonal[i] =
        bonds.stiffness[i] * (bonds.is_elastic[i] ? 1. : plastic_stiffness) +
        least_stiffness * stiffest;
    if (jack < 0. && is_plate_elastic)
      diagonal[0] += properties.plate_stiffness;
    for (unsigned int j = 0; j + 1 < n_nodes(); ++j)
      {
        const double stiffness =
          state.is_broken[j] != 0.
            ? 0.
            : segments.stiffness[j] *
                (segments.is_elastic[j] ? 1. : plastic_stiffness);
        diagonal[j] += stiffness;
        diagonal[j + 1] += stiffness;
        off[j] = -stiffness;
      }
    change = residual;
    solve_tridiagonal(diagonal, off, change);
  }



  void
  BoltChain::solve(const std::vector<double> &rock, const double jack)
  {
    std::vector<double> &w = state.displacement;
    respond(rock);
    double size = find_residual(jack);
    for (unsigned int i = 0; i < maximum_iterations; ++i)
      {
        double scale = std::max(0., jack), farthest = 0.;
        for (const auto *forces : {&state.axial_force, &state.bond_force})
          for (const double force : *forces)
            scale = std::max(scale, std::abs(force));
        for (const std::vector<double> *displacement :
             std::array<const std::vector<double> *, 2>{{&w, &rock}})
          for (const double u : *displacement)
            farthest = std::max(farthest, std::abs(u));
        if (size <= tolerance * scale + round_off * stiffest * farthest)
          break;
        find_change(jack);
        // the energy is convex: go on where it still falls at the end of the
        // way, else to its least value on the way
        before              = w;
        const auto slope_at = [&](const double share) {
          for (unsigned int k = 0; k < w.size(); ++k)
            w[k] = before[k] + share * change[k];
          respond(rock);
          size         = find_residual(jack);
          double slope = 0.;
          for (unsigned int k = 0; k < w.size(); ++k)
            slope += residual[k] * change[k];
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
    commit(rock);
  }



  void
  BoltChain::commit(const std::vector<double> &rock)
  {
    const std::vector<double> &w = state.displacement;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        rock_force[i] = -state.bond_force[i];
        if (bonds.is_elastic[i])
          continue;
        const double slip =
          rock[i] - w[i] - state.bond_force[i] / bonds.stiffness[i];
        state.dissipated += state.bond_force[i] * (slip - state.slip[i]);
        state.slip[i] = slip;
      }
    for (unsigned int j = 0; j + 1 < n_nodes(); ++j)
      {
        const double force = state.axial_force[j], stretch = w[j + 1] - w[j];
        if (!segments.is_elastic[j])
          {
            const double elongation = stretch - force / segments.stiffness[j];
            state.dissipated += force * (elongation - state.elongation[j]);
            state.elongation[j] = elongation;
          }
        // what it had stored goes with it
        if (properties.rupture_strain > 0. && state.is_broken[j] == 0. &&
            stretch > properties.rupture_strain * segment_length(j))
          {
            state.is_broken[j] = 1.;
            state.dissipated += 0.5 * force * force / segments.stiffness[j];
            state.axial_force[j] = 0.;
          }
      }
    rock_force[0] += state.plate_force;
    if (is_plate_held && !is_plate_elastic && state.plate_force > 0.)
      {
        const double shift =
          w[0] - rock[0] - state.plate_force / properties.plate_stiffness;
        state.dissipated += state.plate_force * (shift - state.plate_shift);
        state.plate_shift = shift;
      }
  }



  void
  BoltChain::tension()
  {
    if (properties.pretension == 0.)
      return;
    const std::vector<double> rock(n_nodes(), 0.);
    solve(rock, properties.pretension);
    state.plate_shift = state.displacement[0] -
                        properties.pretension / properties.plate_stiffness;
    follow(rock);
  }



  void
  BoltChain::follow(const std::vector<double> &rock)
  {
    solve(rock, -1.);
  }



  double
  BoltChain::stored_energy() const
  {
    double energy  = 0.;
    const auto add = [&](const std::vector<double> &forces,
                         const Springs &springs) {
      for (unsigned int i = 0; i < forces.size(); ++i)
        if (springs.stiffness[i] > 0.)
          energy += 0.5 * forces[i] * forces[i] / springs.stiffness[i];
    };
    add(state.bond_force, bonds);
    add(state.axial_force, segments);
    if (properties.plate_strength > 0.)
      energy += 0.5 * state.plate_force * state.plate_force /
                properties.plate_stiffness;
    return energy;
  }



  std::vector<double>
  BoltChain::stiffness_bound() const
  {
    std::vector<double> bound = bonds.stiffness;
    if (is_plate_held)
      bound[0] += properties.plate_stiffness;
    // in a row with the first segment
    if (bound[0] > 0.)
      bound[0] *= segments.stiffness[0] / (bound[0] + segments.stiffness[0]);
    return bound;
  }



  BoltChain::Capacity
  BoltChain::capacity(const double s) const
  {
    double head = is_plate_held ? properties.plate_strength : 0., anchor = 0.;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (bonds.strength[i] > 0.)
        {
          head += properties.bond_strength * grouted_length(i, 0., s);
          anchor +=
            properties.bond_strength * grouted_length(i, s, place.back());
        }
    Capacity result{properties.yield_force, Capacity::Limit::yield};
    if (head < result.force)
      result = {head, Capacity::Limit::head};
    if (anchor < result.force)
      result = {anchor, Capacity::Limit::anchor};
    return result;
  }



  template <int dim>
  BoltProperties
  properties_of(const BoltSet<dim> &set)
  {
    BoltProperties p;
    p.axial_stiffness = set.young_modulus * set.area;
    p.yield_force     = set.yield_force;
    p.rupture_strain  = set.rupture_strain;
    p.bond_stiffness  = set.bond_stiffness;
    p.bond_strength   = set.bond_strength;
    p.free_length     = set.free_length;
    p.plate_stiffness = set.plate_stiffness > 0.
                          ? set.plate_stiffness
                          : plate_over_bar * p.axial_stiffness;
    p.plate_strength  = set.plate_strength;
    p.pretension      = set.pretension;
    p.dowel_stiffness = set.dowel_stiffness;
    p.dowel_strength  = set.dowel_strength;
    return p;
  }



  std::string
  describe(const BoltChain::Capacity::Limit limit)
  {
    switch (limit)
      {
        case BoltChain::Capacity::Limit::yield:
          return "yield";
        case BoltChain::Capacity::Limit::head:
          return "bond inside and plate";
        default:
          return "bond outside";
      }
  }

  template BoltProperties properties_of(const BoltSet<2> &);
  template BoltProperties properties_of(const BoltSet<3> &);
} // namespace Keyblock

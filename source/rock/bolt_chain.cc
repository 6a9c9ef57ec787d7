// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/bolt_chain.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
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
    , bonded_length(places.size(), 0.)
    , is_held(places.size(), true)
    , rock_force(places.size(), 0.)
    , segment_force(places.size() - 1, 0.)
  {
    const unsigned int n = place.size();
    state.displacement.assign(n, 0.);
    state.slip.assign(n, 0.);
    state.elongation.assign(n - 1, 0.);
    state.is_broken.assign(n - 1, 0.);
    // what of each half segment is grouted
    for (unsigned int j = 0; j + 1 < n; ++j)
      {
        const double middle  = 0.5 * (place[j] + place[j + 1]),
                     grouted = properties.free_length;
        bonded_length[j] += std::max(0., middle - std::max(place[j], grouted));
        bonded_length[j + 1] +=
          std::max(0., place[j + 1] - std::max(middle, grouted));
      }
  }



  void
  BoltChain::set_ground(const std::vector<bool> &is_held_now)
  {
    is_held = is_held_now;
  }



  double
  BoltChain::bond_stiffness_of(const unsigned int i) const
  {
    return is_held[i] ? properties.bond_stiffness * bonded_length[i] : 0.;
  }



  BoltChain::Response
  BoltChain::respond(const std::vector<double> &w,
                     const std::vector<double> &rock) const
  {
    const unsigned int n = n_nodes();
    Response r;
    r.bond.assign(n, 0.);
    r.bond_stiffness.assign(n, 0.);
    r.segment.assign(n - 1, 0.);
    r.segment_stiffness.assign(n - 1, 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!is_held[i] || bonded_length[i] == 0.)
          continue;
        const double stiffness = bond_stiffness_of(i),
                     strength  = properties.bond_strength * bonded_length[i],
                     force     = stiffness * (rock[i] - w[i] - state.slip[i]);
        r.bond[i]              = std::clamp(force, -strength, strength);
        if (std::abs(force) <= strength)
          r.bond_stiffness[i] = stiffness;
      }
    for (unsigned int j = 0; j + 1 < n; ++j)
      {
        if (state.is_broken[j] != 0.)
          continue;
        const double stiffness = properties.axial_stiffness / segment_length(j);
        const double force =
          stiffness * (w[j + 1] - w[j] - state.elongation[j]);
        r.segment[j] =
          std::clamp(force, -properties.yield_force, properties.yield_force);
        if (std::abs(force) <= properties.yield_force)
          r.segment_stiffness[j] = stiffness;
      }
    if (is_held[0] && properties.plate_strength > 0.)
      {
        const double force =
          properties.plate_stiffness * (w[0] - rock[0] - state.plate_shift);
        r.plate = std::clamp(force, 0., properties.plate_strength);
        if (force >= 0. && force <= properties.plate_strength)
          r.plate_stiffness = properties.plate_stiffness;
      }
    return r;
  }



  void
  BoltChain::solve(const std::vector<double> &rock, const double jack)
  {
    const unsigned int n   = n_nodes();
    std::vector<double> &w = state.displacement;
    double stiffest        = properties.bond_stiffness * place.back();
    for (unsigned int j = 0; j + 1 < n; ++j)
      stiffest =
        std::max(stiffest, properties.axial_stiffness / segment_length(j));

    std::vector<double> residual(n), diagonal(n), off(n - 1);
    const auto unbalanced = [&](const Response &r) {
      double largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        {
          residual[i] = r.bond[i] + (i + 1 < n ? r.segment[i] : 0.) -
                        (i > 0 ? r.segment[i - 1] : 0.);
          if (i == 0)
            residual[i] -= jack >= 0. ? jack : r.plate;
          largest = std::max(largest, std::abs(residual[i]));
        }
      return largest;
    };

    Response response = respond(w, rock);
    double size       = unbalanced(response);
    for (unsigned int iteration = 0; iteration < maximum_iterations;
         ++iteration)
      {
        double scale = std::max(0., jack), farthest = 0.;
        for (unsigned int i = 0; i < n; ++i)
          farthest = std::max({farthest, std::abs(w[i]), std::abs(rock[i])});
        for (const double force : response.segment)
          scale = std::max(scale, std::abs(force));
        for (const double force : response.bond)
          scale = std::max(scale, std::abs(force));
        if (size <= tolerance * scale + round_off * stiffest * farthest)
          break;
        for (unsigned int i = 0; i < n; ++i)
          diagonal[i] = std::max(response.bond_stiffness[i],
                                 plastic_stiffness * bond_stiffness_of(i)) +
                        least_stiffness * stiffest;
        if (jack < 0.)
          diagonal[0] += response.plate_stiffness;
        for (unsigned int j = 0; j + 1 < n; ++j)
          {
            const double stiffness =
              std::max(response.segment_stiffness[j],
                       state.is_broken[j] != 0.
                         ? 0.
                         : plastic_stiffness * properties.axial_stiffness /
                             segment_length(j));
            diagonal[j] += stiffness;
            diagonal[j + 1] += stiffness;
            off[j] = -stiffness;
          }
        std::vector<double> change = residual;
        solve_tridiagonal(diagonal, off, change);
        // the energy is convex: go on where it still falls at the end of the
        // way, else to its least value on the way
        const std::vector<double> before = w;
        const auto slope_at              = [&](const double share) {
          for (unsigned int i = 0; i < n; ++i)
            w[i] = before[i] + share * change[i];
          response     = respond(w, rock);
          size         = unbalanced(response);
          double slope = 0.;
          for (unsigned int i = 0; i < n; ++i)
            slope += residual[i] * change[i];
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
    commit(rock, response);
  }



  void
  BoltChain::commit(const std::vector<double> &rock, const Response &response)
  {
    const unsigned int n         = n_nodes();
    const std::vector<double> &w = state.displacement;
    for (unsigned int i = 0; i < n; ++i)
      {
        rock_force[i] = -response.bond[i];
        if (!is_held[i] || bonded_length[i] == 0.)
          continue;
        const double slip =
          rock[i] - w[i] -
          response.bond[i] / (properties.bond_stiffness * bonded_length[i]);
        if (response.bond_stiffness[i] == 0.)
          {
            state.dissipated += response.bond[i] * (slip - state.slip[i]);
            state.slip[i] = slip;
          }
      }
    for (unsigned int j = 0; j + 1 < n; ++j)
      {
        segment_force[j]     = response.segment[j];
        const double stretch = w[j + 1] - w[j];
        if (state.is_broken[j] == 0. && response.segment_stiffness[j] == 0.)
          {
            const double elongation = stretch - response.segment[j] *
                                                  segment_length(j) /
                                                  properties.axial_stiffness;
            state.dissipated +=
              response.segment[j] * (elongation - state.elongation[j]);
            state.elongation[j] = elongation;
          }
        // what it had stored goes with it
        if (properties.rupture_strain > 0. && state.is_broken[j] == 0. &&
            stretch > properties.rupture_strain * segment_length(j))
          {
            state.is_broken[j] = 1.;
            state.dissipated += 0.5 * response.segment[j] *
                                response.segment[j] * segment_length(j) /
                                properties.axial_stiffness;
            segment_force[j] = 0.;
          }
      }
    present_plate_force = response.plate;
    rock_force[0] += response.plate;
    if (response.plate >= properties.plate_strength && response.plate > 0. &&
        response.plate_stiffness == 0.)
      {
        const double shift =
          w[0] - rock[0] - response.plate / properties.plate_stiffness;
        state.dissipated += response.plate * (shift - state.plate_shift);
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
    double energy = 0.;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (bonded_length[i] > 0.)
        {
          const double force =
            rock_force[i] - (i == 0 ? present_plate_force : 0.);
          energy += 0.5 * force * force /
                    (properties.bond_stiffness * bonded_length[i]);
        }
    for (unsigned int j = 0; j + 1 < n_nodes(); ++j)
      energy += 0.5 * segment_force[j] * segment_force[j] * segment_length(j) /
                properties.axial_stiffness;
    if (properties.plate_strength > 0.)
      energy += 0.5 * present_plate_force * present_plate_force /
                properties.plate_stiffness;
    return energy;
  }



  std::vector<double>
  BoltChain::stiffness_bound() const
  {
    std::vector<double> bound(n_nodes(), 0.);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      bound[i] = properties.bond_stiffness * bonded_length[i];
    // in a row with the first segment
    if (properties.plate_strength > 0.)
      bound[0] += properties.plate_stiffness;
    const double first = properties.axial_stiffness / segment_length(0);
    if (bound[0] > 0.)
      bound[0] = bound[0] * first / (bound[0] + first);
    return bound;
  }



  BoltChain::Capacity
  BoltChain::capacity(const double s) const
  {
    double head = is_held[0] ? properties.plate_strength : 0., anchor = 0.;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (is_held[i])
        {
          // the stretch of this node, as far as it is grouted, on either side
          const double begin =
            std::max(properties.free_length,
                     i > 0 ? 0.5 * (place[i - 1] + place[i]) : place[0]);
          const double end =
            i + 1 < n_nodes() ? 0.5 * (place[i] + place[i + 1]) : place[i];
          head +=
            properties.bond_strength * std::max(0., std::min(end, s) - begin);
          anchor +=
            properties.bond_strength * std::max(0., end - std::max(begin, s));
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

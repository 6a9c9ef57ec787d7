// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/bolt_chain.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Stiffness of a plate for which the scene gives none, over that of a
     * metre of the bar. */
    constexpr double plate_over_bar = 10.;

    /** Grout of a node up to which it is round-off, over that between the
     * middles of its segments. */
    constexpr double least_grout = 1e-9;
  } // namespace



  BoltChain::BoltChain(const BoltProperties &properties,
                       const std::vector<double> &places)
    : properties(properties)
    , n(places.size())
    , numbers(n * n_rows, 0.)
    , place(places)
    , bond_is_elastic(n, true)
    , segment_is_elastic(n, true)
  {
    stiffest = properties.bond_stiffness * place.back();
    for (unsigned int j = 0; j + 1 < n; ++j)
      stiffest = std::max(stiffest, whole_stiffness(j));
    set_ground(std::vector<bool>(n, true), std::vector<bool>(n - 1, false));
  }



  double
  BoltChain::grouted_length(const unsigned int i,
                            const double from,
                            const double to) const
  {
    return std::max(0.,
                    std::min(grout[i][1], to) -
                      std::max({grout[i][0], from, properties.free_length}));
  }



  void
  BoltChain::set_ground(const std::vector<bool> &is_held,
                        const std::vector<bool> &are_cut,
                        const std::vector<GroutRange> &ranges)
  {
    grout = ranges;
    if (grout.empty())
      for (unsigned int i = 0; i < n; ++i)
        grout.push_back({{0.5 * (place[i > 0 ? i - 1 : 0] + place[i]),
                          0.5 * (place[i] + place[i + 1 < n ? i + 1 : i])}});
    for (unsigned int i = 0; i < n; ++i)
      {
        const double length =
          is_held[i] ? grouted_length(i, 0., place.back()) : 0.;
        row(bond_stiffness)[i] = properties.bond_stiffness * length;
        row(bond_strength)[i]  = properties.bond_strength * length;
      }
    is_cut           = are_cut;
    is_plate_held    = is_held[0] && properties.plate_strength > 0.;
    is_plate_elastic = is_plate_elastic && is_plate_held;
    set_segments();
  }



  void
  BoltChain::set_segments()
  {
    for (unsigned int j = 0; j + 1 < n; ++j)
      row(segment_stiffness)[j] = is_parted_at(j) ? 0. : whole_stiffness(j);
    is_factorised = false;
    stretches.clear();
    for (unsigned int j = 0; j + 1 < n; ++j)
      if (j > 0 && has_equal_forces_at(j))
        stretches.back()[1] = j + 1;
      else
        stretches.push_back({{j, j + 1}});
  }



  bool
  BoltChain::has_equal_forces_at(const unsigned int i) const
  {
    const double grouted = row(bond_stiffness)[i],
                 whole   = 0.5 * properties.bond_stiffness *
                         (place[i + 1] - place[i - 1]);
    return grouted <= least_grout * whole && !is_parted_at(i - 1) &&
           !is_parted_at(i);
  }



  double
  BoltChain::stiffest_segment() const
  {
    double stiffest_one = 0.;
    for (unsigned int j = 0; j + 1 < n; ++j)
      stiffest_one = std::max(stiffest_one, whole_stiffness(j));
    return stiffest_one;
  }



  bool
  BoltChain::is_broken() const
  {
    return std::any_of(row(broken), row(broken) + n, [](const double b) {
      return b != 0.;
    });
  }



  bool
  BoltChain::is_cut_between(const double a, const double b) const
  {
    const auto [first, end] = segments_between(a, b);
    return std::any_of(is_cut.begin() + first,
                       is_cut.begin() + end,
                       [](const bool is) { return is; });
  }



  bool
  BoltChain::is_broken_between(const double a, const double b) const
  {
    const auto [first, end] = segments_between(a, b);
    return std::any_of(row(broken) + first,
                       row(broken) + end,
                       [](const double is) { return is != 0.; });
  }



  double
  BoltChain::stored_energy() const
  {
    double energy  = 0.;
    const auto add = [&](const Row forces, const Row stiffness) {
      for (unsigned int i = 0; i < n; ++i)
        if (row(stiffness)[i] > 0.)
          energy += 0.5 * row(forces)[i] * row(forces)[i] / row(stiffness)[i];
    };
    add(bond_force, bond_stiffness);
    add(axial_force, segment_stiffness);
    if (properties.plate_strength > 0.)
      energy +=
        0.5 * plate_on_rock * plate_on_rock / properties.plate_stiffness;
    return energy;
  }



  std::vector<double>
  BoltChain::stiffness_bound() const
  {
    std::vector<double> bound(row(bond_stiffness), row(bond_stiffness) + n);
    if (is_plate_held)
      bound[0] += properties.plate_stiffness;
    // in a row with the first segment
    if (bound[0] > 0.)
      bound[0] *= whole_stiffness(0) / (bound[0] + whole_stiffness(0));
    return bound;
  }



  unsigned int
  BoltChain::segment_at(const double s) const
  {
    return std::upper_bound(place.begin() + 1, place.end() - 1, s) -
           place.begin() - 1;
  }



  BoltChain::Capacity
  BoltChain::capacity(const double s) const
  {
    // of the piece between cuts and breaks that s is on
    const unsigned int at = segment_at(s);
    if (is_parted_at(at))
      return {0., Capacity::Limit::yield};
    unsigned int first = at, last = at + 1;
    while (first > 0 && !is_parted_at(first - 1))
      --first;
    while (last + 1 < n && !is_parted_at(last))
      ++last;
    double head = is_plate_held && first == 0 ? properties.plate_strength : 0.,
           anchor = 0.;
    for (unsigned int i = first; i <= last; ++i)
      if (row(bond_strength)[i] > 0.)
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



  void
  BoltChain::remember(std::vector<double> &list) const
  {
    list.insert(list.end(), row(displacement), row(n_remembered));
    list.insert(list.end(),
                {plate_shift,
                 plate_on_rock,
                 dissipated,
                 is_plate_elastic ? 1. : 0.,
                 was_elastic ? 1. : 0.});
  }



  void
  BoltChain::recall(const std::vector<double> &list, std::size_t &at)
  {
    for (unsigned int i = 0; i < n_remembered * n; ++i)
      numbers[i] = list.at(at++);
    plate_shift      = list.at(at++);
    plate_on_rock    = list.at(at++);
    dissipated       = list.at(at++);
    is_plate_elastic = list.at(at++) != 0.;
    was_elastic      = list.at(at++) != 0.;
    if (was_elastic)
      {
        std::fill(bond_is_elastic.begin(), bond_is_elastic.end(), true);
        std::fill(segment_is_elastic.begin(), segment_is_elastic.end(), true);
      }
    set_segments();
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

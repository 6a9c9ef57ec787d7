// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/bolts.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Stiffness of a plate for which the scene gives none, over that of a
     * metre of the bar. */
    constexpr double plate_over_bar = 10.;

    /** How far beside a joint a bolt's sides are bound to the rock, over its
     * length. */
    constexpr double beside = 1e-6;

    /** Numbers at the front of a list, taken off it. */
    class Reader
    {
    public:
      explicit Reader(const std::vector<double> &numbers)
        : numbers(numbers)
      {}

      double
      next()
      {
        return numbers.at(at++);
      }

      void
      next(std::vector<double> &list)
      {
        for (double &value : list)
          value = next();
      }

      template <int dim>
      void
      next(Tensor<1, dim> &vector)
      {
        for (unsigned int d = 0; d < dim; ++d)
          vector[d] = next();
      }

    private:
      const std::vector<double> &numbers;
      std::size_t at = 0;
    };

    template <int dim>
    void
    append(std::vector<double> &numbers, const Tensor<1, dim> &vector)
    {
      for (unsigned int d = 0; d < dim; ++d)
        numbers.push_back(vector[d]);
    }

    void
    append(std::vector<double> &numbers, const std::vector<double> &list)
    {
      numbers.insert(numbers.end(), list.begin(), list.end());
    }
  } // namespace



  /** Where a bolt crosses a joint. */
  template <int dim>
  struct Bolts<dim>::Dowel
  {
    BoltCrossing<dim> crossing;
    Binding near, far;
    Tensor<1, dim> reference; ///< far less near displacement at the start [m]
    Tensor<1, dim> slip;      ///< plastic, across the bolt [m]
    Tensor<1, dim> force;     ///< on the near side [N]
    double dissipated = 0.;   ///< [J]
  };



  /** A bolt in the rock. */
  template <int dim>
  struct Bolts<dim>::Member
  {
    BoltChain chain;
    double share;              ///< of a bolt, per metre in 2D
    unsigned int stage_number; ///< of its installation
    bool is_installed = false;
    std::vector<Binding> bindings;         ///< of its nodes
    std::vector<Tensor<1, dim>> reference; ///< of the rock when installed [m]
    std::vector<Dowel> dowels;
  };



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



  template <int dim>
  Bolts<dim>::Bolts(const Scene<dim> &scene,
                    const SplitMesh<dim> &split,
                    const Numbering<dim> &numbering)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , bolts(split.bolts)
  {
    for (const Bolt<dim> &bolt : bolts)
      {
        const BoltSet<dim> &set   = *scene.bolts[bolt.set];
        const unsigned int number = scene.stage_number(set.stage);
        Member member{BoltChain(properties_of(set), bolt.places),
                      set.share(),
                      number,
                      false,
                      std::vector<Binding>(bolt.places.size()),
                      std::vector<Tensor<1, dim>>(bolt.places.size()),
                      {}};
        for (const BoltCrossing<dim> &crossing : bolt.crossings)
          {
            member.dowels.emplace_back();
            member.dowels.back().crossing = crossing;
          }
        members.push_back(std::move(member));
      }
  }



  template <int dim>
  Bolts<dim>::~Bolts() = default;



  template <int dim>
  typename Bolts<dim>::Binding
  Bolts<dim>::bind(const CellLocator<dim> &rock, const Point<dim> &point) const
  {
    Binding binding;
    const auto place = rock.find(point);
    if (!place)
      return binding;
    binding.is_held     = true;
    const auto &corners = split.mesh.cells[place->cell];
    for (unsigned int v = 0; v < corners.size(); ++v)
      split.for_each_carrier(
        corners[v], [&](const unsigned int carrier, const double weight) {
          if (numbering.is_owned(carrier) && place->weight[v] != 0.)
            binding.carriers.emplace_back(numbering.local_node(carrier),
                                          weight * place->weight[v]);
        });
    return binding;
  }



  template <int dim>
  void
  Bolts<dim>::take_ground(const Ground<dim> &ground)
  {
    stage_number = ground.stage_number;
    if (std::none_of(members.begin(), members.end(), [&](const Member &m) {
          return m.stage_number <= stage_number;
        }))
      return;
    const CellLocator<dim> rock = locate_rock(ground);
    for (unsigned int b = 0; b < bolts.size(); ++b)
      {
        Member &member = members[b];
        if (member.stage_number > stage_number)
          {
            member.is_installed = false;
            continue;
          }
        std::vector<bool> is_held;
        for (unsigned int i = 0; i < member.bindings.size(); ++i)
          {
            member.bindings[i] = bind(rock, bolts[b].at(bolts[b].places[i]));
            is_held.push_back(member.bindings[i].is_held);
          }
        member.chain.set_ground(is_held);
        const double aside = beside * bolts[b].length();
        for (Dowel &dowel : member.dowels)
          {
            const double place = dowel.crossing.place;
            dowel.near         = bind(rock, bolts[b].at(place - aside));
            dowel.far          = bind(rock, bolts[b].at(place + aside));
          }
      }
  }



  template <int dim>
  template <typename Action>
  void
  Bolts<dim>::for_each_binding(const Action &action) const
  {
    for (const Member &member : members)
      if (member.stage_number <= stage_number)
        {
          for (const Binding &binding : member.bindings)
            action(binding);
          for (const Dowel &dowel : member.dowels)
            {
              action(dowel.near);
              action(dowel.far);
            }
        }
  }



  template <int dim>
  std::vector<unsigned int>
  Bolts<dim>::nodes() const
  {
    std::vector<unsigned int> list;
    for_each_binding([&](const Binding &binding) {
      for (const auto &[node, weight] : binding.carriers)
        list.push_back(node);
    });
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  Bolts<dim>::rock_displacements(const std::vector<double> &displacement) const
  {
    std::vector<double> sums;
    for_each_binding([&](const Binding &binding) {
      Tensor<1, dim> u;
      for (const auto &[node, weight] : binding.carriers)
        for (unsigned int d = 0; d < dim; ++d)
          u[d] += weight * displacement[dim * node + d];
      append(sums, u);
    });
    numbering.communicator.sum_lists(sums);
    std::vector<Tensor<1, dim>> result(sums.size() / dim);
    Reader numbers(sums);
    for (Tensor<1, dim> &u : result)
      numbers.next(u);
    return result;
  }



  template <int dim>
  void
  Bolts<dim>::put_force(const Binding &binding,
                        const Tensor<1, dim> &force,
                        std::vector<double> &forces) const
  {
    // against what it does to the rock
    for (const auto &[node, weight] : binding.carriers)
      for (unsigned int d = 0; d < dim; ++d)
        forces[dim * node + d] -= weight * force[d];
  }



  template <int dim>
  void
  Bolts<dim>::add_force(const std::vector<double> &displacement,
                        std::vector<double> &force)
  {
    present         = rock_displacements(displacement);
    unsigned int at = 0;
    for (unsigned int b = 0; b < bolts.size(); ++b)
      {
        Member &member = members[b];
        if (member.stage_number > stage_number)
          continue;
        const Tensor<1, dim> way  = bolts[b].direction();
        const unsigned int n      = member.bindings.size();
        const unsigned int dowels = at + n;
        if (!member.is_installed)
          {
            std::copy_n(present.begin() + at, n, member.reference.begin());
            for (unsigned int k = 0; k < member.dowels.size(); ++k)
              member.dowels[k].reference =
                present[dowels + 2 * k + 1] - present[dowels + 2 * k];
            member.is_installed = true;
            member.chain.tension();
          }
        std::vector<double> rock(n);
        for (unsigned int i = 0; i < n; ++i)
          rock[i] = (present[at + i] - member.reference[i]) * way;
        member.chain.follow(rock);
        for (unsigned int i = 0; i < n; ++i)
          put_force(member.bindings[i],
                    member.share * member.chain.force_on_rock()[i] * way,
                    force);
        const BoltProperties &material = member.chain.material();
        for (unsigned int k = 0; k < member.dowels.size(); ++k)
          {
            Dowel &dowel = member.dowels[k];
            if (!dowel.near.is_held || !dowel.far.is_held)
              continue;
            Tensor<1, dim> on_near;
            if (material.dowel_strength > 0.)
              {
                Tensor<1, dim> jump = present[dowels + 2 * k + 1] -
                                      present[dowels + 2 * k] - dowel.reference;
                jump -= (jump * way) * way;
                dowel.force = material.dowel_stiffness * (jump - dowel.slip);
                const double size = dowel.force.norm();
                if (size > material.dowel_strength)
                  {
                    dowel.force *= material.dowel_strength / size;
                    const Tensor<1, dim> slip =
                      jump - dowel.force / material.dowel_stiffness;
                    dowel.dissipated += dowel.force * (slip - dowel.slip);
                    dowel.slip = slip;
                  }
                on_near = dowel.force;
              }
            const auto &[near_block, far_block] = dowel.crossing.block;
            const double left = reduction.share_between(near_block,
                                                        far_block,
                                                        dowel.crossing.joint);
            if (left != 1.)
              {
                const auto &places = bolts[b].places;
                const unsigned int segment =
                  std::upper_bound(places.begin() + 1,
                                   places.end() - 1,
                                   dowel.crossing.place) -
                  places.begin() - 1;
                Tensor<1, dim> along =
                  member.chain.axial_force()[segment] * way + on_near;
                const Tensor<1, dim> &normal = dowel.crossing.normal;
                along -= (along * normal) * normal;
                on_near -= (1. - left) * along;
              }
            put_force(dowel.near, member.share * on_near, force);
            put_force(dowel.far, -member.share * on_near, force);
          }
        at = dowels + 2 * member.dowels.size();
      }
  }



  template <int dim>
  void
  Bolts<dim>::reduce_strength(const StrengthReduction &new_reduction)
  {
    if (scene.safety.bolt_convention == BoltConvention::passive)
      reduction = new_reduction;
  }



  template <int dim>
  StepBound
  Bolts<dim>::step_bound(const std::vector<double> &inverse_mass) const
  {
    // rows of the stiffness: weights of a point add up to one
    std::vector<double> row(numbering.n_owned(), 0.);
    for (unsigned int b = 0; b < bolts.size(); ++b)
      {
        const Member &member = members[b];
        if (member.stage_number > stage_number)
          continue;
        const Tensor<1, dim> way = bolts[b].direction();
        double sum = 0., largest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            sum += std::abs(way[d]);
            largest = std::max(largest, std::abs(way[d]));
          }
        const auto add = [&](const Binding &binding, const double stiffness) {
          for (const auto &[node, weight] : binding.carriers)
            row[node] += member.share * stiffness * weight;
        };
        const std::vector<double> bound = member.chain.stiffness_bound();
        for (unsigned int i = 0; i < bound.size(); ++i)
          add(member.bindings[i], bound[i] * sum * largest);
        if (member.chain.material().dowel_strength > 0.)
          for (const Dowel &dowel : member.dowels)
            for (const Binding *side : {&dowel.near, &dowel.far})
              add(*side, 2. * member.chain.material().dowel_stiffness);
      }
    StepBound bound;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      bound.squared_frequency =
        std::max(bound.squared_frequency, row[node] * inverse_mass[node]);
    bound.squared_frequency =
      numbering.communicator.max(bound.squared_frequency);
    return bound;
  }



  template <int dim>
  double
  Bolts<dim>::stored_energy(const std::vector<double> &) const
  {
    if (!numbering.communicator.is_root())
      return 0.;
    double energy = 0.;
    for (const Member &member : members)
      if (member.is_installed)
        {
          energy += member.share * member.chain.stored_energy();
          for (const Dowel &dowel : member.dowels)
            if (dowel.force.norm() > 0.)
              energy += 0.5 * member.share * dowel.force.norm_square() /
                        member.chain.material().dowel_stiffness;
        }
    return energy;
  }



  template <int dim>
  double
  Bolts<dim>::plastic_work() const
  {
    if (!numbering.communicator.is_root())
      return 0.;
    double work = 0.;
    for (const Member &member : members)
      if (member.is_installed)
        {
          work += member.share * member.chain.state.dissipated;
          for (const Dowel &dowel : member.dowels)
            work += member.share * dowel.dissipated;
        }
    return work;
  }



  template <int dim>
  ForceElementState
  Bolts<dim>::remember() const
  {
    ForceElementState state{name(), {}, {}};
    std::vector<double> &numbers = state.numbers;
    for (const Member &member : members)
      {
        numbers.push_back(member.is_installed ? 1. : 0.);
        for (const Tensor<1, dim> &u : member.reference)
          append(numbers, u);
        const BoltChainState &chain = member.chain.state;
        for (const auto *list : {&chain.displacement,
                                 &chain.slip,
                                 &chain.elongation,
                                 &chain.is_broken})
          append(numbers, *list);
        numbers.push_back(chain.plate_shift);
        numbers.push_back(chain.dissipated);
        for (const Dowel &dowel : member.dowels)
          {
            append(numbers, dowel.reference);
            append(numbers, dowel.slip);
            append(numbers, dowel.force);
            numbers.push_back(dowel.dissipated);
          }
      }
    return state;
  }



  template <int dim>
  void
  Bolts<dim>::recall(const ForceElementState &state)
  {
    Reader numbers(state.numbers);
    for (Member &member : members)
      {
        member.is_installed = numbers.next() != 0.;
        for (Tensor<1, dim> &u : member.reference)
          numbers.next(u);
        BoltChainState &chain = member.chain.state;
        for (auto *list : {&chain.displacement,
                           &chain.slip,
                           &chain.elongation,
                           &chain.is_broken})
          numbers.next(*list);
        chain.plate_shift = numbers.next();
        chain.dissipated  = numbers.next();
        for (Dowel &dowel : member.dowels)
          {
            numbers.next(dowel.reference);
            numbers.next(dowel.slip);
            numbers.next(dowel.force);
            dowel.dissipated = numbers.next();
          }
      }
  }



  template <int dim>
  std::vector<BoltReport<dim>>
  Bolts<dim>::report() const
  {
    std::vector<BoltReport<dim>> reports;
    unsigned int at = 0;
    for (unsigned int b = 0; b < bolts.size(); ++b)
      {
        const Member &member = members[b];
        if (member.stage_number > stage_number)
          continue;
        const unsigned int first = at;
        at += member.bindings.size() + 2 * member.dowels.size();
        if (!member.is_installed)
          continue;
        BoltReport<dim> result;
        result.bolt        = &bolts[b];
        result.axial_force = member.chain.axial_force();
        result.slip        = member.chain.state.slip;
        for (unsigned int i = 0; i < member.bindings.size(); ++i)
          result.displacement.push_back(
            present.size() > first + i ? present[first + i] : Tensor<1, dim>());
        result.plate_force = member.chain.plate_force();
        result.n_crossings = member.dowels.size();
        double least       = 1e300;
        for (const Dowel &dowel : member.dowels)
          {
            result.dowel_force =
              std::max(result.dowel_force, dowel.force.norm());
            const auto capacity = member.chain.capacity(dowel.crossing.place);
            if (capacity.force < least)
              result.limit = describe(capacity.limit);
            least = std::min(least, capacity.force);
          }
        for (const double broken : member.chain.state.is_broken)
          result.is_broken = result.is_broken || broken != 0.;
        reports.push_back(result);
      }
    return reports;
  }

  template class Bolts<2>;
  template class Bolts<3>;
  template BoltProperties properties_of(const BoltSet<2> &);
  template BoltProperties properties_of(const BoltSet<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/bolt_in_rock.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    append(std::vector<double> &numbers, const Tensor<1, dim> &vector)
    {
      numbers.insert(numbers.end(), vector.begin_raw(), vector.end_raw());
    }

    template <int dim>
    void
    take(const std::vector<double> &numbers,
         std::size_t &at,
         Tensor<1, dim> &vector)
    {
      for (unsigned int d = 0; d < dim; ++d)
        vector[d] = numbers.at(at++);
    }
  } // namespace



  template <int dim>
  BoltInRock<dim>::BoltInRock(const Bolt<dim> &bolt, const Scene<dim> &scene)
    : bolt(bolt)
    , way(bolt.direction())
    , share(scene.bolts[bolt.set]->share())
    , first_stage(scene.stage_number(scene.bolts[bolt.set]->stage))
    , chain(properties_of(*scene.bolts[bolt.set]), bolt.places)
    , reference(bolt.places.size())
    , dowels(bolt.crossings.size())
  {}



  template <int dim>
  void
  BoltInRock<dim>::take_ground(const Ground<dim> &ground,
                               const Numbering<dim> &numbering)
  {
    bindings.clear();
    for (const CellPoint<dim> &point : bolt.rock)
      bindings.emplace_back(point, ground, numbering);
    for (const BoltCrossing<dim> &crossing : bolt.crossings)
      for (const CellPoint<dim> &side : crossing.side)
        bindings.emplace_back(side, ground, numbering);
    forces.assign(bindings.size(), Tensor<1, dim>());
    chain.set_ground(list_held_nodes(bolt, ground));
  }



  template <int dim>
  void
  BoltInRock<dim>::install(const Tensor<1, dim> *displacement)
  {
    std::copy_n(displacement, reference.size(), reference.begin());
    const Tensor<1, dim> *side = displacement + reference.size();
    for (Dowel &dowel : dowels)
      {
        dowel.reference = side[1] - side[0];
        side += 2;
      }
    chain.tension();
    was_installed = true;
  }



  template <int dim>
  void
  BoltInRock<dim>::follow(Dowel &dowel, Tensor<1, dim> jump) const
  {
    const BoltProperties &material = chain.material();
    jump -= dowel.reference;
    jump -= (jump * way) * way;
    dowel.force       = material.dowel_stiffness * (jump - dowel.slip);
    const double size = dowel.force.norm();
    if (size <= material.dowel_strength)
      return;
    dowel.force *= material.dowel_strength / size;
    const Tensor<1, dim> slip = jump - dowel.force / material.dowel_stiffness;
    dowel.dissipated += dowel.force * (slip - dowel.slip);
    dowel.slip = slip;
  }



  template <int dim>
  double
  BoltInRock<dim>::axial_force_at(const BoltCrossing<dim> &crossing) const
  {
    const auto node = std::upper_bound(bolt.places.begin() + 1,
                                       bolt.places.end() - 1,
                                       crossing.place);
    return chain.axial_force()[node - bolt.places.begin() - 1];
  }



  template <int dim>
  const std::vector<Tensor<1, dim>> &
  BoltInRock<dim>::respond(const Tensor<1, dim> *displacement,
                           const StrengthReduction &reduction)
  {
    if (!was_installed)
      install(displacement);
    const unsigned int n = reference.size();
    std::vector<double> along(n);
    for (unsigned int i = 0; i < n; ++i)
      along[i] = (displacement[i] - reference[i]) * way;
    chain.follow(along);
    for (unsigned int i = 0; i < n; ++i)
      forces[i] = share * chain.force_on_rock()[i] * way;

    for (unsigned int k = 0; k < dowels.size(); ++k)
      {
        const unsigned int before = n + 2 * k, behind = before + 1;
        Dowel &dowel = dowels[k];
        dowel.force  = Tensor<1, dim>();
        if (!bindings[before].is_held || !bindings[behind].is_held)
          continue;
        if (chain.material().dowel_strength > 0.)
          follow(dowel, displacement[behind] - displacement[before]);
        Tensor<1, dim> on_rock = dowel.force;

        const BoltCrossing<dim> &crossing = bolt.crossings[k];
        const double left = reduction.share_between(crossing.block[0],
                                                    crossing.block[1],
                                                    crossing.joint);
        if (left != 1.)
          {
            Tensor<1, dim> tangent = axial_force_at(crossing) * way + on_rock;
            tangent -= (tangent * crossing.normal) * crossing.normal;
            on_rock -= (1. - left) * tangent;
          }
        forces[before] = share * on_rock;
        forces[behind] = -share * on_rock;
      }
    return forces;
  }



  template <int dim>
  double
  BoltInRock<dim>::row_sum(const Tensor<1, dim> &way)
  {
    double sum = 0., largest = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        sum += std::abs(way[d]);
        largest = std::max(largest, std::abs(way[d]));
      }
    return sum * largest;
  }



  template <int dim>
  double
  BoltInRock<dim>::stored_energy() const
  {
    double energy = chain.stored_energy();
    if (chain.material().dowel_strength > 0.)
      for (const Dowel &dowel : dowels)
        energy +=
          0.5 * dowel.force.norm_square() / chain.material().dowel_stiffness;
    return share * energy;
  }



  template <int dim>
  double
  BoltInRock<dim>::dissipated_energy() const
  {
    double energy = chain.state.dissipated;
    for (const Dowel &dowel : dowels)
      energy += dowel.dissipated;
    return share * energy;
  }



  template <int dim>
  void
  BoltInRock<dim>::remember(std::vector<double> &numbers) const
  {
    numbers.push_back(was_installed ? 1. : 0.);
    for (const Tensor<1, dim> &u : reference)
      append(numbers, u);
    const BoltChainState &state = chain.state;
    for (const auto *list : {&state.displacement,
                             &state.slip,
                             &state.elongation,
                             &state.is_broken,
                             &state.bond_force,
                             &state.axial_force})
      numbers.insert(numbers.end(), list->begin(), list->end());
    numbers.push_back(state.plate_shift);
    numbers.push_back(state.plate_force);
    numbers.push_back(state.dissipated);
    for (const Dowel &dowel : dowels)
      {
        append(numbers, dowel.reference);
        append(numbers, dowel.slip);
        append(numbers, dowel.force);
        numbers.push_back(dowel.dissipated);
      }
  }



  template <int dim>
  void
  BoltInRock<dim>::recall(const std::vector<double> &numbers, std::size_t &at)
  {
    was_installed = numbers.at(at++) != 0.;
    for (Tensor<1, dim> &u : reference)
      take(numbers, at, u);
    BoltChainState &state = chain.state;
    for (auto *list : {&state.displacement,
                       &state.slip,
                       &state.elongation,
                       &state.is_broken,
                       &state.bond_force,
                       &state.axial_force})
      for (double &value : *list)
        value = numbers.at(at++);
    state.plate_shift = numbers.at(at++);
    state.plate_force = numbers.at(at++);
    state.dissipated  = numbers.at(at++);
    for (Dowel &dowel : dowels)
      {
        take(numbers, at, dowel.reference);
        take(numbers, at, dowel.slip);
        take(numbers, at, dowel.force);
        dowel.dissipated = numbers.at(at++);
      }
  }



  template <int dim>
  BoltReport<dim>
  BoltInRock<dim>::report() const
  {
    BoltReport<dim> result;
    result.bolt        = &bolt;
    result.axial_force = chain.axial_force();
    result.slip        = chain.state.slip;
    result.plate_force = chain.plate_force();
    for (const Dowel &dowel : dowels)
      result.dowel_force = std::max(result.dowel_force, dowel.force.norm());
    double least = std::numeric_limits<double>::max();
    for (const BoltCrossing<dim> &crossing : bolt.crossings)
      {
        const auto capacity = chain.capacity(crossing.place);
        if (capacity.force < least)
          result.limit = describe(capacity.limit);
        least = std::min(least, capacity.force);
      }
    result.is_broken = std::any_of(chain.state.is_broken.begin(),
                                   chain.state.is_broken.end(),
                                   [](const double b) { return b != 0.; });
    return result;
  }

  template class BoltInRock<2>;
  template class BoltInRock<3>;
} // namespace Keyblock

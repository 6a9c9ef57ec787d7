// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/bolt_in_rock.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    Tensor<1, dim>
    vector_at(const double *first)
    {
      Tensor<1, dim> vector;
      std::copy_n(first, dim, vector.begin_raw());
      return vector;
    }

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
    const BoltRemains remains = find_remains(bolt, ground);
    chain.set_ground(remains.is_held, remains.is_cut, remains.grout);
    cut_length = remains.cut_length;
    for (unsigned int k = 0; k < dowels.size(); ++k)
      {
        const unsigned int before = n_nodes() + 2 * k;
        dowels[k].is_there =
          bindings[before].is_held && bindings[before + 1].is_held &&
          !chain.is_cut_between(bolt.crossings[k].begin, bolt.crossings[k].end);
      }
  }



  template <int dim>
  void
  BoltInRock<dim>::get_jumps(const std::vector<double> &displacement,
                             double *jump) const
  {
    const RockBinding<dim> *side = bindings.data() + n_nodes();
    for (unsigned int k = 0; k < n_jumps(); ++k, side += 2)
      {
        const Tensor<1, dim> part =
          side[1].part_of(displacement) - side[0].part_of(displacement);
        jump = std::copy(part.begin_raw(), part.end_raw(), jump);
      }
  }



  template <int dim>
  void
  BoltInRock<dim>::install(const double *along, const double *jump)
  {
    std::copy_n(along, n_nodes(), reference.begin());
    for (unsigned int k = 0; k < n_jumps(); ++k)
      dowels[k].reference = vector_at<dim>(jump + dim * k);
    chain.tension();
    was_installed = true;
  }



  template <int dim>
  Tensor<1, dim>
  BoltInRock<dim>::shear_of(const Dowel &dowel, Tensor<1, dim> jump) const
  {
    jump -= dowel.reference;
    return jump - (jump * way) * way;
  }



  template <int dim>
  void
  BoltInRock<dim>::follow(Dowel &dowel, const Tensor<1, dim> &shear) const
  {
    const BoltProperties &material = chain.material();
    const Tensor<1, dim> before    = dowel.force;
    dowel.force       = material.dowel_stiffness * (shear - dowel.slip);
    const double size = dowel.force.norm();
    if (size <= material.dowel_strength)
      return;
    dowel.force *= material.dowel_strength / size;
    const Tensor<1, dim> slip = shear - dowel.force / material.dowel_stiffness;
    // by the mean of the forces before and behind, as all work of a step
    dowel.dissipated += 0.5 * (before + dowel.force) * (slip - dowel.slip);
    dowel.slip = slip;
  }



  template <int dim>
  void
  BoltInRock<dim>::respond(double *along, const double *jump)
  {
    if (!was_installed)
      install(along, jump);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      along[i] -= reference[i];
    chain.follow(along);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      along[i] = share * chain.force_on_rock(i);
    for (unsigned int k = 0; k < n_jumps(); ++k)
      follow_at_joint(k, vector_at<dim>(jump + dim * k));
  }



  template <int dim>
  void
  BoltInRock<dim>::follow_at_joint(const unsigned int k,
                                   const Tensor<1, dim> &jump)
  {
    Dowel &dowel               = dowels[k];
    const Tensor<1, dim> shear = shear_of(dowel, jump);
    if (is_whole_at_joint(k))
      {
        if (!bolt.crossings[k].is_void())
          follow(dowel, shear);
        return;
      }
    // what breaks dissipates what it has stored and what the rock does in the
    // step against half its force, what is dug takes it along
    if (dowel.is_there)
      dowel.dissipated += 0.5 * dowel.force * (shear - dowel.slip);
    dowel.force = Tensor<1, dim>();
  }



  template <int dim>
  void
  BoltInRock<dim>::subtract_at_joints(const PassiveSupport<dim> &trial,
                                      std::vector<double> &forces) const
  {
    for (unsigned int k = 0; k < dowels.size(); ++k)
      {
        if (!is_whole_at_joint(k))
          continue;
        Tensor<1, dim> on_rock            = dowels[k].force;
        const BoltCrossing<dim> &crossing = bolt.crossings[k];
        if (!trial.is_whole())
          on_rock -= trial.taken(
            chain.axial_force_of(chain.segment_at(crossing.middle())) * way +
              on_rock,
            crossing.block,
            crossing.joint,
            crossing.normal);
        subtract_at_joint(k, on_rock, forces);
      }
  }



  template <int dim>
  void
  BoltInRock<dim>::subtract_at_joint(const unsigned int k,
                                     const Tensor<1, dim> &on_first,
                                     std::vector<double> &forces) const
  {
    const RockBinding<dim> *side = bindings.data() + n_nodes() + 2 * k;
    side[0].add(-share * on_first, forces);
    side[1].add(share * on_first, forces);
  }



  template <int dim>
  void
  BoltInRock<dim>::multiply(double *along,
                            const double *jump,
                            std::vector<double> &forces)
  {
    chain.multiply(along);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      along[i] *= share;
    for (unsigned int k = 0; k < n_jumps(); ++k)
      if (is_whole_at_joint(k) && !bolt.crossings[k].is_void())
        {
          Tensor<1, dim> across = vector_at<dim>(jump + dim * k);
          across -= (across * way) * way;
          subtract_at_joint(k,
                            chain.material().dowel_stiffness * across,
                            forces);
        }
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
  BoltInRock<dim>::stored_energy_of(const Dowel &dowel) const
  {
    return chain.material().dowel_strength > 0.
             ? 0.5 * dowel.force.norm_square() /
                 chain.material().dowel_stiffness
             : 0.;
  }



  template <int dim>
  double
  BoltInRock<dim>::stored_energy() const
  {
    double energy = chain.stored_energy();
    for (const Dowel &dowel : dowels)
      energy += stored_energy_of(dowel);
    return share * energy;
  }



  template <int dim>
  double
  BoltInRock<dim>::dissipated_energy() const
  {
    double energy = chain.dissipated_energy();
    for (const Dowel &dowel : dowels)
      energy += dowel.dissipated;
    return share * energy;
  }



  template <int dim>
  std::vector<bool>
  BoltInRock<dim>::broken_segments() const
  {
    std::vector<bool> broken;
    for (unsigned int j = 0; j + 1 < n_nodes(); ++j)
      broken.push_back(chain.is_broken_at(j));
    return broken;
  }



  template <int dim>
  void
  BoltInRock<dim>::remember(std::vector<double> &numbers) const
  {
    numbers.push_back(was_installed ? 1. : 0.);
    numbers.insert(numbers.end(), reference.begin(), reference.end());
    chain.remember(numbers);
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
    for (double &u : reference)
      u = numbers.at(at++);
    chain.recall(numbers, at);
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
    result.bolt = &bolt;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      result.slip.push_back(chain.slip_of(i));
    for (unsigned int j = 0; j + 1 < n_nodes(); ++j)
      {
        result.axial_force.push_back(chain.axial_force_of(j));
        result.is_cut.push_back(chain.is_cut_at(j));
      }
    result.cut_length  = cut_length;
    result.plate_force = chain.plate_force();
    for (const Dowel &dowel : dowels)
      result.dowel_force = std::max(result.dowel_force, dowel.force.norm());
    double least = std::numeric_limits<double>::max();
    for (const BoltCrossing<dim> &crossing : bolt.crossings)
      {
        if (chain.is_parted_between(crossing.begin, crossing.end))
          continue;
        const auto capacity = chain.capacity(crossing.middle());
        if (capacity.force < least)
          result.limit = !bindings.front().is_held &&
                             capacity.limit == BoltChain::Capacity::Limit::head
                           ? "bond inside"
                           : describe(capacity.limit);
        least = std::min(least, capacity.force);
      }
    result.is_broken = chain.is_broken();
    if (result.is_broken &&
        (least == 0. || least == std::numeric_limits<double>::max()))
      result.limit = "broken";
    return result;
  }

  template class BoltInRock<2>;
  template class BoltInRock<3>;
} // namespace Keyblock

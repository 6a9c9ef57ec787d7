// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact as monitors and output see it: states and sums over all ranks.
#include <keyblock/contact.h>
#include <keyblock/mpi.h>

#include <cmath>

namespace Keyblock
{
  template <int dim>
  std::vector<PairState<dim>>
  Contact<dim>::gather_pair_states() const
  {
    constexpr unsigned int n = dim + 3;
    std::vector<double> packed(n * state.size(), 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      if (is_primary(group_of_pair[p]))
        {
          for (int d = 0; d < dim; ++d)
            packed[n * p + d] = state[p].impulse[d];
          packed[n * p + dim]     = static_cast<int>(state[p].status);
          packed[n * p + dim + 1] = state[p].is_intact;
          packed[n * p + dim + 2] = state[p].is_converted;
        }
    dealii::Utilities::MPI::sum(packed, world(), packed);
    std::vector<PairState<dim>> result(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        for (int d = 0; d < dim; ++d)
          result[p].impulse[d] = packed[n * p + d];
        result[p].status =
          static_cast<ContactStatus>(std::lround(packed[n * p + dim]));
        result[p].is_intact    = packed[n * p + dim + 1] > 0.5;
        result[p].is_converted = packed[n * p + dim + 2] > 0.5;
        result[p].is_welded    = state[p].is_welded;
      }
    return result;
  }



  namespace
  {
    template <int dim>
    void
    add_point(JointSums<dim> &sums,
              Vector<dim> &moment,
              const Vector<dim> &impulse,
              const Vector<dim> &normal,
              const ContactStatus status,
              const Vector<dim> &place,
              const double kick)
    {
      const double pressure = dot<dim>(impulse, normal) / kick;
      sums.normal += pressure;
      for (int d = 0; d < dim; ++d)
        {
          sums.force[d] += impulse[d] / kick;
          moment[d] += pressure * place[d];
        }
      sums.n_open += status == ContactStatus::open;
      sums.n_sliding += status == ContactStatus::sliding;
      sums.n_sticking += status == ContactStatus::sticking;
    }

    template <int dim>
    JointSums<dim>
    finish_sums(const JointSums<dim> &sums, const Vector<dim> &moment)
    {
      std::vector<double> values = {sums.normal,
                                    double(sums.n_open),
                                    double(sums.n_sliding),
                                    double(sums.n_sticking),
                                    double(sums.n_intact)};
      values.insert(values.end(), sums.force.begin(), sums.force.end());
      values.insert(values.end(), moment.begin(), moment.end());
      dealii::Utilities::MPI::sum(values, world(), values);
      JointSums<dim> total;
      total.normal     = values[0];
      total.n_open     = std::lround(values[1]);
      total.n_sliding  = std::lround(values[2]);
      total.n_sticking = std::lround(values[3]);
      total.n_intact   = std::lround(values[4]);
      for (int d = 0; d < dim; ++d)
        {
          total.force[d] = values[5 + d];
          if (total.normal != 0.)
            total.center[d] = values[5 + dim + d] / total.normal;
        }
      return total;
    }
  } // namespace



  template <int dim>
  JointSums<dim>
  Contact<dim>::sum_over_joint(const unsigned int joint) const
  {
    JointSums<dim> sums;
    Vector<dim> moment{};
    const double kick = last_kick > 0. ? last_kick : 1.;
    for (unsigned int p = 0; p < state.size(); ++p)
      if ((joint == none || interface.pairs[p].joint == joint) &&
          !state[p].is_converted && is_primary(group_of_pair[p]))
        {
          const unsigned int node =
            numbering.local_node(interface.pairs[p].plus);
          Vector<dim> place;
          for (int d = 0; d < dim; ++d)
            place[d] = fields.reference[dim * node + d] +
                       fields.displacement[dim * node + d];
          add_point<dim>(sums,
                         moment,
                         state[p].impulse,
                         normal[p],
                         state[p].status,
                         place,
                         kick);
          sums.n_intact += state[p].is_intact;
        }
    if (is_root())
      for (const SurfaceContact<dim> &contact : contacts)
        if (joint == none || contact.joint == joint)
          {
            // the slave's side has the positive weights
            const ContactPoint<dim> &point = contact.point;
            Vector<dim> place{};
            for (int k = 0; k < point.n_nodes; ++k)
              for (int d = 0; d < dim; ++d)
                place[d] += std::max(0., point.weight[k]) *
                            slot_position[dim * point.node[k] + d];
            add_point<dim>(sums,
                           moment,
                           contact.point.impulse,
                           contact.point.normal,
                           contact.point.status,
                           place,
                           kick);
          }
    JointSums<dim> total = finish_sums<dim>(sums, moment);
    if (joint != none)
      {
        const Tensor<1, dim> n = scene.joints[joint]->normal();
        Vector<dim> normal_of_joint;
        for (int d = 0; d < dim; ++d)
          normal_of_joint[d] = n[d];
        total.shear =
          norm<dim>(add<dim>(total.force,
                             -dot<dim>(total.force, normal_of_joint),
                             normal_of_joint));
      }
    return total;
  }



  template <int dim>
  JointSums<dim>
  Contact<dim>::count_points() const
  {
    return sum_over_joint(none);
  }

  template std::vector<PairState<2>> Contact<2>::gather_pair_states() const;
  template std::vector<PairState<3>> Contact<3>::gather_pair_states() const;
  template JointSums<2> Contact<2>::sum_over_joint(const unsigned int) const;
  template JointSums<3> Contact<3>::sum_over_joint(const unsigned int) const;
  template JointSums<2> Contact<2>::count_points() const;
  template JointSums<3> Contact<3>::count_points() const;
} // namespace Keyblock

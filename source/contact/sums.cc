// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact as monitors and output see it: states and sums over all ranks.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>

#include <cmath>

namespace Keyblock
{
  template <int dim>
  std::vector<PairState<dim>>
  Contact<dim>::gather_pair_states() const
  {
    const unsigned int n = dim + 4 + (has_memory ? 3 : 0);
    std::vector<double> packed(n * state.size(), 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      if (is_primary(group_of_pair[p]))
        {
          for (int d = 0; d < dim; ++d)
            packed[n * p + d] = state[p].impulse[d];
          packed[n * p + dim]     = static_cast<int>(state[p].status);
          packed[n * p + dim + 1] = state[p].is_intact;
          packed[n * p + dim + 2] = state[p].is_converted;
          packed[n * p + dim + 3] = state[p].has_opened;
          if (has_memory)
            {
              packed[n * p + dim + 4] = state[p].history.slip;
              packed[n * p + dim + 5] = state[p].history.dilation;
              packed[n * p + dim + 6] = state[p].history.damage;
            }
        }
    sum_lists(packed);
    std::vector<PairState<dim>> result(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        for (int d = 0; d < dim; ++d)
          result[p].impulse[d] = packed[n * p + d];
        result[p].status =
          static_cast<ContactStatus>(std::lround(packed[n * p + dim]));
        result[p].is_intact    = packed[n * p + dim + 1] > 0.5;
        result[p].is_converted = packed[n * p + dim + 2] > 0.5;
        result[p].has_opened   = packed[n * p + dim + 3] > 0.5;
        if (has_memory)
          result[p].history = {packed[n * p + dim + 4],
                               packed[n * p + dim + 5],
                               packed[n * p + dim + 6]};
        result[p].is_welded    = state[p].is_welded;
        result[p].is_removed   = state[p].is_removed;
        result[p].bend_shear   = state[p].bend_shear;
        result[p].bend_tension = state[p].bend_tension;
        result[p].weld_shear   = state[p].weld_shear;
        result[p].weld_tension = state[p].weld_tension;
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
      sum_lists(values);
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

    /** Size of the part of @p force across @p normal [N]. */
    template <int dim>
    double
    shear_of(const Vector<dim> &force, const Tensor<1, dim> &normal)
    {
      Vector<dim> n;
      for (int d = 0; d < dim; ++d)
        n[d] = normal[d];
      return norm<dim>(add<dim>(force, -dot<dim>(force, n), n));
    }

    /** Sums over several joints; the centre is weighted by pressure. */
    template <int dim>
    JointSums<dim>
    add_up(const std::vector<JointSums<dim>> &sums)
    {
      JointSums<dim> total;
      Vector<dim> moment{};
      for (const JointSums<dim> &sum : sums)
        {
          total.normal += sum.normal;
          total.shear += sum.shear;
          total.force = add<dim>(total.force, 1., sum.force);
          moment      = add<dim>(moment, sum.normal, sum.center);
          total.n_open += sum.n_open;
          total.n_sliding += sum.n_sliding;
          total.n_sticking += sum.n_sticking;
          total.n_intact += sum.n_intact;
        }
      if (total.normal != 0.)
        for (int d = 0; d < dim; ++d)
          total.center[d] = moment[d] / total.normal;
      return total;
    }
  } // namespace



  template <int dim>
  JointSums<dim>
  Contact<dim>::sum_over_joints(const std::vector<unsigned int> &joints) const
  {
    // one sum for each joint, or one for all points
    std::vector<JointSums<dim>> sums(std::max<std::size_t>(joints.size(), 1));
    std::vector<Vector<dim>> moment(sums.size());
    std::vector<unsigned int> sum_of_joint(scene.joints.size(), none);
    for (unsigned int i = 0; i < joints.size(); ++i)
      sum_of_joint[joints[i]] = i;
    const auto find_sum = [&](const unsigned int joint) {
      return joints.empty() ? 0 : joint == none ? none : sum_of_joint[joint];
    };
    const double kick = last_kick > 0. ? last_kick : 1.;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const unsigned int i = find_sum(interface.pairs[p].joint);
        if (i == none || state[p].is_converted || state[p].is_removed ||
            !is_primary(group_of_pair[p]))
          continue;
        const unsigned int node = numbering.local_node(interface.pairs[p].plus);
        Vector<dim> place;
        for (int d = 0; d < dim; ++d)
          place[d] = fields.reference[dim * node + d] +
                     fields.displacement[dim * node + d];
        add_point<dim>(sums[i],
                       moment[i],
                       state[p].impulse,
                       normal[p],
                       state[p].status,
                       place,
                       kick);
        sums[i].n_intact += state[p].is_intact;
      }
    if (is_root())
      for (const SurfaceContact<dim> &contact : contacts)
        {
          const unsigned int i = find_sum(contact.joint);
          if (i == none)
            continue;
          // the slave's side has the positive weights
          const ContactPoint<dim> &point = contact.point;
          // forces are those on the joint's plus side
          double side = 1.;
          if (contact.joint != none)
            {
              const Tensor<1, dim> n = scene.joints[contact.joint]->normal();
              double cosine          = 0.;
              for (int d = 0; d < dim; ++d)
                cosine += n[d] * point.normal[d];
              side = cosine < 0. ? -1. : 1.;
            }
          Vector<dim> place{};
          for (int k = 0; k < point.n_nodes; ++k)
            for (int d = 0; d < dim; ++d)
              place[d] += std::max(0., point.weight[k]) *
                          slot_position[dim * point.node[k] + d];
          add_point<dim>(sums[i],
                         moment[i],
                         add<dim>(Vector<dim>{}, side, point.impulse),
                         add<dim>(Vector<dim>{}, side, point.normal),
                         point.status,
                         place,
                         kick);
        }
    for (unsigned int i = 0; i < sums.size(); ++i)
      {
        sums[i] = finish_sums<dim>(sums[i], moment[i]);
        if (!joints.empty())
          sums[i].shear =
            shear_of<dim>(sums[i].force, scene.joints[joints[i]]->normal());
      }
    return sums.size() == 1 ? sums[0] : add_up<dim>(sums);
  }



  template <int dim>
  std::vector<JointSums<dim>>
  Contact<dim>::sum_over_block(const unsigned int block) const
  {
    // pressure and force on the block, by joint; the last is for no joint
    const double kick = present_kick();
    std::vector<JointSums<dim>> sums(scene.joints.size() + 1);
    std::vector<Vector<dim>> moment(sums.size());
    const auto add = [&](const unsigned int joint,
                         const Vector<dim> &impulse,
                         const Vector<dim> &outward,
                         const ContactStatus status) {
      const unsigned int j = joint == none ? scene.joints.size() : joint;
      add_point<dim>(
        sums[j], moment[j], impulse, outward, status, Vector<dim>{}, kick);
    };
    const auto reversed = [](const Vector<dim> &v) {
      return Keyblock::add<dim>(Vector<dim>{}, -1., v);
    };
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const auto sides = blocks_of_pair(p);
        if (sides[0] == sides[1] || state[p].is_converted ||
            state[p].is_removed || !is_primary(group_of_pair[p]))
          continue;
        if (sides[0] == block || sides[1] == block)
          sums[interface.pairs[p].joint].n_intact += state[p].is_intact;
        if (sides[1] == block)
          add(interface.pairs[p].joint,
              state[p].impulse,
              normal[p],
              state[p].status);
        else if (sides[0] == block)
          add(interface.pairs[p].joint,
              reversed(state[p].impulse),
              reversed(normal[p]),
              state[p].status);
      }
    if (is_root())
      for (const SurfaceContact<dim> &contact : contacts)
        {
          const unsigned int slave       = search.block_of_slot[contact.slave];
          const ContactPoint<dim> &point = contact.point;
          if (slave == contact.master_block)
            continue;
          if (slave == block)
            add(contact.joint, point.impulse, point.normal, point.status);
          else if (contact.master_block == block)
            add(contact.joint,
                reversed(point.impulse),
                reversed(point.normal),
                point.status);
        }
    for (unsigned int j = 0; j < sums.size(); ++j)
      sums[j] = finish_sums<dim>(sums[j], moment[j]);
    return sums;
  }



  template <int dim>
  Vector<dim>
  Contact<dim>::mean_slip(const unsigned int block) const
  {
    std::vector<double> sums(dim + 1, 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const auto sides = blocks_of_pair(p);
        if (sides[0] == sides[1] || state[p].is_removed ||
            !is_primary(group_of_pair[p]) ||
            (sides[0] != block && sides[1] != block))
          continue;
        const unsigned int plus = numbering.local_node(interface.pairs[p].plus);
        const unsigned int minus =
          numbering.local_node(interface.pairs[p].minus);
        const double area =
          (sides[1] == block ? 1. : -1.) * interface.pairs[p].area;
        for (int d = 0; d < dim; ++d)
          sums[d] += area * (fields.displacement[dim * plus + d] -
                             fields.displacement[dim * minus + d]);
        sums[dim] += interface.pairs[p].area;
      }
    sum_lists(sums);
    Vector<dim> slip{};
    if (sums[dim] > 0.)
      for (int d = 0; d < dim; ++d)
        slip[d] = sums[d] / sums[dim];
    return slip;
  }



  template <int dim>
  JointSums<dim>
  Contact<dim>::count_points() const
  {
    return sum_over_joints({});
  }



  template <int dim>
  unsigned int
  Contact<dim>::count_through_rock() const
  {
    // share of the skin that is no depth
    constexpr double shallow = 0.02;
    return std::count_if(contacts.begin(),
                         contacts.end(),
                         [&](const SurfaceContact<dim> &contact) {
                           const unsigned int block =
                             search.block_of_slot[contact.slave];
                           return !contact.is_ridge &&
                                  block == contact.master_block &&
                                  search.start_distance(contact.slave,
                                                        contact.face) <
                                    -shallow * search.skin();
                         });
  }



  template <int dim>
  JointSums<dim>
  Contact<dim>::count_pairs() const
  {
    std::vector<double> n(2, 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      if (is_primary(group_of_pair[p]) && !state[p].is_converted &&
          !state[p].is_removed)
        {
          n[0] += state[p].status == ContactStatus::open;
          n[1] += state[p].status == ContactStatus::sliding;
        }
    sum_lists(n);
    JointSums<dim> sums;
    sums.n_open    = n[0];
    sums.n_sliding = n[1];
    return sums;
  }



  template <int dim>
  std::vector<double>
  Contact<dim>::list_sliding_blocks() const
  {
    std::vector<double> is_sliding(is_removed_block.size(), 0.);
    const auto mark = [&](const unsigned int block) {
      if (block != none && !is_removed_block[block])
        is_sliding[block] = 1.;
    };
    for (unsigned int p = 0; p < state.size(); ++p)
      if (state[p].status == ContactStatus::sliding)
        for (const unsigned int block : blocks_of_pair(p))
          mark(block);
    for (const SurfaceContact<dim> &contact : contacts)
      if (contact.point.status == ContactStatus::sliding)
        {
          mark(contact.master_block);
          mark(search.block_of_slot[contact.slave]);
        }
    max_lists(is_sliding);
    return is_sliding;
  }

  template std::vector<double> Contact<2>::list_sliding_blocks() const;
  template std::vector<double> Contact<3>::list_sliding_blocks() const;
  template std::vector<PairState<2>> Contact<2>::gather_pair_states() const;
  template std::vector<PairState<3>> Contact<3>::gather_pair_states() const;
  template JointSums<2>
  Contact<2>::sum_over_joints(const std::vector<unsigned int> &) const;
  template JointSums<3>
  Contact<3>::sum_over_joints(const std::vector<unsigned int> &) const;
  template std::vector<JointSums<2>>
  Contact<2>::sum_over_block(const unsigned int) const;
  template std::vector<JointSums<3>>
  Contact<3>::sum_over_block(const unsigned int) const;
  template Vector<2> Contact<2>::mean_slip(const unsigned int) const;
  template Vector<3> Contact<3>::mean_slip(const unsigned int) const;
  template unsigned int Contact<2>::count_through_rock() const;
  template unsigned int Contact<3>::count_through_rock() const;
  template JointSums<2> Contact<2>::count_pairs() const;
  template JointSums<3> Contact<3>::count_pairs() const;
  template JointSums<2> Contact<2>::count_points() const;
  template JointSums<3> Contact<3>::count_points() const;
} // namespace Keyblock

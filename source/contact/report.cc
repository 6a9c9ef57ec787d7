// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/report.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
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

    /** Sum each of @p sums over the ranks, all at once, and find the centres.
     */
    template <int dim>
    void
    finish_sums(const Communicator &communicator,
                const std::vector<Vector<dim>> &moment,
                std::vector<JointSums<dim>> &sums)
    {
      std::vector<double> values;
      for (unsigned int i = 0; i < sums.size(); ++i)
        {
          values.insert(values.end(),
                        {sums[i].normal,
                         double(sums[i].n_open),
                         double(sums[i].n_sliding),
                         double(sums[i].n_sticking),
                         double(sums[i].n_intact)});
          values.insert(values.end(),
                        sums[i].force.begin(),
                        sums[i].force.end());
          values.insert(values.end(), moment[i].begin(), moment[i].end());
        }
      communicator.sum_lists(values);
      const double *of_one = values.data();
      for (JointSums<dim> &total : sums)
        {
          total.normal     = of_one[0];
          total.n_open     = std::lround(of_one[1]);
          total.n_sliding  = std::lround(of_one[2]);
          total.n_sticking = std::lround(of_one[3]);
          total.n_intact   = std::lround(of_one[4]);
          for (int d = 0; d < dim; ++d)
            {
              total.force[d] = of_one[5 + d];
              if (total.normal != 0.)
                total.center[d] = of_one[5 + dim + d] / total.normal;
            }
          of_one += 5 + 2 * dim;
        }
    }

    /** Size of the part of a vector across @p normal. */
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
  ContactReport<dim>::ContactReport(const ContactSearch<dim> &search,
                                    const PairTopology<dim> &topology,
                                    const SurfaceNodes<dim> &nodes,
                                    const Fields<dim> &fields,
                                    const ContactMemory<dim> &memory)
    : search(search)
    , topology(topology)
    , scene(topology.scene)
    , interface(topology.interface)
    , surface(topology.surface)
    , nodes(nodes)
    , fields(fields)
    , memory(memory)
  {}



  template <int dim>
  void
  ContactReport<dim>::add_pairs(const std::vector<unsigned int> &sum_of_joint,
                                std::vector<JointSums<dim>> &sums,
                                std::vector<Vector<dim>> &moment) const
  {
    const double kick = memory.present_kick();
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const unsigned int i = sum_of_joint[interface.pairs[p].joint];
        if (i == none || memory.state[p].is_converted ||
            memory.state[p].is_removed ||
            !topology.is_primary(topology.group_of_pair[p]))
          continue;
        const unsigned int node =
          topology.numbering.local_node(interface.pairs[p].plus);
        Vector<dim> place;
        for (int d = 0; d < dim; ++d)
          place[d] = fields.reference[dim * node + d] +
                     fields.displacement[dim * node + d];
        add_point<dim>(sums[i],
                       moment[i],
                       memory.state[p].impulse,
                       memory.normal[p],
                       memory.state[p].status,
                       place,
                       kick);
        sums[i].n_intact += memory.state[p].is_intact;
      }
  }



  template <int dim>
  void
  ContactReport<dim>::add_surface_contacts(
    const std::vector<unsigned int> &sum_of_joint,
    std::vector<JointSums<dim>> &sums,
    std::vector<Vector<dim>> &moment) const
  {
    if (!topology.numbering.communicator.is_root())
      return;
    const double kick = memory.present_kick();
    for (const SurfaceContact<dim> &contact : memory.contacts)
      {
        const unsigned int i = contact.joint == none
                                 ? sum_of_joint.back()
                                 : sum_of_joint[contact.joint];
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
                        nodes.position[dim * point.node[k] + d];
        add_point<dim>(sums[i],
                       moment[i],
                       add<dim>(Vector<dim>{}, side, point.impulse),
                       add<dim>(Vector<dim>{}, side, point.normal),
                       point.status,
                       place,
                       kick);
      }
  }


  template <int dim>
  JointSums<dim>
  ContactReport<dim>::sum_over_joints(
    const std::vector<unsigned int> &joints) const
  {
    // one sum for each joint; of all of them, the last for faces on no joint
    const bool is_all = joints.empty();
    std::vector<unsigned int> sum_of_joint(scene.joints.size() + 1, none);
    if (is_all)
      std::iota(sum_of_joint.begin(), sum_of_joint.end(), 0);
    for (unsigned int i = 0; i < joints.size(); ++i)
      sum_of_joint[joints[i]] = i;
    std::vector<JointSums<dim>> sums(is_all ? sum_of_joint.size()
                                            : joints.size());
    std::vector<Vector<dim>> moment(sums.size());
    add_pairs(sum_of_joint, sums, moment);
    add_surface_contacts(sum_of_joint, sums, moment);
    finish_sums<dim>(topology.numbering.communicator, moment, sums);
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      if (sum_of_joint[j] != none)
        {
          JointSums<dim> &sum = sums[sum_of_joint[j]];
          sum.shear = shear_of<dim>(sum.force, scene.joints[j]->normal());
        }
    return sums.size() == 1 ? sums[0] : add_up<dim>(sums);
  }



  template <int dim>
  JointMotion
  ContactReport<dim>::mean_motion(const std::vector<unsigned int> &joints) const
  {
    // of each joint the area and area times u(plus) - u(minus)
    std::vector<double> sums((1 + dim) * joints.size(), 0.);
    std::vector<unsigned int> place(scene.joints.size(), none);
    for (unsigned int i = 0; i < joints.size(); ++i)
      place[joints[i]] = (1 + dim) * i;
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (place[pair.joint] == none || memory.state[p].is_removed ||
            !topology.is_primary(topology.group_of_pair[p]))
          continue;
        double *const sum        = &sums[place[pair.joint]];
        const unsigned int plus  = topology.numbering.local_node(pair.plus),
                           minus = topology.numbering.local_node(pair.minus);
        sum[0] += pair.area;
        for (int d = 0; d < dim; ++d)
          sum[1 + d] += pair.area * (fields.displacement[dim * plus + d] -
                                     fields.displacement[dim * minus + d]);
      }
    topology.numbering.communicator.sum_lists(sums);
    JointMotion mean;
    double area = 0.;
    for (unsigned int i = 0; i < joints.size(); ++i)
      {
        const double *const sum = &sums[(1 + dim) * i];
        Vector<dim> jump;
        std::copy(sum + 1, sum + 1 + dim, jump.begin());
        const Tensor<1, dim> normal = scene.joints[joints[i]]->normal();
        for (int d = 0; d < dim; ++d)
          mean.opening += jump[d] * normal[d];
        mean.slip += shear_of<dim>(jump, normal);
        area += sum[0];
      }
    if (area > 0.)
      {
        mean.opening /= area;
        mean.slip /= area;
      }
    return mean;
  }



  template <int dim>
  Overlap<dim>
  ContactReport<dim>::largest_overlap() const
  {
    return find_largest_overlap<dim>(search,
                                     nodes.gather_positions(),
                                     memory.is_removed_block);
  }


  template <int dim>
  std::vector<JointSums<dim>>
  ContactReport<dim>::sum_over_block(const unsigned int block) const
  {
    // pressure and force on the block, by joint; the last is for no joint
    const double kick = memory.present_kick();
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
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const auto sides = topology.blocks_of_pair(p);
        if (sides[0] == sides[1] || memory.state[p].is_converted ||
            memory.state[p].is_removed ||
            !topology.is_primary(topology.group_of_pair[p]))
          continue;
        if (sides[0] == block || sides[1] == block)
          sums[interface.pairs[p].joint].n_intact += memory.state[p].is_intact;
        if (sides[1] == block)
          add(interface.pairs[p].joint,
              memory.state[p].impulse,
              memory.normal[p],
              memory.state[p].status);
        else if (sides[0] == block)
          add(interface.pairs[p].joint,
              reversed(memory.state[p].impulse),
              reversed(memory.normal[p]),
              memory.state[p].status);
      }
    if (topology.numbering.communicator.is_root())
      for (const SurfaceContact<dim> &contact : memory.contacts)
        {
          const unsigned int slave       = surface.block_of_node[contact.slave];
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
    finish_sums<dim>(topology.numbering.communicator, moment, sums);
    return sums;
  }



  template <int dim>
  Vector<dim>
  ContactReport<dim>::mean_slip(const unsigned int block) const
  {
    std::vector<double> sums(dim + 1, 0.);
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const auto sides = topology.blocks_of_pair(p);
        if (sides[0] == sides[1] || memory.state[p].is_removed ||
            !topology.is_primary(topology.group_of_pair[p]) ||
            (sides[0] != block && sides[1] != block))
          continue;
        const unsigned int plus =
          topology.numbering.local_node(interface.pairs[p].plus);
        const unsigned int minus =
          topology.numbering.local_node(interface.pairs[p].minus);
        const double area =
          (sides[1] == block ? 1. : -1.) * interface.pairs[p].area;
        for (int d = 0; d < dim; ++d)
          sums[d] += area * (fields.displacement[dim * plus + d] -
                             fields.displacement[dim * minus + d]);
        sums[dim] += interface.pairs[p].area;
      }
    topology.numbering.communicator.sum_lists(sums);
    Vector<dim> slip{};
    if (sums[dim] > 0.)
      for (int d = 0; d < dim; ++d)
        slip[d] = sums[d] / sums[dim];
    return slip;
  }



  template <int dim>
  JointSums<dim>
  ContactReport<dim>::count_points() const
  {
    return sum_over_joints({});
  }



  template class ContactReport<2>;
  template class ContactReport<3>;
} // namespace Keyblock

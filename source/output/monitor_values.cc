// SPDX-License-Identifier: LGPL-2.1-or-later
// What monitors measure of blocks, joints, supports and nodes.
#include <keyblock/output/monitors.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  void
  Monitors<dim>::sample_block(const unsigned int block,
                              std::vector<double> &row)
  {
    // mass, m u, m v, m x, m X, then with centres known: rotation, momentum
    std::vector<double> sums(1 + 4 * dim, 0.);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (block_of_node[node] == block)
        {
          const double m = fields.mass[node];
          sums[0] += m;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int i = dim * node + d;
              sums[1 + d] += m * (fields.displacement[i] - baseline[i]);
              sums[1 + dim + d] += m * fields.velocity[i];
              sums[1 + 2 * dim + d] +=
                m * (fields.reference[i] + fields.displacement[i]);
              sums[1 + 3 * dim + d] += m * fields.reference[i];
            }
        }
    numbering.communicator.sum_lists(sums);
    if (sums[0] > 0.)
      for (unsigned int i = 1; i < sums.size(); ++i)
        sums[i] /= sums[0];
    std::vector<double> spin(3, 0.);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (block_of_node[node] == block)
        {
          double X[2], x[2], v[2], u[2];
          for (unsigned int k = 0; k < 2; ++k)
            {
              // in 3D about the y axis: the plane of x and z
              const unsigned int d = (dim == 3 && k == 1) ? 2 : k;
              const unsigned int i = dim * node + d;
              u[k]                 = fields.displacement[i];
              X[k] = fields.reference[i] - sums[1 + 3 * dim + d];
              x[k] = fields.reference[i] + u[k] - sums[1 + 2 * dim + d];
              v[k] = fields.velocity[i];
            }
          const double m = fields.mass[node];
          spin[0] += m * (X[0] * x[1] - X[1] * x[0]);
          spin[1] += m * (X[0] * x[0] + X[1] * x[1]);
          spin[2] += m * (x[0] * v[1] - x[1] * v[0]);
        }
    numbering.communicator.sum_lists(spin);
    for (unsigned int i = 1; i < 1 + 2 * dim; ++i)
      row.push_back(sums[i]);
    row.push_back(std::atan2(spin[0], spin[1]));
    row.push_back(spin[2]);

    // mean over the volume of the in-plane (2D) or full (3D) trace
    double trace = 0., volume = 0.;
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int mesh_cell = cells.mesh_cell[c];
        if (split.block_of_cell[mesh_cell] != block)
          continue;
        const double share = cell_volume[mesh_cell] / (1 << dim);
        for (int q = 0; q < (1 << dim); ++q)
          {
            const auto stress = cells.stress_at(c, q);
            for (unsigned int d = 0; d < dim; ++d)
              trace += share * stress[d];
          }
        volume += cell_volume[mesh_cell];
      }
    std::vector<double> mean = {trace, volume};
    numbering.communicator.sum_lists(mean);
    row.push_back(mean[1] > 0. ? mean[0] / mean[1] : 0.);
  }



  template <int dim>
  void
  Monitors<dim>::sample_block_motion(const unsigned int block,
                                     std::vector<double> &row)
  {
    const Interface<dim> &interface = split.interface;
    double largest                  = 0.;
    std::vector<double> sums(3, 0.); // area, of slip and of opening
    for (unsigned int g = 0; g < interface.n_groups() && contact; ++g)
      {
        // the owner of a group's first vertex has all of its nodes
        if (!numbering.is_owned(
              interface.group_vertices[interface.group_begin[g]]))
          continue;
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          {
            const Pair<dim> &pair    = interface.pairs[p];
            const unsigned int minus = numbering.local_node(pair.minus),
                               plus  = numbering.local_node(pair.plus);
            const bool is_of_block =
              block_of_node[minus] == block || block_of_node[plus] == block;
            if (!is_of_block || block_of_node[minus] == block_of_node[plus] ||
                contact->remember().state[p].is_removed)
              continue;
            Vector<dim> jump;
            for (unsigned int d = 0; d < dim; ++d)
              jump[d] = fields.displacement[dim * plus + d] -
                        fields.displacement[dim * minus + d];
            const Vector<dim> &normal = contact->remember().normal[p];
            const double opening      = dot<dim>(jump, normal);
            const double slip = norm<dim>(add<dim>(jump, -opening, normal));
            largest           = std::max(largest, slip);
            sums[0] += pair.area;
            sums[1] += pair.area * slip;
            sums[2] += pair.area * opening;
          }
      }
    numbering.communicator.sum_lists(sums);
    row.push_back(sums[0] > 0. ? sums[1] / sums[0] : 0.);
    row.push_back(numbering.communicator.max(largest));
    row.push_back(sums[0] > 0. ? sums[2] / sums[0] : 0.);
  }



  template <int dim>
  void
  Monitors<dim>::sample_joint(const Monitor<dim> &monitor,
                              std::vector<double> &row)
  {
    const bool is_all = monitor.joint == "all";
    std::vector<unsigned int> joints;
    if (is_all)
      for (unsigned int j = 0; j < scene.joints.size(); ++j)
        joints.push_back(j);
    else
      joints = scene.joints_called(monitor.joint);
    JointSums<dim> sums;
    // all: what meets faces on no joint, too
    if (contact && (is_all || !joints.empty()))
      sums = contact->report().sum_over_joints(
        is_all ? std::vector<unsigned int>() : joints);
    row.push_back(sums.normal);
    row.push_back(sums.shear);
    row.insert(row.end(), sums.force.begin(), sums.force.end());
    row.insert(row.end(), sums.center.begin(), sums.center.end());
    for (const unsigned int n :
         {sums.n_open, sums.n_sliding, sums.n_sticking, sums.n_intact})
      row.push_back(n);
    JointMotion motion;
    if (contact && !joints.empty())
      motion = contact->report().mean_motion(joints);
    row.push_back(motion.slip);
    row.push_back(motion.opening);
  }



  template <int dim>
  void
  Monitors<dim>::sample_support(const Monitor<dim> &monitor,
                                std::vector<double> &row)
  {
    // what holds the nodes of the support against all other forces
    std::vector<double> sums(dim, 0.);
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      if (scene.supports[s]->name == monitor.support)
        for (const unsigned int node : fields.nodes_of_support[s])
          for (unsigned int d = 0; d < dim; ++d)
            sums[d] += fields.internal_force[dim * node + d] -
                       fields.load[dim * node + d] -
                       fields.contact_force[dim * node + d];
    numbering.communicator.sum_lists(sums);
    row.insert(row.end(), sums.begin(), sums.end());
  }



  template <int dim>
  void
  Monitors<dim>::sample_nodes(const std::vector<unsigned int> &nodes,
                              std::vector<double> &row)
  {
    std::vector<double> total(1, 0.);
    for (const unsigned int node : nodes)
      total[0] += fields.mass[node];
    numbering.communicator.sum_lists(total);
    const bool has_mass = total[0] > 0.;
    // mass, m u, m v
    std::vector<double> sums(1 + 2 * dim, 0.);
    for (const unsigned int node : nodes)
      {
        const double m = has_mass ? fields.mass[node] : 1.;
        sums[0] += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = dim * node + d;
            sums[1 + d] += m * (fields.displacement[i] - baseline[i]);
            sums[1 + dim + d] += m * fields.velocity[i];
          }
      }
    numbering.communicator.sum_lists(sums);
    for (unsigned int i = 1; i < sums.size(); ++i)
      row.push_back(sums[i] / sums[0]);
  }

  template void Monitors<2>::sample_block(const unsigned int,
                                          std::vector<double> &);
  template void Monitors<3>::sample_block(const unsigned int,
                                          std::vector<double> &);
  template void Monitors<2>::sample_block_motion(const unsigned int,
                                                 std::vector<double> &);
  template void Monitors<3>::sample_block_motion(const unsigned int,
                                                 std::vector<double> &);
  template void Monitors<2>::sample_joint(const Monitor<2> &,
                                          std::vector<double> &);
  template void Monitors<3>::sample_joint(const Monitor<3> &,
                                          std::vector<double> &);
  template void Monitors<2>::sample_support(const Monitor<2> &,
                                            std::vector<double> &);
  template void Monitors<3>::sample_support(const Monitor<3> &,
                                            std::vector<double> &);
  template void Monitors<2>::sample_nodes(const std::vector<unsigned int> &,
                                          std::vector<double> &);
  template void Monitors<3>::sample_nodes(const std::vector<unsigned int> &,
                                          std::vector<double> &);
} // namespace Keyblock

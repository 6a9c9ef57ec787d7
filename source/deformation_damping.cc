// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/deformation_damping.h>
#include <keyblock/mpi.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    using Space = dealii::Tensor<1, 3>;

    /** Damping ratio from which on the lowest mode is damped critically [-]. */
    constexpr double full_ratio = 0.3;

    /** Critical damping of the lowest mode, over the time in which a shear wave
     * crosses the block, inverted: twice the frequency 2.1 of a block on its
     * base [-]. */
    constexpr double critical_rate = 4.2;

    /** Largest share of a velocity that is taken in one step: section 3 of
     * doc/theory.md leaves that much at a safety of 0.9 [-]. */
    constexpr double largest_share = 0.1;

    /** Sums over weighted points that move, about an origin near them: the
     * nearest motion of a rigid body. */
    struct RigidSums
    {
      static constexpr unsigned int n = 16;
      std::array<double, n> sum{};

      void
      add(const double weight, const Space &x, const Space &v)
      {
        const Space spin = dealii::cross_product_3d(x, v);
        sum[0] += weight;
        for (unsigned int i = 0, k = 10; i < 3; ++i)
          {
            sum[1 + i] += weight * x[i];
            sum[4 + i] += weight * v[i];
            sum[7 + i] += weight * spin[i];
            for (unsigned int j = i; j < 3; ++j, ++k)
              sum[k] += weight * x[i] * x[j];
          }
      }

      Space
      mean(const unsigned int first) const
      {
        return Space({sum[first] / sum[0],
                      sum[first + 1] / sum[0],
                      sum[first + 2] / sum[0]});
      }
      Space
      center() const
      {
        return mean(1);
      }
      Space
      velocity() const
      {
        return mean(4);
      }

      /** Rate of rotation [rad/s], or @p otherwise where the points, on one
       * line, do not tell it. */
      template <int dim>
      Space
      rotation(const Space &otherwise) const
      {
        if (sum[0] <= 0.)
          return otherwise;
        const Space x    = center();
        const Space spin = mean(7) - dealii::cross_product_3d(x, velocity());
        dealii::SymmetricTensor<2, 3> moment;
        for (unsigned int i = 0, k = 10; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j, ++k)
            moment[i][j] = -(sum[k] / sum[0] - x[i] * x[j]);
        const double spread = -dealii::trace(moment);
        moment += spread * dealii::unit_symmetric_tensor<3>();
        if (dim == 2)
          return spread > 0. ? Space({0., 0., spin[2] / spread}) : otherwise;
        if (dealii::determinant(moment) <= 1e-6 * spread * spread * spread)
          return otherwise;
        return dealii::invert(moment) * spin;
      }
    };

    template <int dim>
    Space
    in_space(const double *values)
    {
      Space result;
      for (int d = 0; d < dim; ++d)
        result[d] = values[d];
      return result;
    }

    template <int dim>
    Space
    in_space(const Point<dim> &point)
    {
      Space result;
      for (int d = 0; d < dim; ++d)
        result[d] = point[d];
      return result;
    }
  } // namespace



  template <int dim>
  DeformationDamping<dim>::DeformationDamping(const SplitMesh<dim> &split,
                                              const Blocks<dim> &blocks,
                                              const Numbering<dim> &numbering,
                                              const CellArrays<dim> &cells,
                                              Fields<dim> &fields)
    : split(split)
    , blocks(blocks)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
  {
    std::vector<unsigned int> block_of_node(numbering.n_owned(), none);
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      {
        const unsigned int block = split.block_of_cell[c];
        if (block == none || blocks.blocks[block].is_infinite ||
            blocks.blocks[block].is_rigid)
          continue;
        for (const unsigned int v : split.mesh.cells[c])
          if (numbering.is_owned(v) && !split.is_hanging(v))
            block_of_node[numbering.local_node(v)] = block;
      }
    std::vector<double> area(numbering.n_owned(), 0.);
    for (const Pair<dim> &pair : split.interface.pairs)
      for (const unsigned int v : {pair.minus, pair.plus})
        if (numbering.is_owned(v))
          area[numbering.local_node(v)] += pair.area;
    members.resize(blocks.blocks.size());
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (block_of_node[node] != none)
        members[block_of_node[node]].push_back({node, area[node]});
  }



  template <int dim>
  void
  DeformationDamping<dim>::begin_stage()
  {
    stiffness.assign(blocks.blocks.size(), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int block = split.block_of_cell[cells.mesh_cell[c]];
        if (block != none)
          stiffness[block] +=
            cells.mu[c] * split.mesh.cell_volume(cells.mesh_cell[c]);
      }
    sum_lists(stiffness);
    for (unsigned int b = 0; b < stiffness.size(); ++b)
      {
        double largest = 0.;
        for (const auto &[joint, area] : blocks.blocks[b].joint_area)
          largest = std::max(largest, area);
        stiffness[b] =
          std::sqrt(stiffness[b]) * largest / blocks.blocks[b].volume;
      }
  }



  template <int dim>
  void
  DeformationDamping<dim>::add_force(const Contact<dim> &contact,
                                     const double ratio,
                                     const double dt,
                                     const double *position)
  {
    std::vector<unsigned int> sliding;
    std::vector<double> is_sliding = contact.list_sliding_blocks();
    for (unsigned int b = 0; b < members.size(); ++b)
      if (is_sliding[b] > 0.)
        sliding.push_back(b);
    if (sliding.empty())
      return;

    // of the whole block by mass, of its faces by area
    constexpr unsigned int n = RigidSums::n;
    std::vector<double> packed;
    const auto place = [&](const unsigned int node, const unsigned int block) {
      return in_space<dim>(position + dim * node) -
             in_space<dim>(blocks.blocks[block].centroid);
    };
    for (const unsigned int b : sliding)
      {
        RigidSums whole, faces;
        for (const Member &member : members[b])
          {
            const Space x = place(member.node, b);
            const Space v =
              in_space<dim>(fields.velocity.data() + dim * member.node);
            whole.add(fields.mass[member.node], x, v);
            if (member.area > 0.)
              faces.add(member.area, x, v);
          }
        packed.insert(packed.end(), whole.sum.begin(), whole.sum.end());
        packed.insert(packed.end(), faces.sum.begin(), faces.sum.end());
      }
    sum_lists(packed);

    for (unsigned int i = 0; i < sliding.size(); ++i)
      {
        const unsigned int b = sliding[i];
        RigidSums whole, faces;
        std::copy_n(packed.begin() + 2 * n * i, n, whole.sum.begin());
        std::copy_n(packed.begin() + (2 * n * i + n), n, faces.sum.begin());
        if (whole.sum[0] <= 0.)
          continue;
        const double rate =
          std::min(critical_rate * std::min(1., ratio / full_ratio) *
                     stiffness[b] / std::sqrt(whole.sum[0]),
                   largest_share / dt);
        const Space center = whole.center(), velocity = whole.velocity();
        const Space turn = whole.template rotation<dim>(Space());
        Space rotation   = faces.template rotation<dim>(turn);
        for (unsigned int d = 0; d < 3; ++d)
          rotation[d] = std::clamp(rotation[d],
                                   std::min(0., turn[d]),
                                   std::max(0., turn[d]));
        for (const Member &member : members[b])
          {
            const Space rigid =
              velocity +
              dealii::cross_product_3d(rotation,
                                       place(member.node, b) - center);
            const double factor = rate * fields.mass[member.node];
            for (int d = 0; d < dim; ++d)
              fields.damping_force[dim * member.node + d] +=
                factor * (fields.velocity[dim * member.node + d] - rigid[d]);
          }
      }
  }

  template class DeformationDamping<2>;
  template class DeformationDamping<3>;
} // namespace Keyblock

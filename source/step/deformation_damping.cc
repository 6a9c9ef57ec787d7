// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/deformation_damping.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Rates of rotation: one in 2D, three in 3D [rad/s]. */
    template <int dim>
    using Turn = dealii::Tensor<1, dim == 2 ? 1 : 3>;

    /** x times v, as a moment. */
    template <int dim>
    Turn<dim>
    moment(const dealii::Tensor<1, dim> &x, const dealii::Tensor<1, dim> &v)
    {
      Turn<dim> result;
      if constexpr (dim == 2)
        result[0] = x[0] * v[1] - x[1] * v[0];
      else
        result = dealii::cross_product_3d(x, v);
      return result;
    }

    /** Velocity at @p x from a rotation about the origin. */
    template <int dim>
    dealii::Tensor<1, dim>
    velocity_of(const Turn<dim> &turn, const dealii::Tensor<1, dim> &x)
    {
      dealii::Tensor<1, dim> result;
      if constexpr (dim == 2)
        {
          result[0] = -turn[0] * x[1];
          result[1] = turn[0] * x[0];
        }
      else
        result = dealii::cross_product_3d(turn, x);
      return result;
    }

    /** Damping ratio from which on the lowest mode is damped critically [-]. */
    constexpr double full_ratio = 0.3;

    /** Critical damping of the lowest mode, over the time in which a shear wave
     * crosses the block, inverted: twice the frequency 2.1 of a block on its
     * base [-]. */
    constexpr double critical_rate = 4.2;

    /** Sums over weighted points that move: they tell the nearest motion of a
     * rigid body. The origin is near the points. */
    template <int dim>
    struct RigidSums
    {
      using Place = dealii::Tensor<1, dim>;

      static constexpr unsigned int n_turns   = dim == 2 ? 1 : 3;
      static constexpr unsigned int n_squares = dim == 2 ? 1 : 6;
      static constexpr unsigned int n = 1 + 2 * dim + n_turns + n_squares;

      /** Of weights, and weights times place, velocity, moment of velocity,
       * products of places (in 2D the square of the distance). */
      std::array<double, n> sum{};

      void
      add(const double weight, const Place &x, const Place &v)
      {
        double *to = sum.data();
        *to++ += weight;
        for (int d = 0; d < dim; ++d)
          *to++ += weight * x[d];
        for (int d = 0; d < dim; ++d)
          *to++ += weight * v[d];
        const Turn<dim> spin = moment<dim>(x, v);
        for (unsigned int i = 0; i < n_turns; ++i)
          *to++ += weight * spin[i];
        if constexpr (dim == 2)
          *to += weight * (x * x);
        else
          for (int d = 0; d < dim; ++d)
            for (int e = d; e < dim; ++e)
              *to++ += weight * x[d] * x[e];
      }

      bool
      is_empty() const
      {
        return sum[0] <= 0.;
      }

      Place
      center() const
      {
        return mean(1);
      }

      Place
      velocity() const
      {
        return mean(1 + dim);
      }

      /** Rate of rotation, or @p otherwise where the points do not tell it, as
       * those on one line in 3D. */
      Turn<dim>
      rotation(const Turn<dim> &otherwise) const
      {
        if (is_empty())
          return otherwise;
        const Place x  = center();
        Turn<dim> spin = -1. * moment<dim>(x, velocity());
        for (unsigned int i = 0; i < n_turns; ++i)
          spin[i] += sum[1 + 2 * dim + i] / sum[0];
        const double *square = sum.data() + n - n_squares;
        if constexpr (dim == 2)
          {
            const double spread = square[0] / sum[0] - x * x;
            return spread > 0. ? spin / spread : otherwise;
          }
        else
          {
            dealii::SymmetricTensor<2, dim> inertia;
            for (int d = 0; d < dim; ++d)
              for (int e = d; e < dim; ++e)
                inertia[d][e] = x[d] * x[e] - *square++ / sum[0];
            const double spread = -dealii::trace(inertia);
            inertia += spread * dealii::unit_symmetric_tensor<dim>();
            if (dealii::determinant(inertia) <= 1e-6 * std::pow(spread, 3))
              return otherwise;
            return dealii::invert(inertia) * spin;
          }
      }

    private:
      Place
      mean(const unsigned int first) const
      {
        Place result;
        for (int d = 0; d < dim; ++d)
          result[d] = sum[first + d] / sum[0];
        return result;
      }
    };

    template <int dim>
    dealii::Tensor<1, dim>
    vector_of(const double *values)
    {
      dealii::Tensor<1, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = values[d];
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
    numbering.communicator.sum_lists(stiffness);
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
                                     const double largest_rate,
                                     const double *position)
  {
    std::vector<unsigned int> sliding;
    std::vector<double> is_sliding = contact.report().list_sliding_blocks();
    for (unsigned int b = 0; b < members.size(); ++b)
      if (is_sliding[b] > 0.)
        sliding.push_back(b);
    if (sliding.empty())
      return;

    // of the whole block by mass, of its faces by area
    using Sums = RigidSums<dim>;
    std::vector<double> packed;
    const auto place = [&](const unsigned int node, const unsigned int block) {
      return vector_of<dim>(position + dim * node) -
             vector_of<dim>(&blocks.blocks[block].centroid[0]);
    };
    const auto velocity = [&](const unsigned int node) {
      return vector_of<dim>(fields.velocity.data() + dim * node);
    };
    for (const unsigned int b : sliding)
      {
        Sums whole, faces;
        for (const Member &member : members[b])
          {
            const auto x = place(member.node, b), v = velocity(member.node);
            whole.add(fields.mass[member.node], x, v);
            if (member.area > 0.)
              faces.add(member.area, x, v);
          }
        packed.insert(packed.end(), whole.sum.begin(), whole.sum.end());
        packed.insert(packed.end(), faces.sum.begin(), faces.sum.end());
      }
    numbering.communicator.sum_lists(packed);

    const double *sums = packed.data();
    for (const unsigned int b : sliding)
      {
        Sums whole, faces;
        std::copy_n(sums, Sums::n, whole.sum.begin());
        std::copy_n(sums + Sums::n, Sums::n, faces.sum.begin());
        sums += 2 * Sums::n;
        if (whole.is_empty())
          continue;
        const double rate =
          std::min(critical_rate * std::min(1., ratio / full_ratio) *
                     stiffness[b] / std::sqrt(whole.sum[0]),
                   largest_rate);
        const auto center = whole.center(), mean = whole.velocity();
        const Turn<dim> own = whole.rotation(Turn<dim>());
        Turn<dim> turn      = faces.rotation(own);
        for (unsigned int i = 0; i < Sums::n_turns; ++i)
          turn[i] =
            std::clamp(turn[i], std::min(0., own[i]), std::max(0., own[i]));
        for (const Member &member : members[b])
          {
            const auto excess =
              velocity(member.node) - mean -
              velocity_of<dim>(turn, place(member.node, b) - center);
            const double factor = rate * fields.mass[member.node];
            for (int d = 0; d < dim; ++d)
              fields.damping_force[dim * member.node + d] += factor * excess[d];
          }
      }
  }

  template class DeformationDamping<2>;
  template class DeformationDamping<3>;
} // namespace Keyblock

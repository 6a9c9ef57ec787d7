// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/blocks.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace Keyblock
{
  template <int dim>
  std::vector<std::vector<signed char>>
  sign_code(const Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    std::vector<std::vector<signed char>> code(mesh.n_cells());
    for (const auto &joint : scene.joints)
      {
        const Tensor<1, dim> normal = joint->normal();
        const Point<dim> origin     = joint->extent == JointShape::polygon
                                        ? joint->vertices[0]
                                        : joint->point;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          code[c].push_back(normal * (mesh.cell_center(c) - origin) > 0. ? 1
                                                                         : -1);
      }
    return code;
  }



  template <int dim>
  bool
  is_removable(const std::vector<Tensor<1, dim>> &inward)
  {
    const auto leaves_all = [&inward](const Tensor<1, dim> &direction) {
      return std::all_of(inward.begin(), inward.end(), [&](const auto &n) {
        return n * direction >= -1e-10;
      });
    };
    if (inward.empty())
      return true;
    // an extreme ray of the cone lies on as many planes as leave one direction
    // free; with fewer independent normals a normal or a line does
    for (const auto &n : inward)
      if (leaves_all(n))
        return true;
    for (const auto &a : inward)
      {
        if constexpr (dim == 2)
          {
            const Tensor<1, dim> along = cross_product_2d(a);
            if (leaves_all(along) || leaves_all(-along))
              return true;
          }
        else
          {
            // with parallel normals only, any direction in their plane
            Tensor<1, dim> axis;
            axis[std::abs(a[0]) < 0.6 ? 0 : 1] = 1.;
            const Tensor<1, dim> along         = cross_product_3d(a, axis);
            if (leaves_all(along) || leaves_all(-along))
              return true;
          }
        if constexpr (dim == 3)
          for (const auto &b : inward)
            {
              Tensor<1, dim> line = cross_product_3d(a, b);
              if (line.norm() < 1e-10)
                continue;
              line /= line.norm();
              if (leaves_all(line) || leaves_all(-line))
                return true;
            }
      }
    return false;
  }



  template <int dim>
  bool
  Blocks<dim>::is_split(const Mesh<dim> &mesh,
                        const unsigned int cell,
                        const unsigned int face,
                        const bool weld_infinite_blocks) const
  {
    const unsigned int other = mesh.neighbor[cell][face];
    if (other == none || mesh.joint[cell][face] == none)
      return false;
    const unsigned int a = block_of_cell[cell], b = block_of_cell[other];
    if (a == none || b == none)
      return false;
    return !(weld_infinite_blocks && blocks[a].is_infinite &&
             blocks[b].is_infinite);
  }



  template <int dim>
  std::vector<unsigned int>
  rank_blocks(const std::vector<Block<dim>> &blocks)
  {
    std::vector<unsigned int> order(blocks.size());
    std::iota(order.begin(), order.end(), 0);
    double largest = 0.;
    for (const auto &block : blocks)
      largest = std::max(largest, block.volume);
    const auto key = [&](const Block<dim> &block) {
      std::array<long long, dim + 2> result;
      result[0]           = block.is_infinite;
      result[1]           = -std::llround(1e8 * block.volume / largest);
      const double length = std::pow(largest, 1. / dim);
      for (unsigned int d = 0; d < dim; ++d)
        result[2 + d] = std::llround(1e6 * block.centroid[d] / length);
      return result;
    };
    std::sort(order.begin(), order.end(), [&](unsigned int a, unsigned int b) {
      return key(blocks[a]) < key(blocks[b]);
    });
    return order;
  }



  namespace
  {
    /** Label connected cells; returns the number of labels. */
    template <int dim>
    unsigned int
    label_cells(const Mesh<dim> &mesh, std::vector<unsigned int> &label)
    {
      label.assign(mesh.n_cells(), none);
      unsigned int n_labels = 0;
      std::vector<unsigned int> front;
      for (unsigned int seed = 0; seed < mesh.n_cells(); ++seed)
        {
          if (label[seed] != none || mesh.excavation_stage[seed] != 0)
            continue;
          label[seed] = n_labels;
          front       = {seed};
          while (!front.empty())
            {
              const unsigned int c = front.back();
              front.pop_back();
              for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
                if (mesh.joint[c][f] == none)
                  mesh.for_each_across(c, f, [&](const unsigned int other) {
                    if (label[other] == none &&
                        mesh.excavation_stage[other] == 0)
                      {
                        label[other] = n_labels;
                        front.push_back(other);
                      }
                  });
            }
          ++n_labels;
        }
      return n_labels;
    }



    template <int dim>
    bool
    is_truncated(const Mesh<dim> &mesh,
                 const Scene<dim> &scene,
                 const unsigned int cell,
                 const unsigned int face)
    {
      for (const std::string &name : scene.domain.truncated_boundaries)
        if (mesh.is_on(cell, face, name))
          return true;
      return false;
    }



    /** Exact first moment and volume of a cell by tensor Gauss quadrature. */
    template <int dim>
    void
    add_moments(const Mesh<dim> &mesh,
                const unsigned int cell,
                double &volume,
                Tensor<1, dim> &moment)
    {
      const double g = 0.5 / std::sqrt(3.);
      for (unsigned int q = 0; q < Mesh<dim>::n_cell_vertices; ++q)
        {
          Tensor<1, dim> x;
          Tensor<2, dim> jacobian;
          for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
            {
              double value = 1.;
              std::array<double, dim> factor, slope;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double s = ((q >> d) & 1) ? 0.5 + g : 0.5 - g;
                  factor[d]      = ((v >> d) & 1) ? s : 1. - s;
                  slope[d]       = ((v >> d) & 1) ? 1. : -1.;
                  value *= factor[d];
                }
              const Point<dim> &p = mesh.vertices[mesh.cells[cell][v]];
              x += value * p;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double derivative = slope[d];
                  for (unsigned int e = 0; e < dim; ++e)
                    if (e != d)
                      derivative *= factor[e];
                  jacobian[d] += derivative * p;
                }
            }
          const double weight =
            determinant(jacobian) / Mesh<dim>::n_cell_vertices;
          volume += weight;
          moment += weight * x;
        }
    }



    /** What surrounds a block at each stage. */
    struct Surroundings
    {
      std::vector<bool> has_free_face, is_attached;
    };



    template <int dim>
    void
    classify(Blocks<dim> &result,
             const Mesh<dim> &mesh,
             const Scene<dim> &scene)
    {
      const unsigned int n_stages = result.n_stages;
      std::vector<Surroundings> around(result.blocks.size(),
                                       {std::vector<bool>(n_stages + 1),
                                        std::vector<bool>(n_stages + 1)});
      std::vector<std::vector<Tensor<1, dim>>> inward(result.blocks.size());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const unsigned int b = result.block_of_cell[c];
          if (b == none)
            continue;
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              const unsigned int other = mesh.neighbor[c][f];
              const unsigned int j     = mesh.joint[c][f];
              const unsigned int excavated =
                other == none ? 0 : mesh.excavation_stage[other];
              for (unsigned int s = 0; s <= n_stages; ++s)
                {
                  if (other == none ? !is_truncated(mesh, scene, c, f)
                                    : (excavated > 0 && excavated <= s))
                    around[b].has_free_face[s] = true;
                  if (excavated > s && j == none)
                    around[b].is_attached[s] = true;
                }
              if (j != none && other != none && excavated == 0)
                {
                  const int side      = mesh.side[c][f];
                  const bool is_outer = result.block_of_cell[other] != b;
                  // (a joint that ends in the block is met from both sides)
                  result.blocks[b].joint_area[j] +=
                    (is_outer ? 1. : 0.5) * mesh.face_area_vector(c, f).norm();
                  if (is_outer)
                    {
                      const Tensor<1, dim> n =
                        double(side) * scene.joints[j]->normal();
                      if (std::find(inward[b].begin(), inward[b].end(), n) ==
                          inward[b].end())
                        inward[b].push_back(n);
                      result.blocks[b].joint_side[j] = side;
                    }
                }
            }
        }
      for (unsigned int b = 0; b < result.blocks.size(); ++b)
        {
          Block<dim> &block  = result.blocks[b];
          block.is_removable = !block.is_infinite && is_removable(inward[b]);
          for (unsigned int s = 0; s <= n_stages; ++s)
            {
              BlockClass kind = BlockClass::hidden;
              if (block.is_rigid)
                kind = BlockClass::rigid;
              else if (block.is_infinite)
                kind = BlockClass::infinite;
              else if (around[b].is_attached[s])
                kind = BlockClass::attached;
              else if (around[b].has_free_face[s])
                kind = BlockClass::exposed;
              block.class_of_stage.push_back(kind);
              if (around[b].has_free_face[s] && kind != BlockClass::attached &&
                  block.exposed_stage == none)
                block.exposed_stage = s;
            }
        }
    }
  } // namespace



  template <int dim>
  Blocks<dim>
  find_blocks(const Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    std::vector<unsigned int> label;
    const unsigned int n_labels = label_cells(mesh, label);
    std::vector<Block<dim>> found(n_labels);
    std::vector<Tensor<1, dim>> moment(n_labels);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (label[c] == none)
          continue;
        Block<dim> &block = found[label[c]];
        double volume     = 0.;
        add_moments(mesh, c, volume, moment[label[c]]);
        const Material<dim> &material = *scene.materials[mesh.material[c]];
        block.mass += volume * material.density;
        block.is_rigid = block.is_rigid || material.is_rigid();
        block.volume += volume;
        ++block.n_cells;
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          if (mesh.neighbor[c][f] == none && is_truncated(mesh, scene, c, f))
            block.is_infinite = true;
      }
    for (unsigned int b = 0; b < n_labels; ++b)
      {
        found[b].centroid    = Point<dim>(moment[b] / found[b].volume);
        found[b].is_infinite = found[b].is_infinite || found[b].is_rigid;
      }
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (label[c] != none)
        for (const unsigned int v : mesh.cells[c])
          {
            Block<dim> &block = found[label[c]];
            block.size =
              std::max(block.size,
                       2. * block.centroid.distance(mesh.vertices[v]));
          }

    Blocks<dim> result;
    std::set<std::vector<signed char>> codes;
    const std::vector<std::vector<signed char>> code = sign_code(mesh, scene);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (label[c] != none)
        codes.insert(code[c]);
    result.n_sign_codes                   = codes.size();
    const std::vector<unsigned int> order = rank_blocks(found);
    std::vector<unsigned int> index(n_labels);
    for (unsigned int b = 0; b < n_labels; ++b)
      {
        index[order[b]] = b;
        result.blocks.push_back(found[order[b]]);
        result.blocks.back().id = b + 1;
      }
    result.block_of_cell.assign(mesh.n_cells(), none);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (label[c] != none)
          result.block_of_cell[c] = index[label[c]];
        result.n_stages = std::max(result.n_stages, mesh.excavation_stage[c]);
      }
    classify(result, mesh, scene);
    measure_widths(result, mesh, scene);
    return result;
  }



#define INSTANTIATE(dim)                                                       \
  template struct Blocks<dim>;                                                 \
  template std::vector<std::vector<signed char>> sign_code(                    \
    const Mesh<dim> &, const Scene<dim> &);                                    \
  template Blocks<dim> find_blocks(const Mesh<dim> &, const Scene<dim> &);     \
  template std::vector<unsigned int> rank_blocks(                              \
    const std::vector<Block<dim>> &);                                          \
  template bool is_removable(const std::vector<Tensor<1, dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

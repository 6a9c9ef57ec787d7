// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/material_shares.h>

#include <deal.II/base/geometry_info.h>

#include <keyblock/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Difference of masses that is not warned of [-]. */
    constexpr double unwarned_difference = 0.005;

    /** Parts of a cell in each direction, and how often those are halved where
     * the density changes. */
    constexpr unsigned int n_parts = 4, n_halvings = 4;

    /** Mass of a part of a cell, and its volume. */
    template <int dim>
    class PartMass
    {
    public:
      PartMass(const Mesh<dim> &mesh,
               const unsigned int cell,
               const DensityOfPlaces<dim> &density,
               const double of_cell)
        : mesh(mesh)
        , cell(cell)
        , density(density)
        , of_cell(of_cell)
      {}

      /** Add a part of the unit cell: a cube with sides of @p size from its
       * corner @p low. */
      void
      add(const Point<dim> &low,
          const double size,
          const unsigned int n_halvings)
      {
        const auto corner = [&](const unsigned int v, const double share) {
          Point<dim> unit = low;
          for (unsigned int d = 0; d < dim; ++d)
            unit[d] += ((v >> d) & 1 ? 1. : share) * size;
          return unit;
        };
        Point<dim> middle = low;
        for (unsigned int d = 0; d < dim; ++d)
          middle[d] += 0.5 * size;
        const double here = density_at(middle);
        bool is_one       = true;
        for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices && is_one; ++v)
          is_one = density_at(corner(v, 0.)) == here;
        if (is_one || n_halvings == 0)
          {
            const double part = std::pow(size, dim) * jacobian(middle);
            volume += part;
            mass += part * here;
          }
        else
          for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
            {
              Point<dim> child = low;
              for (unsigned int d = 0; d < dim; ++d)
                child[d] += (v >> d) & 1 ? 0.5 * size : 0.;
              add(child, 0.5 * size, n_halvings - 1);
            }
      }

      double mass = 0., volume = 0.;

    private:
      double
      density_at(const Point<dim> &unit) const
      {
        Point<dim> place;
        for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
          place += GeometryInfo<dim>::d_linear_shape_function(unit, v) *
                   mesh.vertices[mesh.cells[cell][v]];
        return density.at(place, of_cell);
      }

      double
      jacobian(const Point<dim> &unit) const
      {
        Tensor<2, dim> slopes;
        for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
          slopes += outer_product(
            GeometryInfo<dim>::d_linear_shape_function_gradient(unit, v),
            Tensor<1, dim>(mesh.vertices[mesh.cells[cell][v]]));
        return determinant(slopes);
      }

      const Mesh<dim> &mesh;
      const unsigned int cell;
      const DensityOfPlaces<dim> &density;
      const double of_cell;
    };
  } // namespace



  template <int dim>
  DensityOfPlaces<dim>::DensityOfPlaces(const Scene<dim> &scene)
  {
    for (const auto &material : scene.materials)
      if (material->stage.empty())
        {
          regions.emplace_back(scene, *material);
          densities.push_back(material->density);
          has_groups = has_groups || regions.back().is_group();
        }
  }



  template <int dim>
  bool
  DensityOfPlaces<dim>::varies() const
  {
    return !has_groups &&
           std::set<double>(densities.begin(), densities.end()).size() > 1;
  }



  template <int dim>
  double
  DensityOfPlaces<dim>::at(const Point<dim> &point,
                           const double otherwise) const
  {
    for (unsigned int m = regions.size(); m-- > 0;)
      if (regions[m].contains(point))
        return densities[m];
    return otherwise;
  }



  template <int dim>
  double
  DensityOfPlaces<dim>::mean(const Mesh<dim> &mesh,
                             const unsigned int cell,
                             const double of_cell) const
  {
    if (!varies())
      return of_cell;
    PartMass<dim> sum(mesh, cell, *this, of_cell);
    const unsigned int n = std::pow(n_parts, dim);
    for (unsigned int i = 0; i < n; ++i)
      {
        Point<dim> low;
        for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n_parts)
          low[d] = double(rest % n_parts) / n_parts;
        sum.add(low, 1. / n_parts, n_halvings);
      }
    return sum.volume > 0. ? sum.mass / sum.volume : of_cell;
  }



  template <int dim>
  std::string
  warning_of_material_shares(const Scene<dim> &scene,
                             const SplitMesh<dim> &split,
                             const Blocks<dim> &blocks)
  {
    const DensityOfPlaces<dim> density(scene);
    if (!density.varies())
      return "";
    const Mesh<dim> &mesh = split.mesh;
    std::vector<double> masses(blocks.blocks.size(), 0.), of_cells = masses;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (const unsigned int b = split.block_of_cell[c];
          b != none && !blocks.blocks[b].is_infinite)
        {
          const double of_cell = scene.materials[mesh.material[c]]->density;
          of_cells[b] += of_cell * mesh.cell_volume(c);
          const auto &vertices  = mesh.cells[c];
          const bool is_crossed = std::any_of(
            vertices.begin(), vertices.end(), [&](const unsigned int v) {
              return density.at(mesh.vertices[v], of_cell) != of_cell;
            });
          masses[b] += (is_crossed ? density.mean(mesh, c, of_cell) : of_cell) *
                       mesh.cell_volume(c);
        }
    const auto difference = [&](const unsigned int b) {
      return masses[b] > 0. ? std::abs(of_cells[b] / masses[b] - 1.) : 0.;
    };
    unsigned int most = none, n_blocks = 0;
    for (unsigned int b = 0; b < masses.size(); ++b)
      if (difference(b) > unwarned_difference)
        {
          ++n_blocks;
          if (most == none || difference(b) > difference(most))
            most = b;
        }
    if (most == none)
      return "";
    const std::string unit = dim == 2 ? " kg/m" : " kg";
    return "A cell has the material at its centre: block " +
           std::to_string(blocks.blocks[most].id) + " has " +
           text_of(of_cells[most], 4) + unit + " instead of about " +
           text_of(masses[most], 4) + unit + " by 'Materials/*/Region'" +
           (n_blocks > 1 ? " (more than 0.5 % off are " +
                             std::to_string(n_blocks) + " blocks)"
                         : std::string()) +
           ", and its factors are found with that; let edges of cells follow "
           "the boundary between the materials, as on a joint there, or lower "
           "'Mesh/Size' there.";
  }

  template class DensityOfPlaces<2>;
  template class DensityOfPlaces<3>;
  template std::string warning_of_material_shares(const Scene<2> &,
                                                  const SplitMesh<2> &,
                                                  const Blocks<2> &);
  template std::string warning_of_material_shares(const Scene<3> &,
                                                  const SplitMesh<3> &,
                                                  const Blocks<3> &);
} // namespace Keyblock

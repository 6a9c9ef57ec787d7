// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/material_shares.h>

#include <deal.II/base/geometry_info.h>

#include <keyblock/base/number_text.h>
#include <keyblock/mesh/material_region.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Difference of masses that is not warned of [-]. */
    constexpr double unwarned_difference = 0.005;

    /** Parts of a cell that a boundary crosses, in each direction. */
    template <int dim>
    constexpr unsigned int n_parts = dim == 2 ? 12 : 6;

    /** The densities of materials that are there from the start, by place. */
    template <int dim>
    class DensityOfPlaces
    {
    public:
      DensityOfPlaces(const Scene<dim> &scene)
      {
        for (const auto &material : scene.materials)
          if (material->stage.empty())
            {
              regions.emplace_back(scene, *material);
              densities.push_back(material->density);
              has_groups = has_groups || regions.back().is_group();
            }
      }

      /** Whether it varies, and with places alone. */
      bool
      varies() const
      {
        return !has_groups &&
               std::set<double>(densities.begin(), densities.end()).size() > 1;
      }

      /** [kg/m3]; of places without material @p otherwise. */
      double
      at(const Point<dim> &point, const double otherwise) const
      {
        for (unsigned int m = regions.size(); m-- > 0;)
          if (regions[m].contains(point))
            return densities[m];
        return otherwise;
      }

    private:
      std::deque<MaterialRegion<dim>> regions;
      std::vector<double> densities;
      bool has_groups = false;
    };

    /** Mean density of a cell over its parts [kg/m3]. */
    template <int dim>
    double
    mean_density(const Mesh<dim> &mesh,
                 const unsigned int cell,
                 const DensityOfPlaces<dim> &density,
                 const double of_cell)
    {
      const auto &vertices = mesh.cells[cell];
      if (std::all_of(vertices.begin(),
                      vertices.end(),
                      [&](const unsigned int v) {
                        return density.at(mesh.vertices[v], of_cell) == of_cell;
                      }))
        return of_cell;
      double sum           = 0.;
      const unsigned int n = std::pow(n_parts<dim>, dim);
      for (unsigned int i = 0; i < n; ++i)
        {
          Point<dim> unit;
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n_parts<dim>)
            unit[d] = (rest % n_parts<dim> + 0.5) / n_parts<dim>;
          Point<dim> place;
          for (unsigned int v = 0; v < vertices.size(); ++v)
            place +=
              dealii::GeometryInfo<dim>::d_linear_shape_function(unit, v) *
              mesh.vertices[vertices[v]];
          sum += density.at(place, of_cell);
        }
      return sum / n;
    }
  } // namespace



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
          masses[b] +=
            mean_density(mesh, c, density, of_cell) * mesh.cell_volume(c);
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

  template std::string warning_of_material_shares(const Scene<2> &,
                                                  const SplitMesh<2> &,
                                                  const Blocks<2> &);
  template std::string warning_of_material_shares(const Scene<3> &,
                                                  const SplitMesh<3> &,
                                                  const Blocks<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_liner_mass_h
#define keyblock_step_liner_mass_h

#include <keyblock/blocks/ground.h>
#include <keyblock/rock/dofs.h>

namespace Keyblock
{
  /** Add the mass of liner @p i (of Scene::liners) where it is and has rock
   * under it to owned nodes, lumped as its weight is [kg].
   * @return its area, on all ranks [m2] */
  template <int dim>
  double
  add_liner_mass(const Ground<dim> &ground,
                 const Numbering<dim> &numbering,
                 const unsigned int i,
                 std::vector<double> &mass)
  {
    const Liner &liner = *ground.scene.liners[i];
    double area        = 0.;
    if (ground.scene.stage_number(liner.stage) > ground.stage_number)
      return area;
    for (const LinerArea &part : ground.split.liners[i].areas)
      if (!ground.is_excavated(part.cell))
        {
          area += part.area;
          for_each_owned_carrier(ground.split,
                                 numbering,
                                 part.vertex,
                                 [&](const unsigned int node,
                                     const double weight) {
                                   mass[node] += weight * part.area *
                                                 liner.thickness *
                                                 liner.density;
                                 });
        }
    return area;
  }

  /**
   * Add the inertia of liners to the @p mass of owned nodes: their true mass,
   * or where steps are equal as much as keeps the frequency of @p inertia [kg].
   * @param row_sums tells those of their stiffness, by owned node [N/m]
   * @param own_mass the true mass, then what is in use
   */
  template <typename Inertia, typename RowSums>
  void
  add_inertia_of_liners(const Inertia &inertia,
                        const RowSums &row_sums,
                        std::vector<double> &own_mass,
                        std::vector<double> &mass)
  {
    if (inertia.has_equal_steps)
      {
        own_mass = row_sums();
        for (double &m : own_mass)
          m /= inertia.frequency * inertia.frequency;
      }
    for (unsigned int node = 0; node < own_mass.size(); ++node)
      mass[node] += own_mass[node];
  }
} // namespace Keyblock

#endif

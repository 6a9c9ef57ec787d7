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
          ground.split.for_each_carrier(
            part.vertex, [&](const unsigned int carrier, const double weight) {
              if (numbering.is_owned(carrier))
                mass[numbering.local_node(carrier)] +=
                  weight * part.area * liner.thickness * liner.density;
            });
        }
    return area;
  }
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_tests_mesh_frequency_h
#define keyblock_tests_mesh_frequency_h

#include "world.h"

#include <keyblock/rock/internal_force.h>
#include <keyblock/run/simulation.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  /** Highest frequency of the mesh with the masses in use, without supports,
   * which is at least that with them, by so many power iterations on M^-1 K;
   * from below [rad/s]. */
  template <int dim>
  double
  highest_frequency_of_mesh(const Simulation<dim> &simulation,
                            const unsigned int n_iterations)
  {
    CellArrays<dim> cells        = simulation.state().cells;
    const Fields<dim> &fields    = simulation.state().fields;
    const Numbering<dim> &number = *simulation.state().numbering;
    for (MohrCoulomb &strength : cells.strengths)
      strength.peak.uniaxial       = strength.peak.tension =
        strength.residual.uniaxial = strength.residual.tension = 1e100;
    std::vector<double> x(fields.velocity.size()), y(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = std::sin(3. + 11. * number.vertex_of_node[i / dim] + i % dim);
    double eigenvalue = 0.;
    for (unsigned int iteration = 0; iteration < n_iterations; ++iteration)
      {
        number.update_ghosts(x);
        number.interpolate_hanging(x);
        cells.stress.reinit(cells.nodes.size());
        std::fill(y.begin(), y.end(), 0.);
        ForcePass pass;
        pass.step = 1.;
        add_internal_force<dim>(
          pass, cells, fields.reference.data(), x.data(), y.data(), nullptr);
        number.add_hanging_to_masters(y);
        number.add_ghosts_to_owners(y);
        std::vector<double> sums(2, 0.);
        for (unsigned int i = 0; i < dim * number.n_owned(); ++i)
          {
            const double mass = fields.mass[i / dim];
            y[i]              = mass > 0. ? y[i] / mass : 0.; // hanging: 0
            sums[0] += x[i] * y[i] * mass;
            sums[1] += x[i] * x[i] * mass;
          }
        world.sum_lists(sums);
        eigenvalue = sums[0] / sums[1];
        for (unsigned int i = 0; i < x.size(); ++i)
          x[i] = y[i] / eigenvalue;
      }
    return std::sqrt(eigenvalue);
  }
} // namespace Keyblock

#endif

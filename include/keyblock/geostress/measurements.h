// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_geostress_measurements_h
#define keyblock_geostress_measurements_h

#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** A component of stress, measured at a place. */
  template <int dim>
  struct Measurement
  {
    Point<dim> place;
    unsigned int component;
    double value, weight;
    std::string text;
  };

  /** Names of the components of stress, in the order of their numbers. */
  template <int dim>
  const std::vector<std::string> &component_names();

  /** Read the file of `Initial state/Measured points`; throws InputError. */
  template <int dim>
  std::vector<Measurement<dim>> read_measurements(const Scene<dim> &scene);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_liner_h
#define keyblock_scene_liner_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  /** Shotcrete on faces of excavations. */
  struct Liner
  {
    std::string name;
    std::string stage;
    std::vector<std::string> excavations;
    std::vector<std::string> parts = {"roof", "walls"};
    std::string region;
    double thickness      = 0.;    ///< [m]
    double shear_strength = 0.;    ///< of the section that a block shears [Pa]
    double shear_modulus  = 10e9;  ///< [Pa]
    double density        = 2400.; ///< [kg/m3]

    void declare(dealii::ParameterHandler &prm);
  };

  template <int dim>
  struct Scene;

  /** Throw InputError if a liner cannot be what is meant. */
  template <int dim>
  void check_liners(const Scene<dim> &scene);
} // namespace Keyblock

#endif

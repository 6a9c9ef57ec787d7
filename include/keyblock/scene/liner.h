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

    // of a liner that carries thrust and bends
    double young_modulus        = 0.;  ///< 0: it does not [Pa]
    double poisson_ratio        = 0.2; ///< [-]
    double compressive_strength = 0.;  ///< 0: not compared [Pa]
    double tensile_strength     = 0.;  ///< 0: not compared [Pa]

    bool
    is_structural() const
    {
      return young_modulus > 0.;
    }

    void declare(dealii::ParameterHandler &prm);
  };

  template <int dim>
  struct Scene;

  /** Throw InputError if a liner cannot be what is meant. */
  template <int dim>
  void check_liners(const Scene<dim> &scene);
} // namespace Keyblock

#endif

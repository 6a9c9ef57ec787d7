// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_bolts_h
#define keyblock_scene_bolts_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  /** Bolts or cables of one kind: single ones by their two ends, or a pattern
   * on the faces of excavations. */
  template <int dim>
  struct BoltSet
  {
    std::string name;
    std::string stage;

    // single ones
    std::vector<dealii::Point<dim>> heads, ends;

    // a pattern
    std::vector<std::string> excavations;
    std::vector<std::string> parts = {"roof", "walls"};
    std::string region;
    double length      = 0.; ///< [m]
    double inclination = 0.; ///< against the face's normal [deg]
    dealii::Tensor<1, dim> direction;
    dealii::Tensor<1, dim> axis;

    /** Along the section of the excavation and along its axis (in 2D: out of
     * the plane) [m]. */
    std::vector<double> spacing = {1., 1.};

    // what they are made of, and how they are held
    double area            = 0.; ///< [m2]
    double young_modulus   = 200e9;
    double yield_force     = 0.; ///< [N]
    double rupture_strain  = 0.; ///< [-]
    double pretension      = 0.; ///< [N]
    double plate_strength  = 0.; ///< [N]
    double plate_stiffness = 0.; ///< [N/m]
    double free_length     = 0.; ///< [m]
    double bond_stiffness  = 0.; ///< [N/m/m]
    double bond_strength   = 0.; ///< [N/m]
    double dowel_stiffness = 0.; ///< [N/m]
    double dowel_strength  = 0.; ///< [N]
    double segment_length  = 0.; ///< [m]

    bool
    is_pattern() const
    {
      return !excavations.empty();
    }

    /** How many of them stand for a bolt of the model: in 2D one per metre. */
    double
    share() const
    {
      return dim == 2 ? 1. / spacing.back() : 1.;
    }

    void declare(dealii::ParameterHandler &prm);
  };

  template <int dim>
  struct Scene;

  /** Throw InputError if a set of bolts cannot be what is meant. */
  template <int dim>
  void check_bolts(const Scene<dim> &scene);
} // namespace Keyblock

#endif

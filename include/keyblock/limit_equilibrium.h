// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_limit_equilibrium_h
#define keyblock_limit_equilibrium_h

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** A plane on which a rigid block rests, or may slide. */
  template <int dim>
  struct BlockFace
  {
    dealii::Tensor<1, dim> inward; ///< unit normal, into the block
    double area             = 0.;  ///< [m^(dim-1)]
    double tangent_friction = 0.;  ///< tan(phi) [-]
    double cohesion         = 0.;  ///< [Pa]
    double water_force      = 0.;  ///< pressure times area, pushes inwards [N]
    std::string name;              ///< of the joint
  };

  /** What a rigid block without a state of stress would do. */
  template <int dim>
  struct LimitEquilibrium
  {
    enum class Mode
    {
      stable,  ///< no direction in which it is driven is free
      falling, ///< leaves all faces, downwards
      lifting, ///< leaves all faces, upwards
      one_plane,
      two_planes
    };
    Mode mode = Mode::stable;

    /** Those it slides on (none, one or two), then those with cohesion that it
     * moves along without pressing on them. */
    std::vector<unsigned int> faces;
    dealii::Tensor<1, dim> direction;

    /** Effective normal forces on those faces, compression positive [N]. */
    std::vector<double> normal_forces;
    double driving_force = 0.; ///< along the direction [N]

    /** Resistance over driving force; 0 if falling or lifting; infinite if
     * stable [-]. */
    double factor = 0.;

    /** The mode in words, with the names of the joints. */
    std::string describe(const std::vector<BlockFace<dim>> &all) const;
  };

  /**
   * Mode and factor of a rigid block on @p faces under the force @p load
   * (weight, and whatever else acts, water excluded) [N]. Of all
   * directions that leave no face closed in, the block takes that along which
   * the resultant of load and water drives it: off all faces, else along one
   * plane that it is pressed on, else along two (Warburton 1981; Goodman and
   * Shi 1985). Faces that it moves along without pressing on them resist by
   * their cohesion, faces that open by nothing. Moments are ignored: no
   * toppling.
   */
  template <int dim>
  LimitEquilibrium<dim>
  solve_limit_equilibrium(const std::vector<BlockFace<dim>> &faces,
                          const dealii::Tensor<1, dim> &load);
} // namespace Keyblock

#endif

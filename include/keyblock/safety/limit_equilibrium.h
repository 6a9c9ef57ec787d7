// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_limit_equilibrium_h
#define keyblock_safety_limit_equilibrium_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/safety/block_mode.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Keyblock
{
  class JointLaw; // law/joint_law.h

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

    /** Set if friction depends on the normal stress. */
    std::shared_ptr<const JointLaw> law{};

    bool is_reduced = true; ///< the factor divides its strength

    bool loses_friction = false; ///< where it slips

    /** Index of its joint; none: it lies against a free face of other rock. */
    unsigned int joint = dealii::numbers::invalid_unsigned_int;

    // only for judge_rotation()
    double tensile_strength = 0.;               ///< [Pa]
    std::vector<dealii::Point<dim>> vertices{}; ///< of the mesh on it
  };

  /** What a rigid block without a state of stress would do. */
  template <int dim>
  struct LimitEquilibrium
  {
    enum class Mode
    {
      stable,  ///< no direction in which it is driven is free
      falling, ///< leaves all faces, with the weight
      lifting, ///< leaves all faces, against it
      one_plane,
      two_planes,
      rotating ///< turns, as about an edge of the one plane it is pressed on
    };
    Mode mode = Mode::stable;

    /** Those it is pressed on (those of one or two planes, or none), then those
     * with cohesion that it moves along without pressing on them. */
    std::vector<unsigned int> faces;
    unsigned int n_pressed = 0; ///< how many of them it is pressed on
    dealii::Tensor<1, dim> direction;

    /** Effective normal forces on those faces, compression positive [N]. */
    std::vector<double> normal_forces;
    double driving_force = 0.; ///< along the direction [N]

    // against it; cohesion alone resists falling and lifting [N]
    double reduced_resistance = 0.; ///< what the factor divides
    double fixed_resistance   = 0.; ///< of faces that are not reduced

    /** Number by which the reduced resistance is divided when both together
     * are the driving force; if rotating that up to which moments
     * are balanced, 0 if none is; infinite if stable or held by faces
     * that are not reduced [-]. */
    double factor = 0.;

    /** Stable because support bears all that drives the block. */
    bool is_borne = false;

    /** Add the resistance of one face, or of support on it [N]; set_factor() is
     * to follow. */
    void
    add_resistance(const double force, const bool is_reduced)
    {
      (is_reduced ? reduced_resistance : fixed_resistance) += force;
    }

    void set_factor();

    /** Whether faces that are not reduced bear all that drives the block. */
    bool
    is_held_by_fixed() const
    {
      return mode != Mode::stable && mode != Mode::rotating &&
             driving_force <= fixed_resistance;
    }

    /** Tell falling from lifting by the block's @p weight [N], which need not
     * be along an axis; nothing changes if there is none. */
    void orient(const dealii::Tensor<1, dim> &weight);

    /** Faces that the block presses on, by index. If it is stable those that
     * keep it where it is: all that acts closes them, or its part along those
     * does that it has closed.
     * @param load as for solve_limit_equilibrium() [N] */
    std::set<unsigned int>
    pressed_faces(const std::vector<BlockFace<dim>> &all,
                  const dealii::Tensor<1, dim> &load) const;

    /** The mode with the joints of the faces that the block presses. */
    BlockMode block_mode(const std::vector<BlockFace<dim>> &all) const;

    /** The same in words: falling, sliding on J1, sliding on J1/J2. */
    std::string
    describe(const std::vector<BlockFace<dim>> &all) const
    {
      return block_mode(all).text();
    }
  };

  /**
   * Mode and factor of a rigid block on @p faces under the force @p load
   * (weight, and whatever else acts, water excluded) [N]. Of all
   * directions that leave no face closed in, the block takes that along which
   * the resultant of load and water drives it: off all faces, else along one
   * plane that it is pressed on, else along two (Warburton 1981; Goodman and
   * Shi 1985). Faces with one normal, as the pieces of a stepped base, share
   * the normal force by their areas. Faces that it moves along without pressing
   * on them resist by their cohesion, faces that open by nothing. Moments are
   * ignored; see judge_rotation(). The last axis is up, but for
   * LimitEquilibrium::orient().
   */
  template <int dim>
  LimitEquilibrium<dim>
  solve_limit_equilibrium(const std::vector<BlockFace<dim>> &faces,
                          const dealii::Tensor<1, dim> &load);

  /** The same where the friction of some faces depends on their normal stress:
   * statics gives it, and @p faces the friction that belongs to it. */
  template <int dim>
  LimitEquilibrium<dim> solve_with_laws(std::vector<BlockFace<dim>> &faces,
                                        const dealii::Tensor<1, dim> &load);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/stress_ratio.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Cosines up to which a block moves along a face [-]. */
    constexpr double parallel = 1e-6;
  } // namespace



  template <int dim>
  double
  stress_ratio(const std::vector<BlockFace<dim>> &faces,
               const LimitEquilibrium<dim> &limit,
               const std::vector<JointSums<dim>> &sums)
  {
    const bool moves      = limit.direction.norm() > 0.;
    const bool leaves_all = moves && limit.n_pressed == 0;
    double reduced = 0., fixed = 0.; // strength
    Tensor<1, dim> shear;
    for (const BlockFace<dim> &face : faces)
      {
        const double leaves = face.inward * limit.direction;
        if (moves && !leaves_all && std::abs(leaves) > parallel)
          continue;
        const double along =
          leaves_all ? std::sqrt(std::max(0., 1. - leaves * leaves)) : 1.;
        if (face.joint == none)
          continue;
        const JointSums<dim> &sum = sums[face.joint];
        Tensor<1, dim> force;
        for (unsigned int d = 0; d < dim; ++d)
          force[d] = sum.force[d];
        const double normal = force * face.inward;
        shear += force - normal * face.inward;
        const unsigned int n_closed = sum.n_sliding + sum.n_sticking;
        if (n_closed == 0)
          continue;
        double tangent = face.tangent_friction;
        if (face.law != nullptr && face.area > 0.)
          {
            JointPointState state;
            state.pressure = std::max(0., normal) / face.area;
            tangent        = face.law->envelope(state).static_tangent;
          }
        const double cohesion =
          face.cohesion * face.area * n_closed / (sum.n_open + n_closed);
        (face.is_reduced ? reduced : fixed) +=
          along * std::max(0., cohesion + tangent * normal);
      }
    const double force =
      leaves_all ? std::abs(shear * limit.direction) : shear.norm();
    return force > fixed && reduced > 0. ? reduced / (force - fixed) : 0.;
  }

  template double stress_ratio(const std::vector<BlockFace<2>> &,
                               const LimitEquilibrium<2> &,
                               const std::vector<JointSums<2>> &);
  template double stress_ratio(const std::vector<BlockFace<3>> &,
                               const LimitEquilibrium<3> &,
                               const std::vector<JointSums<3>> &);
} // namespace Keyblock

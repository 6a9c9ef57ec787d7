// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_moments.h>
#include <keyblock/safety/moment_balance.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Part of a factor that moments may take off it without being told [-],
     * factors below which are none, and halvings by which they are found. */
    constexpr double least_loss = 1e-4, least_factor = 1e-3;
    constexpr unsigned int n_factor_halvings = 32;

    /** Whether limit equilibrium knows all that may balance moments on a block:
     * not of one that is joined to others, nor what sheared support or tensile
     * strength do, nor friction by the stress on it. */
    template <int dim>
    bool
    knows_moments(const BlockSurroundings<dim> &around,
                  const BlockSupport<dim> &support)
    {
      return !around.is_attached && !around.is_on_fill &&
             support.sections.empty() &&
             std::all_of(support.pulls.begin(),
                         support.pulls.end(),
                         [](const auto &pull) {
                           return pull.dowel_strength == 0.;
                         }) &&
             std::all_of(around.faces.begin(),
                         around.faces.end(),
                         [](const BlockFace<dim> &face) {
                           return !face.vertices.empty() && !face.law &&
                                  face.tensile_strength == 0.;
                         });
    }
  } // namespace



  template <int dim>
  bool
  balances_moments(const BlockSurroundings<dim> &around,
                   const BlockSupport<dim> &support,
                   const bool is_passive,
                   const std::vector<PointForce<dim>> &pressed,
                   const Tensor<1, dim> &way,
                   const double factor)
  {
    if (!knows_moments(around, support))
      return true;
    Tensor<1, dim> passive_way;
    std::vector<BlockFace<dim>> faces = around.faces;
    if (is_passive)
      passive_way = solve_with_laws<dim>(faces,
                                         around.loads.without_water() +
                                           support.shotcrete_load)
                      .direction;
    const auto divided = [&](const Tensor<1, dim> &force,
                             const bool is_against,
                             const bool is_reduced) {
      return is_against && is_reduced
               ? force -
                   (1. - 1. / factor) * (force * passive_way) * passive_way
               : force;
    };
    std::vector<PointForce<dim>> forces = around.loads.all(), bolts;
    if (support.shotcrete_load.norm() > 0.)
      forces.push_back({support.shotcrete_center, support.shotcrete_load});
    const bool is_against = sum_of(pressed) * passive_way < 0.;
    for (const PointForce<dim> &f : pressed)
      forces.push_back({f.place, divided(f.force, is_against, true)});
    for (const auto &pull : support.pulls)
      bolts.push_back({pull.place,
                       divided(pull.force * pull.along,
                               pull.along * passive_way < 0.,
                               pull.is_reduced)});
    return can_balance<dim>(around.faces, forces, bolts, way, factor);
  }



  template <int dim>
  double
  greatest_balanced_factor(const BlockSurroundings<dim> &around,
                           const BlockSupport<dim> &support,
                           const bool is_passive,
                           const Tensor<1, dim> &way,
                           const double most)
  {
    const auto balances = [&](const double factor) {
      return balances_moments<dim>(
        around, support, is_passive, {}, way, factor);
    };
    if (balances((1. - least_loss) * most))
      return most;
    if (most <= least_factor || !balances(least_factor))
      return 0.;
    double low = least_factor, high = most;
    for (unsigned int i = 0; i < n_factor_halvings; ++i)
      {
        const double middle             = std::sqrt(low * high);
        (balances(middle) ? low : high) = middle;
      }
    return low;
  }

#define INSTANTIATE(dim)                                                       \
  template bool balances_moments(const BlockSurroundings<dim> &,               \
                                 const BlockSupport<dim> &,                    \
                                 const bool,                                   \
                                 const std::vector<PointForce<dim>> &,         \
                                 const Tensor<1, dim> &,                       \
                                 const double);                                \
  template double greatest_balanced_factor(const BlockSurroundings<dim> &,     \
                                           const BlockSupport<dim> &,          \
                                           const bool,                         \
                                           const Tensor<1, dim> &,             \
                                           const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

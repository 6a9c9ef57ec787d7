// SPDX-License-Identifier: LGPL-2.1-or-later
// Limit equilibrium of a block with its support.
#include <keyblock/safety/block_support.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** By how much a reaction is changed to see what it does, over itself,
     * halvings by which its share is found, and changes that are none. */
    constexpr double share_step             = 1e-4;
    constexpr unsigned int n_share_halvings = 40;
    constexpr double round_off              = 1e-12;
  } // namespace



  namespace
  {
    template <int dim>
    LimitEquilibrium<dim>
    solve_with_active(std::vector<BlockFace<dim>> &faces,
                      const Tensor<1, dim> &load,
                      const BlockSupport<dim> &support)
    {
      const Tensor<1, dim> pulled = load + support.force();
      const LimitEquilibrium<dim> unsheared =
        solve_with_laws<dim>(faces, pulled);
      const Tensor<1, dim> way = unsheared.direction;
      if (way.norm() == 0.)
        return unsheared;
      Tensor<1, dim> reaction;
      for (const auto &force : support.forces_against(way))
        reaction += force.reaction;
      if (reaction.norm() == 0.)
        return unsheared;
      // what is sheared resists, and never by more than drives
      if (-(reaction * way) < unsheared.driving_force)
        return solve_with_laws<dim>(faces, pulled + reaction);
      LimitEquilibrium<dim> result;
      result.factor   = std::numeric_limits<double>::infinity();
      result.is_borne = true;
      return result;
    }

    /**
     * Set the @p share of the reactions' strength that is there by what
     * @p solve gives with it: reactions do not drive, so they grow no further
     * than what drives gets less, or stays, with the block on its planes, and
     * no further than they raise the factor. All grow alike, as the way that
     * shears them is one.
     * @param bears_across whether they also bear what would push a block that
     * falls aside, so that this counts as driving
     */
    template <int dim, typename Solve>
    void
    mobilize(const Solve &solve, const bool bears_across, double &share)
    {
      const auto with = [&](const double trial) {
        share = trial;
        return solve();
      };
      const LimitEquilibrium<dim> without = with(0.);
      if (without.mode == LimitEquilibrium<dim>::Mode::stable)
        return;
      // the greatest share at which something is no worse than just below,
      // as it gets better with less to begin with or never
      const auto greatest = [&](const double most, const auto &is_no_worse) {
        const auto grows = [&](const double trial) {
          return is_no_worse(with((1. - share_step) * trial), with(trial));
        };
        if (grows(most))
          return most;
        double low = 0., high = most;
        for (unsigned int i = 0; i < n_share_halvings; ++i)
          {
            const double middle          = 0.5 * (low + high);
            (grows(middle) ? low : high) = middle;
          }
        return low;
      };
      using Limit = LimitEquilibrium<dim>;
      const double driving_least =
        greatest(1., [&](const Limit &less, const Limit &more) {
          return more.mode != Limit::Mode::stable &&
                 (more.n_pressed > 0 || without.n_pressed == 0) &&
                 ((more.n_pressed == 0 && !bears_across) ||
                  more.driving_force <= (1. + round_off) * less.driving_force);
        });
      share = greatest(driving_least, [](const Limit &less, const Limit &more) {
        return more.factor >= (1. - round_off) * less.factor;
      });
    }

    /** The passive convention for a block that would take the @p way. */
    template <int dim>
    LimitEquilibrium<dim>
    resist_along(const Tensor<1, dim> &way,
                 std::vector<BlockFace<dim>> &faces,
                 const Tensor<1, dim> &load,
                 const BlockSupport<dim> &support)
    {
      const auto forces      = support.forces_against(way);
      double share_of_dowels = 0., share_of_sections = 0.;
      const auto solve = [&]() {
        Tensor<1, dim> loading = load;
        std::vector<double> resisting(forces.size());
        for (unsigned int i = 0; i < forces.size(); ++i)
          {
            const Tensor<1, dim> force =
              forces[i].pull +
              (forces[i].is_of_bolt ? share_of_dowels : share_of_sections) *
                forces[i].reaction;
            const double against = std::max(0., -(force * way));
            loading += force + against * way;
            resisting[i] = against;
          }
        LimitEquilibrium<dim> held = solve_with_laws<dim>(faces, loading);
        if (held.mode == LimitEquilibrium<dim>::Mode::stable)
          return held;
        for (unsigned int i = 0; i < forces.size(); ++i)
          held.add_resistance(resisting[i], forces[i].is_reduced);
        held.set_factor();
        return held;
      };
      for (const bool is_of_bolt : {true, false})
        if (std::any_of(forces.begin(), forces.end(), [&](const auto &force) {
              return force.is_of_bolt == is_of_bolt &&
                     force.reaction.norm() > 0.;
            }))
          mobilize<dim>(solve,
                        is_of_bolt,
                        is_of_bolt ? share_of_dowels : share_of_sections);
      return solve();
    }

    /** Let shotcrete hold all of a block that slides, off its planes, where it
     * is strong enough to give a greater factor than with them. */
    template <int dim>
    void
    hang_on_sections(const std::vector<BlockFace<dim>> &faces,
                     const Tensor<1, dim> &load,
                     const BlockSupport<dim> &support,
                     LimitEquilibrium<dim> &sliding)
    {
      Tensor<1, dim> resultant = load;
      for (const BlockFace<dim> &face : faces)
        resultant += face.water_force * face.inward;
      if (support.sections.empty() || sliding.n_pressed == 0 ||
          resultant.norm() == 0.)
        return;
      std::vector<BlockFace<dim>> none_pressed;
      const LimitEquilibrium<dim> hanging = resist_along<dim>(
        resultant / resultant.norm(), none_pressed, resultant, support);
      if (!(hanging.factor > sliding.factor))
        return;
      sliding.factor             = hanging.factor;
      sliding.driving_force      = hanging.driving_force;
      sliding.reduced_resistance = hanging.reduced_resistance;
      sliding.fixed_resistance   = hanging.fixed_resistance;
      for (double &force : sliding.normal_forces)
        force = 0.;
    }

    template <int dim>
    LimitEquilibrium<dim>
    solve_with_passive(std::vector<BlockFace<dim>> &faces,
                       const Tensor<1, dim> &load,
                       const BlockSupport<dim> &support)
    {
      LimitEquilibrium<dim> bare = solve_with_laws<dim>(faces, load);
      if (!support.holds() || bare.direction.norm() == 0.)
        return bare;
      LimitEquilibrium<dim> held =
        resist_along<dim>(bare.direction, faces, load, support);
      hang_on_sections<dim>(faces, load, support, held);
      return held;
    }
  } // namespace



  template <int dim>
  LimitEquilibrium<dim>
  solve_with_support(std::vector<BlockFace<dim>> &faces,
                     const Tensor<1, dim> &load,
                     const BlockSupport<dim> &support,
                     const bool is_passive)
  {
    const Tensor<1, dim> all_load = load + support.shotcrete_load;
    return is_passive ? solve_with_passive(faces, all_load, support)
                      : solve_with_active(faces, all_load, support);
  }

  template LimitEquilibrium<2> solve_with_support(std::vector<BlockFace<2>> &,
                                                  const Tensor<1, 2> &,
                                                  const BlockSupport<2> &,
                                                  const bool);
  template LimitEquilibrium<3> solve_with_support(std::vector<BlockFace<3>> &,
                                                  const Tensor<1, 3> &,
                                                  const BlockSupport<3> &,
                                                  const bool);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// The second phase of a trial of strength reduction: does the block speed up?
#include <keyblock/base/stop_request.h>
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/strength_trial.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Way over the size at which a growing motion is a failure [-]. */
    constexpr double failure_slip = 1e-3;

    // acceleration of slip over that of the block [-]
    constexpr double least_share = 0.3; ///< what the block slips on moves along
    constexpr double free_share  = 0.8; ///< the block moves by itself
    constexpr double most_share  = 1.25; ///< a neighbour slides past it

    // loss of acceleration of a block on its way to failure [-]
    constexpr double steady_alone = 0.1;  ///< of a block that moves by itself
    constexpr double steady_along = 0.01; ///< of one whose neighbours go along

    /** Slip over the block's compression by its load, before which speeding up
     * may be no more than strength that is not yet mobilised [-]. */
    constexpr double mobilising_slip = 0.02;

    /** Swings on such support that are watched at least. */
    constexpr double n_swings_watched = 2.;

    /** Half the windows over which such an acceleration must stay: longer where
     * slower blocks may move. */
    constexpr double half_steady = 3.;

    /** What a block and its slip have gained in speed over the last windows. */
    struct SpeedGain
    {
      double of_block; ///< size of the gain of its masses' velocity [m/s]
      bool is_passed;  ///< its neighbours slide past it: its slip tells nothing
      bool is_steady;  ///< it speeds up as a free body would
    };

    /** Of the last @p n_steady windows, from the speed of slip [m/s] and the
     * velocity of the block [m/s] at the ends of all of them. */
    template <int dim>
    SpeedGain
    last_gain(const std::vector<double> &slip,
              const std::vector<Vector<dim>> &block,
              const unsigned int n_steady)
    {
      const unsigned int end    = slip.size() - 1;
      const unsigned int middle = end - n_steady / 2;
      const unsigned int begin  = end - n_steady;
      const Vector<dim> gained  = add<dim>(block[end], -1., block[begin]);
      SpeedGain gain;
      gain.of_block = norm<dim>(gained);
      const double share =
        gain.of_block > 0. ? (slip[end] - slip[begin]) / gain.of_block : 0.;
      gain.is_passed            = share > most_share;
      const auto gained_between = [&](const unsigned int from,
                                      const unsigned int to) {
        return gain.is_passed
                 ? dot<dim>(add<dim>(block[to], -1., block[from]), gained) /
                     gain.of_block
                 : slip[to] - slip[from];
      };
      const double early = gained_between(begin, middle);
      const double loss  = share > free_share ? steady_alone : steady_along;
      gain.is_steady     = share > least_share && early > 0. &&
                       gained_between(middle, end) > (1. - loss) * early;
      return gain;
    }

    /** Speed over that of the middle of the phase, of a flow that goes on [-].
     */
    constexpr double steady_flow = 0.95;

    bool
    keeps_its_speed(const std::vector<double> &velocity)
    {
      const double middle = velocity[velocity.size() / 2];
      return middle > 0. && velocity.back() > steady_flow * middle;
    }
  } // namespace



  template <int dim>
  unsigned int
  StrengthTrials<dim>::watched_window(const TriedBlocks &tried) const
  {
    const double period = scene.safety.true_masses
                            ? 4. * blocks.blocks[tried.block].size /
                                (measures.wave_speed(tried.block) * run.step.dt)
                            : measures.period(tried.block);
    return std::max(1., std::ceil(scene.safety.window * period));
  }



  template <int dim>
  typename StrengthTrials<dim>::Verdict
  StrengthTrials<dim>::watch(const TriedBlocks &tried,
                             const double periods,
                             const Vector<dim> &first,
                             Trial &trial)
  {
    const double size           = blocks.blocks[tried.block].size;
    const unsigned int window   = watched_window(tried);
    const double seconds        = window * run.step.dt;
    const double slowness       = measures.slowness(tried);
    const unsigned int n_steady = 2 * std::ceil(half_steady * slowness);
    double n_windows =
      std::max(n_steady + 1.,
               slowness * std::min(periods, scene.safety.maximum_periods) /
                 scene.safety.window);
    const Motion at_rest = measures.motion(tried);
    const double passing =
      has_initial_stress(scene) ? measures.force_through(tried.block) : 0.;
    const double mass = measures.mass_in_use(tried.block);
    failure.begin(run.contact->report().mean_slip(tried.block));
    Motion before             = at_rest;
    SupportState<dim> support = measures.support(tried);
    std::vector<double> velocity(1, 0.);
    std::vector<Vector<dim>> block_velocity(1);
    double least          = std::numeric_limits<double>::max();
    bool is_left_in_peace = false;
    for (unsigned int w = 1; w <= n_windows; ++w)
      {
        pause();
        for (unsigned int step = 0; step < window; ++step)
          run.step.advance(false);
        trial.n_steps += window;
        const Motion now = measures.motion(tried);
        failure.add(run.contact->report().sum_over_block(tried.block));
        const Vector<dim> way   = add<dim>(now.slip, -1., at_rest.slip);
        const Vector<dim> moved = add<dim>(now.slip, -1., before.slip);
        const double slip       = norm<dim>(way);
        trial.slip              = norm<dim>(add<dim>(now.slip, -1., first));
        trial.unbalanced        = now.unbalanced;
        // of the slip along the way so far
        velocity.push_back(slip > 0. ? dot<dim>(moved, way) / (slip * seconds)
                                     : 0.);
        block_velocity.push_back(now.velocity);
        trial.velocity     = velocity[w];
        trial.acceleration = (velocity[w] - velocity[w - 1]) / seconds;
        const SupportState<dim> borne = measures.support(tried);
        const double swing =
          measures.swing_period(tried.block, support, borne, before, now);
        const bool rests =
          now.unbalanced < rest_unbalanced &&
          measures.way_between(before, now) * std::max(1., swing / window) <
            rest_slip * size;
        const bool is_taken_up = swing > 0.;
        n_windows = std::max(n_windows, n_swings_watched * swing / window);
        support   = borne;
        before    = now;
        const double unbalanced = measures.largest_unbalanced(tried, now);
        least                   = std::min(least, unbalanced);
        if (rests && is_as_good_as_at_rest(unbalanced))
          return Verdict::holds;
        // what leans on it neither comes to rest nor gains on that
        is_left_in_peace = rests && unbalanced <= 2. * least;
        const bool grows = w >= 3 && velocity[w] > velocity[w - 1] &&
                           velocity[w - 1] > velocity[w - 2] &&
                           velocity[w - 2] > 0.;
        const double own_way =
          norm<dim>(add<dim>(now.displacement, -1., at_rest.displacement));
        const double squeezed =
          measures.compression(tried.block, std::max(now.load, passing));
        const bool has_moved =
          slip > failure_slip * size &&
          own_way > std::max(failure_slip * size, squeezed);
        if (grows && has_moved && !is_taken_up)
          return Verdict::fails;
        if (w > n_steady)
          {
            // forces that stay and move the block as they would a free body;
            // one whose neighbours go along may be held by their stiffness
            // later
            const SpeedGain gain =
              last_gain<dim>(velocity, block_velocity, n_steady);
            const bool is_driven = mass * gain.of_block / (n_steady * seconds) >
                                   resolution * scene.safety.bracket * now.load;
            if (!is_taken_up && slip > mobilising_slip * squeezed &&
                (!gain.is_passed || own_way > squeezed) &&
                velocity[w - n_steady] >= 0. && gain.is_steady && is_driven)
              return Verdict::fails;
            if (!has_moved && !is_driven &&
                measures.has_passed(tried.block, slip))
              return Verdict::holds;
          }
      }
    // rock that yields flows at the speed that damping lets it have
    if (scene.safety.reduces_rock &&
        norm<dim>(add<dim>(before.slip, -1., at_rest.slip)) >
          mobilising_slip *
            measures.compression(tried.block, std::max(before.load, passing)) &&
        keeps_its_speed(velocity))
      return Verdict::fails;
    return is_left_in_peace ? Verdict::holds : Verdict::open;
  }



  template unsigned int
  StrengthTrials<2>::watched_window(const TriedBlocks &) const;
  template unsigned int
  StrengthTrials<3>::watched_window(const TriedBlocks &) const;
  template StrengthTrials<2>::Verdict
  StrengthTrials<2>::watch(const TriedBlocks &,
                           const double,
                           const Vector<2> &,
                           Trial &);
  template StrengthTrials<3>::Verdict
  StrengthTrials<3>::watch(const TriedBlocks &,
                           const double,
                           const Vector<3> &,
                           Trial &);
} // namespace Keyblock

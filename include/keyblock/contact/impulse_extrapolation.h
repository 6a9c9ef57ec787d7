// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_impulse_extrapolation_h
#define keyblock_contact_impulse_extrapolation_h

#include <keyblock/contact/solver.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Keyblock
{
  /** Limit of sweeps over the points of a group that shrink slowly, each the
   * same way as the one before: that of the geometric sequence which the last
   * two changes of the impulses begin (Aitken's, with the rate of the vectors);
   * and the way back from it. */
  template <int dim>
  class ImpulseExtrapolation
  {
  public:
    /** Sweeps from one extrapolation to the next. */
    static constexpr unsigned int interval = 8;

    ImpulseExtrapolation(std::vector<ContactPoint<dim>> &points,
                         const ContactNodes<dim> &nodes)
      : points(points)
      , nodes(nodes)
    {}

    /** A sweep has ended, the first one being 1. */
    void
    record(const unsigned int sweep)
    {
      const unsigned int phase = sweep % interval;
      if (phase == 0 || phase + 2 >= interval)
        {
          std::vector<Vector<dim>> &kept =
            impulses[phase == 0 ? 2 : phase + 2 - interval];
          kept.resize(points.size());
          for (unsigned int p = 0; p < points.size(); ++p)
            kept[p] = points[p].impulse;
        }
    }

    /** Move all points to the limit; whether there is one to move to. To be
     * called after the sweeps that interval divides. */
    bool
    go()
    {
      double product = 0., square = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        for (int d = 0; d < dim; ++d)
          {
            const double first = impulses[1][p][d] - impulses[0][p][d];
            const double last  = impulses[2][p][d] - impulses[1][p][d];
            product += first * last;
            square += first * first;
          }
      if (product <= slow_rate * square || product >= square)
        return false;
      const double n_sweeps = std::min(product / (square - product), longest);
      for (unsigned int p = 0; p < points.size(); ++p)
        move(p, n_sweeps, add<dim>(impulses[2][p], -1., impulses[1][p]));
      return true;
    }

    /** Back to where go() started. */
    void
    undo()
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        move(p, 1., add<dim>(impulses[2][p], -1., points[p].impulse));
    }

  private:
    static constexpr double slow_rate = 0.5; ///< least share left by a sweep
    static constexpr double longest   = 1e4; ///< sweeps that are passed over

    std::vector<ContactPoint<dim>> &points;
    const ContactNodes<dim> &nodes;
    std::array<std::vector<Vector<dim>>, 3> impulses; ///< the last ones

    void
    move(const unsigned int p, const double factor, Vector<dim> change)
    {
      for (double &component : change)
        component *= factor;
      apply_impulse<dim>(points[p], change, nodes);
      points[p].impulse = add<dim>(points[p].impulse, 1., change);
    }
  };
} // namespace Keyblock

#endif

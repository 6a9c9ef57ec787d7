// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_impulse_extrapolation_h
#define keyblock_contact_impulse_extrapolation_h

#include <keyblock/contact/solver.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /**
   * Limit of sweeps over the points of a group that shrink slowly: where the
   * impulses change from sweep to sweep by a matrix with few eigenvalues near
   * one, the combination of the last iterates whose change is least (reduced
   * rank extrapolation, Sidi 2017, Vector Extrapolation Methods; with one mode
   * Aitken's step with the rate of the vectors). Where they change by the same
   * in each sweep, as from one of two points that do the same to the other, as
   * far as the first point opens. And the way back from it.
   */
  template <int dim>
  class ImpulseExtrapolation
  {
  public:
    /** Sweeps from one extrapolation to the next. */
    static constexpr unsigned int interval = 8;

    ImpulseExtrapolation(std::vector<ContactPoint<dim>> &points,
                         const ContactNodes<dim> &nodes);

    /** A sweep has ended, the first one being 1. */
    void record(const unsigned int sweep);

    /** Move all points to the limit; whether there is one to move to. To be
     * called after the sweeps that interval divides. */
    bool go();

    /** Share of the changes of the impulses that the last sweep before go()
     * left [-]. */
    double
    rate() const
    {
      return share_left;
    }

    /** Back to where go() started. */
    void undo();

  private:
    static constexpr unsigned int n_modes = 3; ///< that are taken out at most
    static constexpr unsigned int n_kept  = n_modes + 2; ///< iterates
    static_assert(n_kept <= interval, "an extrapolation uses its own sweeps");

    std::vector<ContactPoint<dim>> &points;
    const ContactNodes<dim> &nodes;
    std::array<std::vector<Vector<dim>>, n_kept> impulses; ///< the last ones
    double share_left = 0.;                                ///< rate()
    std::vector<Vector<dim>> start; ///< impulses before the last leap

    /** Points whose impulses differ in the kept iterates. */
    std::vector<unsigned int> changing;

    /** Change of the impulses from kept iterate @p i to the next, or that of
     * its change with @p order 2 [N s]; dim entries a point of changing, as
     * in all that follow. */
    std::vector<double> difference(const unsigned int i,
                                   const unsigned int order) const;

    /** Sweeps, each with @p change, until a point's normal impulse ends [-]. */
    double sweeps_to_first_opening(const std::vector<double> &change) const;

    /** Add @p factor times @p direction to the impulses. */
    void move(const std::vector<double> &direction, const double factor);
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/impulse_extrapolation.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    constexpr double slow_rate = 0.5; ///< least share left by a sweep
    constexpr double shortest = 100., longest = 1e4; ///< sweeps passed over

    /** Change of the changes from sweep to sweep over them below which
     * impulses drift on a straight line; then at least the shortest leap is
     * made, whichever points open. */
    constexpr double drift_share = 1e-4;

    /** Share of a vector that its forerunners do not span below which it is
     * taken to be in their span. */
    constexpr double independent_share = 1e-6;

    double
    product(const std::vector<double> &a, const std::vector<double> &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }



    void
    add_to(std::vector<double> &a,
           const double factor,
           const std::vector<double> &b)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        a[i] += factor * b[i];
    }
  } // namespace



  template <int dim>
  ImpulseExtrapolation<dim>::ImpulseExtrapolation(
    std::vector<ContactPoint<dim>> &points,
    const ContactNodes<dim> &nodes)
    : points(points)
    , nodes(nodes)
  {}



  template <int dim>
  void
  ImpulseExtrapolation<dim>::record(const unsigned int sweep)
  {
    const unsigned int sweeps_to_go = (interval - sweep % interval) % interval;
    if (sweeps_to_go >= n_kept)
      return;
    std::vector<Vector<dim>> &kept = impulses[n_kept - 1 - sweeps_to_go];
    kept.resize(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      kept[p] = points[p].impulse;
  }



  template <int dim>
  std::vector<double>
  ImpulseExtrapolation<dim>::difference(const unsigned int i,
                                        const unsigned int order) const
  {
    std::vector<double> result;
    result.reserve(dim * changing.size());
    for (const unsigned int p : changing)
      for (int d = 0; d < dim; ++d)
        {
          const double change = impulses[i + 1][p][d] - impulses[i][p][d];
          result.push_back(order == 1 ? change
                                      : impulses[i + 2][p][d] -
                                          impulses[i + 1][p][d] - change);
        }
    return result;
  }



  template <int dim>
  bool
  ImpulseExtrapolation<dim>::go()
  {
    start = impulses.back();
    changing.clear();
    for (unsigned int p = 0; p < points.size(); ++p)
      if (std::any_of(impulses.begin() + 1,
                      impulses.end(),
                      [&](const std::vector<Vector<dim>> &kept) {
                        return kept[p] != impulses[0][p];
                      }))
        changing.push_back(p);
    std::vector<double> last        = difference(n_modes, 1);
    const std::vector<double> first = difference(n_modes - 1, 1);
    const double first_square       = product(first, first);
    const double last_square        = product(last, last);
    share_left                      = std::sqrt(last_square / first_square);
    std::vector<double> bend        = last;
    add_to(bend, -1., first);
    if (product(bend, bend) <= drift_share * drift_share * last_square)
      {
        move(last, std::max(shortest, sweeps_to_first_opening(last)));
        return true;
      }
    if (last_square <= slow_rate * slow_rate * first_square ||
        last_square >= first_square)
      return false;
    // the last change less its projection on the changes of the changes, the
    // latest of which come first; each takes its step along with it
    std::vector<std::vector<double>> basis, steps;
    std::vector<double> leap(last.size(), 0.);
    for (unsigned int i = n_modes; i-- > 0;)
      {
        std::vector<double> direction = difference(i, 2);
        std::vector<double> step      = difference(i + 1, 1);
        const double whole            = product(direction, direction);
        for (unsigned int pass = 0; pass < 2; ++pass)
          for (unsigned int j = 0; j < basis.size(); ++j)
            {
              const double share = product(direction, basis[j]);
              add_to(direction, -share, basis[j]);
              add_to(step, -share, steps[j]);
            }
        const double rest = product(direction, direction);
        if (rest <= independent_share * independent_share * whole)
          break;
        for (std::vector<double> *vector : {&direction, &step})
          for (double &entry : *vector)
            entry /= std::sqrt(rest);
        const double share = product(last, direction);
        add_to(last, -share, direction);
        add_to(leap, -share, step);
        basis.push_back(direction);
        steps.push_back(step);
      }
    const double length = std::sqrt(product(leap, leap) / last_square);
    move(leap, length > longest ? longest / length : 1.);
    return true;
  }



  template <int dim>
  double
  ImpulseExtrapolation<dim>::sweeps_to_first_opening(
    const std::vector<double> &change) const
  {
    double n_sweeps = longest;
    for (unsigned int i = 0; i < changing.size(); ++i)
      {
        const ContactPoint<dim> &point = points[changing[i]];
        const double r_n               = dot<dim>(point.impulse, point.normal);
        double loss                    = 0.;
        for (int d = 0; d < dim; ++d)
          loss -= change[dim * i + d] * point.normal[d];
        if (r_n > 0. && n_sweeps * loss > r_n)
          n_sweeps = r_n / loss;
      }
    return n_sweeps;
  }



  template <int dim>
  void
  ImpulseExtrapolation<dim>::move(const std::vector<double> &direction,
                                  const double factor)
  {
    for (unsigned int i = 0; i < changing.size(); ++i)
      {
        ContactPoint<dim> &point = points[changing[i]];
        Vector<dim> change;
        for (int d = 0; d < dim; ++d)
          change[d] = factor * direction[dim * i + d];
        apply_impulse<dim>(point, change, nodes);
        point.impulse = add<dim>(point.impulse, 1., change);
      }
  }



  template <int dim>
  void
  ImpulseExtrapolation<dim>::undo()
  {
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const Vector<dim> change = add<dim>(start[p], -1., points[p].impulse);
        apply_impulse<dim>(points[p], change, nodes);
        points[p].impulse = add<dim>(points[p].impulse, 1., change);
      }
  }

  template class ImpulseExtrapolation<2>;
  template class ImpulseExtrapolation<3>;
} // namespace Keyblock

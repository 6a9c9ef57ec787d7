// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/contact/impulse_extrapolation.h>
#include <keyblock/contact/point_response.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  template <int dim>
  double
  point_inverse_mass(const ContactPoint<dim> &point,
                     const ContactNodes<dim> &nodes)
  {
    double w = 0.;
    for (int k = 0; k < point.n_nodes; ++k)
      w +=
        point.weight[k] * point.weight[k] * nodes.inverse_mass[point.node[k]];
    return w;
  }



  template <int dim>
  Vector<dim>
  relative_velocity(const ContactPoint<dim> &point, const double *velocity)
  {
    Vector<dim> c{};
    for (int k = 0; k < point.n_nodes; ++k)
      for (int d = 0; d < dim; ++d)
        c[d] += point.weight[k] * velocity[dim * point.node[k] + d];
    return c;
  }



  template <int dim>
  void
  apply_impulse(const ContactPoint<dim> &point,
                const Vector<dim> &impulse,
                const ContactNodes<dim> &nodes)
  {
    for (int k = 0; k < point.n_nodes; ++k)
      {
        const double factor =
          point.weight[k] * nodes.inverse_mass[point.node[k]];
        double *v       = nodes.velocity + dim * point.node[k];
        const double *p = nodes.projection_of(point.node[k]);
        if (p == nullptr)
          for (int d = 0; d < dim; ++d)
            v[d] += factor * impulse[d];
        else
          for (int d = 0; d < dim; ++d)
            for (int e = 0; e < dim; ++e)
              v[d] += factor * p[dim * d + e] * impulse[e];
      }
  }



  namespace
  {
    /** One visit of a point: its new response to the present velocities, of
     * which its present impulse is a part. */
    template <int dim>
    PointResponse<dim>
    respond(const ContactPoint<dim> &point,
            const ContactNodes<dim> &nodes,
            const double step)
    {
      if (point.spring.is_elastic)
        return respond_elastically<dim>(point, nodes);
      // the velocity the point must not have: its own plus what closes the gap
      Vector<dim> u     = relative_velocity<dim>(point, nodes.velocity);
      const double bias = std::max(point.gap, 0.) / step;
      u                 = add<dim>(u, bias, point.normal);
      if (is_partly_held<dim>(point, nodes))
        {
          const Matrix<dim> w = inverse_mass_matrix<dim>(point, nodes);
          const Vector<dim> free_velocity =
            add<dim>(u, -1., multiply<dim>(w, point.impulse));
          return respond_with_matrix<dim>(point, w, free_velocity);
        }
      const double w = point_inverse_mass<dim>(point, nodes);
      return admissible_impulse<dim>(add<dim>(point.impulse, -1. / w, u),
                                     point.normal,
                                     point.strength);
    }

    // creep: momentum changes by at most this, over the largest impulse, and by
    // at most this share of what the impulses change, as they cancel; or as
    // much as some sweeps before
    constexpr double creep_tolerance      = 1e-6;
    constexpr double creep_share          = 1e-3;
    constexpr double creep_shrinkage      = 0.99;
    constexpr unsigned int creep_interval = 32;

    // larger changes that do not shrink go round in circles, as points stick
    // and slide in turns: steps of this share end it
    constexpr double relaxation_of_cycles = 0.5;

    // a point that opens so often in the sweeps of one solve, though its
    // cohesion would hold it while it is closed, loses that: with it no sweep
    // ends them
    constexpr unsigned char most_openings = 3;

    // a leap has failed if changes are larger by this after it; where they were
    // creep, of which a sweep leaves this share, that is as far as it goes
    constexpr double failed_leap   = 1.01;
    constexpr double rate_of_creep = 0.9997;

    // a point is visited again when a node of it has changed by this share of
    // what ends the sweeps
    constexpr double stale_share = 0.1;

    /** The nodes of a group, each once, and in which sweep they changed. */
    template <int dim>
    class GroupNodes
    {
    public:
      GroupNodes(const std::vector<ContactPoint<dim>> &points,
                 const ContactNodes<dim> &nodes)
        : nodes(nodes)
        , number(points.size())
      {
        for (const ContactPoint<dim> &point : points)
          list.insert(list.end(),
                      point.node.begin(),
                      point.node.begin() + point.n_nodes);
        sort_unique(list);
        for (unsigned int p = 0; p < points.size(); ++p)
          for (int k = 0; k < points[p].n_nodes; ++k)
            number[p][k] =
              std::lower_bound(list.begin(), list.end(), points[p].node[k]) -
              list.begin();
        changed_in.assign(list.size(), 0);
        touched_in.assign(list.size(), 0);
        before.resize(list.size());
      }

      /** Whether a node of point @p p may have changed since it was visited. */
      bool
      is_due(const ContactPoint<dim> &point, const unsigned int p) const
      {
        for (int k = 0; k < point.n_nodes; ++k)
          if (changed_in[number[p][k]] + 1 >= sweep ||
              touched_in[number[p][k]] == sweep)
            return true;
        return false;
      }

      /** Point @p p is about to change its nodes. */
      void
      touch(const ContactPoint<dim> &point, const unsigned int p)
      {
        for (int k = 0; k < point.n_nodes; ++k)
          {
            const unsigned int i = number[p][k];
            if (touched_in[i] == sweep)
              continue;
            touched_in[i] = sweep;
            touched.push_back(i);
            std::copy_n(nodes.velocity + dim * list[i], dim, before[i].begin());
          }
      }

      /** All nodes may have changed since the sweep that ended last. */
      void
      renew()
      {
        std::fill(changed_in.begin(), changed_in.end(), sweep - 1);
      }

      /** Largest change of momentum in the sweep [N s]; nodes that changed by
       * more than @p stale are to be looked at in the next. */
      double
      end_sweep(const double stale)
      {
        double largest = 0.;
        for (const unsigned int i : touched)
          {
            const double factor = nodes.inverse_mass[list[i]];
            double change       = 0.;
            for (int d = 0; d < dim && factor > 0.; ++d)
              change = std::max(change,
                                std::abs(nodes.velocity[dim * list[i] + d] -
                                         before[i][d]) /
                                  factor);
            if (change > stale)
              changed_in[i] = sweep;
            largest = std::max(largest, change);
          }
        touched.clear();
        ++sweep;
        return largest;
      }

    private:
      const ContactNodes<dim> &nodes;
      std::vector<unsigned int> list; ///< the nodes

      /** Indices in list, of each point's nodes. */
      std::vector<std::array<unsigned int, ContactPoint<dim>::max_nodes>>
        number;
      unsigned int sweep = 1;
      std::vector<unsigned int> changed_in, touched_in; ///< sweep
      std::vector<Vector<dim>> before; ///< velocity at its start [m/s]
      std::vector<unsigned int> touched;
    };

    /**
     * Sweep over the points until no node's momentum changes any more. That of
     * the nodes, not the impulses: where two points do the same, as two nodes
     * that lie on each other's faces, impulse creeps from one to the other for
     * long and nothing moves. If their normals differ a little the nodes creep
     * along, and where points contradict each other by rounding they drift:
     * small changes that are the difference of large ones, or do not shrink,
     * end the sweeps as well.
     */
    template <int dim>
    SolverReport
    iterate(std::vector<ContactPoint<dim>> &points,
            const ContactNodes<dim> &nodes,
            const SolverSettings &settings)
    {
      double largest = 0., impulse_change = 0., relaxation = 1.;
      std::vector<unsigned char> n_openings; // by point, once one opens
      const auto visit = [&](const unsigned int p) {
        ContactPoint<dim> &point    = points[p];
        PointResponse<dim> response = respond<dim>(point, nodes, settings.step);
        if (response.status == ContactStatus::open &&
            point.status != ContactStatus::open && !point.is_intact)
          {
            n_openings.resize(points.size(), 0);
            if (n_openings[p] < most_openings &&
                ++n_openings[p] == most_openings)
              point.strength.cohesion = point.strength.tension = 0.;
          }
        Vector<dim> difference = add<dim>(response.impulse, -1., point.impulse);
        if (relaxation != 1.)
          {
            for (double &component : difference)
              component *= relaxation;
            response.impulse = add<dim>(point.impulse, 1., difference);
          }
        apply_impulse<dim>(point, difference, nodes);
        point.impulse  = response.impulse;
        point.status   = response.status;
        impulse_change = std::max(impulse_change, norm<dim>(difference));
        largest        = std::max(largest, norm<dim>(response.impulse));
      };
      SolverReport report;
      if (points.size() == 1)
        {
          visit(0);
          report.n_iterations = 1;
          return report;
        }
      GroupNodes<dim> group(points, nodes);
      ImpulseExtrapolation<dim> extrapolation(points, nodes);
      bool is_extrapolated      = false;
      double change_before_leap = 0.;
      double earlier_change     = std::numeric_limits<double>::max();
      while (report.n_iterations < settings.maximum_iterations)
        {
          ++report.n_iterations;
          impulse_change = 0.;
          for (unsigned int p = 0; p < points.size(); ++p)
            if (group.is_due(points[p], p))
              {
                group.touch(points[p], p);
                visit(p);
              }
          const double change =
            group.end_sweep(stale_share * settings.tolerance * largest);
          const bool is_small = change <= creep_tolerance * largest;
          if (change <= settings.tolerance * largest ||
              (is_small && change <= creep_share * impulse_change))
            return report;
          extrapolation.record(report.n_iterations);
          if (report.n_iterations % extrapolation.interval == 0)
            {
              if (is_extrapolated && change > failed_leap * change_before_leap)
                {
                  extrapolation.undo();
                  group.renew();
                  is_extrapolated = false;
                  if (change_before_leap <= creep_tolerance * largest &&
                      extrapolation.rate() >= rate_of_creep)
                    return report;
                }
              else
                {
                  change_before_leap = change;
                  is_extrapolated    = extrapolation.go();
                  if (is_extrapolated)
                    group.renew();
                }
            }
          if (report.n_iterations % creep_interval == 0)
            {
              const bool has_shrunk =
                change <= creep_shrinkage * earlier_change;
              if (is_small && !has_shrunk)
                return report;
              if (!has_shrunk)
                relaxation = relaxation_of_cycles;
              earlier_change = change;
            }
        }
      report.is_capped = true;
      return report;
    }

    /** The intact point whose strength falls shortest of what would stop it,
     * or -1 if all of them stick. */
    template <int dim>
    int
    worst_intact_point(const std::vector<ContactPoint<dim>> &points,
                       const ContactNodes<dim> &nodes)
    {
      int worst      = -1;
      double largest = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        if (points[p].is_intact && points[p].status != ContactStatus::sticking)
          {
            const Vector<dim> u =
              relative_velocity<dim>(points[p], nodes.velocity);
            const double w = point_inverse_mass<dim>(points[p], nodes);
            const Vector<dim> stick =
              points[p].spring.is_elastic
                ? elastic_trial<dim>(points[p], nodes)
                : add<dim>(points[p].impulse, -1. / w, u);
            const double excess =
              violation<dim>(stick, points[p].normal, points[p].strength);
            if (worst < 0 || excess > largest)
              {
                worst   = p;
                largest = excess;
              }
          }
      return worst;
    }
  } // namespace



  template <int dim>
  SolverReport
  solve_group(std::vector<ContactPoint<dim>> &points,
              const std::vector<PointStrength> &broken,
              const ContactNodes<dim> &nodes,
              const SolverSettings &settings)
  {
    for (ContactPoint<dim> &point : points)
      apply_impulse<dim>(point, point.impulse, nodes);
    SolverReport report = iterate<dim>(points, nodes, settings);
    int worst           = -1;
    while ((worst = worst_intact_point<dim>(points, nodes)) >= 0)
      {
        points[worst].is_intact  = false;
        points[worst].strength   = broken[worst];
        const SolverReport again = iterate<dim>(points, nodes, settings);
        report.n_iterations += again.n_iterations;
        report.is_capped = report.is_capped || again.is_capped;
      }
    return report;
  }

#define INSTANTIATE(dim)                                                       \
  template double point_inverse_mass(const ContactPoint<dim> &,                \
                                     const ContactNodes<dim> &);               \
  template Vector<dim> relative_velocity<dim>(const ContactPoint<dim> &,       \
                                              const double *);                 \
  template void apply_impulse<dim>(const ContactPoint<dim> &,                  \
                                   const Vector<dim> &,                        \
                                   const ContactNodes<dim> &);                 \
  template SolverReport solve_group(std::vector<ContactPoint<dim>> &,          \
                                    const std::vector<PointStrength> &,        \
                                    const ContactNodes<dim> &,                 \
                                    const SolverSettings &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

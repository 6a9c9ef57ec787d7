// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/point_solver.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  PointSolver<dim>::PointSolver(const Scene<dim> &scene, ContactTally &tally)
    : scene(scene)
    , tally(tally)
  {}


  template <int dim>
  void
  PointSolver<dim>::solve(std::vector<ContactPoint<dim>> &points,
                          const std::vector<PointStrength> &broken,
                          const ContactNodes<dim> &nodes,
                          const double step,
                          const bool counts_cap)
  {
    const SolverSettings settings{step,
                                  scene.contact.tolerance,
                                  scene.contact.maximum_iterations};
    if (scene.contact.is_published_variant())
      {
        solve_as_published<dim>(points, broken, nodes, settings);
        return;
      }
    const SolverReport report =
      solve_group<dim>(points, broken, nodes, settings);
    tally.n_capped += report.is_capped && counts_cap;
    ++tally.n_solved;
    tally.n_iterations = std::max(tally.n_iterations, report.n_iterations);
  }



  template <int dim>
  void
  PointSolver<dim>::book(const ContactPoint<dim> &point,
                         const double *old_velocity,
                         const double *new_velocity)
  {
    const Vector<dim> mean =
      add<dim>(relative_velocity<dim>(point, old_velocity),
               1.,
               relative_velocity<dim>(point, new_velocity));
    const double r_n = dot<dim>(point.impulse, point.normal);
    const double all = -0.5 * dot<dim>(point.impulse, mean);
    if (point.spring.is_elastic)
      {
        book_spring(point, all, relative_velocity<dim>(point, new_velocity));
        return;
      }
    const double closure = -0.5 * r_n * dot<dim>(point.normal, mean);
    const bool dilates =
      point.strength.dilation > 0. && point.status == ContactStatus::sliding;
    (dilates ? tally.work.dilation : tally.work.closure) += closure;
    tally.work.friction += all - closure;
  }

  template <int dim>
  void
  PointSolver<dim>::book_spring(const ContactPoint<dim> &point,
                                const double work,
                                const Vector<dim> &velocity)
  {
    const PointSpring<dim> &spring = point.spring;
    const SpringChange<dim> change = advance_spring<dim>(spring,
                                                         point.impulse,
                                                         point.normal,
                                                         velocity,
                                                         point.status,
                                                         point.strength);
    const double stored = spring.energy(change.after.force, point.normal) -
                          spring.energy(spring.before.force, point.normal);
    const double friction = -dot<dim>(point.impulse, change.slip) / spring.kick;
    const bool dilates =
      point.strength.dilation > 0. && point.status == ContactStatus::sliding;
    tally.work.elastic += stored;
    tally.work.friction += friction;
    (dilates ? tally.work.dilation : tally.work.closure) +=
      work - stored - friction;
  }



  template <int dim>
  void
  PointSolver<dim>::book_spring_energy(const double energy)
  {
    tally.work.elastic += energy;
    tally.work.closure -= energy;
  }

  template class PointSolver<2>;
  template class PointSolver<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_point_solver_h
#define keyblock_contact_point_solver_h

#include <keyblock/contact/state.h>
#include <keyblock/contact/topology.h>

namespace Keyblock
{

  /** Solves groups of points by the scene's method and books what they do. */
  template <int dim>
  class PointSolver
  {
  public:
    PointSolver(const Scene<dim> &scene, ContactTally &tally);

    /** Solve points that belong together: see solve_group.
     * @param step dt of the coming move [s]
     * @param counts_cap whether to count the group if it reaches the cap */
    void solve(std::vector<ContactPoint<dim>> &points,
               const std::vector<PointStrength> &broken,
               const ContactNodes<dim> &nodes,
               const double step,
               const bool counts_cap);

    /** Add the work of a point's impulse between two velocities of its nodes.
     */
    void book(const ContactPoint<dim> &point,
              const double *old_velocity,
              const double *new_velocity);

    /** Add @p energy [J] of springs that has come without work, as that of a
     * point that takes another's place; negative: gone. */
    void book_spring_energy(const double energy);

  private:
    /** book() of a compliant point: of the @p work [J] that it took a part is
     * stored, a part friction, the rest what damps the spring. */
    void book_spring(const ContactPoint<dim> &point,
                     const double work,
                     const Vector<dim> &velocity);

    const Scene<dim> &scene;
    ContactTally &tally;
  };
} // namespace Keyblock

#endif

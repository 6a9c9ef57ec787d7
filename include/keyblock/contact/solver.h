// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_solver_h
#define keyblock_contact_solver_h

#include <keyblock/contact/point_spring.h>

#include <vector>

namespace Keyblock
{
  /**
   * A contact point: nodes with signed weights (the slave +1, masters -phi).
   * Relative velocity c = sum a_k v_k, force on node k is a_k R.
   */
  template <int dim>
  struct ContactPoint
  {
    /** A node and a face, in 3D a hanging node's masters for each at most. */
    static constexpr int max_nodes = dim == 2 ? 3 : 10;

    int n_nodes = 0;
    std::array<unsigned int, max_nodes> node{}; ///< index into the arrays
    std::array<double, max_nodes> weight{};     ///< a_k [-]
    Vector<dim> normal{};
    double gap = 0.; ///< [m], positive when open
    PointStrength strength;
    bool is_intact = false;
    PointSpring<dim> spring; ///< of a compliant joint; then gap does not count

    Vector<dim> impulse{}; ///< on the slave [N s]; start value and result
    ContactStatus status = ContactStatus::open;
  };

  /** The nodes a group acts on: dim velocities and one inverse mass each;
   * directions held, if any, take no impulse. */
  template <int dim>
  struct ContactNodes
  {
    double *velocity           = nullptr;
    const double *inverse_mass = nullptr;

    /** For each node either null or the projection P that removes held
     * directions, dim x dim by rows; inverse mass matrix is P / m. */
    const std::vector<const double *> *projection = nullptr;

    const double *
    projection_of(const unsigned int node) const
    {
      return projection == nullptr ? nullptr : (*projection)[node];
    }
  };

  /** How exactly groups are solved, and for which step. */
  struct SolverSettings
  {
    double step      = 0.;    ///< dt of the coming move [s]
    double tolerance = 1e-10; ///< change in a sweep over impulses [-]
    unsigned int maximum_iterations = 2000; ///< sweeps over the group
  };

  /** How a group was solved. */
  struct SolverReport
  {
    unsigned int n_iterations = 0;
    bool is_capped            = false; ///< ended by maximum_iterations
  };

  /**
   * Solve a group of coupled points by block projected Gauss-Seidel from the
   * impulses the points start with: velocities must contain the predictor
   * only. Intact points that cannot stick within their strength lose their
   * bond (is_intact = false, strength from @p broken), the worst one first,
   * and the group is solved again.
   *
   * On return velocities contain the impulses and points their final state.
   */
  template <int dim>
  SolverReport solve_group(std::vector<ContactPoint<dim>> &points,
                           const std::vector<PointStrength> &broken,
                           const ContactNodes<dim> &nodes,
                           const SolverSettings &settings);

  /**
   * The published variant as a baseline (Chen, Xiao and Chen 2020, equations
   * 14 to 20, without their factor 2): every point for itself from the
   * predicted velocities, in one pass; the gap is closed in one step, overlap
   * included; a pulled point separates when its total force exceeds c A; the
   * mass of a point on a surface is that of equation 20 and its force is shared
   * by mass.
   * Points that share nodes do not know of each other, so that corners may
   * diverge.
   */
  template <int dim>
  void solve_as_published(std::vector<ContactPoint<dim>> &points,
                          const std::vector<PointStrength> &broken,
                          const ContactNodes<dim> &nodes,
                          const SolverSettings &settings);

  /** Inverse mass of a point in all directions, sum a_k^2 / m_k [1/kg]; only
   * for points without partly held nodes. */
  template <int dim>
  double point_inverse_mass(const ContactPoint<dim> &point,
                            const ContactNodes<dim> &nodes);

  /** Relative velocity sum a_k v_k [m/s]. */
  template <int dim>
  Vector<dim> relative_velocity(const ContactPoint<dim> &point,
                                const double *velocity);

  /** Add @p impulse, times the weights, to the nodes' velocities. */
  template <int dim>
  void apply_impulse(const ContactPoint<dim> &point,
                     const Vector<dim> &impulse,
                     const ContactNodes<dim> &nodes);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/joint_springs.h>

namespace Keyblock
{
  namespace
  {
    /** Up to this product of the spring's frequency and the step, squared, its
     * force keeps energy; stiffer ones are damped the more, as their own motion
     * takes a few steps only, until they are rigid [-]. */
    constexpr double resolved_stiffness = 4.;

    /** Share of the move at which a spring's force is taken
     * (PointSpring::tau). */
    double
    share_of(const double squared_frequency_times_step)
    {
      return squared_frequency_times_step <= resolved_stiffness
               ? 0.5
               : 1. - 0.5 * resolved_stiffness / squared_frequency_times_step;
    }
  } // namespace



  template <int dim>
  JointSprings<dim>::JointSprings(const PairTopology<dim> &topology,
                                  const ContactStrength<dim> &strength,
                                  const SurfaceNodes<dim> &nodes,
                                  PointSolver<dim> &solver,
                                  ContactMemory<dim> &memory)
    : topology(topology)
    , interface(topology.interface)
    , surface(topology.surface)
    , strength(strength)
    , nodes(nodes)
    , solver(solver)
    , memory(memory)
  {
    for (const auto &joint : topology.scene.joints)
      {
        stiffness.emplace_back(*joint);
        is_any = is_any || stiffness.back().is_compliant();
      }
    allocate();
  }



  template <int dim>
  void
  JointSprings<dim>::allocate()
  {
    if (is_any)
      memory.pair_springs.resize(interface.pairs.size());
  }



  template <int dim>
  bool
  JointSprings<dim>::is_elastic(const unsigned int pair) const
  {
    return is_any && stiffness[interface.pairs[pair].joint].is_compliant() &&
           !memory.state[pair].is_welded && !strength.is_tied &&
           !topology.scene.contact.tie_all && !present.is_settling;
  }



  template <int dim>
  PointSpring<dim>
  JointSprings<dim>::make_spring(const unsigned int joint,
                                 const double area,
                                 const double inverse_mass,
                                 const bool is_partly_held,
                                 const SpringState<dim> &before) const
  {
    PointSpring<dim> spring;
    spring.is_elastic  = true;
    spring.normal      = stiffness[joint].normal * area;
    spring.shear       = stiffness[joint].shear * area;
    spring.kick        = present.kick;
    spring.step        = present.step;
    spring.before      = before;
    const double scale = present.kick * present.step * inverse_mass;
    const auto share   = [&](const double stiffness) {
      return present.seeks_rest ? 1. : share_of(scale * stiffness);
    };
    spring.tau       = share(spring.normal);
    spring.tau_shear = share(spring.shear);
    if (is_partly_held)
      spring.tau = spring.tau_shear = std::min(spring.tau, spring.tau_shear);
    return spring;
  }



  template <int dim>
  void
  JointSprings<dim>::put_into_pair(const unsigned int pair,
                                   const double inverse_mass,
                                   const bool is_partly_held,
                                   ContactPoint<dim> &point) const
  {
    if (!is_elastic(pair))
      return;
    const Pair<dim> &p = interface.pairs[pair];
    point.spring       = make_spring(
      p.joint, p.area, inverse_mass, is_partly_held, memory.pair_springs[pair]);
    point.gap = dot<dim>(memory.pair_springs[pair].stretch, point.normal);
  }



  template <int dim>
  void
  JointSprings<dim>::take_up_pair(const unsigned int pair,
                                  const ContactPoint<dim> &point,
                                  const Vector<dim> &velocity)
  {
    if (!is_any)
      return;
    if (point.spring.is_elastic)
      memory.pair_springs[pair] = advance_spring<dim>(point.spring,
                                                      point.impulse,
                                                      point.normal,
                                                      velocity,
                                                      point.status,
                                                      point.strength)
                                    .after;
    else
      take_up_rigid(pair, point.impulse);
  }



  template <int dim>
  void
  JointSprings<dim>::take_up_rigid(const unsigned int pair,
                                   const Vector<dim> &impulse)
  {
    const Pair<dim> &p          = interface.pairs[pair];
    const JointStiffness &joint = stiffness[p.joint];
    if (!is_any || !joint.is_compliant() || p.area <= 0.)
      return;
    SpringState<dim> &spring = memory.pair_springs[pair];
    spring.force   = add<dim>(Vector<dim>{}, 1. / present.kick, impulse);
    spring.stretch = scale_parts<dim>(spring.force,
                                      memory.normal[pair],
                                      -1. / (joint.normal * p.area),
                                      -1. / (joint.shear * p.area));
  }



  template <int dim>
  void
  JointSprings<dim>::pass_on(const unsigned int pair)
  {
    const Pair<dim> &p = interface.pairs[pair];
    if (!is_any || (norm<dim>(memory.pair_springs[pair].force) == 0. &&
                    norm<dim>(memory.pair_springs[pair].stretch) == 0.))
      return;
    for (const unsigned int vertex : {p.minus, p.plus})
      {
        const double side       = vertex == p.plus ? 1. : -1.;
        NodeSpring<dim> &spring = at(surface.node_of_vertex[vertex], p.joint);
        const SpringState<dim> &past = memory.pair_springs[pair];
        // of several pairs on one joint the node bears all forces
        const bool is_further =
          spring.last_step == memory.n_steps && norm<dim>(spring.normal) > 0.;
        if (!is_further)
          {
            spring.state      = {};
            spring.has_offset = false;
            spring.normal = add<dim>(Vector<dim>{}, side, memory.normal[pair]);
            spring.state.stretch = add<dim>(Vector<dim>{}, side, past.stretch);
          }
        spring.state.force = add<dim>(spring.state.force, side, past.force);
        spring.last_step   = memory.n_steps;
      }
    if (topology.is_primary(topology.group_of_pair[pair]))
      {
        const PointSpring<dim> spring =
          make_spring(p.joint, p.area, 0., false, {});
        solver.book_spring_energy(
          -spring.energy(memory.pair_springs[pair].force, memory.normal[pair]));
      }
    memory.pair_springs[pair] = {};
  }



  template <int dim>
  void
  JointSprings<dim>::turn_pairs(const std::vector<Vector<dim>> &old_normals)
  {
    for (unsigned int p = 0; p < memory.pair_springs.size(); ++p)
      for (Vector<dim> *v :
           {&memory.pair_springs[p].force, &memory.pair_springs[p].stretch})
        *v = turn<dim>(*v, old_normals[p], memory.normal[p]);
  }



  template <int dim>
  double
  JointSprings<dim>::energy() const
  {
    double sum = 0.;
    for (unsigned int p = 0; p < memory.pair_springs.size(); ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (stiffness[pair.joint].is_compliant() && pair.area > 0. &&
            !memory.state[p].is_converted && !memory.state[p].is_removed &&
            topology.is_primary(topology.group_of_pair[p]))
          sum += make_spring(pair.joint, pair.area, 0., false, {})
                   .energy(memory.pair_springs[p].force, memory.normal[p]);
      }
    if (topology.numbering.communicator.is_root())
      for (const NodeSpring<dim> &spring : memory.node_springs)
        sum += spring.stored;
    return sum;
  }

  template class JointSprings<2>;
  template class JointSprings<3>;
} // namespace Keyblock

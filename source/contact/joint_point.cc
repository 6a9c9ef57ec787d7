// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/joint_point.h>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    typename JointPoint<dim>::State
    state_of(const PairState<dim> &pair)
    {
      using State = typename JointPoint<dim>::State;
      if (pair.is_removed)
        return State::open;
      if (pair.is_welded)
        return State::welded;
      if (pair.is_intact)
        return State::bonded;
      return pair.status == ContactStatus::sticking  ? State::sticking
             : pair.status == ContactStatus::sliding ? State::sliding
                                                     : State::open;
    }
  } // namespace



  template <int dim>
  JointPoint<dim>::JointPoint(const Pair<dim> &pair,
                              const PairState<dim> &at,
                              const Vector<dim> &jump,
                              const double kick)
    : jump(jump)
    , state(state_of(at))
  {
    for (int d = 0; d < dim; ++d)
      {
        normal[d] = pair.normal[d];
        stress[d] = at.impulse[d] / (kick * pair.area);
      }
  }



  template <int dim>
  double
  JointPoint<dim>::gap() const
  {
    return dot<dim>(jump, normal);
  }



  template <int dim>
  Vector<dim>
  JointPoint<dim>::slip() const
  {
    return add<dim>(jump, -gap(), normal);
  }



  template <int dim>
  double
  JointPoint<dim>::pressure() const
  {
    return dot<dim>(stress, normal);
  }



  template <int dim>
  Vector<dim>
  JointPoint<dim>::shear() const
  {
    return add<dim>(stress, -pressure(), normal);
  }



  const std::vector<std::string> &
  joint_state_names()
  {
    static const std::vector<std::string> names = {
      "bonded", "sticking", "sliding", "open", "welded", "none"};
    return names;
  }

  template struct JointPoint<2>;
  template struct JointPoint<3>;
} // namespace Keyblock

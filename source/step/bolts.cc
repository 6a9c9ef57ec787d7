// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/bolts.h>

#include <keyblock/base/sort_unique.h>
#include <keyblock/step/row_bound.h>

namespace Keyblock
{
  template <int dim>
  Bolts<dim>::Bolts(const Scene<dim> &scene,
                    const SplitMesh<dim> &split,
                    const Numbering<dim> &numbering)
    : numbering(numbering)
    , trial(scene.safety.bolt_convention)
  {
    for (const Bolt<dim> &bolt : split.bolts)
      bolts.emplace_back(bolt, scene);
  }



  template <int dim>
  void
  Bolts<dim>::take_ground(const Ground<dim> &ground)
  {
    stage_number = ground.stage_number;
    points.clear();
    unsigned int n_jumps = 0;
    for_each_present(bolts, [&](BoltInRock<dim> &bolt) {
      bolt.take_ground(ground, numbering);
      points.add_bolt(bolt.direction(), bolt.points(), bolt.n_nodes());
      n_jumps += bolt.n_jumps();
    });
    motion.assign(points.size() + dim * n_jumps, 0.);
  }



  template <int dim>
  std::vector<unsigned int>
  Bolts<dim>::nodes() const
  {
    std::vector<unsigned int> list;
    for_each_present(bolts, [&](const BoltInRock<dim> &bolt) {
      for (const RockBinding<dim> &point : bolt.points())
        for (const auto &[node, weight] : point.carriers)
          list.push_back(node);
    });
    sort_unique(list);
    return list;
  }



  template <int dim>
  void
  Bolts<dim>::gather(const std::vector<double> &displacement)
  {
    points.gather(displacement, motion.data());
    double *jump = motion.data() + points.size();
    for_each_present(bolts, [&](const BoltInRock<dim> &bolt) {
      bolt.get_jumps(displacement, jump);
      jump += dim * bolt.n_jumps();
    });
    if (numbering.communicator.size() > 1)
      numbering.communicator.sum_lists(motion);
  }



  template <int dim>
  template <typename Action>
  void
  Bolts<dim>::for_each_motion(const Action &action)
  {
    double *along = motion.data();
    double *jump  = motion.data() + points.size();
    for_each_present(bolts, [&](BoltInRock<dim> &bolt) {
      action(bolt, along, jump);
      along += bolt.n_nodes();
      jump += dim * bolt.n_jumps();
    });
  }



  template <int dim>
  void
  Bolts<dim>::add_force(const std::vector<double> &displacement,
                        std::vector<double> &force)
  {
    if (motion.empty())
      return;
    gather(displacement);
    for_each_motion([&](BoltInRock<dim> &bolt, double *along, double *jump) {
      bolt.respond(along, jump);
      if (bolt.n_jumps() > 0 || !trial.is_whole())
        bolt.subtract_at_joints(trial, force);
    });
    // the force counts against what it does to the rock
    points.subtract(motion.data(), force);
  }



  template <int dim>
  bool
  Bolts<dim>::has_product() const
  {
    return !motion.empty();
  }



  template <int dim>
  void
  Bolts<dim>::add_product(const std::vector<double> &displacement,
                          std::vector<double> &force)
  {
    if (motion.empty())
      return;
    gather(displacement);
    for_each_motion([&](BoltInRock<dim> &bolt, double *along, double *jump) {
      bolt.multiply(along, jump, force);
    });
    points.subtract(motion.data(), force);
  }



  template <int dim>
  StepBound
  Bolts<dim>::step_bound(const std::vector<double> &inverse_mass) const
  {
    // sums of rows of the stiffness: weights of a point add up to one
    std::vector<double> row(numbering.n_owned(), 0.);
    for_each_present(bolts, [&](const BoltInRock<dim> &bolt) {
      bolt.for_each_stiffness_bound(trial.largest_share(),
                                    [&](const RockBinding<dim> &point,
                                        const double stiffness) {
                                      for (const auto &[node, weight] :
                                           point.carriers)
                                        row[node] += stiffness * weight;
                                    });
    });
    return bound_of_rows(row, inverse_mass, numbering);
  }



  template <int dim>
  double
  Bolts<dim>::stored_energy(const std::vector<double> &) const
  {
    double energy = 0.;
    if (numbering.communicator.is_root())
      for_each_present(bolts, [&](const BoltInRock<dim> &bolt) {
        energy += bolt.stored_energy();
      });
    return energy;
  }



  template <int dim>
  double
  Bolts<dim>::plastic_work() const
  {
    double work = 0.;
    if (numbering.communicator.is_root())
      for_each_present(bolts, [&](const BoltInRock<dim> &bolt) {
        work += bolt.dissipated_energy();
      });
    return work;
  }



  template <int dim>
  ForceElementState
  Bolts<dim>::remember() const
  {
    ForceElementState state{name(), {}, {}};
    for (const BoltInRock<dim> &bolt : bolts)
      bolt.remember(state.numbers);
    return state;
  }



  template <int dim>
  void
  Bolts<dim>::recall(const ForceElementState &state)
  {
    std::size_t at = 0;
    for (BoltInRock<dim> &bolt : bolts)
      bolt.recall(state.numbers, at);
  }



  template <int dim>
  std::vector<BoltReport<dim>>
  Bolts<dim>::report() const
  {
    std::vector<BoltReport<dim>> reports;
    for_each_present(bolts, [&](const BoltInRock<dim> &bolt) {
      if (bolt.is_installed())
        reports.push_back(bolt.report());
    });
    return reports;
  }

  template <int dim>
  BrokenSegments
  Bolts<dim>::broken_segments() const
  {
    BrokenSegments broken;
    for (const BoltInRock<dim> &bolt : bolts)
      broken.push_back(bolt.broken_segments());
    return broken;
  }

  template class Bolts<2>;
  template class Bolts<3>;
} // namespace Keyblock

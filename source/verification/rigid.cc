// SPDX-License-Identifier: LGPL-2.1-or-later
// Closed forms of bodies that move as rigid ones: on joints, and free.
#include <keyblock/verification/tools.h>

namespace Keyblock
{
  namespace
  {
    /** What an acceleration along the joint has to overcome, by a cohesion [Pa]
     * over the area on which the body stands [m/s2]. */
    template <int dim>
    double
    resistance_of_cohesion(const CheckInput<dim> &input,
                           const Block<dim> &block,
                           const double cohesion)
    {
      const auto joints = input.scene.joints_called(input.scene.checks.joint);
      double area       = 0.;
      for (const auto &[joint, part] : block.joint_area)
        if (std::count(joints.begin(), joints.end(), joint) > 0)
          area += part;
      return cohesion * area / block.mass;
    }
  } // namespace



  /** Block that slides on an incline: a = g (sin - cos tan phi) - c A / m, with
   * what is left of the cohesion c, if the whole base stays closed (where an
   * edge opens, its cohesion is lost); one that holds by cohesion and friction
   * stays.
   */
  template <int dim>
  CheckValues
  check_incline(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const Block<dim> &block = input.blocks.blocks[body.body];
    const double tangent =
      tangent_of_kinetic_friction(body.joint->friction_angle,
                                  body.joint->kinetic_friction_angle);
    const double drive = body.gravity * body.downhill;
    const double press = std::abs(body.gravity * body.normal);
    const double start = body.time.front() - input.stages.back().time_step;
    const double held =
      resistance_of_cohesion(input, block, body.joint->cohesion);
    const double sliding =
      tangent * press +
      resistance_of_cohesion(input, block, body.joint->cohesion_of_sliding());
    const double shear_per_mass =
      held > 0. && drive <= held + press * std::tan(body.joint->friction_angle *
                                                    dealii::numbers::PI / 180.)
        ? drive
        : std::min(drive, sliding);
    const double acceleration = drive - shear_per_mass;

    CheckValues checks;
    const unsigned int window = body.window();
    const auto velocity       = body.along(body.body_name, "v", body.downhill);
    compare(checks,
            "acceleration",
            fitted_slope(from(body.time, window), from(velocity, window)),
            acceleration);
    const auto slip       = body.along(body.body_name, "u", body.downhill);
    double reference_time = input.scene.checks.reference_time;
    if (reference_time == 0.)
      reference_time = body.time.back() - start;
    unsigned int row = 0;
    while (row + 1 < body.time.size() &&
           body.time[row] - start < reference_time * (1. - 1e-9))
      ++row;
    const double elapsed = body.time[row] - start;
    compare(checks, "slip", slip[row], 0.5 * acceleration * elapsed * elapsed);

    const auto normal_force =
      from(body.column(body.joint_name, "normal_force"), window);
    compare(checks,
            "normal_force",
            windowed_mean(normal_force),
            block.mass * press);
    const auto range =
      std::minmax_element(normal_force.begin(), normal_force.end());
    checks.emplace_back("normal_force_spread",
                        (*range.second - *range.first) / (block.mass * press));
    const auto shear =
      from(body.column(body.joint_name, "shear_force"), window);
    compare(checks,
            "shear_force",
            windowed_mean(shear),
            block.mass * shear_per_mass);

    // offset of the normal force from the foot of the block's centre
    const auto center = body.along(body.joint_name, "center", body.downhill);
    double foot       = block.centroid * body.downhill;
    std::vector<double> moment;
    for (unsigned int i = window; i < center.size(); ++i)
      moment.push_back((center[i] - foot - slip[i]) * normal_force[i - window]);
    compare(checks,
            "force_offset",
            windowed_mean(moment) / windowed_mean(normal_force),
            std::abs(body.joint->distance(block.centroid)) * shear_per_mass /
              press);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }


  /** Body at rest: contact carries its weight, from the first step on. */
  template <int dim>
  CheckValues
  check_resting(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const double mass = input.blocks.blocks[body.body].mass;
    CheckValues checks;
    const auto normal_force = body.column(body.joint_name, "normal_force");
    const auto shear_force  = body.column(body.joint_name, "shear_force");
    const double press      = mass * std::abs(body.gravity * body.normal);
    const double drive      = mass * (body.gravity * body.downhill);
    compare(checks, "first_normal_force", normal_force.front(), press);
    compare(checks, "first_shear_force", shear_force.front(), drive);
    const auto n =
      std::minmax_element(normal_force.begin(), normal_force.end());
    const auto t = std::minmax_element(shear_force.begin(), shear_force.end());
    compare(checks, "least_normal_force", *n.first, press);
    compare(checks, "greatest_normal_force", *n.second, press);
    compare(checks, "least_shear_force", *t.first, drive);
    compare(checks, "greatest_shear_force", *t.second, drive);
    return checks;
  }


  /** Rigid block on a shaken base, integrated with a fine step (Newmark
   * 1965): along the joint it follows the base while that needs no more than mu
   * times its pressure, which the shaking changes. */
  template <int dim>
  CheckValues
  check_newmark(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const double friction =
      tangent_of_kinetic_friction(body.joint->friction_angle,
                                  body.joint->kinetic_friction_angle);
    const Material<dim> *base = nullptr;
    for (const auto &material : input.scene.materials)
      if (material->is_rigid())
        base = material.get();
    const Expression<dim> motion(base->rigid_velocity,
                                 dim,
                                 "Materials/*/Rigid velocity");
    // away from the base, and along it
    Tensor<1, dim> up = body.normal;
    if (up * body.gravity > 0.)
      up *= -1.;
    Tensor<1, dim> ahead = -up[0] * up;
    ahead[0] += 1.;
    ahead /= ahead.norm();
    const double pull    = body.gravity * ahead;
    const double start   = body.time.front() - input.stages.back().time_step;
    const double end     = body.time.back();
    const unsigned int n = 400000;
    const double dt      = (end - start) / n;
    Tensor<1, dim> base_velocity = motion.vector(Point<dim>(), start);
    double v = base_velocity * ahead, slip = 0., base_path = 0.;
    double stop = start;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Tensor<1, dim> before = base_velocity;
        base_velocity   = motion.vector(Point<dim>(), start + (i + 1) * dt);
        const double vb = base_velocity * ahead;
        const double middle =
          motion.vector(Point<dim>(), start + (i + 0.5) * dt) * ahead;
        const double pressure =
          (base_velocity - before) * up / dt - body.gravity * up;
        const double limit = friction * std::max(0., pressure) * dt;
        const double old   = v;
        v += pull * dt + std::clamp(vb - v - pull * dt, -limit, limit);
        slip += (0.5 * (old + v) - middle) * dt;
        base_path += middle * dt;
        if (std::abs(vb - v) > 1e-12 + limit)
          stop = start + (i + 1) * dt;
      }
    CheckValues checks;
    const auto path = body.along(body.body_name, "u", ahead);
    compare(checks, "slip", std::abs(path.back() - base_path), std::abs(slip));
    checks.emplace_back("stop_time_reference", stop);
    const auto normal_force = body.column(body.joint_name, "normal_force");
    const double weight     = input.blocks.blocks[body.body].mass *
                          std::abs(body.gravity * body.normal);
    checks.emplace_back("least_pressure_over_weight",
                        *std::min_element(normal_force.begin(),
                                          normal_force.end()) /
                          weight);
    checks.emplace_back("greatest_pressure_over_weight",
                        *std::max_element(normal_force.begin(),
                                          normal_force.end()) /
                          weight);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }


  /** Whether a block on an incline stays, slides, topples or does both. */
  template <int dim>
  CheckValues
  check_toppling(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const Block<dim> &block = input.blocks.blocks[body.body];
    const double size       = block.size;
    const auto slip         = body.along(body.body_name, "u", body.downhill);
    const auto turn         = body.column(body.body_name, "rotation");
    CheckValues checks;
    checks.emplace_back("slip_over_size", slip.back() / size);
    checks.emplace_back("rotation", turn.back());
    // slip of the toe: what the turn about it does not explain of the path of
    // the centre
    const double height = std::abs(body.joint->distance(block.centroid));
    double width        = 0.;
    for (const auto &[joint, area] : block.joint_area)
      if (input.scene.joints[joint].get() == body.joint)
        width = std::pow(area, 1. / (dim - 1));
    const double angle     = std::abs(turn.back());
    const double foot_slip = slip.back() - height * std::sin(angle) -
                             0.5 * width * (1. - std::cos(angle));
    checks.emplace_back("foot_slip_over_size", foot_slip / size);
    checks.emplace_back("slides", foot_slip > 1e-3 * size ? 1. : 0.);
    checks.emplace_back("topples", std::abs(turn.back()) > 2e-3 ? 1. : 0.);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }


  /** Body that spins freely: angular momentum is kept, and by the virial
   * theorem the mean stress is the mean of rho omega^2 r r. */
  template <int dim>
  CheckValues
  check_rotation(const CheckInput<dim> &input)
  {
    std::string name;
    unsigned int index = none;
    for (unsigned int m = 0; m < input.scene.monitors.size(); ++m)
      if (input.scene.monitors[m]->kind == MonitorKind::block)
        {
          name  = input.scene.monitors[m]->name;
          index = input.block_of_monitor[m];
        }
    AssertThrow(index != none,
                InputError("The entry 'Check/Closed form' is 'rotation', "
                           "which needs a monitor of kind block in "
                           "'Monitors/Names'; add one."));
    const unsigned int begin = input.history.stage_begin.back();
    const auto momentum =
      input.history.column(name + ".angular_momentum", begin);
    const auto trace = input.history.column(name + ".mean_stress_trace", begin);
    const auto range = std::minmax_element(momentum.begin(), momentum.end());
    CheckValues checks;
    checks.emplace_back("angular_momentum", momentum.back());
    checks.emplace_back("angular_momentum_spread",
                        (*range.second - *range.first) /
                          std::abs(momentum.front()));
    // kinetic energy of the spin is half of omega^2 times the moment of
    // inertia, and the trace of the mean stress is omega^2 times that moment
    // over the volume
    const auto kinetic = input.history.column("energy.kinetic", begin);
    compare(checks,
            "mean_stress_trace",
            windowed_mean(trace),
            2. * kinetic.back() / input.blocks.blocks[index].volume);
    checks.emplace_back("mean_stress_over_modulus",
                        windowed_mean(trace) /
                          input.scene.materials.front()->young_modulus);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }

  template CheckValues check_incline(const CheckInput<2> &);
  template CheckValues check_incline(const CheckInput<3> &);
  template CheckValues check_resting(const CheckInput<2> &);
  template CheckValues check_resting(const CheckInput<3> &);
  template CheckValues check_newmark(const CheckInput<2> &);
  template CheckValues check_newmark(const CheckInput<3> &);
  template CheckValues check_toppling(const CheckInput<2> &);
  template CheckValues check_toppling(const CheckInput<3> &);
  template CheckValues check_rotation(const CheckInput<2> &);
  template CheckValues check_rotation(const CheckInput<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/checks.h>

#include <keyblock/expression.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Add a measured value with its reference. */
    void
    compare(CheckValues &checks,
            const std::string &name,
            const double value,
            const double reference)
    {
      checks.emplace_back(name, value);
      checks.emplace_back(name + "_reference", reference);
      checks.emplace_back(name + "_relative_error",
                          reference != 0. ? (value - reference) / reference
                                          : value);
    }

    double
    mean(const std::vector<double> &values)
    {
      return values.empty()
               ? 0.
               : std::accumulate(values.begin(), values.end(), 0.) /
                   values.size();
    }

    /** Mean with the weight of a Hann window, so that an oscillation cut off at
     * the ends does not count. */
    double
    windowed_mean(const std::vector<double> &values)
    {
      double sum = 0., weights = 0.;
      for (unsigned int i = 0; i < values.size(); ++i)
        {
          const double s =
            std::sin(dealii::numbers::PI * (i + 0.5) / values.size());
          sum += s * s * values[i];
          weights += s * s;
        }
      return weights > 0. ? sum / weights : 0.;
    }

    /** Slope of the line of least squares. */
    double
    fitted_slope(const std::vector<double> &x, const std::vector<double> &y)
    {
      const double mx = mean(x), my = mean(y);
      double xy = 0., xx = 0.;
      for (unsigned int i = 0; i < x.size(); ++i)
        {
          xy += (x[i] - mx) * (y[i] - my);
          xx += (x[i] - mx) * (x[i] - mx);
        }
      return xx > 0. ? xy / xx : 0.;
    }

    /** The monitors and geometry of a body on a joint under gravity. */
    template <int dim>
    class BodyOnJoint
    {
    public:
      explicit BodyOnJoint(const CheckInput<dim> &input)
        : input(input)
      {
        for (unsigned int m = 0; m < input.scene.monitors.size(); ++m)
          {
            const Monitor<dim> &monitor = *input.scene.monitors[m];
            if (monitor.kind == "block" && body_name.empty())
              {
                body_name = monitor.name;
                body      = input.block_of_monitor[m];
              }
            if (monitor.kind == "joint" && joint_name.empty() &&
                (input.scene.checks.joint.empty() ||
                 monitor.joint == input.scene.checks.joint))
              joint_name = monitor.name;
          }
        AssertThrow(!body_name.empty() && !joint_name.empty(),
                    InputError("The entry 'Check/Closed form' is '" +
                               input.scene.checks.closed_form +
                               "', which needs a monitor of kind block and "
                               "one of kind joint in 'Monitors/Names'; add "
                               "them."));
        begin = input.history.stage_begin.back();
        time  = input.history.column("time", begin);
        if (!input.scene.initial_state.gravity.empty())
          {
            const Expression<dim> formula(input.scene.initial_state.gravity,
                                          dim,
                                          "Initial state/Gravity");
            gravity = formula.vector(Point<dim>(), time.back());
          }
        for (const auto &entry : input.scene.joints)
          if (entry->name == input.scene.checks.joint)
            joint = entry.get();
        if (joint)
          {
            normal   = joint->normal();
            downhill = gravity - (gravity * normal) * normal;
            if (downhill.norm() > 1e-12)
              downhill /= downhill.norm();
          }
      }

      /** First row of the window of means, counted from the stage's first. */
      unsigned int
      window() const
      {
        return std::min<unsigned int>(input.scene.checks.window_start *
                                        time.size(),
                                      time.size() - 1);
      }

      std::vector<double>
      column(const std::string &monitor, const std::string &quantity) const
      {
        return input.history.column(monitor + "." + quantity, begin);
      }

      /** Component of a vector quantity along @p direction. */
      std::vector<double>
      along(const std::string &monitor,
            const std::string &quantity,
            const Tensor<1, dim> &direction) const
      {
        std::vector<double> result(time.size(), 0.);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto values =
              column(monitor, quantity + "_" + std::string(1, "xyz"[d]));
            for (unsigned int i = 0; i < result.size(); ++i)
              result[i] += direction[d] * values[i];
          }
        return result;
      }

      const CheckInput<dim> &input;
      std::string body_name, joint_name;
      unsigned int body       = none;
      const Joint<dim> *joint = nullptr;
      unsigned int begin      = 0;
      std::vector<double> time;
      Tensor<1, dim> gravity, normal, downhill;
    };

    std::vector<double>
    from(const std::vector<double> &values, const unsigned int begin)
    {
      return {values.begin() + begin, values.end()};
    }

    double
    tangent_of_kinetic_friction(const double angle, const double kinetic)
    {
      return std::tan((kinetic < 0. ? angle : kinetic) * dealii::numbers::PI /
                      180.);
    }



    /** Block that slides on an incline: a = g (sin - cos tan phi). */
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
      const double acceleration = std::max(0., drive - tangent * press);

      CheckValues checks;
      const unsigned int window = body.window();
      const auto velocity = body.along(body.body_name, "v", body.downhill);
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
      compare(checks,
              "slip",
              slip[row],
              0.5 * acceleration * elapsed * elapsed);

      const auto normal_force =
        from(body.column(body.joint_name, "normal_force"), window);
      compare(checks,
              "normal_force",
              windowed_mean(normal_force),
              block.mass * press);
      const auto range =
        std::minmax_element(normal_force.begin(), normal_force.end());
      checks.emplace_back("normal_force_spread",
                          (*range.second - *range.first) /
                            (block.mass * press));
      const auto shear =
        from(body.column(body.joint_name, "shear_force"), window);
      compare(checks,
              "shear_force",
              windowed_mean(shear),
              block.mass * std::min(drive, tangent * press));

      // offset of the normal force from the foot of the block's centre
      const auto center = body.along(body.joint_name, "center", body.downhill);
      double foot       = block.centroid * body.downhill;
      std::vector<double> moment;
      for (unsigned int i = window; i < center.size(); ++i)
        moment.push_back((center[i] - foot - slip[i]) *
                         normal_force[i - window]);
      compare(checks,
              "force_offset",
              windowed_mean(moment) / windowed_mean(normal_force),
              std::abs(body.joint->distance(block.centroid)) *
                std::min(tangent, drive / press));
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
      const auto t =
        std::minmax_element(shear_force.begin(), shear_force.end());
      compare(checks, "least_normal_force", *n.first, press);
      compare(checks, "greatest_normal_force", *n.second, press);
      compare(checks, "least_shear_force", *t.first, drive);
      compare(checks, "greatest_shear_force", *t.second, drive);
      return checks;
    }



    /** Bar thrown against a wall: force rho c v A for 2 L / c, then all of the
     * velocity comes back. */
    template <int dim>
    CheckValues
    check_bar_impact(const CheckInput<dim> &input)
    {
      const BodyOnJoint<dim> body(input);
      const Block<dim> &block       = input.blocks.blocks[body.body];
      const Material<dim> &material = *input.scene.materials.front();
      const double modulus =
        material.lame_lambda() + 2. * material.shear_modulus();
      const double speed = std::sqrt(modulus / material.density);
      const Expression<dim> initial(input.scene.initial_state.velocity,
                                    dim,
                                    "Initial state/Velocity");
      const Tensor<1, dim> v0 = initial.vector(block.centroid, 0.);
      Tensor<1, dim> toward   = v0 / v0.norm();
      // the body is a box along its velocity
      const double length     = input.scene.checks.length;
      const double area       = block.volume / length;
      const double force      = material.density * speed * v0.norm() * area;
      const double dt         = input.stages.back().time_step;
      const auto normal_force = body.column(body.joint_name, "normal_force");
      unsigned int first = 0, last = 0;
      for (unsigned int i = 0; i < normal_force.size(); ++i)
        if (normal_force[i] > 1e-6 * force)
          {
            if (last == 0)
              first = i;
            last = i;
          }
      const double impact   = body.time[first] - dt;
      const double duration = 2. * length / speed;
      std::vector<double> window;
      for (unsigned int i = first; i <= last; ++i)
        if (body.time[i] > impact + 0.1 * duration &&
            body.time[i] < impact + 0.9 * duration)
          window.push_back(normal_force[i]);
      CheckValues checks;
      compare(checks, "force", mean(window), force);
      compare(checks, "release_time", body.time[last] - impact, duration);
      checks.emplace_back("release_error_in_steps",
                          (body.time[last] - impact - duration) / dt);
      const auto velocity = body.along(body.body_name, "v", toward);
      compare(checks, "rebound_velocity", velocity.back(), -v0.norm());
      const auto kinetic = input.history.column("energy.kinetic", body.begin);
      const auto elastic = input.history.column("energy.elastic", body.begin);
      const double start = input.stages.back().energies.start;
      double greatest    = 0.;
      for (unsigned int i = 0; i < kinetic.size(); ++i)
        greatest = std::max(greatest, kinetic[i] + elastic[i]);
      checks.emplace_back("greatest_energy_over_start", greatest / start);
      checks.emplace_back("final_energy_over_start",
                          (kinetic.back() + elastic.back()) / start);
      checks.emplace_back("energy_residual",
                          input.stages.back().energies.relative_residual());
      return checks;
    }



    /** Bar bonded to a wall and pulled at its free end: the stress at the wall
     * is 2 k rho c v from (2 k - 1) L / c on, k = 1, 2, ..., until it exceeds
     * the tensile strength. */
    template <int dim>
    CheckValues
    check_bond_break(const CheckInput<dim> &input)
    {
      const BodyOnJoint<dim> body(input);
      const Material<dim> &material = *input.scene.materials.front();
      const double speed =
        std::sqrt((material.lame_lambda() + 2. * material.shear_modulus()) /
                  material.density);
      const Expression<dim> pull(input.scene.supports.front()->velocity,
                                 dim,
                                 "Supports/*/Velocity");
      const double level =
        2. * material.density * speed * pull.vector(Point<dim>(), 0.).norm();
      const double strength = body.joint->tensile_strength;
      const double k        = std::floor(strength / level) + 1.;
      const double time     = (2. * k - 1.) * input.scene.checks.length / speed;
      const auto intact     = body.column(body.joint_name, "intact");
      const auto force      = body.column(body.joint_name, "normal_force");
      unsigned int row      = 0;
      double largest        = 0.;
      while (row + 1 < intact.size() && intact[row] == intact.front())
        largest = std::max(largest, -force[row++]);
      double area = 0.;
      for (const auto &[joint, part] :
           input.blocks.blocks[body.body].joint_area)
        area += part;
      CheckValues checks;
      // the kick of a row is that of the time one step before it
      const double dt = input.stages.back().time_step;
      compare(checks, "break_time", body.time[row] - dt, time);
      checks.emplace_back("break_error_in_steps",
                          (body.time[row] - dt - time) / dt);
      checks.emplace_back("force_before_break_over_strength",
                          largest / (strength * area));
      checks.emplace_back("force_before_break_over_strength_is_below_1",
                          largest <= strength * area ? 1. : 0.);
      return checks;
    }



    /** Rigid block on a shaken base, integrated with a fine step (Newmark
     * 1965): it follows the base while that needs no more than mu g. */
    template <int dim>
    CheckValues
    check_newmark(const CheckInput<dim> &input)
    {
      const BodyOnJoint<dim> body(input);
      const double limit =
        tangent_of_kinetic_friction(body.joint->friction_angle,
                                    body.joint->kinetic_friction_angle) *
        std::abs(body.gravity * body.normal);
      const Material<dim> *base = nullptr;
      for (const auto &material : input.scene.materials)
        if (material->is_rigid())
          base = material.get();
      const Expression<dim> motion(base->rigid_velocity,
                                   dim,
                                   "Materials/*/Rigid velocity");
      const double start   = body.time.front() - input.stages.back().time_step;
      const double end     = body.time.back();
      const unsigned int n = 400000;
      const double dt      = (end - start) / n;
      double v = motion.value(Point<dim>(), start, 0), slip = 0.,
             base_path = 0.;
      double stop      = start;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double vb = motion.value(Point<dim>(), start + (i + 1) * dt, 0);
          const double middle =
            motion.value(Point<dim>(), start + (i + 0.5) * dt, 0);
          const double change = std::clamp(vb - v, -limit * dt, limit * dt);
          const double old    = v;
          v += change;
          slip += (0.5 * (old + v) - middle) * dt;
          base_path += middle * dt;
          if (std::abs(vb - v) > 1e-12 + limit * dt)
            stop = start + (i + 1) * dt;
        }
      CheckValues checks;
      const auto path = body.column(body.body_name, "u_x");
      compare(checks,
              "slip",
              std::abs(path.back() - base_path),
              std::abs(slip));
      checks.emplace_back("stop_time_reference", stop);
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
        if (input.scene.monitors[m]->kind == "block")
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
      const auto trace =
        input.history.column(name + ".mean_stress_trace", begin);
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
  } // namespace



  template <int dim>
  CheckValues
  evaluate_checks(const CheckInput<dim> &input)
  {
    using Check = std::function<CheckValues(const CheckInput<dim> &)>;
    static const std::map<std::string, Check> closed_forms = {
      {"incline", check_incline<dim>},
      {"resting", check_resting<dim>},
      {"bar_impact", check_bar_impact<dim>},
      {"bond_break", check_bond_break<dim>},
      {"newmark", check_newmark<dim>},
      {"toppling", check_toppling<dim>},
      {"rotation", check_rotation<dim>}};
    const auto found = closed_forms.find(input.scene.checks.closed_form);
    return found == closed_forms.end() ? CheckValues() : found->second(input);
  }

  template CheckValues evaluate_checks(const CheckInput<2> &);
  template CheckValues evaluate_checks(const CheckInput<3> &);
} // namespace Keyblock

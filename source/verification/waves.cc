// SPDX-License-Identifier: LGPL-2.1-or-later
// Closed forms of plane waves that meet an interface.
#include <keyblock/law/joint_law.h>
#include <keyblock/verification/polar_state.h>
#include <keyblock/verification/tools.h>

namespace Keyblock
{
  /** Bar thrown against a wall: force rho c v A for 2 L / c, then all of the
   * velocity comes back. */
  template <int dim>
  CheckValues
  check_bar_impact(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const Block<dim> &block       = input.blocks.blocks[body.body];
    const Material<dim> &material = *input.scene.materials.front();
    const double speed            = material.p_wave_speed();
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


  /** Wide slab thrown obliquely on a rough rigid base: plane waves in its
   * middle. It sticks for v_t / v_n <= mu c_p / c_s and comes back with
   * v_t (1 - 2 c_s / c_p), else with v_t - 2 mu v_n (mean over the height,
   * after 2 L / c_p); v_n comes back whole. */
  template <int dim>
  CheckValues
  check_oblique_impact(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const Material<dim> &material = *input.scene.materials.front();
    const double ratio =
      std::sqrt(material.shear_modulus() / material.p_wave_modulus());
    const Expression<dim> initial(input.scene.initial_state.velocity,
                                  dim,
                                  "Initial state/Velocity");
    const Block<dim> &block = input.blocks.blocks[body.body];
    const Tensor<1, dim> v0 = initial.vector(block.centroid, 0.);
    const double friction   = std::tan(
      input.scene.contact.default_friction_angle * dealii::numbers::PI / 180.);
    // the slab lies along x, the base below it
    const double normal_speed = -v0[dim - 1], tangential_speed = v0[0];
    const bool sticks = tangential_speed <= friction / ratio * normal_speed;
    std::string middle;
    for (const auto &monitor : input.scene.monitors)
      if (monitor->kind == MonitorKind::region)
        middle = monitor->name;

    Tensor<1, dim> along, upward;
    along[0]                  = 1.;
    upward[dim - 1]           = 1.;
    const unsigned int window = body.window();
    CheckValues checks;
    compare(checks,
            "rebound_normal_velocity",
            mean(from(body.along(middle, "v", upward), window)),
            normal_speed);
    compare(checks,
            "rebound_tangential_velocity",
            mean(from(body.along(middle, "v", along), window)),
            sticks ? tangential_speed * (1. - 2. * ratio)
                   : tangential_speed - 2. * friction * normal_speed);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }



  /** Bar bonded to a wall and pulled at its free end: the stress at the wall
   * is 2 k rho c v from (2 k - 1) L / c on, k = 1, 2, ..., until it exceeds
   * the tensile strength. A bond that holds to the end has no time of a break.
   */
  template <int dim>
  CheckValues
  check_bond_break(const CheckInput<dim> &input)
  {
    const BodyOnJoint<dim> body(input);
    const Material<dim> &material = *input.scene.materials.front();
    const double speed            = material.p_wave_speed();
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
    for (const auto &[joint, part] : input.blocks.blocks[body.body].joint_area)
      area += part;
    CheckValues checks;
    const bool is_broken = intact[row] != intact.front();
    checks.emplace_back("bond_breaks", is_broken ? 1. : 0.);
    if (is_broken)
      {
        // the kick of a row is that of the time one step before it
        const double dt = input.stages.back().time_step;
        compare(checks, "break_time", body.time[row] - dt, time);
        checks.emplace_back("break_error_in_steps",
                            (body.time[row] - dt - time) / dt);
      }
    checks.emplace_back("force_before_break_over_strength",
                        largest / (strength * area));
    checks.emplace_back("force_before_break_over_strength_is_below_1",
                        largest <= strength * area ? 1. : 0.);
    return checks;
  }

  template CheckValues check_bar_impact(const CheckInput<2> &);
  template CheckValues check_bar_impact(const CheckInput<3> &);
  template CheckValues check_oblique_impact(const CheckInput<2> &);
  template CheckValues check_oblique_impact(const CheckInput<3> &);
  /** Harmonic shear wave that a quiet boundary lets in and a joint across its
   * way lets pass up to the joint's strength: what is above is sent back, so
   * that of the incident stress s(t) clip(s, strength) goes on. Transmission,
   * reflection and absorption are square roots of shares of the energy. */
  template <int dim>
  CheckValues
  check_joint_wave(const CheckInput<dim> &input)
  {
    const Support<dim> *base = nullptr;
    for (const auto &support : input.scene.supports)
      if (support->is_quiet() && !support->velocity.empty())
        base = support.get();
    const auto joints = input.scene.joints_called(input.scene.checks.joint);
    std::vector<const Monitor<dim> *> points;
    for (const auto &monitor : input.scene.monitors)
      if (monitor->kind == MonitorKind::point)
        points.push_back(monitor.get());
    const Material<dim> &rock       = *input.scene.materials.front();
    const double speed              = rock.s_wave_speed();
    const double impedance          = rock.density * speed;
    const Joint<dim> &joint         = *input.scene.joints[joints.front()];
    const StrengthEnvelope envelope = make_joint_law(joint)->envelope({});
    const double strength           = // [Pa]; the joint is level
      envelope.cohesion -
      envelope.static_tangent * initial_stress(input, joint.point)[dim - 1];
    const Expression<dim> wave(base->velocity, dim, "Supports/*/Velocity");
    const double bottom    = input.scene.domain.corner[dim - 1];
    const double joint_way = joint.point[dim - 1] - bottom;
    // velocities are those half a step before the time of their row
    const unsigned int begin = input.history.stage_begin.back();
    const double half        = 0.5 * input.stages.back().time_step;
    const auto time          = input.history.column("time", begin);
    const auto below = input.history.column(points[0]->name + ".v_x", begin);
    const auto above = input.history.column(points[1]->name + ".v_x", begin);
    const unsigned int first = input.scene.checks.window_start * time.size();
    const auto incident      = [&](const double t, const double way) {
      return wave.vector(Point<dim>(), t - way / speed)[0];
    };
    double in = 0., back = 0., on = 0., clipped = 0., cut = 0.;
    for (unsigned int i = first; i < time.size(); ++i)
      {
        const double t = time[i] - half;
        const double v = incident(t, joint_way);
        const double passed =
          std::copysign(std::min(std::abs(v), strength / impedance), v);
        in += v * v;
        clipped += passed * passed;
        cut += (v - passed) * (v - passed);
        const double sent =
          below[i] - incident(t, points[0]->location[dim - 1] - bottom);
        back += sent * sent;
        on += above[i] * above[i];
      }
    const auto friction = input.history.column("energy.friction", begin);
    double area         = 0.;
    for (const auto &[j, part] : input.blocks.blocks.front().joint_area)
      area += part;
    const double taken = friction.back() - friction[first - 1];
    // seconds between two rows
    const double row = (time.back() - time[first - 1]) / (time.size() - first);
    const double given = impedance * area * in * row;
    CheckValues checks;
    compare(checks,
            "transmission",
            std::sqrt(on / in),
            std::sqrt(clipped / in));
    compare(checks, "reflection", std::sqrt(back / in), std::sqrt(cut / in));
    compare(checks,
            "absorption",
            std::sqrt(std::max(0., taken / given)),
            std::sqrt(std::max(0., 1. - (clipped + cut) / in)));
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }

  template CheckValues check_joint_wave(const CheckInput<2> &);
  template CheckValues check_joint_wave(const CheckInput<3> &);
  template CheckValues check_bond_break(const CheckInput<2> &);
  template CheckValues check_bond_break(const CheckInput<3> &);
} // namespace Keyblock

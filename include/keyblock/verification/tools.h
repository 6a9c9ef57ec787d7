// SPDX-License-Identifier: LGPL-2.1-or-later
// What the closed forms of verification/checks.h share; not for use elsewhere.
#ifndef keyblock_verification_tools_h
#define keyblock_verification_tools_h

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/verification/checks.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  /** Add a measured value with its reference. */
  inline void
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

  inline double
  mean(const std::vector<double> &values)
  {
    return values.empty() ? 0.
                          : std::accumulate(values.begin(), values.end(), 0.) /
                              values.size();
  }

  /** Mean with the weight of a Hann window, so that an oscillation cut off at
   * the ends does not count. */
  inline double
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
  inline double
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
          if (monitor.kind == MonitorKind::block && body_name.empty())
            {
              body_name = monitor.name;
              body      = input.block_of_monitor[m];
            }
          if (monitor.kind == MonitorKind::joint && joint_name.empty() &&
              (input.scene.checks.joint.empty() ||
               monitor.joint == input.scene.checks.joint))
            joint_name = monitor.name;
        }
      AssertThrow(!body_name.empty() && !joint_name.empty(),
                  InputError("The entry 'Check/Closed form' is '" +
                             name_of(input.scene.checks.closed_form) +
                             "', which needs a monitor of kind block and "
                             "one of kind joint in 'Monitors/Names'; add "
                             "them."));
      begin   = input.history.stage_begin.back();
      time    = input.history.column("time", begin);
      gravity = Gravity<dim>(input.scene).at(Point<dim>(), time.back());
      for (const unsigned int j :
           input.scene.joints_called(input.scene.checks.joint))
        joint = input.scene.joints[j].get();
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

  inline std::vector<double>
  from(const std::vector<double> &values, const unsigned int begin)
  {
    return {values.begin() + begin, values.end()};
  }

  inline double
  tangent_of_kinetic_friction(const double angle, const double kinetic)
  {
    return std::tan((kinetic < 0. ? angle : kinetic) * dealii::numbers::PI /
                    180.);
  }


  template <int dim>
  CheckValues check_incline(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_resting(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_newmark(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_toppling(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_rotation(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_bar_impact(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_oblique_impact(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_bond_break(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_joint_wave(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_gravity_column(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_kirsch(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_salencon(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_spherical_cavity(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_value(const CheckInput<dim> &input);
  template <int dim>
  CheckValues check_footing(const CheckInput<dim> &input);
} // namespace Keyblock

#endif

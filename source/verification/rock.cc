// SPDX-License-Identifier: LGPL-2.1-or-later
// Closed forms of elastic and plastic rock.
#include <keyblock/verification/polar_state.h>

#include <keyblock/scene/gravity.h>

#include <array>

namespace Keyblock
{
  namespace
  {
    /** Circular hole of radius a in an elastic plate with stresses x and y far
     * away (Kirsch 1898), displacements those of the excavation. */
    struct Kirsch
    {
      double a, x, y, shear_modulus, poisson_ratio;

      PolarState
      at(const double r, const double angle) const
      {
        const double s = 0.5 * (x + y), d = 0.5 * (x - y);
        const double q = a * a / (r * r), c = std::cos(2. * angle),
                     w = a * a / (2. * shear_modulus * r);
        return {s * (1. - q) + d * (1. - 4. * q + 3. * q * q) * c,
                s * (1. + q) - d * (1. + 3. * q * q) * c,
                -d * (1. + 2. * q - 3. * q * q) * std::sin(2. * angle),
                -w * (s + d * (4. * (1. - poisson_ratio) - q) * c),
                w * d * (2. * (1. - 2. * poisson_ratio) + q) *
                  std::sin(2. * angle)};
      }
    };

    /** Circular tunnel under a hydrostatic stress in Mohr-Coulomb rock
     * (Salencon 1969), no support pressure. */
    struct Salencon
    {
      double a, pressure, shear_modulus, poisson_ratio, k, flow, strength;

      double
      plastic_radius() const
      {
        const double cohesive = strength / (k - 1.);
        return a * std::pow(2. / (k + 1.) * (pressure + cohesive) / cohesive,
                            1. / (k - 1.));
      }

      PolarState
      at(const double r, const double) const
      {
        const double cohesive = strength / (k - 1.), R = plastic_radius();
        const double w = r / (2. * shear_modulus);
        if (r >= R)
          {
            const double limit = (2. * pressure - strength) / (k + 1.);
            const double part  = (pressure - limit) * R * R / (r * r);
            return {pressure - part, pressure + part, 0., -w * part, 0.};
          }
        const double grown = cohesive * std::pow(r / a, k - 1.);
        const double chi =
          (2. * poisson_ratio - 1.) * (pressure + cohesive) +
          (1. - poisson_ratio) * (k * k - 1.) / (k + flow) * cohesive *
            std::pow(R / a, k - 1.) * std::pow(R / r, flow + 1.) +
          ((1. - poisson_ratio) * (k * flow + 1.) / (k + flow) -
           poisson_ratio) *
            grown;
        return {grown - cohesive, k * grown - cohesive, 0., -w * chi, 0.};
      }
    };

    /** Compare all of the rock around a hole with a solution in polar
     * coordinates: displacements of the wall relative to the largest, stresses
     * of cells that do not touch the wall relative to @p scale. */
    template <int dim, typename Solution>
    void
    compare_around_hole(const CheckInput<dim> &input,
                        const Solution &solution,
                        const double scale,
                        CheckValues &checks)
    {
      const Excavation<dim> &hole = *input.scene.excavations.front();
      const auto polar            = [&](const Point<dim> &p) {
        return std::array<double, 2>{
          {std::hypot(p[0] - hole.center[0], p[1] - hole.center[1]),
           std::atan2(p[1] - hole.center[1], p[0] - hole.center[0])}};
      };
      std::vector<bool> is_wall(input.rock.vertices.size());
      for (unsigned int v = 0; v < is_wall.size(); ++v)
        is_wall[v] = std::abs(polar(input.rock.vertices[v])[0] - hole.radius) <
                     1e-6 * hole.radius;
      double error = 0., largest = 0., closure = 0., exact_closure = 0.;
      for (unsigned int v = 0; v < is_wall.size(); ++v)
        if (is_wall[v])
          {
            const auto [r, angle]  = polar(input.rock.vertices[v]);
            const PolarState exact = solution.at(r, angle);
            const Tensor<1, dim> u = input.rock.displacements[v];
            const double c = std::cos(angle), s = std::sin(angle);
            const double radial = c * u[0] + s * u[1];
            error =
              std::max(error,
                       std::hypot(radial - exact.radial,
                                  c * u[1] - s * u[0] - exact.tangential));
            largest =
              std::max(largest, std::hypot(exact.radial, exact.tangential));
            closure -= radial;
            exact_closure -= exact.radial;
          }
      double stress_error = 0., square = 0., volume = 0.;
      for (const auto &cell : input.rock.cells)
        {
          if (std::any_of(cell.vertices.begin(),
                          cell.vertices.end(),
                          [&](const unsigned int v) { return is_wall[v]; }))
            continue;
          const auto [r, angle]  = polar(cell.center);
          const PolarState exact = solution.at(r, angle);
          const double c = std::cos(angle), s = std::sin(angle);
          const double x = -cell.stress[0], y = -cell.stress[1],
                       xy     = -cell.stress[n_stress<dim> - 1];
          const double radial = c * c * x + s * s * y + 2. * s * c * xy;
          const double hoop   = s * s * x + c * c * y - 2. * s * c * xy;
          const double shear  = s * c * (y - x) + (c * c - s * s) * xy;
          const double off = std::max({std::abs(radial - exact.radial_stress),
                                       std::abs(hoop - exact.hoop_stress),
                                       std::abs(shear - exact.shear_stress)}) /
                             scale;
          stress_error = std::max(stress_error, off);
          square += cell.volume * off * off;
          volume += cell.volume;
        }
      compare(checks, "wall_closure", closure, exact_closure);
      checks.emplace_back("wall_displacement_error", error / largest);
      checks.emplace_back("stress_error", stress_error);
      checks.emplace_back("mean_stress_error", std::sqrt(square / volume));
      checks.emplace_back("cells", input.rock.cells.size());
    }

    /** Share of a full circle that the wall of the hole covers, 1 or what
     * symmetry leaves [-]. */
    template <int dim>
    double
    covered_share(const CheckInput<dim> &input)
    {
      const Excavation<dim> &hole = *input.scene.excavations.front();
      std::vector<double> angles;
      for (const Point<dim> &p : input.rock.vertices)
        {
          const double x = p[0] - hole.center[0], y = p[1] - hole.center[1];
          if (std::abs(std::hypot(x, y) - hole.radius) < 1e-6 * hole.radius)
            angles.push_back(std::atan2(y, x));
        }
      std::sort(angles.begin(), angles.end());
      const double circle = 2. * dealii::numbers::PI;
      double gap          = angles.front() + circle - angles.back();
      for (unsigned int i = 1; i < angles.size(); ++i)
        gap = std::max(gap, angles[i] - angles[i - 1]);
      return gap > 0.5 ? 1. - gap / circle : 1.;
    }

  } // namespace



  /** Column under its own weight between rollers: settlement rho g (H^2 - d^2)
   * / (2 M) at depth d, K0 stresses. */
  template <int dim>
  CheckValues
  check_gravity_column(const CheckInput<dim> &input)
  {
    const Material<dim> &rock = *input.scene.materials.front();
    const double modulus      = rock.p_wave_modulus();
    const double weight =
      -rock.density * Gravity<dim>(input.scene).at(Point<dim>(), 0.)[dim - 1];
    double bottom = 1e300, top = -1e300;
    for (const Point<dim> &p : input.rock.vertices)
      {
        bottom = std::min(bottom, p[dim - 1]);
        top    = std::max(top, p[dim - 1]);
      }
    const double height   = top - bottom;
    const double greatest = 0.5 * weight * height * height / modulus;
    double error = 0., stress_error = 0., settlement = 0.;
    for (unsigned int v = 0; v < input.rock.vertices.size(); ++v)
      {
        const double depth = top - input.rock.vertices[v][dim - 1];
        const double u     = -input.rock.displacements[v][dim - 1];
        error =
          std::max(error,
                   std::abs(u - 0.5 * weight *
                                  (height * height - depth * depth) / modulus));
        if (depth < 1e-9 * height)
          settlement = u;
      }
    const double k0 = rock.poisson_ratio / (1. - rock.poisson_ratio);
    for (const auto &cell : input.rock.cells)
      {
        const double vertical = weight * (top - cell.center[dim - 1]);
        stress_error          = std::max({stress_error,
                                          std::abs(-cell.stress[dim - 1] - vertical),
                                          std::abs(-cell.stress[0] - k0 * vertical)});
      }
    CheckValues checks;
    compare(checks, "settlement", settlement, greatest);
    checks.emplace_back("displacement_error", error / greatest);
    checks.emplace_back("stress_error", stress_error / (weight * height));
    return checks;
  }



  template <int dim>
  CheckValues
  check_kirsch(const CheckInput<dim> &input)
  {
    const Material<dim> &rock   = *input.scene.materials.front();
    const Excavation<dim> &hole = *input.scene.excavations.front();
    Point<dim> center;
    for (unsigned int d = 0; d < 2; ++d)
      center[d] = hole.center[d];
    const auto stress = initial_stress(input, center);
    const Kirsch solution{hole.radius,
                          -stress[0],
                          -stress[1],
                          rock.shear_modulus(),
                          rock.poisson_ratio};
    CheckValues checks;
    compare_around_hole(input,
                        solution,
                        std::max(-stress[0], -stress[1]),
                        checks);
    return checks;
  }



  template <int dim>
  CheckValues
  check_salencon(const CheckInput<dim> &input)
  {
    const Material<dim> &rock   = *input.scene.materials.front();
    const Excavation<dim> &hole = *input.scene.excavations.front();
    Point<dim> center;
    for (unsigned int d = 0; d < 2; ++d)
      center[d] = hole.center[d];
    const double pressure = -initial_stress(input, center)[0];
    const double k        = slope_of(rock.friction_angle);
    const Salencon solution{hole.radius,
                            pressure,
                            rock.shear_modulus(),
                            rock.poisson_ratio,
                            k,
                            slope_of(rock.dilation_angle < 0.
                                       ? rock.friction_angle
                                       : rock.dilation_angle),
                            2. * rock.cohesion * std::sqrt(k)};
    CheckValues checks;
    compare_around_hole(input, solution, pressure, checks);
    double yielded = 0.;
    for (const auto &cell : input.rock.cells)
      yielded += cell.plastic_share * cell.volume;
    compare(checks,
            "plastic_radius",
            std::sqrt(yielded / (covered_share(input) * dealii::numbers::PI) +
                      hole.radius * hole.radius),
            solution.plastic_radius());
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }



  /** A column of the history against a number of the scene. */
  template <int dim>
  CheckValues
  check_value(const CheckInput<dim> &input)
  {
    const CheckSettings &settings = input.scene.checks;
    CheckValues checks;
    compare(checks,
            "value",
            input.history.last(settings.quantity),
            settings.reference);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }



  /** Strip footing on weightless rock (Prandtl 1920): mean pressure c N_c over
   * the loaded width, measured at the end of the last stage. */
  template <int dim>
  CheckValues
  check_footing(const CheckInput<dim> &input)
  {
    const Material<dim> &rock = *input.scene.materials.front();
    const double angle  = rock.friction_angle * dealii::numbers::PI / 180.;
    const double factor = angle > 0.
                            ? (std::exp(dealii::numbers::PI * std::tan(angle)) *
                                 slope_of(rock.friction_angle) -
                               1.) /
                                std::tan(angle)
                            : 2. + dealii::numbers::PI;
    std::string name;
    for (const auto &monitor : input.scene.monitors)
      if (monitor->kind == MonitorKind::support)
        name = monitor->name;
    const auto reaction =
      input.history.column(name + ".reaction_" + std::string(1, "xyz"[dim - 1]),
                           input.history.stage_begin.back());
    const unsigned int window =
      input.scene.checks.window_start * reaction.size();
    double sum = 0., largest = 0.;
    for (unsigned int i = window; i < reaction.size(); ++i)
      sum -= reaction[i] / (reaction.size() - window);
    for (const double r : reaction)
      largest = std::max(largest, -r);
    CheckValues checks;
    compare(checks,
            "collapse_pressure",
            sum / input.scene.checks.length,
            rock.cohesion * factor);
    checks.emplace_back("largest_pressure",
                        largest / input.scene.checks.length);
    checks.emplace_back("energy_residual",
                        input.stages.back().energies.relative_residual());
    return checks;
  }

  template CheckValues check_gravity_column(const CheckInput<2> &);
  template CheckValues check_gravity_column(const CheckInput<3> &);
  template CheckValues check_kirsch(const CheckInput<2> &);
  template CheckValues check_kirsch(const CheckInput<3> &);
  template CheckValues check_salencon(const CheckInput<2> &);
  template CheckValues check_salencon(const CheckInput<3> &);
  template CheckValues check_value(const CheckInput<2> &);
  template CheckValues check_value(const CheckInput<3> &);
  template CheckValues check_footing(const CheckInput<2> &);
  template CheckValues check_footing(const CheckInput<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Closed form of a spherical cavity.
#include <keyblock/verification/polar_state.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace Keyblock
{
  using dealii::SymmetricTensor;

  namespace
  {
    /** Spherical cavity of radius a under a hydrostatic stress in
     * Mohr-Coulomb rock: Salencon's solution with two hoop stresses, both on
     * the yield surface. Elastic rock has no strength limit. */
    class SphericalCavity
    {
    public:
      const double a; ///< [m]

      SphericalCavity(const double a,
                      const double pressure,
                      const Material<3> &rock)
        : a(a)
        , pressure(pressure)
        , shear_modulus(rock.shear_modulus())
        , k(slope_of(rock.friction_angle))
        , strength(2. * rock.cohesion * std::sqrt(k))
        , cohesive(strength / (k - 1.))
        , flow(2. * slope_of(rock.dilation_angle < 0. ? rock.friction_angle
                                                      : rock.dilation_angle))
      {
        limit = (3. * pressure - 2. * strength) / (2. * k + 1.);
        if (!rock.is_plastic() || limit <= 0.)
          {
            limit  = 0.;
            radius = a;
            return;
          }
        const double nu = rock.poisson_ratio,
                     e  = 2. * shear_modulus * (1. + nu);
        radius  = a * std::pow((limit + cohesive) / cohesive, 0.5 / (k - 1.));
        growing = cohesive * (1. - 2. * nu * k + flow * ((1. - nu) * k - nu)) /
                  (e * (1. + 2. * (k - 1.) + flow));
        uniform  = -(cohesive + pressure) * (1. - 2. * nu) / e;
        decaying = (pressure - limit) / (4. * shear_modulus) - uniform -
                   growing * grown(radius);
      }

      double
      plastic_radius() const
      {
        return radius;
      }

      /** Stress, compression positive, and displacement away from the
       * cavity. */
      PolarState
      at(const double r) const
      {
        if (r >= radius)
          {
            const double part = (pressure - limit) * std::pow(radius / r, 3.);
            return {pressure - part,
                    pressure + 0.5 * part,
                    0.,
                    -0.25 * r * part / shear_modulus,
                    0.};
          }
        const double radial = cohesive * (grown(r) - 1.);
        return {radial,
                k * radial + strength,
                0.,
                -r * (growing * grown(r) + uniform +
                      decaying * std::pow(radius / r, 1. + flow)),
                0.};
      }

    private:
      double
      grown(const double r) const
      {
        return std::pow(r / a, 2. * (k - 1.));
      }

      const double pressure, shear_modulus, k, strength, cohesive, flow;
      double limit;  ///< radial stress at the edge of the plastic rock [Pa]
      double radius; ///< of the plastic rock [m]
      double growing = 0., uniform = 0., decaying = 0.; ///< hoop strains [-]
    };

    /** Displacements of the wall of a cavity. Returns which vertices are on
     * it. */
    std::vector<bool>
    compare_wall_of_cavity(const CheckInput<3> &input,
                           const SphericalCavity &solution,
                           CheckValues &checks)
    {
      const double a = solution.a, exact = -solution.at(a).radial;
      std::vector<bool> is_wall(input.rock.vertices.size());
      std::vector<double> closure;
      double error = 0.;
      for (unsigned int v = 0; v < is_wall.size(); ++v)
        {
          const Point<3> &p = input.rock.vertices[v];
          is_wall[v]        = std::abs(p.norm() - a) < 1e-6 * a;
          if (!is_wall[v])
            continue;
          const Tensor<1, 3> u = input.rock.displacements[v];
          closure.push_back(-(u * p) / a);
          error = std::max(error, (u + exact / a * p).norm());
        }
      compare(checks, "wall_closure", mean(closure), exact);
      checks.emplace_back("wall_displacement_error", error / exact);
      return is_wall;
    }

    void
    compare_stress_around_cavity(const CheckInput<3> &input,
                                 const SphericalCavity &solution,
                                 const double scale,
                                 const std::vector<bool> &is_wall,
                                 CheckValues &checks)
    {
      double largest = 0., square = 0., volume = 0.;
      double hoop = 0., exact_hoop = 0.;
      for (const auto &cell : input.rock.cells)
        {
          const double r         = cell.center.norm();
          const Tensor<1, 3> n   = cell.center / r;
          const PolarState exact = solution.at(r);
          const auto &s          = cell.stress; // xx, yy, zz, yz, xz, xy
          const double entry[6]  = {-s[0], -s[1], -s[2], -s[5], -s[4], -s[3]};
          const SymmetricTensor<2, 3> stress(entry);
          if (std::any_of(cell.vertices.begin(),
                          cell.vertices.end(),
                          [&](const unsigned int v) { return is_wall[v]; }))
            {
              hoop += 0.5 * cell.volume * (trace(stress) - n * (stress * n));
              exact_hoop += cell.volume * exact.hoop_stress;
              continue;
            }
          const SymmetricTensor<2, 3> reference =
            exact.hoop_stress * dealii::unit_symmetric_tensor<3>() +
            (exact.radial_stress - exact.hoop_stress) *
              symmetrize(outer_product(n, n));
          const double off = (stress - reference).norm() / scale;
          largest          = std::max(largest, off);
          square += cell.volume * off * off;
          volume += cell.volume;
        }
      const double wall = solution.at(solution.a).hoop_stress;
      compare(checks, "wall_hoop_stress", wall * hoop / exact_hoop, wall);
      checks.emplace_back("stress_error", largest);
      checks.emplace_back("mean_stress_error", std::sqrt(square / volume));
    }

    /** Radius of a ball about the origin that holds the cavity of radius @p a
     * and the rock that has yielded; symmetry planes through the origin are
     * where the rock ends [m]. */
    double
    yielded_radius(const CheckInput<3> &input, const double a)
    {
      double volume = 0., share = 1.;
      for (const auto &cell : input.rock.cells)
        volume += cell.plastic_share * cell.volume;
      for (unsigned int d = 0; d < 3; ++d)
        if (std::all_of(input.rock.vertices.begin(),
                        input.rock.vertices.end(),
                        [&](const Point<3> &p) { return p[d] > -1e-9 * a; }))
          share *= 0.5;
      return std::cbrt(0.75 * volume / (share * dealii::numbers::PI) +
                       a * a * a);
    }
  } // namespace



  /** Spherical cavity about the origin: displacements of the wall, stresses of
   * cells that do not touch it (norm of the difference of tensors), the hoop
   * stress of those that do, brought to the wall in proportion to the closed
   * form, and the radius of the rock that has yielded. */
  template <int dim>
  CheckValues
  check_spherical_cavity(const CheckInput<dim> &input)
  {
    CheckValues checks;
    if constexpr (dim == 3)
      {
        const double pressure = -initial_stress(input, Point<dim>())[0];
        const SphericalCavity solution(input.scene.checks.length,
                                       pressure,
                                       *input.scene.materials.front());
        const auto is_wall = compare_wall_of_cavity(input, solution, checks);
        compare_stress_around_cavity(
          input, solution, pressure, is_wall, checks);
        if (solution.plastic_radius() > solution.a)
          compare(checks,
                  "plastic_radius",
                  yielded_radius(input, solution.a),
                  solution.plastic_radius());
        checks.emplace_back("cells", input.rock.cells.size());
        checks.emplace_back("energy_residual",
                            input.stages.back().energies.relative_residual());
      }
    return checks;
  }

  template CheckValues check_spherical_cavity(const CheckInput<2> &);
  template CheckValues check_spherical_cavity(const CheckInput<3> &);
} // namespace Keyblock

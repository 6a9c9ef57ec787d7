// SPDX-License-Identifier: LGPL-2.1-or-later
// Operators of structural liners: motions of rigid bodies are free of force,
// constant strains and moments are exact on any mesh, strips and plates deflect
// as the closed forms say, and corners bend as their arms turn.
#include <keyblock/rock/liner_shell.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <random>

BOOST_AUTO_TEST_SUITE(liner_shell)

using namespace Keyblock;

namespace
{
  constexpr double pi        = 3.14159265358979323846;
  constexpr double thickness = 0.2, poisson = 0.3;
  const LinerSection section(10e9, poisson, thickness);

  template <int dim>
  using Vectors = std::vector<Tensor<1, dim>>;

  /** Points and faces, with the stiffness between them. */
  template <int dim>
  struct Model
  {
    std::vector<Point<dim>> points;
    std::vector<LinedFace<dim>> faces;

    void
    add_face(const std::array<unsigned int, LinedFace<dim>::n> &corners)
    {
      LinedFace<dim> face;
      face.points = face.vertices = corners;
      face.cell                   = 0;
      face.is_mirrored.fill(false);
      face.area = 1.;
      faces.push_back(face);
    }

    LinerShell<dim>
    shell() const
    {
      return LinerShell<dim>(section, points, faces);
    }

    Vectors<dim>
    field(const std::function<Tensor<1, dim>(const Point<dim> &)> &f) const
    {
      Vectors<dim> values;
      for (const Point<dim> &p : points)
        values.push_back(f(p));
      return values;
    }
  };

  template <int dim>
  Vectors<dim>
  forces_of(const LinerShell<dim> &shell, const Vectors<dim> &u)
  {
    Vectors<dim> f;
    for (unsigned int p = 0; p < u.size(); ++p)
      f.push_back(shell.force_at(p, u));
    return f;
  }

  template <int dim>
  double
  largest(const Vectors<dim> &vectors)
  {
    double value = 0.;
    for (const auto &v : vectors)
      value = std::max(value, v.norm());
    return value;
  }

  template <int dim>
  double
  product(const Vectors<dim> &a, const Vectors<dim> &b)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      sum += a[i] * b[i];
    return sum;
  }

  /** Displacements in equilibrium with @p load where @p is_free(point,
   * component), by conjugate gradients. */
  template <int dim>
  Vectors<dim>
  solve(const LinerShell<dim> &shell,
        const Vectors<dim> &load,
        const std::function<bool(unsigned int, unsigned int)> &is_free)
  {
    const auto hold = [&](Vectors<dim> v) {
      for (unsigned int p = 0; p < v.size(); ++p)
        for (unsigned int d = 0; d < dim; ++d)
          if (!is_free(p, d))
            v[p][d] = 0.;
      return v;
    };
    Vectors<dim> u(load.size()), r = hold(load), s = r;
    double size        = product(r, r);
    const double start = size;
    for (unsigned int i = 0; i < 20000 && size > 1e-22 * start; ++i)
      {
        const Vectors<dim> ks = hold(forces_of(shell, s));
        const double way      = size / product(s, ks);
        for (unsigned int p = 0; p < u.size(); ++p)
          {
            u[p] += way * s[p];
            r[p] -= way * ks[p];
          }
        const double next = product(r, r);
        for (unsigned int p = 0; p < u.size(); ++p)
          s[p] = r[p] + next / size * s[p];
        size = next;
      }
    return u;
  }

  /** A chain along a curve of the parameter from 0 to 1. */
  Model<2>
  make_chain(const unsigned int n,
             const std::function<Point<2>(double)> &curve,
             const bool is_closed = false)
  {
    Model<2> chain;
    for (unsigned int i = 0; i < n + (is_closed ? 0 : 1); ++i)
      chain.points.push_back(curve(double(i) / n));
    for (unsigned int i = 0; i < n; ++i)
      chain.add_face({{i, is_closed ? (i + 1) % n : i + 1}});
    return chain;
  }

  /** A square of side 1 of triangles, each cut into three quadrilaterals as
   * meshes of tetrahedra are, moved by @p shape; or of squares. */
  Model<3>
  make_plate(const unsigned int n,
             const bool is_cut,
             const std::function<Point<3>(double, double)> &shape)
  {
    Model<3> plate;
    std::map<std::pair<int, int>, unsigned int> index; // of (6 n x, 6 n y)
    const auto at = [&](const int i, const int j) {
      const auto [found, is_new] =
        index.try_emplace({i, j}, plate.points.size());
      if (is_new)
        plate.points.push_back(shape(i / (6. * n), j / (6. * n)));
      return found->second;
    };
    const auto cut = [&](const std::array<std::array<int, 2>, 3> &v) {
      std::array<int, 2> middle{{0, 0}};
      for (const auto &p : v)
        for (unsigned int d = 0; d < 2; ++d)
          middle[d] += p[d] / 3;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const auto &a = v[k], &b = v[(k + 1) % 3], &c = v[(k + 2) % 3];
          plate.add_face({{at(a[0], a[1]),
                           at((a[0] + b[0]) / 2, (a[1] + b[1]) / 2),
                           at(middle[0], middle[1]),
                           at((a[0] + c[0]) / 2, (a[1] + c[1]) / 2)}});
        }
    };
    for (int j = 0; j < int(n); ++j)
      for (int i = 0; i < int(n); ++i)
        {
          const std::array<int, 2> a{{6 * i, 6 * j}}, b{{6 * i + 6, 6 * j}},
            c{{6 * i + 6, 6 * j + 6}}, d{{6 * i, 6 * j + 6}};
          if (!is_cut)
            plate.add_face({{at(a[0], a[1]),
                             at(b[0], b[1]),
                             at(c[0], c[1]),
                             at(d[0], d[1])}});
          else if ((i + j) % 2 == 0)
            {
              cut({{a, b, c}});
              cut({{a, c, d}});
            }
          else
            {
              cut({{a, b, d}});
              cut({{b, c, d}});
            }
        }
    return plate;
  }

  /** Moves points within the square, those on its sides along them. */
  Point<3>
  distorted(const double x, const double y)
  {
    return Point<3>(x + 0.04 * std::sin(pi * x) * std::sin(5. * y + 2.),
                    y + 0.05 * std::sin(pi * y) * std::sin(4. * x),
                    0.);
  }

  double
  deflection_of_plate(const unsigned int n, const bool is_cut)
  {
    const Model<3> plate = make_plate(n, is_cut, distorted);
    Vectors<3> load(plate.points.size());
    for (const auto &face : plate.faces)
      {
        const auto &q = face.points;
        const double area =
          0.5 * cross_product_3d(plate.points[q[2]] - plate.points[q[0]],
                                 plate.points[q[3]] - plate.points[q[1]])
                  .norm();
        for (const unsigned int p : q)
          load[p][2] += 0.25 * area;
      }
    const Vectors<3> u =
      solve<3>(plate.shell(), load, [&](const unsigned int p, unsigned int d) {
        const Point<3> &x = plate.points[p];
        return d == 2 && std::min({x[0], x[1], 1. - x[0], 1. - x[1]}) > 1e-9;
      });
    double top = 0.;
    for (const auto &v : u)
      top = std::max(top, v[2]);
    return top * section.bending;
  }
} // namespace

BOOST_AUTO_TEST_CASE(liner_moves_as_a_rigid_body)
{
  const Model<2> chain = make_chain(12, [](const double s) {
    return Point<2>(s * s, s < 0.5 ? std::sin(3. * s) : std::sin(1.5));
  });
  const Vectors<2> u   = chain.field([](const Point<2> &x) {
    return Tensor<1, 2>({3. - 0.1 * x[1], 1. + 0.1 * x[0]});
  });
  BOOST_TEST(largest(forces_of(chain.shell(), u)) < 1e-10 * section.membrane);
  // a folded and curved sheet
  const Model<3> sheet =
    make_plate(4, true, [](const double x, const double y) {
      return Point<3>(x, std::min(y, 0.5), std::max(0., y - 0.5) + 0.2 * x * x);
    });
  const Vectors<3> v = sheet.field([](const Point<3> &x) {
    const Tensor<1, 3> w({0.1, 0.2, -0.3});
    return Tensor<1, 3>({1., 2., 3.}) + cross_product_3d(w, x);
  });
  BOOST_TEST(largest(forces_of(sheet.shell(), v)) < 1e-9 * section.membrane);
}

BOOST_AUTO_TEST_CASE(liner_of_constant_moment)
{
  // unequal segments
  const Model<2> chain =
    make_chain(9, [](const double s) { return Point<2>(s * s + s, 0.); });
  const auto bent   = chain.field([](const Point<2> &x) {
    return Tensor<1, 2>({2e-3 * x[0], -0.5e-3 * x[0] * x[0]});
  });
  const auto forces = chain.shell().forces(bent);
  for (unsigned int f = 1; f + 1 < forces.size(); ++f)
    {
      BOOST_TEST(std::abs(forces[f].moment[0][0] / section.bending - 1e-3) <
                 1e-14);
      BOOST_TEST(std::abs(forces[f].thrust[0][0] / section.membrane - 2e-3) <
                 1e-14);
      BOOST_TEST(std::abs(forces[f].shear) < 1e-9 * section.bending);
    }
  for (const bool is_cut : {false, true})
    {
      const Model<3> plate      = make_plate(6, is_cut, distorted);
      const auto curved         = plate.field([](const Point<3> &x) {
        return Tensor<1, 3>(
          {0.,
           1e-3 * x[1],
           -1e-3 * (0.5 * x[0] * x[0] + 0.6 * x[0] * x[1] - x[1] * x[1])});
      });
      const LinerShell<3> shell = plate.shell();
      // the changes of curvature are 1, -2 and, between them, 0.6
      const auto of_plate = shell.forces(curved);
      const Vectors<3> f  = forces_of(shell, curved);
      for (unsigned int i = 0; i < of_plate.size(); ++i)
        {
          bool is_inside = true;
          for (const unsigned int p : plate.faces[i].points)
            for (const double x : {plate.points[p][0], plate.points[p][1]})
              is_inside = is_inside && x > 0.01 && x < 0.99;
          if (!is_inside)
            continue;
          const auto m = of_plate[i].moment / (1e-3 * section.bending);
          BOOST_TEST(std::abs(m[0][0] - (1. - 2. * poisson)) < 1e-8);
          BOOST_TEST(std::abs(m[1][1] - (-2. + poisson)) < 1e-8);
          BOOST_TEST(std::abs(m[0][1] - 0.6 * (1. - poisson)) < 1e-8);
          const auto n = of_plate[i].thrust / (1e-3 * section.membrane);
          BOOST_TEST(std::abs(n[0][0] - poisson) < 1e-8);
          BOOST_TEST(std::abs(n[1][1] - 1.) < 1e-8);
        }
      // nothing has to hold it inside
      for (unsigned int p = 0; p < f.size(); ++p)
        {
          const Point<3> &x = plate.points[p];
          if (std::min({x[0], x[1], 1. - x[0], 1. - x[1]}) > 0.55)
            BOOST_TEST(f[p].norm() < 1e-8 * section.bending);
        }
    }
}

BOOST_AUTO_TEST_CASE(liner_strip_on_two_supports)
{
  // 5/384 q L^4 / D, q = L = 1
  double last = 0.;
  for (const unsigned int n : {8, 16})
    {
      const Model<2> strip =
        make_chain(n, [](const double s) { return Point<2>(s, 0.); });
      Vectors<2> load(n + 1);
      for (unsigned int p = 0; p <= n; ++p)
        load[p][1] = 1. / n;
      const auto u = solve<2>(strip.shell(),
                              load,
                              [&](const unsigned int p, const unsigned int d) {
                                return d == 1 && p != 0 && p != n;
                              });
      const double error =
        std::abs(u[n / 2][1] * section.bending * 384. / 5. - 1.);
      BOOST_TEST(error < 0.81 / (n * n));
      if (n == 16)
        BOOST_TEST(std::abs(last / error - 4.) < 0.2);
      last = error;
      // M = q L^2 / 8, with tension at the opening, on the left of the chain
      const auto forces = strip.shell().forces(u);
      BOOST_TEST(std::abs(trace(forces[n / 2].moment) - 0.125) < 1e-6);
      BOOST_TEST(std::abs(forces[0].shear - 0.5 + 0.5 / n) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(liner_strip_that_goes_on_as_its_image)
{
  // half of a strip between its support and the plane of symmetry
  const unsigned int n = 16;
  Model<2> half = make_chain(n, [](const double s) { return Point<2>(s, 0.); });
  half.faces[n - 1].is_mirrored[1] = true;
  Vectors<2> load(n + 1);
  for (unsigned int p = 0; p <= n; ++p)
    load[p][1] = (p == n ? 0.5 : 1.) / n;
  const auto u = solve<2>(half.shell(),
                          load,
                          [&](const unsigned int p, const unsigned int d) {
                            return d == 1 && p != 0;
                          });
  BOOST_TEST(std::abs(u[n][1] * section.bending * 384. / 5. / 16. - 1.) < 1e-2);
  BOOST_TEST(std::abs(trace(half.shell().forces(u)[n - 1].moment) - 0.5) <
             1e-6);
}

BOOST_AUTO_TEST_CASE(liner_ring)
{
  // uniform pressure bends it nowhere; an oval with the amplitude W turns by
  // 3 W / R^2 per length
  const double radius = 3.;
  const auto check = [&](const LinerForce<2> &force, double thrust, double m) {
    BOOST_TEST(std::abs(trace(force.thrust) - thrust) <
               0.003 * 1e-3 / radius * section.membrane);
    BOOST_TEST(std::abs(trace(force.moment) - m) < 0.01 * std::abs(m) + 1e-6);
  };
  const unsigned int n = 64;
  const Model<2> ring  = make_chain(
    n,
    [&](const double s) {
      return Point<2>(radius * std::cos(2. * pi * s),
                      radius * std::sin(2. * pi * s));
    },
    true);
  const LinerShell<2> shell = ring.shell();
  const auto radial         = ring.field(
    [&](const Point<2> &x) { return Tensor<1, 2>(-1e-3 / radius * x); });
  check(shell.forces(radial)[0], -1e-3 / radius * section.membrane, 0.);
  // an oval without stretch
  const auto oval   = ring.field([&](const Point<2> &x) {
    const double a = std::atan2(x[1], x[0]);
    return Tensor<1, 2>(1e-3 * std::cos(2. * a) / radius * x -
                        0.5e-3 * std::sin(2. * a) / radius *
                          Tensor<1, 2>({-x[1], x[0]}));
  });
  const auto forces = shell.forces(oval);
  check(forces[0], 0., -3e-3 / (radius * radius) * section.bending);
}

BOOST_AUTO_TEST_CASE(liner_tube)
{
  // the same ring in 3D, a quarter of a slice; errors of the moment by mesh
  const double radius = 3.;
  const auto error    = [&](const unsigned int n, const bool is_cut) {
    const Model<3> tube =
      make_plate(n, is_cut, [&](const double x, const double y) {
        return Point<3>(radius * std::sin(0.5 * pi * x),
                        radius * std::cos(0.5 * pi * x),
                        y);
      });
    const auto oval   = tube.field([&](const Point<3> &x) {
      const double a = std::atan2(x[1], x[0]);
      const Tensor<1, 3> out({std::cos(a), std::sin(a), 0.}),
        round({-std::sin(a), std::cos(a), 0.});
      return 1e-3 * std::cos(2. * a) * out - 0.5e-3 * std::sin(2. * a) * round;
    });
    const auto forces = tube.shell().forces(oval);
    double worst      = 0.;
    for (unsigned int f = 0; f < forces.size(); ++f)
      {
        Point<3> center;
        for (const unsigned int p : tube.faces[f].points)
          center += 0.25 * (tube.points[p] - Point<3>());
        const double a = std::atan2(center[1], center[0]);
        if (center[2] < 0.25 || center[2] > 0.75 || a < 0.4 || a > 1.17)
          continue;
        const Tensor<1, 3> round({-std::sin(a), std::cos(a), 0.});
        const double moment = round * (forces[f].moment * round) /
                              (3e-3 / (radius * radius) * section.bending);
        worst = std::max(worst, std::abs(moment + std::cos(2. * a)));
        BOOST_TEST(std::abs(round * (forces[f].thrust * round)) <
                   0.01 * 1e-3 / radius * section.membrane);
      }
    return worst;
  };
  for (const bool is_cut : {false, true})
    {
      const double coarse = error(8, is_cut), fine = error(16, is_cut);
      BOOST_TEST(fine > 0.);
      BOOST_TEST(fine < 0.035);
      BOOST_TEST(coarse / fine > 1.8);
    }
}

BOOST_AUTO_TEST_CASE(liner_plate_on_four_supports)
{
  // Timoshenko and Woinowsky-Krieger (1959): 0.00406 q a^4 / D
  constexpr double exact = 0.00406235;
  for (const bool is_cut : {false, true})
    {
      const unsigned int n = is_cut ? 4 : 8;
      const double coarse  = deflection_of_plate(n, is_cut) / exact - 1.,
                   fine    = deflection_of_plate(2 * n, is_cut) / exact - 1.;
      BOOST_TEST(std::abs(coarse) < 0.06);
      BOOST_TEST(std::abs(fine) < 0.015);
      BOOST_TEST(std::abs(coarse / fine) > 2.8);
    }
}

BOOST_AUTO_TEST_CASE(liner_corner)
{
  // arms of a right angle that turn against each other by a small angle: the
  // same change of angle as in a straight liner
  const double angle = 1e-3, arm = 0.25;
  Model<2> corner;
  corner.points = {Point<2>(0., arm), Point<2>(0., 0.), Point<2>(arm, 0.)};
  corner.add_face({{0, 1}});
  corner.add_face({{1, 2}});
  Vectors<2> turned(3);
  turned[2][1] = angle * arm;
  BOOST_TEST(std::abs(trace(corner.shell().forces(turned)[0].moment) +
                      section.bending * angle / arm) < 1e-6);
  // a fold of a sheet
  const Model<3> fold =
    make_plate(4, false, [](const double x, const double y) {
      return Point<3>(x, std::min(y, 0.5), std::max(0., y - 0.5));
    });
  const auto u      = fold.field([&](const Point<3> &x) {
    return Tensor<1, 3>({0., -angle * x[2], 0.});
  });
  const auto forces = fold.shell().forces(u);
  double energy     = 0.;
  const auto f      = forces_of(fold.shell(), u);
  for (unsigned int p = 0; p < u.size(); ++p)
    energy += 0.5 * u[p] * f[p];
  // 1/2 D (angle / arm)^2 on a strip of the width of an arm
  BOOST_TEST(std::abs(energy / (0.5 * section.bending * angle * angle / arm) -
                      1.) < 0.1);
}

namespace
{
  /** Largest ratio of the work of @p shell to that of springs of row_sums(), by
   * power iteration. */
  template <int dim>
  double
  share_of_bound(const LinerShell<dim> &shell)
  {
    const std::vector<double> bound = shell.row_sums();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> between(-1., 1.);
    Vectors<dim> u(shell.n_points());
    for (Tensor<1, dim> &value : u)
      for (unsigned int d = 0; d < dim; ++d)
        value[d] = between(random);
    double share = 0.;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        double work = 0., most = 0., size = 0.;
        Vectors<dim> next(u.size());
        for (unsigned int p = 0; p < u.size(); ++p)
          {
            const Tensor<1, dim> force = shell.force_at(p, u);
            work += force * u[p];
            most += bound[p] * u[p].norm_square();
            next[p] = force / bound[p];
            size    = std::max(size, next[p].norm());
          }
        share = work / most;
        for (unsigned int p = 0; p < u.size(); ++p)
          u[p] = next[p] / size;
      }
    return share;
  }
} // namespace

BOOST_AUTO_TEST_CASE(liner_and_its_bound)
{
  // above the stiffest mode, and near it
  Model<2> arc;
  for (unsigned int i = 0; i <= 20; ++i)
    arc.points.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i));
  for (unsigned int i = 0; i < 20; ++i)
    arc.add_face({{i, i + 1}});
  const double bar = share_of_bound(arc.shell());
  BOOST_TEST(bar < 1. + 1e-9);
  BOOST_TEST(bar > 0.9);
  const Model<3> sheet =
    make_plate(8, true, [](const double x, const double y) {
      return Point<3>(x, y, 0.2 * x * x);
    });
  const double plate = share_of_bound(sheet.shell());
  BOOST_TEST_MESSAGE("share of the bound: " << bar << ", " << plate);
  BOOST_TEST(plate < 1. + 1e-9);
  BOOST_TEST(plate > 0.6);
}

BOOST_AUTO_TEST_SUITE_END()

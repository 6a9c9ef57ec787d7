// SPDX-License-Identifier: LGPL-2.1-or-later
// Joints made from the statistics of their set.
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/joint_sets.h>
#include <keyblock/scene/radius_law.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <array>

namespace Keyblock
{
  namespace
  {
    constexpr double largest_number = 1e6;

    Real
    degrees()
    {
      return RandomNumbers::two_pi() / 360;
    }

    /** Fowler, Noll and Vo of the name, so that sets differ by it too. */
    std::uint64_t
    seed_of(const unsigned int seed, const std::string &name)
    {
      std::uint64_t h = 14695981039346656037ull;
      for (const unsigned char letter : name)
        h = (h ^ letter) * 1099511628211ull;
      return h ^ seed;
    }

    /** Draws poles about the mean one of a set. */
    template <int dim>
    class PoleLaw
    {
    public:
      /** What makes a pole: in 2D its angle from the vertical towards +x, in 3D
       * its components. */
      using Pole = std::array<Real, dim == 2 ? 1 : 3>;

      explicit PoleLaw(const JointSet<dim> &set)
        : set(set)
        , concentration(set.concentration)
        , dip(set.dip * degrees())
        , azimuth(set.dip_direction * degrees())
        , sd(sin(dip))
        , cd(cos(dip))
        , sa(sin(azimuth))
        , ca(cos(azimuth))
      {
        if (concentration <= 0.)
          return;
        const Real k = concentration;
        const Real t = 1 + sqrt(1 + 4 * k * k);
        const Real b = (t - sqrt(2 * t)) / (2 * k);
        r            = (1 + b * b) / (2 * b);
        r_by_doubles = rounded(r);
      }

      /** The numbers of a pole; those of angles by von Mises' law are chosen by
       * the rejection of Best and Fisher (1979). */
      RandomNumbers::Pair draw(RandomNumbers &random) const;

      /** Put the pole that numbers make into dip and dip direction. */
      Pole set_pole(const RandomNumbers::Pair &numbers,
                    Joint<dim> &joint) const;

      static std::array<Real, dim>
      components(const Pole &pole)
      {
        if constexpr (dim == 2)
          return {{sin(pole[0]), cos(pole[0])}};
        else
          return pole;
      }

    private:
      /** Cosine of the angle to the mean pole by von Mises' law. */
      template <typename Number>
      Number
      von_mises_cosine(const Number &r, const double u) const
      {
        using std::cos;
        const Number z = cos(boost::math::constants::pi<Number>() * Number(u));
        return (1 + r * z) / (r + z);
      }

      /** By how much Best and Fisher take it, or do not [-]. */
      template <typename Number>
      Number
      excess(const Number &r, const double u, const double v) const
      {
        using std::log;
        const Number c = Number(concentration) * (r - von_mises_cosine(r, u));
        const Number quick = c * (2 - c) - v;
        return quick > 0 ? quick : log(c / v) + 1 - c;
      }

      /** Cosine of the angle to the mean pole by Fisher's law, by inversion. */
      Real
      fisher_cosine(const double v) const
      {
        if (concentration < 0.)
          return 1;
        if (concentration == 0.)
          return 2 * Real(v) - 1;
        const Real k      = concentration;
        const Real cosine = 1 + log(v + (1 - Real(v)) * exp(-2 * k)) / k;
        return cosine < -1 ? Real(-1) : cosine;
      }

      const JointSet<dim> &set;
      const double concentration;
      const Real dip, azimuth;
      const Real sd, cd, sa, ca; ///< their sines and cosines
      Real r              = 0;   ///< of Best and Fisher
      double r_by_doubles = 0.;  ///< the same
    };

    template <>
    RandomNumbers::Pair
    PoleLaw<2>::draw(RandomNumbers &random) const
    {
      constexpr double safe = 1e-9; // error by doubles, at most [-]
      if (concentration < 0.)
        return {0., 0.};
      while (true)
        {
          const double u = random.uniform();
          if (concentration == 0.)
            return {u, 0.};
          const double v = random.positive_uniform();
          double more    = excess(r_by_doubles, u, v);
          if (std::abs(more) < safe * (1. + concentration))
            more = rounded(excess(r, u, v));
          if (more >= 0.)
            return {u, random.uniform()};
        }
    }

    template <>
    RandomNumbers::Pair
    PoleLaw<3>::draw(RandomNumbers &random) const
    {
      return random.pair();
    }

    template <>
    PoleLaw<2>::Pole
    PoleLaw<2>::set_pole(const RandomNumbers::Pair &numbers,
                         Joint<2> &joint) const
    {
      Real angle = set.dip_direction < 180. ? dip : -dip;
      if (concentration == 0.)
        angle += RandomNumbers::two_pi() * (Real(numbers.u) - 0.5);
      else if (concentration > 0.)
        angle +=
          acos(von_mises_cosine(r, numbers.u)) * (numbers.v < 0.5 ? -1 : 1);
      // upwards
      const Real half_turn = RandomNumbers::two_pi() / 2;
      while (angle > half_turn / 2)
        angle -= half_turn;
      while (angle < -half_turn / 2)
        angle += half_turn;
      joint.dip           = set.dip;
      joint.dip_direction = set.dip_direction;
      if (concentration >= 0.)
        {
          joint.dip           = rounded(abs(angle) / degrees());
          joint.dip_direction = angle < 0 ? 270. : 90.;
        }
      return {{angle}};
    }

    template <>
    PoleLaw<3>::Pole
    PoleLaw<3>::set_pole(const RandomNumbers::Pair &numbers,
                         Joint<3> &joint) const
    {
      const Real along  = fisher_cosine(numbers.u);
      const Real across = sqrt(1 - along * along);
      const Real turn   = RandomNumbers::two_pi() * Real(numbers.v);
      // mean pole, line of dip, strike
      const Real u = across * cos(turn), v = across * sin(turn);
      Pole n = {{along * sd * sa + u * cd * sa + v * ca,
                 along * sd * ca + u * cd * ca - v * sa,
                 along * cd - u * sd}};
      if (n[2] < 0)
        for (Real &component : n)
          component = -component;
      joint.dip           = set.dip;
      joint.dip_direction = set.dip_direction;
      if (concentration < 0.)
        return n;
      joint.dip =
        rounded(atan2(sqrt(n[0] * n[0] + n[1] * n[1]), n[2]) / degrees());
      const Real direction = atan2(n[0], n[1]) / degrees();
      joint.dip_direction =
        rounded(direction < 0 ? direction + 360 : direction);
      return n;
    }

    /** Check the entries that say how many joints there are. */
    template <int dim>
    void
    check(const JointSet<dim> &set, const Domain<dim> &domain)
    {
      const std::string section = "Joint sets/" + set.name;
      const auto require        = [](const bool condition,
                              const std::string &sentence) {
        AssertThrow(condition, InputError(sentence));
      };
      const std::string p = dim == 2 ? "P21" : "P32";
      require((set.spacing > 0.) + (set.intensity > 0.) +
                  (set.frequency > 0.) ==
                1,
              "The set '" + section + "' has more than one of 'Spacing', '" +
                p + "' and 'P10'; keep one.");
      require(dim == 3 || set.dip_direction == 90. || set.dip_direction == 270.,
              "The entry '" + section + "/Dip direction' is " +
                exact_text(set.dip_direction) +
                "; in 2D it is 90 (descends to +x) or 270 (to -x).");
      require(
        set.radius_law == RadiusDistribution::infinite ||
          set.spacing_law == SpacingDistribution::exponential,
        "The entry '" + section +
          "/Spacing law' is constant, which "
          "only infinite joints can have; set 'Radius law' to infinite or "
          "'Spacing law' to exponential.");
      require(set.persistence == 1. ||
                (set.spacing > 0. &&
                 set.radius_law != RadiusDistribution::infinite),
              "The entry '" + section + "/Persistence' is " +
                exact_text(set.persistence) +
                ", which goes with 'Spacing' and finite joints; give both "
                "'Spacing' and 'Radius law', or leave it out.");
      require(set.region_corner.size() == set.region_size.size() &&
                (set.region_size.empty() || set.region_size.size() == dim),
              "The entries '" + section +
                "/Region corner' and 'Region size' "
                "have " +
                std::to_string(set.region_corner.size()) + " and " +
                std::to_string(set.region_size.size()) +
                " numbers; give each " + std::to_string(dim) +
                ", or none for the domain.");
      for (const double length : set.region_size)
        require(length > 0.,
                "The entry '" + section + "/Region size' contains " +
                  exact_text(length) + "; lengths must be positive.");
      const bool is_infinite = set.radius_law == RadiusDistribution::infinite;
      require(!is_infinite || domain.shape == DomainShape::file ||
                set.region_size.empty(),
              "The entry '" + section +
                "/Region size' is given, but 'Radius law' is infinite, and "
                "planes without a rim have no centres in a region; leave "
                "'Region corner' and 'Region size' out, or give the law of "
                "the radii.");
      require(domain.shape != DomainShape::file || !set.region_size.empty(),
              "The set '" + section +
                "' needs 'Region corner' and 'Region "
                "size', because the size of the domain in 'Domain/File' is not "
                "known yet; give them.");
    }

    void
    check_number(const double expected, const std::string &name)
    {
      AssertThrow(expected < largest_number,
                  InputError("The set 'Joint sets/" + name +
                             "' would have about " + exact_text(expected) +
                             " joints, and a million is the most; lower its "
                             "density or give larger radii."));
    }

    /** Adds joints to a list that reach into the domain. */
    template <int dim>
    class SetMaker
    {
    public:
      SetMaker(const JointSet<dim> &set, const DomainOutline<dim> &outline)
        : set(set)
        , outline(outline)
        , poles(set)
        , random(seed_of(set.seed, set.name))
      {}

      /** Planes at distances from the middle of the domain. */
      void
      make_planes()
      {
        const Real reach = Real(outline.lower.distance(outline.upper)) / 2;
        const double p   = intensity_of(set);
        check_number(2. * rounded(reach) * p, set.name);
        if (set.spacing_law == SpacingDistribution::exponential)
          {
            const unsigned int n = random.poisson(2. * rounded(reach) * p);
            for (unsigned int i = 0; i < n; ++i)
              add_plane((2 * Real(random.uniform()) - 1) * reach);
            return;
          }
        const Real spacing = 1 / Real(p);
        const Real start   = Real(random.uniform()) * spacing - reach;
        for (unsigned int i = 0; start + i * spacing <= reach; ++i)
          {
            const Real shift = set.jitter * (Real(random.uniform()) - 0.5);
            add_plane(start + (i + shift) * spacing);
          }
      }

      /** Discs with centres in the box that begins at @p corner. */
      void
      make_discs(const Point<dim> &corner,
                 const std::array<double, dim> &size,
                 const RadiusLaw &law)
      {
        double volume = 1.;
        for (const double length : size)
          volume *= length;
        const double mean_area =
          dim == 2 ? 2. * law.moment(1) : dealii::numbers::PI * law.moment(2);
        const double expected = intensity_of(set) / mean_area * volume;
        check_number(expected, set.name);
        const unsigned int n = random.poisson(expected);
        for (unsigned int i = 0; i < n; ++i)
          {
            const RandomNumbers::Pair pole = poles.draw(random);
            Point<dim> center;
            for (unsigned int d = 0; d < dim; ++d)
              center[d] = rounded(Real(corner[d]) +
                                  Real(random.uniform()) * Real(size[d]));
            const RadiusLaw::Draw radius = law.draw(random);
            if (!may_reach_domain(center, radius.estimate))
              continue;
            auto joint = make_joint();
            poles.set_pole(pole, *joint);
            joint->point  = center;
            joint->extent = JointShape::disc;
            joint->radius = rounded(law.radius_of<Real>(radius.numbers));
            keep_if_inside(joint);
          }
      }

      std::vector<std::unique_ptr<Joint<dim>>> joints;

    private:
      std::unique_ptr<Joint<dim>>
      make_joint() const
      {
        auto joint                           = std::make_unique<Joint<dim>>();
        joint->set                           = set.name;
        joint->origin                        = "Set '" + set.name + "'";
        static_cast<JointStrength &>(*joint) = set.strength;
        return joint;
      }

      /** Whether a disc, whatever its pole, may reach into the domain. */
      bool
      may_reach_domain(const Point<dim> &center, const double radius) const
      {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += std::pow(std::max({0.,
                                       outline.lower[d] - center[d],
                                       center[d] - outline.upper[d]}),
                             2);
        return square <= std::pow((1. + 1e-6) * radius, 2);
      }

      void
      keep_if_inside(std::unique_ptr<Joint<dim>> &joint)
      {
        if (!outline.meets(*joint))
          return;
        joint->name = set.name + "." + std::to_string(joints.size() + 1);
        joints.push_back(std::move(joint));
      }

      void
      add_plane(const Real &distance)
      {
        auto joint = make_joint();
        const auto n =
          poles.components(poles.set_pole(poles.draw(random), *joint));
        for (unsigned int d = 0; d < dim; ++d)
          joint->point[d] =
            rounded((Real(outline.lower[d]) + Real(outline.upper[d])) / 2 +
                    distance * n[d]);
        keep_if_inside(joint);
      }

      const JointSet<dim> &set;
      const DomainOutline<dim> &outline;
      const PoleLaw<dim> poles;
      RandomNumbers random;
    };
  } // namespace



  template <int dim>
  double
  mean_cosine(const double concentration)
  {
    const double k = concentration;
    if (k < 0.)
      return 1.;
    if (dim == 3)
      return k < 1e-3 ? 0.5 + k * k / 24. : 1. - std::tanh(0.5 * k) / k;
    const auto integrate = [&](const int power) {
      return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        [&](const double angle) {
          const double c = std::cos(angle);
          return std::pow(c, power) *
                 (std::exp(k * (c - 1.)) + std::exp(-k * (c + 1.)));
        },
        0.,
        0.5 * dealii::numbers::PI,
        20,
        1e-13);
    };
    return integrate(1) / integrate(0);
  }



  template <int dim>
  double
  intensity_of(const JointSet<dim> &set)
  {
    if (set.intensity > 0.)
      return set.intensity;
    return (set.frequency > 0. ? set.frequency
                               : set.persistence / set.spacing) /
           mean_cosine<dim>(set.concentration);
  }



  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  make_joints_of_set(const JointSet<dim> &set, const Domain<dim> &domain)
  {
    check(set, domain);
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < set.region_size.size(); ++d)
      {
        lower[d] = set.region_corner[d];
        upper[d] = lower[d] + set.region_size[d];
      }
    const DomainOutline<dim> outline = domain.shape == DomainShape::file
                                         ? DomainOutline<dim>(lower, upper)
                                         : DomainOutline<dim>(domain);
    SetMaker<dim> maker(set, outline);
    if (set.radius_law == RadiusDistribution::infinite)
      maker.make_planes();
    else
      {
        const RadiusLaw law(set);
        std::array<double, dim> size;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (set.region_size.empty())
              {
                lower[d] = outline.lower[d] - law.maximum();
                upper[d] = outline.upper[d] + law.maximum();
              }
            size[d] = upper[d] - lower[d];
          }
        maker.make_discs(lower, size, law);
      }
    return std::move(maker.joints);
  }

  template double mean_cosine<2>(const double);
  template double mean_cosine<3>(const double);
  template double intensity_of(const JointSet<2> &);
  template double intensity_of(const JointSet<3> &);
  template std::vector<std::unique_ptr<Joint<2>>>
  make_joints_of_set(const JointSet<2> &, const Domain<2> &);
  template std::vector<std::unique_ptr<Joint<3>>>
  make_joints_of_set(const JointSet<3> &, const Domain<3> &);
} // namespace Keyblock

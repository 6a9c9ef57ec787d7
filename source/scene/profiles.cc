// SPDX-License-Identifier: LGPL-2.1-or-later
// What short entries stand for: the section of a tunnel or cavern.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/scene.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Widths of the excavations between them and the boundary of a domain
     * whose Size is not given. */
    constexpr double margin_of_domain = 4.;

    using Polygon = std::vector<Point<2>>;

    /** Chords of a crown if no number is given: as long as the edges that
     * are cut into cells there, since shorter ones make needles beside them.
     * @p cell: size of cells there [m]; 0: not known. */
    unsigned int
    number_of_chords(const double arc, const double cell)
    {
      constexpr unsigned int fewest = 6, most = 24;
      constexpr double cells_along = 2.;
      if (cell == 0.)
        return most;
      return std::clamp(static_cast<unsigned int>(arc / (cells_along * cell)),
                        fewest,
                        most);
    }

    template <int dim>
    bool
    is_circle(const Excavation<dim> &e)
    {
      return e.shape == ExcavationShape::circle;
    }

    template <int dim>
    double
    width_of(const Excavation<dim> &e)
    {
      return is_circle(e) ? 2. * e.radius : e.width;
    }

    /** Elevations of an excavation's floor and crown, as its entries have it.
     */
    template <int dim>
    double
    floor_of(const Excavation<dim> &e)
    {
      return is_circle(e) ? e.center[1] - e.radius : e.center[1];
    }

    template <int dim>
    double
    crown_of(const Excavation<dim> &e)
    {
      return e.center[1] + (is_circle(e) ? e.radius : e.height);
    }

    /** Corners of a regular polygon with the area of the circle, one of them
     * at the crown. */
    template <int dim>
    Polygon
    polygon_like_circle(const Excavation<dim> &e, const double cell)
    {
      constexpr double pi = dealii::numbers::PI;
      const unsigned int n =
        2 * (e.segments > 0 ? std::max(2U, e.segments)
                            : number_of_chords(pi * e.radius, cell));
      const double turn   = 2. * pi / n;
      const double radius = e.radius * std::sqrt(turn / std::sin(turn));
      Polygon corners;
      for (unsigned int i = 0; i < n; ++i)
        corners.emplace_back(e.center[0] - radius * std::sin(i * turn),
                             e.center[1] + radius * std::cos(i * turn));
      return corners;
    }

    /** Corners of an excavation's section, counterclockwise, from the left end
     * of the floor if it has one. @p cell: as in number_of_chords() */
    template <int dim>
    Polygon
    section_of(const Excavation<dim> &e, const double cell)
    {
      if (is_circle(e))
        return polygon_like_circle(e, cell);
      const double half = 0.5 * e.width;
      const double rise = e.shape == ExcavationShape::rectangle   ? 0.
                          : e.shape == ExcavationShape::horseshoe ? half
                                                                  : e.rise;
      const double x = e.center[0], y = e.center[1], spring = e.height - rise;
      Polygon corners = {Point<2>(x - half, y), Point<2>(x + half, y)};
      if (spring > 0.)
        corners.emplace_back(x + half, y + spring);
      if (rise > 0.)
        {
          const double radius = 0.5 * (half * half / rise + rise);
          const double angle  = std::asin(std::min(1., half / radius));
          const unsigned int n =
            e.segments > 0 ? e.segments
                           : number_of_chords(2. * angle * radius, cell);
          for (unsigned int i = 1; i < n; ++i)
            {
              const double a = angle * (1. - 2. * i / n);
              corners.emplace_back(x + radius * std::sin(a),
                                   y + e.height - radius * (1. - std::cos(a)));
            }
        }
      if (spring > 0.)
        corners.emplace_back(x - half, y + spring);
      return corners;
    }

    /** The part of a convex polygon between two elevations. */
    Polygon
    cut_out(const Polygon &polygon, const double low, const double high)
    {
      /** Distance over the size up to which corners are at a level [-]. */
      constexpr double closeness = 1e-9;
      const double size          = polygon[0].distance(polygon[1]);
      Polygon result             = polygon;
      for (const bool is_floor : {true, false})
        {
          const double level = is_floor ? low : high;
          const auto inside  = [&](const Point<2> &p) {
            const double height = is_floor ? p[1] - level : level - p[1];
            return std::abs(height) <= closeness * size ? 0. : height;
          };
          Polygon cut;
          for (std::size_t i = 0; i < result.size(); ++i)
            {
              const Point<2> &a = result[i];
              const Point<2> &b = result[(i + 1) % result.size()];
              const double ha = inside(a), hb = inside(b);
              if (ha >= 0.)
                cut.push_back(a);
              if ((ha > 0. && hb < 0.) || (ha < 0. && hb > 0.))
                cut.emplace_back(a[0] + ha / (ha - hb) * (b[0] - a[0]), level);
            }
          result = cut;
        }
      return result;
    }

    template <int dim>
    void
    check_profile(const Excavation<dim> &e)
    {
      const std::string section = "Excavations/" + e.name;
      require(!is_circle(e) || e.radius > 0.,
              "The entry '" + section +
                "/Radius' is 0; give a positive radius in metres.");
      require(is_circle(e) || (e.width > 0. && e.height > 0.),
              "The excavation '" + e.name + "' is a " + name_of(e.shape) +
                " of " + text_of(e.width) + " m by " + text_of(e.height) +
                " m; give '" + section + "/Width' and 'Height'.");
      require(e.shape != ExcavationShape::horseshoe ||
                e.height >= 0.5 * e.width,
              "The entry '" + section + "/Height' is " + text_of(e.height) +
                " m, less than the radius of the crown, half of the width of " +
                text_of(e.width) +
                " m; raise it, or take a cavern with a "
                "'Rise'.");
      require(e.shape != ExcavationShape::cavern ||
                (e.rise > 0. && e.rise <= 0.5 * e.width && e.rise <= e.height),
              "The entry '" + section + "/Rise' is " + text_of(e.rise) +
                " m; give the rise of the crown's arch, up to half of the "
                "width and to the height.");
      require(e.bench_levels.size() == e.bench_stages.size(),
              "The entry '" + section + "/Bench levels' has " +
                std::to_string(e.bench_levels.size()) +
                " numbers and 'Bench stages' " +
                std::to_string(e.bench_stages.size()) +
                " names; give a stage for what is below each level.");
      require(dim == 2 || e.to > e.from,
              "The entry '" + section + "/From' (" + text_of(e.from) +
                ") is not below '" + section + "/To' (" + text_of(e.to) +
                "); give the ends of the excavation along y [m].");
      double above = crown_of(e);
      for (const double level : e.bench_levels)
        {
          require(level < above && level > floor_of(e),
                  "The entry '" + section + "/Bench levels' has " +
                    text_of(level) + " m, which is not below " +
                    text_of(above) + " m and above the floor at " +
                    text_of(floor_of(e)) +
                    " m; give elevations from the top down.");
          above = level;
        }
    }

    template <int dim>
    void
    surround(Domain<dim> &domain,
             const std::vector<const Excavation<dim> *> &profiles)
    {
      Point<dim> low, high;
      for (unsigned int d = 0; d < dim; ++d)
        {
          low[d]  = 1e300;
          high[d] = -1e300;
        }
      double width = 0.;
      for (const Excavation<dim> *e : profiles)
        {
          const double half = 0.5 * width_of(*e);
          width =
            std::max({width, width_of(*e), is_circle(*e) ? 0. : e->height});
          low[0]        = std::min(low[0], e->center[0] - half);
          high[0]       = std::max(high[0], e->center[0] + half);
          low[dim - 1]  = std::min(low[dim - 1], floor_of(*e));
          high[dim - 1] = std::max(high[dim - 1], crown_of(*e));
          if (dim == 3)
            {
              low[1]  = std::min(low[1], e->from);
              high[1] = std::max(high[1], e->to);
            }
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double margin =
            d == 0 || d == dim - 1 ? margin_of_domain * width : 0.;
          domain.corner[d] = low[d] - margin;
          domain.size.push_back(high[d] - low[d] + 2. * margin);
        }
    }

    /** Let a box end at the surface above excavations that do not reach it.
     * @p surface: elevation [m]; 0: not known */
    template <int dim>
    void
    stop_at_surface(Domain<dim> &domain,
                    const std::vector<const Excavation<dim> *> &profiles,
                    const double surface)
    {
      if (std::any_of(profiles.begin(), profiles.end(), [&](const auto *e) {
            return crown_of(*e) >= surface;
          }))
        return;
      domain.size[dim - 1] =
        std::min(domain.size[dim - 1], surface - domain.corner[dim - 1]);
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::make_profiles()
  {
    std::vector<const Excavation<dim> *> profiles;
    for (const auto &e : excavations)
      if (e->is_profile())
        {
          check_profile(*e);
          profiles.push_back(e.get());
        }
      else
        require(e->bench_levels.empty(),
                "The entry 'Excavations/" + e->name +
                  "/Bench levels' is given, but 'Shape' is " +
                  name_of(e->shape) +
                  ", which is not parted into benches; give each bench a shape "
                  "of its own.");
    if (profiles.empty())
      return;
    if (domain.shape == DomainShape::box && domain.size.empty())
      {
        for (const Excavation<dim> *e : profiles)
          require(
            !e->is_turned(),
            "The entry 'Domain/Size' is missing: around the excavation '" +
              e->name +
              "', whose 'Trend' or 'Plunge' turns it out of the axis y, "
              "no box is made; give 'Domain/Corner' and 'Size'.");
        surround(domain, profiles);
        if (ground.is_given())
          stop_at_surface(domain, profiles, ground.depth);
        set_entries(*prm,
                    "Domain",
                    {{"Corner", exact_list(domain.corner, dim)},
                     {"Size", exact_list(domain.size, dim)}});
      }
    std::vector<std::unique_ptr<Excavation<dim>>> expanded;
    for (auto &e : excavations)
      {
        if (!e->is_profile())
          {
            expanded.push_back(std::move(e));
            continue;
          }
        const double cell     = meshing.size_at_excavation > 0.
                                  ? meshing.size_at_excavation
                                  : (meshing.cells_across > 0. ? 0. : meshing.size);
        const Polygon section = section_of(*e, cell);
        // (all of a circle, whose polygon reaches a little beyond it)
        const double beyond = is_circle(*e) ? e->radius : 0.;
        double high         = crown_of(*e) + beyond;
        for (unsigned int i = 0; i <= e->bench_levels.size(); ++i)
          {
            auto part        = std::make_unique<Excavation<dim>>(*e);
            const double low = i < e->bench_levels.size()
                                 ? e->bench_levels[i]
                                 : floor_of(*e) - beyond;
            part->pivot      = e->center;
            part->shape      = dim == 2 ? ExcavationShape::polygon
                                        : ExcavationShape::extruded_polygon;
            part->vertices   = cut_out(section, low, high);
            if (i > 0)
              {
                part->bench = i;
                part->name += " bench " + std::to_string(i);
                part->stage = e->bench_stages[i - 1];
              }
            expanded.push_back(std::move(part));
            high = low;
          }
      }
    excavations = std::move(expanded);
  }

  template void Scene<2>::make_profiles();
  template void Scene<3>::make_profiles();
} // namespace Keyblock

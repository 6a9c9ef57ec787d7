// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <keyblock/base/box.h>
#include <keyblock/blocks/plane_scene.h>
#include <keyblock/blocks/solid_parts.h>
#include <keyblock/mesh/report.h>
#include <keyblock/scene/boundary_names.h>
#include <keyblock/scene/joint_extent.h>
#include <keyblock/scene/polygon.h>
#include <keyblock/scene/section_axis.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Why a scene has no planes. */
    struct NoPlanes
    {
      std::string reason;
    };

    /** What is left of the line from @p a to @p b. Of an edge between two
     * polygons both get the same line, to the last digit. */
    HalfSpace<2>
    left_of(const Point<2> &a, const Point<2> &b)
    {
      const bool is_turned     = b[0] < a[0] || (b[0] == a[0] && b[1] < a[1]);
      const Tensor<1, 2> along = is_turned ? a - b : b - a;
      const Tensor<1, 2> right({along[1], -along[0]});
      return {is_turned ? b : a, is_turned ? -right : right};
    }

    /** The half planes of each convex part of a polygon. */
    std::vector<std::vector<HalfSpace<2>>>
    half_planes_of(const std::vector<Point<2>> &corners)
    {
      std::vector<std::vector<HalfSpace<2>>> parts;
      for (const auto &part : convex_parts(corners))
        {
          parts.emplace_back();
          for (unsigned int i = 0; i < part.size(); ++i)
            parts.back().push_back(
              left_of(corners[part[i]], corners[part[(i + 1) % part.size()]]));
        }
      return parts;
    }

    /** A regular polygon with the area of a circle. */
    std::vector<Point<2>>
    polygon_like_circle(const Point<2> &center, const double radius)
    {
      constexpr unsigned int n_sides = 360;
      const double turn              = 2. * dealii::numbers::PI / n_sides;
      const double reach = radius * std::sqrt(turn / std::sin(turn));
      std::vector<Point<2>> corners;
      for (unsigned int i = 0; i < n_sides; ++i)
        corners.emplace_back(center[0] + reach * std::cos(i * turn),
                             center[1] + reach * std::sin(i * turn));
      return corners;
    }

    /** The part of a section between two half spaces across its axis. */
    std::vector<HalfSpace<3>>
    extrude(const Excavation<3> &excavation,
            const std::vector<HalfSpace<2>> &section)
    {
      const Point<3> origin = from_section(excavation, Point<3>());
      const auto direction =
        [&](const double x, const double y, const double z) {
          Tensor<1, 3> result;
          const std::array<double, 3> part = {{x, y, z}};
          for (unsigned int d = 0; d < 3; ++d)
            result +=
              part[d] *
              (from_section(excavation, Point<3>::unit_vector(d)) - origin);
          return result;
        };
      std::vector<HalfSpace<3>> sides;
      for (const HalfSpace<2> &side : section)
        sides.push_back({from_section(excavation,
                                      Point<3>(side.point[0],
                                               excavation.from,
                                               side.point[1])),
                         direction(side.outward[0], 0., side.outward[1])});
      const Point<2> &p = section.front().point;
      sides.push_back(
        {from_section(excavation, Point<3>(p[0], excavation.from, p[1])),
         direction(0., -1., 0.)});
      sides.push_back(
        {from_section(excavation, Point<3>(p[0], excavation.to, p[1])),
         direction(0., 1., 0.)});
      return sides;
    }

    /** Makes a PlaneScene; throws NoPlanes. */
    template <int dim>
    class PlaneLister
    {
    public:
      explicit PlaneLister(const Scene<dim> &scene)
        : scene(scene)
      {}

      PlaneScene<dim>
      run()
      {
        result.rules = [&scene = scene](const unsigned int a,
                                        const unsigned int b) {
          return Keyblock::rules(scene, a, b);
        };
        result.bridging = scene.network.bridging;
        list_domain();
        for (unsigned int e = 0; e < scene.excavations.size(); ++e)
          list_excavation(e);
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          list_joint(j);
        return result;
      }

    private:
      using Shape = typename JointPiece<dim>::Shape;

      bool
      is_truncated(const std::string &side) const
      {
        const auto &names = scene.domain.truncated_boundaries;
        return std::find(names.begin(), names.end(), "all") != names.end() ||
               std::find(names.begin(), names.end(), side) != names.end();
      }

      void
      add_piece(const unsigned int e, const std::vector<HalfSpace<dim>> &sides)
      {
        const bool is_rock_first = e < scene.excavations.size();
        result.excavations.push_back(
          {e,
           is_rock_first ? scene.stage_number(scene.excavations[e]->stage) : 0,
           sides});
      }

      void list_domain();
      void list_polygon(const std::vector<Point<2>> &corners);
      void list_excavation(const unsigned int e);
      void list_joint(const unsigned int j);

      const Scene<dim> &scene;
      PlaneScene<dim> result;
    };



    template <int dim>
    void
    PlaneLister<dim>::list_domain()
    {
      const Domain<dim> &domain = scene.domain;
      if (domain.shape == DomainShape::file)
        throw NoPlanes{"the domain is that of a mesh file"};
      for (const std::string &side : boundary_names<dim>())
        result.is_truncated.push_back(is_truncated(side));
      if (domain.shape == DomainShape::box)
        {
          Point<dim> far = domain.corner;
          for (unsigned int d = 0; d < dim; ++d)
            far[d] += domain.size[d];
          result.box = BoundingBox<dim>({domain.corner, far});
          return;
        }
      std::vector<Point<dim>> corners;
      if (domain.shape == DomainShape::polygon)
        corners = domain.polygon;
      else
        {
          corners.push_back(domain.corner);
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int i = 0; i < (1U << d); ++i)
              corners.push_back(corners[i] + Tensor<1, dim>(domain.edges[d]));
          Tensor<2, dim> frame;
          for (unsigned int d = 0; d < dim; ++d)
            frame[d] = domain.edges[d];
          // rows: across the sides, along their edges
          const Tensor<2, dim> across = transpose(invert(frame));
          for (unsigned int d = 0; d < dim; ++d)
            {
              result.sides.push_back({domain.corner, -across[d]});
              result.sides.push_back(
                {domain.corner + Tensor<1, dim>(domain.edges[d]), across[d]});
            }
        }
      result.box = BoundingBox<dim>(corners);
      result.box.extend(0.1 * longest_side(result.box));
      if constexpr (dim == 2)
        if (domain.shape == DomainShape::polygon)
          list_polygon(domain.polygon);
    }



    /** A polygon is its convex hull without the pockets beside its edges, where
     * there never was rock. */
    template <>
    void
    PlaneLister<2>::list_polygon(const std::vector<Point<2>> &given)
    {
      const HullOfPolygon hull(given);
      const BoundingBox<2> box(given);
      const auto is_edge_truncated = [&](const unsigned int edge) {
        if (is_truncated("id " + std::to_string(edge + 1)))
          return true;
        const Point<2> &a = given[edge], &b = given[(edge + 1) % given.size()];
        for (unsigned int d = 0; d < 2; ++d)
          if (a[d] == b[d] &&
              (a[d] == box.lower_bound(d) || a[d] == box.upper_bound(d)))
            return is_truncated(
              boundary_names<2>()[2 * d + (a[d] == box.upper_bound(d))]);
        return false;
      };
      const auto all_alike = [&](const std::vector<unsigned int> &edges) {
        return std::adjacent_find(edges.begin(),
                                  edges.end(),
                                  [&](const unsigned int e,
                                      const unsigned int f) {
                                    return is_edge_truncated(e) !=
                                           is_edge_truncated(f);
                                  }) == edges.end();
      };
      result.is_truncated.clear();
      for (const auto &side : hull.sides)
        {
          if (!all_alike(side.edges))
            throw NoPlanes{"edges of the domain in one line are truncated and "
                           "free"};
          result.sides.push_back(left_of(given[side.begin], given[side.end]));
          result.is_truncated.push_back(!side.edges.empty() &&
                                        is_edge_truncated(side.edges.front()));
        }
      const unsigned int n = scene.excavations.size();
      for (const auto &pocket : hull.pockets)
        {
          if (!all_alike(pocket.edges))
            throw NoPlanes{"edges of the domain where it is not convex are "
                           "truncated and free"};
          const bool goes_on = is_edge_truncated(pocket.edges.front());
          for (const auto &part : half_planes_of(pocket.corners))
            add_piece(goes_on ? n + 1 : n, part);
          if (goes_on)
            result.beyond = n + 1;
        }
    }



    template <int dim>
    void
    PlaneLister<dim>::list_excavation(const unsigned int e)
    {
      const Excavation<dim> &excavation = *scene.excavations[e];
      if (!excavation.has_outline())
        throw NoPlanes{
          "the excavation '" + excavation.name + "' is a " +
          (excavation.is_group() ? "group of the mesh file" : "formula")};
      if (excavation.shape == ExcavationShape::box)
        {
          std::vector<HalfSpace<dim>> sides;
          for (unsigned int d = 0; d < dim; ++d)
            for (const bool is_upper : {false, true})
              {
                HalfSpace<dim> side{excavation.corner, {}};
                side.point[d] += is_upper ? excavation.size[d] : 0.;
                side.outward[d] = is_upper ? 1. : -1.;
                sides.push_back(side);
              }
          add_piece(e, sides);
        }
      else if constexpr (dim == 2)
        {
          const auto corners =
            excavation.shape == ExcavationShape::circle
              ? polygon_like_circle(excavation.center, excavation.radius)
              : excavation.vertices;
          for (const auto &part : half_planes_of(corners))
            add_piece(e, part);
        }
      else if (excavation.shape == ExcavationShape::file)
        for (const auto &solid : excavation.solids)
          {
            const auto parts = convex_parts(*solid);
            if (parts.empty())
              throw NoPlanes{"the excavation '" + excavation.name +
                             "' is not bounded by planes"};
            for (const auto &part : parts)
              add_piece(e, part);
          }
      else
        for (const auto &section : half_planes_of(excavation.vertices))
          add_piece(e, extrude(excavation, section));
    }



    template <int dim>
    void
    PlaneLister<dim>::list_joint(const unsigned int j)
    {
      const Joint<dim> &joint = *scene.joints[j];
      const JointExtent<dim> extent(joint);
      JointPiece<dim> piece;
      piece.joint  = j;
      piece.point  = extent.origin;
      piece.normal = extent.normal;
      if (joint.extent != JointShape::polygon)
        {
          piece.shape  = extent.is_infinite() ? Shape::unbounded : Shape::disc;
          piece.radius = joint.radius;
          result.joints.push_back(piece);
          return;
        }
      piece.shape                           = Shape::polygon;
      const std::vector<Point<dim>> corners = extent.outermost_points();
      if constexpr (dim == 2)
        {
          piece.corners = corners;
          result.joints.push_back(piece);
        }
      else
        {
          const Tensor<1, 3> along  = corners[1] - corners[0],
                             across = cross_product_3d(piece.normal, along);
          std::vector<Point<2>> flat;
          for (const Point<3> &p : corners)
            flat.emplace_back(along * (p - corners[0]),
                              across * (p - corners[0]));
          for (const auto &part : convex_parts(flat))
            {
              piece.corners.clear();
              for (const unsigned int i : part)
                piece.corners.push_back(corners[i]);
              result.joints.push_back(piece);
            }
        }
    }
  } // namespace



  template <int dim>
  std::variant<PlaneScene<dim>, std::string>
  list_planes(const Scene<dim> &scene)
  {
    try
      {
        return PlaneLister<dim>(scene).run();
      }
    catch (const NoPlanes &none)
      {
        return none.reason;
      }
  }



  template <int dim>
  PlaneBlockOptions
  plane_block_options(const PlaneScene<dim> &scene)
  {
    const double side = longest_side(scene.box);
    PlaneBlockOptions options;
    options.bridging = bridging_length(scene.bridging, side);
    options.narrow   = 1e-8 * side;
    options.dust     = std::pow(1e-5 * side, dim);
    return options;
  }



#define INSTANTIATE(dim)                                                       \
  template std::variant<PlaneScene<dim>, std::string> list_planes(             \
    const Scene<dim> &);                                                       \
  template PlaneBlockOptions plane_block_options(const PlaneScene<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Contradictions between the entries of domain, mesh, excavations and joints.
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/base/find_file.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/scene/check_parts.h>
#include <keyblock/scene/polygon.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    void
    require_simple(const std::vector<Point<2>> &corners,
                   const std::string &entry)
    {
      const std::string fault = fault_of_polygon(corners);
      require(fault.empty(),
              "The polygon '" + entry + "' " + fault +
                "; give its corners in the order in which they follow each "
                "other along its outline.");
    }


    /** Corners of a polygon in space, by two axes of its plane. */
    template <int dim>
    std::vector<Point<2>>
    corners_in_plane(const Joint<dim> &joint)
    {
      const Tensor<1, dim> normal = joint.normal();
      unsigned int steepest       = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) > std::abs(normal[steepest]))
          steepest = d;
      std::vector<Point<2>> corners;
      for (const Point<dim> &vertex : joint.vertices)
        corners.emplace_back(vertex[steepest == 0 ? 1 : 0],
                             vertex[steepest == dim - 1 ? dim - 2 : dim - 1]);
      return corners;
    }
  } // namespace



  template <int dim>
  void
  check_domain(const Scene<dim> &scene)
  {
    const Domain<dim> &domain   = scene.domain;
    const Meshing<dim> &meshing = scene.meshing;
    if (domain.shape == DomainShape::box)
      {
        require(domain.size.size() == dim,
                "The entry 'Domain/Size' has " +
                  std::to_string(domain.size.size()) +
                  " numbers where the box needs " + std::to_string(dim) +
                  "; give one length per axis.");
        for (const double length : domain.size)
          require(length > 0.,
                  "The entry 'Domain/Size' contains " + text_of(length) +
                    "; lengths must be positive.");
      }
    if (domain.shape == DomainShape::parallelepiped)
      {
        require(domain.edges.size() == dim,
                "The entry 'Domain/Edges' has " +
                  std::to_string(domain.edges.size()) +
                  " vectors where the parallelepiped needs " +
                  std::to_string(dim) + "; separate vectors by ';'.");
        Tensor<2, dim> frame;
        for (unsigned int d = 0; d < dim; ++d)
          frame[d] = domain.edges[d];
        require(determinant(frame) > 0.,
                "The vectors of 'Domain/Edges' span a volume of " +
                  text_of(determinant(frame)) +
                  "; order them right-handed and not in one plane.");
      }
    if (domain.shape == DomainShape::polygon)
      {
        require(dim == 2 && domain.polygon.size() >= 3,
                "The entry 'Domain/Shape' is polygon, which needs Dimension "
                "2 and at least three corners in 'Domain/Polygon'; found " +
                  std::to_string(domain.polygon.size()) + ".");
        require(meshing.generator == MeshGenerator::gmsh,
                "The entry 'Mesh/Generator' is " + name_of(meshing.generator) +
                  ", which cannot mesh a polygon; set it to gmsh.");
        if constexpr (dim == 2)
          require_simple(domain.polygon, "Domain/Polygon");
      }
    require((domain.shape == DomainShape::file) ==
              (meshing.generator == MeshGenerator::file),
            "The entries 'Domain/Shape' (" + name_of(domain.shape) +
              ") and 'Mesh/Generator' (" + name_of(meshing.generator) +
              ") contradict each other; set both to file or neither.");
    if (domain.shape == DomainShape::file)
      {
        require(!domain.file.empty(),
                "The entry 'Domain/File' is empty; name the mesh file.");
        require(!find_file(scene.file, domain.file).empty(),
                "The mesh file '" + domain.file +
                  "' of the entry 'Domain/File' does not exist or cannot be "
                  "read; give a path relative to the scene file.");
      }
  }



  template <int dim>
  void
  check_meshing(const Scene<dim> &scene)
  {
    const Meshing<dim> &meshing = scene.meshing;
    const auto check_distances  = [](const std::vector<double> &distances,
                                    const std::string &entry) {
      for (unsigned int i = 0; i < distances.size(); ++i)
        require(distances[i] > 0. &&
                  (i == 0 || distances[i] <= distances[i - 1]),
                "The entry 'Mesh/" + entry +
                  "' is not a list of decreasing distances (number " +
                  std::to_string(i + 1) + " is " +
                  std::to_string(distances[i]) +
                  "); begin with the distance of the first halving.");
    };
    check_distances(meshing.refine_at_excavations, "Refine at excavations");
    check_distances(meshing.refine_at_joints, "Refine at joints");
    require(meshing.refine_at_excavations.empty() ||
              std::any_of(scene.excavations.begin(),
                          scene.excavations.end(),
                          [](const auto &e) { return e->has_outline(); }),
            "The entry 'Mesh/Refine at excavations' needs an excavation with "
            "an outline; use 'Mesh/Refinement levels'.");
    require(meshing.refine_at_joints.empty() || !scene.joints.empty(),
            "The entry 'Mesh/Refine at joints' needs 'Joints/Names'.");
    if (meshing.generator != MeshGenerator::structured)
      return;
    require(meshing.cells.size() == dim,
            "The entry 'Mesh/Cells' has " +
              std::to_string(meshing.cells.size()) +
              " numbers where a structured mesh needs " + std::to_string(dim) +
              "; give one count per edge.");
    for (const unsigned int n : meshing.cells)
      require(n > 0,
              "The entry 'Mesh/Cells' contains 0; give positive counts.");
    require(meshing.gradings.empty() || meshing.gradings.size() == dim,
            "The entry 'Mesh/Gradings' has " +
              std::to_string(meshing.gradings.size()) + " values where " +
              std::to_string(dim) +
              " are needed; give uniform or a ratio per edge.");
  }



  template <int dim>
  void
  check_excavation(const Excavation<dim> &excavation)
  {
    const std::string section   = "Excavations/" + excavation.name;
    const ExcavationShape shape = excavation.shape;
    require(shape != ExcavationShape::extruded_polygon || dim == 3,
            "The entry '" + section +
              "/Shape' is extruded polygon, which needs Dimension 3; use "
              "polygon in 2D.");
    require(shape != ExcavationShape::polygon || dim == 2,
            "The entry '" + section +
              "/Shape' is polygon, which needs Dimension 2; use box or "
              "extruded polygon.");
    for (const auto &[entry, value] :
         {std::make_pair("From", excavation.from),
          std::make_pair("To", excavation.to),
          std::make_pair("Trend", excavation.trend),
          std::make_pair("Plunge", excavation.plunge)})
      require(dim == 3 || value == 0.,
              "The entry '" + section + "/" + entry + "' is " + text_of(value) +
                ", which needs Dimension 3: in 2D excavations have no axis; "
                "remove it.");
    if (shape == ExcavationShape::polygon ||
        shape == ExcavationShape::extruded_polygon)
      {
        require(excavation.vertices.size() >= 3,
                "The entry '" + section + "/Vertices' has " +
                  std::to_string(excavation.vertices.size()) +
                  " corners; a polygon needs at least three.");
        require_simple(excavation.vertices, section + "/Vertices");
      }
    if (shape == ExcavationShape::extruded_polygon)
      require(excavation.from < excavation.to,
              "The entry '" + section + "/From' (" + text_of(excavation.from) +
                ") is not below '" + section + "/To' (" +
                text_of(excavation.to) + "); exchange them.");
    if (shape == ExcavationShape::formula)
      {
        require(!excavation.formula.empty(),
                "The entry '" + section +
                  "/Formula' is empty; give a formula that is positive "
                  "inside.");
        check_expression<dim>(excavation.formula, 1, section + "/Formula");
      }
    if (shape == ExcavationShape::circle)
      require(excavation.radius > 0.,
              "The entry '" + section +
                "/Radius' is 0; give a positive radius in metres.");
    if (shape == ExcavationShape::box)
      {
        require(excavation.size.size() == dim,
                "The entry '" + section + "/Size' has " +
                  std::to_string(excavation.size.size()) + " numbers; give " +
                  std::to_string(dim) + ".");
        for (const double length : excavation.size)
          require(length > 0.,
                  "The entry '" + section + "/Size' contains " +
                    text_of(length) + "; lengths must be positive.");
      }
  }



  template <int dim>
  void
  check_joint(const Joint<dim> &joint)
  {
    const std::string section = "Joints/" + joint.name;
    const std::string entry =
      (joint.origin.empty() ? "The" : joint.origin + ": the") + " entry '" +
      section;
    require(joint.normal_entry.empty() || joint.normal_entry.size() == dim,
            entry + "/Normal' has " +
              std::to_string(joint.normal_entry.size()) + " numbers; give " +
              std::to_string(dim) + " or none.");
    if (!joint.normal_entry.empty())
      {
        double largest = 0.;
        for (const double component : joint.normal_entry)
          largest = std::max(largest, std::abs(component));
        // the reciprocal of a smaller one may be infinite
        require(largest > std::numeric_limits<double>::min(),
                entry + "/Normal' is the zero vector; give a direction.");
      }
    if (dim == 2 && joint.normal_entry.empty() &&
        joint.extent != JointShape::polygon)
      require(joint.dip_direction == 90. || joint.dip_direction == 270.,
              entry + "/Dip direction' is " + text_of(joint.dip_direction) +
                "; in 2D it is 90 (descends to +x) or 270 (to -x).");
    if (joint.extent == JointShape::disc)
      require(joint.radius > 0.,
              entry + "/Radius' is 0; give the radius of the disc in metres.");
    if (joint.extent == JointShape::polygon)
      {
        const bool is_enough =
          dim == 2 ? joint.vertices.size() == 2 : joint.vertices.size() >= 3;
        require(is_enough,
                entry + "/Vertices' has " +
                  std::to_string(joint.vertices.size()) +
                  " corners; give two ends in 2D (for more points set 'Shape' "
                  "to polyline), at least three corners in 3D.");
        const double size = joint.vertices[0].distance(joint.vertices[1]);
        require(size > 0.,
                "The first two corners of '" + section +
                  "/Vertices' coincide; give distinct corners.");
        require(std::isfinite(joint.normal().norm()),
                "The corners of '" + section +
                  "/Vertices' lie on one line, or are no finite numbers; "
                  "give corners of a polygon.");
        for (const Point<dim> &vertex : joint.vertices)
          require(std::abs(joint.distance(vertex)) < 1e-6 * size,
                  "A corner of '" + section + "/Vertices' is " +
                    text_of(joint.distance(vertex)) +
                    " m off the plane of the others; joints are plane.");
        if (dim == 3)
          require_simple(corners_in_plane(joint), section + "/Vertices");
      }
    const double tangent =
      std::tan(joint.friction_angle * dealii::numbers::PI / 180.);
    require(joint.tensile_strength * tangent <= joint.cohesion * (1. + 1e-9),
            entry + "/Tensile strength' is " + text_of(joint.tensile_strength) +
              " Pa, beyond the apex cohesion / tan(friction angle) = " +
              text_of(joint.cohesion / tangent) +
              " Pa; lower it or raise 'Cohesion'.");
    require(joint.kinetic_friction_angle <= joint.friction_angle,
            entry + "/Kinetic friction angle' is " +
              text_of(joint.kinetic_friction_angle) +
              " deg, above 'Friction angle' = " +
              text_of(joint.friction_angle) +
              " deg; sliding friction cannot exceed static friction.");
    require(joint.residual_cohesion <= joint.cohesion,
            entry + "/Residual cohesion' is " +
              text_of(joint.residual_cohesion) + " Pa, above 'Cohesion' = " +
              text_of(joint.cohesion) + " Pa; lower it.");
    make_joint_law(joint, section);
  }

  template void check_domain(const Scene<2> &);
  template void check_domain(const Scene<3> &);
  template void check_meshing(const Scene<2> &);
  template void check_meshing(const Scene<3> &);
  template void check_excavation(const Excavation<2> &);
  template void check_excavation(const Excavation<3> &);
  template void check_joint(const Joint<2> &);
  template void check_joint(const Joint<3> &);
} // namespace Keyblock

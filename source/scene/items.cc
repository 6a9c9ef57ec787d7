// SPDX-License-Identifier: LGPL-2.1-or-later
// What the items of a scene derive from their entries.
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    double
    radians(const double degrees)
    {
      return degrees * dealii::numbers::PI / 180.;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  Joint<dim>::normal() const
  {
    Tensor<1, dim> n;
    if (!normal_entry.empty())
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = normal_entry[d];
    else if (extent == JointShape::polygon && dim == 2)
      {
        const Tensor<1, dim> along = vertices[1] - vertices[0];
        n[0]                       = -along[1];
        n[1]                       = along[0];
      }
    else if (extent == JointShape::polygon)
      {
        const Tensor<1, dim> a = vertices[1] - vertices[0];
        for (unsigned int i = 2; i < vertices.size(); ++i)
          {
            const Tensor<1, dim> b = vertices[i] - vertices[0];
            for (unsigned int d = 0; d < dim; ++d)
              n[d] += a[(d + 1) % dim] * b[(d + 2) % dim] -
                      a[(d + 2) % dim] * b[(d + 1) % dim];
            if (n.norm() > 0.)
              break;
          }
      }
    else
      {
        const double sine = std::sin(radians(dip));
        n[0]              = sine * std::sin(radians(dip_direction));
        if (dim == 3)
          n[1] = sine * std::cos(radians(dip_direction));
        n[dim - 1] = std::cos(radians(dip));
      }
    if (!std::isnormal(n.norm_square()))
      {
        // squares of components are too large, or too small
        double largest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          largest = std::max(largest, std::abs(n[d]));
        n /= largest;
      }
    n /= n.norm();
    // minus to plus is upwards; a vertical joint's normal points to +x or +y
    for (int d = dim - 1; d >= 0; --d)
      {
        const int axis = (d == dim - 1) ? dim - 1 : (dim - 2 - d);
        if (std::abs(n[axis]) > 1e-12)
          return n[axis] > 0. ? n : -n;
      }
    return n;
  }



  template <int dim>
  double
  Joint<dim>::distance(const Point<dim> &p) const
  {
    const Point<dim> &origin =
      (extent == JointShape::polygon) ? vertices[0] : point;
    return normal() * (p - origin);
  }



  template <int dim>
  bool
  Joint<dim>::is_within_extent(const Point<dim> &p,
                               const double tolerance) const
  {
    if (extent == JointShape::infinite)
      return true;
    if (extent == JointShape::disc)
      return p.distance(point) <= radius + tolerance;
    if (dim == 2)
      {
        const Tensor<1, dim> along = vertices[1] - vertices[0];
        const double length        = along.norm();
        const double s             = (p - vertices[0]) * along / length;
        return s >= -tolerance && s <= length + tolerance;
      }
    // a polygon in 3D, by winding about the normal; convex or not
    const Tensor<1, dim> n    = normal();
    double angle              = 0.;
    const unsigned int n_size = vertices.size();
    for (unsigned int i = 0; i < n_size; ++i)
      {
        Tensor<1, dim> a = vertices[i] - p;
        Tensor<1, dim> b = vertices[(i + 1) % n_size] - p;
        const auto edge  = b - a;
        const double s   = std::clamp(-(a * edge) / (edge * edge), 0., 1.);
        if ((a + s * edge).norm() <= tolerance)
          return true;
        double sine = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          sine += n[d] * (a[(d + 1) % dim] * b[(d + 2) % dim] -
                          a[(d + 2) % dim] * b[(d + 1) % dim]);
        angle += std::atan2(sine, a * b);
      }
    return std::abs(angle) > dealii::numbers::PI;
  }



  template <int dim>
  bool
  Support<dim>::names_axis(const unsigned int d) const
  {
    using D = SupportDirections;
    switch (directions)
      {
        case D::x:
          return d == 0;
        case D::y:
          return d == 1;
        case D::z:
          return d == 2;
        case D::xy:
          return d != 2;
        case D::xz:
          return d != 1;
        case D::yz:
          return d != 0;
        default:
          return false;
      }
  }



  void
  Stage::complete()
  {
    if (rayleigh_terms != RayleighTerms::stiffness)
      mass_damping +=
        2. * dealii::numbers::PI * rayleigh_frequency * rayleigh_ratio;
    if (!is_quasi_static())
      return;
    if (local_damping == 0.)
      local_damping = 0.8;
    if (unbalanced_ratio == 0.)
      unbalanced_ratio = 1e-5;
    if (maximum_steps == 0)
      maximum_steps = 200000;
  }



  double
  Stage::rayleigh_stiffness() const
  {
    return rayleigh_ratio > 0. && rayleigh_terms != RayleighTerms::mass
             ? rayleigh_ratio / (2. * dealii::numbers::PI * rayleigh_frequency)
             : 0.;
  }



  bool
  SafetySettings::wants_block(const unsigned int id) const
  {
    if (blocks == "none")
      return is_by_statics();
    if (blocks == "all" || blocks == "exposed" || wants_critical_only())
      return true;
    for (const std::string &word : dealii::Utilities::split_string_list(blocks))
      if (word == std::to_string(id))
        return true;
    return false;
  }



  bool
  SafetySettings::wants_stage(const std::string &name) const
  {
    return is_wanted() &&
           (stages.empty() ||
            std::find(stages.begin(), stages.end(), name) != stages.end());
  }



  template <int dim>
  double
  Material<dim>::apex() const
  {
    return friction_angle > 0. ? cohesion / std::tan(radians(friction_angle))
                               : std::numeric_limits<double>::infinity();
  }

  template struct Joint<2>;
  template struct Joint<3>;
  template double Material<2>::apex() const;
  template double Material<3>::apex() const;
  template bool Support<2>::names_axis(const unsigned int) const;
  template bool Support<3>::names_axis(const unsigned int) const;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether joints lie in the domain at all.
#include <keyblock/base/box.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/check_parts.h>
#include <keyblock/scene/domain_outline.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    bool
    is_inside(const DomainOutline<dim> &outline, const Joint<dim> &joint)
    {
      if (joint.extent != JointShape::polygon)
        return outline.meets(joint);
      const BoundingBox<dim> box(joint.vertices);
      for (unsigned int d = 0; d < dim; ++d)
        if (box.lower_bound(d) > outline.upper[d] ||
            box.upper_bound(d) < outline.lower[d])
          return false;
      return true;
    }

    template <int dim>
    std::string
    text_of_place(const Point<dim> &p)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d > 0 ? ", " : "(") + text_of(p[d], 8);
      return text + ")";
    }
  } // namespace



  template <int dim>
  void
  check_joints_inside(const Scene<dim> &scene)
  {
    // joints of sets fall by chance, and a check names its joint by itself
    if (scene.joints.empty() || scene.domain.shape == DomainShape::file ||
        !scene.checks.joint.empty() ||
        std::any_of(scene.joint_sets.begin(),
                    scene.joint_sets.end(),
                    [](const auto &set) { return set->is_made(); }))
      return;
    const DomainOutline<dim> outline(scene.domain);
    for (const auto &joint : scene.joints)
      if (is_inside(outline, *joint))
        return;
    const Joint<dim> &first = *scene.joints[0];
    const bool is_of_table =
      !scene.network.file.empty() && !first.origin.empty();
    const std::string remedy =
      is_of_table
        ? "if the table has coordinates of a grid, set 'Domain/Origin' to "
          "those of the model's origin."
        : "check 'Point', 'Vertices' and 'Extent' of joints.";
    require(false,
            (scene.joints.size() == 1
               ? "The joint lies"
               : "All " + std::to_string(scene.joints.size()) + " joints lie") +
              " outside the domain, from " + text_of_place(outline.lower) +
              " to " + text_of_place(outline.upper) + " m: '" + first.name +
              "' is at " +
              text_of_place(first.extent == JointShape::polygon
                              ? first.vertices[0]
                              : first.point) +
              " m; " + remedy);
  }

  template void check_joints_inside(const Scene<2> &);
  template void check_joints_inside(const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/scene/joint_extent.h>
#include <keyblock/scene/joint_facets.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  std::vector<std::string>
  warnings_of_facets(const Scene<dim> &scene)
  {
    /** Edges that are cut into cells, over the size of these; their part below
     * which a facet is lost among them [-]. */
    constexpr double coarsening = 3., least_edge = 0.3;

    std::vector<std::string> found;
    const Meshing<dim> &meshing = scene.meshing;
    const double size =
      meshing.size_at_joints > 0. ? meshing.size_at_joints : meshing.size;
    if (meshing.generator != MeshGenerator::gmsh || size == 0.)
      return found;
    for (const auto &joints : joints_by_surface(scene))
      {
        const std::string &name = scene.joints[joints[0]]->surface;
        if (joints.size() < 2 || name.empty())
          continue;
        std::vector<double> widths;
        for (const unsigned int j : joints)
          widths.push_back(JointExtent<dim>(*scene.joints[j]).half_width() *
                           (dim == 2 ? 2. : 1.5));
        const auto middle = widths.begin() + widths.size() / 2;
        std::nth_element(widths.begin(), middle, widths.end());
        if (*middle < least_edge * coarsening * size)
          found.push_back(
            "The joint '" + name + "' has plane parts of about " +
            text_of(*middle) + " m, much smaller than the edges of " +
            text_of(coarsening * size) +
            " m that cells are cut from: where the mesh does not follow it, "
            "its kinks are rounded off; set 'Mesh/Size at joints' to about " +
            text_of(*middle / coarsening) + ", or give larger parts.");
      }
    return found;
  }

  template std::vector<std::string> warnings_of_facets(const Scene<2> &);
  template std::vector<std::string> warnings_of_facets(const Scene<3> &);
} // namespace Keyblock

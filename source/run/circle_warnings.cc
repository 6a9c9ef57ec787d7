// SPDX-License-Identifier: LGPL-2.1-or-later
// Circles whose area the mesh does not have.
#include <deal.II/base/numbers.h>

#include <keyblock/base/number_text.h>
#include <keyblock/mesh/size_remedy.h>
#include <keyblock/run/circle_warnings.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** So much of its area a circle may lack without a warning. */
    constexpr double most_lost = 0.01;

    /** Whether the circle is in the model as a whole and nothing else is dug
     * in it, so that its cells have its area. */
    bool
    is_by_itself(const Scene<2> &scene,
                 const Mesh<2> &mesh,
                 const unsigned int circle)
    {
      const Excavation<2> &excavation = *scene.excavations[circle];
      for (const auto &other : scene.excavations)
        if (other->stage == "start")
          return false;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (mesh.excavation[c] != none && mesh.excavation[c] != circle &&
            mesh.cell_center(c).distance(excavation.center) < excavation.radius)
          return false;
      for (unsigned int d = 0; d < 2; ++d)
        {
          const auto [least, most] =
            std::minmax_element(mesh.vertices.begin(),
                                mesh.vertices.end(),
                                [d](const auto &one, const auto &other) {
                                  return one[d] < other[d];
                                });
          if (excavation.center[d] - excavation.radius < (*least)[d] ||
              excavation.center[d] + excavation.radius > (*most)[d])
            return false;
        }
      return scene.domain.shape == DomainShape::box;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_circles(const Scene<dim> &scene, const Mesh<dim> &mesh)
  {
    std::vector<std::string> warnings;
    if constexpr (dim == 2)
      for (unsigned int e = 0; e < scene.excavations.size(); ++e)
        {
          const Excavation<dim> &excavation = *scene.excavations[e];
          if (scene.meshing.generator != MeshGenerator::gmsh ||
              excavation.shape != ExcavationShape::circle ||
              !is_by_itself(scene, mesh, e))
            continue;
          double area = 0.;
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            if (mesh.excavation[c] == e)
              area += mesh.cell_volume(c);
          const double exact =
            dealii::numbers::PI * excavation.radius * excavation.radius;
          if (std::abs(area - exact) > most_lost * exact)
            warnings.push_back(
              "The circle '" + excavation.name + "' has " + text_of(area, 4) +
              " m2 in the mesh, for " + text_of(exact, 4) +
              ", as cells follow it by chords, which joints and sizes of cells "
              "make longer; " +
              remedy_of_coarse_cells(scene.meshing) + ".");
        }
    return warnings;
  }

  template std::vector<std::string> warnings_of_circles(const Scene<2> &,
                                                        const Mesh<2> &);
  template std::vector<std::string> warnings_of_circles(const Scene<3> &,
                                                        const Mesh<3> &);
} // namespace Keyblock

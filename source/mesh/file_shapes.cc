// SPDX-License-Identifier: LGPL-2.1-or-later
// How large excavations from files are.
#include <keyblock/base/box.h>
#include <keyblock/base/number_text.h>
#include <keyblock/mesh/file_shapes.h>
#include <keyblock/mesh/size.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/solid.h>

#include <cmath>
#include <filesystem>

namespace Keyblock
{
  namespace
  {
    /** Whether the excavation has a shape of its own from a file, which in 2D
     * is kept as a polygon. */
    template <int dim>
    bool
    is_from_file(const Excavation<dim> &excavation)
    {
      return dim == 3 ? !excavation.solids.empty()
                      : !excavation.file_digest.empty() &&
                          !excavation.vertices.empty();
    }

    template <int dim>
    BoundingBox<dim>
    box_around(const Excavation<dim> &excavation)
    {
      if constexpr (dim == 2)
        return BoundingBox<dim>(excavation.vertices);
      else
        {
          std::vector<Point<dim>> corners;
          for (const auto &solid : excavation.solids)
            corners.insert(corners.end(), {solid->low, solid->high});
          return BoundingBox<dim>(corners);
        }
    }

    /** In the file, also of what lies outside of the domain [m^dim]. */
    template <int dim>
    double
    volume_in_file(const Excavation<dim> &excavation)
    {
      double volume = 0.;
      for (const auto &solid : excavation.solids)
        volume += solid->surface.volume();
      if (dim == 2)
        for (unsigned int i = 0, n = excavation.vertices.size(); i < n; ++i)
          {
            const auto &a = excavation.vertices[i],
                       &b = excavation.vertices[(i + 1) % n];
            volume += 0.5 * (a[0] * b[1] - a[1] * b[0]);
          }
      return std::abs(volume);
    }

    template <int dim>
    std::string
    sides_of(const BoundingBox<dim> &box)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d > 0 ? " x " : "") + text_of(box.side_length(d), 4);
      return text + " m";
    }
  } // namespace



  template <int dim>
  void
  print_file_shapes(std::ostream &out, const Scene<dim> &scene)
  {
    for (const auto &excavation : scene.excavations)
      if (is_from_file(*excavation))
        out << "        excavation " << excavation->name << " of "
            << std::filesystem::path(excavation->file).filename().string()
            << ": " << sides_of(box_around(*excavation)) << ", "
            << text_of(volume_in_file(*excavation), 3)
            << (dim == 2 ? " m2\n" : " m3\n");
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_file_shapes(const Scene<dim> &scene)
  {
    std::vector<std::string> found;
    if (scene.meshing.generator != MeshGenerator::gmsh)
      return found;
    const DomainOutline<dim> outline(scene.domain);
    const MeshSize<dim> size(scene,
                             longest_side(BoundingBox<dim>(
                               std::make_pair(outline.lower, outline.upper))));
    for (const auto &excavation : scene.excavations)
      {
        if (!is_from_file(*excavation))
          continue;
        const BoundingBox<dim> box = box_around(*excavation);
        const double cell          = size(box.center());
        if (longest_side(box) < cell)
          found.push_back(
            "The excavation '" + excavation->name + "' from the file '" +
            excavation->file + "' is " + sides_of(box) +
            ", smaller than the cells of " + text_of(cell, 3) +
            " m that are wanted there: is it in another unit? Check the unit "
            "of the file, or lower 'Mesh/Size at excavation'.");
      }
    return found;
  }

  template void print_file_shapes(std::ostream &, const Scene<2> &);
  template void print_file_shapes(std::ostream &, const Scene<3> &);
  template std::vector<std::string> warnings_of_file_shapes(const Scene<2> &);
  template std::vector<std::string> warnings_of_file_shapes(const Scene<3> &);
} // namespace Keyblock

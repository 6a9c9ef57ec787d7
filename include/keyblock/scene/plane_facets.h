// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_plane_facets_h
#define keyblock_scene_plane_facets_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/scene/solid.h>

#include <vector>

namespace Keyblock
{
  using dealii::Tensor;

  /** A plane part of a bent joint: its corners in order, in 2D its two ends,
   * which neighbours share to the last digit, and the unit normal of the plane
   * on which they lie. */
  template <int dim>
  struct PlaneFacet
  {
    std::vector<Point<dim>> corners;
    Tensor<1, dim> normal;
  };

  /** Lines that go on from end to end, in the order of the first of each: up to
   * rounding, two ends that meet. Where more meet, none goes on. */
  std::vector<std::vector<std::vector<Point<2>>>>
  pieces_of_paths(const std::vector<std::vector<Point<2>>> &paths);

  // All below throw std::runtime_error with what is wrong.

  /** The straight parts of lines with kinks: what goes on in one direction is
   * one. Ends of lines that coincide up to rounding are one point. */
  std::vector<PlaneFacet<2>>
  facets_of_paths(std::vector<std::vector<Point<2>>> paths);

  /** The plane parts of an open or closed surface: triangles in one plane up to
   * the precision of files are one facet, unless it has holes, and their
   * vertices are put where the planes meet. */
  std::vector<PlaneFacet<3>> facets_of_triangles(TriangleSurface surface);

  /** The planes on which faces of cells lie, given by their corners; the
   * corners of such a facet are those of its largest connected part. */
  template <int dim>
  std::vector<PlaneFacet<dim>>
  facets_of_faces(const std::vector<std::vector<Point<dim>>> &faces);
} // namespace Keyblock

#endif

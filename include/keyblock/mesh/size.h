// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_size_h
#define keyblock_mesh_size_h

#include <keyblock/scene/joint_extent.h>
#include <keyblock/scene/scene.h>

#include <memory>
#include <vector>

namespace Keyblock
{
  /** Cells of at most a size [m] around places [m]. */
  template <int dim>
  struct SizeDemand
  {
    std::vector<Point<dim>> places;
    double size;
  };

  /**
   * The cell size that is wanted at each place: it grows linearly with the
   * distance from excavations, joints and the places of demands to Mesh/Size.
   * If no size at joints is given, finite ones that such cells would miss get
   * smaller ones, not smaller than those at excavations.
   */
  template <int dim>
  class MeshSize
  {
  public:
    /** @p longest_side: of the domain [m]; a part of it stands for a
     * Mesh/Grading distance and a Mesh/Size that are not given. */
    MeshSize(const Scene<dim> &scene,
             const double longest_side,
             const std::vector<SizeDemand<dim>> &demands = {});
    ~MeshSize();

    /** Wanted cell size [m] at @p p. */
    double operator()(const Point<dim> &p) const;

    /** The smallest size that a demand may have [m]. */
    double least() const;

    /** The smallest size that there is anywhere [m]. */
    double smallest() const;

    /** How much the size changes per length, at most [-]. */
    double steepness() const;

  private:
    const Scene<dim> &scene;
    double distance;      ///< over which sizes grow [m]
    double far;           ///< [m]
    double at_excavation; ///< [m]

    /** A joint at which cells are to be smaller. */
    struct SizeAtJoint
    {
      JointExtent<dim> extent;
      double size; ///< [m]
    };
    std::vector<SizeAtJoint> joints;

    struct SizeAtPlaces;
    std::vector<std::unique_ptr<SizeAtPlaces>> places;
  };
} // namespace Keyblock

#endif

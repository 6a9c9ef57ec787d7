// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_size_h
#define keyblock_mesh_size_h

#include <keyblock/joint_extent.h>
#include <keyblock/scene.h>

#include <vector>

namespace Keyblock
{
  /**
   * The cell size that the section Mesh asks for at each place: it grows
   * linearly with the distance from excavations and joints to Mesh/Size. If no
   * size at joints is given, finite ones that such cells would miss get smaller
   * ones, not smaller than those at excavations.
   */
  template <int dim>
  class MeshSize
  {
  public:
    /** @p longest_side: of the domain [m]; a quarter of it stands for a
     * Mesh/Grading distance that is not given. */
    MeshSize(const Scene<dim> &scene, const double longest_side);

    /** Wanted cell size [m] at @p p. */
    double operator()(const Point<dim> &p) const;

  private:
    const Scene<dim> &scene;
    double distance; ///< over which sizes grow [m]
    /** A joint at which cells are to be smaller. */
    struct SizeAtJoint
    {
      JointExtent<dim> extent;
      double size; ///< [m]
    };
    std::vector<SizeAtJoint> joints;
  };
} // namespace Keyblock

#endif

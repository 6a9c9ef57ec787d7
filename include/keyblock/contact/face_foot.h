// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_face_foot_h
#define keyblock_contact_face_foot_h

#include <keyblock/base/vector.h>
#include <keyblock/mesh/mesh.h>

namespace Keyblock
{
  /** The point of a face nearest to a given one: a segment in 2D, a bilinear
   * face in 3D, with corners as in a cell's face. */
  template <int dim>
  struct FaceFoot
  {
    std::array<double, Mesh<dim>::n_face_vertices> weight; ///< of the corners
    Vector<dim> offset; ///< from the foot to the given point [m]
    Vector<dim> normal; ///< of the face there, outward
    bool is_inside;     ///< not on an edge because the point is beside
    double gap;         ///< normal . offset [m]
    double size;        ///< of the face [m]
  };

  template <int dim>
  FaceFoot<dim>
  find_foot(const std::array<Vector<dim>, Mesh<dim>::n_face_vertices> &corner,
            const Vector<dim> &point);

  template <>
  FaceFoot<2> find_foot<2>(const std::array<Vector<2>, 2> &corner,
                           const Vector<2> &point);
  template <>
  FaceFoot<3> find_foot<3>(const std::array<Vector<3>, 4> &corner,
                           const Vector<3> &point);

  /** Whether a foot could be inside, or nearer than @p reach [m], with a gap of
   * at most @p reach. Errs on the safe side where the face is warped. */
  bool could_touch(const std::array<Vector<3>, 4> &corner,
                   const Vector<3> &point,
                   const double reach);
} // namespace Keyblock

#endif

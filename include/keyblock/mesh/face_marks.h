// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_face_marks_h
#define keyblock_mesh_face_marks_h

#include <deal.II/grid/tria.h>

#include <keyblock/mesh/mesh.h>

#include <vector>

namespace Keyblock
{
  /**
   * Which faces of a Triangulation lie on which surfaces of the mesh that it
   * was planted from, passed on to the children of faces that are refined.
   */
  template <int dim>
  class FaceMarks
  {
  public:
    /** That a face lies on a surface; turned if the surface's plus side is
     * where deal.II's order of the vertices does not point to. */
    struct Mark
    {
      unsigned int surface;
      bool is_turned;
    };

    using Face = typename dealii::Triangulation<dim>::face_iterator;

    /** Take the marked faces of @p coarse, whose cells are those of @p tree. */
    FaceMarks(const dealii::Triangulation<dim> &tree, const Mesh<dim> &coarse);

    /** Children lie on what their parents lie on: after each refinement. */
    void pass_on();

    const std::vector<Mark> &
    of(const Face &face) const
    {
      return marks[list_of_face[face->index()]];
    }

    const std::vector<Surface<dim>> &
    all_surfaces() const
    {
      return surfaces;
    }

    /** Whether the generator of the mesh knows its surfaces at all. */
    bool
    are_known() const
    {
      return !surfaces.empty();
    }

    bool is_on_joint(const Face &face) const;

    /** Of each line, by its index, whether faces of several joints meet in it;
     * of none in 2D. */
    std::vector<bool> find_crossings() const;

    /** The marked faces of the active cells, turned as their surfaces are. */
    std::vector<typename Mesh<dim>::MarkedFace> list() const;

  private:
    void pass_on_to_children(const Face &face);

    const dealii::Triangulation<dim> &tree;
    std::vector<Surface<dim>> surfaces;

    /** Index into marks of each face, by the face's index: refinement clears
     * the user indices of the faces in 2D. */
    std::vector<unsigned int> list_of_face;
    std::vector<std::vector<Mark>> marks;
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cut_h
#define keyblock_mesh_cut_h

#include <deal.II/base/point.h>

#include <keyblock/base/gmsh_session.h>
#include <keyblock/mesh/mesh.h>

#include <string>
#include <unordered_map>
#include <vector>

namespace Keyblock
{
  /**
   * A mesh as files and Gmsh deliver it: cells of any shape, elements of one
   * dimension less, everything in space [m]. The corners of an element are in
   * the order that Gmsh, VTK and UCD share: around the face at the bottom, then
   * around the one on top. Its handedness is arbitrary.
   */
  struct MixedMesh
  {
    struct Element
    {
      std::vector<unsigned int> vertices;

      /** Physical group or material number; 0: none. */
      unsigned int id;
    };

    std::vector<Point<3>> vertices;
    std::vector<Element> cells;
    std::vector<Element> faces;

    /** What the file calls the ids of cells and of faces. */
    GroupNames cell_names, face_names;

    /** Faces that become Mesh::marked_faces; the id is that of the surface. */
    std::vector<Element> marked_faces;
  };

  /**
   * The elements of dimension @p dim (cells) and dim-1 (faces) of the current
   * model of Gmsh, with the number of the first physical group of the entity
   * they belong to, and the names of these groups. @p vertex_of_tag gets the
   * vertex of each of Gmsh's node tags. Of curved elements only the corners are
   * taken. Vertices that no cell uses are left out, and so are faces without a
   * group or with such a vertex.
   */
  template <int dim>
  MixedMesh
  read_gmsh_model(std::unordered_map<std::size_t, unsigned int> &vertex_of_tag);

  template <int dim>
  MixedMesh read_gmsh_model();

  /**
   * @p mixed as quadrilaterals (2D) or hexahedra (3D) of positive volume, in 2D
   * with consistently oriented edges. A mesh that has no other cells keeps its
   * cells; else every cell is cut: each of its corners gets the piece that is
   * spanned by the corner, the midpoints of the edges and the centres of the
   * faces that meet there, and the centre of the cell. So a triangle gives 3
   * quadrilaterals, a quadrilateral 4, a tetrahedron 4 hexahedra, a wedge 6, a
   * hexahedron 8, and neighbours share all new vertices.
   *
   * Fills vertices, cells, region, marked_faces and, from those faces of @p
   * mixed that are outer ones, boundary_faces. In 2D z is dropped.
   *
   * Throws InputError for pyramids, which cannot be cut in this way, for cells
   * that are flat, folded or not convex, and for cells on the same side of a
   * face, that is on top of each other.
   * @p origin says where the mesh comes from, as the subject of the sentence,
   * @p remedy what to do about a bad cell.
   */
  template <int dim>
  Mesh<dim> cut_mesh(const MixedMesh &mixed,
                     const std::string &origin,
                     const std::string &remedy);

  /** Marked faces that are facets of no cell. */
  template <int dim>
  std::vector<MixedMesh::Element> loose_faces(const MixedMesh &mixed);
} // namespace Keyblock

#endif

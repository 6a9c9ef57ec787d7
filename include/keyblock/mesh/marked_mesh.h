// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_marked_mesh_h
#define keyblock_mesh_marked_mesh_h

#include <keyblock/mesh/cut.h>
#include <keyblock/mesh/gmsh_model.h>
#include <keyblock/mesh/simplex_mesh.h>
#include <keyblock/mesh/size.h>

#include <vector>

namespace Keyblock
{
  /** Gmsh's elements with what they lie on. */
  template <int dim>
  struct MarkedMesh
  {
    MixedMesh mixed;
    std::vector<Surface<dim>> surfaces; ///< first those of the joints

    /** Vertices at points of the model and, in 3D, on the rims of joints. */
    std::vector<unsigned int> corners;
  };

  /** A point of Gmsh's, in as many dimensions as the model has. */
  template <int dim>
  Point<dim>
  in_model(const Point<3> &p)
  {
    Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = p[d];
    return result;
  }

  /** Read Gmsh's current mesh, made of @p model. */
  template <int dim>
  MarkedMesh<dim> read_marked_mesh(const GmshModel<dim> &model,
                                   const Scene<dim> &scene);

  /** Wanted edges of simplices over the size of the cells they are cut into:
   * the square root of the area of a third of a regular triangle is 0.38 of
   * its edge; the cube root of the volume of a quarter of a regular
   * tetrahedron 0.31, and Gmsh's are not regular. */
  template <int dim>
  constexpr double simplex_coarsening = (dim == 2) ? 2.6 : 3.;

  /** Triangles or tetrahedra ready to be cut or mended. */
  template <int dim>
  SimplexMesh<dim> make_simplex_mesh(const MarkedMesh<dim> &marked,
                                     const MeshSize<dim> &size);

  /** The live cells and marked facets of @p mesh. */
  template <int dim>
  MarkedMesh<dim> to_marked_mesh(const SimplexMesh<dim> &mesh);

  /** Joints that lie on the same faces, the area they share, and the rock
   * that was between them. */
  template <int dim>
  void list_merged_joints(const MarkedMesh<dim> &marked,
                          const Scene<dim> &scene,
                          MeshReport<dim> &report);

  /** Put the new vertices in the middle of chords onto their circles, unless
   * that turns a thin cell beside them bad. */
  template <int dim>
  void bend_outlines(Mesh<dim> &mesh);
} // namespace Keyblock

#endif

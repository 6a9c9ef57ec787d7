// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_mesh_h
#define keyblock_mesh_mesh_h

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>

#include <keyblock/mesh/report.h>
#include <keyblock/mesh/size.h>
#include <keyblock/mesh/surface.h>
#include <keyblock/scene/scene.h>

#include <algorithm>
#include <array>
#include <iosfwd>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Keyblock
{
  using dealii::GeometryInfo;

  constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

  /** Names of physical groups in a mesh file, by number. */
  using GroupNames = std::map<unsigned int, std::string>;

  /** Whether the words `id N` of a scene mean group number @p id: N is its
   * number or its name. */
  bool means_group(const std::string &words,
                   const unsigned int id,
                   const GroupNames &names);

  /**
   * The mesh as flat lists, before it becomes a deal.II triangulation: what the
   * generators deliver, what block finding and splitting work on. Every rank
   * holds the same copy. Vertices of a cell are in deal.II's order; all cells
   * have positive volume.
   */
  template <int dim>
  struct Mesh
  {
    static constexpr unsigned int n_cell_vertices =
      GeometryInfo<dim>::vertices_per_cell;
    static constexpr unsigned int n_cell_faces =
      GeometryInfo<dim>::faces_per_cell;
    static constexpr unsigned int n_face_vertices =
      GeometryInfo<dim>::vertices_per_face;

    using CellVertices = std::array<unsigned int, n_cell_vertices>;
    using FaceVertices = std::array<unsigned int, n_face_vertices>;

    /** An outer face of a mesh file or of a domain that has names for it. */
    struct BoundaryFace
    {
      FaceVertices vertices;
      unsigned int id;
    };

    std::vector<Point<dim>> vertices;
    std::vector<CellVertices> cells;

    /** Region number of each cell in the mesh file, else 0. */
    std::vector<unsigned int> region;

    /** Index into Scene::materials of each cell. */
    std::vector<unsigned int> material;

    /** Number of the stage that excavates each cell (Scene::stage_number); 0:
     * none.
     */
    std::vector<unsigned int> excavation_stage;

    /** Materials that take the place of `material` in later stages, one list
     * per cell; empty: there are none. */
    std::vector<std::vector<unsigned int>> later_materials;

    /** Index into Scene::excavations of the one that excavates each cell. */
    std::vector<unsigned int> excavation;

    /** Ids of outer faces, where the generator gave any. */
    std::vector<BoundaryFace> boundary_faces;

    /** What a mesh file calls regions, and ids of outer faces. */
    GroupNames region_names, boundary_id_names;

    /** A face between cells that lies on a surface, as the generator knows it.
     * The right-hand normal of the vertices (in 2D: the left of the way from
     * the first to the second) points to the plus side of a joint. */
    struct MarkedFace
    {
      FaceVertices vertices;
      unsigned int surface; ///< index into surfaces
    };

    /** Planes of joints, of excavations and of the domain, and where the mesh
     * lies on them; empty if the generator does not know. */
    std::vector<Surface<dim>> surfaces;
    std::vector<MarkedFace> marked_faces;

    /** What the generator did to joints; on rank 0. */
    MeshReport<dim> report;

    /** A face of a cell and the part of it that a smaller cell covers. */
    struct HangingFace
    {
      unsigned int coarse_cell, coarse_face, fine_cell, fine_face;
    };

    /** Where the refinement changes by a level, sorted by coarse cell. */
    std::vector<HangingFace> hanging_faces;

    /** The cell across each face of each cell, or `none`; of several smaller
     * ones, one. */
    std::vector<std::array<unsigned int, n_cell_faces>> neighbor;

    /** Index into Scene::joints of the joint each face lies on, or `none`.
     * Outer faces on a joint's surface carry the joint as well. */
    std::vector<std::array<unsigned int, n_cell_faces>> joint;

    /** Side of that joint on which the cell lies: -1 or +1; 0: no joint. */
    std::vector<std::array<signed char, n_cell_faces>> side;

    /** Index into boundary_names of the outer boundary each face lies on, or
     * `none` inside and where the boundary has no name. */
    std::vector<std::array<unsigned int, n_cell_faces>> boundary;

    /** Id of each outer face in the mesh file, or `none`. */
    std::vector<std::array<unsigned int, n_cell_faces>> boundary_id;

    /** left, right, (front, back,) bottom, top: two per axis or edge. */
    static const std::vector<std::string> &boundary_names();

    unsigned int
    n_cells() const
    {
      return cells.size();
    }

    FaceVertices face_vertices(const unsigned int cell,
                               const unsigned int face) const;

    Point<dim> cell_center(const unsigned int cell) const;

    Point<dim> face_center(const unsigned int cell,
                           const unsigned int face) const;

    /** Vector area of a face, pointing out of @p cell: length of the segment
     * in 2D, exact area vector of the bilinear face in 3D [m^(dim-1)]. */
    Tensor<1, dim> face_area_vector(const unsigned int cell,
                                    const unsigned int face) const;

    /** Exact volume of the bilinear or trilinear cell [m^dim]. */
    double cell_volume(const unsigned int cell) const;

    /** Least determinant of the Jacobian over the corners, each divided by the
     * product of the lengths of its edges [-]. */
    double scaled_jacobian(const unsigned int cell) const;

    /** Call @p action with each cell across a face: one, none, or the smaller
     * ones beside a hanging face. */
    template <typename Action>
    void
    for_each_across(const unsigned int cell,
                    const unsigned int face,
                    const Action &action) const
    {
      if (neighbor[cell][face] == none)
        return;
      auto hanging =
        std::lower_bound(hanging_faces.begin(),
                         hanging_faces.end(),
                         cell,
                         [](const HangingFace &h, const unsigned int c) {
                           return h.coarse_cell < c;
                         });
      bool is_coarse = false;
      for (; hanging != hanging_faces.end() && hanging->coarse_cell == cell;
           ++hanging)
        if (hanging->coarse_face == face)
          {
            is_coarse = true;
            action(hanging->fine_cell);
          }
      if (!is_coarse)
        action(neighbor[cell][face]);
    }

    /** Whether the face lies on an outer boundary called @p name (or `all`). */
    bool is_on(const unsigned int cell,
               const unsigned int face,
               const std::string &name) const;
  };

  /** The worst shape of a cell. */
  struct MeshQuality
  {
    double minimum_scaled_jacobian = 1.; ///< 1: of a box [-]
    unsigned int worst_cell        = 0;  ///< which has it, if it is below 1
  };

  /**
   * Make or read the mesh of a scene (on rank 0; all ranks get the same copy),
   * sort its cells along a Hilbert curve, find neighbours, and mark materials,
   * excavations, joints and outer boundaries.
   * Throws InputError if the mesh does not follow a joint or an excavation, if
   * a joint misses the domain, or if a file cannot be read (collective).
   * @param out where a mesh that takes a while is announced
   * @param demands cells that Gmsh is asked for besides the section Mesh; known
   * on rank 0
   */
  template <int dim>
  Mesh<dim> make_mesh(const Communicator &communicator,
                      const Scene<dim> &scene,
                      const dealii::ConditionalOStream &out,
                      const std::vector<SizeDemand<dim>> &demands = {});

  /** Equal cells in a box or parallelepiped. */
  template <int dim>
  Mesh<dim> make_structured_mesh(const Scene<dim> &scene);

  /** Quadrilaterals or hexahedra that follow joints and excavations: exactly,
   * made by Gmsh in this process, or, where that would give cells too thin or
   * fails, with the joints cut into a mesh of the rest (cut_joints()). Throws
   * InputError if Mesh/Snap forbids to cut what cannot be exact.
   * The parameters are those of make_mesh(). */
  template <int dim>
  Mesh<dim> make_gmsh_mesh(const Scene<dim> &scene,
                           const dealii::ConditionalOStream &out,
                           const std::vector<SizeDemand<dim>> &demands);

  /** A mesh from Domain/File, non-quadrilateral cells cut. */
  template <int dim>
  Mesh<dim> read_mesh(const Scene<dim> &scene);

  /** Fill Mesh::neighbor from the cells' vertices. */
  template <int dim>
  void find_neighbors(Mesh<dim> &mesh);

  /**
   * Refine the cells that Mesh/Refine at excavations, Refine at joints and
   * Refinement levels ask for, and what keeps neighbours within one level and
   * the two sides of joints and outlines alike; fills Mesh::hanging_faces.
   * New vertices on circular outlines go to the circle.
   */
  template <int dim>
  void refine_mesh(Mesh<dim> &mesh, const Scene<dim> &scene);

  /** A vertex in the middle of an edge or face of a larger cell: its motion is
   * the weighted mean of its masters'. */
  struct HangingVertex
  {
    unsigned int vertex;
    std::vector<std::pair<unsigned int, double>> masters; ///< vertex, weight
  };

  /** All of them, sorted by vertex; no master hangs itself. */
  template <int dim>
  std::vector<HangingVertex> list_hanging_vertices(const Mesh<dim> &mesh);

  /** Whether the vertices of a face in deal.II's order turn around a normal
   * that points into the cell (2D: whether the cell is left of the way from
   * the first to the second). */
  template <int dim>
  constexpr bool
  is_inward(const unsigned int face)
  {
    return dim == 2 ? (face == 1 || face == 2) : face % 2 == 0;
  }

  /** Whether two lists of the vertices of one face, in deal.II's order but from
   * any start, turn around the same normal. */
  template <int dim>
  bool turn_alike(const typename Mesh<dim>::FaceVertices &a,
                  const typename Mesh<dim>::FaceVertices &b);

  /** Thickness of the thinnest cell (its volume over its largest face) over the
   * median one [-]: an estimate of the same ratio of stable steps. */
  template <int dim>
  double least_over_median_thickness(const Mesh<dim> &mesh);

  /** Look for the cell of the worst shape. */
  template <int dim>
  MeshQuality measure_quality(const Mesh<dim> &mesh);
} // namespace Keyblock

#endif

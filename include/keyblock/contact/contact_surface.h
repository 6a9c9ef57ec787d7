// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_contact_surface_h
#define keyblock_contact_contact_surface_h

#include <keyblock/blocks/interface.h>
#include <keyblock/contact/face_foot.h>
#include <keyblock/scene/scene.h>

#include <deal.II/base/bounding_box.h>

namespace Keyblock
{
  /** A foot and the face that it is on. */
  template <int dim>
  struct Projection : FaceFoot<dim>
  {
    unsigned int face; ///< index into Interface::surface
  };

  /** Cosine of 5 degrees: faces that differ by less are one plane. */
  constexpr double cosine_of_kink = 0.996;

  /** Whether the faces of two feet are in one plane. */
  template <int dim>
  bool
  is_coplanar(const Projection<dim> &a, const Projection<dim> &b)
  {
    return dot<dim>(a.normal, b.normal) > cosine_of_kink;
  }

  /**
   * Overlap beyond which a point is not in contact with a face, or a ridge with
   * another, but somewhere behind it [m]: less for what lay behind from the
   * start.
   * @param behind how far it lay behind at the start [m]
   * @param size of the face or ridge [m]
   */
  double largest_overlap_of(const double behind, const double size);

  /**
   * The faces of blocks that may touch, and their nodes. All are numbered as
   * surface nodes, the same on every rank. What moves is asked for by a
   * position: dim values per surface node [m], given by the caller.
   */
  template <int dim>
  class ContactSurface
  {
  public:
    ContactSurface(const SplitMesh<dim> &split,
                   const Blocks<dim> &blocks,
                   const Scene<dim> &scene);

    unsigned int
    n_nodes() const
    {
      return vertex_of_node.size();
    }

    /** Distance [m] that nodes may move, twice, before what was found near them
     * expires. */
    double
    skin() const
    {
      return skin_width;
    }

    /** Whether a surface node is on a face of @p block. Blocks that stay welded
     * share their surface nodes. */
    bool is_on_block(const unsigned int node, const unsigned int block) const;

    /** Whether a surface node is on a face of @p joint; not if that is `none`.
     */
    bool is_on_joint(const unsigned int node, const unsigned int joint) const;

    /** Whether contact of a surface node with a face is looked for: not with
     * its own faces, nor within a block, but for the two sides of a joint that
     * ends inside it, nor of rigid blocks. */
    bool may_meet(const unsigned int node, const unsigned int face) const;

    /** Whether nodes of block @p a are slaves on faces of block @p b. */
    bool is_slave_block(const unsigned int a, const unsigned int b) const;

    /** How far a surface node lay in front of a face at the start, along the
     * normal at its nearest point, as faces may be warped [m]. */
    double start_distance(const unsigned int node,
                          const unsigned int face) const;

    /** How far a node may go through a face before that bears it [m]: corners
     * that start at the end of a free face, and do not lie on it, are rounded.
     * Without area they would hold blocks that statics lets fall. */
    double rounding_of_tip(const unsigned int node,
                           const unsigned int face) const;

    std::array<Vector<dim>, Mesh<dim>::n_face_vertices>
    corners_of(const std::vector<double> &position,
               const unsigned int face) const;

    /** Outward unit normal of a face at its centre. */
    Vector<dim> face_normal(const std::vector<double> &position,
                            const unsigned int face) const;

    /** Box around a face, widened by @p margin [m]. */
    dealii::BoundingBox<dim> box_of(const std::vector<double> &position,
                                    const unsigned int face,
                                    const double margin) const;

    /** The point of a face nearest to @p point. */
    Projection<dim> project(const std::vector<double> &position,
                            const Vector<dim> &point,
                            const unsigned int face) const;

    /** Whether one of the faces of a surface node looks against @p normal. */
    bool opposes(const std::vector<double> &position,
                 const unsigned int node,
                 const Vector<dim> &normal) const;

    /** Whether the block around a surface node lies in front of a plane through
     * it with @p normal, so that the surface node can stand on that plane. */
    bool can_stand_on(const std::vector<double> &position,
                      const unsigned int node,
                      const Vector<dim> &normal) const;

    /** Whether a face with @p normal can bear a surface node: one of the node's
     * faces looks against it and, unless it is of a joint of the node's, its
     * block can stand there. A side that slides past the end of another joint
     * is not caught on that joint's ledge. */
    bool can_bear(const std::vector<double> &position,
                  const unsigned int node,
                  const unsigned int face,
                  const Vector<dim> &normal) const;

    const Interface<dim> &interface;
    std::vector<unsigned int> vertex_of_node;
    std::vector<unsigned int> node_of_vertex;
    std::vector<unsigned int> block_of_node; ///< one of them, see is_on_block()
    std::vector<bool> is_on_edge;            ///< node where planes meet

    /** Where each node is at the start [m], see place_in_joint_planes(). */
    std::vector<Point<dim>> place_of_node;
    std::vector<double> start_position; ///< the same, dim values each

    /** Surface nodes of each surface face, outward by the right-hand rule. */
    std::vector<typename Mesh<dim>::FaceVertices> nodes_of_face;
    std::vector<unsigned int> faces_with_area;            ///< all but flat ones
    std::vector<std::vector<unsigned int>> faces_of_node; ///< of those

    std::vector<double> block_face_size; ///< mean of each block [m]
    std::vector<bool> is_rigid_block;

  private:
    std::vector<double> block_volume; ///< [m^dim]
    double skin_width;                ///< [m]
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_search_h
#define keyblock_contact_search_h

#include <keyblock/blocks/interface.h>
#include <keyblock/contact/solver.h>

#include <deal.II/base/bounding_box.h>

#include <functional>

namespace Keyblock
{
  /** A slave on a master face (or its edge or corner), or in 3D a ridge across
   * another, as found now. */
  template <int dim>
  struct SurfaceContact
  {
    unsigned int
      slave;           ///< surface node; of ridges the first of the slave ridge
    unsigned int face; ///< index into Interface::surface; one of the ridge's
    unsigned int joint; ///< of the face, or `none`
    unsigned int master_block;
    bool is_ridge = false;
    ContactPoint<dim> point;
  };

  /** Where two faces of one joint lie on each other. */
  template <int dim>
  struct FaceOverlap
  {
    unsigned int slave_face, master_face; ///< indices into Interface::surface
    double area;                          ///< [m^(dim-1)]

    /** Shares of the faces' nodes at the overlap's centre. */
    std::array<double, Mesh<dim>::n_face_vertices> slave_weight, master_weight;
  };

  /** How deep a node is in a block, beyond how deep it was at the start. */
  template <int dim>
  struct Overlap
  {
    double depth = 0.; ///< [m]
    Vector<dim> place{};
  };

  /**
   * Finds which surface node meets which face. All surface nodes of the split
   * mesh are numbered as `surface nodes`, the same on every rank; positions of
   * surface nodes are given by the caller. The broad phase (search) lists
   * candidate faces for the nodes by an R-tree over bounding boxes widened by a
   * skin, and stays valid until something has moved by half the skin; the
   * narrow phase (evaluate) measures gaps, normals and weights of the
   * candidates.
   *
   * In 3D also ridges (convex edges between faces that differ by more than 20
   * degrees) that cross: where both closest points are inside the ridges, and
   * their common normal is outside both bodies.
   *
   * A node that lay behind a face from the start is beyond it, through rock,
   * and not in contact with it before it has come out. Not found: contact of a
   * block with itself, but for the two sides of a joint that ends inside it.
   */
  template <int dim>
  class ContactSearch
  {
  public:
    ContactSearch(const SplitMesh<dim> &split,
                  const Blocks<dim> &blocks,
                  const Scene<dim> &scene);

    unsigned int
    n_surface_nodes() const
    {
      return vertex_of_node.size();
    }

    /** Distance [m] that nodes may move, twice, before the candidates expire.
     */
    double
    skin() const
    {
      return skin_width;
    }

    /**
     * List candidates for the present @p position (dim per surface node).
     * @param is_paired whether the pair contact of a surface node with a face
     * stands for it, so that the face is not to be searched
     * @param has_changed surface nodes for which that has changed since a
     * search at the same position, which the others need not repeat; empty: all
     */
    void
    search(const std::vector<double> &position,
           const std::function<bool(unsigned int, unsigned int)> &is_paired,
           const std::vector<bool> &has_changed = {});

    /** Surface nodes of all candidate slaves and of the faces they may meet. */
    std::vector<unsigned int> candidate_nodes() const;

    bool
    has_candidates() const
    {
      return !candidates.empty() || !ridge_pairs.empty();
    }

    /**
     * Contacts nearer than @p reach [m] at the present @p position.
     * @param travelled how far candidate_nodes() are from where they were at
     *   the search, at most [m]; faces too far away for that are not looked at
     */
    void evaluate(const std::vector<double> &position,
                  const double reach,
                  const double travelled,
                  std::vector<SurfaceContact<dim>> &contacts) const;

    /** Overlaps of the faces of @p joints (by index), which touch each other at
     * @p position but for a tenth of their size. */
    std::vector<FaceOverlap<dim>>
    list_overlaps(const std::vector<double> &position,
                  const std::vector<bool> &joints) const;

    /** The deepest of all nodes, found without the list of candidates: a check
     * of contact. Nodes behind faces from the start are left out as there, and
     * those that a pair holds: faces that the mesh has bent may lie in several
     * layers in a joint's plane. */
    Overlap<dim>
    find_largest_overlap(const std::vector<double> &position,
                         const std::vector<bool> &is_removed_block) const;

    /** Whether a surface node is on a face of @p block. Blocks that stay welded
     * share their surface nodes. */
    bool is_on_block(const unsigned int node, const unsigned int block) const;

    /** How far a surface node lay in front of a face's plane at the start [m].
     */
    double start_distance(const unsigned int node,
                          const unsigned int face) const;

    std::vector<unsigned int> vertex_of_node;
    std::vector<unsigned int> node_of_vertex;
    std::vector<unsigned int> block_of_node; ///< one of them, see is_on_block()

    /** Where each is at the start [m], see place_in_joint_planes(). */
    std::vector<Point<dim>> place_of_node;

    /** Surface nodes of each surface face, outward by the right-hand rule. */
    std::vector<typename Mesh<dim>::FaceVertices> nodes_of_face;

    /** Outward unit normal of a face at its centre, present position. */
    Vector<dim> face_normal(const std::vector<double> &position,
                            const unsigned int face) const;

  private:
    /** A face that a slave may meet. */
    struct CandidateFace
    {
      unsigned int face;
      double largest_overlap; ///< what is deeper is beyond the face [m]
      double clearance; ///< between them at the search; 0 if behind it [m]
    };

    struct Candidate
    {
      unsigned int slave;
      std::vector<CandidateFace> faces;
      std::vector<CandidateFace>
        paired_faces; ///< a pair contact stands for them
    };

    /** A convex edge of the surface (3D). */
    struct Ridge
    {
      std::array<unsigned int, 2> surface_nodes, faces;
    };

    /** Indices into ridges. */
    struct RidgePair
    {
      unsigned int master, slave;
      double largest_overlap; ///< as in CandidateFace [m]
    };

    void find_ridges();

    void search_ridges(
      const std::vector<double> &position,
      const std::function<bool(unsigned int, unsigned int)> &is_paired);

    /** Overlap beyond which crossing ridges are no contact [m]: less for such
     * as lay beyond each other from the start. */
    double largest_overlap_of(const Ridge &master, const Ridge &slave) const;

    /** The joint that ridges meet on: of those of their faces the one whose
     * face is most nearly across @p normal; `none` if there is none. */
    unsigned int joint_between(const std::vector<double> &position,
                               const Ridge &master,
                               const Ridge &slave,
                               const Vector<dim> &normal) const;

    void add_ridge_contacts(const std::vector<double> &position,
                            const double reach,
                            std::vector<SurfaceContact<dim>> &contacts) const;

    /** Whether @p direction is outside the body at a ridge: a positive
     * combination of the normals of its faces. */
    bool is_in_normal_cone(const std::vector<double> &position,
                           const Ridge &ridge,
                           const Vector<dim> &direction) const;

    /** The point of a face nearest to a slave. */
    struct Projection
    {
      unsigned int face;
      std::array<double, Mesh<dim>::n_face_vertices> weight;
      Vector<dim> offset; ///< slave - foot
      Vector<dim> normal; ///< of the face
      bool is_inside;
      double gap; ///< normal . offset
      double size;
    };

    /** The face as a candidate of @p slave; clearance below zero if they cannot
     * meet before the next search. */
    CandidateFace make_candidate(const std::vector<double> &position,
                                 const unsigned int slave,
                                 const unsigned int face) const;

    /** Whether the block around a surface node lies in front of a plane through
     * it with
     * @p normal, so that the surface node can stand on that plane. */
    bool can_stand_on(const std::vector<double> &position,
                      const unsigned int node,
                      const Vector<dim> &normal) const;

    /** Drop contacts of a master's nodes on a slave's face where the slave has
     * a node that stands on the master's face. */
    void drop_mirrored(std::vector<SurfaceContact<dim>> &contacts) const;

    std::array<Vector<dim>, Mesh<dim>::n_face_vertices>
    corners_of(const std::vector<double> &position,
               const unsigned int face) const;

    Projection project(const std::vector<double> &position,
                       const Vector<dim> &point,
                       const unsigned int face) const;

    /** Box around a face, widened by @p margin [m]. */
    dealii::BoundingBox<dim> box_of(const std::vector<double> &position,
                                    const unsigned int face,
                                    const double margin) const;

    /** Whether two faces are in one plane, within 5 degrees. */
    static bool is_coplanar(const Projection &a, const Projection &b);

    /** Whether face @p b of the block of @p a lies behind the plane of @p a, so
     * that a node kept off @p a need not be kept off @p b. */
    bool is_convex(const std::vector<double> &position,
                   const Projection &a,
                   const Projection &b) const;

    /** Whether face @p b, of whatever block, lies behind the plane of @p a
     * with the node in front of it: the node cannot get to @p b past @p a. */
    bool hides(const std::vector<double> &position,
               const Projection &a,
               const Projection &b) const;

    /** Feet of a slave on faces within @p reach that no pair stands for. */
    std::vector<Projection> feet_near(const std::vector<double> &position,
                                      const double reach,
                                      const double travelled,
                                      const Candidate &candidate) const;

    /** Of feet over faces the nearest of those with nearly one normal, and of
     * those of a convex edge the one that the slave is least deep below, or
     * that of the joint that it slides along; else one per face, but for those
     * behind another, as the sides of a joint in a bed. */
    std::vector<Projection>
    feet_that_count(const std::vector<double> &position,
                    const unsigned int slave,
                    std::vector<Projection> inside) const;

    void add_contact(const unsigned int slave,
                     const Projection &projection,
                     const Vector<dim> &normal,
                     const double gap,
                     std::vector<SurfaceContact<dim>> &contacts) const;

    /** The contact of a slave with the edge or corner nearest to it, of faces
     * that it is beside. */
    void add_contact_beside(const std::vector<double> &position,
                            const double reach,
                            const unsigned int slave,
                            const std::vector<Projection> &outside,
                            std::vector<SurfaceContact<dim>> &contacts) const;

    void add_contacts(const std::vector<double> &position,
                      const double reach,
                      const double travelled,
                      const Candidate &candidate,
                      std::vector<SurfaceContact<dim>> &contacts) const;

    /** Whether nodes of block @p a are slaves on faces of block @p b. */
    bool is_slave_block(const unsigned int a, const unsigned int b) const;

    /** The feet of a surface node on the faces for which its pairs stand. */
    std::vector<Projection> feet_on_pairs(const std::vector<double> &position,
                                          const unsigned int node) const;

    /** How deep a surface node is in a block with @p faces near it, beyond how
     * deep it was at the start [m]; not above 0 if it is outside, or if a pair
     * holds it on the plane of the face. */
    double overlap_with(const std::vector<double> &position,
                        const unsigned int node,
                        const std::vector<unsigned int> &faces) const;

    /** Whether a surface node is on a face of @p joint; not if that is `none`.
     */
    bool is_on_joint(const unsigned int node, const unsigned int joint) const;

    bool opposes(const std::vector<double> &position,
                 const unsigned int slave,
                 const Vector<dim> &normal) const;

    const Interface<dim> &interface;
    std::vector<double> block_face_size; ///< mean [m]
    std::vector<double> block_volume;
    std::vector<bool> is_rigid_block;
    std::vector<bool> is_sharp;         ///< surface node on an edge or corner
    std::vector<double> start_position; ///< place_of_node, dim values each
    std::vector<unsigned int> faces_with_area;            ///< all but flat ones
    std::vector<std::vector<unsigned int>> faces_of_node; ///< of those
    std::vector<Candidate> candidates;
    std::vector<Ridge> ridges;
    std::vector<RidgePair> ridge_pairs;
    double skin_width;

    /** Overlap over the size of a face beyond which a node is not in contact
     * with the face, but somewhere behind it [-]. */
    static constexpr double deepest_overlap = 0.5;

    /** The same for nodes that lay behind the face from the start, and how far
     * over the size that has to be; over how far they lay behind it [-]. */
    static constexpr double overlap_from_behind = 0.05, least_behind = 1e-3,
                            way_out = 0.5;

    /** Cosine of 20 degrees: faces that differ by more make a sharp edge. */
    static constexpr double cosine_of_sharp = 0.9396926207859084;
  };

  template <>
  void ContactSearch<3>::find_ridges();
  template <>
  void ContactSearch<3>::search_ridges(
    const std::vector<double> &position,
    const std::function<bool(unsigned int, unsigned int)> &is_paired);
  template <>
  double ContactSearch<3>::largest_overlap_of(const Ridge &master,
                                              const Ridge &slave) const;
  template <>
  unsigned int
  ContactSearch<3>::joint_between(const std::vector<double> &position,
                                  const Ridge &master,
                                  const Ridge &slave,
                                  const Vector<3> &normal) const;
  template <>
  void ContactSearch<3>::add_ridge_contacts(
    const std::vector<double> &position,
    const double reach,
    std::vector<SurfaceContact<3>> &contacts) const;
  template <>
  bool ContactSearch<3>::is_in_normal_cone(const std::vector<double> &position,
                                           const Ridge &ridge,
                                           const Vector<3> &direction) const;
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_search_h
#define keyblock_contact_search_h

#include <keyblock/contact_solver.h>
#include <keyblock/interface.h>

#include <functional>

namespace Keyblock
{
  /** A slave on a master face (or its edge or corner), or in 3D a ridge across
   * another, as found now. */
  template <int dim>
  struct SurfaceContact
  {
    unsigned int slave; ///< slot; of ridges the first of the slave ridge
    unsigned int face;  ///< index into Interface::surface; one of the ridge's
    unsigned int joint; ///< of the face, or `none`
    unsigned int master_block;
    bool is_ridge = false;
    ContactPoint<dim> point;
  };

  /**
   * Finds which surface node meets which face. All surface nodes of the split
   * mesh are numbered as `slots`, the same on every rank; positions of slots
   * are given by the caller. The broad phase (search) lists candidate faces for
   * the nodes by an R-tree over bounding boxes widened by a skin, and stays
   * valid until something has moved by half the skin; the narrow phase
   * (evaluate) measures gaps, normals and weights of the candidates.
   *
   * In 3D also ridges (convex edges between faces that differ by more than 20
   * degrees) that cross: where both closest points are inside the ridges, and
   * their common normal is outside both bodies.
   *
   * Not found: contact of a block with itself, but for the two sides of a joint
   * that ends inside it.
   */
  template <int dim>
  class ContactSearch
  {
  public:
    ContactSearch(const SplitMesh<dim> &split,
                  const Blocks<dim> &blocks,
                  const Scene<dim> &scene);

    unsigned int
    n_slots() const
    {
      return vertex_of_slot.size();
    }

    /** Distance [m] that nodes may move, twice, before the candidates expire.
     */
    double
    skin() const
    {
      return skin_width;
    }

    /**
     * List candidates for the present @p position (dim per slot).
     * @param is_paired whether the pair contact of a slot with a face stands
     *   for it, so that the face is not to be searched
     */
    void
    search(const std::vector<double> &position,
           const std::function<bool(unsigned int, unsigned int)> &is_paired);

    /** Slots of all candidate slaves and of the faces they may meet. */
    std::vector<unsigned int> candidate_slots() const;

    bool
    has_candidates() const
    {
      return !candidates.empty() || !ridge_pairs.empty();
    }

    /** Contacts nearer than @p reach [m] at the present @p position. */
    void evaluate(const std::vector<double> &position,
                  const double reach,
                  std::vector<SurfaceContact<dim>> &contacts) const;

    std::vector<unsigned int> vertex_of_slot;
    std::vector<unsigned int> slot_of_vertex;
    std::vector<unsigned int> block_of_slot;

    /** Where each slot is at the start [m]: its vertex, but in the planes of
     * the joints of its faces, which the mesh may have bent. So bent faces do
     * not interlock. */
    std::vector<Point<dim>> place_of_slot;

    /** Slots of each surface face, outward by the right-hand rule. */
    std::vector<typename Mesh<dim>::FaceVertices> face_slots;

    /** Outward unit normal of a face at its centre, present position. */
    Vector<dim> face_normal(const std::vector<double> &position,
                            const unsigned int face) const;

  private:
    struct Candidate
    {
      unsigned int slave;
      std::vector<unsigned int> faces;
      std::vector<unsigned int>
        paired_faces; ///< a pair contact stands for them
    };

    /** A convex edge of the surface (3D). */
    struct Ridge
    {
      std::array<unsigned int, 2> slots, faces;
    };

    /** Indices into ridges. */
    struct RidgePair
    {
      unsigned int master, slave;
    };

    void place_slots(const Mesh<dim> &mesh, const Scene<dim> &scene);

    void find_ridges();

    void search_ridges(
      const std::vector<double> &position,
      const std::function<bool(unsigned int, unsigned int)> &is_paired);

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

    std::array<Vector<dim>, Mesh<dim>::n_face_vertices>
    corners_of(const std::vector<double> &position,
               const unsigned int face) const;

    Projection project(const std::vector<double> &position,
                       const unsigned int slave,
                       const unsigned int face) const;

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

    void add_contacts(const std::vector<double> &position,
                      const double reach,
                      const Candidate &candidate,
                      std::vector<SurfaceContact<dim>> &contacts) const;

    /** Whether nodes of block @p a are slaves on faces of block @p b. */
    bool is_slave_block(const unsigned int a, const unsigned int b) const;

    bool opposes(const std::vector<double> &position,
                 const unsigned int slave,
                 const Vector<dim> &normal) const;

    const Interface<dim> &interface;
    std::vector<double> block_face_size; ///< mean [m]
    std::vector<double> block_volume;
    std::vector<bool> is_rigid_block;
    std::vector<bool> is_sharp; ///< slot on an edge or corner
    std::vector<std::vector<unsigned int>> faces_of_slot;
    std::vector<Candidate> candidates;
    std::vector<Ridge> ridges;
    std::vector<RidgePair> ridge_pairs;
    double skin_width;

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

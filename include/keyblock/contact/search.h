// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_search_h
#define keyblock_contact_search_h

#include <keyblock/contact/ridges.h>

#include <memory>

namespace Keyblock
{
  /**
   * Finds which surface node meets which face, and in 3D which ridges cross.
   * The broad phase (search) lists candidate faces for the nodes by an R-tree
   * over bounding boxes widened by a skin, and stays valid until something has
   * moved by half the skin; the narrow phase (evaluate) measures gaps, normals
   * and weights of the candidates.
   *
   * A node that lay behind a face from the start is beyond it, through rock,
   * and not in contact with it before it has come out. Not found: contact of a
   * block with itself, but for the two sides of a joint that ends inside it.
   */
  template <int dim>
  class ContactSearch
  {
  public:
    explicit ContactSearch(const ContactSurface<dim> &surface);

    /**
     * List candidates for the present @p position (dim per surface node).
     * @param has_changed surface nodes for which @p is_paired has changed since
     * a search at the same position, which the others need not repeat; empty:
     * all
     */
    void search(const std::vector<double> &position,
                const IsPaired &is_paired,
                const std::vector<bool> &has_changed = {});

    /** Let the next search find what presses on each other although it is
     * @p gap apart: joints that have dilated, springs [m]. */
    void
    widen(const double gap)
    {
      held_gap = gap;
    }

    /** Surface nodes of all candidate slaves and of the faces they may meet. */
    std::vector<unsigned int> candidate_nodes() const;

    /**
     * Contacts nearer than @p reach [m] at the present @p position.
     * @param travelled how far candidate_nodes() are from where they were at
     *   the search, at most [m]; faces too far away for that are not looked at
     */
    void evaluate(const std::vector<double> &position,
                  const double reach,
                  const double travelled,
                  std::vector<SurfaceContact<dim>> &contacts) const;

    /** A face that a slave may meet. */
    struct CandidateFace
    {
      unsigned int face;
      double largest_overlap; ///< what is deeper is beyond the face [m]
      double clearance; ///< between them at the search; 0 if behind it [m]
      double rounding;  ///< ContactSurface::rounding_of_tip() [m]
    };

    /** The face as a candidate of @p slave; clearance below zero if they cannot
     * meet before the next search. */
    CandidateFace make_candidate(const std::vector<double> &position,
                                 const unsigned int slave,
                                 const unsigned int face) const;

    /** The feet of a surface node on the faces for which its pairs stand. */
    std::vector<Projection<dim>>
    feet_on_pairs(const std::vector<double> &position,
                  const unsigned int node) const;

    const ContactSurface<dim> &surface;

  private:
    struct Candidate
    {
      unsigned int slave;
      std::vector<CandidateFace> faces;
      std::vector<CandidateFace>
        paired_faces; ///< a pair contact stands for them
    };

    /** Drop contacts of a master's nodes on a slave's face where the slave has
     * a node that stands on the master's face. */
    void drop_mirrored(std::vector<SurfaceContact<dim>> &contacts) const;

    /** Whether face @p b of the block of @p a lies behind the plane of @p a, so
     * that a node kept off @p a need not be kept off @p b. */
    bool is_convex(const std::vector<double> &position,
                   const Projection<dim> &a,
                   const Projection<dim> &b) const;

    /** Whether face @p b, of whatever block, lies behind the plane of @p a
     * with the node in front of it: the node cannot get to @p b past @p a. */
    bool hides(const std::vector<double> &position,
               const Projection<dim> &a,
               const Projection<dim> &b) const;

    /** Feet of a slave on faces within @p reach that no pair stands for. */
    std::vector<Projection<dim>> feet_near(const std::vector<double> &position,
                                           const double reach,
                                           const double travelled,
                                           const Candidate &candidate) const;

    /** Of feet over faces the nearest of those with nearly one normal, and of
     * those of a convex edge the one that the slave is least deep below, or
     * that of the joint that it slides along; else one per face, but for those
     * behind another, as the sides of a joint in a bed. */
    std::vector<Projection<dim>>
    feet_that_count(const std::vector<double> &position,
                    const unsigned int slave,
                    std::vector<Projection<dim>> inside) const;

    void add_contact(const unsigned int slave,
                     const Projection<dim> &projection,
                     const Vector<dim> &normal,
                     const double gap,
                     std::vector<SurfaceContact<dim>> &contacts) const;

    /** The joint of a slave that has slid over the rim of it, on rock that goes
     * on level, by less than half a face: what the slave stands for is still on
     * the joint. None if it has gone farther. */
    unsigned int joint_at_rim(const std::vector<double> &position,
                              const Candidate &candidate,
                              const Projection<dim> &foot) const;

    /** Give a contact over a foot that is on no joint of the slave's the one
     * over whose rim the slave has slid, if any. */
    void keep_joint_at_rim(const std::vector<double> &position,
                           const Candidate &candidate,
                           const Projection<dim> &foot,
                           SurfaceContact<dim> &contact) const;

    /** Contacts of a slave that is beside faces of its joint by so little that
     * they bear it as if it were over them. Returns whether there are any. */
    bool add_contacts_flush(const std::vector<double> &position,
                            const Candidate &candidate,
                            const std::vector<Projection<dim>> &kept,
                            const std::vector<Projection<dim>> &outside,
                            std::vector<SurfaceContact<dim>> &contacts) const;

    /** The contact of a slave with the edge or corner nearest to it, of faces
     * that it is beside. */
    void add_contact_beside(const std::vector<double> &position,
                            const double reach,
                            const Candidate &candidate,
                            const std::vector<Projection<dim>> &outside,
                            std::vector<SurfaceContact<dim>> &contacts) const;

    void add_contacts(const std::vector<double> &position,
                      const double reach,
                      const double travelled,
                      const Candidate &candidate,
                      std::vector<SurfaceContact<dim>> &contacts) const;

    /** How far from a face its slaves are looked for [m]. */
    double
    range() const
    {
      return surface.skin() + held_gap;
    }

    std::vector<Candidate> candidates;
    std::unique_ptr<RidgeSearch> ridges; ///< in 3D
    double held_gap = 0.;                ///< [m]
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_ridges_h
#define keyblock_contact_ridges_h

#include <keyblock/contact/surface_contact.h>

namespace Keyblock
{
  /**
   * Finds ridges (convex edges between faces that differ by more than 20
   * degrees) that cross, in 3D: where both closest points are inside the
   * ridges, and their common normal is outside both bodies. As
   * ContactSearch does with nodes and faces, search() lists pairs that may meet
   * and add_contacts() measures them.
   */
  class RidgeSearch
  {
  public:
    explicit RidgeSearch(const ContactSurface<3> &surface);

    /** List the pairs that may meet near the present @p position, as
     * ContactSearch::search(). */
    void search(const std::vector<double> &position, const IsPaired &is_paired);

    /** Add contacts nearer than @p reach [m]. */
    void add_contacts(const std::vector<double> &position,
                      const double reach,
                      std::vector<SurfaceContact<3>> &contacts) const;

    /** Mark the surface nodes of the faces of pairs that may meet. */
    void mark_nodes(std::vector<bool> &is_used) const;

  private:
    struct Ridge
    {
      std::array<unsigned int, 2> surface_nodes, faces;
    };

    struct RidgePair
    {
      unsigned int master, slave; ///< indices into ridges
      double largest_overlap;     ///< what is deeper is beyond the ridge [m]
    };

    /** Overlap beyond which crossing ridges are no contact [m]. */
    double largest_overlap(const Ridge &master, const Ridge &slave) const;

    /** The joint that ridges meet on: of those of their faces the one whose
     * face is most nearly across @p normal; `none` if there is none. */
    unsigned int joint_between(const std::vector<double> &position,
                               const Ridge &master,
                               const Ridge &slave,
                               const Vector<3> &normal) const;

    /** Whether @p direction is outside the body at a ridge: a positive
     * combination of the normals of its faces. */
    bool is_in_normal_cone(const std::vector<double> &position,
                           const Ridge &ridge,
                           const Vector<3> &direction) const;

    const ContactSurface<3> &surface;
    std::vector<Ridge> ridges;
    std::vector<RidgePair> pairs;
  };
} // namespace Keyblock

#endif

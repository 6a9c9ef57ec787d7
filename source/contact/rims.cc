// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes at the rims of their joints.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/search.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** How far a node may be beside a face of its joint that still bears it,
     * over the size of the face [-]. */
    constexpr double farthest_overhang = 1e-3;
  } // namespace



  template <int dim>
  unsigned int
  ContactSearch<dim>::joint_at_rim(const std::vector<double> &position,
                                   const Candidate &candidate,
                                   const Projection<dim> &foot) const
  {
    // of what a node at the rim of its block stands for, half a face
    constexpr double share  = 0.5;
    const Vector<dim> place = at<dim>(position, candidate.slave);
    unsigned int joint      = none;
    double nearest          = std::numeric_limits<double>::max();
    for (const auto *faces : {&candidate.faces, &candidate.paired_faces})
      for (const CandidateFace &face : *faces)
        if (const unsigned int own = surface.interface.surface[face.face].joint;
            surface.is_on_joint(candidate.slave, own))
          {
            const Projection<dim> beside =
              surface.project(position, place, face.face);
            const double distance = norm<dim>(beside.offset);
            if (distance < std::min(share * beside.size, nearest) &&
                is_coplanar(beside, foot))
              {
                nearest = distance;
                joint   = own;
              }
          }
    return joint;
  }



  template <int dim>
  void
  ContactSearch<dim>::keep_joint_at_rim(const std::vector<double> &position,
                                        const Candidate &candidate,
                                        const Projection<dim> &foot,
                                        SurfaceContact<dim> &contact) const
  {
    if (surface.is_on_joint(candidate.slave, contact.joint))
      return;
    if (const unsigned int own = joint_at_rim(position, candidate, foot);
        own != none)
      contact.joint = own;
  }



  template <int dim>
  bool
  ContactSearch<dim>::add_contacts_flush(
    const std::vector<double> &position,
    const Candidate &candidate,
    const std::vector<Projection<dim>> &kept,
    const std::vector<Projection<dim>> &outside,
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    std::vector<Projection<dim>> flush;
    for (const Projection<dim> &foot : outside)
      {
        const double farthest = farthest_overhang * foot.size;
        if (norm<dim>(foot.offset) < farthest &&
            std::none_of(kept.begin(),
                         kept.end(),
                         [&](const auto &other) {
                           return is_coplanar(other, foot) ||
                                  is_convex(position, other, foot);
                         }) &&
            surface.can_stand_on(position, candidate.slave, foot.normal) &&
            joint_at_rim(position, candidate, foot) != none)
          flush.push_back(foot);
      }
    std::sort(flush.begin(), flush.end(), [](const auto &a, const auto &b) {
      const double to_a = norm<dim>(a.offset), to_b = norm<dim>(b.offset);
      return to_a < to_b || (to_a == to_b && a.face < b.face);
    });
    const std::size_t n_before = contacts.size();
    std::vector<Projection<dim>> added;
    for (const Projection<dim> &foot : flush)
      if (std::none_of(added.begin(), added.end(), [&](const auto &other) {
            return is_coplanar(other, foot) || is_convex(position, other, foot);
          }))
        {
          added.push_back(foot);
          add_contact(candidate.slave, foot, foot.normal, foot.gap, contacts);
          keep_joint_at_rim(position, candidate, foot, contacts.back());
        }
    return contacts.size() > n_before;
  }

  template void ContactSearch<2>::keep_joint_at_rim(const std::vector<double> &,
                                                    const Candidate &,
                                                    const Projection<2> &,
                                                    SurfaceContact<2> &) const;
  template bool
  ContactSearch<2>::add_contacts_flush(const std::vector<double> &,
                                       const Candidate &,
                                       const std::vector<Projection<2>> &,
                                       const std::vector<Projection<2>> &,
                                       std::vector<SurfaceContact<2>> &) const;
  template void ContactSearch<3>::keep_joint_at_rim(const std::vector<double> &,
                                                    const Candidate &,
                                                    const Projection<3> &,
                                                    SurfaceContact<3> &) const;
  template bool
  ContactSearch<3>::add_contacts_flush(const std::vector<double> &,
                                       const Candidate &,
                                       const std::vector<Projection<3>> &,
                                       const std::vector<Projection<3>> &,
                                       std::vector<SurfaceContact<3>> &) const;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Broad phase: which nodes may meet which faces.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/search.h>
#include <keyblock/scene/joint_extent.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Joints with a smaller sine between them count as one. */
    constexpr double least_sine = 1e-2;

    /** Free faces with a larger sine between them make an edge. */
    constexpr double least_sine_of_edge = 0.34;

    /** Shifts of vertices onto their joints that count as the mesh's bend, over
     * the size of a face [-]. */
    constexpr double least_bend = 1e-4, farthest_bend = 2.;

    /** Sine of what an edge may dip below the plane on which its end stands. */
    constexpr double dip_of_edges = 0.34;

    /** Share of a face's corner in a point that counts as the corner. */
    constexpr double share_of_corner = 0.9;
  } // namespace



  template <int dim>
  ContactSearch<dim>::ContactSearch(const SplitMesh<dim> &split,
                                    const Blocks<dim> &blocks,
                                    const Scene<dim> &scene)
    : interface(split.interface)
    , block_face_size(blocks.blocks.size(), 0.)
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<unsigned int> n_faces(blocks.blocks.size(), 0);
    slot_of_vertex.assign(mesh.vertices.size(), none);
    double smallest = std::numeric_limits<double>::max();
    for (const SurfaceFace<dim> &face : interface.surface)
      {
        auto slots = face.vertices;
        for (unsigned int &slot : slots)
          {
            const unsigned int v = slot;
            if (slot_of_vertex[v] == none)
              {
                slot_of_vertex[v] = vertex_of_slot.size();
                vertex_of_slot.push_back(v);
                block_of_slot.push_back(face.block);
                faces_of_slot.emplace_back();
              }
            slot = slot_of_vertex[v];
            faces_of_slot[slot].push_back(face_slots.size());
          }
        face_slots.push_back(slots);
        const double size =
          std::pow(mesh.face_area_vector(face.cell, face.face).norm(),
                   1. / (dim - 1));
        smallest = std::min(smallest, size);
        block_face_size[face.block] += size;
        ++n_faces[face.block];
      }
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      {
        block_face_size[b] /= std::max(1u, n_faces[b]);
        block_volume.push_back(blocks.blocks[b].volume);
        is_rigid_block.push_back(blocks.blocks[b].is_rigid);
      }
    skin_width = 0.5 * smallest;
    place_slots(mesh, scene);
    start_position.resize(dim * n_slots());
    for (unsigned int slot = 0; slot < n_slots(); ++slot)
      for (int d = 0; d < dim; ++d)
        start_position[dim * slot + d] = place_of_slot[slot][d];
    if constexpr (dim == 3)
      find_ridges();

    for (unsigned int slot = 0; slot < n_slots(); ++slot)
      {
        bool is_edge = false;
        for (const unsigned int f : faces_of_slot[slot])
          is_edge = is_edge || dot<dim>(face_normal(start_position, f),
                                        face_normal(start_position,
                                                    faces_of_slot[slot][0])) <
                                 cosine_of_sharp;
        is_sharp.push_back(is_edge);
      }
  }



  template <int dim>
  void
  ContactSearch<dim>::place_slots(const Mesh<dim> &mesh,
                                  const Scene<dim> &scene)
  {
    std::vector<JointExtent<dim>> planes;
    planes.reserve(scene.joints.size());
    for (const auto &joint : scene.joints)
      planes.emplace_back(*joint);
    for (unsigned int slot = 0; slot < n_slots(); ++slot)
      {
        const Point<dim> &vertex = mesh.vertices[vertex_of_slot[slot]];
        Point<dim> place         = vertex;
        double size              = 0.;
        std::vector<Tensor<1, dim>> used;
        std::vector<unsigned int> joints;
        // free faces stay where they are
        for (const unsigned int f : faces_of_slot[slot])
          if (interface.surface[f].joint == none)
            {
              const SurfaceFace<dim> &face = interface.surface[f];
              const Tensor<1, dim> area =
                mesh.face_area_vector(face.cell, face.face);
              Tensor<1, dim> n = area / area.norm();
              for (const auto &other : used)
                n -= (n * other) * other;
              if (used.size() < dim && n.norm() > least_sine_of_edge)
                used.push_back(n / n.norm());
            }
        for (const unsigned int f : faces_of_slot[slot])
          {
            const SurfaceFace<dim> &face = interface.surface[f];
            size                         = std::max(size,
                            mesh.vertices[face.vertices[0]].distance(
                              mesh.vertices[face.vertices[1]]));
            if (face.joint == none ||
                std::find(joints.begin(), joints.end(), face.joint) !=
                  joints.end())
              continue;
            joints.push_back(face.joint);
            Tensor<1, dim> way = planes[face.joint].normal;
            for (const auto &n : used)
              way -= (way * n) * n;
            if (used.size() == dim || way.norm() < least_sine)
              continue;
            place -=
              planes[face.joint].distance(place) / way.norm_square() * way;
            used.push_back(way / way.norm());
          }
        // rounding is no bend, and planes that meet far away do not meet here
        const double shift = place.distance(vertex);
        place_of_slot.push_back(
          shift > least_bend * size && shift < farthest_bend * size ? place
                                                                    : vertex);
      }
  }



  template <int dim>
  Vector<dim>
  ContactSearch<dim>::face_normal(const std::vector<double> &position,
                                  const unsigned int face) const
  {
    const auto &slots = face_slots[face];
    if constexpr (dim == 2)
      {
        const Vector<2> along =
          difference<2>(at<2>(position, slots[1]), at<2>(position, slots[0]));
        return unit<2>({{along[1], -along[0]}});
      }
    else
      return unit<3>(cross(
        difference<3>(at<3>(position, slots[3]), at<3>(position, slots[0])),
        difference<3>(at<3>(position, slots[2]), at<3>(position, slots[1]))));
  }



  template <int dim>
  bool
  ContactSearch<dim>::is_slave_block(const unsigned int a,
                                     const unsigned int b) const
  {
    if (is_rigid_block[a] != is_rigid_block[b])
      return is_rigid_block[b];
    if (std::abs(block_face_size[a] - block_face_size[b]) >
        0.05 * block_face_size[a])
      return block_face_size[a] < block_face_size[b];
    if (block_volume[a] != block_volume[b])
      return block_volume[a] < block_volume[b];
    return a >= b;
  }



  template <int dim>
  dealii::BoundingBox<dim>
  ContactSearch<dim>::box_of(const std::vector<double> &position,
                             const unsigned int face,
                             const double margin) const
  {
    std::pair<dealii::Point<dim>, dealii::Point<dim>> corners;
    for (unsigned int d = 0; d < dim; ++d)
      {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const unsigned int slot : face_slots[face])
          {
            low  = std::min(low, position[dim * slot + d]);
            high = std::max(high, position[dim * slot + d]);
          }
        corners.first[d]  = low - margin;
        corners.second[d] = high + margin;
      }
    return dealii::BoundingBox<dim>(corners);
  }



  template <int dim>
  bool
  ContactSearch<dim>::is_on_block(const unsigned int slot,
                                  const unsigned int block) const
  {
    return block_of_slot[slot] == block ||
           std::any_of(faces_of_slot[slot].begin(),
                       faces_of_slot[slot].end(),
                       [&](const unsigned int f) {
                         return interface.surface[f].block == block;
                       });
  }



  template <int dim>
  double
  ContactSearch<dim>::start_distance(const unsigned int slot,
                                     const unsigned int face) const
  {
    Vector<dim> center{};
    for (const unsigned int corner : face_slots[face])
      center = add<dim>(center,
                        1. / face_slots[face].size(),
                        at<dim>(start_position, corner));
    return dot<dim>(face_normal(start_position, face),
                    difference<dim>(at<dim>(start_position, slot), center));
  }



  template <int dim>
  typename ContactSearch<dim>::CandidateFace
  ContactSearch<dim>::make_candidate(const std::vector<double> &position,
                                     const unsigned int slave,
                                     const unsigned int face) const
  {
    const Projection now = project(position, at<dim>(position, slave), face);
    const double before  = -start_distance(slave, face);
    CandidateFace result{face, deepest_overlap * now.size, 0.};
    if (before > least_behind * now.size)
      result.largest_overlap =
        std::min(way_out * before, overlap_from_behind * now.size);
    const double distance = norm<dim>(now.offset);
    if (now.gap > 0.)
      result.clearance = distance;
    // behind the face for good, or too far beside it
    if (now.gap < -result.largest_overlap - skin_width ||
        (!(now.gap < 0. && now.is_inside) &&
         distance > skin_width + 1e-5 * now.size))
      result.clearance = -1.;
    return result;
  }



  template <int dim>
  bool
  ContactSearch<dim>::can_stand_on(const std::vector<double> &position,
                                   const unsigned int slot,
                                   const Vector<dim> &normal) const
  {
    const Vector<dim> end = at<dim>(position, slot);
    for (const unsigned int f : faces_of_slot[slot])
      for (const unsigned int other : face_slots[f])
        {
          const Vector<dim> edge =
            difference<dim>(at<dim>(position, other), end);
          if (dot<dim>(edge, normal) < -dip_of_edges * norm<dim>(edge))
            return false;
        }
    return true;
  }



  template <int dim>
  void
  ContactSearch<dim>::drop_mirrored(
    std::vector<SurfaceContact<dim>> &contacts) const
  {
    // the corner of its face that a contact stands on, or `none`
    const auto corner_of = [](const SurfaceContact<dim> &contact) {
      for (int k = 1; k < contact.point.n_nodes; ++k)
        if (contact.point.weight[k] < -share_of_corner)
          return contact.point.node[k];
      return none;
    };
    const auto has_slave = [](const SurfaceContact<dim> &contact,
                              const unsigned int slot) {
      return contact.slave < slot;
    };
    // contacts are in the order of their slaves
    const auto is_mirror = [&](const SurfaceContact<dim> &contact) {
      const unsigned int corner = corner_of(contact);
      if (corner == none ||
          is_slave_block(block_of_slot[contact.slave], contact.master_block))
        return false;
      for (auto other = std::lower_bound(
             contacts.begin(), contacts.end(), corner, has_slave);
           other != contacts.end() && other->slave == corner;
           ++other)
        if (corner_of(*other) == contact.slave &&
            dot<dim>(other->point.normal, contact.point.normal) < -0.99)
          return true;
      return false;
    };
    std::vector<bool> is_dropped;
    for (const SurfaceContact<dim> &contact : contacts)
      is_dropped.push_back(is_mirror(contact));
    unsigned int n_kept = 0;
    for (unsigned int i = 0; i < contacts.size(); ++i)
      if (!is_dropped[i])
        contacts[n_kept++] = contacts[i];
    contacts.resize(n_kept);
  }



  template <int dim>
  void
  ContactSearch<dim>::search(
    const std::vector<double> &position,
    const std::function<bool(unsigned int, unsigned int)> &is_paired,
    const std::vector<bool> &has_changed)
  {
    std::vector<std::pair<dealii::BoundingBox<dim>, unsigned int>> boxes;
    for (unsigned int f = 0; f < face_slots.size(); ++f)
      boxes.emplace_back(box_of(position, f, skin_width), f);
    const auto tree = dealii::pack_rtree(boxes);

    const std::vector<Candidate> before = std::move(candidates);
    candidates.clear();
    auto kept     = before.begin();
    namespace bgi = boost::geometry::index;
    for (unsigned int slot = 0; slot < n_slots(); ++slot)
      {
        while (kept != before.end() && kept->slave < slot)
          ++kept;
        if (!has_changed.empty() && !has_changed[slot])
          {
            if (kept != before.end() && kept->slave == slot)
              candidates.push_back(*kept);
            continue;
          }
        dealii::Point<dim> p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = position[dim * slot + d];
        Candidate candidate{slot, {}, {}};
        const unsigned int block = block_of_slot[slot];
        const auto is_a_slave_on = [&](const unsigned int f) {
          return is_slave_block(block, interface.surface[f].block) ||
                 (is_sharp[slot] &&
                  can_stand_on(position, slot, face_normal(position, f)));
        };
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::intersects(p)))
          {
            const unsigned int f     = hit.second;
            const unsigned int other = interface.surface[f].block;
            const auto &slots        = face_slots[f];
            if (std::find(slots.begin(), slots.end(), slot) != slots.end() ||
                (is_rigid_block[block] && is_rigid_block[other]))
              continue;
            if (block == other && interface.surface[f].joint == none)
              continue;
            const bool has_pair = is_paired(slot, f);
            if (!has_pair && !is_a_slave_on(f))
              continue;
            const CandidateFace face = make_candidate(position, slot, f);
            if (face.clearance >= 0.)
              (has_pair ? candidate.paired_faces : candidate.faces)
                .push_back(face);
          }
        std::sort(candidate.faces.begin(),
                  candidate.faces.end(),
                  [](const CandidateFace &a, const CandidateFace &b) {
                    return a.face < b.face;
                  });
        if (!candidate.faces.empty())
          candidates.push_back(candidate);
      }
    if constexpr (dim == 3)
      search_ridges(position, is_paired);
  }



  template <int dim>
  std::vector<unsigned int>
  ContactSearch<dim>::candidate_slots() const
  {
    std::vector<bool> is_used(n_slots(), false);
    for (const Candidate &candidate : candidates)
      {
        is_used[candidate.slave] = true;
        // the slave's own faces tell which side of it is outside
        for (const unsigned int f : faces_of_slot[candidate.slave])
          for (const unsigned int slot : face_slots[f])
            is_used[slot] = true;
        for (const CandidateFace &candidate_face : candidate.faces)
          for (const unsigned int slot : face_slots[candidate_face.face])
            is_used[slot] = true;
      }
    for (const RidgePair &pair : ridge_pairs)
      for (const unsigned int r : {pair.master, pair.slave})
        for (const unsigned int f : ridges[r].faces)
          for (const unsigned int slot : face_slots[f])
            is_used[slot] = true;
    std::vector<unsigned int> slots;
    for (unsigned int slot = 0; slot < n_slots(); ++slot)
      if (is_used[slot])
        slots.push_back(slot);
    return slots;
  }



  template class ContactSearch<2>;
  template class ContactSearch<3>;
} // namespace Keyblock

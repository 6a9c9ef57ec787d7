// SPDX-License-Identifier: LGPL-2.1-or-later
// Broad phase: which nodes may meet which faces.
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/search.h>
#include <keyblock/contact/surface_places.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
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
    node_of_vertex.assign(mesh.vertices.size(), none);
    double smallest = std::numeric_limits<double>::max();
    for (const SurfaceFace<dim> &face : interface.surface)
      {
        auto surface_nodes = face.vertices;
        for (unsigned int &node : surface_nodes)
          {
            const unsigned int v = node;
            if (node_of_vertex[v] == none)
              {
                node_of_vertex[v] = vertex_of_node.size();
                vertex_of_node.push_back(v);
                block_of_node.push_back(face.block);
                faces_of_node.emplace_back();
              }
            node = node_of_vertex[v];
            faces_of_node[node].push_back(nodes_of_face.size());
          }
        nodes_of_face.push_back(surface_nodes);
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
    skin_width                      = 0.5 * smallest;
    const SurfacePlaces<dim> places = place_in_joint_planes<dim>(
      mesh,
      scene,
      interface.surface,
      {vertex_of_node, faces_of_node, nodes_of_face});
    place_of_node = places.of_node;
    for (unsigned int f = 0; f < nodes_of_face.size(); ++f)
      if (!places.is_flat[f])
        faces_with_area.push_back(f);
    for (std::vector<unsigned int> &faces : faces_of_node)
      faces.erase(std::remove_if(faces.begin(),
                                 faces.end(),
                                 [&](const unsigned int f) {
                                   return places.is_flat[f];
                                 }),
                  faces.end());
    start_position.resize(dim * n_surface_nodes());
    for (unsigned int node = 0; node < n_surface_nodes(); ++node)
      for (int d = 0; d < dim; ++d)
        start_position[dim * node + d] = place_of_node[node][d];
    if constexpr (dim == 3)
      find_ridges();

    for (unsigned int node = 0; node < n_surface_nodes(); ++node)
      {
        bool is_edge = false;
        for (const unsigned int f : faces_of_node[node])
          is_edge = is_edge || dot<dim>(face_normal(start_position, f),
                                        face_normal(start_position,
                                                    faces_of_node[node][0])) <
                                 cosine_of_sharp;
        is_sharp.push_back(is_edge);
      }
  }



  template <int dim>
  Vector<dim>
  ContactSearch<dim>::face_normal(const std::vector<double> &position,
                                  const unsigned int face) const
  {
    const auto &surface_nodes = nodes_of_face[face];
    if constexpr (dim == 2)
      {
        const Vector<2> along =
          difference<2>(at<2>(position, surface_nodes[1]),
                        at<2>(position, surface_nodes[0]));
        return unit<2>({{along[1], -along[0]}});
      }
    else
      return unit<3>(cross(difference<3>(at<3>(position, surface_nodes[3]),
                                         at<3>(position, surface_nodes[0])),
                           difference<3>(at<3>(position, surface_nodes[2]),
                                         at<3>(position, surface_nodes[1]))));
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
        for (const unsigned int node : nodes_of_face[face])
          {
            low  = std::min(low, position[dim * node + d]);
            high = std::max(high, position[dim * node + d]);
          }
        corners.first[d]  = low - margin;
        corners.second[d] = high + margin;
      }
    return dealii::BoundingBox<dim>(corners);
  }



  template <int dim>
  bool
  ContactSearch<dim>::is_on_block(const unsigned int node,
                                  const unsigned int block) const
  {
    return block_of_node[node] == block ||
           std::any_of(faces_of_node[node].begin(),
                       faces_of_node[node].end(),
                       [&](const unsigned int f) {
                         return interface.surface[f].block == block;
                       });
  }



  template <int dim>
  double
  ContactSearch<dim>::start_distance(const unsigned int node,
                                     const unsigned int face) const
  {
    Vector<dim> center{};
    for (const unsigned int corner : nodes_of_face[face])
      center = add<dim>(center,
                        1. / nodes_of_face[face].size(),
                        at<dim>(start_position, corner));
    return dot<dim>(face_normal(start_position, face),
                    difference<dim>(at<dim>(start_position, node), center));
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
                                   const unsigned int node,
                                   const Vector<dim> &normal) const
  {
    const Vector<dim> end = at<dim>(position, node);
    for (const unsigned int f : faces_of_node[node])
      for (const unsigned int other : nodes_of_face[f])
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
                              const unsigned int node) {
      return contact.slave < node;
    };
    // contacts are in the order of their slaves
    const auto is_mirror = [&](const SurfaceContact<dim> &contact) {
      const unsigned int corner = corner_of(contact);
      if (corner == none ||
          is_slave_block(block_of_node[contact.slave], contact.master_block))
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
    is_dropped.reserve(contacts.size());
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
    for (const unsigned int f : faces_with_area)
      boxes.emplace_back(box_of(position, f, skin_width), f);
    const auto tree = dealii::pack_rtree(boxes);

    const std::vector<Candidate> before = std::move(candidates);
    candidates.clear();
    auto kept     = before.begin();
    namespace bgi = boost::geometry::index;
    for (unsigned int node = 0; node < n_surface_nodes(); ++node)
      {
        while (kept != before.end() && kept->slave < node)
          ++kept;
        if (!has_changed.empty() && !has_changed[node])
          {
            if (kept != before.end() && kept->slave == node)
              candidates.push_back(*kept);
            continue;
          }
        dealii::Point<dim> p;
        for (unsigned int d = 0; d < dim; ++d)
          p[d] = position[dim * node + d];
        Candidate candidate{node, {}, {}};
        const unsigned int block = block_of_node[node];
        const auto is_a_slave_on = [&](const unsigned int f) {
          return is_slave_block(block, interface.surface[f].block) ||
                 (is_sharp[node] &&
                  can_stand_on(position, node, face_normal(position, f)));
        };
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::intersects(p)))
          {
            const unsigned int f      = hit.second;
            const unsigned int other  = interface.surface[f].block;
            const auto &surface_nodes = nodes_of_face[f];
            if (std::find(surface_nodes.begin(), surface_nodes.end(), node) !=
                  surface_nodes.end() ||
                (is_rigid_block[block] && is_rigid_block[other]))
              continue;
            if (block == other && interface.surface[f].joint == none)
              continue;
            const bool has_pair = is_paired(node, f);
            if (!has_pair && !is_a_slave_on(f))
              continue;
            const CandidateFace face = make_candidate(position, node, f);
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
  ContactSearch<dim>::candidate_nodes() const
  {
    std::vector<bool> is_used(n_surface_nodes(), false);
    for (const Candidate &candidate : candidates)
      {
        is_used[candidate.slave] = true;
        // the slave's own faces tell which side of it is outside
        for (const unsigned int f : faces_of_node[candidate.slave])
          for (const unsigned int node : nodes_of_face[f])
            is_used[node] = true;
        for (const CandidateFace &candidate_face : candidate.faces)
          for (const unsigned int node : nodes_of_face[candidate_face.face])
            is_used[node] = true;
      }
    for (const RidgePair &pair : ridge_pairs)
      for (const unsigned int r : {pair.master, pair.slave})
        for (const unsigned int f : ridges[r].faces)
          for (const unsigned int node : nodes_of_face[f])
            is_used[node] = true;
    std::vector<unsigned int> surface_nodes;
    for (unsigned int node = 0; node < n_surface_nodes(); ++node)
      if (is_used[node])
        surface_nodes.push_back(node);
    return surface_nodes;
  }



  template class ContactSearch<2>;
  template class ContactSearch<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/contact_surface.h>
#include <keyblock/contact/geometry.h>
#include <keyblock/contact/surface_places.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Sine of what an edge may dip below the plane on which its end stands. */
    constexpr double dip_of_edges = 0.34;

    /** Overlap over the size of a face beyond which a node is not in contact
     * with the face, but somewhere behind it [-]. */
    constexpr double deepest_overlap = 0.5;

    /** The same for nodes that lay behind the face from the start, and how far
     * over the size that has to be; over how far they lay behind it [-]. */
    constexpr double overlap_from_behind = 0.05, least_behind = 1e-3,
                     way_out = 0.5;

    /** A corner is at the end of a free face if it is no further from it than
     * this over the size of the face [-]. */
    constexpr double distance_of_tip = 1e-3;

    /** How far corners of blocks are rounded, over the size of the block and,
     * at most, over that of the face that they meet [-]. */
    constexpr double radius_of_tips = 0.01, most_of_face = 0.2;
  } // namespace



  double
  largest_overlap_of(const double behind, const double size)
  {
    return behind > least_behind * size
             ? std::min(way_out * behind, overlap_from_behind * size)
             : deepest_overlap * size;
  }



  template <int dim>
  ContactSurface<dim>::ContactSurface(const SplitMesh<dim> &split,
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
    start_position.resize(dim * n_nodes());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (int d = 0; d < dim; ++d)
        start_position[dim * node + d] = place_of_node[node][d];

    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        bool is_edge = false;
        for (const unsigned int f : faces_of_node[node])
          is_edge = is_edge || dot<dim>(face_normal(start_position, f),
                                        face_normal(start_position,
                                                    faces_of_node[node][0])) <
                                 cosine_of_kink;
        is_on_edge.push_back(is_edge);
      }
  }



  template <int dim>
  bool
  ContactSurface<dim>::is_on_block(const unsigned int node,
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
  bool
  ContactSurface<dim>::is_on_joint(const unsigned int node,
                                   const unsigned int joint) const
  {
    return joint != none &&
           std::any_of(faces_of_node[node].begin(),
                       faces_of_node[node].end(),
                       [&](const unsigned int f) {
                         return interface.surface[f].joint == joint;
                       });
  }



  template <int dim>
  bool
  ContactSurface<dim>::may_meet(const unsigned int node,
                                const unsigned int face) const
  {
    const unsigned int block = block_of_node[node];
    const unsigned int other = interface.surface[face].block;
    const auto &corners      = nodes_of_face[face];
    return std::find(corners.begin(), corners.end(), node) == corners.end() &&
           !(is_rigid_block[block] && is_rigid_block[other]) &&
           !(block == other && interface.surface[face].joint == none);
  }



  template <int dim>
  bool
  ContactSurface<dim>::is_slave_block(const unsigned int a,
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
  double
  ContactSurface<dim>::start_distance(const unsigned int node,
                                      const unsigned int face) const
  {
    return project(start_position, at<dim>(start_position, node), face).gap;
  }



  template <int dim>
  double
  ContactSurface<dim>::rounding_of_tip(const unsigned int node,
                                       const unsigned int face) const
  {
    if (interface.surface[face].joint != none)
      return 0.;
    const FaceFoot<dim> start = find_foot<dim>(corners_of(start_position, face),
                                               at<dim>(start_position, node));
    if (std::abs(start.gap) > distance_of_tip * start.size)
      return 0.;
    for (const unsigned int f : faces_of_node[node])
      if (dot<dim>(face_normal(start_position, f), start.normal) <
          -cosine_of_kink)
        return 0.;
    const double volume = std::min(block_volume[block_of_node[node]],
                                   block_volume[interface.surface[face].block]);
    return std::min(radius_of_tips * std::pow(volume, 1. / dim),
                    most_of_face * start.size);
  }



  template <int dim>
  std::array<Vector<dim>, Mesh<dim>::n_face_vertices>
  ContactSurface<dim>::corners_of(const std::vector<double> &position,
                                  const unsigned int face) const
  {
    std::array<Vector<dim>, Mesh<dim>::n_face_vertices> corners;
    for (unsigned int v = 0; v < corners.size(); ++v)
      corners[v] = at<dim>(position, nodes_of_face[face][v]);
    return corners;
  }



  template <int dim>
  Vector<dim>
  ContactSurface<dim>::face_normal(const std::vector<double> &position,
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
  dealii::BoundingBox<dim>
  ContactSurface<dim>::box_of(const std::vector<double> &position,
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
  Projection<dim>
  ContactSurface<dim>::project(const std::vector<double> &position,
                               const Vector<dim> &point,
                               const unsigned int face) const
  {
    Projection<dim> result;
    static_cast<FaceFoot<dim> &>(result) =
      find_foot<dim>(corners_of(position, face), point);
    result.face = face;
    return result;
  }



  template <int dim>
  bool
  ContactSurface<dim>::opposes(const std::vector<double> &position,
                               const unsigned int slave,
                               const Vector<dim> &normal) const
  {
    for (const unsigned int f : faces_of_node[slave])
      if (dot<dim>(face_normal(position, f), normal) < -0.1)
        return true;
    return false;
  }



  template <int dim>
  bool
  ContactSurface<dim>::can_stand_on(const std::vector<double> &position,
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
  bool
  ContactSurface<dim>::can_bear(const std::vector<double> &position,
                                const unsigned int node,
                                const unsigned int face,
                                const Vector<dim> &normal) const
  {
    return opposes(position, node, normal) &&
           (is_on_joint(node, interface.surface[face].joint) ||
            can_stand_on(position, node, normal));
  }



  template class ContactSurface<2>;
  template class ContactSurface<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/surface_places.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Planes with a smaller sine between them count as one; joints of a node
     * with a smaller one: it goes onto the wider joint only. */
    constexpr double least_sine_to_normal = 1e-2, least_sine_of_joints = 0.34;

    /** Free faces with a larger sine between them make an edge. */
    constexpr double least_sine_of_edge = 0.34;

    /** Shifts of vertices onto their joints that count as the mesh's bend, over
     * the size of a face [-]. */
    constexpr double least_bend = 1e-4, farthest_bend = 2.;

    /** Farther along free faces, or along a joint to another one, a vertex
     * does not go; over the size of a face [-]. */
    constexpr double farthest_along = 1.;

    /** A corner of a face that keeps less of its area is flat or turned over
     * [-]. */
    constexpr double least_area = 0.05;

    /** Sweeps after which what is still turned over counts as flat. */
    constexpr unsigned int n_sweeps = 50;

    /** The places of all surface nodes, in the making. */
    template <int dim>
    class Placement
    {
    public:
      Placement(const Mesh<dim> &mesh,
                const Scene<dim> &scene,
                const std::vector<SurfaceFace<dim>> &surface,
                const SurfaceTopology<dim> &topology)
        : mesh(mesh)
        , surface(surface)
        , topology(topology)
      {
        for (const auto &joint : scene.joints)
          planes.emplace_back(*joint);
        find_faces();
        for (unsigned int node = 0; node < n_nodes(); ++node)
          {
            free_normals.push_back(free_normals_of(node));
            place.push_back(on_joints(node));
          }
        for (unsigned int sweep = 0; sweep < n_sweeps && turned_follow();
             ++sweep)
          {}
      }

      SurfacePlaces<dim>
      result() const
      {
        SurfacePlaces<dim> places{place, {}};
        places.is_flat.assign(surface.size(), false);
        for (const unsigned int f : turned_faces())
          places.is_flat[f] = true;
        return places;
      }

    private:
      unsigned int
      n_nodes() const
      {
        return topology.vertex_of_node.size();
      }

      const Point<dim> &
      vertex(const unsigned int node) const
      {
        return mesh.vertices[topology.vertex_of_node[node]];
      }

      /** Copies of a vertex, one in each block, stay together: they are on the
       * faces of all of them. */
      void
      find_faces()
      {
        const auto coordinates = [&](const unsigned int node) {
          std::array<double, dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = vertex(node)[d];
          return x;
        };
        std::map<std::array<double, dim>, std::vector<unsigned int>> at_vertex;
        for (unsigned int node = 0; node < n_nodes(); ++node)
          {
            auto &faces      = at_vertex[coordinates(node)];
            const auto &more = topology.faces_of_node[node];
            faces.insert(faces.end(), more.begin(), more.end());
          }
        for (unsigned int node = 0; node < n_nodes(); ++node)
          faces_of_node.push_back(at_vertex[coordinates(node)]);
      }

      bool
      is_on_joint(const unsigned int node) const
      {
        const auto &faces = faces_of_node[node];
        return std::any_of(faces.begin(), faces.end(), [&](const unsigned f) {
          return surface[f].joint != none;
        });
      }

      /** Unit normals of the free faces at a node that make edges. */
      std::vector<Tensor<1, dim>>
      free_normals_of(const unsigned int node) const
      {
        std::vector<Tensor<1, dim>> normals, ways;
        for (const unsigned int f : faces_of_node[node])
          {
            const SurfaceFace<dim> &face = surface[f];
            if (face.joint != none || ways.size() == dim)
              continue;
            const Tensor<1, dim> area =
              mesh.face_area_vector(face.cell, face.face);
            const Tensor<1, dim> n = without(area / area.norm(), ways);
            if (n.norm() <= least_sine_of_edge)
              continue;
            ways.push_back(n / n.norm());
            normals.push_back(area / area.norm());
          }
        return normals;
      }

      /** Orthonormal vectors that span @p vectors. */
      static std::vector<Tensor<1, dim>>
      orthonormal(const std::vector<Tensor<1, dim>> &vectors)
      {
        std::vector<Tensor<1, dim>> ways;
        for (const Tensor<1, dim> &vector : vectors)
          {
            const Tensor<1, dim> way = without(vector, ways);
            ways.push_back(way / way.norm());
          }
        return ways;
      }

      static Tensor<1, dim>
      without(Tensor<1, dim> vector, const std::vector<Tensor<1, dim>> &ways)
      {
        for (const Tensor<1, dim> &way : ways)
          vector -= (vector * way) * way;
        return vector;
      }

      /** Joints of the faces of a node, wide ones first. */
      std::vector<unsigned int>
      joints_of(const unsigned int node) const
      {
        std::set<unsigned int> found;
        for (const unsigned int f : faces_of_node[node])
          if (surface[f].joint != none)
            found.insert(surface[f].joint);
        std::vector<unsigned int> joints(found.begin(), found.end());
        std::stable_sort(joints.begin(),
                         joints.end(),
                         [&](const unsigned int a, const unsigned int b) {
                           return planes[a].half_width() >
                                  planes[b].half_width();
                         });
        return joints;
      }

      /** Of the faces of a node, the longest [m]. */
      double
      size_at(const unsigned int node) const
      {
        double size = 0.;
        for (const unsigned int f : faces_of_node[node])
          size = std::max(size,
                          mesh.vertices[surface[f].vertices[0]].distance(
                            mesh.vertices[surface[f].vertices[1]]));
        return size;
      }

      /** Shift of @p point onto a joint's plane, across none of the orthonormal
       * @p kept directions; none if they leave less of its normal than
       * @p least. */
      std::optional<Tensor<1, dim>>
      shift_onto(const unsigned int joint,
                 const Point<dim> &point,
                 const std::vector<Tensor<1, dim>> &kept,
                 const double least) const
      {
        const Tensor<1, dim> way = without(planes[joint].normal, kept);
        if (kept.size() == dim || way.norm() < least)
          return {};
        return -planes[joint].distance(point) / way.norm_square() * way;
      }

      /** The directions across which a node is not to move onto the plane of a
       * joint: of as many of its free faces as let it get there, and of those
       * which let it get there soonest. */
      std::vector<Tensor<1, dim>>
      kept_free_ways(const unsigned int node, const unsigned int joint) const
      {
        const std::vector<Tensor<1, dim>> &normals = free_normals[node];
        const double farthest = farthest_along * size_at(node);
        std::vector<Tensor<1, dim>> best;
        unsigned int most = 0;
        double shortest   = std::numeric_limits<double>::max();
        for (unsigned int set = 0; set < 1u << normals.size(); ++set)
          {
            std::vector<Tensor<1, dim>> chosen;
            for (unsigned int i = 0; i < normals.size(); ++i)
              if (set >> i & 1)
                chosen.push_back(normals[i]);
            const std::vector<Tensor<1, dim>> kept = orthonormal(chosen);
            const auto shift =
              shift_onto(joint, vertex(node), kept, least_sine_to_normal);
            if (!shift || kept.size() < most)
              continue;
            const double way = shift->norm();
            if (way > farthest || (kept.size() == most && way >= shortest))
              continue;
            best     = kept;
            most     = kept.size();
            shortest = way;
          }
        return best;
      }

      /** The place of a node on its joints' planes and its free faces. */
      Point<dim>
      on_joints(const unsigned int node) const
      {
        Point<dim> result = vertex(node);
        const double size = size_at(node);
        const auto joints = joints_of(node);
        std::vector<Tensor<1, dim>> kept;
        for (const unsigned int joint : joints)
          {
            const bool is_first = joint == joints.front();
            if (is_first)
              kept = kept_free_ways(node, joint);
            const auto shift = shift_onto(joint,
                                          result,
                                          kept,
                                          is_first ? least_sine_to_normal
                                                   : least_sine_of_joints);
            // planes that meet far away do not meet here
            if (!shift || (!is_first && shift->norm() > farthest_along * size))
              continue;
            kept.push_back(planes[joint].normal);
            kept = orthonormal(kept);
            result += *shift;
          }
        // rounding is no bend
        const double shift = result.distance(vertex(node));
        return shift > least_bend * size && shift < farthest_bend * size
                 ? result
                 : vertex(node);
      }

      /** Area vector of a face at its corner @p v, of its nodes at their
       * vertices or places. */
      template <typename At>
      Tensor<1, dim>
      corner_area(const unsigned int face, const unsigned int v, At &&at) const
      {
        const auto &nodes = topology.nodes_of_face[face];
        if constexpr (dim == 2)
          return at(nodes[1]) - at(nodes[0]);
        else
          // the next corners against and with the right-hand rule differ in
          // one bit each
          return dealii::cross_product_3d(at(nodes[v ^ 1]) - at(nodes[v]),
                                          at(nodes[v ^ 2]) - at(nodes[v]));
      }

      bool
      is_turned(const unsigned int face) const
      {
        const auto at_vertex = [&](const unsigned int n) { return vertex(n); };
        const auto at_place  = [&](const unsigned int n) { return place[n]; };
        for (unsigned int v = 0; v < Mesh<dim>::n_face_vertices; ++v)
          {
            const Tensor<1, dim> before = corner_area(face, v, at_vertex);
            if (before * corner_area(face, v, at_place) <
                least_area * before.norm_square())
              return true;
          }
        return false;
      }

      std::vector<unsigned int>
      turned_faces() const
      {
        std::vector<unsigned int> faces;
        for (unsigned int f = 0; f < surface.size(); ++f)
          if (surface[f].joint == none && is_turned(f))
            faces.push_back(f);
        return faces;
      }

      /** Move the nodes of free faces that are turned over, but for those on
       * joints, as the nodes beside them on the mean. Returns whether any
       * moved. */
      bool
      turned_follow()
      {
        bool has_moved = false;
        for (const unsigned int f : turned_faces())
          for (const unsigned int node : topology.nodes_of_face[f])
            if (!is_on_joint(node))
              {
                const Point<dim> before = place[node];
                place[node]             = vertex(node) + mean_shift(node);
                has_moved               = has_moved || place[node] != before;
              }
        return has_moved;
      }

      /** Of the other nodes of a node's faces, along its free faces. */
      Tensor<1, dim>
      mean_shift(const unsigned int node) const
      {
        Tensor<1, dim> sum;
        unsigned int n_others = 0;
        for (const unsigned int f : faces_of_node[node])
          for (const unsigned int other : topology.nodes_of_face[f])
            if (other != node)
              {
                sum += place[other] - vertex(other);
                ++n_others;
              }
        return without(sum / n_others, orthonormal(free_normals[node]));
      }

      const Mesh<dim> &mesh;
      const std::vector<SurfaceFace<dim>> &surface;
      const SurfaceTopology<dim> &topology;
      std::vector<std::vector<unsigned int>> faces_of_node; ///< of all copies
      std::vector<JointExtent<dim>> planes;
      std::vector<std::vector<Tensor<1, dim>>> free_normals; ///< of each node
      std::vector<Point<dim>> place; ///< of each node [m]
    };
  } // namespace



  template <int dim>
  SurfacePlaces<dim>
  place_in_joint_planes(const Mesh<dim> &mesh,
                        const Scene<dim> &scene,
                        const std::vector<SurfaceFace<dim>> &surface,
                        const SurfaceTopology<dim> &topology)
  {
    return Placement<dim>(mesh, scene, surface, topology).result();
  }

#define INSTANTIATE(dim)                                                       \
  template SurfacePlaces<dim> place_in_joint_planes(                           \
    const Mesh<dim> &,                                                         \
    const Scene<dim> &,                                                        \
    const std::vector<SurfaceFace<dim>> &,                                     \
    const SurfaceTopology<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

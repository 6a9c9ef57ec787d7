// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_measures.h>

#include <keyblock/blocks/face_quadrature.h>
#include <keyblock/blocks/plane_arrangement.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace Keyblock
{
  namespace
  {
    /** Sine between planes below which they count as parallel. */
    constexpr double least_sine = 1e-4;

    /** How far a vertex may be from one more plane, how far it may be moved,
     * and how far a block may lie on both sides of a joint, over the size of a
     * cell there [-]. */
    constexpr double coincident = 1e-7, farthest = 3., across = 1e-6;

    /** The same of a joint that may lie on another, which rules [-]. */
    constexpr double merged = 1e-5;

    /** Ratio of volumes up to which a block is what the planes bound, and what
     * an excavation leaves of that [-]. */
    constexpr double most_like = 3., most_like_rest = 1.5;

    /** How far a corner on a joint may lie beside the face of an outline that
     * the mesh has it on, over the size of the block [-]: what that changes of
     * the volume is less than half its square times the sine between the
     * outline's faces, 1 % at 30 degrees. */
    constexpr double beside_outline = 0.2;

    template <int dim>
    using SurfacesOfFace =
      std::map<typename Mesh<dim>::FaceVertices, std::vector<unsigned int>>;

    template <int dim>
    SurfacesOfFace<dim>
    list_surfaces(const Mesh<dim> &mesh)
    {
      SurfacesOfFace<dim> result;
      for (const auto &face : mesh.marked_faces)
        {
          auto key = face.vertices;
          std::sort(key.begin(), key.end());
          result[key].push_back(face.surface);
        }
      return result;
    }

    /** Where the planes nearest to @p p in the list meet; nothing if they do
     * not all meet there. @p size: of a cell [m]. */
    template <int dim>
    std::optional<Point<dim>>
    intersection(const Point<dim> &p,
                 const std::vector<unsigned int> &list,
                 const Mesh<dim> &mesh,
                 const double size)
    {
      Point<dim> x = p;
      std::vector<Tensor<1, dim>> used;
      for (const unsigned int s : list)
        {
          const Surface<dim> &surface = mesh.surfaces[s];
          if (surface.radius > 0.)
            return {};
          Tensor<1, dim> way = surface.normal;
          for (unsigned int twice = 0; twice < 2; ++twice)
            for (const auto &n : used)
              way -= (way * n) * n;
          if (used.size() == dim || way.norm() < least_sine)
            continue;
          x -= surface.distance(x) / way.norm_square() * way;
          used.push_back(way / way.norm());
        }
      for (const unsigned int s : list)
        if (std::abs(mesh.surfaces[s].distance(x)) > coincident * size)
          return {};
      if (x.distance(p) > farthest * size)
        return {};
      return x;
    }

    /** Area vector of a face, out of its cell, with its corners at @p x. */
    template <int dim>
    Tensor<1, dim>
    outward_area(const std::array<Point<dim>, Mesh<dim>::n_face_vertices> &x,
                 const unsigned int face)
    {
      Tensor<1, dim> area; // by deal.II's order; in 2D to the left
      if constexpr (dim == 2)
        area = -cross_product_2d(x[1] - x[0]);
      else
        area = 0.5 * cross_product_3d(x[3] - x[0], x[2] - x[1]);
      return is_inward<dim>(face) ? -area : area;
    }

    /** The corners at @p x around a face as seen from outside its cell. */
    template <int dim>
    std::vector<Point<dim>>
    polygon_of(const FaceCorners<dim> &x, const bool is_turned)
    {
      std::vector<Point<dim>> polygon(x.begin(), x.end());
      if constexpr (dim == 3)
        std::swap(polygon[2], polygon[3]);
      if (is_turned)
        std::reverse(polygon.begin(), polygon.end());
      return polygon;
    }

    /** Areas on the joints as the mesh has them. */
    template <int dim>
    std::map<unsigned int, double>
    bent_areas(const std::vector<OuterFace> &faces, const Mesh<dim> &mesh)
    {
      std::map<unsigned int, double> areas;
      for (const OuterFace &face : faces)
        if (face.surface != none && mesh.surfaces[face.surface].is_joint())
          areas[mesh.surfaces[face.surface].joint] +=
            mesh.face_area_vector(face.cell, face.face).norm();
      return areas;
    }

    /** Measure a convex block by the planes alone. Joints on which the mesh has
     * no face of it have a bent area of zero. */
    template <int dim>
    void
    measure(Block<dim> &block,
            const ConvexBody<dim> &body,
            const std::vector<OuterFace> &faces,
            const Mesh<dim> &mesh,
            const unsigned int n_joints)
    {
      auto &exact     = block.exact;
      exact.volume    = body.volume();
      exact.centroid  = body.centroid();
      exact.bent_area = bent_areas(faces, mesh);
      for (const auto &[joint, area] : exact.bent_area)
        exact.joint_area[joint] = 0.;
      for (const auto &face : body.get_faces())
        if (face.name < n_joints)
          {
            exact.joint_area[face.name] += body.area(face);
            exact.joint_faces[face.name].push_back(face.corners);
            exact.bent_area.try_emplace(face.name, 0.);
          }
      exact.is_known = exact.volume > 0.;
    }

    /** Measure a block whose faces are those of the mesh, made plane: where the
     * planes do not meet as the mesh has it, or a joint goes on through the
     * block, nothing is known. */
    template <int dim>
    void
    measure(Block<dim> &block,
            const std::vector<OuterFace> &faces,
            const Mesh<dim> &mesh,
            const PlaneArrangement<dim> &planes)
    {
      std::map<unsigned int, std::vector<unsigned int>> surfaces_at;
      for (const OuterFace &face : faces)
        for (const unsigned int v : mesh.face_vertices(face.cell, face.face))
          {
            if (face.surface == none)
              return;
            auto &list = surfaces_at[v];
            if (std::find(list.begin(), list.end(), face.surface) == list.end())
              list.push_back(face.surface);
          }
      const double size   = cell_size(block);
      const double beside = beside_outline * std::pow(block.volume, 1. / dim);
      std::map<unsigned int, Point<dim>> place;
      for (const auto &[v, list] : surfaces_at)
        {
          const auto x = intersection(mesh.vertices[v], list, mesh, size);
          if (!x || !planes.is_on_outlines(*x, list, merged * size, beside))
            return;
          place[v] = *x;
        }
      typename Block<dim>::Measures exact;
      Tensor<1, dim> moment;
      std::vector<std::pair<Point<dim>, Point<dim>>> edges;
      for (const OuterFace &face : faces)
        {
          const auto vertices = mesh.face_vertices(face.cell, face.face);
          std::array<Point<dim>, Mesh<dim>::n_face_vertices> x;
          for (unsigned int i = 0; i < vertices.size(); ++i)
            x[i] = place.at(vertices[i]);
          for (unsigned int i = 0; i < vertices.size(); ++i)
            for (unsigned int d = 1; d < dim; ++d)
              if (i < (i ^ d)) // along edges: in 2D 01, in 3D 01 02 13 23
                edges.emplace_back(x[i], x[i ^ d]);
          const Tensor<1, dim> area = outward_area<dim>(x, face.face);
          exact.volume += area * (x[0] - block.centroid) / dim;
          auto points = gauss_points<dim>(x);
          turn_outward(points, area);
          for (const FacePoint<dim> &point : points)
            for (unsigned int d = 0; d < dim; ++d)
              moment[d] += 0.5 *
                           std::pow(point.place[d] - block.centroid[d], 2) *
                           point.area[d];
          const Surface<dim> &surface = mesh.surfaces[face.surface];
          if (surface.is_joint())
            {
              exact.joint_area[surface.joint] += area * surface.normal;
              exact.joint_faces[surface.joint].push_back(
                polygon_of<dim>(x, is_inward<dim>(face.face)));
            }
        }
      exact.centroid = block.centroid + moment / exact.volume;
      for (auto &[joint, area] : exact.joint_area)
        area = std::abs(area);
      exact.bent_area = bent_areas(faces, mesh);
      exact.is_known =
        exact.volume > 0. && !planes.is_cut(edges, merged * size);
      if (exact.is_known)
        block.exact = exact;
    }

    /** Whether what an excavation leaves of a convex body is one block, and
     * that one. */
    template <int dim>
    bool
    is_rest(const unsigned int b,
            const Blocks<dim> &blocks,
            const ConvexBody<dim> &around,
            const double rest)
    {
      const double ratio = rest / blocks.blocks[b].volume;
      for (unsigned int other = 0; other < blocks.blocks.size(); ++other)
        if (other != b && around.contains(blocks.blocks[other].centroid))
          return false;
      return ratio < most_like_rest && ratio * most_like_rest > 1.;
    }

    /** Measure a block between infinite joints and excavations by what is
     * around it, whatever the mesh has made of its corners. Of faces on joints
     * the areas are known then. */
    template <int dim>
    void
    measure_by_rest(const unsigned int b,
                    Blocks<dim> &blocks,
                    const std::vector<OuterFace> &faces,
                    const Mesh<dim> &mesh,
                    const PlaneArrangement<dim> &planes)
    {
      Block<dim> &block = blocks.blocks[b];
      const auto around = planes.body_of(block, faces, false);
      typename Block<dim>::Measures rest;
      if (around)
        rest = planes.measure_rest(*around);
      if (block.exact.is_known &&
          std::abs(block.exact.volume - rest.volume) <= across * rest.volume)
        return;
      block.exact = typename Block<dim>::Measures();
      if (!around || !is_rest(b, blocks, *around, rest.volume))
        return;
      rest.bent_area = bent_areas(faces, mesh);
      for (const auto &entry : rest.joint_area)
        rest.bent_area.try_emplace(entry.first, 0.);
      for (const auto &entry : rest.bent_area)
        rest.joint_area.try_emplace(entry.first, 0.);
      rest.is_known = true;
      block.exact   = rest;
    }

    /** Of blocks between the same planes, which the mesh has split, none is
     * what the planes bound but the largest; nor is one of another size. */
    template <int dim>
    void
    forget_parts(Blocks<dim> &blocks,
                 const std::vector<std::optional<ConvexBody<dim>>> &bodies)
    {
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (bodies[b])
          {
            Block<dim> &block  = blocks.blocks[b];
            const double ratio = std::max(block.exact.volume / block.volume,
                                          block.volume / block.exact.volume);
            if (ratio > most_like ||
                std::any_of(blocks.blocks.begin(),
                            blocks.blocks.end(),
                            [&](const Block<dim> &other) {
                              return other.volume > block.volume &&
                                     bodies[b]->contains(other.centroid);
                            }))
              block.exact = typename Block<dim>::Measures();
          }
    }
  } // namespace



  template <int dim>
  void
  measure_exactly(Blocks<dim> &blocks,
                  const Mesh<dim> &mesh,
                  const Scene<dim> &scene)
  {
    if (mesh.surfaces.empty())
      return;
    const SurfacesOfFace<dim> surfaces = list_surfaces(mesh);
    std::vector<std::vector<OuterFace>> faces(blocks.blocks.size());
    std::vector<bool> is_plane(blocks.blocks.size(), true);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const unsigned int b = blocks.block_of_cell[c];
        if (b == none || blocks.blocks[b].is_infinite)
          continue;
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const unsigned int other = mesh.neighbor[c][f];
            if (other != none && blocks.block_of_cell[other] == b)
              continue;
            auto key = mesh.face_vertices(c, f);
            std::sort(key.begin(), key.end());
            const auto found = surfaces.find(key);
            if (found == surfaces.end())
              {
                if (other == none && scene.domain.shape != DomainShape::file)
                  faces[b].push_back({c, f, none});
                else
                  is_plane[b] = false;
                continue;
              }
            // of several that share the face the one that rules
            unsigned int surface = found->second.front();
            for (const unsigned int s : found->second)
              if (mesh.surfaces[s].joint == mesh.joint[c][f] &&
                  mesh.joint[c][f] != none)
                surface = s;
            faces[b].push_back({c, f, surface});
          }
      }
    const PlaneArrangement<dim> planes(mesh, scene);
    std::vector<std::optional<ConvexBody<dim>>> bodies(blocks.blocks.size());
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      if (is_plane[b] && !faces[b].empty())
        {
          Block<dim> &block = blocks.blocks[b];
          const double size = cell_size(block);
          if (const auto body = planes.body_of(block, faces[b], true))
            {
              if (!planes.is_in_rock(*body, across * size))
                continue;
              bodies[b].emplace(*body);
              measure(block, *body, faces[b], mesh, scene.joints.size());
              continue;
            }
          measure(block, faces[b], mesh, planes);
          if (!planes.has_finite_joint(faces[b]))
            measure_by_rest(b, blocks, faces[b], mesh, planes);
        }
    forget_parts(blocks, bodies);
  }



  template <int dim>
  double
  weight_per_mass(const Scene<dim> &scene)
  {
    const Gravity<dim> gravity(scene);
    return gravity.is_given() ? gravity.at(Point<dim>(), 0.).norm()
                              : standard_gravity;
  }

  template double weight_per_mass(const Scene<2> &);
  template double weight_per_mass(const Scene<3> &);
  template void measure_exactly(Blocks<2> &, const Mesh<2> &, const Scene<2> &);
  template void measure_exactly(Blocks<3> &, const Mesh<3> &, const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/plane_blocks.h>
#include <keyblock/blocks/solid_parts.h>
#include <keyblock/scene/plane_faces.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** A plane face of a body. */
    struct BodyFace
    {
      Point<3> point;       ///< on it [m]
      Tensor<1, 3> outward; ///< unit normal
      std::vector<TriangleSurface::Triangle> triangles;
    };

    std::vector<BodyFace>
    faces_of(const TriangleSurface &surface)
    {
      std::vector<BodyFace> faces;
      for (const PlaneFace &face : list_faces(surface))
        {
          const auto &vertices = surface.vertices;
          Tensor<1, 3> area;
          for (const auto &t : face.triangles)
            area += cross_product_3d(vertices[t[1]] - vertices[t[0]],
                                     vertices[t[2]] - vertices[t[0]]);
          faces.push_back({vertices[face.triangles.front()[0]],
                           area / area.norm(),
                           face.triangles});
        }
      return faces;
    }

    bool
    is_convex(const Solid &solid, const std::vector<BodyFace> &faces)
    {
      constexpr double rounding = 1e-9;
      const double size         = solid.low.distance(solid.high);
      for (const BodyFace &face : faces)
        for (const Point<3> &p : solid.surface.vertices)
          if (face.outward * (p - face.point) > rounding * size)
            return false;
      return true;
    }

    /** The cells between its faces, in a box around it. */
    PlaneBlocks<3>
    cut_along_faces(const Solid &solid, const std::vector<BodyFace> &faces)
    {
      const double size = solid.low.distance(solid.high);
      PlaneScene<3> scene;
      scene.box = BoundingBox<3>({solid.low, solid.high});
      scene.box.extend(0.1 * size);
      scene.is_truncated.assign(6, true);
      for (const BodyFace &face : faces)
        for (const auto &triangle : face.triangles)
          {
            JointPiece<3> piece;
            piece.shape  = JointPiece<3>::Shape::polygon;
            piece.point  = face.point;
            piece.normal = face.outward;
            for (const unsigned int v : triangle)
              piece.corners.push_back(solid.surface.vertices[v]);
            scene.joints.push_back(piece);
          }
      PlaneBlockOptions options;
      options.bridging = options.narrow = 1e-8 * size;
      options.dust                      = std::pow(1e-6 * size, 3);
      return find_plane_blocks(scene, options);
    }
  } // namespace



  std::vector<std::vector<HalfSpace<3>>>
  convex_parts(const Solid &solid)
  {
    std::vector<std::vector<HalfSpace<3>>> parts;
    const std::vector<BodyFace> faces = faces_of(solid.surface);
    if (is_convex(solid, faces))
      {
        parts.emplace_back();
        for (const BodyFace &face : faces)
          parts.back().push_back({face.point, face.outward});
        return parts;
      }
    const PlaneBlocks<3> found = cut_along_faces(solid, faces);
    double volume              = 0.;
    for (unsigned int c = 0; c < found.cells.n_cells(); ++c)
      {
        if (found.blocks[found.block_of_cell[c]].is_infinite)
          continue;
        const auto measures = found.cells.measures(c);
        if (solid.depth_inside(measures.centroid) < 0.)
          continue;
        volume += measures.volume;
        parts.emplace_back();
        for (const auto &facet : found.cells.cell(c).facets)
          {
            const auto &plane = found.cells.plane(facet.plane);
            parts.back().push_back(
              {found.cells.to_metres(Point<3>(-plane.offset * plane.normal)),
               -double(facet.side) * plane.normal});
          }
      }
    constexpr double closeness = 1e-6;
    const double wanted        = std::abs(solid.surface.volume());
    if (std::abs(volume - wanted) > closeness * wanted)
      parts.clear();
    return parts;
  }
} // namespace Keyblock

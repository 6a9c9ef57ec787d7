// SPDX-License-Identifier: LGPL-2.1-or-later
// Outlines of excavations among the planes of joints.
#include <keyblock/blocks/plane_arrangement.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Cosine of planes that are one, short of 1 by this; the least area over
     * that of the body [-]. */
    constexpr double parallel = 1e-6, least_area = 1e-9;
  } // namespace



  template <int dim>
  auto
  PlaneArrangement<dim>::measure_rest(const ConvexBody<dim> &body) const ->
    typename Block<dim>::Measures
  {
    typename Block<dim>::Measures rest;
    rest.volume           = body.volume();
    Tensor<1, dim> moment = rest.volume * body.centroid();
    for (const auto &face : body.get_faces())
      if (face.name < joints.size())
        rest.joint_area[face.name] += body.area(face);
    const auto is_on = [&body](const auto &part, const auto &face) {
      return std::all_of(
        part.corners.begin(), part.corners.end(), [&](const Point<dim> &p) {
          return std::abs(face.outward * (p - face.corners[0])) <=
                 2. * body.tolerance;
        });
    };
    const auto add = [&](const std::array<Point<dim>, dim + 1> &x) {
      for (const auto &face : body.get_faces())
        if (std::all_of(x.begin(), x.end(), [&face](const Point<dim> &p) {
              return face.outward * (p - face.corners[0]) >= 0.;
            }))
          return;
      ConvexBody<dim> part(x, body.tolerance);
      for (const auto &face : body.get_faces())
        if (!part.is_empty())
          part.cut(face.corners[0], face.outward, face.name);
      const double volume = part.volume();
      if (!(volume > 0.))
        return;
      rest.volume -= volume;
      moment -= volume * part.centroid();
      // (faces of cells may lie on a joint, too)
      for (const auto &face : body.get_faces())
        if (face.name < joints.size())
          for (const auto &own : part.get_faces())
            if (is_on(own, face))
              rest.joint_area[face.name] -= body.area(own);
    };
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.excavation_stage[c] != 0)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const auto v            = mesh.face_vertices(c, f);
            const Point<dim> center = mesh.cell_center(c);
            if constexpr (dim == 2)
              add({{mesh.vertices[v[0]], mesh.vertices[v[1]], center}});
            else
              for (const auto &[i, k] : {std::pair<int, int>(0, 1),
                                         std::pair<int, int>(1, 3),
                                         std::pair<int, int>(3, 2),
                                         std::pair<int, int>(2, 0)})
                add({{mesh.vertices[v[i]],
                      mesh.vertices[v[k]],
                      mesh.face_center(c, f),
                      center}});
          }
    rest.centroid = Point<dim>(moment / rest.volume);
    for (auto &[joint, area] : rest.joint_area)
      if (area < least_area * std::pow(rest.volume, (dim - 1.) / dim))
        area = 0.;
    return rest;
  }



  template <int dim>
  bool
  PlaneArrangement<dim>::is_on_outline(const Point<dim> &point,
                                       const Tensor<1, dim> &normal,
                                       const double tolerance,
                                       const double beside) const
  {
    const auto covers = [&](const OutlineFace &part) {
      const auto &x        = part.corners;
      const std::size_t n  = x.size();
      const Point<dim> mid = std::accumulate(x.begin(), x.end(), Point<dim>());
      if (std::abs(part.normal * normal) < 1. - parallel ||
          std::abs((point - x[0]) * normal) > tolerance)
        return false;
      for (std::size_t i = 0; i < n; ++i)
        {
          // in 2D past an end, in 3D past an edge
          Tensor<1, dim> out;
          if constexpr (dim == 2)
            out = x[i] - x[1 - i];
          else
            {
              out = cross_product_3d(x[(i + 1) % n] - x[i], normal);
              if (out * (mid / double(n) - x[i]) > 0.)
                out = -out;
            }
          if (out * (point - x[i]) > beside * out.norm())
            return false;
        }
      return true;
    };
    return std::any_of(outline.begin(), outline.end(), covers);
  }



  template <int dim>
  bool
  PlaneArrangement<dim>::is_on_outlines(
    const Point<dim> &point,
    const std::vector<unsigned int> &surfaces,
    const double tolerance,
    const double beside) const
  {
    const auto is_joint = [this](const unsigned int s) {
      return mesh.surfaces[s].is_joint();
    };
    return std::none_of(surfaces.begin(), surfaces.end(), is_joint) ||
           std::all_of(surfaces.begin(),
                       surfaces.end(),
                       [&](const unsigned int s) {
                         return is_joint(s) ||
                                is_on_outline(point,
                                              mesh.surfaces[s].normal,
                                              tolerance,
                                              beside);
                       });
  }

  template Block<2>::Measures
  PlaneArrangement<2>::measure_rest(const ConvexBody<2> &) const;
  template bool
  PlaneArrangement<2>::is_on_outlines(const Point<2> &,
                                      const std::vector<unsigned int> &,
                                      const double,
                                      const double) const;
  template Block<3>::Measures
  PlaneArrangement<3>::measure_rest(const ConvexBody<3> &) const;
  template bool
  PlaneArrangement<3>::is_on_outlines(const Point<3> &,
                                      const std::vector<unsigned int> &,
                                      const double,
                                      const double) const;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/face_quadrature.h>
#include <keyblock/step/trial_pressure.h>

#include <map>

namespace Keyblock
{
  template <int dim>
  TrialPressure<dim>::TrialPressure(const SplitMesh<dim> &split,
                                    const Numbering<dim> &numbering)
    : split(split)
    , numbering(numbering)
  {}



  template <int dim>
  void
  TrialPressure<dim>::press_on(const std::vector<CellFace> &faces)
  {
    const Mesh<dim> &mesh = split.mesh;
    std::map<unsigned int, double> sums;
    for (const CellFace &face : faces)
      {
        auto points =
          gauss_points<dim>(face_corners(mesh, face.cell, face.face));
        turn_outward(points, mesh.face_area_vector(face.cell, face.face));
        const auto vertices = mesh.face_vertices(face.cell, face.face);
        for (const FacePoint<dim> &point : points)
          for (unsigned int v = 0; v < vertices.size(); ++v)
            for_each_owned_carrier(split,
                                   numbering,
                                   vertices[v],
                                   [&](const unsigned int node,
                                       const double weight) {
                                     for (unsigned int d = 0; d < dim; ++d)
                                       sums[dim * node + d] += weight *
                                                               point.shape[v] *
                                                               point.area[d];
                                   });
      }
    areas.assign(sums.begin(), sums.end());
  }



  template <int dim>
  void
  TrialPressure<dim>::add_force(std::vector<double> &force) const
  {
    if (value != 0.)
      for (const auto &[dof, area] : areas)
        force[dof] += value * area;
  }

  template class TrialPressure<2>;
  template class TrialPressure<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/blocks/block_resolution.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace Keyblock
{
  namespace
  {
    /** Directions nearer than this count as one [-]. */
    constexpr double same_direction = 1e-3;

    /** What bounds a block. */
    template <int dim>
    struct Hull
    {
      std::vector<Tensor<1, dim>> normals; ///< of its faces, up to the sign
      std::vector<unsigned int> vertices;

      void
      add_normal(const Tensor<1, dim> &normal)
      {
        for (const auto &n : normals)
          if (std::min((n - normal).norm(), (n + normal).norm()) <
              same_direction)
            return;
        normals.push_back(normal);
      }

      double
      width(const Mesh<dim> &mesh) const
      {
        double least = std::numeric_limits<double>::max();
        for (const auto &n : normals)
          {
            double low = std::numeric_limits<double>::max(), high = -low;
            for (const unsigned int v : vertices)
              {
                low  = std::min(low, n * mesh.vertices[v]);
                high = std::max(high, n * mesh.vertices[v]);
              }
            least = std::min(least, high - low);
          }
        return least;
      }
    };
  } // namespace



  template <int dim>
  void
  measure_widths(Blocks<dim> &blocks,
                 const Mesh<dim> &mesh,
                 const Scene<dim> &scene)
  {
    std::vector<Hull<dim>> hulls(blocks.blocks.size());
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
            const unsigned int j = mesh.joint[c][f];
            if (j != none)
              hulls[b].add_normal(scene.joints[j]->normal());
            else
              {
                const Tensor<1, dim> area = mesh.face_area_vector(c, f);
                hulls[b].add_normal(area / area.norm());
              }
            for (const unsigned int v : mesh.face_vertices(c, f))
              hulls[b].vertices.push_back(v);
          }
      }
    for (unsigned int b = 0; b < hulls.size(); ++b)
      {
        auto &vertices = hulls[b].vertices;
        sort_unique(vertices);
        if (!vertices.empty())
          blocks.blocks[b].width = hulls[b].width(mesh);
      }
  }

  template <int dim>
  double
  deviation(const Block<dim> &of_mesh,
            const double volume,
            const std::map<unsigned int, double> &joint_area,
            const Scene<dim> &scene)
  {
    const auto whole = [&scene](const unsigned int j) {
      const Joint<dim> &joint = *scene.joints[j];
      return joint.surface.empty() ? joint.name : joint.surface;
    };
    std::set<std::string> touched;
    for (const auto &entry : of_mesh.joint_area)
      touched.insert(whole(entry.first));
    double all = 0., missing = 0.;
    for (const auto &[joint, area] : joint_area)
      {
        all += area;
        missing += touched.count(whole(joint)) == 0 ? area : 0.;
      }
    return std::max(std::abs(of_mesh.volume / volume - 1.),
                    all > 0. ? missing / all : 0.);
  }

  template double deviation(const Block<2> &,
                            const double,
                            const std::map<unsigned int, double> &,
                            const Scene<2> &);
  template double deviation(const Block<3> &,
                            const double,
                            const std::map<unsigned int, double> &,
                            const Scene<3> &);
  template void measure_widths(Blocks<2> &, const Mesh<2> &, const Scene<2> &);
  template void measure_widths(Blocks<3> &, const Mesh<3> &, const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/mesh/mesh.h>
#include <keyblock/mesh/size_limit.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Positions in [0, 1] of @p n cells whose lengths grow geometrically to
     * @p ratio times the first's. */
    std::vector<double>
    graded_positions(const unsigned int n, const std::string &grading)
    {
      double ratio = 1.;
      if (!grading.empty() && grading != "uniform")
        {
          try
            {
              ratio = std::stod(grading);
            }
          catch (const std::exception &)
            {
              ratio = 0.;
            }
          AssertThrow(ratio > 0.,
                      InputError("The entry 'Mesh/Gradings' contains '" +
                                 grading +
                                 "'; give uniform or a positive ratio."));
        }
      std::vector<double> positions(n + 1);
      if (ratio == 1. || n == 1)
        for (unsigned int i = 0; i <= n; ++i)
          positions[i] = double(i) / n;
      else
        {
          const double growth = std::pow(ratio, 1. / (n - 1));
          for (unsigned int i = 0; i <= n; ++i)
            positions[i] =
              (std::pow(growth, double(i)) - 1.) / (std::pow(growth, n) - 1.);
        }
      for (unsigned int i = 0; i < n; ++i)
        AssertThrow(positions[i] < positions[i + 1],
                    InputError("The entry 'Mesh/Gradings' contains '" +
                               grading +
                               "', which makes cells of no length; "
                               "give a ratio nearer to 1."));
      return positions;
    }

    /** Refuse what does not fit into memory before it is made. */
    template <int dim>
    void
    require_structured_size(const Scene<dim> &scene)
    {
      double n_cells = 1.;
      for (const unsigned int n : scene.meshing.cells)
        n_cells *= n;
      require_size<dim>(n_cells,
                        scene.joints.size(),
                        "'Mesh/Cells'",
                        [](const double times) {
                          std::ostringstream text;
                          text << std::setprecision(2) << "divide them by "
                               << std::pow(times, 1. / dim) << " each";
                          return text.str();
                        });
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  make_structured_mesh(const Scene<dim> &scene)
  {
    require_structured_size(scene);
    const Domain<dim> &domain = scene.domain;
    std::array<Tensor<1, dim>, dim> edges;
    std::array<std::vector<double>, dim> positions;
    std::array<unsigned int, 3> n = {{1, 1, 0}};
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (domain.shape == DomainShape::box)
          edges[d][d] = domain.size[d];
        else
          edges[d] = domain.edges[d];
        n[d]         = scene.meshing.cells[d];
        positions[d] = graded_positions(n[d],
                                        scene.meshing.gradings.empty()
                                          ? "uniform"
                                          : scene.meshing.gradings[d]);
      }
    if (dim == 2)
      n[2] = 0;

    Mesh<dim> mesh;
    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          {
            const std::array<unsigned int, 3> index = {{i, j, k}};
            Point<dim> p                            = domain.corner;
            for (unsigned int d = 0; d < dim; ++d)
              p += positions[d][index[d]] * edges[d];
            mesh.vertices.push_back(p);
          }
    const auto vertex = [&n](unsigned int i, unsigned int j, unsigned int k) {
      return (k * (n[1] + 1) + j) * (n[0] + 1) + i;
    };
    for (unsigned int k = 0; k < std::max(n[2], 1u); ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            typename Mesh<dim>::CellVertices cell;
            for (unsigned int v = 0; v < cell.size(); ++v)
              cell[v] = vertex(i + (v & 1), j + ((v >> 1) & 1), k + (v >> 2));
            mesh.cells.push_back(cell);
          }
    mesh.region.assign(mesh.cells.size(), 0);
    return mesh;
  }

  template Mesh<2> make_structured_mesh(const Scene<2> &);
  template Mesh<3> make_structured_mesh(const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Unit fields of stress on the model, at the measured points.
#include <keyblock/geostress/geostress.h>
#include <keyblock/geostress/measurements.h>

#include <deal.II/lac/full_matrix.h>

#include <deal.II/numerics/rtree.h>

#include <keyblock/scene/gravity.h>
#include <keyblock/step/equilibrium.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Means of the cells near a point, and their centres. */
    template <int dim>
    class PointSampler
    {
    public:
      explicit PointSampler(const Mesh<dim> &mesh)
        : mesh(mesh)
      {
        std::vector<std::pair<Point<dim>, unsigned int>> centers;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          centers.emplace_back(mesh.cell_center(c), c);
        tree = dealii::pack_rtree(centers);
      }

      /** Weights of the cell means that make the value at @p place: least
       * squares of a linear function over the nearest cells. */
      std::map<unsigned int, double>
      weights_at(const Point<dim> &place) const
      {
        namespace bgi               = boost::geometry::index;
        constexpr unsigned int near = dim == 2 ? 9 : 27;
        std::vector<unsigned int> nearest;
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::nearest(place, near)))
          nearest.push_back(hit.second);
        dealii::FullMatrix<double> normal(dim + 1, dim + 1);
        std::vector<std::array<double, dim + 1>> rows;
        const double size =
          std::pow(mesh.cell_volume(nearest.front()), 1. / dim);
        for (const unsigned int c : nearest)
          {
            std::array<double, dim + 1> row;
            row[0] = 1.;
            for (unsigned int d = 0; d < dim; ++d)
              row[d + 1] = (mesh.cell_center(c)[d] - place[d]) / size;
            rows.push_back(row);
            for (unsigned int i = 0; i <= dim; ++i)
              for (unsigned int j = 0; j <= dim; ++j)
                normal(i, j) += row[i] * row[j];
          }
        // a layer of cells has no slope across it
        for (unsigned int i = 0; i <= dim; ++i)
          normal(i, i) += 1e-13 * nearest.size();
        normal.gauss_jordan();
        std::map<unsigned int, double> weights;
        for (unsigned int i = 0; i < nearest.size(); ++i)
          for (unsigned int j = 0; j <= dim; ++j)
            weights[nearest[i]] += normal(0, j) * rows[i][j];
        return weights;
      }

      bool
      is_inside(const Point<dim> &place) const
      {
        namespace bgi = boost::geometry::index;
        double least = 1e300, size = 1.;
        for (const auto &hit :
             tree | bgi::adaptors::queried(bgi::nearest(place, 1)))
          {
            least = place.distance(hit.first);
            size  = std::pow(mesh.cell_volume(hit.second), 1. / dim);
            for (const unsigned int v : mesh.cells[hit.second])
              size = std::max(size, mesh.vertices[v].distance(hit.first));
          }
        return least <= size;
      }

    private:
      const Mesh<dim> &mesh;
      dealii::RTree<std::pair<Point<dim>, unsigned int>> tree;
    };



    /** The unit fields: supports of the outer boundary and what moves them. */
    template <int dim>
    class UnitFields
    {
    public:
      UnitFields(const Scene<dim> &scene,
                 const SplitMesh<dim> &split,
                 const Numbering<dim> &numbering,
                 const CellArrays<dim> &cells,
                 const Fields<dim> &fields)
        : scene(scene)
        , split(split)
        , numbering(numbering)
        , cells(cells)
        , fields(fields)
        , rollers(hold_boundary(true))
        , clamps(hold_boundary(false))
      {}

      /** Stresses of all cells [Pa]. */
      StressArray<dim>
      solve(const std::string &name)
      {
        const bool is_gravity = name == "gravity";
        auto &solver          = is_gravity ? roller_solver : clamp_solver;
        if (!solver)
          solver =
            std::make_unique<StaticSolver<dim>>(split,
                                                numbering,
                                                cells,
                                                fields,
                                                is_gravity ? rollers : clamps,
                                                ForceElements<dim>());
        std::vector<double> force(fields.load.size(), 0.);
        if (is_gravity)
          {
            const Tensor<1, dim> g = Gravity<dim>(scene).at(Point<dim>(), 0.);
            for (unsigned int i = 0; i < dim * numbering.n_owned(); ++i)
              force[i] = fields.weighing_mass[i / dim] * g[i % dim];
          }
        const std::vector<double> displacement =
          solver->solve(force, [&](const NodeSupport<dim> &support) {
            Point<dim> place;
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = fields.reference[dim * support.node + d];
            return is_gravity ? Tensor<1, dim>()
                              : boundary_displacement(name, place);
          });
        CellArrays<dim> unit = cells;
        unit.stress.reinit(unit.nodes.size());
        for (MohrCoulomb &strength : unit.strengths)
          strength.peak.uniaxial       = strength.peak.tension =
            strength.residual.uniaxial = strength.residual.tension = 1e100;
        ForcePass pass;
        pass.step = 1.;
        std::vector<double> internal(force.size(), 0.);
        add_internal_force<dim>(pass,
                                unit,
                                fields.reference.data(),
                                displacement.data(),
                                internal.data(),
                                nullptr);
        return unit.stress;
      }

    private:
      std::vector<NodeSupport<dim>>
      hold_boundary(const bool as_rollers) const
      {
        const Mesh<dim> &mesh = split.mesh;
        std::map<unsigned int, NodeSupport<dim>> held;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              if (mesh.neighbor[c][f] != none || mesh.joint[c][f] != none ||
                  mesh.boundary[c][f] == none || mesh.is_on(c, f, "top"))
                continue;
              const Tensor<1, dim> normal = mesh.face_area_vector(c, f);
              unsigned int axis           = 0;
              for (unsigned int d = 0; d < dim; ++d)
                axis = std::abs(normal[d]) > std::abs(normal[axis]) ? d : axis;
              for (const unsigned int v : mesh.face_vertices(c, f))
                {
                  const unsigned int node = numbering.local_node(v);
                  if (node == none || split.is_hanging(v))
                    continue;
                  NodeSupport<dim> &support = held[node];
                  support.node              = node;
                  for (unsigned int d = 0; d < dim; ++d)
                    if (!as_rollers || d == axis)
                      add_axis(support, d);
                }
            }
        std::vector<NodeSupport<dim>> list;
        list.reserve(held.size());
        for (const auto &[node, support] : held)
          list.push_back(support);
        return list;
      }

      static void
      add_axis(NodeSupport<dim> &support, const unsigned int axis)
      {
        for (unsigned int k = 0; k < support.n_directions; ++k)
          if (support.directions[k][axis] != 0.)
            return;
        support.directions[support.n_directions++][axis] = 1.;
      }

      /** Displacement of a homogeneous body under a unit field, zero strain
       * along the other horizontal axis, free top. */
      Tensor<1, dim>
      boundary_displacement(const std::string &name,
                            const Point<dim> &place) const
      {
        const Material<dim> &rock = *scene.materials.front();
        const double nu = rock.poisson_ratio, E = rock.young_modulus;
        const double along = (1. - nu * nu) / E, up = -nu * (1. + nu) / E;
        const double height =
          place[dim - 1] - scene.initial_state.surface_elevation;
        Tensor<1, dim> u;
        if (name == "shear xy")
          {
            u[0] = place[1] / (2. * rock.shear_modulus());
            u[1] = place[0] / (2. * rock.shear_modulus());
            return u;
          }
        const unsigned int d = name.back() == 'x' ? 0 : 1;
        if (name.rfind("push", 0) == 0)
          {
            u[d]       = -along * place[d];
            u[dim - 1] = -up * height;
          }
        else
          {
            // stress = height, at depth -height: compression of depth
            u[d] = along * place[d] * height;
            u[dim - 1] =
              0.5 * up * height * height - 0.5 * along * place[d] * place[d];
          }
        return u;
      }

      const Scene<dim> &scene;
      const SplitMesh<dim> &split;
      const Numbering<dim> &numbering;
      const CellArrays<dim> &cells;
      const Fields<dim> &fields;
      const std::vector<NodeSupport<dim>> rollers, clamps;
      std::unique_ptr<StaticSolver<dim>> roller_solver, clamp_solver;
    };
  } // namespace



  template <int dim>
  std::unique_ptr<Geostress>
  invert_measured_stress(const Scene<dim> &scene,
                         const SplitMesh<dim> &split,
                         const Numbering<dim> &numbering,
                         CellArrays<dim> &cells,
                         Fields<dim> &fields)
  {
    const std::vector<Measurement<dim>> measurements = read_measurements(scene);
    auto result   = std::make_unique<Geostress>();
    result->names = scene.initial_state.stress_fields;
    const PointSampler<dim> sampler(split.mesh);
    std::vector<std::map<unsigned int, double>> samples;
    std::vector<double> weights;
    for (const Measurement<dim> &m : measurements)
      {
        AssertThrow(sampler.is_inside(m.place),
                    InputError("The measured point (" + m.text +
                               ") is outside the model; extend the model, or "
                               "take the point out of '" +
                               scene.initial_state.measured_points + "'."));
        samples.push_back(sampler.weights_at(m.place));
        weights.push_back(m.weight);
        result->measured.push_back(m.value);
        result->measurements.push_back(m.text);
      }

    UnitFields<dim> unit_fields(scene, split, numbering, cells, fields);
    std::vector<StressArray<dim>> stresses;
    std::vector<std::vector<double>> matrix(
      measurements.size(), std::vector<double>(result->names.size(), 0.));
    std::map<unsigned int, unsigned int> local_cell;
    for (unsigned int c = 0; c < cells.mesh_cell.size(); ++c)
      local_cell[cells.mesh_cell[c]] = c;
    constexpr unsigned int n = 1 << dim;
    for (unsigned int j = 0; j < result->names.size(); ++j)
      {
        stresses.push_back(unit_fields.solve(result->names[j]));
        std::vector<double> values(measurements.size(), 0.);
        for (unsigned int i = 0; i < measurements.size(); ++i)
          for (const auto &[mesh_cell, weight] : samples[i])
            if (const auto found = local_cell.find(mesh_cell);
                found != local_cell.end())
              for (unsigned int q = 0; q < n; ++q)
                values[i] +=
                  weight / n *
                  cells.stress_at(found->second,
                                  q,
                                  stresses[j])[measurements[i].component];
        numbering.communicator.sum_lists(values);
        for (unsigned int i = 0; i < measurements.size(); ++i)
          matrix[i][j] = values[i];
      }
    result->fit = fit_fields(matrix, result->measured, weights, result->names);
    for (unsigned int k = 0; k < cells.stress.values.size(); ++k)
      {
        cells.stress.values[k] = 0.;
        for (unsigned int j = 0; j < stresses.size(); ++j)
          cells.stress.values[k] +=
            result->fit.coefficients[j] * stresses[j].values[k];
      }
    return result;
  }

  template std::unique_ptr<Geostress>
  invert_measured_stress(const Scene<2> &,
                         const SplitMesh<2> &,
                         const Numbering<2> &,
                         CellArrays<2> &,
                         Fields<2> &);
  template std::unique_ptr<Geostress>
  invert_measured_stress(const Scene<3> &,
                         const SplitMesh<3> &,
                         const Numbering<3> &,
                         CellArrays<3> &,
                         Fields<3> &);
} // namespace Keyblock

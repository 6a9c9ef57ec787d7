// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/expression.h>
#include <keyblock/step/roller_shear.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Shear that is not warned of [Pa], and over the normal stress [-]. */
    constexpr double little_shear = 1e3, relative_shear = 0.01;

    /** Mean stress of a cell [Pa]. */
    template <int dim>
    Tensor<2, dim>
    mean_stress(const CellArrays<dim> &cells, const unsigned int c)
    {
      Tensor<2, dim> mean;
      for (unsigned int q = 0; q < (1u << dim); ++q)
        {
          const auto s = cells.stress_at(c, q);
          for (unsigned int d = 0; d < dim; ++d)
            mean[d][d] += s[d];
          if constexpr (dim == 2)
            mean[0][1] += s[3];
          else
            {
              mean[1][2] += s[3];
              mean[0][2] += s[4];
              mean[0][1] += s[5];
            }
        }
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < d; ++e)
          mean[d][e] = mean[e][d];
      return mean / (1u << dim);
    }

    /** Where supports or tractions are, by their boundaries or regions. */
    template <int dim, typename Item>
    class Places
    {
    public:
      Places(const std::vector<std::unique_ptr<Item>> &items,
             const Mesh<dim> &mesh)
        : items(items)
        , mesh(mesh)
      {
        for (const auto &item : items)
          inside.push_back(
            item->region.empty()
              ? nullptr
              : std::make_unique<Expression<dim>>(item->region, 1, "Region"));
      }

      bool
      has(const unsigned int i,
          const unsigned int cell,
          const unsigned int face) const
      {
        for (const std::string &name : items[i]->boundaries)
          if (mesh.is_on(cell, face, name))
            return true;
        return inside[i] &&
               inside[i]->value(mesh.face_center(cell, face), 0., 0) > 0.;
      }

    private:
      const std::vector<std::unique_ptr<Item>> &items;
      const Mesh<dim> &mesh;
      std::vector<std::unique_ptr<Expression<dim>>> inside;
    };

    /** Forces of the initial stress on what a roller holds [N]. */
    struct FaceForces
    {
      double area = 0., normal = 0., shear = 0.;
    };

    /** Whether a support holds the normal of its boundaries only. */
    template <int dim>
    bool
    is_roller(const Support<dim> &support)
    {
      return support.kind == SupportKind::held &&
             support.directions == SupportDirections::normal;
    }

    template <int dim>
    class RollerForces
    {
    public:
      RollerForces(const Scene<dim> &scene,
                   const SplitMesh<dim> &split,
                   const CellArrays<dim> &cells)
        : scene(scene)
        , mesh(split.mesh)
        , supports(scene.supports, mesh)
        , tractions(scene.tractions, mesh)
        , forces(scene.supports.size())
      {
        for (unsigned int c = 0; c < cells.nodes.size(); ++c)
          {
            const unsigned int cell = cells.mesh_cell[c];
            if (mesh.excavation_stage[cell] == 1)
              continue;
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              if (mesh.neighbor[cell][f] == none)
                for (unsigned int s = 0; s < forces.size(); ++s)
                  if (is_roller(*scene.supports[s]) &&
                      supports.has(s, cell, f) && !is_loaded(cell, f))
                    add(forces[s], cell, f, mean_stress(cells, c));
          }
      }

      /** Of the cells of this rank, by supports. */
      const std::vector<FaceForces> &
      by_support() const
      {
        return forces;
      }

    private:
      /** Whether a traction is on the face from the start. */
      bool
      is_loaded(const unsigned int cell, const unsigned int f) const
      {
        for (unsigned int t = 0; t < scene.tractions.size(); ++t)
          if (scene.tractions[t]->stage == "start" && tractions.has(t, cell, f))
            return true;
        return false;
      }

      void
      add(FaceForces &sum,
          const unsigned int cell,
          const unsigned int f,
          const Tensor<2, dim> &stress) const
      {
        const Tensor<1, dim> area = mesh.face_area_vector(cell, f);
        const Tensor<1, dim> n    = area / area.norm();
        const Tensor<1, dim> load = stress * area;
        Tensor<1, dim> shear      = load - (load * n) * n;
        for (unsigned int s = 0; s < forces.size(); ++s)
          {
            const Support<dim> &support = *scene.supports[s];
            if (is_roller(support) || !supports.has(s, cell, f))
              continue;
            for (unsigned int d = 0; d < dim; ++d)
              if (support.kind != SupportKind::held ||
                  support.directions == SupportDirections::all ||
                  support.names_axis(d))
                shear[d] = 0.;
          }
        sum.area += area.norm();
        sum.normal += std::abs(load * n);
        sum.shear += shear.norm();
      }

      const Scene<dim> &scene;
      const Mesh<dim> &mesh;
      const Places<dim, Support<dim>> supports;
      const Places<dim, Traction<dim>> tractions;
      std::vector<FaceForces> forces;
    };
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_rollers(const Communicator &communicator,
                      const Scene<dim> &scene,
                      const SplitMesh<dim> &split,
                      const CellArrays<dim> &cells)
  {
    std::vector<std::string> warnings;
    if (std::none_of(scene.supports.begin(),
                     scene.supports.end(),
                     [](const auto &support) { return is_roller(*support); }))
      return warnings;
    const RollerForces<dim> found(scene, split, cells);
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      {
        const FaceForces &own = found.by_support()[s];
        const double area     = communicator.sum(own.area);
        const double normal   = communicator.sum(own.normal);
        const double shear    = communicator.sum(own.shear);
        if (!(shear > std::max(relative_shear * normal, little_shear * area)))
          continue;
        const std::string &name = scene.supports[s]->name;
        std::ostringstream text;
        text << "The initial stress has a mean shear of "
             << std::setprecision(3) << shear / area
             << " Pa along the boundaries of the support '" << name
             << "' (normal stress " << normal / area
             << " Pa), which has 'Directions' normal and cannot bear it, so "
                "that it leaves the rock before anything is dug; set 'Supports/"
             << name
             << "/Directions' to all, or to axes that hold the shear as well.";
        warnings.push_back(text.str());
      }
    return warnings;
  }

  template std::vector<std::string> warnings_of_rollers(const Communicator &,
                                                        const Scene<2> &,
                                                        const SplitMesh<2> &,
                                                        const CellArrays<2> &);
  template std::vector<std::string> warnings_of_rollers(const Communicator &,
                                                        const Scene<3> &,
                                                        const SplitMesh<3> &,
                                                        const CellArrays<3> &);
} // namespace Keyblock

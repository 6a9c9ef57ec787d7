// SPDX-License-Identifier: LGPL-2.1-or-later
// What acts on a block: weight, water, tractions and seismic loads.
#include <keyblock/base/expression.h>
#include <keyblock/safety/block_loads.h>
#include <keyblock/scene/gravity.h>

namespace Keyblock
{
  template <int dim>
  Tensor<1, dim>
  sum_of(const std::vector<PointForce<dim>> &forces)
  {
    Tensor<1, dim> sum;
    for (const PointForce<dim> &force : forces)
      sum += force.force;
    return sum;
  }



  template <int dim>
  std::vector<PointForce<dim>>
  BlockLoads<dim>::all() const
  {
    std::vector<PointForce<dim>> list = {{centroid, weight + seismic}};
    list.insert(list.end(), tractions.begin(), tractions.end());
    list.insert(list.end(), water.begin(), water.end());
    return list;
  }



  namespace
  {
    /** Present mass over that of the materials of the start [-]. */
    template <int dim>
    double
    mass_ratio(const Ground<dim> &ground,
               const std::vector<unsigned int> &cells)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      if (mesh.later_materials.empty())
        return 1.;
      double now = 0., first = 0.;
      for (const unsigned int c : cells)
        {
          const auto &materials = ground.scene.materials;
          const double volume   = mesh.cell_volume(c);
          now += volume * materials[ground.material_of(c)]->density;
          first += volume * materials[mesh.material[c]]->density;
        }
      return now / first;
    }
  } // namespace



  template <int dim>
  BlockLoads<dim>
  body_forces_on(const Ground<dim> &ground,
                 const FreeFaces<dim> &free,
                 const Block<dim> &block,
                 const double time)
  {
    const double mass =
      block.best_mass() * mass_ratio(ground, free.cells_of_block(block.id - 1));
    BlockLoads<dim> loads;
    loads.centroid =
      block.exact.is_known ? block.exact.centroid : block.centroid;
    loads.weight  = mass * Gravity<dim>(ground.scene).at(Point<dim>(), time);
    loads.seismic = mass * seismic_acceleration_with_safety(ground);
    return loads;
  }



  template <int dim>
  std::vector<PointForce<dim>>
  tractions_on(const Ground<dim> &ground,
               const FreeFaces<dim> &free,
               const unsigned int block,
               const double time)
  {
    std::vector<CellFace> own;
    for (const unsigned int i : free.of_block(block))
      own.push_back(free.faces[i]);
    std::vector<PointForce<dim>> forces;
    for (const auto &traction : ground.scene.tractions)
      {
        const Expression<dim> formula(traction->expression,
                                      dim,
                                      "Tractions/*/Traction");
        const auto value_at = [&formula, time](const Point<dim> &place) {
          return formula.vector(place, time);
        };
        const LoadedRegion<dim> region(*traction);
        for (const LoadedFace &f : list_loaded_faces(ground, own, *traction))
          {
            const Point<dim> center =
              ground.split.mesh.face_center(f.cell, f.face);
            const auto acting_at = [&](const Point<dim> &place) {
              return f.is_whole || region.has(center, place) ? value_at(place)
                                                             : Tensor<1, dim>();
            };
            for (const FacePoint<dim> &point : adapted_points<dim>(
                   face_corners(ground.split.mesh, f.cell, f.face), acting_at))
              forces.push_back(
                {point.place, point.area.norm() * acting_at(point.place)});
          }
      }
    return forces;
  }



  template <int dim>
  std::vector<PointForce<dim>>
  pressure_on(const FaceCorners<dim> &face,
              const Expression<dim> &pressure,
              const double time,
              const Tensor<1, dim> &inward)
  {
    const auto value_at = [&pressure, time](const Point<dim> &place) {
      return pressure.value(place, time, 0);
    };
    std::vector<PointForce<dim>> forces;
    for (const FacePoint<dim> &point : adapted_points<dim>(face, value_at))
      forces.push_back(
        {point.place, value_at(point.place) * point.area.norm() * inward});
    return forces;
  }

#define INSTANTIATE(dim)                                                       \
  template struct BlockLoads<dim>;                                             \
  template Tensor<1, dim> sum_of(const std::vector<PointForce<dim>> &);        \
  template BlockLoads<dim> body_forces_on(const Ground<dim> &,                 \
                                          const FreeFaces<dim> &,              \
                                          const Block<dim> &,                  \
                                          const double);                       \
  template std::vector<PointForce<dim>> tractions_on(const Ground<dim> &,      \
                                                     const FreeFaces<dim> &,   \
                                                     const unsigned int,       \
                                                     const double);            \
  template std::vector<PointForce<dim>> pressure_on(const FaceCorners<dim> &,  \
                                                    const Expression<dim> &,   \
                                                    const double,              \
                                                    const Tensor<1, dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

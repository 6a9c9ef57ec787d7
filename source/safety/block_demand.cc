// SPDX-License-Identifier: LGPL-2.1-or-later
// How a block moves with its support, and what support it needs.
#include <keyblock/safety/block_statics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Halvings by which a demand is found, and least and greatest demand over
     * the load that is looked at. */
    constexpr unsigned int n_halvings = 60;
    constexpr double least_demand = 1e-3, most_demand = 1e4;

    /** What one more bolt of a set bears [N]: those that the block has, in the
     * mean, or else all of the set; 0: none crosses a joint. */
    template <int dim>
    double
    capacity_for(const Ground<dim> &ground,
                 const BlockSupport<dim> &support,
                 const unsigned int set)
    {
      double sum     = 0.;
      unsigned int n = 0;
      for (const auto &pull : support.pulls)
        if (pull.set == set)
          {
            sum += pull.force;
            ++n;
          }
      return n > 0 ? sum / n : mean_bolt_capacity(ground, set);
    }
  } // namespace



  template <int dim>
  SupportedMotion<dim>
  find_motion(BlockSurroundings<dim> &around,
              const BlockSupport<dim> &support,
              const bool is_passive,
              const std::vector<PointForce<dim>> &free_faces,
              const double pressure)
  {
    std::vector<PointForce<dim>> forces = around.loads.all();
    for (const auto &pull : support.pulls)
      forces.push_back({pull.place, pull.force * pull.along});
    if (support.shotcrete_load.norm() > 0.)
      forces.push_back({support.shotcrete_center, support.shotcrete_load});
    BlockSupport<dim> all = support;
    if (pressure > 0.)
      {
        for (const PointForce<dim> &face : free_faces)
          forces.push_back({face.place, -pressure * face.force});
        const Tensor<1, dim> pushed = -pressure * sum_of(free_faces);
        all.pulls.emplace_back();
        all.pulls.back().along = pushed / pushed.norm();
        all.pulls.back().force = pushed.norm();
      }
    SupportedMotion<dim> motion;
    motion.limit = solve_with_support<dim>(around.faces,
                                           around.loads.without_water(),
                                           all,
                                           is_passive);
    motion.limit.orient(around.loads.weight);
    motion.factor_of_sliding = motion.limit.factor;
    // in 3D it changes nothing, see judge_rotation()
    if (dim == 2 || pressure == 0.)
      motion.rotation = judge_rotation<dim>(around.faces, forces, motion.limit);
    return motion;
  }



  template <int dim>
  SupportDemand
  find_demand(const Ground<dim> &ground,
              const FreeFaces<dim> &free,
              const unsigned int block,
              const BlockSurroundings<dim> &around,
              const BlockSupport<dim> &support,
              const double factor)
  {
    using Mode            = typename LimitEquilibrium<dim>::Mode;
    const Mesh<dim> &mesh = ground.split.mesh;
    std::vector<PointForce<dim>> free_faces;
    for (const unsigned int i : free.of_block(block))
      {
        const CellFace &f = free.faces[i];
        free_faces.push_back(
          {mesh.face_center(f.cell, f.face),
           around.free_area_ratio * mesh.face_area_vector(f.cell, f.face)});
      }
    const double area = sum_of(free_faces).norm();
    SupportDemand demand;
    demand.factor = factor;
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    const auto limit_with = [&](const double force) {
      BlockSurroundings<dim> own = around;
      return find_motion(own,
                         support,
                         is_passive,
                         free_faces,
                         force > 0. ? force / area : 0.)
        .limit;
    };
    const LimitEquilibrium<dim> bare = limit_with(0.);
    if (bare.factor >= factor)
      return demand;
    demand.force = demand.pressure = std::numeric_limits<double>::infinity();
    if (area == 0.)
      return demand;
    const auto is_enough = [&](const double force) {
      const LimitEquilibrium<dim> limit = limit_with(force);
      // so much that it lifts the block is none
      return limit.factor >= factor &&
             (limit.mode != Mode::lifting || bare.mode == Mode::lifting);
    };
    const Tensor<1, dim> load = around.loads.without_water();
    Tensor<1, dim> resultant  = load;
    for (const BlockFace<dim> &face : around.faces)
      resultant += face.water_force * face.inward;
    const double most = most_demand * std::max(load.norm(), resultant.norm());
    // the least force that does: more may push the block elsewhere
    double low = 0., high = 0.;
    for (double force = least_demand * resultant.norm(); force < most;
         force *= 1.1)
      {
        if (is_enough(force))
          {
            high = force;
            break;
          }
        low = force;
      }
    if (high == 0.)
      return demand;
    for (unsigned int i = 0; i < n_halvings; ++i)
      {
        const double middle              = 0.5 * (low + high);
        (is_enough(middle) ? high : low) = middle;
      }
    demand.force    = high;
    demand.pressure = high / area;
    for (unsigned int set = 0; set < ground.scene.bolts.size(); ++set)
      if (const double capacity = capacity_for(ground, support, set);
          capacity > 0.)
        demand.numbers.emplace_back(ground.scene.bolts[set]->name,
                                    static_cast<unsigned int>(
                                      std::ceil(high / capacity - 1e-9)));
    return demand;
  }

#define INSTANTIATE(dim)                                                       \
  template SupportedMotion<dim> find_motion(                                   \
    BlockSurroundings<dim> &,                                                  \
    const BlockSupport<dim> &,                                                 \
    const bool,                                                                \
    const std::vector<PointForce<dim>> &,                                      \
    const double);                                                             \
  template SupportDemand find_demand(const Ground<dim> &,                      \
                                     const FreeFaces<dim> &,                   \
                                     const unsigned int,                       \
                                     const BlockSurroundings<dim> &,           \
                                     const BlockSupport<dim> &,                \
                                     const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

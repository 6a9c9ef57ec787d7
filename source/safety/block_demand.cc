// SPDX-License-Identifier: LGPL-2.1-or-later
// How a block moves with its support, and what support it needs.
#include <keyblock/blocks/nodal_areas.h>
#include <keyblock/safety/block_moments.h>
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/least_support.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Force for balanced moments over that against sliding or the weight, at
     * most. */
    constexpr double most_moment = 10.;

    /** Factor up to which moments are looked at [-]. */
    constexpr double most_factor = 1e3;

    /** Bolts of a set that @p support has. */
    template <int dim>
    unsigned int
    n_bolts_of(const BlockSupport<dim> &support, const unsigned int set)
    {
      return std::count_if(support.pulls.begin(),
                           support.pulls.end(),
                           [set](const auto &pull) { return pull.set == set; });
    }

    /** @p support with @p n more bolts of a set, as those that it has of it: in
     * their directions, and each as strong as these in the mean. */
    template <int dim>
    BlockSupport<dim>
    with_more_bolts(const BlockSupport<dim> &support,
                    const unsigned int set,
                    const unsigned int n)
    {
      BlockSupport<dim> more = support;
      more.add_bolts(set, double(n) / n_bolts_of(support, set));
      return more;
    }

    /** Whether a free face is not one of the domain's, but left by digging. A
     * domain from a file has its sides alone, those of its bounding box. */
    template <int dim>
    bool
    is_dug(const Ground<dim> &ground, const CellFace &f)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      // cells that are gone from the start are none of the mesh
      if (mesh.neighbor[f.cell][f.face] != none)
        return true;
      const bool has_numbered_sides =
        ground.scene.domain.shape == DomainShape::polygon;
      return mesh.boundary[f.cell][f.face] == none &&
             !(has_numbered_sides && mesh.boundary_id[f.cell][f.face] != none);
    }

    /** Bolts of a set that give @p force [N] together, each the mean capacity
     * of the set; 0: none do, or it has none. */
    template <int dim>
    unsigned int
    number_of_new_bolts(const Ground<dim> &ground,
                        const unsigned int set,
                        const double force)
    {
      const double capacity = mean_bolt_capacity(ground, set);
      return capacity > 0. && std::isfinite(force)
               ? static_cast<unsigned int>(std::ceil(force / capacity - 1e-9))
               : 0;
    }

    /** Sum of areas over their sizes that is none [-]. */
    constexpr double no_area = 1e-6;
  } // namespace



  template <int dim>
  std::vector<CellFace>
  list_supported_faces(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const unsigned int block,
                       const Tensor<1, dim> &way)
  {
    const auto &own    = free.of_block(block);
    const bool has_dug = std::any_of(own.begin(), own.end(), [&](const auto i) {
      return is_dug(ground, free.faces[i]);
    });
    std::vector<CellFace> faces;
    for (const unsigned int i : own)
      {
        const CellFace &f = free.faces[i];
        const Tensor<1, dim> area =
          ground.split.mesh.face_area_vector(f.cell, f.face);
        if (!has_dug || is_dug(ground, f) || area * way >= -1e-6 * area.norm())
          faces.push_back(f);
      }
    return faces;
  }



  template <int dim>
  Tensor<1, dim>
  sum_of_areas(const Mesh<dim> &mesh, const std::vector<CellFace> &faces)
  {
    Tensor<1, dim> sum;
    double all = 0.;
    for (const CellFace &f : faces)
      {
        const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
        sum += area;
        all += area.norm();
      }
    return sum.norm() > no_area * all ? sum : Tensor<1, dim>();
  }



  template <int dim>
  std::vector<std::pair<std::string, unsigned int>>
  list_new_bolts(const Ground<dim> &ground,
                 const BlockSupport<dim> &support,
                 const double force)
  {
    std::vector<std::pair<std::string, unsigned int>> numbers;
    for (unsigned int set = 0; set < ground.scene.bolts.size(); ++set)
      if (const unsigned int n = number_of_new_bolts(ground, set, force);
          n > 0 && n_bolts_of(support, set) == 0)
        numbers.emplace_back(ground.scene.bolts[set]->name, n);
    return numbers;
  }



  namespace
  {
    /** Forces of a @p pressure on faces. */
    template <int dim>
    std::vector<PointForce<dim>>
    forces_of_pressure(const std::vector<PointForce<dim>> &free_faces,
                       const double pressure)
    {
      std::vector<PointForce<dim>> forces;
      if (pressure > 0.)
        for (const PointForce<dim> &face : free_faces)
          forces.push_back({face.place, -pressure * face.force});
      return forces;
    }

    /** Whether the line of the resultant, which passes within the base, tells
     * that moments are balanced with all that acts undivided. */
    template <int dim>
    bool
    is_judged_by_base(const SupportedMotion<dim> &motion)
    {
      return motion.rotation.is_judged && motion.rotation.outside == 0. &&
             motion.limit.faces.size() == motion.limit.n_pressed;
    }



    /** That of a block which does not turn but about its base, under a
     * @p pressure on free faces besides, which pulls as a bolt does. */
    template <int dim>
    SupportedMotion<dim>
    find_sliding(BlockSurroundings<dim> &around,
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
          const std::vector<PointForce<dim>> pressed =
            forces_of_pressure(free_faces, pressure);
          forces.insert(forces.end(), pressed.begin(), pressed.end());
          const Tensor<1, dim> pushed = sum_of(pressed);
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
      motion.rotation = judge_rotation<dim>(around.faces, forces, motion.limit);
      return motion;
    }
  } // namespace



  template <int dim>
  SupportedMotion<dim>
  find_motion(BlockSurroundings<dim> &around,
              const BlockSupport<dim> &support,
              const bool is_passive)
  {
    SupportedMotion<dim> motion =
      find_sliding<dim>(around, support, is_passive, {}, 0.);
    if (is_judged_by_base(motion) && (!is_passive || support.pulls.empty()))
      return motion;
    const double most = std::min(motion.limit.factor, most_factor);
    if (const double factor = greatest_balanced_factor<dim>(
          around, support, is_passive, motion.limit.direction, most);
        factor < most)
      {
        motion.rotation.is_by_moments = true;
        motion.limit.mode             = LimitEquilibrium<dim>::Mode::rotating;
        motion.limit.factor           = factor;
      }
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
    using Mode = typename LimitEquilibrium<dim>::Mode;
    SupportDemand demand;
    demand.factor = factor;
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    const auto motion_with = [&](const BlockSupport<dim> &bolts,
                                 const std::vector<PointForce<dim>> &faces,
                                 const double pressure) {
      BlockSurroundings<dim> own = around;
      return find_sliding<dim>(own, bolts, is_passive, faces, pressure);
    };
    const LimitEquilibrium<dim> bare = motion_with(support, {}, 0.).limit;
    const auto is_held               = [&](const SupportedMotion<dim> &motion) {
      // so much that it lifts the block is none
      return motion.limit.factor >= factor &&
             (motion.limit.mode != Mode::lifting || bare.mode == Mode::lifting);
    };
    const auto does = [&](const BlockSupport<dim> &bolts,
                          const std::vector<PointForce<dim>> &faces,
                          const double pressure) {
      const SupportedMotion<dim> motion = motion_with(bolts, faces, pressure);
      const bool has_divided =
        is_passive && (pressure > 0. || !bolts.pulls.empty());
      return is_held(motion) &&
             ((is_judged_by_base(motion) && !has_divided) ||
              balances_moments<dim>(around,
                                    bolts,
                                    is_passive,
                                    forces_of_pressure(faces, pressure),
                                    motion.limit.direction,
                                    factor));
    };
    if (does(support, {}, 0.))
      return demand;
    const Mesh<dim> &mesh = ground.split.mesh;
    const std::vector<CellFace> supported =
      list_supported_faces(ground, free, block, bare.direction);
    std::vector<PointForce<dim>> free_faces;
    for (const CellFace &f : supported)
      free_faces.push_back({area_center(mesh, f.cell, f.face),
                            mesh.face_area_vector(f.cell, f.face)});
    const double area         = sum_of_areas(mesh, supported).norm();
    const Tensor<1, dim> load = around.loads.without_water();
    Tensor<1, dim> resultant  = load;
    for (const BlockFace<dim> &face : around.faces)
      resultant += face.water_force * face.inward;
    const double most  = most_demand * std::max(load.norm(), resultant.norm());
    const double first = least_demand * resultant.norm();
    const double against_sliding = least_force(
      [&](const double force) {
        return is_held(motion_with(support, free_faces, force / area));
      },
      first,
      area > 0. ? most : 0.,
      1.1);
    const auto is_enough = [&](const double force) {
      return does(support, free_faces, force / area);
    };
    demand.force =
      std::isfinite(against_sliding) && is_enough(against_sliding)
        ? against_sliding
        : least_force(is_enough,
                      std::max(against_sliding, first),
                      most_moment *
                        std::max(against_sliding, around.loads.weight.norm()),
                      1.02);
    demand.pressure = area > 0. ? demand.force / area : demand.force;
    for (unsigned int set = 0; set < ground.scene.bolts.size(); ++set)
      if (n_bolts_of(support, set) > 0)
        demand.numbers.emplace_back(
          ground.scene.bolts[set]->name,
          least_number([&](const unsigned int n) {
            return does(with_more_bolts(support, set, n), {}, 0.);
          }));
      else if (const unsigned int n =
                 number_of_new_bolts(ground, set, demand.force);
               n > 0)
        demand.numbers.emplace_back(ground.scene.bolts[set]->name, n);
    return demand;
  }

#define INSTANTIATE(dim)                                                       \
  template SupportedMotion<dim> find_motion(BlockSurroundings<dim> &,          \
                                            const BlockSupport<dim> &,         \
                                            const bool);                       \
  template SupportDemand find_demand(const Ground<dim> &,                      \
                                     const FreeFaces<dim> &,                   \
                                     const unsigned int,                       \
                                     const BlockSurroundings<dim> &,           \
                                     const BlockSupport<dim> &,                \
                                     const double);                            \
  template Tensor<1, dim> sum_of_areas(const Mesh<dim> &,                      \
                                       const std::vector<CellFace> &);         \
  template std::vector<CellFace> list_supported_faces(const Ground<dim> &,     \
                                                      const FreeFaces<dim> &,  \
                                                      const unsigned int,      \
                                                      const Tensor<1, dim> &); \
  template std::vector<std::pair<std::string, unsigned int>> list_new_bolts(   \
    const Ground<dim> &, const BlockSupport<dim> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

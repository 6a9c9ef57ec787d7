// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/blocks.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/block_theory.h>
#include <keyblock/safety/limit_equilibrium.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    constexpr unsigned int most_sets = 8;
    constexpr double radian          = dealii::numbers::PI / 180.;

    /** Horizontal unit vector of an azimuth [deg], clockwise from north. */
    template <int dim>
    Tensor<1, dim>
    horizontal(const double azimuth)
    {
      Tensor<1, dim> result;
      result[0] = std::sin(azimuth * radian);
      if (dim == 3)
        result[1] = std::cos(azimuth * radian);
      return result;
    }

    /** Whether the cone n.d >= 0 of unit @p normals, none parallel, is more
     * than a ray or a plane: some direction leaves all of them. */
    template <int dim>
    bool
    has_interior(const std::vector<Tensor<1, dim>> &normals)
    {
      if (normals.size() == 1)
        return true;
      Tensor<1, dim> sum; // of the unit vectors along its edges
      const auto add = [&](const Tensor<1, dim> &line) {
        for (const double sign : {1., -1.})
          if (std::all_of(normals.begin(),
                          normals.end(),
                          [&](const Tensor<1, dim> &n) {
                            return sign * (n * line) >= -1e-10 * line.norm();
                          }))
            sum += sign / line.norm() * line;
      };
      for (const Tensor<1, dim> &a : normals)
        for (const Tensor<1, dim> &b : normals)
          if (const double cosine = a * b; std::abs(cosine) < 1. - 1e-12)
            {
              add(b - cosine * a);
              if constexpr (dim == 3)
                add(cross_product_3d(a, b));
            }
      return std::all_of(normals.begin(),
                         normals.end(),
                         [&](const Tensor<1, dim> &n) {
                           return n * sum > 1e-9 * sum.norm();
                         });
    }

    template <int dim>
    JointPyramid
    make_pyramid(const std::vector<ParallelJoints<dim>> &sets,
                 const unsigned int number,
                 const Tensor<1, dim> &gravity)
    {
      JointPyramid result;
      for (unsigned int s = sets.size(); s-- > 0;)
        result.code += (number >> s) & 1 ? '1' : '0';
      const auto inward = inward_normals(sets, result.code);
      result.is_empty   = !has_interior(inward);
      std::vector<BlockFace<dim>> faces(sets.size());
      for (unsigned int s = 0; s < sets.size(); ++s)
        {
          faces[s].inward           = inward[s];
          faces[s].tangent_friction = std::tan(sets[s].friction_angle * radian);
          faces[s].name             = sets[s].name;
        }
      auto limit = solve_limit_equilibrium<dim>(faces, gravity);
      limit.orient(gravity);
      result.mode   = result.is_empty ? "tapered" : limit.describe(faces);
      result.factor = limit.factor;
      return result;
    }

    /** Roof, floor and walls; removable is left empty. */
    template <int dim>
    std::vector<FreeFace<dim>>
    list_faces(const BlockTheorySettings &settings)
    {
      std::vector<FreeFace<dim>> faces(2);
      faces[0].name               = "roof";
      faces[0].into_rock[dim - 1] = 1.;
      faces[1].name               = "floor";
      faces[1].into_rock          = -faces[0].into_rock;
      for (const double azimuth : settings.walls)
        {
          const Tensor<1, dim> outward = horizontal<dim>(azimuth);
          if (outward.norm() < 1. - 1e-9) // not in the plane of a 2D scene
            continue;
          std::ostringstream name;
          name << "wall facing " << azimuth;
          faces.push_back({name.str(), -outward, {}});
        }
      return faces;
    }

    /** Unit vectors along the edges of the cone n.d >= 0. */
    std::vector<Tensor<1, 3>>
    edges_of_cone(const std::vector<Tensor<1, 3>> &normals)
    {
      std::vector<Tensor<1, 3>> edges;
      for (unsigned int i = 0; i < normals.size(); ++i)
        for (unsigned int j = i + 1; j < normals.size(); ++j)
          for (const double sign : {1., -1.})
            {
              const Tensor<1, 3> line =
                sign * cross_product_3d(normals[i], normals[j]);
              if (line.norm() > 1e-10 &&
                  std::all_of(normals.begin(),
                              normals.end(),
                              [&](const Tensor<1, 3> &n) {
                                return n * line >= -1e-10 * line.norm();
                              }))
                edges.push_back(line / line.norm());
            }
      return edges;
    }

    /** Static friction angle [deg], the least there is under any pressure. */
    double
    friction_angle_of(const JointStrength &joint)
    {
      const auto law = make_joint_law(joint);
      if (!law->depends_on_pressure())
        return joint.friction_angle;
      JointPointState state;
      state.pressure = std::numeric_limits<double>::max();
      return std::atan(law->envelope(state).static_tangent) / radian;
    }

    /** Sets of the infinite joints, parallel ones together. */
    template <int dim>
    std::vector<ParallelJoints<dim>>
    collect_sets(const Scene<dim> &scene)
    {
      std::vector<ParallelJoints<dim>> sets;
      for (const auto &joint : scene.joints)
        {
          if (joint->extent != JointShape::infinite)
            continue;
          const Tensor<1, dim> normal = joint->normal();
          const auto same =
            std::find_if(sets.begin(), sets.end(), [&](const auto &set) {
              return std::min((set.normal - normal).norm(),
                              (set.normal + normal).norm()) < 1e-6;
            });
          if (same == sets.end())
            sets.push_back({joint->name, normal, friction_angle_of(*joint)});
          else
            same->friction_angle =
              std::min(same->friction_angle, friction_angle_of(*joint));
        }
      return sets;
    }
  } // namespace



  template <int dim>
  unsigned int
  BlockTheory<dim>::n_empty() const
  {
    return std::count_if(pyramids.begin(),
                         pyramids.end(),
                         [](const JointPyramid &p) { return p.is_empty; });
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  inward_normals(const std::vector<ParallelJoints<dim>> &sets,
                 const std::string &code)
  {
    std::vector<Tensor<1, dim>> result;
    for (unsigned int s = 0; s < sets.size(); ++s)
      result.push_back((code[s] == '0' ? 1. : -1.) * sets[s].normal);
    return result;
  }



  template <int dim>
  BlockTheory<dim>
  find_block_theory(const std::vector<ParallelJoints<dim>> &sets,
                    const Tensor<1, dim> &gravity,
                    const BlockTheorySettings &settings)
  {
    BlockTheory<dim> result;
    result.sets     = sets;
    result.settings = settings;
    if (sets.empty())
      result.remark = "There is no infinite joint, hence no joint set.";
    else if (sets.size() > most_sets)
      result.remark = "The report of block theory is for at most " +
                      std::to_string(most_sets) +
                      " joint sets, and the scene has " +
                      std::to_string(sets.size()) + ".";
    if (!result.remark.empty())
      return result;
    for (unsigned int number = 0; number < (1u << sets.size()); ++number)
      result.pyramids.push_back(make_pyramid(sets, number, gravity));
    result.faces = list_faces<dim>(settings);
    for (FreeFace<dim> &face : result.faces)
      {
        for (unsigned int p = 0; p < result.pyramids.size(); ++p)
          {
            auto block = inward_normals(sets, result.pyramids[p].code);
            block.push_back(face.into_rock);
            if (!result.pyramids[p].is_empty && !is_removable(block))
              face.removable.push_back(p);
          }
        std::stable_sort(face.removable.begin(),
                         face.removable.end(),
                         [&](const unsigned int a, const unsigned int b) {
                           return result.pyramids[a].factor <
                                  result.pyramids[b].factor;
                         });
      }
    return result;
  }



  template <int dim>
  BlockTheory<dim>
  find_block_theory(const Scene<dim> &scene,
                    const BlockTheorySettings &settings)
  {
    Tensor<1, dim> gravity = Gravity<dim>(scene).at(Point<dim>(), 0.);
    if (gravity.norm() == 0.)
      gravity[dim - 1] = -1.;
    return find_block_theory(collect_sets(scene), gravity, settings);
  }



  RoofWedge
  find_largest_roof_wedge(const std::vector<ParallelJoints<3>> &sets,
                          const std::string &code,
                          const BlockTheorySettings &settings)
  {
    // its edges from an apex of unit height down to the roof
    std::vector<Tensor<1, 3>> corners =
      edges_of_cone(inward_normals(sets, code));
    Tensor<1, 3> center;
    for (Tensor<1, 3> &corner : corners)
      {
        corner /= -corner[2];
        center += corner / double(corners.size());
      }
    std::sort(corners.begin(),
              corners.end(),
              [&](const Tensor<1, 3> &a, const Tensor<1, 3> &b) {
                return std::atan2(a[1] - center[1], a[0] - center[0]) <
                       std::atan2(b[1] - center[1], b[0] - center[0]);
              });
    const Tensor<1, 3> across = horizontal<3>(settings.roof_axis + 90.);
    double area = 0., least = across * corners[0], greatest = least;
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        const Tensor<1, 3> &a = corners[i];
        const Tensor<1, 3> &b = corners[(i + 1) % corners.size()];
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        least    = std::min(least, across * a);
        greatest = std::max(greatest, across * a);
      }
    RoofWedge result;
    result.height = settings.roof_span / (greatest - least);
    result.area   = area * result.height * result.height;
    result.volume = result.area * result.height / 3.;
    return result;
  }

#define INSTANTIATE(dim)                                                       \
  template struct BlockTheory<dim>;                                            \
  template std::vector<Tensor<1, dim>> inward_normals(                         \
    const std::vector<ParallelJoints<dim>> &, const std::string &);            \
  template BlockTheory<dim> find_block_theory(                                 \
    const std::vector<ParallelJoints<dim>> &,                                  \
    const Tensor<1, dim> &,                                                    \
    const BlockTheorySettings &);                                              \
  template BlockTheory<dim> find_block_theory(const Scene<dim> &,              \
                                              const BlockTheorySettings &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

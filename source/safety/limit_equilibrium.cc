// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/limit_equilibrium.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  using dealii::Tensor;

  namespace
  {
    /** Cosines below this are taken for a movement along the face. */
    constexpr double rounding = 1e-9;

    /** Difference of unit normals up to which faces count as parallel. */
    constexpr double parallel_normals = 1e-6;

    /** Share of all that acts from which on it presses on a face [-]. */
    constexpr double least_pressed = 1e-6;

    template <int dim>
    bool
    closes_none(const std::vector<BlockFace<dim>> &faces,
                const Tensor<1, dim> &direction)
    {
      for (const BlockFace<dim> &face : faces)
        if (face.inward * direction < -rounding)
          return false;
      return true;
    }

    /** Unit vector of @p force within the plane of @p face; zero if none. */
    template <int dim>
    Tensor<1, dim>
    along(const BlockFace<dim> &face, const Tensor<1, dim> &force)
    {
      const Tensor<1, dim> t = force - (force * face.inward) * face.inward;
      return t.norm() > rounding * force.norm() ? t / t.norm()
                                                : Tensor<1, dim>();
    }

    /** Add to @p result the faces that it moves along without pressing on
     * them: cohesion resists there. */
    template <int dim>
    void
    add_side_faces(const std::vector<BlockFace<dim>> &faces,
                   LimitEquilibrium<dim> &result)
    {
      const std::vector<unsigned int> pressed = result.faces;
      for (unsigned int i = 0; i < faces.size(); ++i)
        if (std::abs(faces[i].inward * result.direction) <= rounding &&
            faces[i].cohesion > 0. &&
            std::find(pressed.begin(), pressed.end(), i) == pressed.end())
          {
            result.add_resistance(faces[i].cohesion * faces[i].area,
                                  faces[i].is_reduced);
            result.faces.push_back(i);
            result.normal_forces.push_back(0.);
          }
    }

    /** Let @p planes be pressed, and all faces parallel to them, which share
     * their normal forces [N]. */
    template <int dim>
    void
    press(const std::vector<BlockFace<dim>> &faces,
          const std::vector<unsigned int> &planes,
          const std::vector<double> &normal_forces,
          LimitEquilibrium<dim> &result)
    {
      for (unsigned int p = 0; p < planes.size(); ++p)
        {
          std::vector<unsigned int> group;
          double area = 0.;
          for (unsigned int i = 0; i < faces.size(); ++i)
            if ((faces[i].inward - faces[planes[p]].inward).norm() <
                parallel_normals)
              {
                group.push_back(i);
                area += faces[i].area;
              }
          for (const unsigned int i : group)
            {
              result.faces.push_back(i);
              result.normal_forces.push_back(
                normal_forces[p] *
                (area > 0. ? faces[i].area / area : 1. / group.size()));
            }
        }
      result.n_pressed = result.faces.size();
    }

    /** Effective normal forces on one or two @p planes that balance the
     * resultant across the direction of sliding [N]. */
    template <int dim>
    std::vector<double>
    normal_forces_on(const std::vector<BlockFace<dim>> &faces,
                     const std::vector<unsigned int> &planes,
                     const Tensor<1, dim> &resultant)
    {
      const Tensor<1, dim> &a = faces[planes[0]].inward;
      if (planes.size() == 1)
        return {-(resultant * a)};
      const Tensor<1, dim> &b  = faces[planes[1]].inward;
      const double cosine      = a * b;
      const double determinant = 1. - cosine * cosine;
      const double ra = -(resultant * a), rb = -(resultant * b);
      return {(ra - cosine * rb) / determinant,
              (rb - cosine * ra) / determinant};
    }

    /** Factor and forces of a block that slides along result.direction on
     * @p planes, which it presses on. */
    template <int dim>
    void
    resist(const std::vector<BlockFace<dim>> &faces,
           const std::vector<unsigned int> &planes,
           const Tensor<1, dim> &resultant,
           LimitEquilibrium<dim> &result)
    {
      result.driving_force = resultant * result.direction;
      press(faces, planes, normal_forces_on(faces, planes, resultant), result);
      for (unsigned int i = 0; i < result.faces.size(); ++i)
        {
          const BlockFace<dim> &face = faces[result.faces[i]];
          result.add_resistance(face.cohesion * face.area +
                                  face.tangent_friction *
                                    result.normal_forces[i],
                                face.is_reduced);
        }
      add_side_faces(faces, result);
      result.set_factor();
    }
  } // namespace



  template <int dim>
  LimitEquilibrium<dim>
  solve_limit_equilibrium(const std::vector<BlockFace<dim>> &faces,
                          const Tensor<1, dim> &load)
  {
    using Mode = typename LimitEquilibrium<dim>::Mode;
    LimitEquilibrium<dim> result;
    Tensor<1, dim> resultant = load;
    for (const BlockFace<dim> &face : faces)
      resultant += face.water_force * face.inward;
    if (resultant.norm() == 0.)
      {
        result.factor = std::numeric_limits<double>::infinity();
        return result;
      }
    if (closes_none(faces, resultant / resultant.norm()))
      {
        result.direction = resultant / resultant.norm();
        result.mode      = Mode::falling;
        Tensor<1, dim> down;
        down[dim - 1] = -1.;
        result.orient(down);
        result.driving_force = resultant.norm();
        add_side_faces(faces, result);
        result.set_factor();
        return result;
      }
    for (unsigned int i = 0; i < faces.size(); ++i)
      if (resultant * faces[i].inward < 0.)
        {
          const Tensor<1, dim> s = along(faces[i], resultant);
          if (s.norm() > 0. && closes_none(faces, s))
            {
              result.mode      = Mode::one_plane;
              result.direction = s;
              resist(faces, {i}, resultant, result);
              return result;
            }
        }
    if constexpr (dim == 3)
      for (unsigned int i = 0; i < faces.size(); ++i)
        for (unsigned int j = i + 1; j < faces.size(); ++j)
          {
            Tensor<1, dim> s =
              cross_product_3d(faces[i].inward, faces[j].inward);
            if (s.norm() < rounding)
              continue;
            s *= (s * resultant > 0. ? 1. : -1.) / s.norm();
            if (s * resultant < rounding * resultant.norm() ||
                !closes_none(faces, s) ||
                along(faces[i], resultant) * faces[j].inward > 0. ||
                along(faces[j], resultant) * faces[i].inward > 0.)
              continue;
            LimitEquilibrium<dim> candidate;
            const std::vector<double> normal_forces =
              normal_forces_on(faces, {i, j}, resultant);
            if (normal_forces[0] < 0. || normal_forces[1] < 0.)
              continue;
            candidate.mode      = Mode::two_planes;
            candidate.direction = s;
            resist(faces, {i, j}, resultant, candidate);
            return candidate;
          }
    result.factor = std::numeric_limits<double>::infinity();
    return result;
  }



  template <int dim>
  void
  LimitEquilibrium<dim>::set_factor()
  {
    factor = is_held_by_fixed()
               ? std::numeric_limits<double>::infinity()
               : reduced_resistance / (driving_force - fixed_resistance);
  }



  template <int dim>
  void
  LimitEquilibrium<dim>::orient(const Tensor<1, dim> &weight)
  {
    if ((mode == Mode::falling || mode == Mode::lifting) && weight.norm() > 0.)
      mode = direction * weight < 0. ? Mode::lifting : Mode::falling;
  }



  template <int dim>
  std::set<unsigned int>
  LimitEquilibrium<dim>::pressed_faces(const std::vector<BlockFace<dim>> &all,
                                       const dealii::Tensor<1, dim> &load) const
  {
    if (mode != Mode::stable && !(mode == Mode::rotating && n_pressed == 0))
      return {faces.begin(), faces.begin() + n_pressed};
    dealii::Tensor<1, dim> drive = load;
    for (const BlockFace<dim> &face : all)
      drive += face.water_force * face.inward;
    const double least = least_pressed * drive.norm();
    std::set<unsigned int> pressed;
    std::vector<dealii::Tensor<1, dim>> closed; // orthonormal
    while (closed.size() < dim)
      {
        double most = -least;
        dealii::Tensor<1, dim> normal;
        for (unsigned int i = 0; i < all.size(); ++i)
          if (const double along = drive * all[i].inward; along < -least)
            {
              pressed.insert(i);
              if (along < most)
                {
                  most   = along;
                  normal = all[i].inward;
                }
            }
        for (const auto &n : closed)
          normal -= (normal * n) * n;
        if (normal.norm() < least_pressed)
          break;
        closed.push_back(normal / normal.norm());
        drive -= (drive * closed.back()) * closed.back();
      }
    return pressed;
  }



  template <int dim>
  BlockMode
  LimitEquilibrium<dim>::block_mode(
    const std::vector<BlockFace<dim>> &all) const
  {
    BlockMode result;
    switch (mode)
      {
        case Mode::stable:
          result.motion = "stable";
          return result;
        case Mode::falling:
          result.motion = "falling";
          return result;
        case Mode::lifting:
          result.motion = "lifting";
          return result;
        case Mode::one_plane:
        case Mode::two_planes:
          result.motion = "sliding";
          break;
        case Mode::rotating:
          result.motion = "rotating";
      }
    for (unsigned int i = 0; i < n_pressed; ++i)
      result.add_joint(all[faces[i]].name);
    return result;
  }

  template struct LimitEquilibrium<2>;
  template struct LimitEquilibrium<3>;
  template <int dim>
  LimitEquilibrium<dim>
  solve_with_laws(std::vector<BlockFace<dim>> &faces,
                  const Tensor<1, dim> &load)
  {
    const LimitEquilibrium<dim> result = solve_limit_equilibrium(faces, load);
    // the mode and the normal forces do not depend on friction
    bool has_changed = false;
    for (unsigned int i = 0; i < result.n_pressed; ++i)
      {
        BlockFace<dim> &face = faces[result.faces[i]];
        if (face.law == nullptr || face.area <= 0.)
          continue;
        JointPointState state;
        state.pressure        = result.normal_forces[i] / face.area;
        face.tangent_friction = face.law->envelope(state).static_tangent;
        has_changed           = true;
      }
    return has_changed ? solve_limit_equilibrium(faces, load) : result;
  }

  template LimitEquilibrium<2> solve_with_laws(std::vector<BlockFace<2>> &,
                                               const Tensor<1, 2> &);
  template LimitEquilibrium<3> solve_with_laws(std::vector<BlockFace<3>> &,
                                               const Tensor<1, 3> &);
  template LimitEquilibrium<2>
  solve_limit_equilibrium(const std::vector<BlockFace<2>> &,
                          const Tensor<1, 2> &);
  template LimitEquilibrium<3>
  solve_limit_equilibrium(const std::vector<BlockFace<3>> &,
                          const Tensor<1, 3> &);
} // namespace Keyblock

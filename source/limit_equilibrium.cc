// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/limit_equilibrium.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  using dealii::Tensor;

  namespace
  {
    /** Cosines below this are taken for a movement along the face. */
    constexpr double tolerance = 1e-9;

    template <int dim>
    bool
    closes_none(const std::vector<BlockFace<dim>> &faces,
                const Tensor<1, dim> &direction)
    {
      for (const BlockFace<dim> &face : faces)
        if (face.inward * direction < -tolerance)
          return false;
      return true;
    }

    /** Unit vector of @p force within the plane of @p face; zero if none. */
    template <int dim>
    Tensor<1, dim>
    along(const BlockFace<dim> &face, const Tensor<1, dim> &force)
    {
      const Tensor<1, dim> t = force - (force * face.inward) * face.inward;
      return t.norm() > tolerance * force.norm() ? t / t.norm()
                                                 : Tensor<1, dim>();
    }

    /** Add to @p result the faces that it moves along without pressing on
     * them: cohesion resists there. Returns their resistance [N]. */
    template <int dim>
    double
    add_side_faces(const std::vector<BlockFace<dim>> &faces,
                   LimitEquilibrium<dim> &result)
    {
      const std::vector<unsigned int> pressed = result.faces;
      double resistance                       = 0.;
      for (unsigned int i = 0; i < faces.size(); ++i)
        if (std::abs(faces[i].inward * result.direction) <= tolerance &&
            faces[i].cohesion > 0. &&
            std::find(pressed.begin(), pressed.end(), i) == pressed.end())
          {
            resistance += faces[i].cohesion * faces[i].area;
            result.faces.push_back(i);
            result.normal_forces.push_back(0.);
          }
      return resistance;
    }

    /** Factor and forces of a block that slides along result.direction on
     * result.faces, which it presses on. */
    template <int dim>
    void
    resist(const std::vector<BlockFace<dim>> &faces,
           const Tensor<1, dim> &resultant,
           LimitEquilibrium<dim> &result)
    {
      result.driving_force = resultant * result.direction;
      // N_i n_i (+ N_j n_j) balances the resultant across the direction
      const Tensor<1, dim> &a = faces[result.faces[0]].inward;
      if (result.faces.size() == 1)
        result.normal_forces = {-(resultant * a)};
      else
        {
          const Tensor<1, dim> &b  = faces[result.faces[1]].inward;
          const double cosine      = a * b;
          const double determinant = 1. - cosine * cosine;
          const double ra = -(resultant * a), rb = -(resultant * b);
          result.normal_forces = {(ra - cosine * rb) / determinant,
                                  (rb - cosine * ra) / determinant};
        }
      double resistance = 0.;
      for (unsigned int i = 0; i < result.faces.size(); ++i)
        {
          const BlockFace<dim> &face = faces[result.faces[i]];
          resistance += face.cohesion * face.area +
                        face.tangent_friction * result.normal_forces[i];
        }
      resistance += add_side_faces(faces, result);
      result.factor = resistance / result.driving_force;
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
        result.mode =
          result.direction[dim - 1] > 0. ? Mode::lifting : Mode::falling;
        result.driving_force = resultant.norm();
        result.factor = add_side_faces(faces, result) / result.driving_force;
        return result;
      }
    for (unsigned int i = 0; i < faces.size(); ++i)
      if (resultant * faces[i].inward < 0.)
        {
          const Tensor<1, dim> s = along(faces[i], resultant);
          if (s.norm() > 0. && closes_none(faces, s))
            {
              result.mode      = Mode::one_plane;
              result.faces     = {i};
              result.direction = s;
              resist(faces, resultant, result);
              return result;
            }
        }
    if constexpr (dim == 3)
      for (unsigned int i = 0; i < faces.size(); ++i)
        for (unsigned int j = i + 1; j < faces.size(); ++j)
          {
            Tensor<1, dim> s =
              cross_product_3d(faces[i].inward, faces[j].inward);
            if (s.norm() < tolerance)
              continue;
            s *= (s * resultant > 0. ? 1. : -1.) / s.norm();
            if (s * resultant < tolerance * resultant.norm() ||
                !closes_none(faces, s) ||
                along(faces[i], resultant) * faces[j].inward > 0. ||
                along(faces[j], resultant) * faces[i].inward > 0.)
              continue;
            LimitEquilibrium<dim> candidate;
            candidate.mode      = Mode::two_planes;
            candidate.faces     = {i, j};
            candidate.direction = s;
            resist(faces, resultant, candidate);
            if (candidate.normal_forces[0] >= 0. &&
                candidate.normal_forces[1] >= 0.)
              return candidate;
          }
    result.factor = std::numeric_limits<double>::infinity();
    return result;
  }



  template <int dim>
  std::string
  LimitEquilibrium<dim>::describe(const std::vector<BlockFace<dim>> &all) const
  {
    switch (mode)
      {
        case Mode::stable:
          return "stable";
        case Mode::falling:
          return "falling";
        case Mode::lifting:
          return "lifting";
        case Mode::one_plane:
          return "sliding on " + all[faces[0]].name;
        case Mode::two_planes:
          return "sliding on " + all[faces[0]].name + "/" + all[faces[1]].name;
      }
    return "";
  }

  template struct LimitEquilibrium<2>;
  template struct LimitEquilibrium<3>;
  template LimitEquilibrium<2>
  solve_limit_equilibrium(const std::vector<BlockFace<2>> &,
                          const Tensor<1, 2> &);
  template LimitEquilibrium<3>
  solve_limit_equilibrium(const std::vector<BlockFace<3>> &,
                          const Tensor<1, 3> &);
} // namespace Keyblock

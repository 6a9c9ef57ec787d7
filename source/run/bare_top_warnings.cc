// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that are never judged for a surface of the ground that counts as rock
// that goes on.
#include <keyblock/base/expression.h>
#include <keyblock/run/bare_top_warnings.h>
#include <keyblock/scene/box_sides.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <memory>

namespace Keyblock
{
  namespace
  {
    /** Whether the last axis points up and the scene leaves open which sides
     * are truncated, without a load or a support that may be on the top. */
    template <int dim>
    bool
    leaves_top_open(const Scene<dim> &scene)
    {
      const Domain<dim> &domain   = scene.domain;
      const Tensor<1, dim> weight = Gravity<dim>(scene).at(Point<dim>(), 0.);
      const bool is_box =
        domain.shape == DomainShape::box && domain.size.size() == dim;
      if (domain.truncated_boundaries != Domain<dim>().truncated_boundaries ||
          scene.ground.is_given() || -weight[dim - 1] < 0.9 * weight.norm() ||
          weight.norm() == 0. || !scene.initial_state.measured_points.empty() ||
          (!is_box && domain.shape != DomainShape::polygon))
        return false;
      const auto is_on_top = [&](const auto &item, const std::string &section) {
        return is_box ? is_on_side(item, section, domain, "top")
                      : !item.region.empty() || item.boundaries.empty() ||
                          std::count(item.boundaries.begin(),
                                     item.boundaries.end(),
                                     "top") > 0;
      };
      for (const auto &traction : scene.tractions)
        if (is_on_top(*traction, "Tractions"))
          return false;
      for (const auto &support : scene.supports)
        if (is_on_top(*support, "Supports"))
          return false;
      return true;
    }

    /** Initial vertical stress of a scene, compression positive [Pa]. */
    template <int dim>
    class VerticalStress
    {
    public:
      explicit VerticalStress(const InitialState<dim> &state)
        : state(state)
      {
        if (!state.stress.empty())
          formula = std::make_unique<Expression<dim>>(state.stress,
                                                      dim == 2 ? 4 : 6,
                                                      "Initial state/Stress");
      }

      double
      at(const Point<dim> &place) const
      {
        return formula ? -formula->value(place, 0., dim - 1)
                       : vertical_stress_at(state, place[dim - 1]);
      }

    private:
      const InitialState<dim> &state;
      std::unique_ptr<Expression<dim>> formula;
    };

    /** What makes a block infinite. */
    struct OuterFaces
    {
      bool has_bare  = false; ///< the top, or edges of a polygon, unpressed
      bool has_slope = false; ///< edges of a polygon
      bool has_other = false;
    };

    template <int dim>
    std::vector<OuterFaces>
    find_outer_faces(const Scene<dim> &scene,
                     const Mesh<dim> &mesh,
                     const Blocks<dim> &blocks)
    {
      constexpr double least_pressure = 1e3; // [Pa]
      const VerticalStress<dim> stress(scene.initial_state);
      std::vector<OuterFaces> found(blocks.blocks.size());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const unsigned int b = blocks.block_of_cell[c];
          if (b == none || found[b].has_other)
            continue;
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (mesh.is_on(c, f, "all"))
              {
                const bool is_slope = mesh.boundary[c][f] == none;
                if ((is_slope || mesh.is_on(c, f, "top")) &&
                    stress.at(mesh.face_center(c, f)) < least_pressure)
                  {
                    found[b].has_bare  = true;
                    found[b].has_slope = found[b].has_slope || is_slope;
                  }
                else
                  found[b].has_other = true;
              }
        }
      return found;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_bare_top(const Scene<dim> &scene,
                       const Mesh<dim> &mesh,
                       const Blocks<dim> &blocks)
  {
    if (!leaves_top_open(scene))
      return {};
    const std::vector<OuterFaces> faces = find_outer_faces(scene, mesh, blocks);
    const Block<dim> *largest           = nullptr;
    unsigned int n                      = 0;
    for (unsigned int b = 0; b < faces.size(); ++b)
      {
        const Block<dim> &block = blocks.blocks[b];
        const bool is_free      = block.exposed_stage != none;
        if (!block.is_infinite || block.is_rigid || !faces[b].has_bare ||
            faces[b].has_other || !(is_free || faces[b].has_slope))
          continue;
        ++n;
        if (!largest || block.volume > largest->volume)
          largest = &block;
      }
    if (n == 0)
      return {};
    const std::string beginning =
      n == 1 ? "Block " + std::to_string(largest->id) + " is"
             : std::to_string(n) + " blocks, the largest of them " +
                 std::to_string(largest->id) + ", are";
    return {beginning +
            " infinite by nothing but the surface of the domain, on which "
            "nothing presses, and never judged; if it is that of the ground, "
            "name the sides where the rock goes on in 'Domain/Truncated "
            "boundaries', as left, right, bottom, or set 'Ground/Depth'."};
  }

  template std::vector<std::string>
  warnings_of_bare_top(const Scene<2> &, const Mesh<2> &, const Blocks<2> &);
  template std::vector<std::string>
  warnings_of_bare_top(const Scene<3> &, const Mesh<3> &, const Blocks<3> &);
} // namespace Keyblock

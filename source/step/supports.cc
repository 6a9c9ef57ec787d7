// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/supports.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/sort_unique.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    Tensor<1, dim>
    tensor_of(const std::array<double, dim> &list)
    {
      Tensor<1, dim> tensor;
      for (int d = 0; d < dim; ++d)
        tensor[d] = list[d];
      return tensor;
    }

    template <int dim>
    std::array<double, dim>
    list_of(const Tensor<1, dim> &tensor)
    {
      std::array<double, dim> list;
      for (int d = 0; d < dim; ++d)
        list[d] = tensor[d];
      return list;
    }

    /** Directions that are this close to each other are one. */
    constexpr double same_direction = 1e-6;

    /** Add the unit vector @p axis to what a support holds, moved by @p motion
     * or at rest (-1). */
    template <int dim>
    void
    hold_direction(NodeSupport<dim> &support,
                   const Tensor<1, dim> &axis,
                   const int motion)
    {
      Tensor<1, dim> direction = axis;
      for (unsigned int k = 0; k < support.n_directions; ++k)
        {
          const Tensor<1, dim> held = tensor_of<dim>(support.directions[k]);
          if (motion >= 0 &&
              (axis - (axis * held) * held).norm() < same_direction)
            {
              support.axes[k]    = list_of<dim>(axis);
              support.motions[k] = motion;
              return;
            }
          direction -= (direction * held) * held;
        }
      if (direction.norm() < same_direction)
        return;
      direction /= direction.norm();
      const unsigned int k  = support.n_directions++;
      support.directions[k] = list_of<dim>(direction);
      support.axes[k]       = list_of<dim>(axis);
      support.motions[k]    = motion;
    }

    template <int dim>
    void
    hold_axis(NodeSupport<dim> &support, const int d, const int motion)
    {
      Tensor<1, dim> axis;
      axis[d] = 1.;
      hold_direction(support, axis, motion);
    }

    /** Call @p hold(vertex, normal) for each vertex that @p support holds; of
     * those in a region the normal is zero. */
    template <int dim, typename Hold>
    void
    for_each_held_vertex(const Support<dim> &support,
                         const Ground<dim> &ground,
                         const Hold &hold)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      if (!support.region.empty())
        {
          const Expression<dim> inside(support.region, 1, "Supports/*/Region");
          for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
            if (inside.value(mesh.vertices[v], 0., 0) > 0.)
              hold(v, Tensor<1, dim>());
        }
      for (const std::string &name : support.boundaries)
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (mesh.is_on(c, f, name) && !ground.is_excavated(c))
              for (const unsigned int v : mesh.face_vertices(c, f))
                hold(v,
                     mesh.face_area_vector(c, f) /
                       mesh.face_area_vector(c, f).norm());
    }
  } // namespace



  template <int dim>
  Supports<dim>::Supports(const Scene<dim> &scene,
                          const SplitMesh<dim> &split,
                          const Numbering<dim> &numbering,
                          const StageClock &clock,
                          Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , clock(clock)
    , fields(fields)
  {}



  template <int dim>
  void
  Supports<dim>::set_up(const Ground<dim> &ground,
                        const std::function<bool(unsigned int)> &is_released)
  {
    Found found;
    fields.supports.clear();
    fields.nodes_of_support.assign(scene.supports.size(), {});
    motions.clear();
    // nodes of rigid bodies first: nothing else may move them
    hold_rigid_bodies(ground, found);
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      {
        const Support<dim> &support = *scene.supports[s];
        if (is_released(s))
          continue;
        const unsigned int n_hits = hold(s, ground, found);
        AssertThrow(n_hits > 0 || ground.stage_number > 1,
                    InputError("The support '" + support.name +
                               "' holds no node; check 'Supports/" +
                               support.name +
                               "/Boundaries' or 'Region' against the domain."));
      }
    fields.support_of_node.assign(numbering.n_local(), -1);
    for (auto &[node, support] : found)
      {
        support.node                 = node;
        fields.support_of_node[node] = fields.supports.size();
        fields.supports.push_back(support);
      }
  }



  template <int dim>
  int
  Supports<dim>::add_motion(const std::string &formula,
                            const std::string &entry,
                            const bool is_displacement)
  {
    motions.push_back({std::make_unique<Expression<dim>>(formula, dim, entry),
                       is_displacement,
                       nullptr,
                       0});
    return motions.size() - 1;
  }



  template <int dim>
  int
  Supports<dim>::motion_of(const Support<dim> &support)
  {
    // a quiet support is held until it lets go
    if (support.is_quiet())
      return -1;
    if (!support.displacement.empty())
      return add_motion(support.displacement, "Supports/*/Displacement", true);
    if (!support.velocity.empty())
      return add_motion(support.velocity, "Supports/*/Velocity", false);
    if (!support.history)
      return -1;
    motions.push_back(
      {nullptr, false, support.history, scene.history_stage(support)});
    return motions.size() - 1;
  }



  template <int dim>
  Tensor<1, dim>
  Supports<dim>::velocity_of(const Motion &motion,
                             const Point<dim> &place,
                             const double time) const
  {
    if (clock.stands())
      return Tensor<1, dim>();
    if (motion.formula)
      return motion.formula->vector(place, time);
    Tensor<1, dim> velocity;
    for (unsigned int d = 0; d < dim; ++d)
      velocity[d] = motion.history->value(clock.since(motion.stage, time), d);
    return velocity;
  }



  template <int dim>
  template <typename Value>
  Tensor<1, dim>
  Supports<dim>::prescribed(const NodeSupport<dim> &support,
                            const Value &value) const
  {
    const Point<dim> place = place_of(support);
    Tensor<1, dim> result, of_motion;
    int known = -1; // the motion that of_motion is of
    for (unsigned int k = 0; k < support.n_directions; ++k)
      {
        const Tensor<1, dim> axis      = tensor_of<dim>(support.axes[k]);
        const Tensor<1, dim> direction = tensor_of<dim>(support.directions[k]);
        if (support.motions[k] >= 0 && support.motions[k] != known)
          {
            known     = support.motions[k];
            of_motion = value(motions[known], place);
          }
        const double wanted = support.motions[k] >= 0 ? axis * of_motion : 0.;
        result += (wanted - axis * result) / (axis * direction) * direction;
      }
    return result;
  }



  template <int dim>
  void
  Supports<dim>::hold_rigid_bodies(const Ground<dim> &ground, Found &found)
  {
    const Mesh<dim> &mesh = split.mesh;
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const Material<dim> &material = *scene.materials[m];
        if (!material.is_rigid())
          continue;
        const int motion = material.rigid_velocity.empty()
                             ? -1
                             : add_motion(material.rigid_velocity,
                                          "Materials/*/Rigid velocity",
                                          false);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (mesh.material[c] == m && !ground.is_excavated(c) &&
              !ground.is_filled(c))
            for (const unsigned int v : mesh.cells[c])
              {
                const unsigned int node = numbering.local_node(v);
                if (node == none || split.is_hanging(v))
                  continue;
                NodeSupport<dim> &support = found[node];
                for (int d = 0; d < dim; ++d)
                  hold_axis(support, d, motion);
              }
      }
  }



  template <int dim>
  unsigned int
  Supports<dim>::hold(const unsigned int s,
                      const Ground<dim> &ground,
                      Found &found)
  {
    const Support<dim> &support      = *scene.supports[s];
    std::vector<unsigned int> &nodes = fields.nodes_of_support[s];
    const int motion                 = motion_of(support);
    const bool holds_all =
      support.directions == SupportDirections::all || support.is_far_field();
    unsigned int n_hits = 0;
    for_each_held_vertex(
      support,
      ground,
      [&](const unsigned int vertex, const Tensor<1, dim> &normal) {
        ++n_hits;
        const unsigned int node = numbering.local_node(vertex);
        if (node == none || split.is_hanging(vertex))
          return;
        if (node < numbering.n_owned())
          nodes.push_back(node);
        NodeSupport<dim> &entry = found[node];
        if (entry.is_fixed())
          return;
        if (support.directions == SupportDirections::normal &&
            !support.is_far_field())
          hold_direction(entry, normal, motion);
        else
          for (int d = 0; d < dim; ++d)
            if (holds_all || support.names_axis(d))
              hold_axis(entry, d, motion);
      });
    sort_unique(nodes);
    return n_hits;
  }



  template <int dim>
  Point<dim>
  Supports<dim>::place_of(const NodeSupport<dim> &support) const
  {
    Point<dim> place;
    for (int d = 0; d < dim; ++d)
      place[d] = fields.reference[dim * support.node + d];
    return place;
  }



  template <int dim>
  void
  Supports<dim>::apply_supports(const double time,
                                const double step,
                                const double share_of_step)
  {
    const double ramp_rate = share_of_step / step;
    for (const NodeSupport<dim> &support : fields.supports)
      {
        if (support.node >= numbering.n_owned())
          continue;
        double *v = fields.velocity.data() + dim * support.node;
        Tensor<1, dim> given;
        if (support.is_moved())
          given = prescribed(
            support, [&](const Motion &motion, const Point<dim> &place) {
              return motion.is_displacement
                       ? ramp_rate * motion.formula->vector(place, 0.)
                       : velocity_of(motion, place, time + 0.5 * step);
            });
        for (unsigned int k = 0; k < support.n_directions; ++k)
          {
            double excess = 0.;
            for (int d = 0; d < dim; ++d)
              excess += support.directions[k][d] * (v[d] - given[d]);
            for (int d = 0; d < dim; ++d)
              v[d] -= excess * support.directions[k][d];
          }
      }
  }



  template <int dim>
  void
  Supports<dim>::remove_held_components(std::vector<double> &force) const
  {
    for (const NodeSupport<dim> &support : fields.supports)
      if (support.node < numbering.n_owned())
        for (unsigned int k = 0; k < support.n_directions; ++k)
          {
            double *const f = force.data() + dim * support.node;
            double held     = 0.;
            for (int d = 0; d < dim; ++d)
              held += support.directions[k][d] * f[d];
            for (int d = 0; d < dim; ++d)
              f[d] -= held * support.directions[k][d];
          }
  }



  template <int dim>
  Tensor<1, dim>
  Supports<dim>::prescribed_displacement(const NodeSupport<dim> &s) const
  {
    return prescribed(s, [](const Motion &motion, const Point<dim> &place) {
      return motion.is_displacement ? motion.formula->vector(place, 0.)
                                    : Tensor<1, dim>();
    });
  }

  template class Supports<2>;
  template class Supports<3>;
} // namespace Keyblock

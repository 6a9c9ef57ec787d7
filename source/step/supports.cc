// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/supports.h>

#include <keyblock/base/errors.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Add @p direction to those of a support, made orthonormal; nothing if it
     * is already held. */
    template <int dim>
    void
    hold_direction(NodeSupport<dim> &support, Tensor<1, dim> direction)
    {
      for (unsigned int k = 0; k < support.n_directions; ++k)
        {
          Tensor<1, dim> held;
          for (int d = 0; d < dim; ++d)
            held[d] = support.directions[k][d];
          direction -= (direction * held) * held;
        }
      if (direction.norm() < 1e-6)
        return;
      direction /= direction.norm();
      for (int d = 0; d < dim; ++d)
        support.directions[support.n_directions][d] = direction[d];
      ++support.n_directions;
    }

    template <int dim>
    void
    hold_axis(NodeSupport<dim> &support, const int d)
    {
      Tensor<1, dim> axis;
      axis[d] = 1.;
      hold_direction(support, axis);
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
                          Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
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
    is_displacement.clear();
    histories.clear();
    // nodes of rigid bodies first: nothing else may move them
    hold_rigid_bodies(found);
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
                            const bool is_reached)
  {
    motions.push_back(std::make_unique<Expression<dim>>(formula, dim, entry));
    is_displacement.push_back(is_reached);
    histories.push_back(nullptr);
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
    motions.push_back(nullptr);
    is_displacement.push_back(false);
    histories.push_back(support.history);
    return motions.size() - 1;
  }



  template <int dim>
  Tensor<1, dim>
  Supports<dim>::velocity_of(const int motion,
                             const Point<dim> &place,
                             const double time) const
  {
    if (motions[motion])
      return motions[motion]->vector(place, time);
    Tensor<1, dim> velocity;
    for (unsigned int d = 0; d < dim; ++d)
      velocity[d] = histories[motion]->value(time, d);
    return velocity;
  }



  template <int dim>
  void
  Supports<dim>::hold_rigid_bodies(Found &found)
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
          if (mesh.material[c] == m)
            for (const unsigned int v : mesh.cells[c])
              {
                const unsigned int node = numbering.local_node(v);
                if (node == none || split.is_hanging(v))
                  continue;
                NodeSupport<dim> &support = found[node];
                for (int d = 0; d < dim; ++d)
                  hold_axis(support, d);
                support.motion = motion;
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
          hold_direction(entry, normal);
        else
          for (int d = 0; d < dim; ++d)
            if (holds_all || support.names_axis(d))
              hold_axis(entry, d);
        if (motion >= 0)
          entry.motion = motion;
      });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
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
        Tensor<1, dim> prescribed;
        if (support.motion >= 0)
          prescribed = is_displacement[support.motion]
                         ? ramp_rate * prescribed_displacement(support)
                         : velocity_of(support.motion,
                                       place_of(support),
                                       time + 0.5 * step);
        for (unsigned int k = 0; k < support.n_directions; ++k)
          {
            double excess = 0.;
            for (int d = 0; d < dim; ++d)
              excess += support.directions[k][d] * (v[d] - prescribed[d]);
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
    if (s.motion < 0 || !is_displacement[s.motion])
      return Tensor<1, dim>();
    return motions[s.motion]->vector(place_of(s), 0.);
  }

  template class Supports<2>;
  template class Supports<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes held or moved, and the springs of the far field.
#include <keyblock/base/mpi.h>
#include <keyblock/step/set_up.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

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
  } // namespace



  template <int dim>
  void
  Conditions<dim>::set_up_supports()
  {
    const Mesh<dim> &mesh = split.mesh;
    std::map<unsigned int, NodeSupport<dim>> found;
    fields.supports.clear();
    fields.nodes_of_support.assign(scene.supports.size(), {});
    motions.clear();
    is_displacement.clear();
    const auto hold_all = [&](NodeSupport<dim> &support) {
      for (int d = 0; d < dim; ++d)
        {
          Tensor<1, dim> axis;
          axis[d] = 1.;
          hold_direction(support, axis);
        }
    };
    // nodes of rigid bodies first: nothing else may move them
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const Material<dim> &material = *scene.materials[m];
        if (!material.is_rigid())
          continue;
        int motion = -1;
        if (!material.rigid_velocity.empty())
          {
            motion = motions.size();
            motions.push_back(std::make_unique<Expression<dim>>(
              material.rigid_velocity, dim, "Materials/*/Rigid velocity"));
            is_displacement.push_back(false);
          }
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (mesh.material[c] == m)
            for (const unsigned int v : mesh.cells[c])
              {
                const unsigned int node = numbering.local_node(v);
                if (node == none || split.is_hanging(v))
                  continue;
                NodeSupport<dim> &support = found[node];
                hold_all(support);
                support.motion = motion;
              }
      }
    for (const auto &support : scene.supports)
      {
        if (support->is_far_field() && is_far_field_free)
          continue;
        std::vector<unsigned int> &nodes =
          fields.nodes_of_support[&support - scene.supports.data()];
        int motion            = -1;
        const bool is_reached = !support->displacement.empty();
        if (!support->velocity.empty() || is_reached)
          {
            motion = motions.size();
            motions.push_back(std::make_unique<Expression<dim>>(
              is_reached ? support->displacement : support->velocity,
              dim,
              is_reached ? "Supports/*/Displacement" : "Supports/*/Velocity"));
            is_displacement.push_back(is_reached);
          }
        unsigned int n_hits = 0;
        const auto hold     = [&](const unsigned int vertex,
                              const Tensor<1, dim> &normal) {
          ++n_hits;
          const unsigned int node = numbering.local_node(vertex);
          if (node == none || split.is_hanging(vertex))
            return;
          if (node < numbering.n_owned())
            nodes.push_back(node);
          NodeSupport<dim> &entry = found[node];
          if (entry.is_fixed())
            return;
          if (support->directions == "normal" && !support->is_far_field())
            hold_direction(entry, normal);
          else
            for (int d = 0; d < dim; ++d)
              if (support->directions == "all" || support->is_far_field() ||
                  support->directions.find("xyz"[d]) != std::string::npos)
                {
                  Tensor<1, dim> axis;
                  axis[d] = 1.;
                  hold_direction(entry, axis);
                }
          if (motion >= 0)
            entry.motion = motion;
        };
        if (!support->region.empty())
          {
            const Expression<dim> inside(support->region,
                                         1,
                                         "Supports/*/Region");
            for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
              if (inside.value(mesh.vertices[v], 0., 0) > 0.)
                hold(v, Tensor<1, dim>());
          }
        for (const std::string &name : support->boundaries)
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              if (mesh.is_on(c, f, name) && !is_dug(c))
                for (const unsigned int v : mesh.face_vertices(c, f))
                  hold(v,
                       mesh.face_area_vector(c, f) /
                         mesh.face_area_vector(c, f).norm());
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        AssertThrow(n_hits > 0 || stage_number > 1,
                    InputError("The support '" + support->name +
                               "' holds no node; check 'Supports/" +
                               support->name +
                               "/Boundaries' or 'Region' against the domain."));
      }
    fields.support_of_node.assign(numbering.n_local(), -1);
    for (auto &[node, support] : found)
      {
        support.node                 = node;
        fields.support_of_node[node] = fields.supports.size();
        fields.supports.push_back(support);
      }
    scale_density(false);
  }



  template <int dim>
  bool
  Conditions<dim>::has_far_field() const
  {
    return std::any_of(scene.supports.begin(),
                       scene.supports.end(),
                       [](const auto &s) { return s->is_far_field(); });
  }



  template <int dim>
  void
  Conditions<dim>::release_far_field()
  {
    if (!has_far_field() || is_far_field_free)
      return;
    set_up_far_field();
    // what the boundary carries now stays as a dead load
    far_field_force.assign(dim * numbering.n_owned(), 0.);
    for (const auto &spring : fields.far_field.springs)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = dim * spring.node + d;
          far_field_force[i]   = fields.internal_force[i] - fields.load[i];
        }
    is_far_field_free = true;
    is_load_set       = false;
    set_up_supports();
    if (is_root() && !fields.far_field.is_coupled())
      std::cout << "Rock    the far field does not enclose its centre: springs "
                   "only"
                << std::endl;
  }



  template <int dim>
  void
  Conditions<dim>::set_up_far_field()
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<typename FarField<dim>::Face> faces;
    for (const auto &support : scene.supports)
      if (support->is_far_field())
        for (const std::string &name : support->boundaries)
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              if (mesh.is_on(c, f, name) && mesh.excavation_stage[c] != 1)
                {
                  const Material<dim> &rock =
                    *scene.materials[mesh.material[c]];
                  faces.push_back({mesh.face_vertices(c, f),
                                   mesh.face_center(c, f),
                                   mesh.face_area_vector(c, f),
                                   support->center,
                                   rock.lame_lambda(),
                                   rock.shear_modulus()});
                }
    fields.far_field = FarField<dim>(faces, split, numbering);
  }



  template <int dim>
  void
  Conditions<dim>::bound_step_by_far_field()
  {
    stable_step.frequency =
      std::sqrt(stable_step.frequency * stable_step.frequency +
                fields.far_field.frequency_bound(fields.inverse_mass));
  }



  template <int dim>
  void
  Conditions<dim>::apply_supports(const double time, const double step)
  {
    // increment of a displacement that is reached at the end of the ramp
    const double ramp_rate =
      (share_left_at(ramp_progress) -
       share_left_at(std::min(1., ramp_progress + next_progress(step)))) /
      step;
    for (const NodeSupport<dim> &support : fields.supports)
      {
        if (support.node >= numbering.n_owned())
          continue;
        double *v = fields.velocity.data() + dim * support.node;
        Tensor<1, dim> prescribed;
        if (support.motion >= 0)
          {
            Point<dim> place;
            for (int d = 0; d < dim; ++d)
              place[d] = fields.reference[dim * support.node + d];
            prescribed =
              is_displacement[support.motion]
                ? ramp_rate * motions[support.motion]->vector(place, 0.)
                : motions[support.motion]->vector(place, time + 0.5 * step);
          }
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
  Conditions<dim>::remove_held_components(std::vector<double> &force) const
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
  Conditions<dim>::prescribed_displacement(const NodeSupport<dim> &s) const
  {
    Tensor<1, dim> result;
    if (s.motion < 0 || !is_displacement[s.motion])
      return result;
    Point<dim> place;
    for (int d = 0; d < dim; ++d)
      place[d] = fields.reference[dim * s.node + d];
    return motions[s.motion]->vector(place, 0.);
  }

  template void Conditions<2>::set_up_supports();
  template void Conditions<3>::set_up_supports();
  template bool Conditions<2>::has_far_field() const;
  template bool Conditions<3>::has_far_field() const;
  template void Conditions<2>::set_up_far_field();
  template void Conditions<3>::set_up_far_field();
  template void Conditions<2>::release_far_field();
  template void Conditions<3>::release_far_field();
  template void Conditions<2>::bound_step_by_far_field();
  template void Conditions<3>::bound_step_by_far_field();
  template void Conditions<2>::apply_supports(const double, const double);
  template void Conditions<3>::apply_supports(const double, const double);
  template void
  Conditions<2>::remove_held_components(std::vector<double> &) const;
  template void
  Conditions<3>::remove_held_components(std::vector<double> &) const;
  template Tensor<1, 2>
  Conditions<2>::prescribed_displacement(const NodeSupport<2> &) const;
  template Tensor<1, 3>
  Conditions<3>::prescribed_displacement(const NodeSupport<3> &) const;
} // namespace Keyblock

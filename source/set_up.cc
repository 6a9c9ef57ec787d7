// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/set_up.h>

#include <keyblock/cell_geometry.h>
#include <keyblock/mpi.h>

#include <cmath>
#include <limits>
#include <regex>

namespace Keyblock
{
  namespace
  {
    bool
    depends_on_time(const std::string &formula)
    {
      return std::regex_search(formula, std::regex("\\bt\\b"));
    }

    template <int dim>
    Corners<dim, double>
    corners_of(const Mesh<dim> &mesh, const unsigned int cell)
    {
      Corners<dim, double> corners;
      for (int v = 0; v < (1 << dim); ++v)
        for (int d = 0; d < dim; ++d)
          corners[v][d] = mesh.vertices[mesh.cells[cell][v]][d];
      return corners;
    }

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
  double
  StableStep<dim>::limit(const Stage &stage) const
  {
    // y = omega dt / 2 with (1 + alpha) (y^2 + 2 c y) = 1
    const double c = stage.damping_ratio + 0.5 * stage.mass_damping / frequency;
    return 2. / frequency *
           (std::sqrt(c * c + 1. / (1. + stage.local_damping)) - c);
  }



  template <int dim>
  Conditions<dim>::Conditions(const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Numbering<dim> &numbering,
                              CellArrays<dim> &cells,
                              Fields<dim> &fields)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
  {
    const std::size_t n_dofs = std::size_t(dim) * numbering.n_local();
    for (auto *field : {&fields.reference,
                        &fields.displacement,
                        &fields.velocity,
                        &fields.old_velocity,
                        &fields.internal_force,
                        &fields.load,
                        &fields.contact_force})
      field->assign(n_dofs, 0.);
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.reference[dim * node + d] =
          split.mesh.vertices[numbering.vertex_of_node[node]][d];
    fields.is_in_cluster.assign(numbering.n_local(), 0);
    set_up_cells();
    set_up_mass();
    set_up_supports();
    set_up_tractions();
    set_up_initial_state();
    if (scene.time_stepping.is_large())
      {
        fields.position = fields.reference;
        fields.rate     = fields.velocity;
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_cells()
  {
    const unsigned int n = numbering.cell_nodes.size();
    cells.nodes          = numbering.cell_nodes;
    cells.stress.assign(std::size_t(n) * (1 << dim) * n_stress<dim>, 0.);
    cells.beta.assign(n, 0.);
    frequency.resize(n);
    Corners<dim, double> last_edges{};
    unsigned int last_material = none;
    double highest             = 0.;
    unsigned int highest_cell  = none;
    for (unsigned int c = 0; c < n; ++c)
      {
        const unsigned int mesh_cell  = numbering.mesh_cell[c];
        const unsigned int m          = split.mesh.material[mesh_cell];
        const Material<dim> &material = *scene.materials[m];
        cells.lambda.push_back(material.lame_lambda());
        cells.mu.push_back(material.shear_modulus());
        // congruent cells, as in structured meshes, have equal frequencies
        const auto corners = corners_of(split.mesh, mesh_cell);
        auto edges         = corners;
        bool is_congruent  = m == last_material;
        for (int v = 0; v < (1 << dim); ++v)
          for (int d = 0; d < dim; ++d)
            edges[v][d] -= corners[0][d];
        for (int v = 0; v < (1 << dim) && is_congruent; ++v)
          for (int d = 0; d < dim; ++d)
            is_congruent = is_congruent &&
                           std::abs(edges[v][d] - last_edges[v][d]) <
                             1e-12 * std::abs(edges[(1 << dim) - 1][d]) + 1e-14;
        frequency[c]  = is_congruent ? frequency[c - 1]
                                     : highest_frequency<dim>(corners,
                                                             cells.lambda[c],
                                                             cells.mu[c],
                                                             material.density);
        last_edges    = edges;
        last_material = m;
        if (frequency[c] > highest)
          {
            highest      = frequency[c];
            highest_cell = mesh_cell;
          }
      }
    stable_step.frequency   = dealii::Utilities::MPI::max(highest, world());
    const unsigned int cell = dealii::Utilities::MPI::min(
      highest == stable_step.frequency ? highest_cell : none, world());
    if (cell != none)
      stable_step.place = split.mesh.cell_center(cell);
  }



  template <int dim>
  void
  Conditions<dim>::set_up_mass()
  {
    std::vector<double> mass(dim * numbering.n_local(), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int mesh_cell = numbering.mesh_cell[c];
        const auto share             = lumped_mass<dim>(
          corners_of(split.mesh, mesh_cell),
          scene.materials[split.mesh.material[mesh_cell]]->density);
        for (int v = 0; v < (1 << dim); ++v)
          for (int d = 0; d < dim; ++d)
            mass[dim * cells.nodes[c][v] + d] += share[v];
      }
    numbering.add_ghosts_to_owners(mass);
    numbering.update_ghosts(mass);
    fields.mass.resize(numbering.n_local());
    fields.inverse_mass.resize(numbering.n_local());
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      {
        fields.mass[node] = mass[dim * node];
        fields.inverse_mass[node] =
          mass[dim * node] > 0. ? 1. / mass[dim * node] : 0.;
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_supports()
  {
    const Mesh<dim> &mesh = split.mesh;
    std::map<unsigned int, NodeSupport<dim>> found;
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
          }
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (mesh.material[c] == m)
            for (const unsigned int v : mesh.cells[c])
              {
                const unsigned int node = numbering.local_node(v);
                if (node == none)
                  continue;
                NodeSupport<dim> &support = found[node];
                hold_all(support);
                support.motion = motion;
              }
      }
    for (const auto &support : scene.supports)
      {
        int motion = -1;
        if (!support->velocity.empty())
          {
            motion = motions.size();
            motions.push_back(std::make_unique<Expression<dim>>(
              support->velocity, dim, "Supports/*/Velocity"));
          }
        unsigned int n_hits = 0;
        const auto hold     = [&](const unsigned int vertex,
                              const Tensor<1, dim> &normal) {
          ++n_hits;
          const unsigned int node = numbering.local_node(vertex);
          if (node == none)
            return;
          NodeSupport<dim> &entry = found[node];
          if (entry.is_fixed())
            return;
          if (support->directions == "normal")
            hold_direction(entry, normal);
          else
            for (int d = 0; d < dim; ++d)
              if (support->directions == "all" ||
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
              if (mesh.is_on(c, f, name))
                for (const unsigned int v : mesh.face_vertices(c, f))
                  hold(v,
                       mesh.face_area_vector(c, f) /
                         mesh.face_area_vector(c, f).norm());
        AssertThrow(n_hits > 0,
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
        if (support.is_fixed())
          fields.inverse_mass[node] = 0.;
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_tractions()
  {
    const Mesh<dim> &mesh = split.mesh;
    for (unsigned int t = 0; t < scene.tractions.size(); ++t)
      {
        const Traction<dim> &traction = *scene.tractions[t];
        tractions.push_back(std::make_unique<Expression<dim>>(
          traction.expression, dim, "Tractions/*/Traction"));
        is_load_constant =
          is_load_constant && !depends_on_time(traction.expression);
        const Expression<dim> inside(traction.region.empty() ? "-1"
                                                             : traction.region,
                                     1,
                                     "Tractions/*/Region");
        unsigned int n_hits = 0;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              if (mesh.neighbor[c][f] != none)
                continue;
              const Point<dim> center = mesh.face_center(c, f);
              bool is_loaded          = inside.value(center, 0., 0) > 0.;
              for (const std::string &name : traction.boundaries)
                is_loaded = is_loaded || mesh.is_on(c, f, name);
              if (!is_loaded)
                continue;
              ++n_hits;
              const double area =
                mesh.face_area_vector(c, f).norm() / Mesh<dim>::n_face_vertices;
              for (const unsigned int v : mesh.face_vertices(c, f))
                if (numbering.is_owned(v))
                  nodal_tractions.push_back(
                    {numbering.local_node(v), t, area, center});
            }
        AssertThrow(n_hits > 0,
                    InputError("The traction '" + traction.name +
                               "' loads no face; check 'Tractions/" +
                               traction.name +
                               "/Boundaries' or 'Region' against the domain."));
      }
    if (!scene.initial_state.gravity.empty())
      {
        gravity = std::make_unique<Expression<dim>>(scene.initial_state.gravity,
                                                    dim,
                                                    "Initial state/Gravity");
        is_load_constant =
          is_load_constant && !depends_on_time(scene.initial_state.gravity);
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_up_initial_state()
  {
    if (!scene.initial_state.stress.empty())
      {
        const Expression<dim> stress(scene.initial_state.stress,
                                     n_stress<dim>,
                                     "Initial state/Stress");
        for (unsigned int c = 0; c < cells.nodes.size(); ++c)
          for (int q = 0; q < (1 << dim); ++q)
            {
              Point<dim> place;
              for (int v = 0; v < (1 << dim); ++v)
                place +=
                  shape<dim>.value[q][v] *
                  split.mesh
                    .vertices[split.mesh.cells[numbering.mesh_cell[c]][v]];
              for (int k = 0; k < n_stress<dim>; ++k)
                cells.stress_of(c)[q * n_stress<dim> + k] =
                  stress.value(place, 0., k);
            }
      }
    if (!scene.initial_state.velocity.empty())
      {
        const Expression<dim> velocity(scene.initial_state.velocity,
                                       dim,
                                       "Initial state/Velocity");
        for (unsigned int node = 0; node < numbering.n_local(); ++node)
          if (fields.inverse_mass[node] > 0.)
            for (int d = 0; d < dim; ++d)
              fields.velocity[dim * node + d] = velocity.value(
                split.mesh.vertices[numbering.vertex_of_node[node]], 0., d);
      }
  }



  template <int dim>
  void
  Conditions<dim>::set_damping(const double damping_ratio)
  {
    for (unsigned int c = 0; c < frequency.size(); ++c)
      cells.beta[c] = 2. * damping_ratio / frequency[c];
    if (damping_ratio > 0.)
      fields.damping_force.assign(fields.velocity.size(), 0.);
  }



  template <int dim>
  void
  Conditions<dim>::set_load(const double time)
  {
    if (is_load_set && is_load_constant)
      return;
    is_load_set = true;
    Tensor<1, dim> g;
    if (gravity)
      g = gravity->vector(Point<dim>(), time);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.load[dim * node + d] = fields.mass[node] * g[d];
    for (const NodalTraction<dim> &entry : nodal_tractions)
      {
        const Tensor<1, dim> t =
          tractions[entry.traction]->vector(entry.place, time);
        for (int d = 0; d < dim; ++d)
          fields.load[dim * entry.node + d] += entry.area * t[d];
      }
  }



  template <int dim>
  void
  Conditions<dim>::apply_supports(const double time)
  {
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
            prescribed = motions[support.motion]->vector(place, time);
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

  template struct StableStep<2>;
  template struct StableStep<3>;
  template class Conditions<2>;
  template class Conditions<3>;
} // namespace Keyblock

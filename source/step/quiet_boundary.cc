// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/quiet_boundary.h>

#include <keyblock/blocks/nodal_areas.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  template <int dim>
  Tensor<2, dim>
  quiet_impedance(const Material<dim> &material, const Tensor<1, dim> &n)
  {
    const double shear = std::sqrt(material.density * material.shear_modulus());
    const double pressure =
      std::sqrt(material.density * material.p_wave_modulus());
    Tensor<2, dim> impedance = (pressure - shear) * outer_product(n, n);
    for (unsigned int d = 0; d < dim; ++d)
      impedance[d][d] += shear;
    return impedance;
  }



  template <int dim>
  QuietBoundary<dim>::QuietBoundary(const Scene<dim> &scene,
                                    const SplitMesh<dim> &split,
                                    const Numbering<dim> &numbering,
                                    const StageClock &clock)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , clock(clock)
    , material(split.mesh.material)
    , acts(scene.supports.size(), false)
    , free_field(scene, split, numbering)
    , dead_load(dim * numbering.n_owned(), 0.)
  {
    for (const auto &support : scene.supports)
      waves.push_back(!support->velocity.empty()
                        ? std::make_unique<Expression<dim>>(
                            support->velocity, dim, "Supports/*/Velocity")
                        : nullptr);
  }



  template <int dim>
  bool
  QuietBoundary<dim>::is_wanted(const Scene<dim> &scene)
  {
    return std::any_of(scene.supports.begin(),
                       scene.supports.end(),
                       [](const auto &s) { return s->is_quiet(); });
  }



  template <int dim>
  bool
  QuietBoundary<dim>::release(const unsigned int number,
                              const std::vector<double> &reaction)
  {
    std::vector<bool> is_new(acts.size(), false);
    for (unsigned int s = 0; s < acts.size(); ++s)
      if (scene.supports[s]->is_quiet() && !acts[s] &&
          scene.stage_number(scene.supports[s]->stage) <= number)
        acts[s] = is_new[s] = true;
    if (std::find(is_new.begin(), is_new.end(), true) == is_new.end())
      return false;
    find_dashpots();
    std::vector<bool> is_let_go(numbering.n_owned(), false);
    for (const Dashpot &dashpot : dashpots)
      if (is_new[dashpot.support])
        is_let_go[dashpot.node] = true;
    for (unsigned int node = 0; node < is_let_go.size(); ++node)
      if (is_let_go[node])
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          dead_load[i] += reaction[i];
    return true;
  }



  template <int dim>
  void
  QuietBoundary<dim>::take_ground(const Ground<dim> &ground)
  {
    for (unsigned int c = 0; c < material.size(); ++c)
      material[c] = ground.is_excavated(c) ? none : ground.material_of(c);
    free_field.take_ground(ground);
    find_dashpots();
  }



  template <int dim>
  void
  QuietBoundary<dim>::find_dashpots()
  {
    const Mesh<dim> &mesh = split.mesh;
    std::map<std::array<unsigned int, 2>, Dashpot> found; // by node, support
    for (unsigned int s = 0; s < acts.size(); ++s)
      if (acts[s])
        for (const std::string &name : scene.supports[s]->boundaries)
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              if (mesh.is_on(c, f, name) && material[c] != none &&
                  !scene.materials[material[c]]->is_rigid())
                {
                  const Tensor<1, dim> area = mesh.face_area_vector(c, f);
                  const Tensor<2, dim> impedance =
                    quiet_impedance(*scene.materials[material[c]],
                                    area / area.norm());
                  const auto areas    = nodal_areas(mesh, c, f);
                  const auto vertices = mesh.face_vertices(c, f);
                  for (unsigned int v = 0; v < vertices.size(); ++v)
                    for_each_owned_carrier(
                      split,
                      numbering,
                      vertices[v],
                      [&](const unsigned int node, const double weight) {
                        Dashpot &dashpot =
                          found
                            .try_emplace({{node, s}}, Dashpot{node, s, {}, 0.})
                            .first->second;
                        dashpot.impedance += weight * areas[v] * impedance;
                        dashpot.area += weight * areas[v];
                      });
                }
    dashpots.clear();
    at_nodes.clear();
    for (const auto &[place, dashpot] : found)
      {
        dashpots.push_back(dashpot);
        if (at_nodes.empty() || at_nodes.back().node != dashpot.node)
          at_nodes.push_back({dashpot.node, {}, {}});
        at_nodes.back().impedance += dashpot.impedance;
      }
    free_field.find_sides(acts, material, [this](const unsigned int node) {
      return std::lower_bound(at_nodes.begin(),
                              at_nodes.end(),
                              node,
                              [](const Node &entry, const unsigned int n) {
                                return entry.node < n;
                              }) -
             at_nodes.begin();
    });
  }



  template <int dim>
  std::vector<unsigned int>
  QuietBoundary<dim>::nodes() const
  {
    std::vector<unsigned int> list;
    for (const Node &entry : at_nodes)
      list.push_back(entry.node);
    return list;
  }



  template <int dim>
  bool
  QuietBoundary<dim>::is_viscous() const
  {
    return std::find(acts.begin(), acts.end(), true) != acts.end();
  }



  template <int dim>
  void
  QuietBoundary<dim>::add_damping_force(const MotionOfStep<dim> &motion,
                                        std::vector<double> &force)
  {
    const Fields<dim> &fields = motion.fields;
    if (!free_field.is_empty())
      free_field.advance(motion,
                         acts,
                         [this](const unsigned int support,
                                const Point<dim> &place,
                                const double time) {
                           return incoming(support, place, time);
                         });
    drive.assign(at_nodes.size(), Tensor<1, dim>());
    free_field.add_drive(drive);
    for (unsigned int i = 0; i < at_nodes.size(); ++i)
      {
        Node &entry              = at_nodes[i];
        const unsigned int first = dim * entry.node;
        const double half        = 0.5 * motion.kick;
        const double factor      = half * fields.inverse_mass[entry.node];
        Tensor<1, dim> middle; // the velocity then, without the dashpots
        for (unsigned int d = 0; d < dim; ++d)
          middle[d] =
            fields.velocity[first + d] * (1. - half * motion.mass_damping) +
            factor * (fields.load[first + d] + drive[i][d] -
                      fields.internal_force[first + d] - force[first + d]);
        Tensor<2, dim> slowed = factor * entry.impedance;
        for (unsigned int d = 0; d < dim; ++d)
          slowed[d][d] += 1.;
        entry.force = invert(slowed) * (entry.impedance * middle) - drive[i];
        for (unsigned int d = 0; d < dim; ++d)
          force[first + d] += entry.force[d];
      }
  }



  template <int dim>
  double
  QuietBoundary<dim>::damping_work(const Fields<dim> &fields,
                                   const double kick) const
  {
    double work = 0.;
    for (const Node &entry : at_nodes)
      for (unsigned int d = 0; d < dim; ++d)
        work += 0.5 * kick * entry.force[d] *
                (fields.old_velocity[dim * entry.node + d] +
                 fields.velocity[dim * entry.node + d]);
    return work;
  }



  template <int dim>
  Tensor<1, dim>
  QuietBoundary<dim>::incoming(const unsigned int support,
                               const Point<dim> &place,
                               const double time) const
  {
    if (clock.stands())
      return Tensor<1, dim>();
    if (waves[support])
      return waves[support]->vector(place, time);
    Tensor<1, dim> wave;
    if (const auto &history = scene.supports[support]->history)
      {
        const double since =
          clock.since(scene.history_stage(*scene.supports[support]), time);
        for (unsigned int d = 0; d < dim; ++d)
          wave[d] = history->value(since, d);
      }
    return wave;
  }



  template <int dim>
  bool
  QuietBoundary<dim>::is_load_changing() const
  {
    for (unsigned int s = 0; s < acts.size(); ++s)
      if (acts[s] && has_wave(s))
        return true;
    return false;
  }



  template <int dim>
  void
  QuietBoundary<dim>::add_load(const double time,
                               std::vector<double> &load) const
  {
    for (unsigned int i = 0; i < dead_load.size(); ++i)
      load[i] += dead_load[i];
    // a history is the same at all places
    std::vector<Tensor<1, dim>> of_history(acts.size());
    for (unsigned int s = 0; s < acts.size(); ++s)
      if (acts[s] && !waves[s])
        of_history[s] = incoming(s, Point<dim>(), time);
    for (const Dashpot &dashpot : dashpots)
      if (has_wave(dashpot.support))
        {
          const Point<dim> &place =
            split.mesh.vertices[numbering.vertex_of_node[dashpot.node]];
          const Tensor<1, dim> wave = waves[dashpot.support]
                                        ? incoming(dashpot.support, place, time)
                                        : of_history[dashpot.support];
          const Tensor<1, dim> force =
            lets_in_stress(*scene.supports[dashpot.support])
              ? dashpot.area * wave
              : dashpot.impedance * wave;
          for (unsigned int d = 0; d < dim; ++d)
            load[dim * dashpot.node + d] += 2. * force[d];
        }
  }



  template <int dim>
  ForceElementState
  QuietBoundary<dim>::remember() const
  {
    ForceElementState state{name(),
                            std::vector<double>(acts.begin(), acts.end()),
                            dead_load};
    const std::vector<double> ground = free_field.remember();
    state.numbers.insert(state.numbers.end(), ground.begin(), ground.end());
    return state;
  }



  template <int dim>
  void
  QuietBoundary<dim>::recall(const ForceElementState &state)
  {
    for (unsigned int s = 0; s < acts.size(); ++s)
      acts[s] = state.numbers.at(s) != 0.;
    dead_load = state.nodal;
    free_field.recall(state.numbers.data() + acts.size());
    find_dashpots();
  }



  template Tensor<2, 2> quiet_impedance(const Material<2> &,
                                        const Tensor<1, 2> &);
  template Tensor<2, 3> quiet_impedance(const Material<3> &,
                                        const Tensor<1, 3> &);
  template class QuietBoundary<2>;
  template class QuietBoundary<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/step/liner_mass.h>
#include <keyblock/step/structural_liner.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  template <int dim>
  StructuralLiners<dim>::StructuralLiners(const Scene<dim> &scene,
                                          const SplitMesh<dim> &split,
                                          const Numbering<dim> &numbering,
                                          const ActiveCells<dim> &active_cells)
    : scene(scene)
    , split(split)
    , numbering(numbering)
    , active_cells(active_cells)
  {
    for (unsigned int i = 0; i < split.liners.size(); ++i)
      if (scene.liners[i]->is_structural())
        {
          Lining lining;
          lining.liner = i;
          std::vector<unsigned int> vertices;
          for (const LinedFace<dim> &face : split.liners[i].faces)
            vertices.insert(vertices.end(),
                            face.vertices.begin(),
                            face.vertices.end());
          sort_unique(vertices);
          for (const unsigned int v : vertices)
            {
              lining.anchors.emplace_back();
              lining.anchors.back().vertex = v;
              for_each_owned_carrier(
                split,
                numbering,
                v,
                [&](const unsigned int node, const double weight) {
                  lining.anchors.back().carriers.emplace_back(node, weight);
                });
            }
          linings.push_back(std::move(lining));
        }
  }



  template <int dim>
  bool
  StructuralLiners<dim>::is_wanted(const Scene<dim> &scene)
  {
    return std::any_of(scene.liners.begin(),
                       scene.liners.end(),
                       [](const auto &liner) {
                         return liner->is_structural();
                       });
  }



  template <int dim>
  void
  StructuralLiners<dim>::take_ground(const Ground<dim> &ground)
  {
    for (Lining &lining : linings)
      {
        const bool is_sprayed =
          scene.stage_number(scene.liners[lining.liner]->stage) <=
          ground.stage_number;
        std::vector<bool> is_there;
        for (const LinedFace<dim> &face : split.liners[lining.liner].faces)
          is_there.push_back(is_sprayed && !ground.is_excavated(face.cell));
        if (is_there == lining.is_there)
          continue;
        lining.is_there = is_there;
        build(lining);
      }
    true_mass.assign(numbering.n_owned(), 0.);
    for (const Lining &lining : linings)
      add_liner_mass(ground, numbering, lining.liner, true_mass);
  }



  template <int dim>
  void
  StructuralLiners<dim>::build(Lining &lining) const
  {
    lining.points.clear();
    lining.anchors_of_point.clear();
    std::map<unsigned int, unsigned int> point_of; // by that of the layout
    std::map<unsigned int, double> area_of;        // by vertex
    std::map<unsigned int, unsigned int> place_of; // the same
    std::vector<LinedFace<dim>> faces;
    const auto &all = split.liners[lining.liner].faces;
    for (unsigned int f = 0; f < all.size(); ++f)
      if (lining.is_there[f])
        {
          faces.push_back(all[f]);
          for (unsigned int i = 0; i < LinedFace<dim>::n; ++i)
            {
              const unsigned int v = all[f].vertices[i];
              const auto [found, is_new] =
                point_of.try_emplace(all[f].points[i], lining.points.size());
              if (is_new)
                lining.points.push_back(split.mesh.vertices[v]);
              faces.back().points[i] = found->second;
              place_of[v]            = found->second;
              area_of[v] += all[f].area;
            }
        }
    std::vector<double> area(lining.points.size(), 0.);
    for (const auto &[v, part] : area_of)
      area[place_of[v]] += part;
    lining.anchors_of_point.resize(area.size());
    lining.is_mine.assign(area.size(), false);
    for (unsigned int a = 0; a < lining.anchors.size(); ++a)
      {
        Anchor &anchor = lining.anchors[a];
        anchor.share   = 0.;
        if (area_of.count(anchor.vertex) == 0)
          continue;
        anchor.point = place_of[anchor.vertex];
        anchor.share = area_of[anchor.vertex] / area[anchor.point];
        lining.anchors_of_point[anchor.point].push_back(a);
        for_each_owned(anchor, [&](const unsigned int, double) {
          lining.is_mine[anchor.point] = true;
        });
      }
    lining.is_present  = !faces.empty();
    const Liner &liner = *scene.liners[lining.liner];
    lining.shell       = LinerShell<dim>(LinerSection(liner.young_modulus,
                                                liner.poisson_ratio,
                                                liner.thickness),
                                   lining.points,
                                   faces);
    deal_out(lining);
  }



  template <int dim>
  std::vector<unsigned int>
  StructuralLiners<dim>::nodes() const
  {
    std::vector<unsigned int> list;
    for (const Lining &lining : linings)
      for (const Anchor &anchor : lining.anchors)
        if (anchor.share > 0.)
          for_each_owned(anchor, [&](const unsigned int node, double) {
            list.push_back(node);
          });
    sort_unique(list);
    return list;
  }



  template <int dim>
  void
  StructuralLiners<dim>::follow(const std::vector<double> &displacement)
  {
    std::vector<Tensor<1, dim>> all;
    for (const Lining &lining : linings)
      if (lining.is_present)
        for (const Anchor &anchor : lining.anchors)
          {
            all.emplace_back();
            for_each_owned(anchor,
                           [&](const unsigned int node, const double weight) {
                             for (unsigned int d = 0; d < dim; ++d)
                               all.back()[d] +=
                                 weight * displacement[dim * node + d];
                           });
          }
    numbering.communicator.sum(all.front().begin_raw(), dim * all.size());
    auto next = all.begin();
    for (Lining &lining : linings)
      if (lining.is_present)
        {
          for (Anchor &anchor : lining.anchors)
            {
              anchor.displacement = *next++;
              if (!lining.is_installed)
                anchor.rest = anchor.displacement;
            }
          lining.is_installed = true;
        }
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  StructuralLiners<dim>::displacements(const Lining &lining) const
  {
    std::vector<Tensor<1, dim>> result(lining.points.size());
    for (const Anchor &anchor : lining.anchors)
      if (anchor.share > 0.)
        result[anchor.point] +=
          anchor.share * (anchor.displacement - anchor.rest);
    return result;
  }



  template <int dim>
  void
  StructuralLiners<dim>::add_force(const std::vector<double> &displacement,
                                   std::vector<double> &force)
  {
    // the same on every rank
    if (std::none_of(linings.begin(), linings.end(), [](const Lining &l) {
          return l.is_present;
        }))
      return;
    follow(displacement);
    for (const Lining &lining : linings)
      if (lining.is_present)
        {
          const std::vector<Tensor<1, dim>> moved = displacements(lining);
          for (unsigned int p = 0; p < moved.size(); ++p)
            if (lining.is_mine[p])
              {
                const Tensor<1, dim> held = lining.shell.force_at(p, moved);
                for (const unsigned int a : lining.anchors_of_point[p])
                  for_each_owned(lining.anchors[a],
                                 [&](const unsigned int node,
                                     const double weight) {
                                   for (unsigned int d = 0; d < dim; ++d)
                                     force[dim * node + d] +=
                                       weight * lining.anchors[a].share *
                                       held[d];
                                 });
              }
        }
  }



  template <int dim>
  double
  StructuralLiners<dim>::stored_energy(const std::vector<double> &) const
  {
    double twice = 0.;
    if (numbering.communicator.is_root())
      for (const Lining &lining : linings)
        if (lining.is_present)
          {
            const std::vector<Tensor<1, dim>> moved = displacements(lining);
            for (unsigned int p = 0; p < moved.size(); ++p)
              twice += moved[p] * lining.shell.force_at(p, moved);
          }
    return 0.5 * twice;
  }



  template <int dim>
  ForceElementState
  StructuralLiners<dim>::remember() const
  {
    ForceElementState state{name(), {}, {}};
    for (const Lining &lining : linings)
      for_each_number(lining, [&](const double number) {
        state.numbers.push_back(number);
      });
    return state;
  }



  template <int dim>
  void
  StructuralLiners<dim>::recall(const ForceElementState &state)
  {
    std::size_t at = 0;
    for (Lining &lining : linings)
      for_each_number(lining,
                      [&](auto &number) { number = state.numbers.at(at++); });
  }



  template <int dim>
  std::vector<LinerLoads<dim>>
  StructuralLiners<dim>::report() const
  {
    std::vector<LinerLoads<dim>> reports;
    for (const Lining &lining : linings)
      if (lining.is_present && lining.is_installed)
        {
          LinerLoads<dim> report;
          report.liner        = lining.liner;
          report.points       = lining.points;
          report.displacement = displacements(lining);
          report.forces       = lining.shell.forces(report.displacement);
          report.faces        = lining.shell.faces();
          const auto &all     = split.liners[lining.liner].faces;
          for (unsigned int f = 0; f < all.size(); ++f)
            if (lining.is_there[f])
              report.areas.push_back(all[f].area);
          for (const LinerForce<dim> &force : report.forces)
            report.checks.push_back(
              check_section(*scene.liners[lining.liner], force));
          reports.push_back(std::move(report));
        }
    return reports;
  }

  template class StructuralLiners<2>;
  template class StructuralLiners<3>;
} // namespace Keyblock

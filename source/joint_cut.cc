// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/joint_cut.h>

#include <keyblock/disjoint_sets.h>
#include <keyblock/joint_extent.h>
#include <keyblock/mesh_improvement.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    // All lengths over the target size, all qualities as SimplexMesh::quality.

    /** A cell is cut if the joint reaches so far into it; where it touches
     * another surface also if the joint ends so far before it. */
    constexpr double least_reach = 0.1, closing = 0.35;

    /** A vertex is not moved onto a joint if a cell falls below this. */
    constexpr double least_quality_of_snap = 0.2;

    /** Patches of a joint between other surfaces are dropped if less of them
     * lies inside its rim; from the second on their edges close. */
    constexpr double least_part_inside = 0.3, part_that_closes = 0.5;

    /** Pieces of less than this part of a cell go to a neighbour. */
    constexpr double crumb = 0.2;

    /** How far a collapse may lead a joint astray. */
    constexpr double allowed_bend = 0.1;

    /** Cells below these are mended: before and at the end, and the new ones
     * of one joint. */
    constexpr double wanted_quality = 0.35, wanted_between = 0.25;

    /** Joints are put back into their planes where cells stay as good. */
    constexpr double least_quality_of_flattening = 0.2;

    /** Volume of a regular cell of unit edge [-]. */
    template <int dim>
    constexpr double unit_volume = (dim == 2) ? 0.433 : 0.1179;



    /** Cuts one joint into the mesh. */
    template <int dim>
    class Insertion
    {
    public:
      Insertion(SimplexMesh<dim> &mesh,
                const unsigned int surface,
                const JointExtent<dim> &extent,
                const double snap)
        : mesh(mesh)
        , surface(surface)
        , extent(extent)
        , snap(snap)
      {
        distance.reserve(mesh.vertices.size());
        for (const Point<dim> &p : mesh.vertices)
          {
            distance.push_back(extent.distance(p));
            side.push_back(distance.back() > 0. ? 1 : -1);
          }
      }

      void
      run()
      {
        move_vertices();
        split_edges();
        mark_facets();
      }

    private:
      using Cell  = typename SimplexMesh<dim>::Cell;
      using Facet = typename SimplexMesh<dim>::Facet;

      bool
      has_two_sides(const Cell &cell) const
      {
        bool has_plus = false, has_minus = false;
        for (const unsigned int v : cell.vertices)
          {
            has_plus |= side[v] > 0;
            has_minus |= side[v] < 0;
          }
        return has_plus && has_minus;
      }

      /** Where on the edge from @p a to @p b the joint crosses, from 0 to 1. */
      double
      crossing(const unsigned int a, const unsigned int b) const
      {
        const double below = std::abs(distance[a]),
                     above = std::abs(distance[b]);
        return below + above > 0. ? below / (below + above) : 0.5;
      }

      /** Whether the joint's extent reaches into a cell with two sides. */
      bool
      reaches_into(const Cell &cell) const
      {
        if (extent.is_infinite())
          return true;
        bool touches_other = false;
        for (const unsigned int v : cell.vertices)
          touches_other |= !mesh.bound_to[v].empty();
        const double margin = (touches_other ? -closing : least_reach) *
                              mesh.size_at(cell.vertices);
        Point<dim> sum;
        unsigned int n  = 0;
        const auto look = [&](const Point<dim> &p) {
          sum += p;
          ++n;
          return extent.depth_inside(p) > margin;
        };
        for (unsigned int i = 0; i <= dim; ++i)
          {
            const unsigned int a = cell.vertices[i];
            if (side[a] == 0 && look(mesh.vertices[a]))
              return true;
            for (unsigned int j = 0; j < i; ++j)
              {
                const unsigned int b = cell.vertices[j];
                if (side[a] * side[b] < 0 &&
                    look(mesh.vertices[a] +
                         crossing(a, b) *
                           (mesh.vertices[b] - mesh.vertices[a])))
                  return true;
              }
          }
        return extent.depth_inside(sum / n) > 0.;
      }

      /** Put vertices that are near onto the joint, the nearest first. */
      void
      move_vertices()
      {
        std::set<std::pair<double, unsigned int>> near;
        for (const Cell &cell : mesh.cells)
          {
            if (!cell.is_alive)
              continue;
            const bool is_cut = has_two_sides(cell) && reaches_into(cell);
            for (const unsigned int v : cell.vertices)
              {
                const double relative =
                  std::abs(distance[v]) / mesh.target_size[v];
                if (relative < snap &&
                    (is_cut || extent.depth_inside(mesh.vertices[v]) > 0.))
                  near.insert({relative, v});
              }
          }
        for (const auto &[relative, v] : near)
          if (!would_flatten_a_cell(v))
            {
              side[v] = 0;
              move_onto_joint(v);
            }
      }

      /** Whether all other vertices of some cell there lie on the joint: then
       * it would no longer be the facets between cells of two sides. */
      bool
      would_flatten_a_cell(const unsigned int v) const
      {
        for (const unsigned int cell : mesh.cells_at[v])
          {
            unsigned int n_on_joint = 0;
            for (const unsigned int w : mesh.cells[cell].vertices)
              n_on_joint += w != v && side[w] == 0;
            if (n_on_joint == dim)
              return true;
          }
        return false;
      }

      void
      move_onto_joint(const unsigned int v)
      {
        if (mesh.is_fixed[v] ||
            std::abs(distance[v]) < 1e-12 * mesh.target_size[v])
          return;
        const Tensor<1, dim> way =
          SimplexMesh<dim>::free_part(extent.normal, mesh.locked_directions(v));
        if (way.norm_square() < 0.1)
          return;
        const Point<dim> old = mesh.vertices[v];
        const double before  = mesh.least_quality_at(v);
        mesh.vertices[v] -= distance[v] / way.norm_square() * way;
        mesh.return_to_circles(v);
        if (mesh.least_quality_at(v) < std::min(least_quality_of_snap, before))
          mesh.vertices[v] = old;
        else
          distance[v] = extent.distance(mesh.vertices[v]);
      }

      /** Bisect the edges between the two sides, the longest first. */
      void
      split_edges()
      {
        std::set<std::pair<unsigned int, unsigned int>> crossed;
        for (const Cell &cell : mesh.cells)
          if (cell.is_alive && has_two_sides(cell) && reaches_into(cell))
            for (unsigned int i = 0; i <= dim; ++i)
              for (unsigned int j = 0; j < i; ++j)
                if (side[cell.vertices[i]] * side[cell.vertices[j]] < 0)
                  crossed.insert(
                    std::minmax(cell.vertices[i], cell.vertices[j]));
        std::vector<std::pair<double, std::pair<unsigned int, unsigned int>>>
          order;
        for (const auto &[a, b] : crossed)
          order.push_back(
            {-mesh.vertices[a].distance(mesh.vertices[b]), {a, b}});
        std::sort(order.begin(), order.end());
        for (const auto &[minus_length, edge] : order)
          {
            const auto [a, b] = edge;
            const double size =
              0.5 * (mesh.target_size[a] + mesh.target_size[b]);
            // neither part becomes much shorter than vertices are moved
            const double least = snap * std::min(1., -size / minus_length);
            const double part  = std::clamp(crossing(a, b), least, 1. - least);
            const unsigned int middle =
              mesh.split_edge(a,
                              b,
                              mesh.vertices[a] +
                                part * (mesh.vertices[b] - mesh.vertices[a]));
            mesh.return_to_circles(middle);
            side.push_back(0);
            distance.push_back(extent.distance(mesh.vertices[middle]));
          }
      }

      /** The joint is what lies between cells of different sides. */
      void
      mark_facets()
      {
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          {
            if (!mesh.cells[c].is_alive)
              continue;
            unsigned int n_on_joint = 0, apex = 0;
            for (unsigned int i = 0; i <= dim; ++i)
              if (side[mesh.cells[c].vertices[i]] == 0)
                ++n_on_joint;
              else
                apex = i;
            if (n_on_joint != dim || side[mesh.cells[c].vertices[apex]] < 0)
              continue;
            const unsigned int other = mesh.neighbor(c, apex);
            if (other == no_index)
              continue;
            bool is_between = false;
            for (const unsigned int v : mesh.cells[other].vertices)
              is_between |= side[v] < 0;
            if (is_between)
              mesh.add_mark(mesh.facet(c, apex),
                            {surface, mesh.is_on_positive_side(c, apex)});
          }
      }

      SimplexMesh<dim> &mesh;
      const unsigned int surface;
      const JointExtent<dim> &extent;
      const double snap;
      std::vector<double> distance;
      std::vector<signed char> side; ///< of each vertex: -1, +1; 0: on it
    };



    /** The edges (3D) or ends (2D) of a facet. */
    template <int dim, typename Action>
    void
    for_each_ridge(const typename SimplexMesh<dim>::Facet &facet,
                   const Action &action)
    {
      if constexpr (dim == 2)
        for (const unsigned int v : facet)
          action(std::array<unsigned int, 1>{{v}});
      else
        for (unsigned int i = 0; i < 3; ++i)
          action(std::array<unsigned int, 2>{
            {facet[i == 0 ? 1 : 0], facet[i == 2 ? 1 : 2]}});
    }



    /**
     * Drop what cuts beyond the joints' rims. A joint falls into patches
     * between other surfaces: a patch mostly outside (a flap behind the surface
     * that the joint ends on) goes as a whole, unless none is larger inside; of
     * the others each facet stays whose centre is inside, and beside another
     * surface also those that close a small gap.
     */
    template <int dim>
    class Trim
    {
    public:
      Trim(SimplexMesh<dim> &mesh, const std::vector<JointExtent<dim>> &extents)
        : mesh(mesh)
        , extents(extents)
      {
        for (const Facet &facet : mesh.marked_facets())
          for (const auto &mark : mesh.marks.at(facet))
            {
              facets_of[mark.surface].push_back(facet);
              for_each_ridge<dim>(facet, [&](const Ridge &ridge) {
                auto &list = surfaces_at[ridge];
                if (std::find(list.begin(), list.end(), mark.surface) ==
                    list.end())
                  list.push_back(mark.surface);
              });
            }
      }

      void
      run()
      {
        for (const auto &[surface, facets] : facets_of)
          if (mesh.surfaces[surface].is_joint() &&
              !extents[mesh.surfaces[surface].joint].is_infinite())
            trim(surface, facets);
        mesh.bind_vertices();
      }

    private:
      using Facet = typename SimplexMesh<dim>::Facet;
      using Ridge = std::array<unsigned int, dim - 1>;

      void
      trim(const unsigned int surface, const std::vector<Facet> &facets)
      {
        const JointExtent<dim> &extent = extents[mesh.surfaces[surface].joint];
        DisjointSets patches(facets.size());
        std::vector<bool> is_junction(facets.size(), false);
        std::map<Ridge, unsigned int> first_at;
        for (unsigned int i = 0; i < facets.size(); ++i)
          for_each_ridge<dim>(facets[i], [&](const Ridge &ridge) {
            if (surfaces_at.at(ridge).size() > 1)
              is_junction[i] = true;
            else
              {
                const auto entry = first_at.emplace(ridge, i).first;
                patches.join(i, entry->second);
              }
          });
        struct Patch
        {
          double area = 0., area_inside = 0.;
        };
        std::map<unsigned int, Patch> patch_of_root;
        std::map<unsigned int, double> inside;
        for (unsigned int i = 0; i < facets.size(); ++i)
          {
            inside[i]         = extent.depth_inside(mesh.center(facets[i]));
            Patch &patch      = patch_of_root[patches.root(i)];
            const double area = mesh.measure(facets[i]);
            patch.area += area;
            patch.area_inside += inside[i] > 0. ? area : 0.;
          }
        const Patch *largest = nullptr;
        for (const auto &[root, patch] : patch_of_root)
          if (!largest || patch.area_inside > largest->area_inside)
            largest = &patch;
        for (unsigned int i = 0; i < facets.size(); ++i)
          {
            const Patch &patch = patch_of_root[patches.root(i)];
            const double part =
              &patch == largest ? 1. : patch.area_inside / patch.area;
            const double limit = is_junction[i] && part >= part_that_closes
                                   ? -closing * mesh.size_at(facets[i])
                                   : 0.;
            if (part < least_part_inside || inside[i] <= limit)
              drop(facets[i], surface);
          }
      }

      void
      drop(const Facet &facet, const unsigned int surface)
      {
        const auto entry = mesh.marks.find(facet);
        auto &list       = entry->second;
        list.erase(std::remove_if(list.begin(),
                                  list.end(),
                                  [surface](const auto &mark) {
                                    return mark.surface == surface;
                                  }),
                   list.end());
        if (list.empty())
          mesh.marks.erase(entry);
      }

      SimplexMesh<dim> &mesh;
      const std::vector<JointExtent<dim>> &extents;
      std::map<unsigned int, std::vector<Facet>> facets_of;
      std::map<Ridge, std::vector<unsigned int>> surfaces_at;
    };



    /** Pieces of the mesh between marked facets. */
    template <int dim>
    struct Pieces
    {
      std::vector<unsigned int> of_cell;
      std::vector<double> volume, wanted_volume;
      std::vector<Point<dim>> center;

      explicit Pieces(const SimplexMesh<dim> &mesh)
        : of_cell(mesh.cells.size(), no_index)
      {
        for (unsigned int seed = 0; seed < mesh.cells.size(); ++seed)
          if (mesh.cells[seed].is_alive && of_cell[seed] == no_index)
            fill(mesh, seed);
      }

    private:
      void
      fill(const SimplexMesh<dim> &mesh, const unsigned int seed)
      {
        const unsigned int piece = volume.size();
        double total = 0., size = 0.;
        unsigned int n_cells = 0;
        Tensor<1, dim> moment;
        std::vector<unsigned int> open = {seed};
        of_cell[seed]                  = piece;
        while (!open.empty())
          {
            const unsigned int c = open.back();
            open.pop_back();
            const auto &cell  = mesh.cells[c].vertices;
            const double part = mesh.volume(cell);
            total += part;
            size += mesh.size_at(cell);
            ++n_cells;
            for (const unsigned int v : cell)
              moment += part / (dim + 1) * mesh.vertices[v];
            for (unsigned int i = 0; i <= dim; ++i)
              if (mesh.marks.count(mesh.facet(c, i)) == 0)
                {
                  const unsigned int other = mesh.neighbor(c, i);
                  if (other != no_index && of_cell[other] == no_index)
                    {
                      of_cell[other] = piece;
                      open.push_back(other);
                    }
                }
          }
        volume.push_back(total);
        wanted_volume.push_back(unit_volume<dim> *
                                std::pow(size / n_cells, dim));
        center.push_back(Point<dim>(moment / total));
      }
    };



    /** Let pieces below a part of a cell join the neighbour with which they
     * share most area of joints. */
    template <int dim>
    bool
    dissolve_crumbs(SimplexMesh<dim> &mesh, MeshReport<dim> &report)
    {
      const Pieces<dim> pieces(mesh);
      using Pair  = std::pair<unsigned int, unsigned int>;
      using Facet = typename SimplexMesh<dim>::Facet;
      std::map<Pair, double> common;
      std::vector<std::pair<Facet, Pair>> facets;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        if (mesh.cells[c].is_alive)
          for (unsigned int i = 0; i <= dim; ++i)
            {
              const Facet facet = mesh.facet(c, i);
              const auto found  = mesh.marks.find(facet);
              if (found == mesh.marks.end() ||
                  std::any_of(found->second.begin(),
                              found->second.end(),
                              [&mesh](const auto &mark) {
                                return !mesh.surfaces[mark.surface].is_joint();
                              }))
                continue;
              const unsigned int other = mesh.neighbor(c, i);
              const Pair pair =
                std::minmax(pieces.of_cell[c], pieces.of_cell[other]);
              if (other < c || pair.first == pair.second)
                continue;
              common[pair] += mesh.measure(facet);
              facets.push_back({facet, pair});
            }
      std::set<Pair> dissolved;
      for (unsigned int p = 0; p < pieces.volume.size(); ++p)
        {
          if (pieces.volume[p] > crumb * pieces.wanted_volume[p])
            continue;
          double largest = 0.;
          Pair best;
          for (const auto &[pair, area] : common)
            {
              const unsigned int other =
                pair.first == p ? pair.second : pair.first;
              if ((pair.first == p || pair.second == p) && area > largest &&
                  pieces.volume[other] > pieces.volume[p])
                {
                  largest = area;
                  best    = pair;
                }
            }
          if (largest == 0.)
            continue;
          dissolved.insert(best);
          ++report.n_lost_blocks;
          if (pieces.volume[p] > report.largest_lost_volume)
            {
              report.largest_lost_volume = pieces.volume[p];
              report.largest_lost_place  = pieces.center[p];
            }
        }
      for (const auto &[facet, pair] : facets)
        if (dissolved.count(pair) > 0)
          mesh.marks.erase(facet);
      if (!dissolved.empty())
        mesh.bind_vertices();
      return !dissolved.empty();
    }



    template <int dim>
    void
    measure_shifts(const SimplexMesh<dim> &mesh,
                   const double coarsening,
                   MeshReport<dim> &report)
    {
      std::vector<double> shifts, shifts_in_cells;
      for (const auto &facet : mesh.marked_facets())
        {
          for (const auto &mark : mesh.marks.at(facet))
            if (mesh.surfaces[mark.surface].is_joint())
              {
                for (const unsigned int v : facet)
                  {
                    shifts.push_back(std::abs(
                      mesh.surfaces[mark.surface].distance(mesh.vertices[v])));
                    shifts_in_cells.push_back(shifts.back() * coarsening /
                                              mesh.target_size[v]);
                  }
              }
        }
      if (shifts.empty())
        return;
      std::sort(shifts.begin(), shifts.end());
      std::sort(shifts_in_cells.begin(), shifts_in_cells.end());
      const std::size_t at_99       = shifts.size() * 99 / 100;
      report.largest_shift          = shifts.back();
      report.largest_shift_in_cells = shifts_in_cells.back();
      report.percentile_99          = shifts[at_99];
      report.percentile_99_in_cells = shifts_in_cells[at_99];
    }



    /** Tells which joints reach into the model: of those without facets
     * whether they are too small or outside, and of the others that lie wholly
     * in its box how much of their area they have. */
    template <int dim>
    void
    look_for_joints(const SimplexMesh<dim> &mesh,
                    const std::vector<JointExtent<dim>> &extents,
                    MeshReport<dim> &report)
    {
      std::vector<double> area(extents.size(), 0.);
      for (const auto &facet : mesh.marked_facets())
        for (const auto &mark : mesh.marks.at(facet))
          if (mesh.surfaces[mark.surface].is_joint())
            area[mesh.surfaces[mark.surface].joint] += mesh.measure(facet);
      Point<dim> low = mesh.vertices[0], high = low;
      for (const Point<dim> &p : mesh.vertices)
        for (unsigned int d = 0; d < dim; ++d)
          {
            low[d]  = std::min(low[d], p[d]);
            high[d] = std::max(high[d], p[d]);
          }
      const auto is_in_box = [&](const Point<dim> &p) {
        bool is_inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_inside = is_inside && p[d] > low[d] && p[d] < high[d];
        return is_inside;
      };
      double found = 0., wanted = 0.;
      for (unsigned int j = 0; j < extents.size(); ++j)
        {
          std::vector<Point<dim>> places;
          if (!extents[j].is_infinite())
            places = extents[j].outermost_points();
          const unsigned int n_inside =
            std::count_if(places.begin(), places.end(), is_in_box);
          if (area[j] == 0.)
            (n_inside > 0 ? report.lost : report.outside).push_back(j);
          if (!places.empty() && n_inside == places.size())
            {
              found += area[j];
              wanted += extents[j].area();
            }
        }
      if (wanted > 0.)
        report.area_ratio = found / wanted;
    }
  } // namespace



  template <int dim>
  MeshReport<dim>
  cut_joints(SimplexMesh<dim> &mesh,
             const Scene<dim> &scene,
             const double snap,
             const double coarsening)
  {
    MeshReport<dim> report;
    report.way = "cut";
    MeshImprovement<dim> improvement(mesh, allowed_bend);
    improvement.improve(wanted_quality, 3);
    std::vector<JointExtent<dim>> extents;
    extents.reserve(scene.joints.size());
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      {
        extents.emplace_back(*scene.joints[j]);
        const unsigned int first_cell = mesh.cells.size();
        mesh.surfaces.push_back({extents[j].origin, extents[j].normal, 0., j});
        Insertion<dim>(mesh, mesh.surfaces.size() - 1, extents[j], snap).run();
        improvement.improve(wanted_between, 1, first_cell);
      }
    Trim<dim>(mesh, extents).run();
    while (dissolve_crumbs(mesh, report))
      ;
    improvement.improve(wanted_quality, 8);
    improvement.flatten(least_quality_of_flattening);
    improvement.improve(wanted_quality, 2);
    improvement.flatten(least_quality_of_flattening);

    measure_shifts(mesh, coarsening, report);
    look_for_joints(mesh, extents, report);
    return report;
  }

  template MeshReport<2>
  cut_joints(SimplexMesh<2> &, const Scene<2> &, const double, const double);
  template MeshReport<3>
  cut_joints(SimplexMesh<3> &, const Scene<3> &, const double, const double);
} // namespace Keyblock

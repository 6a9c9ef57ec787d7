// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/joint_cut_steps.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** A cell is cut if the joint reaches so far into it, over the target size;
     * where it touches another surface also if the joint ends `closing` before
     * it. */
    constexpr double least_reach = 0.1;

    /** A vertex is not moved onto a joint if a cell falls below this. */
    constexpr double least_quality_of_snap = 0.2;

    /** A vertex that stays so far off the joint that it is said to lie on,
     * over the target size, loses rock there; fewer of them are the tip of a
     * wedge. */
    constexpr double least_loss         = 0.02;
    constexpr unsigned int least_losses = 2;

    /** A corner of the model stays where it is: only joints that pass nearer
     * than this, over the target size, go through it. */
    constexpr double through_corner = 0.01;

    /** Sine up to which a joint and an outline are nearly parallel. */
    constexpr double nearly_parallel = 0.1;



    /** Cuts one joint into the mesh. */
    template <int dim>
    class Insertion
    {
    public:
      Insertion(SimplexMesh<dim> &mesh,
                const unsigned int surface,
                const JointSheet<dim> &sheet,
                const SnapDistance<dim> &snap,
                MeshReport<dim> &report)
        : mesh(mesh)
        , surface(surface)
        , sheet(sheet)
        , snap(snap)
        , report(report)
      {
        distance.reserve(mesh.vertices.size());
        for (const Point<dim> &p : mesh.vertices)
          {
            distance.push_back(sheet.distance(p));
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
        return sheet.crossing(mesh.vertices[a],
                              mesh.vertices[b],
                              distance[a],
                              distance[b]);
      }

      /** Whether the joint's extent reaches into a cell with two sides. */
      bool
      reaches_into(const Cell &cell) const
      {
        if (sheet.is_infinite())
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
          return sheet.depth_inside(p) > margin;
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
        return sheet.depth_inside(sum / n) > 0.;
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
                if (relative < snap.largest() &&
                    relative < (mesh.is_fixed[v] ? through_corner : 1.) &&
                    relative < snap.at(mesh.vertices[v]) &&
                    (is_cut || sheet.depth_inside(mesh.vertices[v]) > 0.))
                  near.insert({relative, v});
              }
          }
        for (const auto &[relative, v] : near)
          if (!would_flatten_a_cell(v))
            {
              side[v] = 0;
              move_onto_joint(v);
              note_loss(v);
            }
        if (n_losses >= least_losses)
          report.thin_rock.push_back(thinnest);
      }

      /** Note that the rock between the joint and an outline is lost at a
       * vertex, if it is. */
      void
      note_loss(const unsigned int v)
      {
        const double thickness = std::abs(distance[v]);
        if (thickness < least_loss * mesh.target_size[v] ||
            sheet.depth_inside(mesh.vertices[v]) < 0.)
          return;
        const Tensor<1, dim> normal = sheet.normal_at(mesh.vertices[v]);
        for (const unsigned int s : mesh.bound_to[v])
          if (!mesh.surfaces[s].is_joint() &&
              std::abs(normal * mesh.surfaces[s].normal_at(mesh.vertices[v])) >
                std::sqrt(1. - nearly_parallel * nearly_parallel))
            {
              ++n_losses;
              report.lost_rock.push_back({mesh.vertices[v], thickness});
              if (thickness < thinnest.thickness)
                thinnest = {sheet.joints[0], mesh.vertices[v], thickness};
              return;
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
          SimplexMesh<dim>::free_part(sheet.normal_at(mesh.vertices[v]),
                                      mesh.locked_directions(v));
        if (way.norm_square() < 0.1)
          return;
        const Point<dim> old = mesh.vertices[v];
        const double before  = mesh.least_quality_at(v);
        mesh.move(v, old - distance[v] / way.norm_square() * way);
        mesh.return_to_circles(v);
        if (mesh.least_quality_at(v) < std::min(least_quality_of_snap, before))
          mesh.move(v, old);
        else
          distance[v] = sheet.distance(mesh.vertices[v]);
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
        order.reserve(crossed.size());
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
            const double least =
              snap.at(mesh.vertices[a] +
                      0.5 * (mesh.vertices[b] - mesh.vertices[a])) *
              std::min(1., -size / minus_length);
            const double part = std::clamp(crossing(a, b), least, 1. - least);
            const unsigned int middle =
              mesh.split_edge(a,
                              b,
                              mesh.vertices[a] +
                                part * (mesh.vertices[b] - mesh.vertices[a]));
            mesh.return_to_circles(middle);
            side.push_back(0);
            distance.push_back(sheet.distance(mesh.vertices[middle]));
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
              {
                const auto facet = mesh.facet(c, apex);
                std::vector<Point<dim>> corners;
                for (const unsigned int v : facet)
                  corners.push_back(mesh.vertices[v]);
                const unsigned int part = sheet.facet_along(corners);
                mesh.add_mark(facet,
                              {surface + part,
                               mesh.is_on_positive_side(c, apex) !=
                                 sheet.is_turned(part)});
              }
          }
      }

      SimplexMesh<dim> &mesh;
      const unsigned int surface;
      const JointSheet<dim> &sheet;
      const SnapDistance<dim> &snap;
      MeshReport<dim> &report;
      unsigned int n_losses = 0;
      typename MeshReport<dim>::ThinRock thinnest{no_index, {}, 1e300};
      std::vector<double> distance;
      std::vector<signed char> side; ///< of each vertex: -1, +1; 0: on it
    };
  } // namespace



  template <int dim>
  void
  insert_joint(SimplexMesh<dim> &mesh,
               const unsigned int surface,
               const JointSheet<dim> &sheet,
               const SnapDistance<dim> &snap,
               MeshReport<dim> &report)
  {
    Insertion<dim>(mesh, surface, sheet, snap, report).run();
  }

  template void insert_joint(SimplexMesh<2> &,
                             const unsigned int,
                             const JointSheet<2> &,
                             const SnapDistance<2> &,
                             MeshReport<2> &);
  template void insert_joint(SimplexMesh<3> &,
                             const unsigned int,
                             const JointSheet<3> &,
                             const SnapDistance<3> &,
                             MeshReport<3> &);
} // namespace Keyblock

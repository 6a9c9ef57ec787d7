// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/joint_cut_steps.h>
#include <keyblock/mesh/pieces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Pieces of less than this part of a cell go to a neighbour. */
    constexpr double crumb = 0.2;

    /** Area shared with a neighbour, over the most, that is much [-]. */
    constexpr double much_area = 0.25;



    using PiecePair = std::pair<unsigned int, unsigned int>;

    /** The pair with the neighbour that crumb @p p goes to: the largest of
     * those with which it shares much area of joints, which changes least by
     * it. Pieces that are equal: none. */
    template <int dim>
    PiecePair
    neighbor_of_crumb(const unsigned int p,
                      const Pieces<dim> &pieces,
                      const std::map<PiecePair, double> &common)
    {
      const auto other = [p](const PiecePair &pair) {
        return pair.first == p ? pair.second : pair.first;
      };
      const auto is_candidate = [&](const PiecePair &pair) {
        return (pair.first == p || pair.second == p) &&
               pieces.volume[other(pair)] > pieces.volume[p];
      };
      double most_area = 0.;
      for (const auto &[pair, area] : common)
        if (is_candidate(pair))
          most_area = std::max(most_area, area);
      double largest = 0.;
      PiecePair best(0, 0);
      for (const auto &[pair, area] : common)
        if (is_candidate(pair) && area > much_area * most_area &&
            pieces.volume[other(pair)] > largest)
          {
            largest = pieces.volume[other(pair)];
            best    = pair;
          }
      return best;
    }



    /** One pass; whether there were any. */
    template <int dim>
    bool
    dissolve_crumbs_once(SimplexMesh<dim> &mesh, MeshReport<dim> &report)
    {
      const Pieces<dim> pieces(mesh);
      using Facet = typename SimplexMesh<dim>::Facet;
      std::map<PiecePair, double> common;
      std::vector<std::pair<Facet, PiecePair>> facets;
      std::set<unsigned int> exposed; // pieces with a face on an excavation
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        if (mesh.cells[c].is_alive)
          for (unsigned int i = 0; i <= dim; ++i)
            {
              const Facet facet = mesh.facet(c, i);
              const auto found  = mesh.marks.find(facet);
              if (found == mesh.marks.end())
                continue;
              const unsigned int other = mesh.neighbor(c, i);
              if (std::any_of(found->second.begin(),
                              found->second.end(),
                              [&mesh](const auto &mark) {
                                return !mesh.surfaces[mark.surface].is_joint();
                              }))
                {
                  if (other != no_index) // else the outer boundary
                    exposed.insert(pieces.of_cell[c]);
                  continue;
                }
              const PiecePair pair =
                std::minmax(pieces.of_cell[c], pieces.of_cell[other]);
              if (other < c || pair.first == pair.second)
                continue;
              common[pair] += mesh.measure(facet);
              facets.push_back({facet, pair});
            }
      std::set<PiecePair> dissolved;
      for (unsigned int p = 0; p < pieces.volume.size(); ++p)
        {
          if (pieces.volume[p] > crumb * pieces.wanted_volume[p])
            continue;
          const auto best = neighbor_of_crumb(p, pieces, common);
          if (best.first == best.second)
            continue;
          dissolved.insert(best);
          ++report.n_lost_blocks;
          report.lost_rock.push_back(
            {pieces.center[p], std::pow(pieces.volume[p], 1. / dim)});
          if (exposed.count(p) > 0)
            report.lost_exposed.push_back({pieces.volume[p], pieces.center[p]});
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
  } // namespace



  template <int dim>
  void
  dissolve_crumbs(SimplexMesh<dim> &mesh, MeshReport<dim> &report)
  {
    while (dissolve_crumbs_once(mesh, report))
      ;
  }

  template void dissolve_crumbs(SimplexMesh<2> &, MeshReport<2> &);
  template void dissolve_crumbs(SimplexMesh<3> &, MeshReport<3> &);
} // namespace Keyblock

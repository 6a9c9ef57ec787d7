// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/mesh/joint_cut_steps.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Patches of a joint between other surfaces are dropped if less of them
     * lies inside its rim; from the second on their edges close. */
    constexpr double least_part_inside = 0.3, part_that_closes = 0.5;



    /** See trim_joints(). */
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
  } // namespace



  template <int dim>
  void
  trim_joints(SimplexMesh<dim> &mesh,
              const std::vector<JointExtent<dim>> &extents)
  {
    Trim<dim>(mesh, extents).run();
  }

  template void trim_joints(SimplexMesh<2> &,
                            const std::vector<JointExtent<2>> &);
  template void trim_joints(SimplexMesh<3> &,
                            const std::vector<JointExtent<3>> &);
} // namespace Keyblock

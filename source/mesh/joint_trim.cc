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
      Trim(SimplexMesh<dim> &mesh, const JointSheets<dim> &sheets)
        : mesh(mesh)
        , sheets(sheets)
      {
        for (const Facet &facet : mesh.marked_facets())
          for (const auto &mark : mesh.marks.at(facet))
            {
              const unsigned int whole = whole_of(mark.surface);
              facets_of[whole].push_back(facet);
              for_each_ridge<dim>(facet, [&](const Ridge &ridge) {
                auto &list = surfaces_at[ridge];
                if (std::find(list.begin(), list.end(), whole) == list.end())
                  list.push_back(whole);
              });
            }
      }

      void
      run()
      {
        for (const auto &[surface, facets] : facets_of)
          if (mesh.surfaces[surface].is_joint() &&
              !sheet_of(surface).is_infinite())
            trim(surface, facets);
        mesh.bind_vertices();
      }

    private:
      using Facet = typename SimplexMesh<dim>::Facet;
      using Ridge = std::array<unsigned int, dim - 1>;

      const JointSheet<dim> &
      sheet_of(const unsigned int surface) const
      {
        return sheets.of_joint(mesh.surfaces[surface].joint);
      }

      /** What stands for all surfaces of a bent joint: that of its first facet,
       * which are in a row. */
      unsigned int
      whole_of(const unsigned int surface) const
      {
        if (!mesh.surfaces[surface].is_joint())
          return surface;
        const auto &joints = sheet_of(surface).joints;
        return surface - (std::find(joints.begin(),
                                    joints.end(),
                                    mesh.surfaces[surface].joint) -
                          joints.begin());
      }

      void
      trim(const unsigned int surface, const std::vector<Facet> &facets)
      {
        const JointSheet<dim> &sheet = sheet_of(surface);
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
            inside[i]         = sheet.depth_inside(mesh.center(facets[i]));
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
                                  [&](const auto &mark) {
                                    return whole_of(mark.surface) == surface;
                                  }),
                   list.end());
        if (list.empty())
          mesh.marks.erase(entry);
      }

      SimplexMesh<dim> &mesh;
      const JointSheets<dim> &sheets;
      std::map<unsigned int, std::vector<Facet>> facets_of;
      std::map<Ridge, std::vector<unsigned int>> surfaces_at;
    };
  } // namespace



  template <int dim>
  void
  trim_joints(SimplexMesh<dim> &mesh, const JointSheets<dim> &sheets)
  {
    Trim<dim>(mesh, sheets).run();
  }

  template void trim_joints(SimplexMesh<2> &, const JointSheets<2> &);
  template void trim_joints(SimplexMesh<3> &, const JointSheets<3> &);
} // namespace Keyblock

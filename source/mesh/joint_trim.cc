// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/mesh/joint_cut_steps.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Patches of a joint between other surfaces are dropped if less of them
     * lies inside its rim; from the second on their edges close. */
    constexpr double least_part_inside = 0.3, part_that_closes = 0.5;

    /** So many facets are taken off an end that touches another joint. */
    constexpr unsigned int most_facets_parted = 4;



    /** See trim_joints(). */
    template <int dim>
    class Trim
    {
    public:
      Trim(SimplexMesh<dim> &mesh, const JointSheets<dim> &sheets)
        : mesh(mesh)
        , sheets(sheets)
      {
        find_facets();
      }

      void
      run()
      {
        bool is_parted = false; // (or may be)
        for (const auto &[surface, facets] : facets_of)
          if (has_rim(surface))
            {
              trim(surface, facets);
              is_parted = is_parted || sheet_of(surface).is_plane();
            }
        for (unsigned int i = 0; i < most_facets_parted && is_parted; ++i)
          {
            is_parted = false;
            find_facets();
            for (const auto &[surface, facets] : facets_of)
              if (has_rim(surface) && sheet_of(surface).is_plane())
                is_parted = part_ends(surface, facets) || is_parted;
          }
        mesh.bind_vertices();
      }

    private:
      using Facet = typename SimplexMesh<dim>::Facet;
      using Ridge = std::array<unsigned int, dim - 1>;

      void
      find_facets()
      {
        facets_of.clear();
        surfaces_at.clear();
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

      const JointSheet<dim> &
      sheet_of(const unsigned int surface) const
      {
        return sheets.of_joint(mesh.surfaces[surface].joint);
      }

      bool
      has_rim(const unsigned int surface) const
      {
        return mesh.surfaces[surface].is_joint() &&
               !sheet_of(surface).is_infinite();
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

      /** Drop the facets at whose ridges a plane joint ends on another one that
       * it does not reach: two that are nearly parallel may be nearer to each
       * other than cells are large, share vertices, and meet far beyond a rim.
       * A parallel one that has fallen together with it elsewhere does not
       * count beside what it ends on else. Whether there were any. */
      bool
      part_ends(const unsigned int surface, const std::vector<Facet> &facets)
      {
        std::map<Ridge, unsigned int> n_facets_at;
        for (const Facet &facet : facets)
          for_each_ridge<dim>(facet, [&](const Ridge &ridge) {
            ++n_facets_at[ridge];
          });
        std::set<unsigned int> twins;
        for (const Facet &facet : facets)
          for (const auto &mark : mesh.marks.at(facet))
            twins.insert(whole_of(mark.surface));
        bool is_parted = false;
        for (const Facet &facet : facets)
          {
            const double gap = closing * mesh.size_at(facet);
            bool is_apart    = false;
            for_each_ridge<dim>(facet, [&](const Ridge &ridge) {
              if (n_facets_at.at(ridge) > 1)
                return;
              bool misses_twin = false, is_closed = false;
              for (const unsigned int other : surfaces_at.at(ridge))
                {
                  if (other == surface)
                    continue;
                  const bool is_reached =
                    reaches(sheet_of(surface), other, ridge, gap);
                  const bool is_twin = !is_reached && twins.count(other) > 0 &&
                                       are_parallel(surface, other, ridge);
                  is_closed =
                    is_closed || (is_reached && !lies_on(facet, other));
                  misses_twin =
                    misses_twin || (is_twin && !lies_on(facet, other));
                  is_apart = is_apart || (!is_twin && !is_reached);
                }
              is_apart = is_apart || (misses_twin && !is_closed);
            });
            if (is_apart)
              drop(facet, surface);
            is_parted = is_parted || is_apart;
          }
        return is_parted;
      }

      /** Whether two surfaces are parallel at a ridge, so that they meet
       * nowhere near it. */
      bool
      are_parallel(const unsigned int surface,
                   const unsigned int other,
                   const Ridge &ridge) const
      {
        constexpr double least_cosine = 0.9998; // 1.1 degrees
        return std::abs(sheet_of(surface).normal_at(middle_of(ridge)) *
                        sheet_of(other).normal_at(middle_of(ridge))) >
               least_cosine;
      }

      Point<dim>
      middle_of(const Ridge &ridge) const
      {
        Point<dim> middle;
        for (const unsigned int v : ridge)
          middle += 1. / ridge.size() * mesh.vertices[v];
        return middle;
      }

      /** Whether a facet lies on a surface. */
      bool
      lies_on(const Facet &facet, const unsigned int surface) const
      {
        const auto &list = mesh.marks.at(facet);
        return std::any_of(list.begin(), list.end(), [&](const auto &mark) {
          return whole_of(mark.surface) == surface;
        });
      }

      /** Whether a plane joint meets another surface near a ridge of the mesh
       * on both not farther beyond its rim than @p gap [m]. */
      bool
      reaches(const JointSheet<dim> &sheet,
              const unsigned int other,
              const Ridge &ridge,
              const double gap) const
      {
        if (!mesh.surfaces[other].is_joint() || !sheet_of(other).is_plane())
          return true;
        const Point<dim> here  = middle_of(ridge);
        const double a         = sheet.distance(here),
                     b         = sheet_of(other).distance(here);
        const Tensor<1, dim> m = sheet.normal_at(here),
                             n = sheet_of(other).normal_at(here);
        const double cosine = m * n, square_sine = 1. - cosine * cosine;
        if (std::max(std::abs(a), std::abs(b)) <= 1e-6 * gap)
          return true;
        if (square_sine <= 1e-12)
          return false;
        const Point<dim> meeting = here + (cosine * b - a) / square_sine * m +
                                   (cosine * a - b) / square_sine * n;
        return sheet.depth_inside(meeting) > -gap;
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

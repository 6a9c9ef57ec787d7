// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/bounding_box.h>

#include <keyblock/mesh/improvement.h>
#include <keyblock/mesh/joint_cut.h>
#include <keyblock/mesh/joint_cut_steps.h>
#include <keyblock/scene/joint_facets.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Keyblock
{
  namespace
  {
    // Qualities as SimplexMesh::quality.

    /** How far a collapse may lead a joint astray, over the target size. */
    constexpr double allowed_bend = 0.1;

    /** Cells below these are mended: before and at the end, and the new ones
     * of one joint. */
    constexpr double wanted_at_joints = 0.35, wanted_between = 0.25;

    /** At the end joints between rock that stays are bent so far, over the
     * target size, where cells are below this: the stable step is then a tenth
     * of that of cells of the wanted size without joints, or more. */
    constexpr double largest_bend = 0.25;
    template <int dim>
    constexpr double least_quality = (dim == 2) ? 0.12 : 0.16;

    /** Joints are put back into their planes where cells stay as good. */
    constexpr double least_quality_of_flattening = 0.2;



    template <int dim>
    JointSheets<dim>
    make_sheets(const Scene<dim> &scene)
    {
      JointSheets<dim> result;
      result.sheet_of_joint.resize(scene.joints.size());
      for (const auto &joints : joints_by_surface(scene))
        {
          for (const unsigned int j : joints)
            result.sheet_of_joint[j] = result.sheets.size();
          result.sheets.push_back(
            std::make_unique<JointSheet<dim>>(scene, joints));
        }
      return result;
    }



    template <int dim>
    void
    measure_shifts(const SimplexMesh<dim> &mesh,
                   const JointSheets<dim> &sheets,
                   const double coarsening,
                   MeshReport<dim> &report)
    {
      std::vector<double> shifts, shifts_in_cells;
      const auto add = [&](const double shift, const double size) {
        shifts.push_back(std::abs(shift));
        shifts_in_cells.push_back(shifts.back() * coarsening / size);
      };
      for (const auto &facet : mesh.marked_facets())
        for (const auto &mark : mesh.marks.at(facet))
          if (mesh.surfaces[mark.surface].is_joint())
            {
              const auto &sheet =
                sheets.of_joint(mesh.surfaces[mark.surface].joint);
              for (const unsigned int v : facet)
                add(sheet.distance(mesh.vertices[v]), mesh.target_size[v]);
              // a bent joint may leave a facet between its vertices, too
              if (!sheet.is_plane())
                add(sheet.distance(mesh.center(facet)), mesh.size_at(facet));
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



    /** Whether a point is within @p box, not on it. */
    template <int dim>
    bool
    is_within(const dealii::BoundingBox<dim> &box, const Point<dim> &p)
    {
      bool is_inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_inside =
          is_inside && p[d] > box.lower_bound(d) && p[d] < box.upper_bound(d);
      return is_inside;
    }



    /** See MeshReport::lost_parts; of joints that are there. */
    template <int dim>
    void
    find_lost_parts(const SimplexMesh<dim> &mesh,
                    const JointSheets<dim> &sheets,
                    const double coarsening,
                    MeshReport<dim> &report)
    {
      const dealii::BoundingBox<dim> box(mesh.vertices);
      std::set<unsigned int> kept;
      for (const auto &facet : mesh.marked_facets())
        for (const auto &mark : mesh.marks.at(facet))
          if (mesh.surfaces[mark.surface].is_joint())
            kept.insert(mesh.surfaces[mark.surface].joint);
      for (const auto &sheet : sheets.sheets)
        {
          typename MeshReport<dim>::LostParts lost = {
            sheet->joints[0], 0, unsigned(sheet->facets.size()), 0., 0.};
          bool is_there = false;
          for (unsigned int f = 0; f < sheet->facets.size(); ++f)
            {
              const JointExtent<dim> &part = sheet->facets[f];
              Point<dim> middle;
              const auto corners = part.outermost_points();
              for (const Point<dim> &p : corners)
                middle += p / double(corners.size());
              if (kept.count(sheet->joints[f]) > 0)
                is_there = true;
              else if (is_within(box, middle))
                {
                  ++lost.n_lost;
                  lost.width = std::max(lost.width, 2. * part.half_width());
                }
            }
          lost.size = lost.width / coarsening;
          if (is_there && lost.n_lost > 0)
            report.lost_parts.push_back(lost);
        }
    }



    /** Tells which joints reach into the model: of those without facets
     * whether they are too small or outside, and of the others that lie wholly
     * in its box how much of their area they have. */
    template <int dim>
    void
    look_for_joints(const SimplexMesh<dim> &mesh,
                    const JointSheets<dim> &sheets,
                    MeshReport<dim> &report)
    {
      std::vector<double> area(sheets.sheets.size(), 0.),
        edge(sheets.sheets.size(), 0.);
      for (const auto &facet : mesh.marked_facets())
        for (const auto &mark : mesh.marks.at(facet))
          if (mesh.surfaces[mark.surface].is_joint())
            {
              const unsigned int j =
                sheets.sheet_of_joint[mesh.surfaces[mark.surface].joint];
              area[j] += mesh.measure(facet);
              edge[j] += mesh.measure(facet) * mesh.size_at(facet);
            }
      const dealii::BoundingBox<dim> box(mesh.vertices);
      double found = 0., wanted = 0., found_large = 0., wanted_large = 0.;
      for (unsigned int j = 0; j < sheets.sheets.size(); ++j)
        {
          const JointSheet<dim> &sheet         = *sheets.sheets[j];
          const std::vector<Point<dim>> places = sheet.outermost_points();
          const unsigned int n_inside =
            std::count_if(places.begin(),
                          places.end(),
                          [&box](const Point<dim> &p) {
                            return is_within(box, p);
                          });
          if (area[j] == 0.)
            {
              auto &list = n_inside > 0 ? report.lost : report.outside;
              list.insert(list.end(), sheet.joints.begin(), sheet.joints.end());
            }
          if (!places.empty() && n_inside == places.size())
            {
              found += area[j];
              wanted += sheet.area();
              if (sheet.half_width() * area[j] >= 2. * edge[j])
                {
                  found_large += area[j];
                  wanted_large += sheet.area();
                }
            }
        }
      if (wanted > 0.)
        report.area_ratio = found / wanted;
      if (wanted_large > 0.)
        report.area_ratio_of_large = found_large / wanted_large;
    }



    /** A mesh with its joints, and what had to be simplified. */
    template <int dim>
    struct CutMesh
    {
      SimplexMesh<dim> mesh;
      MeshReport<dim> report;
      ChangedPieces<dim> changed; ///< see straighten_pieces()

      /** What is worse comes first: pieces that are there, but wrong. */
      std::pair<unsigned int, unsigned int>
      faults() const
      {
        return {changed.n, report.n_lost_blocks};
      }
    };



    template <int dim>
    CutMesh<dim>
    cut_with(const SimplexMesh<dim> &uncut,
             const Scene<dim> &scene,
             const JointSheets<dim> &sheets,
             const SnapDistance<dim> &snap)
    {
      CutMesh<dim> result;
      result.mesh = uncut;
      auto &mesh  = result.mesh;
      MeshImprovement<dim> improvement(mesh, allowed_bend);
      improvement.improve(wanted_at_joints, 3);
      for (const auto &sheet : sheets.sheets)
        {
          const unsigned int first_cell = mesh.cells.size();
          const unsigned int surface    = mesh.surfaces.size();
          for (unsigned int f = 0; f < sheet->facets.size(); ++f)
            mesh.surfaces.push_back({sheet->facets[f].origin,
                                     sheet->facets[f].normal,
                                     0.,
                                     sheet->joints[f]});
          insert_joint(mesh, surface, *sheet, snap, result.report);
          improvement.improve(wanted_between, 1, first_cell);
        }
      trim_joints(mesh, sheets);
      dissolve_crumbs(mesh, result.report);
      improvement.improve(wanted_at_joints, 8);
      improvement.flatten(least_quality_of_flattening);
      improvement.improve(wanted_at_joints, 2);
      improvement.flatten(least_quality_of_flattening);

      improvement.improve_by_bending(least_quality<dim>,
                                     8,
                                     largest_bend,
                                     list_block_vertices(mesh, scene));
      result.changed = straighten_pieces(mesh, scene);
      return result;
    }
  } // namespace



  template <int dim>
  MeshReport<dim>
  cut_joints(SimplexMesh<dim> &mesh,
             const Scene<dim> &scene,
             const double snap,
             const double coarsening)
  {
    const JointSheets<dim> sheets = make_sheets(scene);
    CutMesh<dim> best = cut_with(mesh, scene, sheets, SnapDistance<dim>(snap));
    if (best.changed.n > 0)
      {
        CutMesh<dim> nearer = cut_with(
          mesh, scene, sheets, SnapDistance<dim>(snap, best.changed.vertices));
        if (nearer.faults() < best.faults())
          best = std::move(nearer);
      }
    mesh            = std::move(best.mesh);
    best.report.way = "cut";
    measure_shifts(mesh, sheets, coarsening, best.report);
    look_for_joints(mesh, sheets, best.report);
    find_lost_parts(mesh, sheets, coarsening, best.report);
    return best.report;
  }

  template MeshReport<2>
  cut_joints(SimplexMesh<2> &, const Scene<2> &, const double, const double);
  template MeshReport<3>
  cut_joints(SimplexMesh<3> &, const Scene<3> &, const double, const double);
} // namespace Keyblock

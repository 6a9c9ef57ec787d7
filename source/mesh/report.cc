// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <keyblock/base/delimited_text.h>
#include <keyblock/mesh/report_warnings.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    using Sentences = std::vector<std::string>;

    /** A text to write a sentence into. */
    std::ostringstream
    begin_sentence()
    {
      std::ostringstream text;
      text << std::setprecision(3);
      return text;
    }

    template <int dim>
    std::ostream &
    operator<<(std::ostream &out, const Point<dim> &place)
    {
      for (unsigned int d = 0; d < dim; ++d)
        out << (d ? ", " : "") << place[d];
      return out;
    }

    template <int dim>
    void
    add_names(Sentences &found,
              const std::vector<unsigned int> &joints,
              const Scene<dim> &scene,
              const std::string &fate)
    {
      if (joints.empty())
        return;
      constexpr unsigned int most_names = 8;
      std::ostringstream out            = begin_sentence();
      out << joints.size() << " joint" << (joints.size() == 1 ? " " : "s ")
          << fate << ": ";
      for (unsigned int i = 0; i < joints.size() && i < most_names; ++i)
        out << (i ? ", " : "") << scene.joints[joints[i]]->name;
      out << (joints.size() > most_names ? ", ..." : "") << '.';
      found.push_back(out.str());
    }

    template <int dim>
    void
    print_way(std::ostream &out, const MeshReport<dim> &report)
    {
      if (report.n_passes > 1)
        out << "        made " << report.n_passes
            << " times to get its blocks right\n";
      if (report.n_welded > 0)
        out << "        " << report.n_welded << " block"
            << (report.n_welded == 1 ? "" : "s")
            << " that joints closed in the mesh alone are joined to the rock\n";
      if (report.way == "exact")
        out << "        joints are where the scene has them\n";
      else
        {
          out << "        joints are cut into the mesh (" << report.reason
              << ") and moved by up to " << report.largest_shift << " m, "
              << report.largest_shift_in_cells
              << " cells; 99 % of their points by less than "
              << report.percentile_99 << " m, " << report.percentile_99_in_cells
              << " cells\n";
          if (report.area_ratio != 1.)
            out << "        finite joints have " << report.area_ratio
                << " of their " << (dim == 2 ? "length" : "area")
                << " in the mean\n";
        }
    }

    /** How far apart two joints are that the mesh has on the same faces. */
    struct Parting
    {
      double angle;    ///< between their planes [deg]
      double distance; ///< of one's place from the other's plane [m]

      /** Whether they were one plane before the mesh was made; @p size: of
       * what they share [m]. */
      bool
      is_nothing(const double size) const
      {
        constexpr double closeness = 1e-4;
        return angle * dealii::numbers::PI / 180. <= closeness &&
               distance <= closeness * size;
      }
    };

    template <int dim>
    Parting
    parting_of(const Joint<dim> &a, const Joint<dim> &b)
    {
      const double cosine = std::abs(a.normal() * b.normal());
      const Point<dim> &place =
        b.extent == JointShape::polygon ? b.vertices[0] : b.point;
      return {std::acos(std::min(1., cosine)) * 180. / dealii::numbers::PI,
              std::abs(a.distance(place))};
    }

    /** Joints that lie wholly on others, in the scene or because the mesh has
     * let them fall together. */
    template <int dim>
    void
    add_duplicates(Sentences &found,
                   const MeshReport<dim> &report,
                   const Scene<dim> &scene)
    {
      constexpr unsigned int most_pairs = 5;
      unsigned int n                    = 0;
      for (const auto &merged : report.merged)
        if (merged.is_all_of_other && n++ < most_pairs)
          {
            const Joint<dim> &ruler = *scene.joints[merged.joint];
            const Joint<dim> &other = *scene.joints[merged.other];
            const Parting parting   = parting_of(ruler, other);
            std::ostringstream out  = begin_sentence();
            if (parting.is_nothing(std::pow(merged.area, 1. / (dim - 1))))
              out << "The joint '" << other.name
                  << "' lies wholly on the joint '" << ruler.name
                  << "', whose strength rules there; remove one of them, or "
                     "move it.";
            else
              out << "The mesh has let the joint '" << other.name
                  << "' fall together with the joint '" << ruler.name
                  << "', whose strength rules there: their planes are "
                  << parting.angle << " degrees and up to about "
                  << parting.distance
                  << " m apart; lower the size of cells there ('Mesh/Size at "
                     "joints') to keep them apart, or leave one of them "
                     "out.";
            found.push_back(out.str());
          }
      if (n > most_pairs)
        found.push_back(std::to_string(n - most_pairs) +
                        " more joints lie or fell on others in this way.");
    }

    template <int dim>
    void
    print_merged(std::ostream &out,
                 const MeshReport<dim> &report,
                 const Scene<dim> &scene)
    {
      constexpr unsigned int most_pairs = 5;
      auto merged                       = report.merged;
      std::stable_sort(merged.begin(),
                       merged.end(),
                       [](const auto &a, const auto &b) {
                         return a.area > b.area;
                       });
      for (unsigned int i = 0; i < merged.size() && i < most_pairs; ++i)
        out << "        joints " << scene.joints[merged[i].joint]->name
            << " and " << scene.joints[merged[i].other]->name << " share "
            << merged[i].area << (dim == 2 ? " m" : " m2") << ", which "
            << scene.joints[merged[i].joint]->name << " rules\n";
      if (merged.size() > most_pairs)
        out << "        and so do " << merged.size() - most_pairs
            << " more pairs of joints: summary.json lists them\n";
    }

    /** Rock between joints and outlines that the cells are too large for. */
    template <int dim>
    void
    add_thin_rock(Sentences &found,
                  const MeshReport<dim> &report,
                  const Scene<dim> &scene)
    {
      constexpr unsigned int most_joints = 5;
      auto thin                          = report.thin_rock;
      std::stable_sort(thin.begin(),
                       thin.end(),
                       [](const auto &a, const auto &b) {
                         return a.thickness < b.thickness;
                       });
      for (unsigned int i = 0; i < thin.size() && i < most_joints; ++i)
        {
          std::ostringstream out = begin_sentence();
          out << "The rock between the joint '"
              << scene.joints[thin[i].joint]->name
              << "' and an outline beside it is too thin for the cells, about "
              << thin[i].thickness << " m at (" << thin[i].place
              << "), and lost there; ";
          const double cells_across = scene.meshing.cells_across;
          if (cells_across > 0.)
            out << "lower 'Mesh/Least size' to about "
                << thin[i].thickness / cells_across;
          else
            out << "lower the size there to about " << thin[i].thickness
                << ", or set 'Mesh/Cells across blocks'";
          out << " to keep it, or leave the joint out.";
          found.push_back(out.str());
        }
      if (thin.size() > most_joints)
        found.push_back("So is it beside " +
                        std::to_string(thin.size() - most_joints) +
                        " more joints.");
    }

    template <int dim>
    void
    add_lost_parts(Sentences &found,
                   const MeshReport<dim> &report,
                   const Scene<dim> &scene)
    {
      for (const auto &lost : report.lost_parts)
        {
          std::ostringstream out = begin_sentence();
          out << lost.n_lost << " of the " << lost.n_parts
              << " plane parts of the joint '"
              << scene.joints[lost.joint]->surface
              << "' are too small for the cells there, the largest about "
              << lost.width
              << " m wide: the joint is smoothed over them; set 'Mesh/Size at "
                 "joints' to about "
              << lost.size << ", or give larger parts.";
          found.push_back(out.str());
        }
    }

    /** That finite joints have another size in the mesh than in the scene. */
    template <int dim>
    void
    add_area_ratio(Sentences &found, const MeshReport<dim> &report)
    {
      constexpr double least = 0.8, largest = 1.25; // [-]
      if (report.area_ratio >= least && report.area_ratio <= largest)
        return;
      std::ostringstream out = begin_sentence();
      out << "Finite joints have " << report.area_ratio << " of their "
          << (dim == 2 ? "length" : "area")
          << " in the mean, as the mesh has their rims at edges of its cells, "
             "too large for them, which "
          << (report.area_ratio > 1. ? "cuts out blocks that are not there"
                                     : "leaves blocks out")
          << "; lower 'Mesh/Size at joints'.";
      found.push_back(out.str());
    }

    template <int dim>
    void
    add_lost_blocks(Sentences &found, const MeshReport<dim> &report)
    {
      if (report.n_lost_blocks == 0)
        return;
      const auto describe =
        [](std::ostream &out, const double volume, const Point<dim> &place) {
          out << volume << (dim == 2 ? " m2" : " m3") << " at (" << place
              << ") m";
        };
      const bool is_one      = report.n_lost_blocks == 1;
      std::ostringstream out = begin_sentence();
      out << count_text(report.n_lost_blocks, "block")
          << " smaller than a fifth of a triangle or tetrahedron went to "
          << (is_one ? "its" : "their") << " neighbours, "
          << (is_one ? "" : "the largest ") << "of ";
      describe(out, report.largest_lost_volume, report.largest_lost_place);
      out << "; lower 'Mesh/Size' there to keep " << (is_one ? "it." : "them.");
      auto exposed = report.lost_exposed;
      std::sort(exposed.begin(),
                exposed.end(),
                [](const auto &a, const auto &b) {
                  return a.volume > b.volume;
                });
      constexpr std::size_t most_told = 5;
      const std::size_t n_told        = std::min(exposed.size(), most_told);
      if (is_one && n_told > 0)
        out << " It is at an excavation, where it may fall, and is not judged.";
      for (std::size_t i = 0; i < n_told && !is_one; ++i)
        {
          out << (i > 0 ? "; "
                        : " At an excavation, where they may fall, and "
                          "not judged: ");
          describe(out, exposed[i].volume, exposed[i].place);
        }
      if (exposed.size() > n_told)
        out << "; and " << exposed.size() - n_told << " smaller";
      if (!is_one && n_told > 0)
        out << '.';
      found.push_back(out.str());
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_mesh_report(const MeshReport<dim> &report,
                          const Scene<dim> &scene)
  {
    Sentences found;
    if (scene.joints.empty())
      return found;
    add_area_ratio(found, report);
    add_duplicates(found, report, scene);
    add_lost_blocks(found, report);
    add_thin_rock(found, report, scene);
    add_names(found,
              report.lost,
              scene,
              "too small for the cells where they lie, and left out");
    add_lost_parts(found, report, scene);
    add_names(found, report.outside, scene, "outside the model, and left out");
    return found;
  }



  template <int dim>
  void
  print_mesh_report(std::ostream &out,
                    const MeshReport<dim> &report,
                    const Scene<dim> &scene)
  {
    if (scene.joints.empty())
      return;
    out << std::setprecision(3);
    if (!report.way.empty())
      print_way(out, report);
    print_merged(out, report, scene);
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<std::string> warnings_of_mesh_report(                   \
    const MeshReport<dim> &, const Scene<dim> &);                              \
  template void print_mesh_report(std::ostream &,                              \
                                  const MeshReport<dim> &,                     \
                                  const Scene<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh_report.h>

#include <iomanip>
#include <ostream>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    print_names(std::ostream &out,
                const std::vector<unsigned int> &joints,
                const Scene<dim> &scene,
                const std::string &fate)
    {
      if (joints.empty())
        return;
      constexpr unsigned int most_names = 8;
      out << "Warning: " << joints.size() << " joint"
          << (joints.size() == 1 ? " " : "s ") << fate << ": ";
      for (unsigned int i = 0; i < joints.size() && i < most_names; ++i)
        out << (i ? ", " : "") << scene.joints[joints[i]]->name;
      out << (joints.size() > most_names ? ", ..." : "") << ".\n";
    }
  } // namespace



  template <int dim>
  void
  print_mesh_report(std::ostream &out,
                    const MeshReport<dim> &report,
                    const Scene<dim> &scene)
  {
    if (report.way.empty() || scene.joints.empty())
      return;
    out << std::setprecision(3);
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
              << " of their area in the mean\n";
      }
    for (const auto &merged : report.merged)
      out << "        joints " << scene.joints[merged.joint]->name << " and "
          << scene.joints[merged.other]->name << " share " << merged.area
          << (dim == 2 ? " m" : " m2") << ", which "
          << scene.joints[merged.joint]->name << " rules\n";
    if (report.n_lost_blocks > 0)
      {
        out << "Warning: " << report.n_lost_blocks
            << " blocks smaller than a fifth of a triangle or tetrahedron went "
               "to their neighbours, the largest of "
            << report.largest_lost_volume << (dim == 2 ? " m2" : " m3")
            << " at (";
        for (unsigned int d = 0; d < dim; ++d)
          out << (d ? ", " : "") << report.largest_lost_place[d];
        out << ") m; lower 'Mesh/Size' there to keep them.\n";
      }
    print_names(out,
                report.lost,
                scene,
                "too small for the cells where they lie, and left out");
    print_names(out, report.outside, scene, "outside the model, and left out");
  }

  template void
  print_mesh_report(std::ostream &, const MeshReport<2> &, const Scene<2> &);
  template void
  print_mesh_report(std::ostream &, const MeshReport<3> &, const Scene<3> &);
} // namespace Keyblock

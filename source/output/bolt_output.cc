// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/output/bolt_output.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace Keyblock
{
  namespace
  {
    std::string
    file_of(const unsigned int number)
    {
      return "bolts_" + dealii::Utilities::int_to_string(number, 4) + ".vtu";
    }

    /** A data array of an ASCII VTU file. */
    class DataArray
    {
    public:
      DataArray(std::ostream &out,
                const std::string &type,
                const std::string &name,
                const unsigned int n_components = 1)
        : out(out)
      {
        out << "<DataArray type=\"" << type << "\" Name=\"" << name
            << "\" NumberOfComponents=\"" << n_components
            << "\" format=\"ascii\">\n";
      }

      ~DataArray()
      {
        out << "\n</DataArray>\n";
      }

      template <typename Number>
      void
      add(const Number value)
      {
        out << value << ' ';
      }

    private:
      std::ostream &out;
    };

    template <int dim>
    void
    write_lines(std::ostream &out, const std::vector<BoltReport<dim>> &reports)
    {
      std::size_t n_points = 0;
      for (const BoltReport<dim> &r : reports)
        n_points += r.bolt->places.size();
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
             "version=\"0.1\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
          << n_points << "\" NumberOfCells=\"" << n_points - reports.size()
          << "\">\n<Points>\n";
      {
        DataArray points(out, "Float64", "points", 3);
        for (const BoltReport<dim> &r : reports)
          for (unsigned int i = 0; i < r.bolt->places.size(); ++i)
            for (unsigned int d = 0; d < 3; ++d)
              points.add(d < dim ? r.bolt->at(r.bolt->places[i])[d] : 0.);
      }
      out << "</Points>\n<Cells>\n";
      {
        DataArray ends(out, "Int32", "connectivity");
        unsigned int first = 0;
        for (const BoltReport<dim> &r : reports)
          {
            for (unsigned int j = 0; j + 1 < r.bolt->places.size(); ++j)
              {
                ends.add(first + j);
                ends.add(first + j + 1);
              }
            first += r.bolt->places.size();
          }
      }
      {
        DataArray offsets(out, "Int32", "offsets");
        for (unsigned int j = 1; j <= n_points - reports.size(); ++j)
          offsets.add(2 * j);
      }
      {
        DataArray types(out, "UInt8", "types");
        for (unsigned int j = 0; j < n_points - reports.size(); ++j)
          types.add(3);
      }
      out << "</Cells>\n<PointData>\n";
      {
        DataArray displacement(out, "Float64", "displacement", 3);
        for (const BoltReport<dim> &r : reports)
          for (const Tensor<1, dim> &u : r.displacement)
            for (unsigned int d = 0; d < 3; ++d)
              displacement.add(d < dim ? u[d] : 0.);
      }
      {
        DataArray slip(out, "Float64", "bond_slip");
        for (const BoltReport<dim> &r : reports)
          for (const double value : r.slip)
            slip.add(value);
      }
      out << "</PointData>\n<CellData>\n";
      {
        DataArray force(out, "Float64", "axial_force");
        for (const BoltReport<dim> &r : reports)
          for (const double value : r.axial_force)
            force.add(value);
      }
      {
        DataArray dowel(out, "Float64", "dowel_force");
        for (const BoltReport<dim> &r : reports)
          for (unsigned int j = 0; j < r.axial_force.size(); ++j)
            dowel.add(r.dowel_force);
      }
      {
        DataArray id(out, "Int32", "bolt");
        for (unsigned int b = 0; b < reports.size(); ++b)
          for (unsigned int j = 0; j < reports[b].axial_force.size(); ++j)
            id.add(b + 1);
      }
      {
        DataArray set(out, "Int32", "set");
        for (const BoltReport<dim> &r : reports)
          for (unsigned int j = 0; j < r.axial_force.size(); ++j)
            set.add(r.bolt->set + 1);
      }
      out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }
  } // namespace



  template <int dim>
  std::vector<BoltFigures>
  list_figures(const std::vector<BoltReport<dim>> &reports,
               const Scene<dim> &scene)
  {
    std::vector<BoltFigures> figures;
    for (const BoltReport<dim> &r : reports)
      {
        BoltFigures one;
        one.set = scene.bolts[r.bolt->set]->name;
        for (unsigned int d = 0; d < dim; ++d)
          {
            one.head.push_back(r.bolt->head[d]);
            one.end.push_back(r.bolt->end[d]);
          }
        for (unsigned int j = 0; j < r.axial_force.size(); ++j)
          if (r.axial_force[j] > one.largest_axial_force)
            {
              one.largest_axial_force = r.axial_force[j];
              one.place = 0.5 * (r.bolt->places[j] + r.bolt->places[j + 1]);
            }
        for (const double slip : r.slip)
          one.largest_slip = std::max(one.largest_slip, std::abs(slip));
        one.plate_force = r.plate_force;
        one.dowel_force = r.dowel_force;
        one.n_crossings = r.n_crossings;
        one.is_broken   = r.is_broken;
        one.limit       = r.limit;
        figures.push_back(one);
      }
    return figures;
  }



  template <int dim>
  void
  write_bolts(const std::string &folder,
              const std::vector<std::pair<double, std::string>> &records,
              const std::vector<BoltReport<dim>> &reports)
  {
    if (reports.empty() || records.empty())
      return;
    const std::string last = file_of(records.size() / 2 - 1);
    std::ofstream out(folder + last);
    write_lines(out, reports);
    bool is_written = bool(out.flush());
    std::ofstream pvd(folder + "bolts.pvd");
    pvd << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
           "version=\"0.1\">\n<Collection>\n";
    for (unsigned int i = 0; i < records.size() / 2; ++i)
      if (std::filesystem::exists(folder + file_of(i)))
        pvd << "<DataSet timestep=\"" << records[2 * i].first << "\" file=\""
            << file_of(i) << "\"/>\n";
    pvd << "</Collection>\n</VTKFile>\n";
    is_written = is_written && pvd.flush();
    AssertThrow(is_written,
                ComputationError("The file '" + folder + last +
                                 "' cannot be written; check free space."));
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<BoltFigures> list_figures(                              \
    const std::vector<BoltReport<dim>> &, const Scene<dim> &);                 \
  template void write_bolts(                                                   \
    const std::string &,                                                       \
    const std::vector<std::pair<double, std::string>> &,                       \
    const std::vector<BoltReport<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

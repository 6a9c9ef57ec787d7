// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/vtu_file.h>

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>
#include <new>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** Text as the value of an attribute. */
    std::string
    quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char letter : text)
        switch (letter)
          {
            case '&':
              result += "&amp;";
              break;
            case '<':
              result += "&lt;";
              break;
            case '"':
              result += "&quot;";
              break;
            default:
              result += letter;
          }
      return result + "\"";
    }



    /** The numbers of a file, which stand behind its elements as bytes. */
    class AppendedData
    {
    public:
      /** Add numbers; returns their place as the attributes of an element.
       * Reals shrink hardly more for more work, integers do. */
      template <typename Number>
      std::string
      add(const std::vector<Number> &list)
      {
        std::string place =
          "format=\"appended\" offset=\"" + std::to_string(bytes.size()) + "\"";
        put(list.data(),
            list.size() * sizeof(Number),
            std::is_same<Number, float>::value ? Z_BEST_SPEED
                                               : Z_DEFAULT_COMPRESSION);
        return place;
      }

      void
      write(std::ostream &out) const
      {
        out << "<AppendedData encoding=\"raw\">\n_" << bytes
            << "\n</AppendedData>\n";
      }

    private:
      /** As VTK's vtkZLibDataCompressor has them: a header of words of 32 bits,
       * then the compressed bytes. */
      void
      put(const void *data, const std::size_t n_bytes, const int level)
      {
        using Word = std::uint32_t;
        if (n_bytes == 0)
          {
            bytes.append(3 * sizeof(Word), 0);
            return;
          }
        if (n_bytes > std::numeric_limits<Word>::max())
          throw std::length_error("An array of a VTU file is too long.");
        const std::size_t begin = bytes.size(), head = 4 * sizeof(Word);
        uLongf length = compressBound(n_bytes);
        bytes.resize(begin + head + length);
        if (compress2(reinterpret_cast<Bytef *>(&bytes[begin + head]),
                      &length,
                      static_cast<const Bytef *>(data),
                      n_bytes,
                      level) != Z_OK)
          throw std::bad_alloc();
        bytes.resize(begin + head + length);
        // one block: their number, its length, that of a last, shorter one
        const Word header[] = {1, Word(n_bytes), 0, Word(length)};
        std::memcpy(&bytes[begin], header, head);
      }

      std::string bytes;
    };

    std::string
    type_of(const std::vector<double> &)
    {
      return "Float64";
    }

    std::string
    type_of(const std::vector<float> &)
    {
      return "Float32";
    }

    std::string
    type_of(const std::vector<std::int32_t> &)
    {
      return "Int32";
    }

    std::string
    type_of(const std::vector<unsigned char> &)
    {
      return "UInt8";
    }



    template <typename Number>
    void
    put_list(std::ostream &out,
             AppendedData &data,
             const std::vector<Number> &list,
             const std::string &attributes)
    {
      out << "<DataArray type=\"" << type_of(list) << "\" " << attributes << " "
          << data.add(list) << "/>\n";
    }



    /** Name and components of an array. */
    std::string
    attributes_of(const VtuArray &array)
    {
      std::string text = "Name=" + quoted(array.name) +
                         " NumberOfComponents=\"" +
                         std::to_string(array.n_components()) + "\"";
      for (unsigned int i = 0; i < array.components.size(); ++i)
        text += " ComponentName" + std::to_string(i) + "=" +
                quoted(array.components[i]);
      return text;
    }



    void
    put_arrays(std::ostream &out,
               AppendedData &data,
               const std::vector<VtuArray> &arrays,
               const std::string &parent)
    {
      out << "<" << parent << ">\n";
      for (const VtuArray &array : arrays)
        std::visit(
          [&](const auto &list) {
            put_list(out, data, list, attributes_of(array));
          },
          array.values);
      out << "</" << parent << ">\n";
    }



    /** What arrays there are, for a PVTU file. */
    void
    put_kinds(std::ostream &out,
              const std::vector<VtuArray> &arrays,
              const std::string &parent)
    {
      out << "<" << parent << ">\n";
      for (const VtuArray &array : arrays)
        std::visit(
          [&](const auto &list) {
            out << "<PDataArray type=\"" << type_of(list) << "\" "
                << attributes_of(array) << "/>\n";
          },
          array.values);
      out << "</" << parent << ">\n";
    }



    /** Time and texts; VTK has texts as their bytes, a zero after each. */
    void
    put_field_data(std::ostream &out, AppendedData &data, const VtuGrid &grid)
    {
      out << "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
             "NumberOfTuples=\"1\" format=\"ascii\">"
          << std::setprecision(17) << grid.time << "</DataArray>\n";
      for (const auto &[name, list] : grid.texts)
        {
          std::vector<unsigned char> bytes;
          for (const std::string &text : list)
            {
              bytes.insert(bytes.end(), text.begin(), text.end());
              bytes.push_back(0);
            }
          out << "<Array type=\"String\" Name=" << quoted(name)
              << " NumberOfTuples=\"" << list.size() << "\" " << data.add(bytes)
              << "/>\n";
        }
      out << "</FieldData>\n";
    }



    /** The beginning of a file, up to its grid of @p type. */
    void
    put_head(std::ostream &out, const std::string &type)
    {
      const std::uint16_t one = 1;
      unsigned char first;
      std::memcpy(&first, &one, 1);
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
          << "\" version=\"1.0\" byte_order=\""
          << (first == 1 ? "LittleEndian" : "BigEndian")
          << "\" header_type=\"UInt32\" "
             "compressor=\"vtkZLibDataCompressor\">\n<"
          << type << (type[0] == 'P' ? " GhostLevel=\"0\">\n" : ">\n");
    }



    void
    put_end(std::ostream &out,
            const AppendedData &data,
            const std::string &type)
    {
      out << "</" << type << ">\n";
      data.write(out);
      out << "</VTKFile>\n";
    }
  } // namespace



  VtuArray
  VtuArray::scalar(const std::string &name)
  {
    return {name, {}, Reals()};
  }



  VtuArray
  VtuArray::vector(const std::string &name)
  {
    return {name, {"X", "Y", "Z"}, Reals()};
  }



  VtuArray
  VtuArray::tensor(const std::string &name)
  {
    return {name,
            {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"},
            Reals()};
  }



  VtuArray
  VtuArray::ids(const std::string &name)
  {
    return {name, {}, Integers()};
  }



  void
  VtuGrid::add_cell(const VtuCell type,
                    const std::vector<unsigned int> &corners)
  {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(connectivity.size());
    types.push_back(static_cast<unsigned char>(type));
  }



  void
  VtuGrid::add_lattice_cell(const std::vector<unsigned int> &corners)
  {
    const auto &c = corners;
    if (c.size() == 2)
      add_cell(VtuCell::line, c);
    else if (c.size() == 4)
      add_cell(VtuCell::quadrilateral, {c[0], c[1], c[3], c[2]});
    else
      add_cell(VtuCell::hexahedron,
               {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]});
  }



  bool
  write_vtu(const VtuGrid &grid, const std::string &file_name)
  {
    std::ofstream out(file_name, std::ios::binary);
    AppendedData data;
    put_head(out, "UnstructuredGrid");
    put_field_data(out, data, grid);
    out << "<Piece NumberOfPoints=\"" << grid.n_points()
        << "\" NumberOfCells=\"" << grid.n_cells() << "\">\n";
    put_arrays(out, data, grid.point_data, "PointData");
    put_arrays(out, data, grid.cell_data, "CellData");
    out << "<Points>\n";
    const std::string points = "Name=\"Points\" NumberOfComponents=\"3\"";
    if (grid.is_far)
      put_list(out, data, grid.points, points);
    else
      put_list(out,
               data,
               std::vector<float>(grid.points.begin(), grid.points.end()),
               points);
    out << "</Points>\n<Cells>\n";
    put_list(out, data, grid.connectivity, "Name=\"connectivity\"");
    put_list(out, data, grid.offsets, "Name=\"offsets\"");
    put_list(out, data, grid.types, "Name=\"types\"");
    out << "</Cells>\n</Piece>\n";
    put_end(out, data, "UnstructuredGrid");
    return bool(out.flush());
  }



  bool
  write_pvtu(const VtuGrid &grid,
             const std::vector<std::string> &pieces,
             const std::string &file_name)
  {
    std::ofstream out(file_name, std::ios::binary);
    AppendedData data;
    put_head(out, "PUnstructuredGrid");
    put_field_data(out, data, grid);
    put_kinds(out, grid.point_data, "PPointData");
    put_kinds(out, grid.cell_data, "PCellData");
    out << "<PPoints>\n<PDataArray type=\""
        << (grid.is_far ? "Float64" : "Float32")
        << "\" NumberOfComponents=\"3\"/>\n</PPoints>\n";
    for (const std::string &piece : pieces)
      out << "<Piece Source=" << quoted(piece) << "/>\n";
    put_end(out, data, "PUnstructuredGrid");
    return bool(out.flush());
  }



  bool
  write_pvd(const std::vector<VtuRecord> &records, const std::string &file_name)
  {
    std::ofstream out(file_name);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
           "version=\"0.1\">\n  <Collection>\n"
        << std::setprecision(10);
    unsigned int part = 0;
    double time       = 0.;
    for (unsigned int i = 0; i < records.size(); ++i)
      {
        const VtuRecord &r = records[i];
        const bool is_first =
          i == 0 || r.name.empty() || r.name == records[0].name;
        part = is_first ? 0 : part + 1;
        // two states of one time, as before and after a static stage, would be
        // shown as one
        if (is_first)
          time = i == 0 ? r.time
                        : std::max(r.time, time + 2e-9 * std::max(1., time));
        out << "    <DataSet timestep=\"" << time
            << "\" group=" << quoted(r.stage) << " part=\"" << part << "\"";
        if (!r.name.empty())
          out << " name=" << quoted(r.name);
        out << " file=" << quoted(r.file) << "/>\n";
      }
    out << "  </Collection>\n</VTKFile>\n";
    return bool(out.flush());
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_vtu_file_h
#define keyblock_base_vtu_file_h

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

// VTU files: unstructured grids as VTK and ParaView read them, with numbers of
// 32 bits (points far from the origin: 64), compressed by zlib.
namespace Keyblock
{
  /** A quantity at all points or all cells of a VtuGrid. */
  struct VtuArray
  {
    using Reals    = std::vector<float>;
    using Integers = std::vector<std::int32_t>;

    std::string name; ///< and unit, as "slip (m)"

    /** Names of the components of a vector or tensor; empty: a scalar. */
    std::vector<std::string> components;

    /** By point or cell, then by component. */
    std::variant<Reals, Integers> values;

    unsigned int
    n_components() const
    {
      return components.empty() ? 1 : components.size();
    }

    void
    add(const double value)
    {
      std::get<Reals>(values).push_back(static_cast<float>(value));
    }

    /** Add a vector of a plane or of space: what it lacks to three components
     * is zero. */
    template <typename VectorType>
    void
    add_vector(const VectorType &v, const unsigned int dim)
    {
      for (unsigned int d = 0; d < 3; ++d)
        add(d < dim ? v[d] : 0.);
    }

    void
    add_id(const std::int32_t id)
    {
      std::get<Integers>(values).push_back(id);
    }

    static VtuArray scalar(const std::string &name);
    static VtuArray vector(const std::string &name);

    /** Nine components by rows, as ParaView takes tensors. */
    static VtuArray tensor(const std::string &name);
    static VtuArray ids(const std::string &name);
  };

  /** VTK's numbers of cell types. */
  enum class VtuCell : unsigned char
  {
    line          = 3,
    polygon       = 7,
    quadrilateral = 9,
    hexahedron    = 12
  };

  /** Points, cells and what is known at them. */
  struct VtuGrid
  {
    std::vector<double> points; ///< x, y, z of each [m]

    /** Whether points are written with 64 bits: 32 would move those far from
     * the origin. The same for all pieces of a collection. */
    bool is_far = false;

    std::vector<std::int32_t> connectivity; ///< points of the cells
    std::vector<std::int32_t> offsets;      ///< where each cell ends in it
    std::vector<unsigned char> types;

    std::vector<VtuArray> point_data, cell_data;

    /** Texts about the whole, by name: what ids stand for, in their order. */
    std::vector<std::pair<std::string, std::vector<std::string>>> texts;

    double time = 0.; ///< [s]

    unsigned int
    n_points() const
    {
      return points.size() / 3;
    }
    unsigned int
    n_cells() const
    {
      return offsets.size();
    }

    /** Add a point of @p dim coordinates; returns its index. */
    template <typename VectorType>
    unsigned int
    add_point(const VectorType &x, const unsigned int dim)
    {
      for (unsigned int d = 0; d < 3; ++d)
        points.push_back(d < dim ? x[d] : 0.);
      return n_points() - 1;
    }

    /** Add a cell of @p type between points in VTK's order. */
    void add_cell(const VtuCell type, const std::vector<unsigned int> &corners);

    /** Add a cell between the points of vertices in deal.II's order: a line, a
     * quadrilateral or a hexahedron, by their number. */
    void add_lattice_cell(const std::vector<unsigned int> &corners);
  };

  /** Whether points (x, y, z of each) lie so far from the origin, over their
   * extent, that numbers of 32 bits would move them. */
  bool are_far(const std::vector<double> &points);

  /** Write a grid; returns whether that worked. */
  bool write_vtu(const VtuGrid &grid, const std::string &file_name);

  /** Write the file that collects the grids in the files @p pieces, which have
   * the same arrays as @p grid; returns whether that worked. */
  bool write_pvtu(const VtuGrid &grid,
                  const std::vector<std::string> &pieces,
                  const std::string &file_name);

  /** A file of a PVD file. */
  struct VtuRecord
  {
    double time = 0.;  ///< [s]
    std::string file;  ///< beside the collection
    std::string name;  ///< of what is in it; empty: there is one of a time
    std::string stage; ///< in which it was written
  };

  /** Write the PVD file that lists files by time; those of one time are its
   * parts. A state that is no later than the one before is put behind it by
   * some nanoseconds. Returns whether that worked. */
  bool write_pvd(const std::vector<VtuRecord> &records,
                 const std::string &file_name);
} // namespace Keyblock

#endif

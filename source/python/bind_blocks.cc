// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/bindings.h>

#include <algorithm>

namespace Keyblock::Python
{
  namespace
  {
    const BlockRow &
    block_with_id(const BlockList &list, const unsigned int id)
    {
      AssertThrow(id > 0 && id <= list.rows.size(),
                  InputError("There is no block " + std::to_string(id) +
                             "; the ids of blocks are 1 to " +
                             std::to_string(list.rows.size()) + "."));
      return list.rows[id - 1];
    }

    /** One number of each block, as a property. */
    template <typename Number>
    auto
    column(Number BlockRow::*member)
    {
      return [member](const BlockList &list) {
        py::array_t<Number> values(list.rows.size());
        for (unsigned int i = 0; i < list.rows.size(); ++i)
          values.mutable_at(i) = list.rows[i].*member;
        return values;
      };
    }

    py::array_t<double>
    centroids(const BlockList &list)
    {
      const py::ssize_t n   = list.rows.size(),
                        dim = n > 0 ? list.rows[0].centroid.size() : 0;
      py::array_t<double> values({n, dim});
      for (py::ssize_t i = 0; i < n; ++i)
        for (py::ssize_t d = 0; d < dim; ++d)
          values.mutable_at(i, d) = list.rows[i].centroid[d];
      return values;
    }

    /** Whether each block is exposed after the last stage. */
    py::array_t<bool>
    exposed(const BlockList &list)
    {
      py::array_t<bool> values(list.rows.size());
      for (unsigned int i = 0; i < list.rows.size(); ++i)
        values.mutable_at(i) = list.rows[i].classes.back() == "exposed";
      return values;
    }



    void
    bind_block(py::module_ &module)
    {
      const auto property = [](auto member) {
        return [member](const BlockRow &row) { return row.*member; };
      };
      py::class_<BlockRow>(module,
                           "Block",
                           "A connected piece of the rock that is left after "
                           "the last stage. In 2D volumes are areas (m2), "
                           "areas are lengths (m), forces are per metre.")
        .def_property_readonly("id", property(&BlockRow::id), "Number, from 1.")
        .def_property_readonly("volume",
                               property(&BlockRow::volume),
                               "m3 (2D: m2).")
        .def_property_readonly("mass",
                               property(&BlockRow::mass),
                               "kg (2D: kg/m).")
        .def_property_readonly("weight",
                               property(&BlockRow::weight),
                               "N (2D: N/m); in a scene without gravity that "
                               "under 9.81 m/s2.")
        .def_property_readonly("exact_volume",
                               property(&BlockRow::exact_volume),
                               "Volume between the planes that bound it, where "
                               "the mesh has bent them; nan: not known.")
        .def_property_readonly("exact_weight",
                               property(&BlockRow::exact_weight),
                               "The same weight; nan: not known.")
        .def_property_readonly("centroid",
                               property(&BlockRow::centroid),
                               "Coordinates (m).")
        .def_property_readonly("size",
                               property(&BlockRow::size),
                               "Largest extent (m).")
        .def_property_readonly("width",
                               property(&BlockRow::width),
                               "Least extent along the normals of its faces "
                               "(m); nan: infinite.")
        .def_property_readonly("cells",
                               property(&BlockRow::n_cells),
                               "Number of cells of the mesh.")
        .def_property_readonly("infinite",
                               property(&BlockRow::is_infinite),
                               "Whether it reaches the truncated boundary.")
        .def_property_readonly("rigid",
                               property(&BlockRow::is_rigid),
                               "Whether it is a rigid body.")
        .def_property_readonly("removable",
                               property(&BlockRow::is_removable),
                               "Whether a direction leaves all of its joints "
                               "(Goodman and Shi 1985).")
        .def_property_readonly("classes",
                               property(&BlockRow::classes),
                               "What it is at the start and after each stage: "
                               "attached, exposed, hidden, infinite, rigid.")
        .def_property_readonly("exposed_in",
                               property(&BlockRow::exposed_in),
                               "First stage with a free face, start, or empty.")
        .def_property_readonly(
          "joint_areas",
          [](const BlockRow &row) {
            py::dict areas;
            for (const auto &[joint, area] : row.joint_areas)
              areas[py::str(joint)] = area;
            return areas;
          },
          "Area on each joint, by its name: m2 (2D: m).")
        .def("__repr__", [](const BlockRow &row) {
          return "<keyblock.Block " + std::to_string(row.id) + ", " +
                 row.classes.back() + ">";
        });
    }



    void
    bind_surface(py::module_ &module)
    {
      py::class_<Surface>(module, "Surface", "Surface of a block.")
        .def_property_readonly(
          "vertices",
          [](const Surface &surface) { return as_numpy(surface.vertices); },
          "Coordinates, shape (n_vertices, dimension) (m).")
        .def_property_readonly(
          "faces",
          [](const Surface &surface) { return as_numpy(surface.faces); },
          "Indices of vertices, shape (n_faces, 4), in 2D (n_faces, 2): seen "
          "from outside they go round anticlockwise, in 2D the rock is left of "
          "the way from the first to the second.")
        .def_readonly("joints",
                      &Surface::joints,
                      "Name of the joint of each face; empty: a free face.");
    }



    void
    bind_limit_equilibrium(py::module_ &module)
    {
      const auto as_dict = [](const auto &pairs) {
        py::dict values;
        for (const auto &[name, value] : pairs)
          values[py::str(name)] = value;
        return values;
      };
      py::class_<Judgement>(module,
                            "LimitEquilibrium",
                            "What a rigid block would do after a stage, "
                            "between neighbours that stay where they are, "
                            "without the in-situ stress.")
        .def_readonly("block", &Judgement::block, "Id of the block.")
        .def_readonly("stage",
                      &Judgement::stage,
                      "Name of the stage, or start.")
        .def_readonly("factor",
                      &Judgement::factor,
                      "Resistance over driving force; inf: it cannot move.")
        .def_readonly("least_factor",
                      &Judgement::least_factor,
                      "The same, or the least one when blocks that fail have "
                      "gone.")
        .def_readonly(
          "mode",
          &Judgement::mode,
          "In words: stable, falling, lifting, rotating, sliding on J1, "
          "sliding on J1/J2.")
        .def_readonly("weight", &Judgement::weight, "N (2D: N/m).")
        .def_readonly("driving_force",
                      &Judgement::driving_force,
                      "Along the direction of motion: N (2D: N/m).")
        .def_readonly("direction",
                      &Judgement::direction,
                      "Unit vector of motion; zeros: it does not move.")
        .def_property_readonly(
          "normal_forces",
          [as_dict](const Judgement &j) { return as_dict(j.normal_forces); },
          "Effective normal force on each joint that it is pressed on, by "
          "name, compression positive: N (2D: N/m).")
        .def_readonly("remarks",
                      &Judgement::remarks,
                      "What is special, and what was left out, in words.")
        .def_readonly("support_force",
                      &Judgement::support_force,
                      "Against the free faces, for the wanted factor: N (2D: "
                      "N/m); 0: it has that factor; inf: no force gives it.")
        .def_readonly("support_pressure",
                      &Judgement::support_pressure,
                      "The same, uniform on the free faces (Pa).")
        .def_property_readonly(
          "bolts",
          [as_dict](const Judgement &j) { return as_dict(j.bolts); },
          "The same as numbers of bolts of each set of the scene, by name.")
        .def("__repr__", [](const Judgement &j) {
          return "<keyblock.LimitEquilibrium block " + std::to_string(j.block) +
                 " after " + j.stage + ": " +
                 py::str(py::float_(j.factor)).cast<std::string>() + ", " +
                 j.mode + ">";
        });
    }


    using BlocksClass = py::class_<BlockList>;

    /** Arrays by block, and of the mesh. */
    void
    bind_arrays(BlocksClass &blocks)
    {
      blocks
        .def_property_readonly("ids", column(&BlockRow::id), "Ids, shape (n,).")
        .def_property_readonly("volumes",
                               column(&BlockRow::volume),
                               "Shape (n,): m3 (2D: m2).")
        .def_property_readonly(
          "exact_volumes",
          column(&BlockRow::exact_volume),
          "Between the planes, shape (n,); nan: not known.")
        .def_property_readonly("weights",
                               column(&BlockRow::weight),
                               "Shape (n,): N (2D: N/m).")
        .def_property_readonly("centroids",
                               centroids,
                               "Shape (n, dimension): m.")
        .def_property_readonly("infinite",
                               column(&BlockRow::is_infinite),
                               "Shape (n,), booleans.")
        .def_property_readonly("removable",
                               column(&BlockRow::is_removable),
                               "Shape (n,), booleans.")
        .def_property_readonly("exposed",
                               exposed,
                               "After the last stage, shape (n,), booleans.")
        .def_property_readonly(
          "vertices",
          [](const BlockList &l) { return as_numpy(l.blocks->vertices()); },
          "Of the mesh split along the joints, shape (n_vertices, dimension): "
          "m.")
        .def_property_readonly(
          "cells",
          [](const BlockList &l) { return as_numpy(l.blocks->cells()); },
          "Vertices of the cells, shape (n_cells, 4), in 3D (n_cells, 8): "
          "x fastest, then y, then z.")
        .def_property_readonly(
          "block_of_cell",
          [](const BlockList &l) {
            return as_numpy(l.blocks->block_of_cell());
          },
          "Id of the block of each cell, shape (n_cells,); 0: dug away later.")
        .def_property_readonly(
          "lost_joints",
          [](const BlockList &l) { return l.blocks->lost_joints(); },
          "Names of joints without a face: smaller than the cells where they "
          "lie, or outside (on rank 0).");
    }
  } // namespace



  void
  bind_blocks(py::module_ &module)
  {
    bind_block(module);
    bind_surface(module);
    bind_limit_equilibrium(module);
    BlocksClass blocks(module,
                       "Blocks",
                       "The blocks of a scene, by ascending id: finite ones "
                       "first, the largest first.");
    bind_arrays(blocks);
    blocks
      .def("__len__", [](const BlockList &list) { return list.rows.size(); })
      .def("__getitem__",
           [](const BlockList &list, const py::ssize_t index) {
             const py::ssize_t n = list.rows.size();
             if (index < -n || index >= n)
               throw py::index_error("list index out of range");
             return list.rows[index < 0 ? index + n : index];
           })
      .def("block",
           block_with_id,
           py::arg("id"),
           "The block with this id. Raises Error.")
      .def(
        "surface",
        [](const BlockList &l, const unsigned int id) {
          return l.blocks->surface(id);
        },
        py::arg("id"),
        "Surface of the block with this id. Raises Error.")
      .def(
        "limit_equilibrium",
        [](const BlockList &list,
           const std::shared_ptr<AnyScene> &scene,
           const double wanted,
           const double time) {
          return computed(false, [&]() {
            return list.blocks->judge(scene, wanted, time);
          });
        },
        py::arg("scene") = py::none(),
        py::kw_only(),
        py::arg("wanted") = 0.,
        py::arg("time")   = 0.,
        "List of LimitEquilibrium: each block with a free face, at the start "
        "and after each stage that changes anything.\n\n"
        "scene: strengths, water, loads and stages are those of this scene; "
        "raises Error if it differs otherwise, as in mesh, materials or bolts "
        "(see leaves_geometry()).\n"
        "wanted: factor to tell the support for.\n"
        "time: of the loads (s).")
      .def("__repr__", [](const BlockList &list) {
        return "<keyblock.Blocks: " + std::to_string(list.rows.size()) + ">";
      });
    module.def(
      "find_blocks",
      [](const std::shared_ptr<AnyScene> &scene, const bool is_verbose) {
        return BlockList(computed(is_verbose, [&]() {
          return AnyBlocks::find(scene, is_verbose);
        }));
      },
      py::arg("scene"),
      py::kw_only(),
      py::arg("verbose") = false,
      "Mesh the scene and find its blocks: Blocks. No step is taken. Raises "
      "Error.");
  }
} // namespace Keyblock::Python

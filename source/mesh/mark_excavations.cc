// SPDX-License-Identifier: LGPL-2.1-or-later
// Which cells are excavated when, and whether rock is left.
#include <keyblock/mesh/mesh_marks.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/mesh/excavation_region.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Whether the generator knows where outlines are. */
    template <int dim>
    bool
    knows_outlines(const Mesh<dim> &mesh)
    {
      return std::any_of(mesh.surfaces.begin(),
                         mesh.surfaces.end(),
                         [](const auto &s) { return !s.is_joint(); });
    }

    /** The piece between outlines that each cell belongs to, if the mesh knows
     * what its faces lie on; else each cell is a piece. Returns their number.
     */
    template <int dim>
    unsigned int
    list_pieces(const Mesh<dim> &mesh, std::vector<unsigned int> &piece)
    {
      piece.assign(mesh.n_cells(), none);
      unsigned int n = 0;
      if (!knows_outlines(mesh))
        {
          for (unsigned int &p : piece)
            p = n++;
          return n;
        }
      const auto key_of = [&mesh](const unsigned int c, const unsigned int f) {
        auto key = mesh.face_vertices(c, f);
        std::sort(key.begin(), key.end());
        return key;
      };
      std::set<typename Mesh<dim>::FaceVertices> outlines;
      for (const auto &face : mesh.marked_faces)
        if (!mesh.surfaces[face.surface].is_joint())
          {
            auto key = face.vertices;
            std::sort(key.begin(), key.end());
            outlines.insert(key);
          }
      // of a face beside smaller cells only its parts are marked
      for (const auto &h : mesh.hanging_faces)
        if (outlines.count(key_of(h.fine_cell, h.fine_face)) > 0)
          outlines.insert(key_of(h.coarse_cell, h.coarse_face));
      std::vector<unsigned int> front;
      for (unsigned int seed = 0; seed < mesh.n_cells(); ++seed)
        {
          if (piece[seed] != none)
            continue;
          piece[seed] = n;
          front       = {seed};
          while (!front.empty())
            {
              const unsigned int c = front.back();
              front.pop_back();
              for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
                if (outlines.count(key_of(c, f)) == 0)
                  mesh.for_each_across(c, f, [&](const unsigned int other) {
                    if (piece[other] == none)
                      {
                        piece[other] = n;
                        front.push_back(other);
                      }
                  });
            }
          ++n;
        }
      return n;
    }



    /** Whether a cell reaches across the outline of an excavation. */
    template <int dim>
    bool
    crosses(const Mesh<dim> &mesh,
            const unsigned int cell,
            const Excavation<dim> &excavation,
            const bool is_inside)
    {
      const double size = std::pow(mesh.cell_volume(cell), 1. / dim);
      for (const unsigned int v : mesh.cells[cell])
        {
          const double depth = depth_inside(excavation, mesh.vertices[v]);
          if (is_inside ? depth < -1e-4 * size : depth > 1e-4 * size)
            return true;
        }
      return false;
    }



    /** Whether a cell is there, as rock that can deform, from a stage on. */
    template <int dim>
    bool
    is_deformable(const Mesh<dim> &mesh,
                  const Scene<dim> &scene,
                  const unsigned int cell,
                  const unsigned int number)
    {
      const unsigned int excavated = mesh.excavation_stage[cell];
      if (excavated == 0 || excavated > number)
        return !scene.materials[mesh.material[cell]]->is_rigid();
      const std::string &filled =
        scene.excavations[mesh.excavation[cell]]->backfill_stage;
      return !filled.empty() && scene.stage_number(filled) <= number;
    }
  } // namespace



  template <int dim>
  void
  mark_excavations(Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    mesh.excavation_stage.assign(mesh.n_cells(), 0);
    mesh.excavation.assign(mesh.n_cells(), none);
    std::vector<unsigned int> piece;
    const unsigned int n_pieces = list_pieces(mesh, piece);
    const bool has_outlines     = knows_outlines(mesh);
    for (unsigned int e = 0; e < scene.excavations.size(); ++e)
      {
        const auto &excavation = scene.excavations[e];
        const bool is_formula  = excavation->shape == ExcavationShape::formula;
        const Expression<dim> formula(is_formula ? excavation->formula : "1",
                                      1,
                                      "Excavations/" + excavation->name +
                                        "/Formula");
        const auto depth_of = [&](const unsigned int c) {
          if (excavation->is_group())
            return means_group("id " + excavation->name,
                               mesh.region[c],
                               mesh.region_names)
                     ? 1.
                     : -1.;
          const Point<dim> center = mesh.cell_center(c);
          return is_formula ? formula.value(center, 0., 0)
                            : depth_inside(*excavation, center);
        };
        std::vector<double> volume_inside(n_pieces, 0.); // minus the rest
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          volume_inside[piece[c]] +=
            depth_of(c) > 0. ? mesh.cell_volume(c) : -mesh.cell_volume(c);
        unsigned int n_hits = 0;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          {
            const bool is_inside = volume_inside[piece[c]] > 0.;
            AssertThrow(!excavation->has_outline() || has_outlines ||
                          !crosses(mesh, c, *excavation, is_inside),
                        InputError(
                          "The mesh does not follow the outline of the "
                          "excavation '" +
                          excavation->name +
                          "': a cell crosses it; set 'Mesh/Generator' to "
                          "gmsh, or move the outline to cell faces."));
            const unsigned int stage = scene.stage_number(excavation->stage);
            if (is_inside && (mesh.excavation_stage[c] == 0 ||
                              stage < mesh.excavation_stage[c]))
              {
                ++n_hits;
                mesh.excavation_stage[c] = stage;
                mesh.excavation[c]       = e;
              }
          }
        AssertThrow(n_hits > 0,
                    InputError(
                      "The excavation '" + excavation->name +
                      "' contains no cell that is not excavated before; "
                      "check 'Excavations/" +
                      excavation->name + "' against the domain."));
      }
  }



  /** Something that can deform has to be left at all times. */
  template <int dim>
  void
  check_rock_is_left(const Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    const auto is_any_left = [&](const unsigned int number) {
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (is_deformable(mesh, scene, c, number))
          return true;
      return false;
    };
    AssertThrow(is_any_left(0),
                InputError("Every cell is of a rigid material, so that "
                           "there is nothing to compute; check "
                           "'Materials/*/Region' and 'Model'."));
    if (scene.excavations.empty())
      return;
    for (unsigned int number = 1; number < scene.stages.size() + 2; ++number)
      AssertThrow(is_any_left(number),
                  InputError(
                    "The excavations take away every cell that can deform " +
                    (number == 1 ? "before the first stage"
                                 : "by the stage '" +
                                     scene.stages[number - 2]->name + "'") +
                    ", so that there is nothing to compute; check the "
                    "section 'Excavations' against 'Domain'."));
  }

  template void mark_excavations(Mesh<2> &, const Scene<2> &);
  template void mark_excavations(Mesh<3> &, const Scene<3> &);
  template void check_rock_is_left(const Mesh<2> &, const Scene<2> &);
  template void check_rock_is_left(const Mesh<3> &, const Scene<3> &);
} // namespace Keyblock

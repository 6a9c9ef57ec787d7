// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/mesh_fidelity.h>

#include <keyblock/base/number_text.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/ground.h>
#include <keyblock/blocks/material_shares.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/place_digits.h>
#include <keyblock/mesh/size_remedy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Distance of a face from its joint's plane over the size of its cell
     * that is not warned of [-]. */
    constexpr double largest_shift = 0.5;

    /** Distance of a cell from the curved face of a solid over the length of
     * its chord that is not warned of: that of 16 chords in a circle [-]. */
    constexpr double largest_sagitta = 0.05;

    constexpr unsigned int most_names = 5;

    /** Where the mesh has a face of a block off its joint. */
    template <int dim>
    struct Shift
    {
      double distance    = 0.; ///< [m]
      double in_cells    = 0.; ///< over the size of the cell [-]
      unsigned int joint = none;
      Point<dim> place;
    };

    template <int dim>
    std::string
    text_of_place(const Point<dim> &place, const int digits)
    {
      std::string text = "(";
      for (unsigned int d = 0; d < dim; ++d)
        text += (d ? ", " : "") + text_of(place[d], digits);
      return text + ")";
    }

    /** Names, of which only the first few are listed. */
    std::string
    list_some(const std::vector<std::string> &names)
    {
      std::string text;
      for (unsigned int i = 0; i < names.size() && i < most_names; ++i)
        text += (i ? ", " : "") + names[i];
      return text + (names.size() > most_names ? ", ..." : "");
    }

    /** The largest shift of each joint, over the size of the cells, on faces
     * of blocks that can move. */
    template <int dim>
    std::vector<Shift<dim>>
    measure_shifts(const Scene<dim> &scene,
                   const SplitMesh<dim> &split,
                   const Blocks<dim> &blocks)
    {
      const Mesh<dim> &mesh = split.mesh;
      std::vector<Shift<dim>> shifts(scene.joints.size());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const unsigned int b = split.block_of_cell[c];
          // joints of rock that stays welded do not move
          if (b == none || (blocks.blocks[b].is_infinite &&
                            scene.contact.weld_infinite_blocks))
            continue;
          const double size = std::pow(mesh.cell_volume(c), 1. / dim);
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              const unsigned int j = mesh.joint[c][f];
              if (j == none)
                continue;
              for (const unsigned int v : mesh.face_vertices(c, f))
                {
                  const double distance =
                    std::abs(scene.joints[j]->distance(mesh.vertices[v]));
                  if (distance > shifts[j].in_cells * size)
                    shifts[j] = {distance,
                                 distance / size,
                                 j,
                                 mesh.vertices[v]};
                }
            }
        }
      return shifts;
    }

    template <int dim>
    std::string
    warning_of_shifts(const Scene<dim> &scene,
                      const std::vector<Shift<dim>> &shifts,
                      const int digits)
    {
      Shift<dim> most;
      std::vector<std::string> names;
      for (const Shift<dim> &shift : shifts)
        if (shift.in_cells > largest_shift)
          {
            names.push_back(scene.joints[shift.joint]->name);
            if (shift.in_cells > most.in_cells)
              most = shift;
          }
      if (names.empty())
        return "";
      return "The mesh has moved faces of blocks off the planes of their "
             "joints (" +
             list_some(names) + "), the most on " +
             scene.joints[most.joint]->name + ", by " +
             text_of(most.distance, 3) + " m at " +
             text_of_place(most.place, digits) + ", " +
             text_of(most.in_cells, 2) + " of the size of the cell there; " +
             remedy_of_coarse_cells(scene.meshing) + ".";
    }

    template <int dim>
    std::string
    warning_of_volumes(const Scene<dim> &scene, const Blocks<dim> &blocks)
    {
      const Block<dim> *most = nullptr;
      double largest         = largest_difference;
      std::vector<std::string> ids;
      for (const Block<dim> &block : blocks.blocks)
        {
          if (block.is_infinite || !block.exact.is_known || block.n_cells == 0)
            continue;
          const double difference =
            deviation(block, block.exact.volume, block.exact.joint_area, scene);
          if (difference <= largest_difference)
            continue;
          ids.push_back(std::to_string(block.id));
          if (difference > largest)
            {
              largest = difference;
              most    = &block;
            }
        }
      if (ids.empty())
        return "";
      std::vector<std::string> faces;
      for (const auto &[joint, area] : most->exact.joint_area)
        if (most->joint_area.count(joint) == 0 &&
            scene.joints[joint]->surface.empty())
          faces.push_back(scene.joints[joint]->name);
      const std::string unit = dim == 2 ? " m2" : " m3";
      return "The mesh gives block " + std::to_string(most->id) + " " +
             text_of(most->volume, 4) + unit + " instead of " +
             text_of(most->exact.volume, 4) + unit +
             " between the planes of its joints" +
             (faces.empty() ? "" : ", and no face on " + list_some(faces)) +
             (ids.size() > 1
                ? " (more than 2 % off are blocks " + list_some(ids) + ")"
                : "") +
             ", and its factor by strength reduction is found with that; " +
             remedy_of_coarse_cells(scene.meshing) + ".";
    }

    std::string
    count_blocks(const unsigned int n_finite, const unsigned int n_exposed)
    {
      return std::to_string(n_finite) + " finite block" +
             (n_finite == 1 ? "" : "s") + ", " + std::to_string(n_exposed) +
             " of them exposed";
    }

    /** Exposed blocks that only the mesh or only the planes have. */
    template <int dim>
    std::string
    warning_of_other_blocks(const Scene<dim> &scene,
                            const Blocks<dim> &blocks,
                            const int digits)
    {
      constexpr unsigned int most_places     = 3;
      const BlockComparison<dim> &comparison = blocks.comparison;
      if (comparison.lost.empty() && comparison.unlike.empty())
        return "";
      unsigned int n_finite = 0, n_exposed = 0;
      for (const Block<dim> &block : blocks.blocks)
        if (!block.is_infinite && block.n_cells > 0)
          {
            ++n_finite;
            n_exposed += block.exposed_stage != none;
          }
      std::ostringstream text;
      text << "The planes of the joints bound "
           << count_blocks(comparison.n_finite, comparison.n_exposed)
           << "; the mesh has " << n_finite << " and " << n_exposed << ".";
      const auto &lost = comparison.lost;
      for (unsigned int i = 0; i < lost.size() && i < most_places; ++i)
        {
          const Block<dim> &block = blocks.blocks[lost[i]];
          text << (i == 0 ? " It lacks exposed ones, of which only limit "
                            "equilibrium says something: "
                          : "; ")
               << "block " << block.id << ", " << text_of(block.exact.volume, 4)
               << (dim == 2 ? " m2" : " m3") << " at "
               << text_of_place(block.exact.centroid, digits);
        }
      if (lost.size() > most_places)
        text << "; and " << lost.size() - most_places << " smaller";
      text << (lost.empty() ? "" : ".");
      std::vector<std::string> ids;
      for (const unsigned int b : comparison.unlike)
        ids.push_back(std::to_string(blocks.blocks[b].id));
      if (ids.size() == 1)
        text << " Its block " << ids[0]
             << " is none of those, and has no factor.";
      else if (!ids.empty())
        text << " Its blocks " << list_some(ids)
             << " are none of those, and have no factor.";
      std::string remedy = remedy_of_coarse_cells(scene.meshing);
      remedy[0]          = std::toupper(remedy[0]);
      return text.str() + " " + remedy + ".";
    }

    /** Where a face of a cell lies off the surface of the solids of an
     * excavation, at its corners or its middle, over the edges of the simplices
     * that cells were made of, two of its own. */
    template <int dim>
    Shift<dim>
    shift_from_solids(const Mesh<dim> &mesh,
                      const CellFace &face,
                      const Excavation<dim> &excavation)
    {
      const double edge =
        2. * std::pow(mesh.face_area_vector(face.cell, face.face).norm(),
                      1. / (dim - 1));
      Shift<dim> most;
      const auto look_at = [&](const Point<dim> &place) {
        const double distance = std::abs(depth_inside(excavation, place));
        if (distance > most.distance)
          most = {distance, distance / edge, none, place};
      };
      for (const unsigned int v : mesh.face_vertices(face.cell, face.face))
        look_at(mesh.vertices[v]);
      look_at(mesh.face_center(face.cell, face.face));
      return most;
    }

    /** The excavation (index) whose surface a face of a cell leaves least. */
    template <int dim>
    unsigned int
    nearest_excavation(const Mesh<dim> &mesh,
                       const CellFace &face,
                       const Scene<dim> &scene)
    {
      unsigned int nearest = none;
      double least         = std::numeric_limits<double>::max();
      for (unsigned int e = 0; e < scene.excavations.size(); ++e)
        if (const double distance =
              shift_from_solids(mesh, face, *scene.excavations[e]).distance;
            distance < least)
          {
            least   = distance;
            nearest = e;
          }
      return nearest;
    }

    /** Excavations of a file whose surface cells leave: curved ones, which they
     * follow by chords. */
    template <int dim>
    std::string
    warning_of_chords(const Scene<dim> &scene, const Mesh<dim> &mesh)
    {
      if (scene.meshing.generator != MeshGenerator::gmsh ||
          std::none_of(scene.excavations.begin(),
                       scene.excavations.end(),
                       [](const auto &excavation) {
                         return excavation->shape == ExcavationShape::file;
                       }))
        return "";
      std::vector<Shift<dim>> shifts(scene.excavations.size());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const unsigned int other = mesh.neighbor[c][f];
            // cells that are gone from the start are none of the mesh; nor are
            // they beyond a joint
            const bool is_bare = other == none && mesh.boundary[c][f] == none &&
                                 mesh.joint[c][f] == none;
            if (mesh.excavation[c] != none ||
                (!is_bare && (other == none || mesh.excavation[other] == none)))
              continue;
            const CellFace face{c, f};
            const unsigned int e = is_bare
                                     ? nearest_excavation(mesh, face, scene)
                                     : mesh.excavation[other];
            if (e == none ||
                scene.excavations[e]->shape != ExcavationShape::file)
              continue;
            const Shift<dim> shift =
              shift_from_solids(mesh, face, *scene.excavations[e]);
            if (shift.in_cells > shifts[e].in_cells &&
                (!is_bare || shift.in_cells < largest_shift))
              shifts[e] = shift;
          }
      Shift<dim> most;
      std::vector<std::string> names;
      for (unsigned int e = 0; e < shifts.size(); ++e)
        if (shifts[e].in_cells > largest_sagitta)
          {
            names.push_back(scene.excavations[e]->name);
            if (shifts[e].in_cells > most.in_cells)
              most = shifts[e];
          }
      if (names.empty())
        return "";
      return "Cells leave the surface of " + list_some(names) + " by up to " +
             text_of(most.distance, 2) + " m, at " +
             text_of_place(most.place, 3) +
             ", as they follow curved faces by chords, so that blocks there "
             "are too large or too small; lower 'Mesh/Size at excavation'" +
             (scene.meshing.size_at_excavation > 0.
                ? " (now " + text_of(scene.meshing.size_at_excavation) + " m)."
                : ".");
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_coarse_mesh(const Scene<dim> &scene,
                          const SplitMesh<dim> &split,
                          const Blocks<dim> &blocks)
  {
    std::vector<std::string> warnings;
    for (const std::string &warning :
         {warning_of_shifts(scene,
                            measure_shifts(scene, split, blocks),
                            digits_of_place(split.mesh, 3)),
          warning_of_other_blocks(scene,
                                  blocks,
                                  digits_of_place(split.mesh, 3)),
          warning_of_volumes(scene, blocks),
          warning_of_chords(scene, split.mesh),
          warning_of_material_shares(scene, split, blocks)})
      if (!warning.empty())
        warnings.push_back(warning);
    return warnings;
  }

  template std::vector<std::string>
  warnings_of_coarse_mesh(const Scene<2> &,
                          const SplitMesh<2> &,
                          const Blocks<2> &);
  template std::vector<std::string>
  warnings_of_coarse_mesh(const Scene<3> &,
                          const SplitMesh<3> &,
                          const Blocks<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/mesh_fidelity.h>

#include <keyblock/base/number_text.h>
#include <keyblock/blocks/ground.h>
#include <keyblock/blocks/material_shares.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/place_digits.h>
#include <keyblock/mesh/size_remedy.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Distance of a face from its joint's plane over the size of its cell
     * that is not warned of [-]. */
    constexpr double largest_shift = 0.5;

    /** Difference of a block's volume from the exact one that is not warned
     * of [-]. */
    constexpr double largest_difference = 0.05;

    /** Difference of volumes from which on their first order says no number
     * [-]. */
    constexpr double far_off = 0.5;

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
      std::string place;
      for (unsigned int d = 0; d < dim; ++d)
        place += (d ? ", " : "") + text_of(most.place[d], digits);
      return "The mesh has moved faces of blocks off the planes of their "
             "joints (" +
             list_some(names) + "), the most on " +
             scene.joints[most.joint]->name + ", by " +
             text_of(most.distance, 3) + " m at (" + place + "), " +
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
          if (block.is_infinite || !block.exact.is_known)
            continue;
          const double difference =
            std::abs(block.volume / block.exact.volume - 1.);
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
      const std::string unit = dim == 2 ? " m2" : " m3";
      return "The mesh gives block " + std::to_string(most->id) + " " +
             text_of(most->volume, 4) + unit + " instead of " +
             text_of(most->exact.volume, 4) + unit +
             " between the planes of its joints" +
             (ids.size() > 1
                ? " (more than 5 % off are blocks " + list_some(ids) + ")"
                : "") +
             ", and its factor by strength reduction is found with that; " +
             remedy_of_coarse_cells(scene.meshing) + ".";
    }

    /** Blocks of which a joint cuts a corner off that the mesh has lost. */
    template <int dim>
    std::string
    warning_of_lost_corners(const Scene<dim> &scene, const Blocks<dim> &blocks)
    {
      std::vector<std::string> cuts;
      for (const Block<dim> &block : blocks.blocks)
        for (const auto &[joint, area] : block.exact.joint_area)
          if (area > 0. && block.exact.bent_area.at(joint) == 0.)
            cuts.push_back(scene.joints[joint]->name + " off block " +
                           std::to_string(block.id));
      if (cuts.empty())
        return "";
      return "Joints cut off corners that the mesh has left on (" +
             list_some(cuts) +
             "); limit equilibrium takes the blocks without them.";
    }

    /** What blocks have too much, as far as the mesh has their faces off their
     * joints, to first order: the integral of the distance [m^dim]. */
    template <int dim>
    std::vector<double>
    volumes_of_shifts(const SplitMesh<dim> &split,
                      const Scene<dim> &scene,
                      const Blocks<dim> &blocks)
    {
      const Mesh<dim> &mesh = split.mesh;
      std::vector<double> volumes(blocks.blocks.size(), 0.);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (const unsigned int b = split.block_of_cell[c]; b != none)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (const unsigned int j = mesh.joint[c][f]; j != none)
              {
                const double area =
                  scene.joints[j]->normal() * mesh.face_area_vector(c, f);
                for (const unsigned int v : mesh.face_vertices(c, f))
                  volumes[b] += area / Mesh<dim>::n_face_vertices *
                                scene.joints[j]->distance(mesh.vertices[v]);
              }
      return volumes;
    }

    /** Blocks whose exact volume is not known, and of which the mesh makes more
     * or less than their joints do. */
    template <int dim>
    std::string
    warning_of_shifted_volumes(const SplitMesh<dim> &split,
                               const Scene<dim> &scene,
                               const Blocks<dim> &blocks)
    {
      const std::vector<double> surplus =
        volumes_of_shifts(split, scene, blocks);
      const auto difference = [&](const unsigned int b) {
        const Block<dim> &block = blocks.blocks[b];
        const double volume     = block.volume - surplus[b];
        return std::abs(surplus[b]) / std::max(volume, 1e-3 * block.volume);
      };
      unsigned int most = none;
      std::vector<std::string> ids;
      for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
        if (!blocks.blocks[b].is_infinite && !blocks.blocks[b].exact.is_known &&
            difference(b) > largest_difference)
          {
            ids.push_back(std::to_string(blocks.blocks[b].id));
            if (most == none || difference(b) > difference(most))
              most = b;
          }
      if (most == none)
        return "";
      const Block<dim> &block = blocks.blocks[most];
      const std::string unit  = dim == 2 ? " m2" : " m3";
      // to first order only
      const bool is_far_off = difference(most) > far_off;
      return "The mesh has moved faces off their joints and gives block " +
             std::to_string(block.id) + " " + text_of(block.volume, 4) + unit +
             (is_far_off
                ? std::string(surplus[most] > 0. ? ", far more"
                                                 : ", far less") +
                    " than there is between them, so that its volume and "
                    "factors mean nothing"
                : " instead of about " +
                    text_of(block.volume - surplus[most], 2) + unit) +
             (ids.size() > 1
                ? " (more than 5 % off are blocks " + list_some(ids) + ")"
                : "") +
             ", and its factors are found with that, by limit equilibrium, too "
             "(a block that is not convex, or that joints bound which end "
             "there, or that the mesh has split); " +
             remedy_of_coarse_cells(scene.meshing) + ".";
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
      std::string place;
      for (unsigned int d = 0; d < dim; ++d)
        place += (d ? ", " : "") + text_of(most.place[d], 3);
      return "Cells leave the surface of " + list_some(names) + " by up to " +
             text_of(most.distance, 2) + " m, at (" + place +
             "), as they follow curved faces by chords, so that blocks there "
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
          warning_of_volumes(scene, blocks),
          warning_of_lost_corners(scene, blocks),
          warning_of_chords(scene, split.mesh),
          warning_of_shifted_volumes(split, scene, blocks),
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

// SPDX-License-Identifier: LGPL-2.1-or-later
// From the generators' cells to the mesh of the run: order, materials,
// excavations, joints and outer boundaries.
#include <keyblock/mesh/mesh.h>

#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    sort_cells_along_hilbert_curve(Mesh<dim> &mesh)
    {
      std::vector<Point<dim>> centers(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        centers[c] = mesh.cell_center(c);
      const auto keys =
        dealii::Utilities::inverse_Hilbert_space_filling_curve(centers, 20);
      std::vector<unsigned int> order(mesh.n_cells());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&keys](unsigned int a, unsigned int b) {
                         return keys[a] < keys[b];
                       });
      auto cells  = mesh.cells;
      auto region = mesh.region;
      for (unsigned int c = 0; c < order.size(); ++c)
        {
          mesh.cells[c]  = cells[order[c]];
          mesh.region[c] = region[order[c]];
        }
      std::vector<unsigned int> place(order.size());
      for (unsigned int c = 0; c < order.size(); ++c)
        place[order[c]] = c;
      for (auto &hanging : mesh.hanging_faces)
        {
          hanging.coarse_cell = place[hanging.coarse_cell];
          hanging.fine_cell   = place[hanging.fine_cell];
        }
      std::sort(mesh.hanging_faces.begin(),
                mesh.hanging_faces.end(),
                [](const auto &a, const auto &b) {
                  return std::tie(a.coarse_cell, a.fine_cell) <
                         std::tie(b.coarse_cell, b.fine_cell);
                });
      // vertices in the order in which the cells meet them
      std::vector<unsigned int> rank(mesh.vertices.size(), none);
      std::vector<Point<dim>> vertices;
      for (auto &cell : mesh.cells)
        for (unsigned int &v : cell)
          {
            if (rank[v] == none)
              {
                rank[v] = vertices.size();
                vertices.push_back(mesh.vertices[v]);
              }
            v = rank[v];
          }
      std::vector<typename Mesh<dim>::BoundaryFace> kept;
      for (auto face : mesh.boundary_faces)
        {
          bool is_used = true;
          for (unsigned int &v : face.vertices)
            is_used = is_used && (v = rank[v]) != none;
          if (is_used)
            kept.push_back(face);
        }
      mesh.boundary_faces = kept;
      for (auto &face : mesh.marked_faces)
        for (unsigned int &v : face.vertices)
          v = rank[v];
      mesh.vertices = std::move(vertices);
    }



    /** The joints below and above the region `band A B` of a material. */
    template <int dim>
    std::array<const Joint<dim> *, 2>
    find_band(const Scene<dim> &scene, const Material<dim> &material)
    {
      const std::vector<std::string> words =
        dealii::Utilities::split_string_list(material.region, ' ');
      std::array<const Joint<dim> *, 2> band{};
      for (unsigned int i = 1; i < std::min<std::size_t>(words.size(), 3); ++i)
        for (const auto &joint : scene.joints)
          if (joint->name == words[i])
            band[i - 1] = joint.get();
      AssertThrow(words.size() == 3 && band[0] && band[1],
                  InputError("The entry 'Materials/" + material.name +
                             "/Region' is '" + material.region +
                             "'; a band is `band A B` with two names of "
                             "'Joints/Names'."));
      // the lower joint first: the upper one's points are above it
      const Point<dim> upper = band[1]->extent == JointShape::polygon
                                 ? band[1]->vertices[0]
                                 : band[1]->point;
      if (band[0]->distance(upper) < 0.)
        std::swap(band[0], band[1]);
      return band;
    }



    template <int dim>
    void
    mark_materials(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      mesh.material.assign(mesh.n_cells(), none);
      for (unsigned int m = 0; m < scene.materials.size(); ++m)
        {
          const std::string &region = scene.materials[m]->region;
          unsigned int n_hits       = 0;
          const bool is_id          = region.rfind("id ", 0) == 0;
          const bool is_all         = region == "all";
          const bool is_band        = region.rfind("band ", 0) == 0;
          const auto band = is_band ? find_band(scene, *scene.materials[m])
                                    : std::array<const Joint<dim> *, 2>{};
          const Expression<dim> inside((is_id || is_all || is_band) ? "1"
                                                                    : region,
                                       1,
                                       "Materials/" + scene.materials[m]->name +
                                         "/Region");
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            if (is_all ||
                (is_id && region.substr(3) == std::to_string(mesh.region[c])) ||
                (is_band && band[0]->distance(mesh.cell_center(c)) > 0. &&
                 band[1]->distance(mesh.cell_center(c)) < 0.) ||
                (!is_id && !is_band &&
                 inside.value(mesh.cell_center(c), 0., 0) > 0.))
              {
                if (scene.materials[m]->stage.empty())
                  mesh.material[c] = m;
                else
                  {
                    mesh.later_materials.resize(mesh.n_cells());
                    mesh.later_materials[c].push_back(m);
                  }
                ++n_hits;
              }
          AssertThrow(n_hits > 0,
                      InputError("No cell lies in the region '" + region +
                                 "' of the entry 'Materials/" +
                                 scene.materials[m]->name +
                                 "/Region'; correct it or drop the material."));
        }
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        AssertThrow(mesh.material[c] != none,
                    InputError(
                      "A cell at " +
                      dealii::Utilities::to_string(mesh.cell_center(c)[0]) +
                      ", " +
                      dealii::Utilities::to_string(mesh.cell_center(c)[1]) +
                      " has no material; extend one of the entries "
                      "'Materials/*/Region', for example the first to all."));
      for (unsigned int c = 0; c < mesh.later_materials.size(); ++c)
        for (const unsigned int later : mesh.later_materials[c])
          AssertThrow(!scene.materials[mesh.material[c]]->is_rigid(),
                      InputError("The entry 'Materials/" +
                                 scene.materials[later]->name +
                                 "/Region' contains cells of the rigid "
                                 "material '" +
                                 scene.materials[mesh.material[c]]->name +
                                 "', which cannot change; restrict it to "
                                 "deformable ones."));
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
      if (mesh.surfaces.empty())
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



    template <int dim>
    void
    mark_excavations(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      mesh.excavation_stage.assign(mesh.n_cells(), 0);
      mesh.excavation.assign(mesh.n_cells(), none);
      std::vector<unsigned int> piece;
      const unsigned int n_pieces = list_pieces(mesh, piece);
      for (unsigned int e = 0; e < scene.excavations.size(); ++e)
        {
          const auto &excavation = scene.excavations[e];
          const bool is_formula = excavation->shape == ExcavationShape::formula;
          const Expression<dim> formula(is_formula ? excavation->formula : "1",
                                        1,
                                        "Excavations/" + excavation->name +
                                          "/Formula");
          std::vector<double> volume_inside(n_pieces, 0.); // minus the rest
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            {
              const Point<dim> center = mesh.cell_center(c);
              const double depth      = is_formula
                                          ? formula.value(center, 0., 0)
                                          : depth_inside(*excavation, center);
              volume_inside[piece[c]] +=
                depth > 0. ? mesh.cell_volume(c) : -mesh.cell_volume(c);
            }
          unsigned int n_hits = 0;
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            {
              const bool is_inside = volume_inside[piece[c]] > 0.;
              AssertThrow(is_formula || !mesh.surfaces.empty() ||
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



    /** Mean of the points where the joint's plane cuts the edges of a cell. */
    template <int dim>
    Point<dim>
    cut_center(const Mesh<dim> &mesh,
               const unsigned int cell,
               const std::vector<double> &distance)
    {
      Point<dim> sum;
      unsigned int n = 0;
      for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int a = mesh.cells[cell][v & ~(1u << d)];
            const unsigned int b = mesh.cells[cell][v | (1u << d)];
            if ((distance[a] < 0.) != (distance[b] < 0.))
              {
                const double s = distance[a] / (distance[a] - distance[b]);
                sum +=
                  mesh.vertices[a] + s * (mesh.vertices[b] - mesh.vertices[a]);
                ++n;
              }
          }
      return sum / n;
    }



    /** Mark joints as the generator knows them: of several on one face the
     * first of the scene. */
    template <int dim>
    void
    mark_known_joints(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      std::map<typename Mesh<dim>::FaceVertices,
               const typename Mesh<dim>::MarkedFace *>
        known;
      const auto joint_of = [&mesh](const auto &face) {
        return mesh.surfaces[face.surface].joint;
      };
      for (const auto &face : mesh.marked_faces)
        if (joint_of(face) != no_index)
          {
            auto key = face.vertices;
            std::sort(key.begin(), key.end());
            const auto entry = known.emplace(key, &face).first;
            if (rules(scene, joint_of(face), joint_of(*entry->second)))
              entry->second = &face;
          }
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const auto vertices = mesh.face_vertices(c, f);
            auto key            = vertices;
            std::sort(key.begin(), key.end());
            const auto found = known.find(key);
            if (found == known.end())
              continue;
            mesh.joint[c][f] = joint_of(*found->second);
            mesh.side[c][f] =
              turn_alike<dim>(vertices, found->second->vertices) ==
                  is_inward<dim>(f)
                ? 1
                : -1;
          }
    }



    /** A joint without a face is left out if it is outside the mesh, and
     * refused if it is not. */
    template <int dim>
    void
    skip_joint(Mesh<dim> &mesh,
               const Scene<dim> &scene,
               const unsigned int index)
    {
      const Joint<dim> &joint = *scene.joints[index];
      const JointExtent<dim> extent(joint);
      std::vector<Point<dim>> places;
      if (!extent.is_infinite())
        places = extent.outermost_points();
      bool is_inside = false;
      for (unsigned int c = 0; c < mesh.n_cells() && !is_inside; ++c)
        {
          const Point<dim> center = mesh.cell_center(c);
          for (const Point<dim> &place : places)
            {
              bool is_near = true;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double reach = 0.;
                  for (const unsigned int v : mesh.cells[c])
                    reach = std::max(reach,
                                     std::abs(mesh.vertices[v][d] - center[d]));
                  is_near = is_near && std::abs(place[d] - center[d]) < reach;
                }
              is_inside = is_inside || is_near;
            }
        }
      AssertThrow(!is_inside,
                  InputError("The joint '" + joint.name +
                             "' lies between the faces of the cells, so that "
                             "none is on it; set 'Mesh/Generator' to gmsh, or "
                             "move it to cell faces ('Joints/" +
                             joint.name + "/Point', 'Dip' and 'Extent')."));
      mesh.report.outside.push_back(index);
    }



    /** Mark the faces on a joint, of several joints for the one that rules, and
     * add up its area. */
    template <int dim>
    void
    mark_joint(Mesh<dim> &mesh,
               const Scene<dim> &scene,
               const unsigned int index,
               std::vector<double> &area_of)
    {
      const Joint<dim> &joint     = *scene.joints[index];
      const double tolerance      = scene.meshing.joint_tolerance;
      const Tensor<1, dim> normal = joint.normal();
      const Point<dim> origin =
        joint.extent == JointShape::polygon ? joint.vertices[0] : joint.point;
      std::vector<double> distance(mesh.vertices.size());
      for (unsigned int v = 0; v < distance.size(); ++v)
        distance[v] = normal * (mesh.vertices[v] - origin);

      std::map<std::pair<unsigned int, unsigned int>, double> shared;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const double size = std::pow(mesh.cell_volume(c), 1. / dim);
          double least = 0., greatest = 0.;
          for (const unsigned int v : mesh.cells[c])
            {
              least    = std::min(least, distance[v]);
              greatest = std::max(greatest, distance[v]);
            }
          if (greatest > tolerance * size && least < -tolerance * size)
            AssertThrow(!joint.is_within_extent(cut_center(mesh, c, distance),
                                                -1e-3 * size),
                        InputError(
                          "The mesh does not follow the joint '" + joint.name +
                          "': a cell crosses it near x = " +
                          std::to_string(mesh.cell_center(c)[0]) +
                          ", y = " + std::to_string(mesh.cell_center(c)[1]) +
                          "; set 'Mesh/Generator' to gmsh, move the joint to "
                          "cell faces, or raise 'Mesh/Joint tolerance'."));
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              bool is_on_plane = true;
              for (const unsigned int v : mesh.face_vertices(c, f))
                is_on_plane =
                  is_on_plane && std::abs(distance[v]) <= tolerance * size;
              if (!is_on_plane ||
                  !joint.is_within_extent(mesh.face_center(c, f), 0.))
                continue;
              // of inner faces each cell sees one half
              const double here = mesh.face_area_vector(c, f).norm() *
                                  (mesh.neighbor[c][f] == none ? 1. : 0.5);
              area_of[index] += here;
              const unsigned int before = mesh.joint[c][f];
              const bool is_ruling =
                before == none || rules(scene, index, before);
              if (before != none)
                shared[is_ruling ? std::make_pair(index, before)
                                 : std::make_pair(before, index)] += here;
              if (!is_ruling)
                continue;
              mesh.joint[c][f] = index;
              mesh.side[c][f] =
                joint.distance(mesh.cell_center(c)) > 0. ? 1 : -1;
            }
        }
      for (const auto &[pair, both] : shared)
        mesh.report.merged.push_back(
          {pair.first,
           pair.second,
           both,
           both > (1. - 1e-9) * area_of[pair.second]});
      if (area_of[index] == 0.)
        skip_joint(mesh, scene, index);
    }



    /** Refuse scenes whose check is on a joint that is not in the model. */
    template <int dim>
    void
    check_joint_of_check(const Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      for (const unsigned int j : mesh.report.outside)
        AssertThrow(scene.checks.joint.empty() ||
                      scene.joints_called(scene.checks.joint).front() != j,
                    InputError("The entry 'Check/Joint' is '" +
                               scene.checks.joint +
                               "', but that joint is outside the model; check "
                               "'Joints/" +
                               scene.joints[j]->name +
                               "/Point', 'Dip' and 'Extent' against "
                               "'Domain'."));
    }



    /** Note the joints of an exact mesh that have no face in it. */
    template <int dim>
    void
    list_joints_outside(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      std::vector<bool> is_inside(scene.joints.size(), false);
      for (const auto &face : mesh.marked_faces)
        if (mesh.surfaces[face.surface].is_joint())
          is_inside[mesh.surfaces[face.surface].joint] = true;
      for (unsigned int j = 0; j < is_inside.size(); ++j)
        if (!is_inside[j])
          mesh.report.outside.push_back(j);
    }



    /** Outer faces on edge number i of a polygon, from 1, get `id i`. */
    void
    mark_polygon_edges(Mesh<2> &mesh, const std::vector<Point<2>> &corners)
    {
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          const Point<2> &a       = corners[i];
          const Tensor<1, 2> edge = corners[(i + 1) % corners.size()] - a;
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (unsigned int f = 0; f < Mesh<2>::n_cell_faces; ++f)
              {
                bool is_on_edge = mesh.neighbor[c][f] == none;
                for (const unsigned int v : mesh.face_vertices(c, f))
                  {
                    const Tensor<1, 2> way = mesh.vertices[v] - a;
                    const double along     = way * edge / edge.norm_square();
                    is_on_edge =
                      is_on_edge && along > -1e-7 && along < 1. + 1e-7 &&
                      (way - along * edge).norm() < 1e-7 * edge.norm();
                  }
                if (is_on_edge)
                  mesh.boundary_id[c][f] = i + 1;
              }
        }
    }



    /** Mark the faces on the sides of the domain: of its frame if it is a box
     * or parallelepiped, else of its bounding box. */
    template <int dim>
    void
    mark_boundaries(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      Point<dim> origin = mesh.vertices[0];
      Tensor<2, dim> frame;
      if (scene.domain.shape == DomainShape::box ||
          scene.domain.shape == DomainShape::parallelepiped)
        {
          origin = scene.domain.corner;
          for (unsigned int d = 0; d < dim; ++d)
            if (scene.domain.shape == DomainShape::box)
              frame[d][d] = scene.domain.size[d];
            else
              frame[d] = scene.domain.edges[d];
        }
      else
        {
          Point<dim> far = origin;
          for (const Point<dim> &p : mesh.vertices)
            for (unsigned int d = 0; d < dim; ++d)
              {
                origin[d] = std::min(origin[d], p[d]);
                far[d]    = std::max(far[d], p[d]);
              }
          for (unsigned int d = 0; d < dim; ++d)
            frame[d][d] = far[d] - origin[d];
        }
      const Tensor<2, dim> to_unit = transpose(invert(frame));

      std::array<unsigned int, Mesh<dim>::n_cell_faces> no_face;
      no_face.fill(none);
      mesh.boundary.assign(mesh.n_cells(), no_face);
      mesh.boundary_id.assign(mesh.n_cells(), no_face);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          if (mesh.neighbor[c][f] == none)
            for (unsigned int side = 0; side < 2 * dim; ++side)
              {
                bool is_on_side = true;
                for (const unsigned int v : mesh.face_vertices(c, f))
                  {
                    const Tensor<1, dim> unit =
                      to_unit * (mesh.vertices[v] - origin);
                    is_on_side =
                      is_on_side && std::abs(unit[side / 2] - side % 2) < 1e-7;
                  }
                if (is_on_side)
                  mesh.boundary[c][f] = side;
              }

      if constexpr (dim == 2)
        if (scene.domain.shape == DomainShape::polygon)
          mark_polygon_edges(mesh, scene.domain.polygon);
      std::map<typename Mesh<dim>::FaceVertices, unsigned int> ids;
      for (auto face : mesh.boundary_faces)
        {
          std::sort(face.vertices.begin(), face.vertices.end());
          ids[face.vertices] = face.id;
        }
      if (!ids.empty())
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            if (mesh.neighbor[c][f] == none)
              {
                auto key = mesh.face_vertices(c, f);
                std::sort(key.begin(), key.end());
                const auto found = ids.find(key);
                if (found != ids.end())
                  mesh.boundary_id[c][f] = found->second;
              }
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  make_mesh(const Communicator &communicator,
            const Scene<dim> &scene,
            const dealii::ConditionalOStream &out,
            const std::vector<SizeDemand<dim>> &demands)
  {
    Mesh<dim> mesh;
    communicator.on_root([&]() {
      if (scene.meshing.generator == MeshGenerator::structured)
        mesh = make_structured_mesh(scene);
      else if (scene.meshing.generator == MeshGenerator::gmsh)
        mesh = make_gmsh_mesh(scene, out, demands);
      else
        mesh = read_mesh(scene);
      if (scene.meshing.is_refined())
        refine_mesh(mesh, scene);
      sort_cells_along_hilbert_curve(mesh);
    });
    communicator.broadcast(mesh.vertices);
    communicator.broadcast(mesh.cells);
    communicator.broadcast(mesh.region);
    communicator.broadcast(mesh.boundary_faces);
    communicator.broadcast(mesh.hanging_faces);
    communicator.broadcast(mesh.surfaces);
    communicator.broadcast(mesh.marked_faces);

    find_neighbors(mesh);
    mark_boundaries(mesh, scene);
    mark_materials(mesh, scene);
    mark_excavations(mesh, scene);
    check_rock_is_left(mesh, scene);
    std::array<unsigned int, Mesh<dim>::n_cell_faces> no_face;
    no_face.fill(none);
    mesh.joint.assign(mesh.n_cells(), no_face);
    std::array<signed char, Mesh<dim>::n_cell_faces> no_side;
    no_side.fill(0);
    mesh.side.assign(mesh.n_cells(), no_side);
    if (scene.meshing.generator == MeshGenerator::gmsh)
      mark_known_joints(mesh, scene);
    else
      {
        std::vector<double> area_of(scene.joints.size(), 0.); // [m^(dim-1)]
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          mark_joint(mesh, scene, j, area_of);
      }
    communicator.on_root([&]() {
      if (mesh.report.way == "exact")
        list_joints_outside(mesh, scene);
      check_joint_of_check(mesh, scene);
    });
    return mesh;
  }



  template Mesh<2> make_mesh(const Communicator &,
                             const Scene<2> &,
                             const dealii::ConditionalOStream &,
                             const std::vector<SizeDemand<2>> &);
  template Mesh<3> make_mesh(const Communicator &,
                             const Scene<3> &,
                             const dealii::ConditionalOStream &,
                             const std::vector<SizeDemand<3>> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Local refinement: cells halved near excavations, joints and where a formula
// says so. The tree lives only here; what follows sees a flat list of cells and
// which of their vertices hang.
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/grid/tria.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/face_marks.h>
#include <keyblock/mesh/mesh.h>
#include <keyblock/mesh/size_limit.h>

#include <cmath>
#include <map>
#include <memory>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** How often a cell may be halved. */
    constexpr unsigned int most_levels = 10;

    template <int dim>
    class Refinement
    {
    public:
      Refinement(const Scene<dim> &scene, const Mesh<dim> &coarse)
        : scene(scene)
        , levels(scene.meshing.refinement_levels.empty()
                   ? "0"
                   : scene.meshing.refinement_levels,
                 1,
                 "Mesh/Refinement levels")
        , tree(dealii::Triangulation<dim>::limit_level_difference_at_vertices)
      {
        for (const auto &excavation : scene.excavations)
          formulas.push_back(std::make_unique<Expression<dim>>(
            excavation->shape == ExcavationShape::formula ? excavation->formula
                                                          : "-1",
            1,
            "Excavations/" + excavation->name + "/Formula"));
        plant(coarse);
        bend_outlines();
      }

      void
      refine()
      {
        while (flag_cells())
          {
            do
              tree.prepare_coarsening_and_refinement();
            while (flag_across_interfaces() | flag_around_crossings());
            tree.execute_coarsening_and_refinement();
            marks->pass_on();
          }
      }

      Mesh<dim>
      flatten() const
      {
        Mesh<dim> mesh;
        mesh.vertices = tree.get_vertices();
        mesh.surfaces = marks->all_surfaces();
        mesh.report   = report;
        for (const auto &cell : tree.active_cell_iterators())
          {
            const unsigned int c = cell->active_cell_index();
            typename Mesh<dim>::CellVertices vertices;
            for (const unsigned int v : cell->vertex_indices())
              vertices[v] = cell->vertex_index(v);
            mesh.cells.push_back(vertices);
            mesh.region.push_back(cell->material_id());
            for (const unsigned int f : cell->face_indices())
              if (cell->at_boundary(f))
                {
                  if (cell->face(f)->boundary_id() > 0)
                    mesh.boundary_faces.push_back(
                      {mesh.face_vertices(c, f),
                       id_of_boundary[cell->face(f)->boundary_id() - 1]});
                }
              else if (cell->neighbor_is_coarser(f))
                mesh.hanging_faces.push_back(
                  {cell->neighbor(f)->active_cell_index(),
                   cell->neighbor_of_coarser_neighbor(f).first,
                   c,
                   f});
          }
        mesh.marked_faces = marks->list();
        for (const HangingVertex &hanging : list_hanging_vertices(mesh))
          {
            // off the middle only where an outline is bent along its axis
            Point<dim> middle;
            for (const auto &[master, weight] : hanging.masters)
              middle += weight * mesh.vertices[master];
            mesh.vertices[hanging.vertex] = middle;
          }
        return mesh;
      }

    private:
      using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

      void
      plant(const Mesh<dim> &coarse)
      {
        std::vector<dealii::CellData<dim>> cells(coarse.n_cells());
        for (unsigned int c = 0; c < coarse.n_cells(); ++c)
          {
            std::copy(coarse.cells[c].begin(),
                      coarse.cells[c].end(),
                      cells[c].vertices.begin());
            cells[c].material_id = coarse.region[c];
          }
        if (dim == 2)
          dealii::GridTools::consistently_order_cells(cells);
        tree.create_triangulation(coarse.vertices,
                                  cells,
                                  dealii::SubCellData());
        std::map<typename Mesh<dim>::FaceVertices, unsigned int> ids;
        for (auto face : coarse.boundary_faces)
          {
            std::sort(face.vertices.begin(), face.vertices.end());
            const auto place =
              std::find(id_of_boundary.begin(), id_of_boundary.end(), face.id);
            ids[face.vertices] = 1 + (place - id_of_boundary.begin());
            if (place == id_of_boundary.end())
              id_of_boundary.push_back(face.id);
          }
        for (const auto &face : tree.active_face_iterators())
          if (face->at_boundary())
            {
              typename Mesh<dim>::FaceVertices key;
              for (const unsigned int v : face->vertex_indices())
                key[v] = face->vertex_index(v);
              std::sort(key.begin(), key.end());
              const auto found = ids.find(key);
              face->set_boundary_id(found == ids.end() ? 0 : found->second);
            }
        marks  = std::make_unique<FaceMarks<dim>>(tree, coarse);
        report = coarse.report;
      }

      /** Let new vertices on circular outlines go to the circle. */
      void
      bend_outlines()
      {
        if constexpr (dim == 2)
          for (unsigned int e = 0; e < scene.excavations.size(); ++e)
            {
              const Excavation<dim> &excavation = *scene.excavations[e];
              if (excavation.shape != ExcavationShape::circle)
                continue;
              tree.set_manifold(e + 1,
                                dealii::SphericalManifold<dim>(
                                  Point<dim>(excavation.center)));
              for (const auto &face : tree.active_face_iterators())
                if (std::abs(depth_inside(excavation, face->vertex(0))) +
                      std::abs(depth_inside(excavation, face->vertex(1))) <
                    1e-6 * excavation.radius)
                  face->set_manifold_id(e + 1);
            }
      }

      bool
      is_near_outline(const Cell &cell, const double distance) const
      {
        for (const auto &excavation : scene.excavations)
          {
            if (!excavation->has_outline())
              continue;
            double least = 1e300, greatest = -1e300;
            for (const unsigned int v : cell->vertex_indices())
              {
                const double depth = depth_inside(*excavation, cell->vertex(v));
                least              = std::min(least, depth);
                greatest           = std::max(greatest, depth);
              }
            if (least < distance && greatest > -distance)
              return true;
          }
        return false;
      }

      bool
      is_near_joint(const Cell &cell, const double distance) const
      {
        for (const auto &joint : scene.joints)
          for (const unsigned int v : cell->vertex_indices())
            {
              const double height = joint->distance(cell->vertex(v));
              if (std::abs(height) < distance &&
                  joint->is_within_extent(cell->vertex(v) -
                                            height * joint->normal(),
                                          distance))
                return true;
            }
        return false;
      }

      unsigned int
      wanted_level(const Cell &cell) const
      {
        const Meshing<dim> &meshing = scene.meshing;
        const double by_formula     = levels.value(cell->center(), 0., 0);
        if (!(std::abs(by_formula) < most_levels + 0.5))
          {
            std::ostringstream text;
            text << "The formula of the entry 'Mesh/Refinement levels' gives "
                 << by_formula << " at (" << cell->center()
                 << ") m; it must give how often cells are halved there, and "
                    "more than ten times is too much.";
            AssertThrow(false, InputError(text.str()));
          }
        unsigned int level = by_formula > 0.5 ? std::lround(by_formula) : 0;
        for (unsigned int i = level; i < meshing.refine_at_excavations.size();
             ++i)
          if (is_near_outline(cell, meshing.refine_at_excavations[i]))
            level = i + 1;
        for (unsigned int i = level; i < meshing.refine_at_joints.size(); ++i)
          if (is_near_joint(cell, meshing.refine_at_joints[i]))
            level = i + 1;
        return level;
      }

      bool
      flag_cells()
      {
        double n_flags = 0.;
        for (const auto &cell : tree.active_cell_iterators())
          {
            const unsigned int wanted = wanted_level(cell);
            AssertThrow(wanted <= most_levels,
                        InputError(
                          "A cell is to be halved " + std::to_string(wanted) +
                          " times, more than ten, by 'Mesh/Refine at "
                          "excavations' or 'Refine at joints'; give fewer "
                          "distances, or lower 'Mesh/Size'."));
            if (unsigned(cell->level()) < wanted)
              {
                cell->set_refine_flag();
                ++n_flags;
              }
          }
        require_size<dim>(tree.n_active_cells() + n_flags * ((1u << dim) - 1),
                          scene.joints.size(),
                          "refinement",
                          [](double) {
                            return "refine less often, or less of the domain";
                          });
        return n_flags > 0.;
      }

      /** Whether a face lies on a joint: as the generator knows, else by its
       * place. */
      template <typename Face>
      bool
      is_on_joint(const Face &face, const double size) const
      {
        return marks->are_known()
                 ? marks->is_on_joint(face)
                 : count_joints_at(face->center(true), size) > 0;
      }

      /** Lines at which several joints meet, by their index: as the generator
       * knows, else by their place. */
      std::vector<bool>
      find_crossings() const
      {
        if (marks->are_known())
          return marks->find_crossings();
        std::vector<bool> is_crossing(tree.n_raw_lines(), false);
        for (const auto &cell : tree.active_cell_iterators())
          for (const unsigned int l : cell->line_indices())
            is_crossing[cell->line(l)->index()] =
              count_joints_at(cell->line(l)->center(),
                              cell->line(l)->diameter()) > 1;
        return is_crossing;
      }

      unsigned int
      count_joints_at(const Point<dim> &place, const double size) const
      {
        unsigned int n = 0;
        for (const auto &joint : scene.joints)
          n += std::abs(joint->distance(place)) < 1e-6 * size &&
               joint->is_within_extent(place, 1e-6 * size);
        return n;
      }

      bool
      is_outline_between(const Cell &a, const Cell &b) const
      {
        for (unsigned int e = 0; e < scene.excavations.size(); ++e)
          {
            if (scene.excavations[e]->is_group() &&
                a->material_id() != b->material_id())
              return true;
            const auto depth = [&](const Point<dim> &p) {
              return scene.excavations[e]->shape == ExcavationShape::formula
                       ? formulas[e]->value(p, 0., 0)
                       : depth_inside(*scene.excavations[e], p);
            };
            if ((depth(a->center()) > 0.) != (depth(b->center()) > 0.))
              return true;
          }
        return false;
      }

      /** Cells that face each other across a joint or outline are refined
       * alike, so that every node there has its partner. */
      bool
      flag_across_interfaces()
      {
        bool has_changed = false;
        for (const auto &cell : tree.active_cell_iterators())
          if (cell->refine_flag_set())
            for (const unsigned int f : cell->face_indices())
              {
                if (cell->at_boundary(f) || cell->neighbor(f)->has_children())
                  continue;
                const Cell other = cell->neighbor(f);
                if (!other->refine_flag_set() &&
                    (is_on_joint(cell->face(f), cell->diameter()) ||
                     is_outline_between(cell, other)))
                  {
                    other->set_refine_flag();
                    has_changed = true;
                  }
              }
        return has_changed;
      }

      /** In 3D the cells around a line where joints cross as well: else a node
       * in its middle hangs in one of the blocks and not in the other. */
      bool
      flag_around_crossings()
      {
        bool has_changed = false;
        if constexpr (dim == 3)
          {
            const std::vector<bool> is_crossing = find_crossings();
            std::vector<bool> is_flagged(tree.n_raw_lines(), false);
            for (const auto &cell : tree.active_cell_iterators())
              if (cell->refine_flag_set())
                for (const unsigned int l : cell->line_indices())
                  is_flagged[cell->line(l)->index()] = true;
            for (const auto &cell : tree.active_cell_iterators())
              if (!cell->refine_flag_set())
                for (const unsigned int l : cell->line_indices())
                  if (is_flagged[cell->line(l)->index()] &&
                      is_crossing[cell->line(l)->index()])
                    {
                      cell->set_refine_flag();
                      has_changed = true;
                    }
          }
        return has_changed;
      }

      const Scene<dim> &scene;
      Expression<dim> levels;
      std::vector<std::unique_ptr<Expression<dim>>>
        formulas; ///< of excavations
      dealii::Triangulation<dim> tree;
      std::vector<unsigned int> id_of_boundary;
      std::unique_ptr<FaceMarks<dim>> marks; ///< of faces of the tree
      MeshReport<dim> report;
    };



  } // namespace



  template <int dim>
  void
  refine_mesh(Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    Refinement<dim> refinement(scene, mesh);
    refinement.refine();
    Mesh<dim> refined         = refinement.flatten();
    refined.region_names      = mesh.region_names;
    refined.boundary_id_names = mesh.boundary_id_names;
    mesh                      = std::move(refined);
  }



  template void refine_mesh(Mesh<2> &, const Scene<2> &);
  template void refine_mesh(Mesh<3> &, const Scene<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/improvement.h>
#include <keyblock/mesh/joint_cut_steps.h>
#include <keyblock/mesh/pieces.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** What moved faces may change of the volume of a piece [-], and how far
     * a vertex may lie off its joints, over the target size: one that is caught
     * at a toe holds a whole block. */
    constexpr double largest_change = 0.02, farthest = 1e-3;

    /** Pieces at the model's outer faces of more cells than this are rock that
     * stays, or so large that moved faces change little. */
    constexpr double most_cells = 300.;

    /** Quality to which cells may go for it, and the least step with them, and
     * how often each vertex is tried: its neighbours must make way. */
    constexpr double quality_of_block_faces = 0.12;
    constexpr unsigned int n_tries          = 3;



    /** Finds the pieces that moved faces have changed. */
    template <int dim>
    class PieceCheck
    {
    public:
      PieceCheck(const SimplexMesh<dim> &mesh, const Scene<dim> &scene)
        : pieces(mesh)
        , most_outer_cells(is_truncated_all_around(scene) ? 0. : most_cells)
        , surplus(pieces.volume.size(), 0.)
        , off_joint(pieces.volume.size(), 0.)
        , is_outer(pieces.volume.size(), false)
        , is_bare(pieces.volume.size(), false)
      {
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (mesh.cells[c].is_alive)
            for (unsigned int i = 0; i <= dim; ++i)
              look_at_facet(mesh, c, i);
        for (unsigned int p = 0; p < pieces.volume.size(); ++p)
          if (counts(p) && !is_excavated(scene, pieces.center[p]))
            {
              counted.insert(p);
              if (is_changed(p))
                changed.insert(p);
            }
      }

      unsigned int
      n() const
      {
        return changed.size();
      }

      /** Their vertices on joints, ascending. */
      std::vector<unsigned int>
      vertices_on_joints(const SimplexMesh<dim> &mesh) const
      {
        return vertices_of(changed, mesh);
      }

      /** Those of all pieces whose faces count. */
      std::vector<unsigned int>
      vertices_that_count(const SimplexMesh<dim> &mesh) const
      {
        return vertices_of(counted, mesh);
      }

    private:
      std::vector<unsigned int>
      vertices_of(const std::set<unsigned int> &list,
                  const SimplexMesh<dim> &mesh) const
      {
        std::set<unsigned int> found;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (mesh.cells[c].is_alive && list.count(pieces.of_cell[c]) > 0)
            for (const unsigned int v : mesh.cells[c].vertices)
              if (!mesh.bound_to[v].empty())
                found.insert(v);
        return {found.begin(), found.end()};
      }

      /** To first order: the integral of the distance from the joint. */
      void
      look_at_facet(const SimplexMesh<dim> &mesh,
                    const unsigned int cell,
                    const unsigned int i)
      {
        const unsigned int piece = pieces.of_cell[cell];
        const auto facet         = mesh.facet(cell, i);
        if (mesh.neighbor(cell, i) == no_index)
          is_outer[piece] = true;
        const auto found = mesh.marks.find(facet);
        if (found == mesh.marks.end())
          return;
        if (!mesh.surfaces[found->second.front().surface].is_joint())
          is_bare[piece] = true;
        double farthest_mean = 0.; // of several joints that share the facet
        for (const auto &mark : found->second)
          if (const Surface<dim> &joint = mesh.surfaces[mark.surface];
              joint.is_joint())
            {
              double mean = 0.;
              for (const unsigned int v : facet)
                {
                  const double distance = joint.distance(mesh.vertices[v]);
                  mean += distance / dim;
                  off_joint[piece] =
                    std::max(off_joint[piece],
                             std::abs(distance) / mesh.target_size[v]);
                }
              const bool is_above =
                mesh.is_on_positive_side(cell, i) == mark.plus_is_positive;
              if (std::abs(mean) > std::abs(farthest_mean))
                farthest_mean = is_above ? -mean : mean;
            }
        surplus[piece] += farthest_mean * mesh.measure(facet);
      }

      /** Whether a piece may fall out of an outline. */
      bool
      counts(const unsigned int piece) const
      {
        return is_bare[piece] &&
               (!is_outer[piece] ||
                pieces.volume[piece] <
                  most_outer_cells * pieces.wanted_volume[piece]);
      }

      bool
      is_changed(const unsigned int piece) const
      {
        return std::abs(surplus[piece]) >
                 largest_change * pieces.volume[piece] ||
               off_joint[piece] > farthest;
      }

      static bool
      is_truncated_all_around(const Scene<dim> &scene)
      {
        const auto &names = scene.domain.truncated_boundaries;
        return std::count(names.begin(), names.end(), "all") > 0;
      }

      static bool
      is_excavated(const Scene<dim> &scene, const Point<dim> &p)
      {
        return std::any_of(scene.excavations.begin(),
                           scene.excavations.end(),
                           [&p](const auto &excavation) {
                             return excavation->has_outline() &&
                                    depth_inside(*excavation, p) > 0.;
                           });
      }

      const Pieces<dim> pieces;
      const double most_outer_cells;
      std::vector<double> surplus;   ///< by piece, to first order [m^dim]
      std::vector<double> off_joint; ///< the farthest vertex, see above [-]
      std::vector<bool> is_outer;    ///< at the model's outer faces
      std::vector<bool> is_bare;     ///< at an outline
      std::set<unsigned int> counted, changed;
    };
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  list_block_vertices(const SimplexMesh<dim> &mesh, const Scene<dim> &scene)
  {
    return PieceCheck<dim>(mesh, scene).vertices_that_count(mesh);
  }



  template <int dim>
  ChangedPieces<dim>
  straighten_pieces(SimplexMesh<dim> &mesh, const Scene<dim> &scene)
  {
    MeshImprovement<dim> improvement(mesh, 0.);
    for (unsigned int i = 0; i < n_tries; ++i)
      {
        const PieceCheck<dim> changed(mesh, scene);
        if (changed.n() == 0)
          return {};
        improvement.flatten(quality_of_block_faces,
                            changed.vertices_on_joints(mesh));
      }
    const PieceCheck<dim> left(mesh, scene);
    ChangedPieces<dim> result;
    result.n = left.n();
    for (const unsigned int v : left.vertices_on_joints(mesh))
      result.vertices.emplace_back(mesh.vertices[v], mesh.target_size[v]);
    return result;
  }

  template std::vector<unsigned int> list_block_vertices(const SimplexMesh<2> &,
                                                         const Scene<2> &);
  template std::vector<unsigned int> list_block_vertices(const SimplexMesh<3> &,
                                                         const Scene<3> &);
  template ChangedPieces<2> straighten_pieces(SimplexMesh<2> &,
                                              const Scene<2> &);
  template ChangedPieces<3> straighten_pieces(SimplexMesh<3> &,
                                              const Scene<3> &);
} // namespace Keyblock

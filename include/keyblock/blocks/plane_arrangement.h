// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_plane_arrangement_h
#define keyblock_blocks_plane_arrangement_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/blocks/convex_body.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace Keyblock
{
  /** One face on the surface of a block. */
  struct OuterFace
  {
    unsigned int cell, face;
    unsigned int surface; ///< index into Mesh::surfaces; none: of the domain
  };

  /** The scene's joints and the mesh's outlines as what they are without the
   * mesh: planes that divide space. */
  template <int dim>
  class PlaneArrangement
  {
  public:
    PlaneArrangement(const Mesh<dim> &mesh, const Scene<dim> &scene);

    /**
     * What the planes leave around the centroid of a block. Faces of the body
     * have the index of their joint as name; those of outlines come after.
     * Nothing if it is not convex, not bounded by planes alone, if a joint does
     * not reach all over a face, or if the centroid is not on the side of a
     * joint where the block's faces are.
     * @param has_outlines whether outlines of excavations cut, too
     */
    std::optional<ConvexBody<dim>> body_of(const Block<dim> &block,
                                           const std::vector<OuterFace> &faces,
                                           const bool has_outlines) const;

    /** Whether a block has a face on a joint that is not infinite. */
    bool
    has_finite_joint(const std::vector<OuterFace> &faces) const
    {
      return std::any_of(faces.begin(), faces.end(), [this](const auto &f) {
        return f.surface != none && mesh.surfaces[f.surface].is_joint() &&
               !joints[mesh.surfaces[f.surface].joint].is_infinite();
      });
    }

    /** Volume, centroid and areas on joints of what excavations leave of a
     * body: meshes have outlines where they are. */
    typename Block<dim>::Measures
    measure_rest(const ConvexBody<dim> &body) const;

    /** Whether a corner on a joint, where the surfaces of the mesh in a list
     * meet, lies on faces of the outlines among these, within @p tolerance of
     * their planes and @p beside them by so much at most [m]: the mesh may have
     * it on a face beside the one that the joint crosses. True of corners that
     * are on no joint. */
    bool is_on_outlines(const Point<dim> &point,
                        const std::vector<unsigned int> &surfaces,
                        const double tolerance,
                        const double beside) const;

    /** Whether no face of an outline lies within a body by more than
     * @p tolerance [m], and what of it is on no joint is all on outlines. */
    bool is_in_rock(const ConvexBody<dim> &body, const double tolerance) const;

    /** Whether some joint has points of a connected body on both sides and
     * reaches over all of its section there. @param edges of the body's faces
     * @param tolerance [m] */
    bool is_cut(const std::vector<std::pair<Point<dim>, Point<dim>>> &edges,
                const double tolerance) const;

  private:
    bool cut_by_faces(ConvexBody<dim> &body,
                      const Block<dim> &block,
                      const std::vector<OuterFace> &faces,
                      const bool has_outlines,
                      std::vector<bool> &is_done) const;
    void add_outline(const typename Mesh<dim>::FaceVertices &vertices,
                     const Point<dim> &point,
                     const Tensor<1, dim> &normal);
    bool reaches_over(const unsigned int joint,
                      const std::vector<Point<dim>> &section,
                      const double tolerance) const;
    bool is_on_outline(const Point<dim> &point,
                       const Tensor<1, dim> &normal,
                       const double tolerance,
                       const double beside) const;
    const Mesh<dim> &mesh;
    std::vector<JointExtent<dim>> joints;

    /** Balls around finite joints: center and radius [m]. */
    std::vector<std::pair<Point<dim>, double>> balls;

    Point<dim> low, high; ///< of the domain's box

    /** A face on an outline of an excavation or of the domain. */
    struct OutlineFace
    {
      std::vector<Point<dim>> corners; ///< in 3D around it
      Point<dim> point;
      Tensor<1, dim> normal; ///< of its plane; zero: it is curved
    };
    std::vector<OutlineFace> outline;
  };

  /** Edge of a cell of the mean volume of a block's [m]. */
  template <int dim>
  double
  cell_size(const Block<dim> &block)
  {
    return std::pow(block.volume / block.n_cells, 1. / dim);
  }
} // namespace Keyblock

#endif

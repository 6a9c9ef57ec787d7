// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_laid_liner_h
#define keyblock_blocks_laid_liner_h

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /** A piece of the trace of a joint under shotcrete: two vertices at one
   * place, on the two sides. */
  template <int dim>
  struct LinerTrace
  {
    std::array<unsigned int, 2> vertex; ///< of the split mesh; none: it is one
                                        ///< between planes
    std::array<unsigned int, 2> block;  ///< index into Blocks::blocks
    std::array<unsigned int, 2> cell;   ///< under the shotcrete
    unsigned int joint;                 ///< or `none`
    double length;                      ///< [m]; in 2D 1 m, out of the plane

    /** Unit normal of the section of the shotcrete there: in the face, across
     * the trace. */
    dealii::Tensor<1, dim> across;

    /** The part of @p vector within the section. */
    dealii::Tensor<1, dim>
    in_section(const dealii::Tensor<1, dim> &vector) const
    {
      return vector - (vector * across) * across;
    }
  };

  /** The part of the area under shotcrete that belongs to a vertex. */
  struct LinerArea
  {
    unsigned int vertex, block, cell;
    double area; ///< [m2]
  };

  /** A face under shotcrete that carries thrust and bends. */
  template <int dim>
  struct LinedFace
  {
    static constexpr unsigned int n = 1 << (dim - 1);

    /** Of the split mesh: in 2D the way from the first to the second has the
     * opening on its left, in 3D they turn around the normal into it. */
    std::array<unsigned int, n> vertices;

    /** What was one vertex before the split has one point; index among the
     * points of the liner. */
    std::array<unsigned int, n> points;

    /** Whether its vertices (2D) or edges, from each vertex to the next (3D),
     * are on a held outer boundary: there the liner goes on as its mirror
     * image. */
    std::array<bool, n> is_mirrored;

    unsigned int cell; ///< under it
    double area;       ///< [m2]; in 2D over 1 m
  };

  /** Shotcrete on a mesh. */
  template <int dim>
  struct LaidLiner
  {
    std::vector<LinerTrace<dim>> traces;
    std::vector<LinerArea> areas;
    std::vector<LinedFace<dim>> faces; ///< of a structural liner only
  };
} // namespace Keyblock

#endif

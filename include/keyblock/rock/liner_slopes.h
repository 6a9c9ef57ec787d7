// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_liner_slopes_h
#define keyblock_rock_liner_slopes_h

#include <keyblock/rock/liner_shell.h>
#include <keyblock/rock/quadratic_fit.h>

#include <map>

namespace Keyblock
{
  /** Rows by point: what they give is linear in displacements. */
  using LinerRows = std::map<unsigned int, Tensor<1, 3>>;

  /** Add @p factor times @p rows to @p sum. */
  void add_rows(LinerRows &sum, const LinerRows &rows, const double factor);

  /** Three points of a liner and what their displacements do between them. */
  struct LinerTriangle
  {
    std::array<unsigned int, 3> points;
    std::array<Tensor<1, 3>, 3> gradient; ///< of the linear functions [1/m]
    Tensor<1, 3> normal;                  ///< unit, into the opening
    double area;                          ///< [m2]

    LinerTriangle(const std::vector<Point<3>> &places,
                  const std::array<unsigned int, 3> &points);

    /** Slope of the deflection along @p way, a unit vector in the plane. */
    LinerRows slope(const Tensor<1, 3> &way) const;
  };

  /** An edge as one of its faces passes it. */
  struct LinerEdge
  {
    unsigned int begin, end;
    double length;    ///< [m]
    Tensor<1, 3> way; ///< unit

    LinerEdge(const std::vector<Point<3>> &places,
              const unsigned int begin,
              const unsigned int end);

    /** Out of the face with the unit normal @p normal. */
    Tensor<1, 3> outward(const Tensor<1, 3> &normal) const;
  };

  /**
   * Slopes of the deflection at the middles of edges of a liner in 3D, one for
   * both sides of an edge, from the displacements of the points around. A body
   * that turns has the slopes of its triangles, a quadratic surface has its
   * own. Over sharp edges, and where the points do not tell a surface, they are
   * means of the triangles beside.
   */
  class LinerSlopes
  {
  public:
    /** The arguments have to live as long. */
    LinerSlopes(const std::vector<Point<3>> &places,
                const std::vector<LinedFace<3>> &faces);

    /** Triangle of three corners of face @p f around its corner @p k. */
    const LinerTriangle &
    triangle(const unsigned int f, const unsigned int k) const
    {
      return triangles[4 * f + k % 4];
    }

    /** Slopes out of the triangles of corners 0 and 1 at the middles of the two
     * diagonals of a face. */
    std::array<LinerRows, 2> at_diagonals(const unsigned int f) const;

    /** Slope out of face @p f at its edge @p k; @p is_free: there is no other
     * face, nor an image, to fix it. */
    LinerRows
    at_edge(const unsigned int f, const unsigned int k, bool &is_free);

  private:
    struct Side
    {
      unsigned int face, edge; ///< from its vertex `edge` to the next
    };

    LinerEdge edge_of(const Side &side) const;

    /** Points of the faces around @p centers that look about the same way. */
    std::vector<unsigned int> patch(const std::vector<unsigned int> &centers,
                                    const Tensor<1, 3> &normal) const;

    QuadraticFit fit_around(const Point<3> &center,
                            const Tensor<1, 3> &first,
                            const Tensor<1, 3> &second,
                            const double length,
                            const std::vector<unsigned int> &points) const;

    /** Slope at the middle of @p edge of the quadratic surface through the
     * deflections of @p points, out of the face; empty if they do not tell it.
     * Across the edge the normal is about @p direction. */
    LinerRows fitted_slope(const LinerEdge &edge,
                           const Tensor<1, 3> &direction,
                           const std::vector<unsigned int> &points) const;

    /** Slope out of @p here at the middle of its edge. */
    LinerRows slope_between(const Side &here, const Side &there) const;

    const std::vector<Point<3>> &places;
    const std::vector<LinedFace<3>> &faces;
    std::vector<Tensor<1, 3>> normals;    ///< of faces
    std::vector<LinerTriangle> triangles; ///< four of each face, by corner
    std::vector<std::vector<unsigned int>> faces_at; ///< points
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Side>> sides;

    /** At edges between two faces, as the first of them sees it. */
    std::map<std::pair<unsigned int, unsigned int>, LinerRows> slopes;
  };
} // namespace Keyblock

#endif

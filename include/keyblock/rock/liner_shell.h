// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_liner_shell_h
#define keyblock_rock_liner_shell_h

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <keyblock/blocks/laid_liner.h>

#include <array>
#include <vector>

namespace Keyblock
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  /** Cosine of the angle between faces up to which a liner is smooth: over
   * sharper edges no surface is fitted. */
  constexpr double smooth_cosine = 0.86;

  /** Stiffness of the section of an elastic liner, per metre; in 2D of plane
   * strain. */
  struct LinerSection
  {
    double membrane = 0.; ///< E t / (1 - nu^2) [N/m]
    double bending  = 0.; ///< E t^3 / (12 (1 - nu^2)) [N m]
    double poisson  = 0.; ///< [-]

    LinerSection(const double young_modulus,
                 const double poisson_ratio,
                 const double thickness)
      : membrane(young_modulus * thickness /
                 (1. - poisson_ratio * poisson_ratio))
      , bending(membrane * thickness * thickness / 12.)
      , poisson(poisson_ratio)
    {}
  };

  /**
   * A part of a liner whose strain or change of curvature is constant: linear
   * in the displacements of its points, and zero for motions of a rigid body.
   */
  template <int dim>
  struct LinerPiece
  {
    static constexpr unsigned int n_strains = dim == 2 ? 1 : 3;
    using Rows = std::array<Tensor<1, dim>, n_strains>;
    using Stiffness =
      std::array<std::array<double, n_strains>, n_strains>; ///< per area

    bool is_bending;
    unsigned int face; ///< that it is of; in 2D, if it bends, its point
    double area;       ///< [m^(dim-1)]
    std::array<Tensor<1, dim>, dim - 1> axes; ///< of its strains
    std::vector<unsigned int> points;
    std::vector<Rows> rows; ///< by point; in 3D of 11, 22 and twice 12
    Stiffness stiffness;

    /** Strains [-] or changes of curvature [1/m] at displacements by point. */
    std::array<double, n_strains>
    strains(const std::vector<Tensor<1, dim>> &displacement) const;

    /** Thrusts [N/m] or moments [N] that belong to them. */
    std::array<double, n_strains>
    stresses(const std::vector<Tensor<1, dim>> &displacement) const;
  };

  /** Chain of segments: each is stretched, each point between two bends by the
   * change of the angle between them. */
  std::vector<LinerPiece<2>>
  make_liner_pieces(const LinerSection &section,
                    const std::vector<Point<2>> &points,
                    const std::vector<LinedFace<2>> &faces);

  /** Quadrilaterals, split into triangles along both diagonals, each with half
   * the stiffness: strains of linear triangles, and changes of curvature of
   * Morley's (1968), whose slopes at the middles of edges are those of a
   * quadratic surface through the points around (doc/theory.md). */
  std::vector<LinerPiece<3>>
  make_liner_pieces(const LinerSection &section,
                    const std::vector<Point<3>> &points,
                    const std::vector<LinedFace<3>> &faces);

  /** Thrust and moment of a face. */
  template <int dim>
  struct LinerForce
  {
    SymmetricTensor<2, dim> thrust; ///< tension positive [N/m]

    /** Positive with tension at the opening; in 2D that of the end where it is
     * larger [N m/m]. */
    SymmetricTensor<2, dim> moment;

    double shear = 0.; ///< in 2D [N/m]
  };

  /**
   * A linear elastic liner on faces of a mesh, without rotations as unknowns:
   * a constant stiffness between the displacements of its points, which small
   * motions leave as it is. Positive moments stretch the side of the opening.
   */
  template <int dim>
  class LinerShell
  {
  public:
    LinerShell() = default;

    /** @param points where they are [m]
     * @param faces their points and mirrors count, their vertices do not */
    LinerShell(const LinerSection &section,
               const std::vector<Point<dim>> &points,
               const std::vector<LinedFace<dim>> &faces);

    unsigned int
    n_points() const
    {
      return row_begin.empty() ? 0 : row_begin.size() - 1;
    }

    const std::vector<LinerPiece<dim>> &
    all_pieces() const
    {
      return pieces;
    }

    /** Points of each face. */
    const std::vector<std::array<unsigned int, LinedFace<dim>::n>> &
    faces() const
    {
      return points_of_face;
    }

    /** What holds @p point back at displacements by point [m, N]; in 2D over
     * 1 m. */
    Tensor<1, dim>
    force_at(const unsigned int point,
             const std::vector<Tensor<1, dim>> &displacement) const
    {
      Tensor<1, dim> force;
      for (unsigned int i = row_begin[point]; i < row_begin[point + 1]; ++i)
        force += blocks[i] * displacement[columns[i]];
      return force;
    }

    /** Largest sum of absolute values of a row of the stiffness at each point,
     * along the axes of its own block: as many springs to the ground, in every
     * direction, are stiffer than the liner [N/m]. */
    std::vector<double> row_sums() const;

    /** By face. */
    std::vector<LinerForce<dim>>
    forces(const std::vector<Tensor<1, dim>> &displacement) const;

  private:
    void list_columns(const unsigned int n_points);
    void assemble();

    std::vector<LinerPiece<dim>> pieces;
    std::vector<std::array<unsigned int, LinedFace<dim>::n>> points_of_face;

    // the stiffness by rows of points
    std::vector<unsigned int> row_begin, columns;
    std::vector<Tensor<2, dim>> blocks; ///< [N/m]
  };
} // namespace Keyblock

#endif

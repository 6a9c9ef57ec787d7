// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_far_field_h
#define keyblock_rock_far_field_h

#include <keyblock/rock/dofs.h>

#include <array>
#include <memory>
#include <numeric>
#include <vector>

namespace dealii
{
  template <typename>
  class FullMatrix;
  template <typename>
  class Vector;
} // namespace dealii

namespace Keyblock
{
  /**
   * Fields of the unbounded elastic body that loads near the origin leave far
   * away (Kelvin 1848; in 2D plane strain): those of the dim^2 dipoles, double
   * forces along axis j whose points of attack lie apart along axis k, and in
   * 3D before them those of the three single forces. Their strengths are such
   * that no modulus but Poisson's ratio is in the displacements.
   */
  template <int dim>
  struct KelvinFields
  {
    static constexpr unsigned int n_forces = dim == 3 ? 3 : 0;
    static constexpr unsigned int n        = n_forces + dim * dim;

    double lambda, mu; ///< of the body [Pa]

    double
    poisson_ratio() const
    {
      return 0.5 * lambda / (lambda + mu);
    }

    /** Displacement at @p x (not zero) from the loads [m]. */
    Tensor<1, dim> displacement(const unsigned int field,
                                const Point<dim> &x) const;

    /** Its gradient, row i that of component i [-]. */
    Tensor<2, dim> gradient(const unsigned int field,
                            const Point<dim> &x) const;

    /** Stress, tension positive [Pa]. */
    Tensor<2, dim> stress(const unsigned int field, const Point<dim> &x) const;
  };

  /**
   * What the infinite rock around a model does at its boundary: springs at the
   * nodes, and, where the boundary encloses the centre, a coupling of all of
   * them that is exact for the fields of Kelvin's loads at the centre (theory,
   * section 11). Force on the model: -(S + W C W^T) u. The stiffness is
   * symmetric and has no negative eigenvalue.
   */
  template <int dim>
  class FarField
  {
  public:
    /** Piece of the boundary. */
    struct Face
    {
      typename Mesh<dim>::FaceVertices vertices;
      Point<dim> place; ///< its centre [m]
      /** Of the vertices, times the outward normal [m^(dim-1)]. */
      std::array<Tensor<1, dim>, Mesh<dim>::n_face_vertices> areas;
      Point<dim> excavation; ///< centre of the excavation [m]
      double lambda, mu;     ///< of the rock beside it [Pa]

      Tensor<1, dim>
      area() const
      {
        return std::accumulate(areas.begin(), areas.end(), Tensor<1, dim>());
      }
    };

    /** Without a boundary: no force. */
    explicit FarField(const Communicator &communicator)
      : communicator(communicator)
    {}

    /** From all faces of the boundary, the same list on every rank. */
    FarField(const std::vector<Face> &faces,
             const SplitMesh<dim> &split,
             const Numbering<dim> &numbering);

    bool
    is_coupled() const
    {
      return n_coupled > 0;
    }

    /** Add the stiffness times @p displacement to @p force, both of local
     * degrees of freedom (collective) [m, N]. */
    void add_force(const std::vector<double> &displacement,
                   std::vector<double> &force) const;

    /** This rank's share of what is stored (collective) [J]. */
    double stored_energy(const std::vector<double> &displacement) const;

    /** Upper bound of the squared frequencies it can add to a body with these
     * inverse masses, one per node (collective) [1/kg -> rad^2/s^2]. */
    double frequency_bound(const std::vector<double> &inverse_mass) const;

    /** Spring at a node, the same in all directions. */
    struct Spring
    {
      unsigned int node;
      double stiffness; ///< [N/m]
    };

    std::vector<Spring> springs; ///< S, of owned nodes
    /** W: per spring dim rows of n_columns() [N]. */
    std::vector<double> columns;
    /** C, null without coupling [1/(N m)]. */
    std::shared_ptr<const dealii::FullMatrix<double>> coupling;

    unsigned int
    n_columns() const
    {
      return 2 * n_coupled;
    }

  private:
    /** W^T @p displacement, summed over the ranks [J]. */
    dealii::Vector<double>
    project(const std::vector<double> &displacement) const;

    /** The fields' own energies, and what is left of displacements without
     * them; false if the boundary cannot be coupled. */
    bool couple(const dealii::FullMatrix<double> &energy,
                const dealii::FullMatrix<double> &spring_energy,
                const dealii::FullMatrix<double> &spring_work);

    Communicator communicator;
    unsigned int n_coupled = 0; ///< fields
    std::shared_ptr<const dealii::FullMatrix<double>> inverse_energy;
    /** Largest factor by which the projection can raise the energy of the
     * springs [-]. */
    double projection_norm = 1.;
  };
} // namespace Keyblock

#endif

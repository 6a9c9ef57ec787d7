// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/symmetric_tensor.h>

#include <keyblock/mesh/place_digits.h>
#include <keyblock/step/initial_tension.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Tension that is not warned of [Pa], and over the largest compression
     * [-]. */
    constexpr double little_tension = 1e3, relative_tension = 1e-3;

    /** Largest and least principal stress, in 2D of the plane [Pa]. */
    template <int dim, typename Stress>
    std::pair<double, double>
    principal_stresses(const Stress &stress)
    {
      dealii::SymmetricTensor<2, dim> tensor;
      for (unsigned int d = 0; d < dim; ++d)
        tensor[d][d] = stress[d];
      if constexpr (dim == 2)
        tensor[0][1] = stress[3];
      else
        {
          tensor[1][2] = stress[3];
          tensor[0][2] = stress[4];
          tensor[0][1] = stress[5];
        }
      const auto values = dealii::eigenvalues(tensor);
      return {values[0], values[dim - 1]};
    }

    /** What the stress of a rank's cells, then of all, amounts to. */
    template <int dim>
    struct Tension
    {
      double largest = 0., compression = 0.; ///< principal stresses [Pa]
      Point<dim> place;                      ///< of the largest
      double volume = 0., volume_under_tension = 0.; ///< in all directions
    };

    template <int dim>
    Tension<dim>
    measure(const SplitMesh<dim> &split, const CellArrays<dim> &cells)
    {
      Tension<dim> tension;
      for (unsigned int c = 0; c < cells.nodes.size(); ++c)
        for (unsigned int q = 0; q < (1u << dim); ++q)
          {
            const unsigned int mesh_cell = cells.mesh_cell[c];
            const auto [greatest, least] =
              principal_stresses<dim>(cells.stress_at(c, q));
            const double part = split.mesh.cell_volume(mesh_cell) / (1u << dim);
            tension.volume += part;
            if (least > little_tension)
              tension.volume_under_tension += part;
            tension.compression = std::max(tension.compression, -least);
            if (greatest > tension.largest)
              {
                tension.largest = greatest;
                tension.place   = split.mesh.cell_center(mesh_cell);
              }
          }
      return tension;
    }
  } // namespace



  template <int dim>
  std::string
  warning_of_tension(const Communicator &communicator,
                     const Scene<dim> &scene,
                     const SplitMesh<dim> &split,
                     const CellArrays<dim> &cells)
  {
    const Tension<dim> tension = measure(split, cells);
    const double largest       = communicator.max(tension.largest);
    const double least =
      std::max(little_tension,
               relative_tension * communicator.max(tension.compression));
    const double share = communicator.sum(tension.volume_under_tension) /
                         communicator.sum(tension.volume);
    std::ostringstream place;
    if (largest > 0. && tension.largest == largest)
      for (unsigned int d = 0; d < dim; ++d)
        place << (d ? ", " : "")
              << std::setprecision(digits_of_place(split.mesh, 4))
              << tension.place[d];
    const std::string where = communicator.any_text(place.str());
    if (!(largest > least))
      return "";
    std::ostringstream text;
    text << "The initial stress is a tension of up to " << std::setprecision(3)
         << largest << " Pa, at (" << where << ") m";
    const InitialState<dim> &state = scene.initial_state;
    const std::string remedy =
      !state.stress.empty()
        ? "compression is negative in 'Initial state/Stress', check its signs"
      : state.has_depth_stress()
        ? "compression is positive in 'Initial state/Surface stress', and "
          "'Surface elevation' should not be below the model"
        : "check 'Initial state/Measured points', where tension is positive";
    AssertThrow(!(share > 0.5),
                InputError(text.str() +
                           ", and more than half of the rock is "
                           "under tension in all directions: " +
                           remedy + "."));
    return text.str() + ": " + remedy + ", if that is not meant.";
  }

  template std::string warning_of_tension(const Communicator &,
                                          const Scene<2> &,
                                          const SplitMesh<2> &,
                                          const CellArrays<2> &);
  template std::string warning_of_tension(const Communicator &,
                                          const Scene<3> &,
                                          const SplitMesh<3> &,
                                          const CellArrays<3> &);
} // namespace Keyblock

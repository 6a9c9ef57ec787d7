// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_free_field_column_h
#define keyblock_step_free_field_column_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <keyblock/scene/ground.h>

#include <array>
#include <vector>

namespace Keyblock
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  /** A face of a side boundary: what the column beside it is made of. */
  template <int dim>
  struct SideFace
  {
    double bottom, top;            ///< elevations [m]
    const Material<dim> *material; ///< at present
    double largest_speed; ///< of pressure waves in all it is ever of [m/s]
  };

  /** What moves a column at its foot in a step. */
  template <int dim>
  struct FootMotion
  {
    /** Of the rock below, zero where the foot is not quiet [Pa s/m]. */
    Tensor<2, dim> impedance;
    /** Traction of the wave that comes in [Pa]. */
    Tensor<1, dim> incoming;
    /** Axes along which the foot is held, and its velocity there [m/s]. */
    std::array<bool, dim> is_held{};
    Tensor<1, dim> velocity;
  };

  /**
   * Horizontal ground beside the model, in which nothing is excavated: a column
   * of unit area of linear elements and lumped masses between the elevations
   * of the side's nodes, with a displacement along each axis, and a free top.
   * It takes the steps that the model takes, so that a model without an
   * excavation moves as the column does, to the last digits.
   *
   * Layers are those of the side; rock is elastic, and keeps its stress when a
   * stage changes its properties.
   */
  template <int dim>
  class FreeFieldColumn
  {
  public:
    /** @param least_step time step that a layer has to bear [s] */
    FreeFieldColumn(const std::vector<SideFace<dim>> &side,
                    const double least_step);

    /** Take the present materials of the same faces; stresses stay. */
    void take_materials(const std::vector<SideFace<dim>> &side);

    /** Damping and times of a step, as in MotionOfStep. */
    struct Step
    {
      double step, kick, mass_damping, stiffness_damping;
    };

    /** Move on by Step::step with the velocities there are, and give them the
     * next kick; with a step of 0 give the last kick again. */
    void advance(const Step &step, const FootMotion<dim> &foot);

    void stop_motion();

    /** Velocity in the middle of the last kick at an elevation [m/s]. */
    Tensor<1, dim> velocity(const double elevation) const;

    /** Stress before the last kick, damping included, at an elevation [Pa]. */
    SymmetricTensor<2, dim> stress(const double elevation) const;

    /** Stresses and velocities, to go on with. */
    std::vector<double> remember() const;

    /** Number of numbers that remember() gives. */
    std::size_t
    n_numbers() const
    {
      return 2 * dim * levels.size() + n_stresses * layers.size();
    }

    /** Take up n_numbers() numbers from @p numbers on. */
    void recall(const double *numbers);

    const std::vector<double> &
    elevations() const
    {
      return levels;
    }

  private:
    using Vector = Tensor<1, dim>;

    /** Between levels i and i + 1. */
    struct Layer
    {
      double thickness, lame_lambda, shear_modulus;
      SymmetricTensor<2, dim> stress; ///< damping left out [Pa]
    };

    static constexpr unsigned int n_stresses =
      SymmetricTensor<2, dim>::n_independent_components;

    unsigned int layer_at(const double elevation) const;

    /** Change of the velocity with height before the last kick [1/s]. */
    Vector rate(const unsigned int layer) const;

    /** Stress of rock whose displacement changes with height like this. */
    SymmetricTensor<2, dim> elastic_stress(const Vector &gradient,
                                           const Layer &layer) const;

    /** Stress before the last kick, damping included [Pa]. */
    SymmetricTensor<2, dim> stress_of(const Layer &layer,
                                      const Vector &rate) const;

    std::vector<double> levels;
    std::vector<Layer> layers;
    std::vector<double> mass; ///< by level, per area [kg/m2]
    std::vector<Vector> velocity_before, velocity_after;
    double stiffness_damping = 0.; ///< of the last step [s]
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/step/free_field_column.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Share of the height of a face beside it that a layer has at least, where
     * nodes of the side lie at many elevations [-]. */
    constexpr double least_share = 0.6;

    /** Height of the lowest of the faces beside an elevation [m]. */
    template <int dim>
    double
    height_beside(const std::vector<SideFace<dim>> &side,
                  const double elevation)
    {
      double least = std::numeric_limits<double>::max();
      for (const SideFace<dim> &face : side)
        if (face.bottom <= elevation && elevation <= face.top)
          least = std::min(least, face.top - face.bottom);
      return least;
    }

    /** Material of the face whose middle is nearest to an elevation. */
    template <int dim>
    const Material<dim> &
    material_beside(const std::vector<SideFace<dim>> &side,
                    const double elevation)
    {
      return *std::min_element(side.begin(),
                               side.end(),
                               [&](const auto &a, const auto &b) {
                                 const auto distance = [&](const auto &face) {
                                   return std::abs(0.5 *
                                                     (face.bottom + face.top) -
                                                   elevation);
                                 };
                                 return distance(a) < distance(b);
                               })
                ->material;
    }
  } // namespace



  template <int dim>
  FreeFieldColumn<dim>::FreeFieldColumn(const std::vector<SideFace<dim>> &side,
                                        const double least_step)
  {
    std::vector<double> all;
    double fastest = 0.;
    for (const SideFace<dim> &face : side)
      {
        all.push_back(face.bottom);
        all.push_back(face.top);
        fastest = std::max(fastest, face.largest_speed);
      }
    sort_unique(all);
    const auto gap = [&](const double elevation) {
      return std::max(least_share * height_beside(side, elevation),
                      fastest * least_step);
    };
    levels.push_back(all.front());
    for (const double elevation : all)
      if (elevation - levels.back() >= gap(elevation))
        levels.push_back(elevation);
    if (levels.size() > 1 && all.back() - levels.back() < gap(all.back()))
      levels.back() = all.back();

    layers.resize(levels.size() - 1);
    velocity_before.resize(levels.size());
    velocity_after = velocity_before;
    take_materials(side);
  }



  template <int dim>
  void
  FreeFieldColumn<dim>::take_materials(const std::vector<SideFace<dim>> &side)
  {
    mass.assign(levels.size(), 0.);
    for (unsigned int i = 0; i < layers.size(); ++i)
      {
        const Material<dim> &material =
          material_beside(side, 0.5 * (levels[i] + levels[i + 1]));
        layers[i].thickness     = levels[i + 1] - levels[i];
        layers[i].lame_lambda   = material.lame_lambda();
        layers[i].shear_modulus = material.shear_modulus();
        for (const unsigned int level : {i, i + 1})
          mass[level] += 0.5 * material.density * layers[i].thickness;
      }
  }



  template <int dim>
  unsigned int
  FreeFieldColumn<dim>::layer_at(const double elevation) const
  {
    const auto above =
      std::upper_bound(levels.begin() + 1, levels.end() - 1, elevation);
    return above - levels.begin() - 1;
  }



  template <int dim>
  Tensor<1, dim>
  FreeFieldColumn<dim>::rate(const unsigned int layer) const
  {
    return (velocity_before[layer + 1] - velocity_before[layer]) /
           layers[layer].thickness;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  FreeFieldColumn<dim>::elastic_stress(const Vector &gradient,
                                       const Layer &layer) const
  {
    SymmetricTensor<2, dim> stress;
    for (unsigned int d = 0; d + 1 < dim; ++d)
      {
        stress[d][d]       = layer.lame_lambda * gradient[dim - 1];
        stress[d][dim - 1] = layer.shear_modulus * gradient[d];
      }
    stress[dim - 1][dim - 1] =
      (layer.lame_lambda + 2. * layer.shear_modulus) * gradient[dim - 1];
    return stress;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  FreeFieldColumn<dim>::stress_of(const Layer &layer, const Vector &rate) const
  {
    return layer.stress + elastic_stress(stiffness_damping * rate, layer);
  }



  template <int dim>
  void
  FreeFieldColumn<dim>::advance(const Step &step, const FootMotion<dim> &foot)
  {
    if (step.step > 0.)
      {
        velocity_before = velocity_after;
        for (unsigned int i = 0; i < layers.size(); ++i)
          layers[i].stress += elastic_stress(step.step * rate(i), layers[i]);
      }
    stiffness_damping = step.stiffness_damping;
    std::vector<Vector> force(levels.size());
    for (unsigned int i = 0; i < layers.size(); ++i)
      {
        const SymmetricTensor<2, dim> stress = stress_of(layers[i], rate(i));
        for (unsigned int d = 0; d < dim; ++d)
          {
            force[i][d] += stress[d][dim - 1];
            force[i + 1][d] -= stress[d][dim - 1];
          }
      }
    for (unsigned int i = 0; i < levels.size(); ++i)
      velocity_after[i] = velocity_before[i] +
                          step.kick * (force[i] / mass[i] -
                                       step.mass_damping * velocity_before[i]);

    // dashpots of the mean velocity, as those of QuietBoundary
    const double factor   = 0.5 * step.kick / mass[0];
    Tensor<2, dim> slowed = factor * foot.impedance;
    for (unsigned int d = 0; d < dim; ++d)
      slowed[d][d] += 1.;
    const Vector middle = 0.5 * (velocity_before[0] + velocity_after[0]) +
                          2. * factor * foot.incoming;
    velocity_after[0] = 2. * (invert(slowed) * middle) - velocity_before[0];
    for (unsigned int d = 0; d < dim; ++d)
      if (foot.is_held[d])
        velocity_after[0][d] = foot.velocity[d];
  }



  template <int dim>
  void
  FreeFieldColumn<dim>::stop_motion()
  {
    std::fill(velocity_before.begin(), velocity_before.end(), Vector());
    std::fill(velocity_after.begin(), velocity_after.end(), Vector());
  }



  template <int dim>
  Tensor<1, dim>
  FreeFieldColumn<dim>::velocity(const double elevation) const
  {
    const unsigned int layer = layer_at(elevation);
    const double share =
      std::clamp((elevation - levels[layer]) / layers[layer].thickness, 0., 1.);
    const auto mean = [&](const unsigned int level) {
      return 0.5 * (velocity_before[level] + velocity_after[level]);
    };
    return (1. - share) * mean(layer) + share * mean(layer + 1);
  }



  template <int dim>
  SymmetricTensor<2, dim>
  FreeFieldColumn<dim>::stress(const double elevation) const
  {
    const unsigned int layer = layer_at(elevation);
    return stress_of(layers[layer], rate(layer));
  }



  template <int dim>
  std::vector<double>
  FreeFieldColumn<dim>::remember() const
  {
    std::vector<double> numbers;
    for (const Layer &layer : layers)
      for (unsigned int i = 0; i < n_stresses; ++i)
        numbers.push_back(layer.stress.access_raw_entry(i));
    for (const auto *values : {&velocity_before, &velocity_after})
      for (const Vector &value : *values)
        for (unsigned int d = 0; d < dim; ++d)
          numbers.push_back(value[d]);
    return numbers;
  }



  template <int dim>
  void
  FreeFieldColumn<dim>::recall(const double *numbers)
  {
    for (Layer &layer : layers)
      for (unsigned int i = 0; i < n_stresses; ++i)
        layer.stress.access_raw_entry(i) = *numbers++;
    for (auto *values : {&velocity_before, &velocity_after})
      for (Vector &value : *values)
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = *numbers++;
  }

  template class FreeFieldColumn<2>;
  template class FreeFieldColumn<3>;
} // namespace Keyblock

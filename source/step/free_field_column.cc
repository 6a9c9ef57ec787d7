// SPDX-License-Identifier: LGPL-2.1-or-later
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
        const Material<dim> &material = *face.material;
        fastest                       = std::max(fastest,
                           std::sqrt((material.lame_lambda() +
                                      2. * material.shear_modulus()) /
                                     material.density));
      }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
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

    mass.assign(levels.size(), 0.);
    for (unsigned int i = 0; i + 1 < levels.size(); ++i)
      {
        const Material<dim> &material =
          material_beside(side, 0.5 * (levels[i] + levels[i + 1]));
        layers.push_back({levels[i + 1] - levels[i],
                          material.density,
                          material.lame_lambda(),
                          material.shear_modulus()});
        for (const unsigned int level : {i, i + 1})
          mass[level] += 0.5 * material.density * layers.back().thickness;
      }
    displacement.resize(levels.size());
    velocity_before = velocity_after = displacement;
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
  FreeFieldColumn<dim>::gradient(const std::vector<Vector> &values,
                                 const unsigned int layer) const
  {
    return (values[layer + 1] - values[layer]) / layers[layer].thickness;
  }



  template <int dim>
  Tensor<1, dim>
  FreeFieldColumn<dim>::traction(const Vector &gradient,
                                 const Layer &layer) const
  {
    Vector result = layer.shear_modulus * gradient;
    result[dim - 1] +=
      (layer.lame_lambda + layer.shear_modulus) * gradient[dim - 1];
    return result;
  }



  template <int dim>
  void
  FreeFieldColumn<dim>::advance(const Step &step, const FootMotion<dim> &foot)
  {
    if (step.step > 0.)
      {
        for (unsigned int i = 0; i < levels.size(); ++i)
          displacement[i] += step.step * velocity_after[i];
        velocity_before = velocity_after;
      }
    stiffness_damping = step.stiffness_damping;
    std::vector<Vector> force(levels.size());
    for (unsigned int i = 0; i < layers.size(); ++i)
      {
        const Vector t =
          traction(gradient(displacement, i) +
                     stiffness_damping * gradient(velocity_before, i),
                   layers[i]);
        force[i] += t;
        force[i + 1] -= t;
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
    const Vector rise        = gradient(displacement, layer) +
                        stiffness_damping * gradient(velocity_before, layer);
    const Vector plane = traction(rise, layers[layer]);
    SymmetricTensor<2, dim> result;
    for (unsigned int d = 0; d + 1 < dim; ++d)
      {
        result[d][d]       = layers[layer].lame_lambda * rise[dim - 1];
        result[d][dim - 1] = plane[d];
      }
    result[dim - 1][dim - 1] = plane[dim - 1];
    return result;
  }



  template <int dim>
  std::vector<double>
  FreeFieldColumn<dim>::remember() const
  {
    std::vector<double> numbers;
    for (const auto *values :
         {&displacement, &velocity_before, &velocity_after})
      for (const Vector &value : *values)
        for (unsigned int d = 0; d < dim; ++d)
          numbers.push_back(value[d]);
    return numbers;
  }



  template <int dim>
  void
  FreeFieldColumn<dim>::recall(const double *numbers)
  {
    for (auto *values : {&displacement, &velocity_before, &velocity_after})
      for (Vector &value : *values)
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = *numbers++;
  }

  template class FreeFieldColumn<2>;
  template class FreeFieldColumn<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>

#include <keyblock/scene/section_axis.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    using dealii::Tensor;

    /** Columns: what is across, along and upwards in the section. */
    Tensor<2, 3>
    axes_of(const Excavation<3> &excavation)
    {
      const double turn = dealii::numbers::PI / 180. * excavation.trend;
      const double fall = dealii::numbers::PI / 180. * excavation.plunge;
      const double sine = std::sin(turn), cosine = std::cos(turn);
      return Tensor<2, 3>(
        {{cosine, sine * std::cos(fall), sine * std::sin(fall)},
         {-sine, cosine * std::cos(fall), cosine * std::sin(fall)},
         {0., -std::sin(fall), std::cos(fall)}});
    }

    Point<3>
    pivot_of(const Excavation<3> &excavation)
    {
      return Point<3>(excavation.pivot[0], 0., excavation.pivot[1]);
    }
  } // namespace



  Point<3>
  from_section(const Excavation<3> &excavation, const Point<3> &p)
  {
    if (!excavation.is_turned())
      return p;
    const Point<3> pivot = pivot_of(excavation);
    return pivot + axes_of(excavation) * (p - pivot);
  }



  Point<3>
  to_section(const Excavation<3> &excavation, const Point<3> &p)
  {
    if (!excavation.is_turned())
      return p;
    const Point<3> pivot = pivot_of(excavation);
    return pivot + transpose(axes_of(excavation)) * (p - pivot);
  }
} // namespace Keyblock

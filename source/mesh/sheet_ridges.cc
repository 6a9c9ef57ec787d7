// SPDX-License-Identifier: LGPL-2.1-or-later
// Sides of facets that meet at ridges.
#include <keyblock/mesh/sheet_ridges.h>

#include <utility>

namespace Keyblock
{
  template <int dim>
  std::vector<Ridge<dim>>
  ridges_of(const std::vector<Point<dim>> &corners)
  {
    std::vector<Ridge<dim>> ridges;
    for (unsigned int i = 0; i < corners.size(); ++i)
      if constexpr (dim == 2)
        ridges.push_back({{corners[i]}});
      else
        {
          Ridge<dim> ridge = {{corners[i], corners[(i + 1) % corners.size()]}};
          std::sort(ridge.begin(), ridge.end(), is_before<dim>);
          ridges.push_back(ridge);
        }
    return ridges;
  }



  namespace
  {
    /** From a ridge into a facet with @p corners, within its plane. */
    Tensor<1, 2>
    inward(const std::vector<Point<2>> &corners, const Ridge<2> &ridge)
    {
      return (corners[0] == ridge[0] ? corners[1] : corners[0]) - ridge[0];
    }

    Tensor<1, 3>
    inward(const std::vector<Point<3>> &corners, const Ridge<3> &ridge)
    {
      // by the way it goes round: the polygon may not be convex
      Tensor<1, 3> area;
      for (unsigned int i = 1; i + 1 < corners.size(); ++i)
        area += cross_product_3d(corners[i] - corners[0],
                                 corners[i + 1] - corners[0]);
      const Tensor<1, 3> in = cross_product_3d(area, ridge[1] - ridge[0]);
      for (unsigned int i = 0; i < corners.size(); ++i)
        if (corners[i] == ridge[1] &&
            corners[(i + 1) % corners.size()] == ridge[0])
          return -in;
      return in;
    }

    /** How a facet's normal goes round the ridge, seen along it: its sign. */
    double
    sense(const Tensor<1, 2> &inward,
          const Tensor<1, 2> &normal,
          const Ridge<2> &)
    {
      return cross_product_2d(inward) * normal;
    }

    double
    sense(const Tensor<1, 3> &inward,
          const Tensor<1, 3> &normal,
          const Ridge<3> &ridge)
    {
      return cross_product_3d(inward, normal) * (ridge[1] - ridge[0]);
    }
  } // namespace



  template <int dim>
  std::vector<bool>
  turn_facets_alike(const std::vector<JointExtent<dim>> &facets,
                    const std::vector<std::vector<Point<dim>>> &corners,
                    const std::vector<std::vector<Ridge<dim>>> &ridges,
                    const FacetsAtRidge<dim> &at_ridge)
  {
    std::vector<bool> is_turned(facets.size(), false),
      is_done(facets.size(), false);
    const auto sense_of = [&](const unsigned int f, const Ridge<dim> &ridge) {
      return sense(inward(corners[f], ridge), facets[f].normal, ridge);
    };
    std::vector<unsigned int> front;
    for (unsigned int seed = 0; seed < facets.size(); ++seed)
      {
        if (is_done[seed])
          continue;
        is_done[seed] = true;
        front         = {seed};
        while (!front.empty())
          {
            const unsigned int f = front.back();
            front.pop_back();
            for (const Ridge<dim> &ridge : ridges[f])
              for (const unsigned int g : at_ridge.at(ridge))
                if (!is_done[g])
                  {
                    // on one side normals go round the ridge in two senses
                    const bool is_alike =
                      sense_of(f, ridge) * sense_of(g, ridge) < 0.;
                    is_done[g]   = true;
                    is_turned[g] = is_turned[f] != !is_alike;
                    front.push_back(g);
                  }
          }
      }
    return is_turned;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<Ridge<dim>> ridges_of(const std::vector<Point<dim>> &); \
  template std::vector<bool> turn_facets_alike(                                \
    const std::vector<JointExtent<dim>> &,                                     \
    const std::vector<std::vector<Point<dim>>> &,                              \
    const std::vector<std::vector<Ridge<dim>>> &,                              \
    const FacetsAtRidge<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

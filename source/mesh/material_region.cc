// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/material_region.h>

#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    bool
    begins_with(const std::string &region, const std::string &word)
    {
      return region.rfind(word + " ", 0) == 0;
    }



    /** The joints below and above the region `band A B` of a material. */
    template <int dim>
    std::array<const Joint<dim> *, 2>
    find_band(const Scene<dim> &scene, const Material<dim> &material)
    {
      const std::vector<std::string> words =
        dealii::Utilities::split_string_list(material.region, ' ');
      std::array<const Joint<dim> *, 2> band{};
      for (unsigned int i = 1; i < std::min<std::size_t>(words.size(), 3); ++i)
        for (const auto &joint : scene.joints)
          if (joint->name == words[i])
            band[i - 1] = joint.get();
      AssertThrow(words.size() == 3 && band[0] && band[1],
                  InputError("The entry 'Materials/" + material.name +
                             "/Region' is '" + material.region +
                             "'; a band is `band A B` with two names of "
                             "'Joints/Names'."));
      // the lower joint first: the upper one's points are above it
      const dealii::Point<dim> upper = band[1]->extent == JointShape::polygon
                                         ? band[1]->vertices[0]
                                         : band[1]->point;
      if (band[0]->distance(upper) < 0.)
        std::swap(band[0], band[1]);
      return band;
    }
  } // namespace



  template <int dim>
  MaterialRegion<dim>::MaterialRegion(const Scene<dim> &scene,
                                      const Material<dim> &material)
    : region(material.region)
    , is_all(region == "all")
    , is_band(begins_with(region, "band"))
    , inside(is_group() || is_all || is_band ? "1" : region,
             1,
             "Materials/" + material.name + "/Region")
  {
    if (is_band)
      band = find_band(scene, material);
  }



  template <int dim>
  bool
  MaterialRegion<dim>::is_group() const
  {
    return begins_with(region, "id");
  }



  template <int dim>
  bool
  MaterialRegion<dim>::contains(const dealii::Point<dim> &point) const
  {
    if (is_group())
      return false;
    if (is_band)
      return band[0]->distance(point) > 0. && band[1]->distance(point) < 0.;
    return is_all || inside.value(point, 0., 0) > 0.;
  }

  template class MaterialRegion<2>;
  template class MaterialRegion<3>;
} // namespace Keyblock

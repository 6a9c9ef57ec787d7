// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/box.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/shape_place.h>
#include <keyblock/scene/solid_file.h>

#include <utility>

namespace Keyblock
{
  namespace
  {
    /** Longest side of a shape over that of the domain, below which its unit
     * is doubted [-]. */
    constexpr double least_of_domain = 1e-2;
  } // namespace



  template <int dim>
  ShapePlace<dim>::ShapePlace(const Domain<dim> &model,
                              const BoundingBox<dim> &box,
                              const std::string &has_shape,
                              const std::string &section,
                              const std::string &file)
    : shape(box)
    , beginning(has_shape + " of ")
    , remedy("; check its unit " +
             (names_unit(file) ? std::string("in the file")
                               : "('" + section + "/Scale')") +
             " and its coordinates ('Domain/Origin') against 'Domain'.")
  {
    const DomainOutline<dim> outline(model);
    domain = BoundingBox<dim>(std::make_pair(outline.lower, outline.upper));
    for (unsigned int d = 0; d < dim; ++d)
      beginning += (d > 0 ? ", " : "") + std::string(1, "xyz"[d]) + " from " +
                   text_of(shape.lower_bound(d)) + " to " +
                   text_of(shape.upper_bound(d));
  }



  template <int dim>
  void
  ShapePlace<dim>::require_that(const bool condition,
                                const std::string &fault) const
  {
    require(condition, beginning + " m, " + fault + remedy);
  }



  template <int dim>
  void
  ShapePlace<dim>::require_smaller() const
  {
    bool is_larger = true;
    for (unsigned int d = 0; d < dim; ++d)
      is_larger = is_larger && shape.side_length(d) >= domain.side_length(d);
    require_that(!is_larger, "larger than the domain");
  }



  template <int dim>
  void
  ShapePlace<dim>::require_size() const
  {
    require_that(longest_side(shape) >= least_of_domain * longest_side(domain),
                 "less than a hundredth of the domain");
  }



  template <int dim>
  void
  ShapePlace<dim>::require_inside(const bool may_touch) const
  {
    bool is_outside = false;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double low = shape.lower_bound(d), high = shape.upper_bound(d),
                     lower = domain.lower_bound(d),
                     upper = domain.upper_bound(d);
        is_outside         = is_outside || low > upper || high < lower ||
                     (!may_touch && (low == upper || high == lower));
      }
    require_that(!is_outside, "which is outside of the domain");
  }

  template class ShapePlace<2>;
  template class ShapePlace<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/check_tools.h>

#include <functional>
#include <map>

namespace Keyblock
{
  template <int dim>
  CheckValues
  evaluate_checks(const CheckInput<dim> &input)
  {
    using Check = std::function<CheckValues(const CheckInput<dim> &)>;
    static const std::map<std::string, Check> closed_forms = {
      {"incline", check_incline<dim>},
      {"resting", check_resting<dim>},
      {"bar_impact", check_bar_impact<dim>},
      {"oblique_impact", check_oblique_impact<dim>},
      {"bond_break", check_bond_break<dim>},
      {"newmark", check_newmark<dim>},
      {"toppling", check_toppling<dim>},
      {"rotation", check_rotation<dim>}};
    const auto found = closed_forms.find(input.scene.checks.closed_form);
    return found == closed_forms.end() ? CheckValues() : found->second(input);
  }

  template CheckValues evaluate_checks(const CheckInput<2> &);
  template CheckValues evaluate_checks(const CheckInput<3> &);
} // namespace Keyblock

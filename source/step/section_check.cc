// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/section_check.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  SectionCheck
  check_section(const Liner &liner, const LinerForce<dim> &force)
  {
    const double t = liner.thickness;
    double tension = 0., compression = 0.;
    for (const double side : {-1., 1.})
      for (const double stress :
           eigenvalues(force.thrust / t + side * 6. / (t * t) * force.moment))
        {
          tension     = std::max(tension, stress);
          compression = std::max(compression, -stress);
        }
    SectionCheck check;
    if (liner.compressive_strength > 0. && compression > 0.)
      check.factor = liner.compressive_strength / compression;
    if (liner.tensile_strength > 0. &&
        tension * check.factor > liner.tensile_strength)
      {
        check.factor     = liner.tensile_strength / tension;
        check.is_tension = true;
      }
    return check;
  }

  template SectionCheck check_section(const Liner &, const LinerForce<2> &);
  template SectionCheck check_section(const Liner &, const LinerForce<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_geometry_h
#define keyblock_contact_geometry_h

#include <keyblock/base/vector.h>

#include <vector>

// Vector algebra of the search for contacts; positions are dim values a surface
// node.
namespace Keyblock
{
  /** Position of a surface node. */
  template <int dim>
  Vector<dim>
  at(const std::vector<double> &position, const unsigned int node)
  {
    Vector<dim> p;
    for (int d = 0; d < dim; ++d)
      p[d] = position[dim * node + d];
    return p;
  }

  template <int dim>
  Vector<dim>
  difference(const Vector<dim> &a, const Vector<dim> &b)
  {
    return add<dim>(a, -1., b);
  }

  inline Vector<3>
  cross(const Vector<3> &a, const Vector<3> &b)
  {
    return {{a[1] * b[2] - a[2] * b[1],
             a[2] * b[0] - a[0] * b[2],
             a[0] * b[1] - a[1] * b[0]}};
  }

  template <int dim>
  Vector<dim>
  unit(const Vector<dim> &a)
  {
    const double length = norm<dim>(a);
    Vector<dim> result  = a;
    for (double &entry : result)
      entry /= length;
    return result;
  }
} // namespace Keyblock

#endif

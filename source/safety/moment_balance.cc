// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/moment_balance.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <deal.II/lac/vector.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    using Column = dealii::Vector<double>;

    /** What may be left of the forces, over them [-], what a column gains that
     * gains nothing, and columns that are looked at. */
    constexpr double balanced = 1e-6, no_gain = 1e-9;
    constexpr unsigned int most_columns = 400;

    /** Moments in space and in the plane. */
    template <int dim>
    constexpr unsigned int n_moments = dim == 3 ? 3 : 1;

    /** Corners of the convex hull of points on a face. */
    std::vector<Point<2>>
    hull_of(const BlockFace<2> &face)
    {
      const Tensor<1, 2> along({-face.inward[1], face.inward[0]});
      const auto [first, last] =
        std::minmax_element(face.vertices.begin(),
                            face.vertices.end(),
                            [&](const Point<2> &a, const Point<2> &b) {
                              return along * a < along * b;
                            });
      return {*first, *last};
    }

    std::vector<Point<3>>
    hull_of(const BlockFace<3> &face)
    {
      namespace bg = boost::geometry;
      using Flat   = bg::model::d2::point_xy<double>;
      Tensor<1, 3> axis;
      unsigned int least = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(face.inward[d]) < std::abs(face.inward[least]))
          least = d;
      axis[least]        = 1.;
      Tensor<1, 3> first = cross_product_3d(face.inward, axis);
      first /= first.norm();
      const Tensor<1, 3> other = cross_product_3d(face.inward, first);
      const Point<3> &origin   = face.vertices[0];
      bg::model::multi_point<Flat> points;
      for (const Point<3> &v : face.vertices)
        bg::append(points, Flat(first * (v - origin), other * (v - origin)));
      bg::model::polygon<Flat> hull;
      bg::convex_hull(points, hull);
      std::vector<Point<3>> corners;
      for (const Flat &p : hull.outer())
        corners.push_back(origin + p.x() * first + p.y() * other);
      if (corners.size() > 1)
        corners.pop_back(); // the first one again
      return corners;
    }

    /** A sum of columns with weights that are not negative, as near to a right
     * hand side as it gets (Lawson and Hanson 1974), of columns that come one
     * by one. */
    class NonnegativeSum
    {
    public:
      NonnegativeSum(const Column &rhs)
        : left(rhs)
        , rhs(rhs)
      {}

      void
      add(const Column &column)
      {
        columns.push_back(column);
        weights.push_back(0.);
        for (bool is_done = false; !is_done && !columns.empty();)
          {
            const std::vector<double> best = least_squares();
            double share                   = 1.;
            for (unsigned int i = 0; i < best.size(); ++i)
              if (best[i] <= 0.)
                share = std::min(share, weights[i] / (weights[i] - best[i]));
            is_done = share == 1.;
            step(best, std::isfinite(share) ? share : 0.);
          }
        left = rhs;
        for (unsigned int i = 0; i < columns.size(); ++i)
          left.add(-weights[i], columns[i]);
      }

      Column left; ///< of the right hand side

    private:
      std::vector<double>
      least_squares() const
      {
        dealii::FullMatrix<double> matrix(rhs.size(), columns.size());
        for (unsigned int j = 0; j < columns.size(); ++j)
          for (unsigned int i = 0; i < rhs.size(); ++i)
            matrix(i, j) = columns[j][i];
        Column best(columns.size());
        dealii::Householder<double>(matrix).least_squares(best, rhs);
        return {best.begin(), best.end()};
      }

      /** Go a share of the way to @p best, and drop what has no weight. */
      void
      step(const std::vector<double> &best, const double share)
      {
        unsigned int n = 0;
        for (unsigned int i = 0; i < best.size(); ++i)
          {
            const double weight = weights[i] + share * (best[i] - weights[i]);
            if (weight > 0. && (share == 1. || best[i] > 0. || weight > 1e-14))
              {
                columns[n]   = columns[i];
                weights[n++] = weight;
              }
          }
        columns.resize(n);
        weights.resize(n);
      }

      const Column rhs;
      std::vector<Column> columns; ///< those with weight
      std::vector<double> weights;
    };

    /** Forces that faces can bear at their corners, as columns of force and
     * moment over their sizes, and a row for each face with cohesion and each
     * force up to a bound, for the share that is in use. */
    template <int dim>
    class FaceForces
    {
    public:
      FaceForces(const std::vector<BlockFace<dim>> &faces,
                 const std::vector<PointForce<dim>> &forces,
                 const std::vector<PointForce<dim>> &at_most,
                 const Tensor<1, dim> &way,
                 const double factor)
        : way(way)
      {
        for (const PointForce<dim> &f : forces)
          load += f.force.norm();
        if (load == 0.)
          return;
        for (const BlockFace<dim> &face : faces)
          add_face(face, face.is_reduced ? factor : 1.);
        if (!contacts.empty())
          origin = contacts[0].corners[0];
        for (const Contact &contact : contacts)
          for (const Point<dim> &corner : contact.corners)
            size = std::max(size, corner.distance(origin));
        size                         = size > 0. ? size : 1.;
        const unsigned int first_row = dim + n_moments<dim>;
        rhs.reinit(first_row + n_cohesive + at_most.size());
        for (const PointForce<dim> &f : forces)
          rhs.add(-1. / load, column(f.force, f.place));
        for (unsigned int i = first_row; i < rhs.size(); ++i)
          rhs[i] = 1.;
        for (unsigned int i = 0; i < at_most.size(); ++i)
          add_bounded(column(at_most[i].force / load, at_most[i].place),
                      first_row + n_cohesive + i);
      }

      bool
      balance() const
      {
        if (load == 0.)
          return true;
        NonnegativeSum sum(rhs);
        for (unsigned int i = 0; i < most_columns; ++i)
          {
            if (sum.left.l2_norm() <= balanced)
              return true;
            const Column next = best_column(sum.left);
            if (next.size() == 0)
              return false;
            sum.add(next);
          }
        return false;
      }

    private:
      static constexpr unsigned int no_row = static_cast<unsigned int>(-1);

      struct Contact
      {
        Tensor<1, dim> inward;
        double tangent   = 0.; ///< of the friction angle
        double cohesion  = 0.; ///< force over the load [-]
        unsigned int row = no_row;
        std::vector<Point<dim>> corners;
      };

      void
      add_face(const BlockFace<dim> &face, const double factor)
      {
        if (face.vertices.empty())
          return;
        Contact contact;
        contact.inward   = face.inward;
        contact.tangent  = face.tangent_friction / factor;
        contact.cohesion = face.cohesion * face.area / (factor * load);
        if (contact.cohesion > 0.)
          contact.row = dim + n_moments<dim> + n_cohesive++;
        contact.corners = hull_of(face);
        contacts.push_back(contact);
      }

      /** A force up to a bound: a column of it all, and one of what is not in
       * use, whose weights add up to one in a row of their own. */
      void
      add_bounded(Column all, const unsigned int row)
      {
        Column unused(rhs.size());
        all[row] = unused[row] = 1.;
        bounded.push_back(all);
        bounded.push_back(unused);
      }

      static Tensor<1, dim>
      part_along(const Contact &contact, const Tensor<1, dim> &x)
      {
        const Tensor<1, dim> part = x - (x * contact.inward) * contact.inward;
        return part.norm() > 1e-12 * x.norm() ? part / part.norm()
                                              : Tensor<1, dim>();
      }

      /** Of a force at a place. */
      Column
      column(const Tensor<1, dim> &force, const Point<dim> &place) const
      {
        Column result(rhs.size());
        const Tensor<1, dim> arm = (place - origin) / size;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = force[d];
        if constexpr (dim == 2)
          result[2] = arm[0] * force[1] - arm[1] * force[0];
        else
          {
            const Tensor<1, 3> moment = cross_product_3d(arm, force);
            for (unsigned int d = 0; d < 3; ++d)
              result[3 + d] = moment[d];
          }
        return result;
      }

      /** By how much a force at a place is along @p left, in each direction. */
      Tensor<1, dim>
      gain_at(const Point<dim> &place, const Column &left) const
      {
        Tensor<1, dim> gain;
        for (unsigned int d = 0; d < dim; ++d)
          {
            Tensor<1, dim> unit;
            unit[d] = 1.;
            gain[d] = column(unit, place) * left;
          }
        return gain;
      }

      /** That which is most along @p left; none if none is. */
      Column
      best_column(const Column &left) const
      {
        Column best;
        double most        = no_gain;
        const auto try_one = [&](const Column &one) {
          if (const double gain = one * left / one.l2_norm(); gain > most)
            {
              most = gain;
              best = one;
            }
        };
        for (const Column &one : bounded)
          try_one(one);
        for (const bool is_against_way : {true, false})
          for (const Contact &contact : contacts)
            for (const Point<dim> &corner : contact.corners)
              {
                if (best.size() > 0 && !is_against_way)
                  return best;
                try_corner(contact,
                           corner,
                           is_against_way ? -way : gain_at(corner, left),
                           try_one);
              }
        return best;
      }

      /** The forces at a corner with friction, and of cohesion, towards. */
      template <typename TryOne>
      void
      try_corner(const Contact &contact,
                 const Point<dim> &corner,
                 const Tensor<1, dim> &towards,
                 const TryOne &try_one) const
      {
        const Tensor<1, dim> along = part_along(contact, towards);
        try_one(column(contact.inward + contact.tangent * along, corner));
        if (contact.row == no_row)
          return;
        Column cohesive       = column(contact.cohesion * along, corner);
        cohesive[contact.row] = 1.;
        try_one(cohesive);
        Column unused(rhs.size());
        unused[contact.row] = 1.;
        try_one(unused);
      }

      const Tensor<1, dim> way;
      double load = 0.; ///< sizes of all forces, added up [N]
      Point<dim> origin;
      double size             = 0.; ///< [m]
      unsigned int n_cohesive = 0;
      std::vector<Contact> contacts;
      std::vector<Column> bounded; ///< forces that may be less
      Column rhs;
    };
  } // namespace



  template <int dim>
  bool
  can_balance(const std::vector<BlockFace<dim>> &faces,
              const std::vector<PointForce<dim>> &forces,
              const std::vector<PointForce<dim>> &at_most,
              const Tensor<1, dim> &way,
              const double factor)
  {
    return FaceForces<dim>(faces, forces, at_most, way, factor).balance();
  }

  template bool can_balance(const std::vector<BlockFace<2>> &,
                            const std::vector<PointForce<2>> &,
                            const std::vector<PointForce<2>> &,
                            const Tensor<1, 2> &,
                            const double);
  template bool can_balance(const std::vector<BlockFace<3>> &,
                            const std::vector<PointForce<3>> &,
                            const std::vector<PointForce<3>> &,
                            const Tensor<1, 3> &,
                            const double);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <keyblock/rock/far_field.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  using dealii::FullMatrix;

  template <int dim>
  Tensor<1, dim>
  KelvinFields<dim>::displacement(const unsigned int field,
                                  const Point<dim> &x) const
  {
    const double r = x.norm(), k = 3. - 4. * poisson_ratio();
    Tensor<1, dim> u;
    if (field < n_forces)
      {
        // a single force along axis j: delta_ij k / r + x_i x_j / r^3
        u = x[field] / (r * r) * x;
        u[field] += k;
        return u / r;
      }
    // minus the derivative of that, or of the same with -k ln r for k / r in
    // 2D, with respect to x_l
    const unsigned int j = (field - n_forces) / dim,
                       l = (field - n_forces) % dim;
    u                    = -dim * x[j] * x[l] / (r * r) * x;
    if (j == l)
      u += x;
    u[j] -= k * x[l];
    u[l] += x[j];
    return u / std::pow(r, dim);
  }



  template <int dim>
  Tensor<2, dim>
  KelvinFields<dim>::gradient(const unsigned int field,
                              const Point<dim> &x) const
  {
    const double r = x.norm(), k = 3. - 4. * poisson_ratio();
    Tensor<2, dim> g;
    if (field < n_forces)
      {
        const unsigned int j = field;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int m = 0; m < dim; ++m)
            g[i][m] =
              (-(i == j ? k : 0.) * x[m] + (i == m ? x[j] : 0.) +
               (j == m ? x[i] : 0.) - 3. * x[i] * x[j] * x[m] / (r * r)) /
              (r * r * r);
        return g;
      }
    const unsigned int j = (field - n_forces) / dim,
                       l = (field - n_forces) % dim;
    // of x_a / r^dim with respect to x_m
    const auto of_first = [&](const unsigned int a, const unsigned int m) {
      return ((a == m ? 1. : 0.) - dim * x[a] * x[m] / (r * r)) /
             std::pow(r, dim);
    };
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int m = 0; m < dim; ++m)
        {
          const double of_triple =
            ((i == m ? x[j] * x[l] : 0.) + (j == m ? x[i] * x[l] : 0.) +
             (l == m ? x[i] * x[j] : 0.) -
             (dim + 2.) * x[i] * x[j] * x[l] * x[m] / (r * r)) /
            std::pow(r, dim + 2);
          g[i][m] = -dim * of_triple;
          if (i == j)
            g[i][m] -= k * of_first(l, m);
          if (i == l)
            g[i][m] += of_first(j, m);
          if (j == l)
            g[i][m] += of_first(i, m);
        }
    return g;
  }



  template <int dim>
  Tensor<2, dim>
  KelvinFields<dim>::stress(const unsigned int field, const Point<dim> &x) const
  {
    const Tensor<2, dim> g = gradient(field, x);
    Tensor<2, dim> s       = mu * (g + transpose(g));
    for (unsigned int d = 0; d < dim; ++d)
      s[d][d] += lambda * trace(g);
    return s;
  }



  namespace
  {
    /** Largest eigenvalue of a product of symmetric matrices without negative
     * eigenvalues. */
    double
    largest_eigenvalue(const FullMatrix<double> &product)
    {
      dealii::LAPACKFullMatrix<double> matrix(product.m());
      matrix = product;
      matrix.compute_eigenvalues();
      double largest = 0.;
      for (unsigned int i = 0; i < product.m(); ++i)
        largest = std::max(largest, matrix.eigenvalue(i).real());
      return largest;
    }

    bool
    is_positive_definite(const FullMatrix<double> &symmetric)
    {
      dealii::LAPACKFullMatrix<double> matrix(symmetric.m());
      matrix = symmetric;
      matrix.compute_eigenvalues();
      double least = std::numeric_limits<double>::max(), largest = 0.;
      for (unsigned int i = 0; i < symmetric.m(); ++i)
        {
          least   = std::min(least, matrix.eigenvalue(i).real());
          largest = std::max(largest, matrix.eigenvalue(i).real());
        }
      return least > 1e-12 * largest;
    }
  } // namespace



  template <int dim>
  FarField<dim>::FarField(const std::vector<Face> &faces,
                          const SplitMesh<dim> &split,
                          const Numbering<dim> &numbering)
    : communicator(numbering.communicator)
  {
    constexpr unsigned int n = KelvinFields<dim>::n;
    if (faces.empty())
      return;
    KelvinFields<dim> fields{0., 0.};
    double total = 0., solid_angle = 0.;
    for (const Face &face : faces)
      {
        const Tensor<1, dim> outward = face.area();
        const double area            = outward.norm();
        const Tensor<1, dim> x       = face.place - face.excavation;
        total += area;
        fields.lambda += area * face.lambda;
        fields.mu += area * face.mu;
        solid_angle += outward * x / std::pow(x.norm(), dim);
      }
    fields.lambda /= total;
    fields.mu /= total;

    struct Entry
    {
      double spring = 0.;
      std::array<Tensor<1, dim>, n> displacement, force;
    };
    std::map<unsigned int, Entry> entries; // by vertex, those of all ranks
    for (const Face &face : faces)
      {
        // a cavity of radius R in an infinite body under a uniform pressure p
        // widens by p R / (2 G) (cylinder) or p R / (4 G) (sphere)
        const double distance = face.place.distance(face.excavation);
        const double spring   = (dim == 2 ? 2. : 4.) * face.mu / distance;
        for (unsigned int v = 0; v < face.vertices.size(); ++v)
          split.for_each_carrier(
            face.vertices[v],
            [&](const unsigned int carrier, const double weight) {
              const Tensor<1, dim> area = weight * face.areas[v];
              const Point<dim> x(split.mesh.vertices[face.vertices[v]] -
                                 face.excavation);
              Entry &entry = entries[carrier];
              entry.spring += area.norm() * spring;
              const Point<dim> place(split.mesh.vertices[carrier] -
                                     face.excavation);
              for (unsigned int m = 0; m < n; ++m)
                {
                  entry.displacement[m] = fields.displacement(m, place);
                  entry.force[m] -= fields.stress(m, x) * area;
                }
            });
      }

    FullMatrix<double> energy(n, n), spring_energy(n, n), spring_work(n, n);
    for (const auto &[vertex, entry] : entries)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            energy(i, j) += 0.5 * (entry.force[i] * entry.displacement[j] +
                                   entry.force[j] * entry.displacement[i]);
            spring_energy(i, j) +=
              entry.spring * (entry.displacement[i] * entry.displacement[j]);
            spring_work(i, j) += entry.force[i] * entry.force[j] / entry.spring;
          }
    const double circle = (dim == 2 ? 2. : 4.) * dealii::numbers::PI;
    const bool encloses = std::abs(solid_angle / circle - 1.) < 0.08;
    const bool is_exact =
      encloses && couple(energy, spring_energy, spring_work);
    for (const auto &[vertex, entry] : entries)
      if (numbering.is_owned(vertex))
        {
          springs.push_back({numbering.local_node(vertex), entry.spring});
          if (!is_exact)
            continue;
          for (unsigned int d = 0; d < dim; ++d)
            {
              for (unsigned int m = 0; m < n; ++m)
                columns.push_back(entry.force[m][d]);
              for (unsigned int m = 0; m < n; ++m)
                columns.push_back(entry.spring * entry.displacement[m][d]);
            }
        }
  }



  template <int dim>
  bool
  FarField<dim>::couple(const FullMatrix<double> &energy,
                        const FullMatrix<double> &spring_energy,
                        const FullMatrix<double> &spring_work)
  {
    const unsigned int n = energy.m();
    if (!is_positive_definite(energy))
      return false;
    n_coupled = n;
    FullMatrix<double> inverse(n, n);
    inverse.invert(energy);

    // F A^-1 F^T + R^T S R - S with R = I - U A^-1 F^T, in terms of [F, S U]
    FullMatrix<double> first(n, n), second(n, n), third(n, n);
    inverse.mmult(first, spring_energy);
    first.mmult(second, inverse);
    FullMatrix<double> couples(2 * n, 2 * n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          couples(i, j)     = inverse(i, j) + second(i, j);
          couples(i, n + j) = couples(n + i, j) = -inverse(i, j);
        }
    coupling       = std::make_shared<FullMatrix<double>>(couples);
    inverse_energy = std::make_shared<FullMatrix<double>>(inverse);
    // of a projection and of what it leaves the norms are the same
    spring_work.mmult(third, second);
    projection_norm = std::max(1., largest_eigenvalue(third));
    return true;
  }



  template <int dim>
  dealii::Vector<double>
  FarField<dim>::project(const std::vector<double> &displacement) const
  {
    const unsigned int n = n_columns();
    std::vector<double> result(n, 0.);
    const double *row = columns.data();
    for (const Spring &spring : springs)
      for (unsigned int d = 0; d < dim; ++d, row += n)
        {
          const double u = displacement[dim * spring.node + d];
          for (unsigned int m = 0; m < n; ++m)
            result[m] += row[m] * u;
        }
    communicator.sum_lists(result);
    return dealii::Vector<double>(result.begin(), result.end());
  }



  template <int dim>
  void
  FarField<dim>::add_force(const std::vector<double> &displacement,
                           std::vector<double> &force) const
  {
    for (const Spring &spring : springs)
      for (unsigned int d = 0; d < dim; ++d)
        force[dim * spring.node + d] +=
          spring.stiffness * displacement[dim * spring.node + d];
    if (!is_coupled())
      return;
    const unsigned int n = n_columns();
    dealii::Vector<double> strength(n);
    coupling->vmult(strength, project(displacement));
    const double *row = columns.data();
    for (const Spring &spring : springs)
      for (unsigned int d = 0; d < dim; ++d, row += n)
        for (unsigned int m = 0; m < n; ++m)
          force[dim * spring.node + d] += row[m] * strength[m];
  }



  template <int dim>
  double
  FarField<dim>::stored_energy(const std::vector<double> &displacement) const
  {
    double twice = 0.;
    for (const Spring &spring : springs)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double u = displacement[dim * spring.node + d];
          twice += spring.stiffness * u * u;
        }
    if (is_coupled())
      {
        const dealii::Vector<double> work = project(displacement);
        if (communicator.is_root())
          twice += coupling->matrix_norm_square(work);
      }
    return 0.5 * twice;
  }



  template <int dim>
  double
  FarField<dim>::frequency_bound(const std::vector<double> &inverse_mass) const
  {
    double of_springs = 0.;
    for (const Spring &spring : springs)
      of_springs =
        std::max(of_springs, spring.stiffness * inverse_mass[spring.node]);
    of_springs = communicator.max(of_springs);
    if (!is_coupled())
      return of_springs;

    FullMatrix<double> mobility(n_coupled, n_coupled), product(mobility);
    const double *row = columns.data();
    for (const Spring &spring : springs)
      for (unsigned int d = 0; d < dim; ++d, row += n_columns())
        for (unsigned int i = 0; i < n_coupled; ++i)
          for (unsigned int j = 0; j < n_coupled; ++j)
            mobility(i, j) += row[i] * row[j] * inverse_mass[spring.node];
    communicator.sum(&mobility(0, 0), mobility.n_elements());
    inverse_energy->mmult(product, mobility);
    return projection_norm * of_springs + largest_eigenvalue(product);
  }

  template struct KelvinFields<2>;
  template struct KelvinFields<3>;
  template class FarField<2>;
  template class FarField<3>;
} // namespace Keyblock

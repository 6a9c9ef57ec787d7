// SPDX-License-Identifier: LGPL-2.1-or-later
// Weighted least squares of measurements by fields.
#include <keyblock/base/errors.h>
#include <keyblock/geostress/geostress.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>

namespace Keyblock
{
  FieldFit
  fit_fields(const std::vector<std::vector<double>> &fields,
             const std::vector<double> &values,
             const std::vector<double> &weights,
             const std::vector<std::string> &names)
  {
    const unsigned int n = values.size(), m = names.size();
    AssertThrow(n > m,
                InputError("There are " + std::to_string(n) +
                           " measured components for " + std::to_string(m) +
                           " fields; measure more, or take fields out of "
                           "'Initial state/Stress fields'."));
    // columns of length one, rows times the root of the weight
    std::vector<double> scale(m, 0.);
    for (unsigned int j = 0; j < m; ++j)
      {
        for (unsigned int i = 0; i < n; ++i)
          scale[j] += weights[i] * fields[i][j] * fields[i][j];
        scale[j] = std::sqrt(scale[j]);
        AssertThrow(scale[j] > 0.,
                    InputError("The measured components do not feel the field "
                               "'" +
                               names[j] +
                               "' at all; take it out of 'Initial state/Stress "
                               "fields'."));
      }
    dealii::LAPACKFullMatrix<double> normal(m);
    std::vector<double> right_side(m, 0.);
    for (unsigned int j = 0; j < m; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const double a = weights[i] * fields[i][j] / scale[j];
          right_side[j] += a * values[i];
          for (unsigned int k = 0; k < m; ++k)
            normal(j, k) += a * fields[i][k] / scale[k];
        }
    dealii::FullMatrix<double> vectors(m, m);
    dealii::Vector<double> eigenvalues(m);
    dealii::LAPACKFullMatrix<double> copy(normal);
    copy.compute_eigenvalues_symmetric(
      -1., 2. * m, 1e-300, eigenvalues, vectors);

    FieldFit fit;
    const double largest = eigenvalues(m - 1);
    fit.condition_number =
      std::sqrt(largest / std::max(eigenvalues(0), 1e-300 * largest));
    if (eigenvalues(0) < 1e-12 * largest)
      {
        std::string mixed;
        for (unsigned int j = 0; j < m; ++j)
          if (std::abs(vectors(j, 0)) > 0.05)
            mixed += (mixed.empty() ? "'" : ", '") + names[j] + "'";
        AssertThrow(
          false,
          InputError("The measured components cannot tell the fields " + mixed +
                     " from each other; take one of them out of "
                     "'Initial state/Stress fields'."));
      }
    fit.coefficients.assign(m, 0.);
    std::vector<double> variance(m, 0.);
    for (unsigned int e = 0; e < m; ++e)
      {
        double part = 0.;
        for (unsigned int j = 0; j < m; ++j)
          part += vectors(j, e) * right_side[j];
        for (unsigned int j = 0; j < m; ++j)
          {
            fit.coefficients[j] += vectors(j, e) * part / eigenvalues(e);
            variance[j] += vectors(j, e) * vectors(j, e) / eigenvalues(e);
          }
      }
    double residual = 0., mean = 0., total = 0., sum = 0.;
    for (unsigned int j = 0; j < m; ++j)
      fit.coefficients[j] /= scale[j];
    for (unsigned int i = 0; i < n; ++i)
      {
        fit.fitted.push_back(0.);
        for (unsigned int j = 0; j < m; ++j)
          fit.fitted[i] += fields[i][j] * fit.coefficients[j];
        residual += weights[i] * std::pow(values[i] - fit.fitted[i], 2);
        mean += weights[i] * values[i];
        sum += weights[i];
      }
    for (unsigned int i = 0; i < n; ++i)
      total += weights[i] * std::pow(values[i] - mean / sum, 2);
    fit.r_squared = total > 0. ? 1. - residual / total : 1.;
    for (unsigned int j = 0; j < m; ++j)
      fit.standard_errors.push_back(
        std::sqrt(residual / (n - m) * variance[j]) / scale[j]);
    return fit;
  }



  void
  write_geostress(const std::string &file_name, const Geostress &result)
  {
    std::ofstream out(file_name);
    out << "measurement,measured [Pa],fitted [Pa],residual [Pa]\n"
        << std::setprecision(12);
    for (unsigned int i = 0; i < result.measured.size(); ++i)
      out << '"' << result.measurements[i] << "\"," << result.measured[i] << ','
          << result.fit.fitted[i] << ','
          << result.measured[i] - result.fit.fitted[i] << '\n';
    AssertThrow(out.flush(),
                InputError("The file '" + file_name +
                           "' cannot be written; check free space and "
                           "permissions."));
  }



  void
  print_geostress(std::ostream &out, const Geostress &result)
  {
    out << "Stress  " << result.measured.size() << " measured components, R2 "
        << std::setprecision(6) << result.fit.r_squared << ", condition number "
        << result.fit.condition_number << '\n';
    for (unsigned int j = 0; j < result.names.size(); ++j)
      out << "        " << result.names[j] << " = "
          << result.fit.coefficients[j] << " +- "
          << result.fit.standard_errors[j] << '\n';
  }
} // namespace Keyblock

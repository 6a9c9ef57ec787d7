// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_geostress_geostress_h
#define keyblock_geostress_geostress_h

#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Weighted least squares of measurements as a sum of fields. */
  struct FieldFit
  {
    std::vector<double> coefficients, standard_errors;
    std::vector<double> fitted; ///< one per measurement
    double r_squared        = 0.;
    double condition_number = 0.; ///< of the scaled matrix of the fields
  };

  /**
   * Fit @p values (n) by the columns of @p fields (n rows, m columns) with
   * weights @p weights (n). Columns are scaled to one before the condition
   * number is taken. Standard errors follow from the scatter of the residuals
   * over n - m degrees of freedom.
   *
   * Throws InputError if there are not more measurements than fields, or if
   * they cannot be separated; the sentence names the fields by @p names.
   */
  FieldFit fit_fields(const std::vector<std::vector<double>> &fields,
                      const std::vector<double> &values,
                      const std::vector<double> &weights,
                      const std::vector<std::string> &names);

  /** An inversion of measured stresses. */
  struct Geostress
  {
    std::vector<std::string> names;        ///< of the fields
    std::vector<std::string> measurements; ///< coordinates and component
    std::vector<double> measured;          ///< [Pa]
    FieldFit fit;
  };

  /**
   * Set the stress of all cells to the sum of the scene's unit fields that fits
   * its measured points best. Each field is an elastic solve on the model, all
   * joints tied: gravity between rollers, the others by displacements of the
   * sides and of the bottom that would make them uniform, or graded with depth,
   * in homogeneous rock of the first material. Stresses at a point are those of
   * the line (plane) fitted to the nearest cells' means (collective).
   *
   * Throws InputError for a file that cannot be used, or a point outside.
   */
  template <int dim>
  std::unique_ptr<Geostress>
  invert_measured_stress(const Scene<dim> &scene,
                         const SplitMesh<dim> &split,
                         const Numbering<dim> &numbering,
                         CellArrays<dim> &cells,
                         Fields<dim> &fields);

  /** Write one line per measurement: where, measured, fitted, residual. */
  void write_geostress(const std::string &file_name, const Geostress &result);

  /** The factors and how well they fit, for people. */
  void print_geostress(std::ostream &out, const Geostress &result);
} // namespace Keyblock

#endif

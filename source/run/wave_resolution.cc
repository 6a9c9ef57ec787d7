// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/mesh/place_digits.h>
#include <keyblock/run/wave_resolution.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Share of a history's energy that the mesh is to carry [-]. */
    constexpr double resolved_share = 0.95;

    /** Times at which a formula is looked at. */
    constexpr unsigned int n_samples = 16384;

    /** Speed of shear waves over the longest way across a cell's edges [1/s],
     * where it is least. */
    template <int dim>
    double
    slowest_crossing(const Ground<dim> &ground, Point<dim> &place)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      double least          = std::numeric_limits<double>::max();
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const Material<dim> &rock =
            *ground.scene.materials[ground.material_of(c)];
          if (rock.is_rigid() || ground.is_excavated(c))
            continue;
          double longest = 0.;
          for (unsigned int v = 0; v < (1 << dim); ++v)
            for (unsigned int d = 0; d < dim; ++d)
              if (!((v >> d) & 1))
                longest =
                  std::max(longest,
                           mesh.vertices[mesh.cells[c][v]].distance(
                             mesh.vertices[mesh.cells[c][v | (1 << d)]]));
          const double rate = rock.s_wave_speed() / longest;
          if (rate < least)
            {
              least = rate;
              place = mesh.cell_center(c);
            }
        }
      return least;
    }

    /** Values of the velocity that a formula prescribes at a place while
     * stages with a duration of their own last, in all. Without such stages,
     * or times in the formula, there is one of 0. */
    template <int dim>
    TimeSeries
    sample(const Support<dim> &support,
           const Scene<dim> &scene,
           const Point<dim> &place)
    {
      double duration = 0.;
      for (const auto &stage : scene.stages)
        if (stage->is_dynamic())
          duration += stage->duration;
      if (duration == 0. || !depends_on_time(support.velocity))
        return TimeSeries(0., 1., {{0.}});
      const Expression<dim> formula(support.velocity,
                                    dim,
                                    "Supports/*/Velocity");
      std::vector<std::vector<double>> values(dim);
      for (unsigned int i = 0; i < n_samples; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          values[d].push_back(
            formula.value(place, duration * i / n_samples, d));
      return TimeSeries(0., duration / n_samples, values);
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_short_waves(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    std::vector<std::string> warnings;
    for (const auto &support : scene.supports)
      {
        if (!support->history && support->velocity.empty())
          continue;
        Point<dim> place;
        const double crossing =
          slowest_crossing<dim>({scene, split, scene.history_stage(*support)},
                                place);
        const TimeSeries waves =
          support->history ? *support->history : sample(*support, scene, place);
        const double frequency = waves.frequency_below(resolved_share);
        const double n_cells   = crossing / frequency;
        if (n_cells >= least_cells_per_wavelength)
          continue;
        const int digits  = digits_of_place(split.mesh, 6);
        std::string where = text_of(place[0], digits);
        for (unsigned int d = 1; d < dim; ++d)
          where += ", " + text_of(place[d], digits);
        const std::string source =
          support->history
            ? "history '" + support->history_file + "'"
            : "velocity in 'Supports/" + support->name + "/Velocity'";
        warnings.push_back(
          "Of the " + source + " 95 % of the energy is below " +
          text_of(frequency) + " Hz, whose shear waves are " +
          text_of(n_cells) + " cells long at (" + where + ") m; " +
          text_of(least_cells_per_wavelength) +
          " are needed: refine the mesh, or " +
          (support->history ? "filter the history." : "lower the frequency."));
      }
    return warnings;
  }

  template std::vector<std::string>
  warnings_of_short_waves(const Scene<2> &, const SplitMesh<2> &);
  template std::vector<std::string>
  warnings_of_short_waves(const Scene<3> &, const SplitMesh<3> &);
} // namespace Keyblock

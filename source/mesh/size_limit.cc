// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/mesh/size_limit.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Memory of a run without cells, and per cell: peaks of runs of 250,000
     * and 1,000,000 (2D), 64,000 to 343,000 (3D) cells, set up only. Writing
     * VTU takes a third more for a moment (3D) [bytes]. */
    constexpr double bytes_of_program = 2e8;
    template <int dim>
    constexpr double bytes_per_cell = (dim == 2) ? 750. : 1500.;

    /** A sign of each cell for each joint. */
    constexpr double bytes_per_cell_and_joint = 1.;

    /** Cells times corners are counted in 32 bits, in places with a sign. */
    template <int dim>
    constexpr double most_cells = double(1u << 31) / (1u << dim);

    /** Boxes that an estimate looks into at most, and the change of the size
     * within one, relative to the size, that is small [-]. */
    constexpr unsigned int most_boxes = 20000;
    constexpr double small_change     = 0.3;

    std::string
    rounded_text(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(3) << value;
      return text.str();
    }

    /** The limit of the control group, infinite without one [bytes]. */
    double
    memory_of_control_group()
    {
      double limit = std::numeric_limits<double>::infinity();
      for (const char *file : {"/sys/fs/cgroup/memory.max",
                               "/sys/fs/cgroup/memory/"
                               "memory.limit_in_bytes"})
        {
          std::ifstream in(file);
          double value;
          if (in >> value)
            limit = std::min(limit, value);
        }
      return limit;
    }

    /** Mean of 1 / h^dim where h grows evenly from @p low to @p high. */
    template <int dim>
    double
    mean_of_inverse(const double low, const double high)
    {
      if (high - low < 1e-3 * high)
        return std::pow(high, -dim);
      return (std::pow(low, 1 - dim) - std::pow(high, 1 - dim)) /
             ((dim - 1) * (high - low));
    }
  } // namespace



  double
  usable_memory()
  {
    double memory =
      double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
    rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      memory = std::min<double>(memory, limit.rlim_cur);
    return std::min(memory, memory_of_control_group());
  }



  template <int dim>
  double
  needed_memory(const double n_cells, const std::size_t n_joints)
  {
    return bytes_of_program +
           n_cells * (bytes_per_cell<dim> +
                      bytes_per_cell_and_joint * static_cast<double>(n_joints));
  }



  template <int dim>
  void
  require_size(const double n_cells,
               const std::size_t n_joints,
               const std::string &origin,
               const std::function<std::string(double)> &remedy)
  {
    const double memory   = usable_memory(),
                 needed   = needed_memory<dim>(n_cells, n_joints);
    const double per_cell = (needed - bytes_of_program) / n_cells;
    const double fitting =
      std::min(most_cells<dim>,
               std::max(1., (memory - bytes_of_program) / per_cell));
    if (n_cells <= fitting)
      return;
    const bool is_counted = n_cells <= most_cells<dim>;
    AssertThrow(
      false,
      InputError(
        "The mesh would have about " + rounded_text(n_cells) + " cells by " +
        origin + " and need about " + rounded_text(needed / 1e9) + " GB" +
        (is_counted ? "" : ", more cells than can be counted") + "; the " +
        rounded_text(memory / 1e9) +
        " GB of memory here are enough for about " + rounded_text(fitting) +
        " cells: " + remedy(n_cells / fitting) + "."));
  }



  template <int dim>
  double
  estimate_cells(const MeshSize<dim> &size,
                 const Point<dim> &low,
                 const Point<dim> &high,
                 const double enough)
  {
    struct Box
    {
      Point<dim> low;
      Tensor<1, dim> sides;
    };
    double n               = 0.;
    std::vector<Box> boxes = {{low, high - low}};
    unsigned int n_looked  = 0;
    while (!boxes.empty() && n < enough)
      {
        n_looked += boxes.size();
        const bool is_last = n_looked + (boxes.size() << dim) > most_boxes;
        std::vector<Box> halves;
        for (const Box &box : boxes)
          {
            const double here   = size(box.low + 0.5 * box.sides);
            const double change = 0.5 * box.sides.norm() * size.steepness();
            double volume       = 1.;
            for (unsigned int d = 0; d < dim; ++d)
              volume *= box.sides[d];
            if (change <= small_change * here)
              n += volume / std::pow(here, dim);
            else if (is_last)
              n += volume * mean_of_inverse<dim>(std::max(size.smallest(),
                                                          here - change),
                                                 here + change);
            else
              for (unsigned int corner = 0; corner < (1u << dim); ++corner)
                {
                  Box half{box.low, 0.5 * box.sides};
                  for (unsigned int d = 0; d < dim; ++d)
                    if (corner & (1u << d))
                      half.low[d] += half.sides[d];
                  halves.push_back(half);
                }
          }
        boxes = std::move(halves);
      }
    return n;
  }

  template double needed_memory<2>(const double, const std::size_t);
  template double needed_memory<3>(const double, const std::size_t);
  template void require_size<2>(const double,
                                const std::size_t,
                                const std::string &,
                                const std::function<std::string(double)> &);
  template void require_size<3>(const double,
                                const std::size_t,
                                const std::string &,
                                const std::function<std::string(double)> &);
  template double estimate_cells(const MeshSize<2> &,
                                 const Point<2> &,
                                 const Point<2> &,
                                 const double);
  template double estimate_cells(const MeshSize<3> &,
                                 const Point<3> &,
                                 const Point<3> &,
                                 const double);
} // namespace Keyblock

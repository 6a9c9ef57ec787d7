// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/cell_kernels.h>
#include <keyblock/rock/internal_force.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Keyblock
{
  // of rock/cell_kernels.cc, one per instruction set
#ifdef KEYBLOCK_HAS_X86_KERNELS
  namespace avx512
  {
    void register_kernels(CellKernels &kernels);
  }
  namespace avx2
  {
    void register_kernels(CellKernels &kernels);
  }
#endif
  namespace portable
  {
    void register_kernels(CellKernels &kernels);
  }



  const std::vector<CellKernels> &
  available_kernels()
  {
    static const std::vector<CellKernels> list = [] {
      std::vector<CellKernels> found;
      const auto add = [&](const std::string &name,
                           void (*register_kernels)(CellKernels &)) {
        found.emplace_back();
        found.back().name = name;
        register_kernels(found.back());
      };
#ifdef KEYBLOCK_HAS_X86_KERNELS
      if (__builtin_cpu_supports("avx512f") &&
          __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512vl"))
        add("avx512", avx512::register_kernels);
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        add("avx2", avx2::register_kernels);
#endif
      add("portable", portable::register_kernels);
      return found;
    }();
    return list;
  }



  namespace
  {
    const CellKernels *chosen_kernels = nullptr;

    const CellKernels &
    kernels()
    {
      return chosen_kernels ? *chosen_kernels : available_kernels().front();
    }

    /** Mean of two stresses times the plastic strain that leads from @p trial
     * to @p stress [J/m3], and the size of that strain. */
    template <int dim>
    inline double
    plastic_work_density(const double *before,
                         const double *trial,
                         const double *stress,
                         const double lambda,
                         const double mu,
                         double &size)
    {
      const double volume =
        (trial[0] + trial[1] + trial[2] - stress[0] - stress[1] - stress[2]) *
        lambda / (3. * lambda + 2. * mu);
      double work = 0., square = 0.;
      for (int k = 0; k < n_stress<dim>; ++k)
        {
          const double strain =
            (trial[k] - stress[k] - (k < 3 ? volume : 0.)) / (2. * mu);
          const double weight = k < 3 ? 1. : 2.;
          work += weight * 0.5 * (before[k] + stress[k]) * strain;
          square += weight * strain * strain;
        }
      size = std::sqrt(2. / 3. * square);
      return work;
    }

    /** The part of the yield surface's inside that is quick to test. */
    ElasticBound
    bound_of(const MohrCoulomb &strength)
    {
      const YieldStrength &peak = strength.peak;
      const double k            = peak.slope;
      ElasticBound bound;
      bound.slope    = k - 1.;
      bound.factor   = 4. / 3. * (k * k + k + 1.);
      bound.uniaxial = peak.uniaxial;
      bound.tension  = peak.tension;
      // strength that varies is looked up point by point
      if (strength.has_residual)
        bound.uniaxial = -std::numeric_limits<double>::max();
      return bound;
    }

    /** Return a point that may yield to the yield surface; whether it was
     * outside. */
    template <int dim>
    bool
    yield(void *owner,
          const unsigned int cell,
          const unsigned int point,
          const double volume,
          const double *before,
          double *stress)
    {
      CellArrays<dim> &cells   = *static_cast<CellArrays<dim> *>(owner);
      const unsigned int place = cell - cells.first_plastic();
      double &plastic_strain = cells.plastic_strain[(1 << dim) * place + point];
      std::array<double, n_stress<dim>> trial;
      std::copy(stress, stress + n_stress<dim>, trial.begin());
      if (!apply_mohr_coulomb<dim>(cells.strengths[cells.strength[place]].at(
                                     plastic_strain),
                                   cells.lambda[cell],
                                   cells.mu[cell],
                                   stress))
        return false;
      double size       = 0.;
      const double work = plastic_work_density<dim>(
        before, trial.data(), stress, cells.lambda[cell], cells.mu[cell], size);
      ++cells.n_yielding;
      cells.plastic_work += volume * work;
      plastic_strain += size;
      return true;
    }

    template <int dim>
    void
    run_kernel(const CellKind kind, const CellPass<dim> &pass)
    {
      const CellKernels &k = kernels();
      if constexpr (dim == 2)
        (kind == CellKind::elastic           ? k.elastic_2d
         : kind == CellKind::mean_dilatation ? k.averaged_2d
                                             : k.plastic_2d)(pass);
      else
        (kind == CellKind::elastic           ? k.elastic_3d
         : kind == CellKind::mean_dilatation ? k.averaged_3d
                                             : k.plastic_3d)(pass);
    }

    /** The same for the cells of @p pass that are in @p ranges, if given. */
    template <int dim>
    void
    run_kernel_on(const std::vector<CellRange> *const ranges,
                  const CellKind kind,
                  const CellPass<dim> &pass)
    {
      if (ranges == nullptr)
        {
          run_kernel<dim>(kind, pass);
          return;
        }
      CellPass<dim> part = pass;
      for (const CellRange &range : *ranges)
        {
          part.begin = std::max(pass.begin, range.begin);
          part.end   = std::min(pass.end, range.end);
          if (part.begin < part.end)
            run_kernel<dim>(kind, part);
        }
    }
  } // namespace



  void
  choose_kernels(const std::string &name)
  {
    chosen_kernels = nullptr;
    for (const CellKernels &k : available_kernels())
      if (k.name == name)
        chosen_kernels = &k;
    if (chosen_kernels == nullptr && !name.empty())
      throw std::invalid_argument("no kernels '" + name +
                                  "' on this processor");
  }



  template <int dim>
  void
  add_internal_force(const ForcePass &settings,
                     CellArrays<dim> &cells,
                     const double *position,
                     const double *rate,
                     double *internal,
                     double *damping)
  {
    std::array<double, batch_size> lambda, mu;
    CellPass<dim> pass;
    pass.nodes    = cells.nodes.data();
    pass.beta     = settings.has_damping ? cells.beta.data() : nullptr;
    pass.stress   = cells.stress.values.data();
    pass.step     = settings.step;
    pass.position = position;
    pass.rate     = rate;
    pass.internal = internal;
    pass.damping  = damping;
    pass.is_large = settings.is_large;
    for (const CellKind kind :
         {CellKind::elastic, CellKind::mean_dilatation, CellKind::plastic})
      {
        pass.begin = cells.kind_begin[unsigned(kind)];
        pass.end   = cells.kind_begin[unsigned(kind) + 1];
        if (pass.begin == pass.end)
          continue;
        // one batch of moduli serves all
        const bool is_uniform = cells.is_uniform[unsigned(kind)];
        lambda.fill(cells.lambda[pass.begin]);
        mu.fill(cells.mu[pass.begin]);
        pass.lambda        = is_uniform ? lambda.data() : cells.lambda.data();
        pass.mu            = is_uniform ? mu.data() : cells.mu.data();
        pass.moduli_stride = is_uniform ? 0 : 1;
        if (kind != CellKind::plastic)
          run_kernel_on<dim>(settings.cells, kind, pass);
      }
    cells.n_yielding = 0;
    if (pass.begin == pass.end)
      return;
    std::vector<ElasticBound> bounds;
    for (const MohrCoulomb &strength : cells.strengths)
      bounds.push_back(bound_of(strength));
    pass.bounds        = bounds.data();
    pass.strength      = cells.strength.data();
    pass.first_plastic = cells.first_plastic();
    pass.yield         = yield<dim>;
    pass.owner         = &cells;
    pass.plastic_work  = &cells.plastic_work;
    // the little that a point adds would be lost in the sum of all steps
    const double so_far = cells.plastic_work;
    cells.plastic_work  = 0.;
    run_kernel_on<dim>(settings.cells, CellKind::plastic, pass);
    cells.plastic_work += so_far;
  }



  template <int dim>
  std::array<double, dim *(1 << dim) * dim *(1 << dim)>
  cell_stiffness(const std::array<std::array<double, dim>, 1 << dim> &corners,
                 const bool is_averaged,
                 const double lambda,
                 const double mu)
  {
    constexpr int n_vertices = 1 << dim;
    constexpr int n          = dim * n_vertices;
    std::array<unsigned int, n_vertices> nodes;
    for (unsigned int v = 0; v < n_vertices; ++v)
      nodes[v] = v;
    StressArray<dim> stress;
    CellPass<dim> pass;
    pass.end      = 1;
    pass.nodes    = &nodes;
    pass.lambda   = &lambda;
    pass.mu       = &mu;
    pass.step     = 1.;
    pass.position = corners[0].data();
    std::array<double, n * n> stiffness;
    for (int j = 0; j < n; ++j)
      {
        std::array<double, n> unit{}, force{};
        unit[j] = 1.;
        stress.reinit(1);
        pass.stress   = stress.values.data();
        pass.rate     = unit.data();
        pass.internal = force.data();
        run_kernel<dim>(is_averaged ? CellKind::mean_dilatation
                                    : CellKind::elastic,
                        pass);
        for (int i = 0; i < n; ++i)
          stiffness[i * n + j] = force[i];
      }
    return stiffness;
  }



  template <int dim>
  double
  elastic_energy(const CellArrays<dim> &cells, const double *position)
  {
    CellPass<dim> pass;
    pass.nodes  = cells.nodes.data();
    pass.lambda = cells.lambda.data();
    pass.mu     = cells.mu.data();
    // only read here
    pass.stress   = const_cast<double *>(cells.stress.values.data());
    pass.position = position;
    const auto of = [&](const bool is_elastic) {
      pass.begin = is_elastic ? 0 : cells.kind_begin[1];
      pass.end   = is_elastic ? cells.kind_begin[1] : cells.nodes.size();
      if constexpr (dim == 2)
        return kernels().energy_2d[is_elastic ? 0 : 1](pass);
      else
        return kernels().energy_3d[is_elastic ? 0 : 1](pass);
    };
    return of(true) + of(false);
  }

  template void add_internal_force(const ForcePass &,
                                   CellArrays<2> &,
                                   const double *,
                                   const double *,
                                   double *,
                                   double *);
  template void add_internal_force(const ForcePass &,
                                   CellArrays<3> &,
                                   const double *,
                                   const double *,
                                   double *,
                                   double *);
  template std::array<double, 64>
  cell_stiffness<2>(const std::array<std::array<double, 2>, 4> &,
                    const bool,
                    const double,
                    const double);
  template std::array<double, 576>
  cell_stiffness<3>(const std::array<std::array<double, 3>, 8> &,
                    const bool,
                    const double,
                    const double);
  template double elastic_energy(const CellArrays<2> &, const double *);
  template double elastic_energy(const CellArrays<3> &, const double *);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_cell_kernels_h
#define keyblock_rock_cell_kernels_h

#include <array>
#include <string>
#include <vector>

// The hot loop over cells, compiled for several instruction sets from one text
// (rock/cell_kernels.cc). Plain pointers: see base/simd.h for why.
namespace Keyblock
{
  /** Strength below which a point is certainly elastic (rock/mohr_coulomb.h):
   * 2 sqrt(j2) sqrt((k^2 + k + 1) / 3) <= uniaxial - (k - 1) p and
   * 2 sqrt(j2 / 3) <= tension - p. */
  struct ElasticBound
  {
    double slope    = 0.; ///< k - 1 [-]
    double factor   = 0.; ///< 4 (k^2 + k + 1) / 3 [-]
    double uniaxial = 0.; ///< [Pa]
    double tension  = 0.; ///< [Pa]
  };

  /** One pass over cells of one kind: what it reads and writes. Arrays with an
   * entry per cell are counted from cell 0, nodal ones hold dim values. */
  template <int dim>
  struct CellPass
  {
    unsigned int begin = 0, end = 0; ///< cells
    const std::array<unsigned int, 1 << dim> *nodes = nullptr;
    const double *lambda = nullptr, *mu = nullptr; ///< [Pa]
    /** 1: moduli have an entry per cell; 0: one batch of them, for all. */
    unsigned int moduli_stride = 1;
    const double *beta         = nullptr; ///< [s]; null: no damping
    double *stress             = nullptr; ///< as in StressArray [Pa]

    double step            = 0.;      ///< [s]
    const double *position = nullptr; ///< [m]
    const double *rate     = nullptr; ///< [m/s]
    double *internal       = nullptr; ///< added to [N]
    double *damping        = nullptr; ///< added to [N]

    bool is_large = false;

    // cells that may yield
    const ElasticBound *bounds     = nullptr; ///< one per strength
    const unsigned short *strength = nullptr; ///< of each such cell
    unsigned int first_plastic     = 0;
    /** Called for points that may yield: return @p trial to the yield
     * surface and book what that costs; whether it was outside. */
    bool (*yield)(void *owner,
                  const unsigned int cell,
                  const unsigned int point,
                  const double volume,
                  const double *before,
                  double *trial) = nullptr;
    void *owner                  = nullptr;
    double *plastic_work         = nullptr; ///< added to [J]
  };

  /** The loops of one instruction set. */
  struct CellKernels
  {
    std::string name;
    void (*elastic_2d)(const CellPass<2> &)  = nullptr;
    void (*elastic_3d)(const CellPass<3> &)  = nullptr;
    void (*averaged_2d)(const CellPass<2> &) = nullptr;
    void (*averaged_3d)(const CellPass<3> &) = nullptr;
    void (*plastic_2d)(const CellPass<2> &)  = nullptr;
    void (*plastic_3d)(const CellPass<3> &)  = nullptr;

    /** Elastic energy [J] of elastic cells and of the others. */
    std::array<double (*)(const CellPass<2> &), 2> energy_2d{};
    std::array<double (*)(const CellPass<3> &), 2> energy_3d{};
  };

  /** Those that this processor can run, the fastest first. */
  const std::vector<CellKernels> &available_kernels();

  /** Use the kernels @p name from now on; the fastest without it. */
  void choose_kernels(const std::string &name);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_energies_h
#define keyblock_step_energies_h

#include <keyblock/step/predict.h>

#include <array>
#include <string>

namespace Keyblock
{
  constexpr unsigned int n_energy_terms = 16;

  /** Those that history.csv lists: all but the last two. */
  constexpr unsigned int n_recorded_energies = 14;

  /** Every energy of the ledger [J], per metre of thickness in 2D. Work terms
   * count since the start of the stage; losses are positive. */
  struct Energies
  {
    double kinetic           = 0.; ///< at n + 1/2
    double elastic           = 0.; ///< at n + 1/2, from the cells' stresses
    double external          = 0.; ///< work of gravity and tractions
    double supports          = 0.; ///< work of prescribed motions
    double friction          = 0.;
    double contact_closure   = 0.;
    double penetration       = 0.; ///< work of the position correction
    double dilation          = 0.; ///< of pressure where joints dilate: gained
    double stiffness_damping = 0.;
    double mass_damping      = 0.;
    double local_damping     = 0.;
    double plastic           = 0.; ///< dissipated by plastic strains
    double radiation         = 0.; ///< left through quiet boundaries
    double joints            = 0.; ///< elastic, in compliant joints, at n + 1/2
    double excavated = 0.; ///< elastic, left with the cells excavated first
    double start     = 0.; ///< kinetic and elastic at the start of the stage

    void
    add(const NodeWork &work)
    {
      external += work.external;
      stiffness_damping += work.stiffness_damping;
      mass_damping += work.mass_damping;
      local_damping += work.local_damping;
    }

    /** A term and its name in files. */
    struct Term
    {
      std::string name;
      double Energies::*value;
    };

    /** All of them, in the order of as_array(). */
    static const std::array<Term, n_energy_terms> &terms();

    std::array<double, n_energy_terms> as_array() const;

    static Energies
    from_array(const std::array<double, n_energy_terms> &values);

    /** What the terms leave unexplained [J]. */
    double residual() const;

    /** The work that the residual is compared with [J]: the largest of what
     * was put in, what was stored at the start and what moves. */
    double turnover() const;

    double
    relative_residual() const
    {
      return turnover() > 0. ? residual() / turnover() : 0.;
    }
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_energy_ledger_h
#define keyblock_step_energy_ledger_h

#include <keyblock/contact/contact.h>
#include <keyblock/step/conditions.h>
#include <keyblock/step/energies.h>

#include <array>

namespace Keyblock
{
  /** What the ledger remembers of a stage, on this rank [J]. */
  struct LedgerState
  {
    Energies sums; ///< work terms
    ContactWork contact_work_at_start;
    double plastic_work_at_start = 0.;
    double excavated_energy      = 0.;

    /** Save it under @p group, or read it (StateFile::exchange). */
    template <typename File>
    void exchange(File &file, const std::string &group);
  };

  /** What the ledger has to know of the step that it books. */
  struct LedgerStep
  {
    const Stage &stage;
    double kick, dt;         ///< [s]
    bool has_damping_force;  ///< Fields::damping_force acts
    bool is_first;           ///< of the stage
    const double *positions; ///< of local nodes, to measure energies at [m]
  };

  /**
   * The work of all forces, term by term, and the energies of a state, each
   * measured by itself, so that their sum can fail (doc/theory.md, equation
   * 21).
   */
  template <int dim>
  class EnergyLedger
  {
  public:
    EnergyLedger(const Numbering<dim> &numbering,
                 const Conditions<dim> &conditions,
                 const CellArrays<dim> &cells,
                 const Fields<dim> &fields,
                 const Contact<dim> *contact);

    /** A stage begins. */
    void begin_stage(LedgerState &state) const;

    /** Elastic energy of the cells on this rank [J]. */
    double energy_of_cells(const double *positions) const;

    /** Book the work done on a run of nodes in this step. */
    void book_work(const NodeRun &run,
                   const LedgerStep &step,
                   LedgerState &state) const;

    /** That of supports: the forces that others left missing. */
    void book_supports(const LedgerStep &step, LedgerState &state) const;

    /** What left as waves, which book_work() takes for damping. */
    void book_radiation(const LedgerStep &step, LedgerState &state) const;

    /** All energies, of all ranks, before the nodes move (collective). */
    Energies sample(const LedgerStep &step, LedgerState &state) const;

    /** Those of a state that has not moved yet (collective). */
    Energies sample_start(const double *positions) const;

  private:
    /** This rank's elastic energy, of cells and force elements (collective)
     * [J]. */
    double stored_energy(const double *positions) const;

    /** What plastic strains of this rank have dissipated, ever [J]. */
    double plastic_work() const;

    Energies sum_over_ranks(const Energies &mine) const;

    const Numbering<dim> &numbering;
    const Conditions<dim> &conditions;
    const CellArrays<dim> &cells;
    const Fields<dim> &fields;
    const Contact<dim> *contact;
  };



  template <typename File>
  void
  LedgerState::exchange(File &file, const std::string &group)
  {
    std::array<double, n_energy_terms> terms = sums.as_array();
    std::vector<double *> shares;
    shares.reserve(terms.size() + 7);
    for (double &term : terms)
      shares.push_back(&term);
    for (double *const share : {&contact_work_at_start.friction,
                                &contact_work_at_start.closure,
                                &contact_work_at_start.penetration,
                                &contact_work_at_start.dilation,
                                &contact_work_at_start.elastic,
                                &plastic_work_at_start,
                                &excavated_energy})
      shares.push_back(share);
    file.exchange_shares(group + "work", shares);
    sums = Energies::from_array(terms);
  }
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checkpoint_checkpoint_h
#define keyblock_checkpoint_checkpoint_h

#include <keyblock/checkpoint/state_file.h>
#include <keyblock/output/output.h>

#include <array>

namespace Keyblock
{
  /**
   * The state of a run in lists over the whole mesh, so that it can be taken up
   * by another number of ranks: nodal fields by vertex of the split mesh,
   * stresses by cell, contact by pair and surface node (all
   * collective).
   *
   * Masses, supports and other things that follow from the scene and the stage
   * are not saved but made anew.
   */
  template <int dim>
  class StateExchange
  {
  public:
    StateExchange(StateFile &file,
                  const SplitMesh<dim> &split,
                  const Numbering<dim> &numbering);

    /** Save @p snapshot, which stays as it is, under @p group. */
    void save(const std::string &group, Snapshot<dim> &snapshot);

    /** Put the state under @p group into @p run; the next thing must be
     * ExplicitStep::resume or begin_stage. */
    void restore(const std::string &group, const RunParts<dim> &run);

    /** Save or read @p field, @p n_values for each of the first @p n_nodes
     * local nodes, which include the owned ones; it may be empty. */
    void exchange_nodes(const std::string &entry,
                        std::vector<double> &field,
                        const unsigned int n_values,
                        const unsigned int n_nodes);

  private:
    void exchange(const std::string &group, StageState &state);
    void exchange(const std::string &group, Fields<dim> &fields);
    void exchange(const std::string &group, CellArrays<dim> &cells);
    void exchange(const std::string &group, ContactMemory<dim> &memory);
    template <typename T>
    void exchange_pairs(const std::string &entry, std::vector<T> &state);

    /** Save or read @p values, @p n_values for each cell from @p first on. */
    void exchange_cells(const std::string &entry,
                        const CellArrays<dim> &cells,
                        const unsigned int first,
                        const unsigned int n_values,
                        std::vector<double> &values);

    StateFile &file;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
  };

  /** Save or read what came out of a run so far. */
  void exchange(StateFile &file,
                const std::string &group,
                std::vector<StageReport> &reports);
  void exchange(StateFile &file,
                const std::string &group,
                std::vector<SafetyFactor> &factors);
  void exchange(StateFile &file, const std::string &group, History &history);

  /** What all rank groups found in a stage, by block; @p mine: what this one
   * did (collective over @p all ranks of all rank groups). */
  std::vector<SafetyFactor>
  gather_from_rank_groups(const Communicator &all,
                          const std::vector<SafetyFactor> &mine);

  /** A number that changes with the vertices, cells and pairs of a mesh, as
   * text. */
  template <int dim>
  std::string signature(const SplitMesh<dim> &split);

  /**
   * The first entry, like `Joints/base/Dip`, in which two scenes differ
   * (Scene::used_entries), and its values in both; entries that begin with one
   * of @p changeable do not count, unless they are in @p fixed. Empty: none.
   */
  std::array<std::string, 3>
  find_difference(const std::string &saved,
                  const std::string &present,
                  const std::vector<std::string> &changeable,
                  const std::vector<std::string> &fixed);
} // namespace Keyblock

#endif

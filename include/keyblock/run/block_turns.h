// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_block_turns_h
#define keyblock_run_block_turns_h

#include <keyblock/run/model.h>
#include <keyblock/run/run_record.h>

namespace Keyblock
{
  /** Rotation of a block since the start of the run. */
  struct BlockTurn
  {
    double angle = 0.; ///< about whatever axis [rad]

    /** By how much it shifts the block's weight on its base, over half the
     * base: angle times height over width, the angle itself of flat ones [-].
     * Small kinematics leave that out. */
    double arm_error = 0.;
  };

  /** Error of the arm of a block's weight from which on a stage warns [-]. */
  constexpr double notable_arm_error = 0.02;

  /** How far finite blocks turn where small kinematics take no notice of it. */
  template <int dim>
  class BlockTurns
  {
  public:
    explicit BlockTurns(const Model<dim> &model);

    /** Keep the largest of each block in the stage, by its arm's error
     * (collective). Nothing in large kinematics. */
    void note(StageProgress<dim> &progress) const;

  private:
    const Model<dim> &model;
    Tensor<1, dim> up;
    /** Of finite blocks, those that this rank owns. */
    std::vector<std::vector<unsigned int>> nodes_of_block;
  };

  /** The block, of those that are there, that has the largest in the stage, and
   * what to beware of if that is notable. */
  template <int dim>
  void report_turns(const Model<dim> &model,
                    const StageProgress<dim> &progress,
                    StageReport &report);
} // namespace Keyblock

#endif

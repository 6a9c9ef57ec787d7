// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_trial_failure_h
#define keyblock_safety_trial_failure_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/contact/report.h>
#include <keyblock/rock/fields.h>
#include <keyblock/safety/block_mode.h>
#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /** How a block and others moved in the last trial that failed, from what its
   * second phase showed. Blocks are given by index. */
  template <int dim>
  class TrialFailure
  {
  public:
    TrialFailure(const Scene<dim> &scene,
                 const Blocks<dim> &blocks,
                 const std::vector<std::vector<unsigned int>> &nodes_of_block,
                 const Fields<dim> &fields,
                 const Communicator &communicator);

    /** Nothing has failed yet. */
    void forget();

    /** The second phase of a trial begins, with a mean slip of @p slip [m] on
     * the contacts of the block that is tried. */
    void begin(const Vector<dim> &slip);

    /** Add forces on the joints of the block that is tried, at the end of a
     * window of that phase. */
    void add(const std::vector<JointSums<dim>> &joints);

    /** The phase showed that @p block fails, with such a slip by its end
     * (collective). */
    void note(const unsigned int block, const Vector<dim> &slip);

    /** Falling, sliding or rotating, and on what, or yielding where the
     * strength of rock is reduced, too; without a motion nothing has failed. */
    const BlockMode &
    mode() const
    {
      return last_mode;
    }

    /** Mean way of the block that failed; zero: none has [m]. */
    const Vector<dim> &
    way() const
    {
      return last_way;
    }

    /** Other finite blocks that moved along: by at least half of its way in
     * its direction. */
    const std::vector<unsigned int> &
    blocks_along() const
    {
      return along;
    }

    /** Those that moved at all: by at least a tenth of its way, wherever to. */
    const std::vector<unsigned int> &
    blocks_moving() const
    {
      return moving;
    }

  private:
    BlockMode find_mode(const unsigned int block,
                        const Vector<dim> &slip) const;
    void list_blocks_that_moved(const unsigned int block);

    const Scene<dim> &scene;
    const Blocks<dim> &blocks;
    const std::vector<std::vector<unsigned int>> &nodes_of_block;
    const Fields<dim> &fields;
    const Communicator communicator;
    std::vector<double> displacement_before; ///< of the second phase [m]
    Vector<dim> slip_before{};       ///< mean, on contacts, of that phase [m]
    std::vector<double> joint_force; ///< at its windows' ends, added up [N]
    BlockMode last_mode;
    Vector<dim> last_way{}; ///< [m]
    std::vector<unsigned int> along, moving;
  };
} // namespace Keyblock

#endif

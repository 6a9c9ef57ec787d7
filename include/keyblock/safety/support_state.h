// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_support_state_h
#define keyblock_safety_support_state_h

#include <keyblock/base/communicator.h>
#include <keyblock/base/vector.h>
#include <keyblock/step/force_element.h>

namespace Keyblock
{
  /** What bolts, liners and other elements do to blocks, and where these are,
   * by index of the block. */
  template <int dim>
  struct SupportState
  {
    /** Of each block 2 dim + 1 numbers, as checkpoints keep them; empty: there
     * are no elements. */
    std::vector<double> numbers;

    unsigned int
    n_blocks() const
    {
      return numbers.size() / n_numbers;
    }

    /** Resultant against their loads [N]. */
    Vector<dim>
    force(const unsigned int block) const
    {
      return vector_at(n_numbers * block);
    }

    /** Of their masses, mean [m]. */
    Vector<dim>
    displacement(const unsigned int block) const
    {
      return vector_at(n_numbers * block + dim);
    }

    /** In use [kg]; 0: it was not looked at. */
    double
    mass(const unsigned int block) const
    {
      return numbers[n_numbers * block + 2 * dim];
    }

    static constexpr unsigned int n_numbers = 2 * dim + 1;

  private:
    Vector<dim>
    vector_at(const unsigned int first) const
    {
      Vector<dim> vector;
      std::copy_n(numbers.begin() + first, dim, vector.begin());
      return vector;
    }
  };

  /** That of now for the blocks that @p is_wanted marks (collective).
   * @param nodes_of_block those that this rank owns */
  template <int dim>
  SupportState<dim>
  measure_support(const ForceElements<dim> &elements,
                  const Fields<dim> &fields,
                  const std::vector<std::vector<unsigned int>> &nodes_of_block,
                  const std::vector<bool> &is_wanted,
                  const Communicator &communicator);

  /** How a block has moved between two states, and what elements have taken up
   * on that way. */
  template <int dim>
  struct TakeUp
  {
    TakeUp(const SupportState<dim> &from,
           const SupportState<dim> &to,
           const unsigned int block)
      : way(add<dim>(to.displacement(block), -1., from.displacement(block)))
      , energy(dot<dim>(add<dim>(to.force(block), -1., from.force(block)), way))
    {}

    /** Whether elements that answer so would bear @p load [N] when a block that
     * has gone @p gone [m] on that way has gone @p length [m]. Then they are
     * still being mobilised, however long that takes: on soft support a block
     * swings much slower than waves cross it. */
    bool
    bears(const double load, const double length, const double gone) const
    {
      return energy > load / length * gone * gone;
    }

    /** Whether what they have taken up on @p gone [m] is a notable share of the
     * work of @p force [N], what is out of balance: also softer support, as of
     * grout that slips bit by bit, may then balance it. */
    bool
    is_notable(const double force, const double gone) const
    {
      constexpr double least_share = 1e-4;
      return energy > least_share * force * gone;
    }

    Vector<dim> way; ///< [m]
    double energy;   ///< change of the force times way [J]
  };

  /** Way over the size of a block within which support may still catch it, and
   * from which on it has left its place [-]. */
  constexpr double far_off = 0.05;

  /** Blocks whose elements answer their way so that they would bear their loads
   * [N] on far_off of their sizes [m], and what has moved along with these:
   * neither falls as yet. None of empty states. */
  template <int dim>
  std::vector<bool> mark_caught_blocks(const SupportState<dim> &from,
                                       const SupportState<dim> &to,
                                       const std::vector<double> &loads,
                                       const std::vector<double> &sizes);
} // namespace Keyblock

#endif

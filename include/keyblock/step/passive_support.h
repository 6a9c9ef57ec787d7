// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_passive_support_h
#define keyblock_step_passive_support_h

#include <keyblock/contact/state.h>
#include <keyblock/scene/scene.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /**
   * What a trial of strength reduction takes from support in the passive
   * convention: of a force between two blocks the part against the way that
   * one of them would take without support is resistance, and divided like the
   * strength of the joint between them (Hoek and Bray 1981). The rest of it,
   * and what drives a block, is a load.
   */
  template <int dim>
  class PassiveSupport
  {
  public:
    /** Nothing is taken in another @p convention. */
    explicit PassiveSupport(const BoltConvention convention)
      : is_passive(convention == BoltConvention::passive)
    {}

    void
    reduce_strength(const StrengthReduction &new_reduction)
    {
      if (is_passive)
        reduction = new_reduction;
    }

    /** As ForceElement::take_ways(). */
    void
    take_ways(const std::vector<Tensor<1, dim>> &new_ways)
    {
      ways = new_ways;
    }

    /** Whether nothing is taken. */
    bool
    is_whole() const
    {
      return reduction.share == 1.;
    }

    /** How many times larger than by itself a force may become [-]. */
    double
    largest_share() const
    {
      return std::max(1., reduction.share);
    }

    /** Part of @p force, of a support that crosses @p joint from the first to
     * the second of two @p blocks (`none`: no block), on the first one, that is
     * not there in a trial. Where the way of no block is known it is taken
     * from the part across @p normal (unit vector; zero: all of it) [N]. */
    Tensor<1, dim> taken(const Tensor<1, dim> &force,
                         const std::array<unsigned int, 2> &blocks,
                         const unsigned int joint,
                         const Tensor<1, dim> &normal) const;

  private:
    const bool is_passive;
    StrengthReduction reduction;
    std::vector<Tensor<1, dim>> ways; ///< unit vectors or zero, by block
  };
} // namespace Keyblock

#endif

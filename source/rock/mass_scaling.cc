// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/mass_scaling.h>

namespace Keyblock
{
  namespace
  {
    /** Halvings of an interval: to the last digit. */
    constexpr unsigned int n_halvings = 60;

    /** The cells of this rank and the blocks they belong to. */
    class BlockMasses
    {
    public:
      BlockMasses(const Communicator &communicator,
                  const std::vector<double> &frequency,
                  const std::vector<double> &mass,
                  const std::vector<unsigned int> &block,
                  const unsigned int n_blocks)
        : communicator(communicator)
        , frequency(frequency)
        , mass(mass)
        , block(block)
        , total(sum(std::vector<bool>(n_blocks, true),
                    [](const double, const unsigned int) { return 1.; }))
      {}

      /** Sums of mass times @p share(omega^2, block) over the cells of blocks
       * that are @p wanted, on all ranks; 0 for the others. */
      template <typename Share>
      std::vector<double>
      sum(const std::vector<bool> &wanted, const Share &share) const
      {
        std::vector<double> sums(wanted.size(), 0.);
        for (unsigned int c = 0; c < block.size(); ++c)
          if (wanted[block[c]])
            sums[block[c]] +=
              mass[c] * share(frequency[c] * frequency[c], block[c]);
        communicator.sum_lists(sums);
        return sums;
      }

      /** Highest omega^2 of each block's cells. */
      std::vector<double>
      stiffest() const
      {
        std::vector<double> squares(total.size(), 0.);
        for (unsigned int c = 0; c < block.size(); ++c)
          squares[block[c]] =
            std::max(squares[block[c]], frequency[c] * frequency[c]);
        communicator.max_lists(squares);
        return squares;
      }

      /** Cells by block whose omega^2 is above the block's @p square. */
      std::vector<unsigned int>
      count_above(const std::vector<double> &square) const
      {
        std::vector<unsigned int> n(total.size(), 0);
        for (unsigned int c = 0; c < block.size(); ++c)
          n[block[c]] += frequency[c] * frequency[c] > square[block[c]];
        communicator.sum_lists(n);
        return n;
      }

      /** By block, whether the mass with densities times max(floor, omega^2) /
       * square is the true one or more. */
      std::vector<bool>
      is_heavy(const std::vector<bool> &wanted,
               const std::vector<double> &floor,
               const std::vector<double> &square) const
      {
        const std::vector<double> masses =
          sum(wanted, [&](const double omega2, const unsigned int b) {
            return std::max(floor[b], omega2) / square[b];
          });
        std::vector<bool> result(total.size());
        for (unsigned int b = 0; b < total.size(); ++b)
          result[b] = masses[b] >= total[b];
        return result;
      }

    private:
      const Communicator communicator;
      const std::vector<double> &frequency, &mass;
      const std::vector<unsigned int> &block;

    public:
      const std::vector<double> total; ///< true mass by block [kg]
    };

    /** By block a number between @p low and @p high, below which
     * is_above(numbers) is false and above which it is true. */
    template <typename IsAbove>
    std::vector<double>
    bisect(std::vector<double> low,
           std::vector<double> high,
           const IsAbove &is_above)
    {
      std::vector<double> middle(low.size());
      for (unsigned int i = 0; i < n_halvings; ++i)
        {
          for (unsigned int b = 0; b < low.size(); ++b)
            middle[b] = 0.5 * (low[b] + high[b]);
          const std::vector<bool> is_high = is_above(middle);
          for (unsigned int b = 0; b < low.size(); ++b)
            (is_high[b] ? high[b] : low[b]) = middle[b];
        }
      return high;
    }

    std::vector<double>
    times(const double factor, std::vector<double> list)
    {
      for (double &value : list)
        value *= factor;
      return list;
    }

    /** Of each wanted block the @p square asked for or, where cells that give
     * all they may would leave the block too heavy, the least that works. */
    std::vector<double>
    affordable_squares(const BlockMasses &blocks,
                       const std::vector<bool> &wanted,
                       std::vector<double> square,
                       const std::vector<double> &stiffest,
                       const double largest)
    {
      const auto is_light = [&](const std::vector<double> &squares) {
        std::vector<bool> result =
          blocks.is_heavy(wanted, times(1. - largest, squares), squares);
        result.flip();
        return result;
      };
      const std::vector<bool> is_affordable = is_light(square);
      const std::vector<double> least = bisect(square, stiffest, is_light);
      for (unsigned int b = 0; b < square.size(); ++b)
        if (wanted[b] && !is_affordable[b])
          square[b] = least[b];
      return square;
    }
  } // namespace



  std::vector<MassScaling>
  scale_masses(const Communicator &communicator,
               const std::vector<double> &frequency,
               const std::vector<double> &mass,
               const std::vector<unsigned int> &block,
               const unsigned int n_blocks,
               const double highest,
               const double largest)
  {
    const BlockMasses blocks(communicator, frequency, mass, block, n_blocks);
    const std::vector<double> stiffest = blocks.stiffest();
    std::vector<double> square(n_blocks, highest * highest);
    std::vector<MassScaling> result(n_blocks);
    std::vector<bool> wanted(n_blocks);
    for (unsigned int b = 0; b < n_blocks; ++b)
      {
        result[b].mass = blocks.total[b];
        wanted[b]      = stiffest[b] > square[b];
      }
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end())
      return result;

    square = affordable_squares(blocks, wanted, square, stiffest, largest);
    // what the other cells give: the mass of the block stays
    const std::vector<double> floor =
      bisect(times(1. - largest, square),
             square,
             [&](const std::vector<double> &floors) {
               return blocks.is_heavy(wanted, floors, square);
             });
    const std::vector<double> added =
      blocks.sum(wanted, [&](const double omega2, const unsigned int b) {
        return std::max(0., omega2 / square[b] - 1.);
      });
    const std::vector<unsigned int> n_stiff = blocks.count_above(square);
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (wanted[b])
        result[b] = {square[b],
                     floor[b],
                     added[b],
                     blocks.total[b],
                     n_stiff[b],
                     square[b] > highest * highest};
    return result;
  }
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/symmetric_tensor.h>

#include <keyblock/base/number_text.h>
#include <keyblock/run/block_turns.h>
#include <keyblock/scene/gravity.h>

namespace Keyblock
{
  namespace
  {
    /** Sums over the masses of a block: m, m X, m u, m X X^T, m X u^T with the
     * places X in the reference and displacements u. */
    template <int dim>
    struct TurnSums
    {
      static constexpr unsigned int n = 1 + 2 * dim + 2 * dim * dim;

      /** @param sum n of them */
      explicit TurnSums(const double *const sum)
      {
        const double mass = sum[0];
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              const unsigned int at = 1 + 2 * dim + dim * i + j;
              places[i][j] = (sum[at] - sum[1 + i] * sum[1 + j] / mass) / mass;
              moves[i][j] =
                (sum[at + dim * dim] - sum[1 + i] * sum[1 + dim + j] / mass) /
                mass;
            }
      }

      static void
      add(const double m,
          const Tensor<1, dim> &X,
          const double *const u,
          double *const sum)
      {
        sum[0] += m;
        for (unsigned int i = 0; i < dim; ++i)
          {
            sum[1 + i] += m * X[i];
            sum[1 + dim + i] += m * u[i];
            for (unsigned int j = 0; j < dim; ++j)
              {
                const unsigned int at = 1 + 2 * dim + dim * i + j;
                sum[at] += m * X[i] * X[j];
                sum[at + dim * dim] += m * X[i] * u[j];
              }
          }
      }

      /** About the mean, over the mass [m^2]. */
      Tensor<2, dim> places, moves;
    };

    /** Height over width, with the axis @p across beside the one upwards. */
    template <int dim>
    double
    slenderness(const Tensor<2, dim> &places,
                const Tensor<1, dim> &up,
                const Tensor<1, dim> &across)
    {
      const double width = across * places * across;
      return width > 0. ? std::sqrt((up * places * up) / width) : 0.;
    }

    /** The turn that fits best. */
    BlockTurn
    fit_turn(const TurnSums<2> &sums, const Tensor<1, 2> &up)
    {
      const double inertia = trace(sums.places);
      BlockTurn turn;
      if (!(inertia > 0.))
        return turn;
      turn.angle = std::abs(sums.moves[0][1] - sums.moves[1][0]) / inertia;
      turn.arm_error =
        turn.angle * std::max(1.,
                              slenderness<2>(sums.places,
                                             up,
                                             Tensor<1, 2>({-up[1], up[0]})));
      return turn;
    }

    BlockTurn
    fit_turn(const TurnSums<3> &sums, const Tensor<1, 3> &up)
    {
      Tensor<2, 3> inertia = -1. * sums.places;
      Tensor<1, 3> momentum;
      for (unsigned int i = 0; i < 3; ++i)
        {
          inertia[i][i] += trace(sums.places);
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          momentum[i] = sums.moves[j][k] - sums.moves[k][j];
        }
      BlockTurn turn;
      if (!(determinant(inertia) > 0.))
        return turn;
      const Tensor<1, 3> rotation = invert(inertia) * momentum;
      turn.angle                  = rotation.norm();
      turn.arm_error              = turn.angle;
      // that about the vertical moves no weight
      const Tensor<1, 3> tilt = rotation - (rotation * up) * up;
      if (tilt.norm() > 0.)
        turn.arm_error =
          std::max(turn.angle,
                   tilt.norm() *
                     slenderness<3>(sums.places,
                                    up,
                                    cross_product_3d(up, tilt) / tilt.norm()));
      return turn;
    }
  } // namespace



  template <int dim>
  BlockTurns<dim>::BlockTurns(const Model<dim> &model)
    : model(model)
    , up(upward(model.scene))
  {
    if (model.scene.time_stepping.is_large())
      return;
    nodes_of_block = owned_nodes_of_blocks(model.split,
                                           *model.numbering,
                                           model.blocks.blocks.size());
    for (unsigned int b = 0; b < nodes_of_block.size(); ++b)
      if (model.blocks.blocks[b].is_infinite)
        std::vector<unsigned int>().swap(nodes_of_block[b]);
  }



  template <int dim>
  void
  BlockTurns<dim>::note(StageProgress<dim> &progress) const
  {
    const unsigned int n_blocks = nodes_of_block.size();
    if (n_blocks == 0)
      return;
    progress.turns.resize(2 * n_blocks, 0.);
    constexpr unsigned int n  = TurnSums<dim>::n;
    const Fields<dim> &fields = model.fields;
    std::vector<double> sums(n * n_blocks, 0.);
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (const unsigned int node : nodes_of_block[b])
        {
          Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = fields.reference[dim * node + d];
          TurnSums<dim>::add(fields.weighing_mass[node],
                             place - model.blocks.blocks[b].centroid,
                             &fields.displacement[dim * node],
                             &sums[n * b]);
        }
    model.communicator.sum_lists(sums);
    for (unsigned int b = 0; b < n_blocks; ++b)
      {
        if (!(sums[n * b] > 0.))
          continue;
        const BlockTurn turn = fit_turn(TurnSums<dim>(&sums[n * b]), up);
        if (turn.arm_error > progress.turns[2 * b + 1])
          {
            progress.turns[2 * b]     = turn.angle;
            progress.turns[2 * b + 1] = turn.arm_error;
          }
      }
  }



  template <int dim>
  void
  report_turns(const Model<dim> &model,
               const StageProgress<dim> &progress,
               StageReport &report)
  {
    unsigned int n_notable = 0;
    for (unsigned int b = 0; 2 * b < progress.turns.size(); ++b)
      {
        if (model.conditions->active_cells.is_removed_block(b))
          continue;
        const double arm_error = progress.turns[2 * b + 1];
        n_notable += arm_error > notable_arm_error;
        if (arm_error > report.arm_error)
          {
            report.turned_block = model.blocks.blocks[b].id;
            report.turned_by    = progress.turns[2 * b];
            report.arm_error    = arm_error;
          }
      }
    if (n_notable == 0)
      return;
    report.warning +=
      (report.warning.empty() ? "" : " ") + std::string("Block ") +
      std::to_string(report.turned_block) + " turned by " +
      text_of(report.turned_by, 2) + " rad" +
      (n_notable > 1 ? ", " + std::to_string(n_notable - 1) + " more by less"
                     : "") +
      ": its weight acts " + text_of(100. * report.arm_error, 2) +
      " % of half its width from where small kinematics leave it, so that it "
      "may stand or come back where it topples; set 'Time stepping/Kinematics "
      "= large'.";
  }

  template class BlockTurns<2>;
  template class BlockTurns<3>;
  template void
  report_turns(const Model<2> &, const StageProgress<2> &, StageReport &);
  template void
  report_turns(const Model<3> &, const StageProgress<3> &, StageReport &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
// Limit equilibrium for people.
#include <keyblock/safety/block_cascade.h>

#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    std::string
    components(const Tensor<1, dim> &force)
    {
      std::ostringstream out;
      out << std::setprecision(5) << '(';
      for (unsigned int d = 0; d < dim; ++d)
        out << (d ? ", " : "")
            << (std::abs(force[d]) < 1e-12 * force.norm() ? 0.
                                                          : 1e-3 * force[d]);
      out << ')';
      return out.str();
    }

    /** Whether two answers are the same but for rounding. */
    template <int dim>
    bool
    agree(const BlockStatics<dim> &a, const BlockStatics<dim> &b)
    {
      return a.mode() == b.mode() && a.forces() == b.forces() &&
             a.remark() == b.remark() &&
             (a.limit.factor == b.limit.factor ||
              std::abs(a.limit.factor - b.limit.factor) <
                1e-9 * a.limit.factor);
    }

    template <int dim>
    void
    print_row(std::ostream &out,
              const unsigned int id,
              const std::string &stage,
              const BlockStatics<dim> &statics)
    {
      out << std::setw(4) << id << "  " << std::left << std::setw(11) << stage
          << std::right << "  " << std::setw(9);
      if (std::isfinite(statics.limit.factor))
        out << std::setprecision(6) << statics.limit.factor;
      else
        out << '-';
      out << "  " << statics.mode() << ": " << statics.forces();
      const std::string remark = statics.remark();
      out << (remark.empty() ? "" : "; ") << remark << '\n';
    }
  } // namespace



  template <int dim>
  std::string
  BlockStatics<dim>::remark() const
  {
    std::string text;
    for (const std::string &one : remarks)
      text += (text.empty() ? "" : "; ") + one;
    return text;
  }



  template <int dim>
  std::string
  BlockStatics<dim>::forces() const
  {
    const BlockLoads<dim> &loads = around.loads;
    std::ostringstream out;
    out << std::setprecision(6) << "weight " << 1e-3 * loads.weight.norm();
    if (!loads.tractions.empty())
      out << ", tractions " << components(sum_of(loads.tractions));
    if (!loads.water.empty())
      out << ", water " << components(sum_of(loads.water));
    if (loads.seismic.norm() > 0.)
      out << ", seismic " << components(loads.seismic);
    if (limit.direction.norm() > 0.)
      out << ", driving " << 1e-3 * limit.driving_force;
    for (unsigned int i = 0; i < limit.n_pressed; ++i)
      out << ", N " << 1e-3 * limit.normal_forces[i] << " on "
          << around.faces[limit.faces[i]].name;
    for (const unsigned int i : limit.faces)
      if (around.faces[i].cohesion > 0.)
        out << ", cA " << 1e-3 * around.faces[i].cohesion * around.faces[i].area
            << " on " << around.faces[i].name;
    return out.str();
  }



  template <int dim>
  void
  print_block_statics(std::ostream &out,
                      const Scene<dim> &scene,
                      const SplitMesh<dim> &split,
                      const Blocks<dim> &blocks)
  {
    std::vector<std::unique_ptr<BlockStatics<dim>>> last(blocks.blocks.size());
    std::ostringstream rows;
    for_each_changed_ground<dim>(
      scene, split, [&](const Ground<dim> &ground, const FreeFaces<dim> &free) {
        auto judged =
          judge_leaning_blocks(ground, free, blocks, 0., scene.safety.wanted);
        for (JudgedBlock<dim> &one : judged)
          {
            auto &before = last[one.block];
            if (!before || !agree(*before, one.statics))
              print_row(rows,
                        blocks.blocks[one.block].id,
                        ground.stage_number == 1
                          ? "the start"
                          : scene.stages[ground.stage_number - 2]->name,
                        one.statics);
            before =
              std::make_unique<BlockStatics<dim>>(std::move(one.statics));
          }
      });
    if (rows.str().empty())
      return;
    out << "Limit equilibrium of rigid blocks between fixed neighbours, "
        << (has_initial_stress(scene) ? "without the in-situ stress, " : "")
        << "in kN" << (dim == 2 ? "/m" : "")
        << "; rotation is judged on one plane"
        << (dim == 2 ? "" : ", as an indication,")
        << " and by the moments that faces can balance"
        << "\n  id  after           factor  mode and forces\n"
        << rows.str();
  }

  template struct BlockStatics<2>;
  template struct BlockStatics<3>;
  template void print_block_statics(std::ostream &,
                                    const Scene<2> &,
                                    const SplitMesh<2> &,
                                    const Blocks<2> &);
  template void print_block_statics(std::ostream &,
                                    const Scene<3> &,
                                    const SplitMesh<3> &,
                                    const Blocks<3> &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_bolts_h
#define keyblock_step_bolts_h

#include <keyblock/step/bolt_in_rock.h>
#include <keyblock/step/bolt_points.h>
#include <keyblock/step/force_element.h>

namespace Keyblock
{
  /**
   * All bolts and cables. Forces act along each as it was installed.
   *
   * Every rank follows all of them, from displacements that all ranks add up,
   * and puts forces on its own nodes.
   */
  template <int dim>
  class Bolts : public ForceElement<dim>
  {
  public:
    Bolts(const Scene<dim> &scene,
          const SplitMesh<dim> &split,
          const Numbering<dim> &numbering);

    std::string
    name() const override
    {
      return "bolts";
    }
    void take_ground(const Ground<dim> &ground) override;
    std::vector<unsigned int> nodes() const override;
    void add_force(const std::vector<double> &displacement,
                   std::vector<double> &force) override;
    StepBound
    step_bound(const std::vector<double> &inverse_mass) const override;
    bool has_product() const override;

    /** Of the springs that are elastic now, nodes without mass in equilibrium.
     */
    void add_product(const std::vector<double> &displacement,
                     std::vector<double> &force) override;
    double
    stored_energy(const std::vector<double> &displacement) const override;
    double plastic_work() const override;
    ForceElementState remember() const override;
    void recall(const ForceElementState &state) override;

    /** In the passive convention divide what bolts hold (PassiveSupport). */
    void
    reduce_strength(const StrengthReduction &reduction) override
    {
      trial.reduce_strength(reduction);
    }
    void
    take_ways(const std::vector<Tensor<1, dim>> &ways) override
    {
      trial.take_ways(ways);
    }

    /** Those that are installed (the same on every rank). */
    std::vector<BoltReport<dim>> report() const;

    /** Of all bolts of the mesh (the same on every rank). */
    BrokenSegments broken_segments() const;

  private:
    /** Call @p action with those of the present stage. */
    template <typename List, typename Action>
    void
    for_each_present(List &list, const Action &action) const
    {
      for (auto &bolt : list)
        if (bolt.stage_number() <= stage_number)
          action(bolt);
    }

    /** Set motion to a displacement of the rock (collective). */
    void gather(const std::vector<double> &displacement);

    /** Call @p action(bolt, along, jump) with the present ones and their parts
     * of motion. */
    template <typename Action>
    void for_each_motion(const Action &action);

    const Numbering<dim> &numbering;
    std::vector<BoltInRock<dim>> bolts;
    BoltPoints<dim> points; ///< of the present ones

    /** Of the present ones, bolt by bolt: the rock's displacement at the nodes
     * along them, then the forces there, and the jumps at dowels, in one list
     * for one sum over the ranks [m, N]. */
    std::vector<double> motion;
    unsigned int stage_number = 1;
    PassiveSupport<dim> trial;
  };
} // namespace Keyblock

#endif

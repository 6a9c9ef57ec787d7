// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_bolts_h
#define keyblock_step_bolts_h

#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/rock/bolt_chain.h>
#include <keyblock/step/force_element.h>

namespace Keyblock
{
  /** What a bolt does now, for output. */
  template <int dim>
  struct BoltReport
  {
    const Bolt<dim> *bolt = nullptr;
    std::vector<double> axial_force; ///< of its segments, tension positive [N]
    std::vector<double> slip;        ///< of the grout at its nodes [m]
    std::vector<Tensor<1, dim>> displacement; ///< of the rock there [m]
    double plate_force       = 0.;            ///< [N]
    double dowel_force       = 0.; ///< largest at a joint that it crosses [N]
    bool is_broken           = false;
    unsigned int n_crossings = 0; ///< of joints, between blocks
    std::string limit;            ///< what would govern it: see describe()
  };

  /**
   * Bolts and cables: chains without mass (rock/bolt_chain.h) whose nodes go
   * with the cells they lie in, and dowels where they cross joints. Forces act
   * along the bolt as it was installed.
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
    ~Bolts() override;

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
    double
    stored_energy(const std::vector<double> &displacement) const override;
    double plastic_work() const override;
    ForceElementState remember() const override;
    void recall(const ForceElementState &state) override;

    /** In the passive convention divide the part of the bolts' forces along
     * the joints that are meant, as the joints' strength. */
    void reduce_strength(const StrengthReduction &reduction) override;

    /** Those that are installed (the same on every rank). */
    std::vector<BoltReport<dim>> report() const;

  private:
    /** A point of the rock and the nodes of this rank that carry it. */
    struct Binding
    {
      bool is_held = false;                                  ///< there is rock
      std::vector<std::pair<unsigned int, double>> carriers; ///< node, weight
    };
    struct Dowel;
    struct Member;

    Binding bind(const CellLocator<dim> &rock, const Point<dim> &point) const;
    /** Displacements of all points that bolts are bound to, the same on every
     * rank (collective) [m]. */
    std::vector<Tensor<1, dim>>
    rock_displacements(const std::vector<double> &displacement) const;

    template <typename Action>
    void for_each_binding(const Action &action) const;

    void put_force(const Binding &binding,
                   const Tensor<1, dim> &force,
                   std::vector<double> &forces) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const std::vector<Bolt<dim>> &bolts;
    std::vector<Member> members; ///< one for each of bolts
    unsigned int stage_number = 1;
    std::vector<Tensor<1, dim>> present; ///< displacements at all bindings

    StrengthReduction reduction;
  };

  /** What bolts are made of, as the scene says. */
  template <int dim>
  BoltProperties properties_of(const BoltSet<dim> &set);

  /** What limits a bolt, in words. */
  std::string describe(const BoltChain::Capacity::Limit limit);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_far_field_springs_h
#define keyblock_step_far_field_springs_h

#include <keyblock/rock/far_field.h>
#include <keyblock/step/force_element.h>

namespace Keyblock
{
  /**
   * The rock around the model, in place of the supports of kind far field: they
   * hold the boundary until the initial state is in balance, then its springs
   * (rock/far_field.h) take over, and what it carried stays as a dead load; so
   * does what the springs carry when a stage changes the rock beside them.
   */
  template <int dim>
  class FarFieldSprings : public ForceElement<dim>
  {
  public:
    FarFieldSprings(const Scene<dim> &scene,
                    const SplitMesh<dim> &split,
                    const Numbering<dim> &numbering,
                    const Fields<dim> &fields);

    /** Whether a support of @p scene is one. */
    static bool is_wanted(const Scene<dim> &scene);

    /** Whether the springs have taken over. */
    bool
    is_acting() const
    {
      return acts;
    }

    /** Whether they are coupled (FarField::is_coupled()). */
    bool
    is_coupled() const
    {
      return far_field.is_coupled();
    }

    /** Take over from the supports, which carry @p reaction now (owned degrees
     * of freedom, on the rock) [N]. */
    void release(const std::vector<double> &reaction);

    std::string
    name() const override
    {
      return "far_field";
    }
    void take_ground(const Ground<dim> &ground) override;
    std::vector<unsigned int> nodes() const override;
    void add_force(const std::vector<double> &displacement,
                   std::vector<double> &force) override;
    void add_load(const double time, std::vector<double> &load) const override;
    StepBound
    step_bound(const std::vector<double> &inverse_mass) const override;
    double
    stored_energy(const std::vector<double> &displacement) const override;
    void for_each_stiffness(
      const typename ForceElement<dim>::AddStiffness &add) const override;
    CoupledStiffness coupled_stiffness() const override;
    ForceElementState remember() const override;
    void recall(const ForceElementState &state) override;

  private:
    void set_up();

    /** Boundary of a support, material of the rock beside it at the present
     * stage. */
    struct Side
    {
      const Support<dim> *support;
      CellFace face;
      unsigned int material;
    };
    std::vector<Side> list_sides(const unsigned int stage) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const Fields<dim> &fields;

    FarField<dim> far_field; ///< empty until it acts
    bool acts          = false;
    unsigned int stage = 1; ///< whose rock the springs are of
    /** Stored by springs that others took the place of, less what those
     * stored then (the same on every rank) [J]. */
    double energy_before = 0.;
    std::vector<double> dead_load; ///< by owned degree of freedom [N]
  };
} // namespace Keyblock

#endif

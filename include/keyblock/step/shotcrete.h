// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_shotcrete_h
#define keyblock_step_shotcrete_h

#include <keyblock/step/body_acceleration.h>
#include <keyblock/step/force_element.h>
#include <keyblock/step/passive_support.h>

namespace Keyblock
{
  /** What the shotcrete of one liner bears. */
  struct LinerReport
  {
    unsigned int liner;       ///< index into Scene::liners
    double area         = 0.; ///< sprayed and not dug again [m2]
    double trace_length = 0.; ///< of joints under it [m]
    double strength     = 0.; ///< of its sections along them [N]
    double largest_load = 0.; ///< of a section, over its strength [-]
    double sheared      = 0.; ///< length that has reached its strength [m]
  };

  /**
   * Shotcrete along the traces of joints: a block that moves out of the face
   * shears its section. A piece of length L joins the two sides of the joint by
   * a spring of stiffness G L (a band as wide as it is thick) against shear in
   * the section, out of the face and along the trace, that yields at strength
   * times thickness times L; it is free of force when it is sprayed. Its weight
   * and the stage's seismic force act on the nodes of the face. Tension across
   * the section, bending and arching are left out.
   *
   * Every rank follows all traces, from displacements that all ranks add up,
   * and puts forces on its own nodes.
   */
  template <int dim>
  class Shotcrete : public ForceElement<dim>
  {
  public:
    Shotcrete(const Scene<dim> &scene,
              const SplitMesh<dim> &split,
              const Numbering<dim> &numbering);

    std::string
    name() const override
    {
      return "shotcrete";
    }
    void take_ground(const Ground<dim> &ground) override;
    std::vector<unsigned int> nodes() const override;
    void add_force(const std::vector<double> &displacement,
                   std::vector<double> &force) override;
    void add_load(const double time, std::vector<double> &load) const override;

    /** Of liners that are not structural; these have their own. */
    void add_mass(const typename ForceElement<dim>::Inertia &inertia,
                  std::vector<double> &mass) override;
    StepBound
    step_bound(const std::vector<double> &inverse_mass) const override;
    double
    stored_energy(const std::vector<double> &displacement) const override;
    double plastic_work() const override;
    ForceElementState remember() const override;
    void recall(const ForceElementState &state) override;

    /** In the passive convention divide what sections hold (PassiveSupport). */
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

    /** By liner that is there (the same on every rank). */
    std::vector<LinerReport> report() const;

  private:
    /** A trace and what has happened to it. */
    struct Section
    {
      unsigned int liner;
      LinerTrace<dim> trace;
      bool is_present   = false;
      bool is_installed = false; ///< rest and slip are of use
      Tensor<1, dim> rest;       ///< of the sides when it was sprayed [m]
      Tensor<1, dim> slip;       ///< plastic part of what came since [m]
      Tensor<1, dim> force;      ///< on the second side [N]
      double dissipated = 0.;    ///< [J]
    };

    /** Call @p action with each number of what has happened to a @p section, in
     * the order of checkpoints. */
    template <typename AnySection, typename Action>
    static void
    for_each_number(AnySection &section, const Action &action)
    {
      action(section.is_installed);
      action(section.dissipated);
      for (auto *value : {&section.rest, &section.slip, &section.force})
        for (unsigned int d = 0; d < dim; ++d)
          action((*value)[d]);
    }

    double stiffness_of(const Section &section) const;
    double strength_of(const Section &section) const; ///< not reduced [N]

    /** The second side's displacement against the first's, by section (the same
     * on every rank, collective) [m]. */
    std::vector<Tensor<1, dim>>
    openings(const std::vector<double> &displacement) const;

    /** Sums of the rows of the stiffness, by owned node [N/m]. */
    std::vector<double> row_sums() const;

    /** Move @p section to an opening. */
    void respond(const Tensor<1, dim> &opening, Section &section) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    std::vector<Section> sections;
    std::vector<double> weighed_mass; ///< by owned node [kg]
    std::vector<double> inert_mass;   ///< that of liners without their own
    std::vector<double> own_mass;     ///< in use, by owned node [kg]
    double frequency = 0.;            ///< highest of the cells [rad/s]
    std::vector<LinerReport> reports; ///< but for loads
    BodyAcceleration<dim> acceleration;
    PassiveSupport<dim> trial;
  };
} // namespace Keyblock

#endif

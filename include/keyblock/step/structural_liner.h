// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_structural_liner_h
#define keyblock_step_structural_liner_h

#include <keyblock/rock/liner_shell.h>
#include <keyblock/step/active_cells.h>
#include <keyblock/step/force_element.h>
#include <keyblock/step/section_check.h>

#include <map>

namespace Keyblock
{
  /** What a structural liner bears now. */
  template <int dim>
  struct LinerLoads
  {
    unsigned int liner; ///< index into Scene::liners
    std::vector<Point<dim>> points;
    std::vector<Tensor<1, dim>> displacement; ///< since installed, by point [m]

    // by face that is there
    std::vector<std::array<unsigned int, LinedFace<dim>::n>> faces;
    std::vector<double> areas; ///< [m2]
    std::vector<LinerForce<dim>> forces;
    std::vector<SectionCheck> checks;
  };

  /**
   * Liners that carry thrust and bend (rock/liner_shell.h), bonded to the faces
   * they are on and free of force when they are installed. A point of a liner
   * follows the mean of the nodes at its place, those on several sides of
   * joints by the areas of the faces they have under it, and its force goes to
   * them in the same parts.
   *
   * Every rank knows the displacements of all points, which all ranks add up,
   * and puts forces on its own nodes.
   */
  template <int dim>
  class StructuralLiners : public ForceElement<dim>
  {
  public:
    StructuralLiners(const Scene<dim> &scene,
                     const SplitMesh<dim> &split,
                     const Numbering<dim> &numbering,
                     const ActiveCells<dim> &active_cells);

    /** Whether a liner of @p scene is one. */
    static bool is_wanted(const Scene<dim> &scene);

    std::string
    name() const override
    {
      return "structural_liners";
    }
    void take_ground(const Ground<dim> &ground) override;
    std::vector<unsigned int> nodes() const override;
    void add_force(const std::vector<double> &displacement,
                   std::vector<double> &force) override;

    void add_mass(const typename ForceElement<dim>::Inertia &inertia,
                  std::vector<double> &mass) override;

    /** No more than takes the highest frequency of all to that of a node with
     * the cells around it: where the rock is softer than the stiffest cell the
     * step stays as it is. */
    StepBound
    step_bound(const std::vector<double> &inverse_mass) const override;
    double
    stored_energy(const std::vector<double> &displacement) const override;

    void for_each_stiffness(
      const typename ForceElement<dim>::AddStiffness &add) const override;

    /** Pieces across the bounds of ranks, none of which knows all their nodes.
     */
    CoupledStiffness coupled_stiffness() const override;
    ForceElementState remember() const override;
    void recall(const ForceElementState &state) override;

    /** By liner that is there (the same on every rank). */
    std::vector<LinerLoads<dim>> report() const;

  private:
    /** A vertex under a liner. */
    struct Anchor
    {
      unsigned int vertex;
      std::vector<std::pair<unsigned int, double>> carriers; ///< owned, weight
      unsigned int point = none;   ///< of the faces that are there
      double share       = 0.;     ///< of the point; 0: none is there
      Tensor<1, dim> rest;         ///< displacement when installed [m]
      Tensor<1, dim> displacement; ///< now [m]
    };

    /** One liner. */
    struct Lining
    {
      unsigned int liner;
      std::vector<Anchor> anchors;
      std::vector<bool> is_there; ///< by face
      bool is_present   = false;  ///< one of them is there
      bool is_installed = false;  ///< rest is of use
      LinerShell<dim> shell;      ///< of the faces that are there
      std::vector<Point<dim>> points;
      std::vector<std::vector<unsigned int>> anchors_of_point;
      std::vector<bool> is_mine; ///< point with an owned node

      /** Rank that hands a piece of the shell to static solutions; as many as
       * ranks: none knows all its nodes. */
      std::vector<unsigned int> rank_of_piece;
    };

    /** Call @p action with each number of what a @p lining remembers, in the
     * order of checkpoints. */
    template <typename AnyLining, typename Action>
    static void
    for_each_number(AnyLining &lining, const Action &action)
    {
      action(lining.is_installed);
      for (auto &anchor : lining.anchors)
        for (auto *value : {&anchor.rest, &anchor.displacement})
          for (unsigned int d = 0; d < dim; ++d)
            action((*value)[d]);
    }

    /** Call @p action(local node, weight) for the owned nodes that carry what
     * acts at @p anchor. */
    template <typename Action>
    static void
    for_each_owned(const Anchor &anchor, const Action &action)
    {
      for (const auto &[node, weight] : anchor.carriers)
        action(node, weight);
    }

    void build(Lining &lining) const;

    /** Sums of the rows of the stiffness, by vertex that carries (the same on
     * every rank), and by owned node [N/m]. */
    std::map<unsigned int, double> row_sums() const;
    std::vector<double> own_row_sums() const;

    /** Deal out the pieces to the ranks (collective). */
    void deal_out(Lining &lining) const;

    /** Displacement of the points since installed [m]. */
    std::vector<Tensor<1, dim>> displacements(const Lining &lining) const;

    /** Bring the anchors' displacements up to date (collective). */
    void follow(const std::vector<double> &displacement);

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const ActiveCells<dim> &active_cells;
    std::vector<Lining> linings;
    std::vector<double> true_mass; ///< by owned node [kg]
    std::vector<double> own_mass;  ///< in use, the same
  };
} // namespace Keyblock

#endif

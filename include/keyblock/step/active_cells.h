// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_active_cells_h
#define keyblock_step_active_cells_h

#include <keyblock/blocks/ground.h>
#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>
#include <keyblock/rock/mass_scaling.h>
#include <keyblock/step/stable_step.h>

namespace Keyblock
{
  /** What has been excavated and taken away so far. */
  struct CellState
  {
    unsigned int stage_number = 0;
    std::vector<bool> is_removed; ///< by block
    std::vector<bool> is_frozen;  ///< by mesh cell

    bool operator==(const CellState &other) const;
  };

  /**
   * The deformable cells that are there: their nodes, materials and
   * frequencies, and the masses that they give to nodes.
   */
  template <int dim>
  class ActiveCells : private CellState
  {
  public:
    ActiveCells(const Scene<dim> &scene,
                const SplitMesh<dim> &split,
                const Numbering<dim> &numbering,
                CellArrays<dim> &cells,
                Fields<dim> &fields);

    /** Go to stage @p number (Scene::stage_number): take away the cells that
     * are excavated, put in those that are filled. Stresses of the cells that
     * stay are kept. Masses are to be set anew, by scale_density. */
    void excavate(const unsigned int number);

    /** Take a block away in the next call of excavate. */
    void remove_block(const unsigned int block);

    bool
    is_removed_block(const unsigned int block) const
    {
      return !is_removed.empty() && is_removed[block];
    }

    /** Leave out cells from the next call of excavate on, and hold all their
     * nodes; by mesh cell. Empty: none. */
    void
    freeze(const std::vector<bool> &is_frozen_cell)
    {
      is_frozen = is_frozen_cell;
    }

    const CellState &
    state() const
    {
      return *this;
    }

    /** Take up another state; excavate is to follow. */
    void
    recall(const CellState &other)
    {
      CellState::operator=(other);
    }

    /** What is there now. */
    Ground<dim>
    ground() const
    {
      return {scene, split, stage_number, &is_removed};
    }

    /** Divide the strength of all rock by 1 / @p share. */
    void reduce_strength(const double share);

    /** Set cells.beta for stiffness-proportional damping. */
    void set_damping(const Stage &stage);

    /** Set masses that give all cells the lowest frequency of them, or those
     * of `mass_scaling`, the true ones without it; nodes held in all directions
     * have inverse mass zero. Gravity is not affected. */
    void scale_density(const bool is_scaled);

    /** Add to the masses in use what else moves with local nodes, until they
     * are set anew [kg]. */
    void add_mass(const std::vector<double> &added);

    /** What was added at local @p node [kg]. */
    double
    added_mass_at(const unsigned int node) const
    {
      return added_mass.empty() ? 0. : added_mass[node];
    }

    /** Highest frequency, squared, of the cells around each of @p vertices of
     * the split mesh with the masses in use; what acts on hanging ones acts on
     * their masters (the same on every rank, collective) [rad^2/s^2]. */
    std::vector<double>
    squared_frequencies_at(const std::vector<unsigned int> &vertices) const;

    StableStep<dim> stable_step;   ///< of the masses in use
    std::vector<double> frequency; ///< of each deformable cell here [rad/s]

    /** Inertia shared out anew within blocks (Time stepping/Least step): one
     * entry for each block, the last for rock that is excavated later. Empty:
     * none. */
    std::vector<MassScaling> mass_scaling;

  private:
    void list_cells();

    /** Add a cell of this rank, number @p i of those of the numbering, whose
     * plastic strains are those of @p old. */
    void add_cell(const unsigned int i, const CellArrays<dim> &old);
    void mark_uniform_kinds();
    void set_up_frequencies();
    void set_up_mass_scaling();
    void share_out_masses();
    void set_up_weighing_mass();
    void invert_masses();
    void hold_frozen_nodes();

    /** Of the block of a cell of `cells`; null without mass_scaling. */
    const MassScaling *scaling_of(const unsigned int cell) const;
    const Material<dim> &material_of(const unsigned int mesh_cell) const;
    std::array<std::array<double, dim>, 1 << dim>
    corners_of(const unsigned int mesh_cell) const;

    /** Mass by node [kg], with @p density(cell, true density) [kg/m3]. */
    template <typename Density>
    std::vector<double> sum_masses(const Density &density) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    CellArrays<dim> &cells;
    Fields<dim> &fields;

    std::vector<unsigned int> cell_of_local; ///< into cells, or `none`
    StableStep<dim> unscaled_step;  ///< of masses that are not all scaled
    double lowest_frequency = 0.;   ///< of all cells [rad/s]
    std::vector<double> added_mass; ///< by local node; empty: none [kg]
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_output_h
#define keyblock_output_output_h

#include <keyblock/base/vtu_file.h>
#include <keyblock/geostress/geostress.h>
#include <keyblock/output/bolt_output.h>
#include <keyblock/output/liner_output.h>
#include <keyblock/output/monitors.h>
#include <keyblock/safety/safety_factor.h>

#include <cstdint>

namespace Keyblock
{
  /** Numbers of contact points by state. */
  struct JointPoints
  {
    unsigned int open = 0, sliding = 0, sticking = 0, intact = 0;
  };

  /** What happened in one stage, for summary.json. */
  struct StageReport
  {
    std::string name;
    std::uint64_t steps        = 0;
    double time_step           = 0.;
    double unbalanced_ratio    = 0.;
    double max_displacement    = 0.;
    double largest_nodal_ratio = 0.;    ///< largest force over the mean one [-]
    bool is_converged          = true;  ///< it ended as it was asked to
    bool is_timed              = false; ///< after its time, not in balance
    std::string remark;  ///< for people: what moves if it did not converge
    std::string warning; ///< sentences, or empty
    unsigned int cells           = 0; ///< deformable ones
    unsigned int plastic_cells   = 0; ///< of these in the plastic loop
    unsigned int yielding_points = 0; ///< Gauss points, last step
    JointPoints points;
    unsigned int through_rock = 0; ///< contacts within a block, at the end
    double largest_overlap = 0.;   ///< of nodes in other blocks, at the end [m]
    std::array<double, 3> overlap_place{{0., 0., 0.}};
    unsigned int turned_block = none; ///< id of the one that turned most
    double turned_by          = 0.;   ///< since the start of the run [rad]
    double arm_error          = 0.;   ///< of its weight by that [-]
    Energies energies;
  };

  /** Figures of the whole run, for summary.json. */
  struct RunReport
  {
    std::uint64_t steps        = 0;
    double time_step           = 0.;
    double simulated_time      = 0.;
    double wall_time           = 0.;
    double loop_time           = 0.;
    double contact_time        = 0.;
    double force_time          = 0.;
    double skipped_steps       = 0.; ///< of element_steps: cells at rest
    double element_steps       = 0.;
    unsigned int capped_groups = 0;
    double solved_groups       = 0.; ///< by iteration, in this run
    std::string stable_step_place;
    std::string stable_step_joints; ///< that touch the cell there
    double step_ratio = 1.; ///< least over median of the cells at the start
    std::vector<MassScaling> mass_scaling; ///< at the end, by block
    std::vector<BoltFigures> bolts;        ///< at the end
    std::vector<LinerReport> liners;       ///< at the end
    std::vector<LinerFigures> structural;  ///< liners, at the end
    std::vector<std::string> warnings;     ///< all of the run
    std::vector<std::string> overrides;    ///< "Section/Entry=value"
  };

  /** Measured quantities of the scene: name and value, in order. */
  using CheckValues = std::vector<std::pair<std::string, double>>;

  /**
   * Writes solution.pvd with one VTU of the rock and one of the interfaces per
   * time, and summary.json, into the output folder.
   */
  template <int dim>
  class Output
  {
  public:
    Output(const Scene<dim> &scene,
           const SplitMesh<dim> &split,
           const Blocks<dim> &blocks,
           const Numbering<dim> &numbering,
           const CellArrays<dim> &cells,
           const Fields<dim> &fields,
           const Contact<dim> *contact,
           const std::vector<SafetyFactor> &factors,
           const std::string &folder);

    /** Write the state at @p time (collective). */
    void write_vtu(const double time);

    /** Write the rock of the last time once more, if that is the state at
     * @p time in the present stage: safety factors have become known
     * (collective). */
    void rewrite_rock(const double time) const;

    /** Numbers that are not finite are left out of summary.json and listed
     * there; then throws ComputationError (collective). */
    void write_summary(const MeshQuality &quality,
                       const MeshReport<dim> &mesh_report,
                       const RunReport &run,
                       const std::vector<StageReport> &stages,
                       const History &history,
                       const CheckValues &checks,
                       const std::vector<SafetyFactor> &factors,
                       const std::vector<unsigned int> &removal_stage,
                       const Geostress *geostress) const;

    /** Write blocks.csv, a line for each finite block with its least factor,
     * and factors.csv, one for each factor (collective; RFC 4180). */
    void write_tables(const std::vector<unsigned int> &removal_stage) const;

    /** The files in solution.pvd: rock, interface, rock, ... */
    std::vector<VtuRecord> records;

    /** Number of the present stage (Scene::stage_number). */
    unsigned int stage = 1;

  private:
    /** The rock that is there, on this rank (collective). */
    VtuGrid make_rock(const double time) const;

    /** Faces of joints whose minus sides this rank has (collective). */
    VtuGrid make_interface(const double time) const;

    /** Write a grid of rock or interface of number @p number, of several ranks
     * in pieces; returns the name of the file (collective). */
    std::string write(const VtuGrid &grid,
                      const std::string &base,
                      const unsigned int number) const;

    /** What the ids of all grids stand for, and the present stage. */
    VtuGrid make_grid(const double time) const;

    std::string stage_name() const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    const Fields<dim> &fields;
    const Contact<dim> *contact;
    const std::vector<SafetyFactor> &factors; ///< found so far
    std::string folder;                       ///< ends with "/"
  };
} // namespace Keyblock

#endif

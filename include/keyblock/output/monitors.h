// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_monitors_h
#define keyblock_output_monitors_h

#include <keyblock/step/step.h>

#include <fstream>

namespace Keyblock
{
  /** A table of named columns over time; only rank 0 holds rows. */
  class History
  {
  public:
    std::vector<std::string> columns; ///< name [unit]
    std::vector<std::vector<double>> rows;

    /** First row of each stage. */
    std::vector<unsigned int> stage_begin;

    /** Whether the last stage has any row. */
    bool
    has_last_stage() const
    {
      return !stage_begin.empty() && stage_begin.back() < rows.size();
    }

    bool has(const std::string &name) const;

    /** Values of column @p name (without unit) from row @p begin on. */
    std::vector<double> column(const std::string &name,
                               const unsigned int begin = 0) const;

    double last(const std::string &name) const;
  };

  /**
   * Samples the scene's monitors. Displacements count from the last reset of
   * motion; velocities are those of the half step before the row's time.
   */
  template <int dim>
  class Monitors
  {
  public:
    Monitors(const Scene<dim> &scene,
             const SplitMesh<dim> &split,
             const Blocks<dim> &blocks,
             const Numbering<dim> &numbering,
             const CellArrays<dim> &cells,
             const Fields<dim> &fields,
             const Contact<dim> *contact);

    /** Take displacements from the present state as zero. */
    void reset_baseline();

    /** Append a row (collective). */
    void sample(const ExplicitStep<dim> &step, const unsigned int stage);

    /** Append the row of the state before the first step, which no stage
     * counts as its own (collective). */
    void sample_start(const ExplicitStep<dim> &step);

    /** Write all rows so far (collective). */
    void write_csv(const std::string &file_name) const;

    /** Add the rows since the last call to the file, which the first call
     * begins anew with all of them (rank 0), for those who watch a run. Whether
     * it could be written does not matter here: write_csv() says it. */
    void append_csv(const std::string &file_name);

    History history;

    /** Displacement of local nodes at the last reset [m]. */
    std::vector<double> baseline;

    /** Index into Blocks::blocks that each block monitor watches. */
    std::vector<unsigned int> block_of_monitor;

    /** A sentence for each monitor that is not where the scene has it. */
    std::vector<std::string> warnings;

  private:
    void find_target(const Monitor<dim> &monitor);

    /** Index into Blocks::blocks of the block that a monitor names, or at its
     * Location. Throws InputError if there is none. */
    unsigned int find_block(const Monitor<dim> &monitor);

    /** The cell that @p location lies in, or none. */
    unsigned int find_cell_at(const Point<dim> &location) const;

    /** Warn of a monitor whose Location is in no cell, or refuse it if the
     * rock is farther away than the model is large; @p distance: of what it
     * follows instead [m]. */
    void look_for_location(const Monitor<dim> &monitor, const double distance);
    void name_columns();
    std::vector<double> make_row(const ExplicitStep<dim> &step,
                                 const unsigned int stage);
    void sample_joint(const Monitor<dim> &monitor, std::vector<double> &row);

    void sample_support(const Monitor<dim> &monitor, std::vector<double> &row);

    /** Mass-weighted means of displacement and velocity over owned @p nodes of
     * all ranks; plain means where nothing has mass any more. */
    void sample_nodes(const std::vector<unsigned int> &nodes,
                      std::vector<double> &row);
    void sample_block(const unsigned int block, std::vector<double> &row);

    /** Motion of a block from the rock beside it, over the faces of its joints:
     * mean slip, largest slip, mean opening [m]. */
    void sample_block_motion(const unsigned int block,
                             std::vector<double> &row);

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    const Fields<dim> &fields;
    const Contact<dim> *contact;

    std::size_t n_appended = 0; ///< rows in the file of append_csv()
    std::vector<unsigned int> node_of_monitor; ///< owned local node or none
    std::vector<std::vector<unsigned int>> nodes_of_monitor; ///< of regions
    std::vector<unsigned int> block_of_node;
    std::vector<double> cell_volume; ///< of mesh cells on this rank
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_model_h
#define keyblock_run_model_h

#include <deal.II/base/conditional_ostream.h>

#include <keyblock/base/communicator.h>
#include <keyblock/base/warning_list.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/geostress/geostress.h>
#include <keyblock/step/snapshot.h>

#include <memory>

namespace Keyblock
{
  /**
   * The rock and its joints, ready to be stepped: what a scene becomes. Members
   * stand in the order of the data; each is built from references to earlier
   * ones.
   */
  template <int dim>
  class Model
  {
  public:
    /** Read and check the scene; nothing is computed. Throws InputError.
     * @param communicator the ranks that share the model */
    Model(const Communicator &communicator,
          const std::string &scene_file,
          const std::vector<std::string> &overrides);

    /** Mesh, blocks, and the mesh split along their faces. */
    void make_geometry();

    /** All that follows from the split mesh. Throws InputError. */
    void set_up();

    /** What of it changes from step to step. */
    RunParts<dim>
    parts()
    {
      return {*conditions, cells, fields, contact.get(), *step};
    }

    /** Stable time step without damping, before the safety factor [s]. */
    double
    stable_step() const
    {
      return conditions->stable_step.limit(Stage());
    }

    /** Cells have come or gone: count those of all ranks anew (collective). */
    void count_cells();

    /** A nodal @p field with dim values for each vertex of the split mesh, the
     * same on all ranks (collective). */
    std::vector<double>
    values_by_vertex(const std::vector<double> &field) const;

    const Communicator communicator;
    dealii::ConditionalOStream out; ///< messages of the run, on rank 0
    WarningList warnings;           ///< prints them to out
    Scene<dim> scene;
    MeshQuality quality;
    MeshReport<dim> mesh_report;
    Blocks<dim> blocks;
    SplitMesh<dim> split;
    std::unique_ptr<Numbering<dim>> numbering;
    CellArrays<dim> cells;
    Fields<dim> fields;
    std::unique_ptr<Conditions<dim>> conditions;
    std::unique_ptr<Contact<dim>> contact; ///< null: joints are ignored
    std::unique_ptr<ExplicitStep<dim>> step;
    std::unique_ptr<Geostress> geostress; ///< null: nothing was measured

    unsigned long long n_cells_global = 0; ///< deformable ones

  private:
    /** Whether all stages take a number of steps that can be made. Throws
     * InputError. */
    void check_durations() const;
  };
} // namespace Keyblock

#endif

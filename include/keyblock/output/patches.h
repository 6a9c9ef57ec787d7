// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_patches_h
#define keyblock_output_patches_h

#include <deal.II/base/data_out_base.h>

#include <fstream>

namespace Keyblock
{
  /** How all VTU files are written. */
  inline dealii::DataOutBase::VtkFlags
  vtk_flags(const double time)
  {
    dealii::DataOutBase::VtkFlags flags;
    flags.time                = time;
    flags.print_date_and_time = false;
    flags.compression_level =
      dealii::DataOutBase::VtkFlags::ZlibCompressionLevel::best_speed;
    return flags;
  }

  /** Write a VTU file; returns whether that worked. */
  template <typename Data>
  bool
  write_file(const Data &data, const std::string &name)
  {
    std::ofstream out(name);
    try
      {
        data.write_vtu(out);
      }
    catch (const dealii::ExcIO &)
      {
        return false;
      }
    return bool(out.flush());
  }

  /** Faces or lines in space as patches, values at their corners. */
  template <int patch_dim, int dim>
  class PatchOutput : public dealii::DataOutInterface<patch_dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>;

    std::vector<Patch> patches;
    std::vector<std::string> names;

    /** A new patch with undetermined vertices and values. */
    Patch &
    add()
    {
      Patch patch;
      patch.patch_index    = patches.size();
      patch.n_subdivisions = 1;
      patch.reference_cell = patch_dim == 1
                               ? dealii::ReferenceCells::Line
                               : dealii::ReferenceCells::Quadrilateral;
      patch.data.reinit(names.size(), 1 << patch_dim);
      patches.push_back(patch);
      return patches.back();
    }

  protected:
    const std::vector<Patch> &
    get_patches() const override
    {
      return patches;
    }

    std::vector<std::string>
    get_dataset_names() const override
    {
      return names;
    }
  };
} // namespace Keyblock

#endif

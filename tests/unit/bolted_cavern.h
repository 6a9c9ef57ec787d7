// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_tests_bolted_cavern_h
#define keyblock_tests_bolted_cavern_h

#include "world.h"

#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/blocks/exact_blocks.h>

#include <fstream>

namespace Keyblock
{
  /** What bolts are made of. */
  constexpr char bar[] = "  set Stage = dig\n  set Area = 1e-4\n"
                         "  set Yield force = 1e5\n"
                         "  set Bond stiffness = 1e8\n"
                         "  set Bond strength = 1e5\n";

  /** Call @p action(bolts, split, scene) for the bolts of a scene with a cavern
   * 4 m wide and 3 m high, in 3D 20 m long. @p entries: of the set of bolts;
   * @p sections: more of the scene. */
  template <int dim, typename Action>
  void
  with_bolts(const std::string &entries,
             const std::string &sections,
             const Action &action)
  {
    const std::string name = "bolt_layout_" + std::to_string(dim) + "_" +
                             std::to_string(world.size()) + ".prm";
    if (world.is_root())
      std::ofstream(name)
        << "set Dimension = " << dim << "\nsubsection Domain\n set Size = "
        << (dim == 2 ? "10, 10" : "10, 20, 10")
        << "\nend\nsubsection Mesh\n set Generator = structured\n"
           " set Cells = "
        << (dim == 2 ? "20, 20" : "10, 5, 20")
        << "\nend\nsubsection Excavations\n set Names = cavern\n"
           " subsection cavern\n  set Shape = box\n  set Corner = "
        << (dim == 2 ? "3, 4" : "3, 0, 4")
        << "\n  set Size = " << (dim == 2 ? "4, 3" : "4, 20, 3")
        << "\n  set Stage = dig\n end\nend\nsubsection Materials\n"
           " set Names = rock\nend\nsubsection Stages\n set Names = dig\n"
           " subsection dig\n  set Duration = 1\n end\nend\n"
        << sections << "subsection Bolts\n set Names = bar\n subsection bar\n"
        << bar << entries << " end\nend\n";
    Scene<dim> scene;
    scene.read(world, name, {});
    std::unique_ptr<ExactBlocks<dim>> exact;
    auto [mesh, blocks] =
      make_mesh_for_blocks<dim>(world, scene, exact, silent);
    const SplitMesh<dim> split = split_mesh(mesh, blocks, scene);
    action(lay_out_bolts(scene, split), split, scene);
  }

  template <int dim>
  std::vector<Bolt<dim>>
  bolts_of(const std::string &entries, const std::string &joints = "")
  {
    std::vector<Bolt<dim>> found;
    with_bolts<dim>(entries,
                    joints,
                    [&](const std::vector<Bolt<dim>> &bolts,
                        const SplitMesh<dim> &,
                        const Scene<dim> &) { found = bolts; });
    return found;
  }
} // namespace Keyblock

#endif

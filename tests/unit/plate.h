// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_tests_unit_plate_h
#define keyblock_tests_unit_plate_h

#include "world.h"

#include <keyblock/blocks/liner_layout.h>
#include <keyblock/step/step.h>

#include <fstream>
#include <memory>

namespace Keyblock
{
  /** A plate of 2 m x 1 m with its lower left corner at the origin, 4 x 2
   * cells, and all that a step works on; no run is set up. */
  struct Plate
  {
    static constexpr double density = 2000.; ///< [kg/m3]
    static constexpr double mass    = 2. * density;

    /** @p text: what the scene says besides mesh and rock, @p last after it. */
    explicit Plate(const std::string &text, const std::string &last = "")
    {
      const std::string file =
        "plate_of_" + std::to_string(world.size()) + ".prm";
      MPI_Barrier(world);
      if (world.is_root())
        std::ofstream(file)
          << "subsection Domain\n set Size = 2, 1\n set Truncated boundaries = "
             "none\nend\nsubsection Mesh\n set Cells = 4, 2\nend\nsubsection "
             "Materials\n set Names = rock\n subsection rock\n  set Young "
             "modulus = 1e9\n  set Poisson ratio = 0.25\n  set Density = "
          << density << "\n end\nend\n"
          << text << last;
      MPI_Barrier(world);
      scene.read(world, file, {});
      const Mesh<2> mesh = make_mesh(world, scene, silent);
      blocks             = find_blocks(mesh, scene);
      split              = split_mesh(mesh, blocks, scene);
      split.liners       = lay_out_liners(scene, split);
      numbering          = std::make_unique<Numbering<2>>(world, scene, split);
      conditions         = std::make_unique<Conditions<2>>(
        scene, split, *numbering, cells, fields);
      step = std::make_unique<ExplicitStep<2>>(
        scene, split, blocks, *numbering, *conditions, cells, fields, nullptr);
    }

    /** Sum of @p field over the owned nodes of all ranks. */
    Tensor<1, 2>
    sum_of(const std::vector<double> &field) const
    {
      Tensor<1, 2> sum;
      for (unsigned int i = 0; i < 2 * numbering->n_owned(); ++i)
        sum[i % 2] += field[i];
      for (unsigned int d = 0; d < 2; ++d)
        sum[d] = world.sum(sum[d]);
      return sum;
    }

    Point<2>
    place_of(const unsigned int node) const
    {
      return split.mesh.vertices[numbering->vertex_of_node[node]];
    }

    Scene<2> scene;
    Blocks<2> blocks;
    SplitMesh<2> split;
    CellArrays<2> cells;
    Fields<2> fields;
    std::unique_ptr<Numbering<2>> numbering;
    std::unique_ptr<Conditions<2>> conditions;
    std::unique_ptr<ExplicitStep<2>> step;
  };

  /** One stage that does nothing. */
  inline const std::string one_stage =
    "subsection Stages\n set Names = rest\n subsection rest\n  set Maximum "
    "steps = 1\n end\nend\n";
} // namespace Keyblock

#endif

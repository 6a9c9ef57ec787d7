// SPDX-License-Identifier: LGPL-2.1-or-later
// Rock that is thinner than the cells.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/block_geometry.h>
#include <keyblock/blocks/mesh_fidelity.h>
#include <keyblock/mesh/report_warnings.h>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace Keyblock;

namespace
{
  /** A wall 4 m high and a joint parallel to it, this deep behind it [m], that
   * ends above and below on free faces. */
  struct Skin
  {
    Skin(const double depth, const std::string &mesh_entries)
    {
      const std::string file =
        "thin_rock_" + std::to_string(world.size()) + ".prm";
      MPI_Barrier(world);
      if (world.is_root())
        std::ofstream(file)
          << "set Dimension = 2\nsubsection Domain\n set Size = 12, 12\n set "
             "Truncated boundaries = left, right, bottom\nend\nsubsection "
             "Mesh\n set Generator = gmsh\n set Size = 1\n"
          << mesh_entries
          << "end\nsubsection Excavations\n set Names = air\n subsection air\n"
             "  set Vertices = "
          << 6. - depth << ",2; 12,2; 12,12; 0,12; 0,8; 6,8; 6,4; "
          << 6. - depth
          << ",4\n end\nend\nsubsection Joints\n set Names = p\n subsection "
             "p\n  set Vertices = "
          << 6. - depth << ",4; " << 6. - depth
          << ",8\n end\nend\nsubsection Materials\n set Names = rock\nend\n";
      MPI_Barrier(world);
      scene.read(world, file, {});
      BlockGeometry<2> made = make_block_geometry(world, scene, silent);
      blocks                = std::move(made.blocks);
      split                 = std::move(made.split);
      report                = std::move(made.report);
      for (const Block<2> &block : blocks.blocks)
        if (!block.is_infinite)
          area += block.volume;
    }

    std::string
    warnings() const
    {
      std::ostringstream text;
      for (const std::string &warning : warnings_of_mesh_report(report, scene))
        text << warning << '\n';
      for (const std::string &warning :
           warnings_of_coarse_mesh(scene, split, blocks))
        text << warning << '\n';
      return text.str();
    }

    Scene<2> scene;
    Blocks<2> blocks;
    SplitMesh<2> split;
    MeshReport<2> report; ///< on rank 0
    double area = 0.;     ///< of all finite blocks [m2]
  };

  bool
  says(const std::string &text, const std::string &words)
  {
    BOOST_TEST_INFO("'" << words << "' in '" << text << "'");
    return text.find(words) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(thin_rock)

BOOST_AUTO_TEST_CASE(skins_are_as_thick_as_they_are)
{
  for (const double depth : {0.01, 0.05, 0.08, 0.12, 0.17})
    {
      const Skin skin(depth, "");
      BOOST_TEST_CONTEXT(depth << " m")
      {
        BOOST_TEST(skin.area == 4. * depth,
                   boost::test_tools::tolerance(1e-12));
        if (world.is_root())
          BOOST_TEST(skin.warnings() == "");
      }
    }
}

BOOST_AUTO_TEST_CASE(smaller_cells_keep_skins)
{
  for (const double depth : {0.05, 0.08, 0.12, 0.17, 0.3})
    {
      const Skin skin(depth,
                      " set Cells across blocks = 2\n set Least size = 0.02\n");
      BOOST_TEST_CONTEXT(depth << " m")
      {
        BOOST_TEST(skin.area == 4. * depth, boost::test_tools::tolerance(1e-3));
        if (world.is_root())
          BOOST_TEST(!says(skin.warnings(), "too thin for the cells"));
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()

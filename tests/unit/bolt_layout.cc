// SPDX-License-Identifier: LGPL-2.1-or-later
// Patterns of bolts set out on the faces of an excavation, and where bolts
// cross joints.
#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/bolt_layout.h>

#include <cmath>
#include <fstream>

#include "world.h"

using namespace Keyblock;

namespace
{
  constexpr char bar[] = "  set Stage = dig\n  set Area = 1e-4\n"
                         "  set Yield force = 1e5\n"
                         "  set Bond stiffness = 1e8\n"
                         "  set Bond strength = 1e5\n";

  /** The bolts of a scene with a cavern 4 m wide and 3 m high, in 3D 20 m
   * long. @p entries: of the set of bolts; @p joints: a section. */
  template <int dim>
  std::vector<Bolt<dim>>
  bolts_of(const std::string &entries, const std::string &joints = "")
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
        << joints << "subsection Bolts\n set Names = bar\n subsection bar\n"
        << bar << entries << " end\nend\n";
    Scene<dim> scene;
    scene.read(world, name, {});
    auto [mesh, blocks]        = make_mesh_for_blocks(world, scene, silent);
    const SplitMesh<dim> split = split_mesh(mesh, blocks, scene);
    return lay_out_bolts(scene, split);
  }

  const std::string pattern = "  set Excavations = cavern\n  set Length = 2\n"
                              "  set Spacing = 1, 2\n";
} // namespace

BOOST_AUTO_TEST_CASE(bolt_pattern_in_the_plane)
{
  // two walls of 3 m and a roof of 4 m in one row
  const auto bolts = bolts_of<2>(pattern);
  BOOST_TEST(bolts.size() == 10u);
  unsigned int n_up = 0;
  for (const Bolt<2> &bolt : bolts)
    {
      const Tensor<1, 2> way = bolt.direction();
      BOOST_TEST(std::abs(bolt.length() - 2.) < 1e-12);
      BOOST_TEST(std::abs(std::abs(way[0]) + std::abs(way[1]) - 1.) < 1e-12);
      n_up += way[1] > 0.5;
      // on the face, and out of the cavern
      const bool is_on_roof = std::abs(bolt.head[1] - 7.) < 1e-12;
      BOOST_TEST(is_on_roof == (way[1] > 0.5));
      BOOST_TEST((is_on_roof || (bolt.head[0] < 5.) == (way[0] < 0.)));
      // half a spacing from corners
      const double along = is_on_roof ? bolt.head[0] : bolt.head[1];
      BOOST_TEST(std::abs(along - std::floor(along) - 0.5) < 1e-9);
      BOOST_TEST(bolt.crossings.empty());
    }
  BOOST_TEST(n_up == 4u);
}

BOOST_AUTO_TEST_CASE(bolt_pattern_in_rings)
{
  for (const auto &[parts, number] :
       {std::make_pair("roof, walls", 100u), {"roof", 40u}, {"floor", 40u}})
    {
      const auto bolts = bolts_of<3>(pattern + "  set Parts = " + parts + "\n");
      BOOST_TEST(bolts.size() == number);
      for (const Bolt<3> &bolt : bolts)
        {
          BOOST_TEST(std::abs(bolt.direction()[1]) < 1e-12);
          BOOST_TEST(std::abs(std::remainder(bolt.head[1] - 1., 2.)) < 1e-9);
        }
    }
  // towards the axis by 30 degrees, above half of the cavern
  const auto bolts = bolts_of<3>(
    pattern +
    "  set Parts = roof\n  set Inclination = 30\n  set Region = y - 10\n");
  BOOST_TEST(bolts.size() == 20u);
  for (const Bolt<3> &bolt : bolts)
    {
      BOOST_TEST(std::abs(bolt.direction()[1] - 0.5) < 1e-12);
      BOOST_TEST(std::abs(bolt.direction()[2] - std::sqrt(0.75)) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(bolt_crosses_a_joint)
{
  // a level joint 1 m above the roof, which parts the rock in two
  const auto bolts =
    bolts_of<2>("  set Heads = 5, 7\n  set Ends = 5.5, 9.5\n",
                "subsection Joints\n set Names = bed\n subsection bed\n"
                "  set Point = 0, 8\n  set Dip = 0\n end\nend\n");
  BOOST_REQUIRE(bolts.size() == 1u);
  BOOST_REQUIRE(bolts[0].crossings.size() == 1u);
  const BoltCrossing<2> &crossing = bolts[0].crossings[0];
  // as near as cells are told apart: 1e-7 of their size
  BOOST_TEST(std::abs(bolts[0].at(crossing.place)[1] - 8.) < 1e-7 * 0.5 * 1.01);
  BOOST_TEST(crossing.joint == 0u);
  BOOST_TEST(std::abs(crossing.normal[1] - 1.) < 1e-12);
  BOOST_TEST(crossing.block[0] != crossing.block[1]);
}

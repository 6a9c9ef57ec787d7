// SPDX-License-Identifier: LGPL-2.1-or-later
// Patterns of bolts set out on the faces of an excavation, and where bolts
// cross joints.
#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/mesh/cell_locator.h>
#include <keyblock/run/bolt_warnings.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include "world.h"

BOOST_AUTO_TEST_SUITE(bolt_layout)

using namespace Keyblock;

namespace
{
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
    auto [mesh, blocks]        = make_mesh_for_blocks(world, scene, silent);
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

  /** Two level joints, 1 m and 1.5 m above the roof. */
  const std::string beds =
    "subsection Joints\n set Names = low, high\n subsection low\n"
    "  set Point = 0, 8\n  set Dip = 0\n end\n subsection high\n"
    "  set Point = 0, 8.5\n  set Dip = 0\n end\nend\n";

  /** Grout of the nodes of a bolt in each of the three layers [m]. */
  std::array<double, 3>
  grout_by_layer(const Bolt<2> &bolt, const BoltRemains &remains)
  {
    std::array<double, 3> length{};
    for (unsigned int i = 0; i < bolt.places.size(); ++i)
      if (remains.is_held[i])
        {
          const double y = bolt.at(bolt.places[i])[1];
          length[y < 8.    ? 0
                 : y < 8.5 ? 1
                           : 2] += remains.grout[i][1] - remains.grout[i][0];
        }
    return length;
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

// Around the whole section they are equally far from each other, no more than
// the spacing, from the middle of the roof on.
BOOST_AUTO_TEST_CASE(bolt_pattern_around_the_section)
{
  const auto places = [](const auto &bolts, const unsigned int up) {
    // clockwise from the middle of the roof, on an outline of 14 m
    std::vector<double> list;
    for (const auto &bolt : bolts)
      {
        const double x = bolt.head[0] - 5., y = bolt.head[up] - 4.;
        double place = x;
        if (std::abs(y) < 1e-9)
          place = 7. - x;
        else if (std::abs(y - 3.) > 1e-9)
          place = x > 0. ? 5. - y : 9. + y;
        list.push_back(place < -1e-9 ? place + 14. : place);
      }
    std::sort(list.begin(), list.end());
    return list;
  };
  const std::string around = "  set Excavations = cavern\n  set Length = 2\n"
                             "  set Parts = roof, walls, floor\n";
  for (const auto &[spacing, n] :
       {std::make_pair("1.3", 11u), {"1.4", 10u}, {"1.3999", 10u}, {"20", 1u}})
    {
      const std::string entries =
        around + "  set Spacing = " + spacing + ", 20\n";
      const auto plane = places(bolts_of<2>(entries), 1),
                 ring  = places(bolts_of<3>(entries), 2);
      BOOST_REQUIRE(plane.size() == n);
      BOOST_REQUIRE(ring.size() == n);
      for (unsigned int k = 0; k < n; ++k)
        {
          BOOST_TEST(std::abs(plane[k] - 14. * k / n) < 1e-9);
          BOOST_TEST(std::abs(ring[k] - 14. * k / n) < 1e-9);
        }
    }
}

// Where gravity points to -x, the roof is at x = 7 and the walls are at y = 4
// and y = 7: turned by a right angle, clockwise.
BOOST_AUTO_TEST_CASE(bolt_pattern_in_turned_axes)
{
  const auto turned = [](const std::string &gravity) {
    return "subsection Initial state\n  set Gravity = " + gravity + "\nend\n";
  };
  const auto roof =
    bolts_of<2>(pattern + "  set Parts = roof\n", turned("-9.81; 0"));
  BOOST_TEST(roof.size() == 3u);
  for (const Bolt<2> &bolt : roof)
    BOOST_TEST(std::abs(bolt.head[0] - 7.) < 1e-12);
  const auto ring =
    bolts_of<3>(pattern + "  set Parts = roof, walls\n", turned("0; 0; 9.81"));
  BOOST_TEST(ring.size() == 100u);
  for (const Bolt<3> &bolt : ring)
    BOOST_TEST(bolt.direction()[2] < 1e-12);
  // from the middle of the roof on
  const auto around =
    bolts_of<2>("  set Excavations = cavern\n  set Length = 2\n"
                "  set Parts = roof, walls, floor\n"
                "  set Spacing = 20, 20\n",
                turned("-9.81; 0"));
  BOOST_REQUIRE(around.size() == 1u);
  BOOST_TEST(around[0].head.distance(Point<2>(7., 5.5)) < 1e-9);
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

// The grout of a node ends with its block, however long segments are; a layer
// between two nodes gets one of its own.
BOOST_AUTO_TEST_CASE(bolt_grout_ends_at_joints)
{
  std::mt19937 random(5);
  for (unsigned int n = 0; n < 20; ++n)
    {
      const double segment =
        std::uniform_real_distribution<double>(0.06, 3.)(random);
      with_bolts<2>(
        "  set Heads = 5, 7\n  set Ends = 5.5, 9.5\n"
        "  set Segment length = " +
          std::to_string(segment) + "\n",
        beds,
        [&](const std::vector<Bolt<2>> &bolts,
            const SplitMesh<2> &split,
            const Scene<2> &scene) {
          const Bolt<2> &bolt = bolts[0];
          BOOST_REQUIRE(bolt.crossings.size() == 2u);
          const auto length = grout_by_layer(
            bolt,
            find_remains(bolt,
                         Ground<2>{scene, split, scene.stage_number("dig")}));
          const double slope = bolt.length() / 2.5;
          for (unsigned int l = 0; l < 3; ++l)
            BOOST_TEST(std::abs(length[l] / slope - (l == 1 ? 0.5 : 1.)) < 1e-6,
                       "segments of " << segment << " m, layer " << l << ": "
                                      << length[l]);
        });
    }
}

// and with the rock that is dug later
BOOST_AUTO_TEST_CASE(bolt_grout_ends_where_rock_is_dug)
{
  const std::string gallery =
    "subsection Excavations\n set Names = cavern, gallery\n"
    " subsection gallery\n  set Shape = box\n  set Corner = 4, 8\n"
    "  set Size = 3, 0.5\n  set Stage = again\n end\nend\n"
    "subsection Stages\n set Names = dig, again\n subsection again\n"
    "  set Duration = 1\n end\nend\n";
  for (const double segment : {0.1, 0.37, 0.9, 2.})
    with_bolts<2>(
      "  set Heads = 5, 7\n  set Ends = 5.5, 9.5\n"
      "  set Segment length = " +
        std::to_string(segment) + "\n",
      gallery,
      [&](const std::vector<Bolt<2>> &bolts,
          const SplitMesh<2> &split,
          const Scene<2> &scene) {
        const Bolt<2> &bolt = bolts[0];
        const auto length   = grout_by_layer(
          bolt,
          find_remains(bolt,
                       Ground<2>{scene, split, scene.stage_number("again")}));
        const double slope = bolt.length() / 2.5,
                     near  = segment / 16. * (1. + 1e-9);
        BOOST_TEST(std::abs(length[0] - slope) < near);
        BOOST_TEST(length[1] == 0.);
        BOOST_TEST(std::abs(length[2] - slope) < near);
      });
}

// A head or an end on the plane of a joint is in the rock along the bolt, so
// that a block on the other side may have gone.
BOOST_AUTO_TEST_CASE(bolt_begins_and_ends_on_joints)
{
  for (const bool is_down : {false, true})
    {
      const std::string low = "5.1, 8", high = "5.3, 8.5";
      with_bolts<2>("  set Heads = " + (is_down ? high : low) +
                      "\n  set Ends = " + (is_down ? low : high) + "\n",
                    beds,
                    [](const std::vector<Bolt<2>> &bolts,
                       const SplitMesh<2> &split,
                       const Scene<2> &) {
                      const Bolt<2> &bolt = bolts[0];
                      BOOST_TEST(bolt.crossings.empty());
                      const unsigned int layer =
                        split.block_of_cell[bolt.rock[10].cell];
                      for (const CellPoint<2> &point : bolt.rock)
                        BOOST_TEST(split.block_of_cell[point.cell] == layer);
                    });
    }
}

// Bolts that are put where a block has been taken away are told of.
BOOST_AUTO_TEST_CASE(bolt_where_a_block_has_gone)
{
  for (const auto &[head, is_in_void] :
       {std::make_pair("5, 8", false), {"5, 7.999", true}})
    with_bolts<2>(
      "  set Heads = " + std::string(head) +
        "; 4.5, 8.1\n  set Ends = 5, 9; 4.5, 9.1\n  set Pretension = 100\n"
        "  set Plate strength = 1e5\n",
      beds,
      [&, is_cut = is_in_void](const std::vector<Bolt<2>> &bolts,
                               SplitMesh<2> split,
                               const Scene<2> &scene) {
        split.bolts = bolts;
        std::vector<bool> is_removed(split.mesh.n_cells(), false);
        const CellLocator<2> cells(split.mesh,
                                   [](const unsigned int) { return true; });
        is_removed[split.block_of_cell[cells.find({5., 7.5}).cell]] = true;
        const auto warnings = warnings_of_bolts_in_void(
          Ground<2>{scene, split, scene.stage_number("dig"), &is_removed});
        BOOST_REQUIRE(warnings.size() == (is_cut ? 1u : 0u));
        if (is_cut)
          BOOST_TEST(warnings[0].find("1 of the 2 bolts of 'bar'") == 0u);
      });
}

BOOST_AUTO_TEST_SUITE_END()

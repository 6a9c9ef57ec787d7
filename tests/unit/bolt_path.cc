// SPDX-License-Identifier: LGPL-2.1-or-later
// Where bolts cross joints and voids, and what of them is in which rock.
#include <boost/test/unit_test.hpp>

#include "bolted_cavern.h"

#include <keyblock/mesh/cell_locator.h>
#include <keyblock/rock/bolt_chain.h>
#include <keyblock/run/bolt_warnings.h>

#include <array>
#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(bolt_path)

using namespace Keyblock;

namespace
{
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
} // namespace

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
  BOOST_TEST(std::abs(bolts[0].at(crossing.begin)[1] - 8.) < 1e-12);
  BOOST_TEST(crossing.joint == 0u);
  BOOST_TEST(std::abs(crossing.normal[1] - 1.) < 1e-12);
  BOOST_TEST(crossing.block[0] != crossing.block[1]);
}

// Blocks that part pull a bolt by sqrt(E A K) tanh(length / decay length) on
// either side over the elongation, both in series: of stiff grout, too, and
// wherever the joint is.
BOOST_AUTO_TEST_CASE(bolt_is_stiff_where_blocks_part)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0., 1.);
  for (unsigned int i = 0; i < 12; ++i)
    {
      const double grout = std::pow(10., 6.5 + 3.5 * any(random)),
                   top   = 8.3 + any(random);
      with_bolts<2>(
        "  set Heads = 5, 7\n  set Ends = 5.1, " + std::to_string(top) +
          "\n  set Bond stiffness = " + std::to_string(grout) +
          "\n  set Bond strength = 1e12\n  set Yield force = 1e12\n",
        "subsection Joints\n set Names = bed\n subsection bed\n"
        "  set Point = 0, 8\n  set Dip = 0\n end\nend\n",
        [&](const std::vector<Bolt<2>> &bolts,
            const SplitMesh<2> &split,
            const Scene<2> &scene) {
          const Bolt<2> &bolt = bolts[0];
          BoltChain chain(properties_of(*scene.bolts[0]), bolt.places);
          const BoltRemains remains =
            find_remains(bolt, Ground<2>{scene, split, 2});
          chain.set_ground(remains.is_held, remains.is_cut, remains.grout);
          const double joint = bolt.crossings[0].begin, opening = 1e-6;
          std::vector<double> rock;
          for (const double place : bolt.places)
            rock.push_back(place > joint ? opening : 0.);
          chain.follow(rock.data());
          const double decay = std::sqrt(2e7 / grout),
                       below = std::tanh(joint / decay),
                       above = std::tanh((bolt.length() - joint) / decay),
                       exact = std::sqrt(2e7 * grout) * opening /
                               (1. / below + 1. / above);
          const double force = chain.axial_force_of(chain.segment_at(joint));
          BOOST_TEST(std::abs(force / exact - 1.) < 0.015);
          BOOST_TEST(bolt.places.size() < 200u);
          BOOST_TEST(warnings_of_coarse_bolts(scene, split).empty());
        });
    }
}

// The bed of 0.02 m is thin beside segments, wherever they end.
BOOST_AUTO_TEST_CASE(bolt_crosses_a_thin_bed)
{
  const std::string thin_bed =
    "subsection Mesh\n set Cells = 10, 500\nend\n"
    "subsection Joints\n set Names = low, high\n subsection low\n"
    "  set Point = 0, 8\n  set Dip = 0\n end\n subsection high\n"
    "  set Point = 0, 8.02\n  set Dip = 0\n end\nend\n";
  for (const std::string segment : {"0", "0.3", "0.7", "1.1", "3"})
    for (const std::string end : {"9.1", "9.37", "9.5", "9.83"})
      with_bolts<2>("  set Heads = 5.1, 7\n  set Ends = 5.6, " + end +
                      "\n  set Segment length = " + segment + "\n",
                    thin_bed,
                    [&](const std::vector<Bolt<2>> &bolts,
                        const SplitMesh<2> &split,
                        const Scene<2> &scene) {
                      const Bolt<2> &bolt = bolts[0];
                      BOOST_REQUIRE(bolt.crossings.size() == 2u);
                      const double height = bolt.direction()[1];
                      for (const unsigned int k : {0u, 1u})
                        {
                          const BoltCrossing<2> &crossing = bolt.crossings[k];
                          BOOST_TEST(crossing.joint == k);
                          BOOST_TEST(!crossing.is_void());
                          BOOST_TEST(std::abs(crossing.begin * height -
                                              (k == 0 ? 1. : 1.02)) < 1e-12);
                        }
                      const BoltRemains remains = find_remains(
                        bolt,
                        Ground<2>{scene, split, scene.stage_number("dig")});
                      double in_bed = 0.;
                      for (unsigned int i = 0; i < bolt.places.size(); ++i)
                        if (std::abs(bolt.at(bolt.places[i])[1] - 8.01) < 0.009)
                          in_bed += remains.grout[i][1] - remains.grout[i][0];
                      BOOST_TEST(std::abs(in_bed * height - 0.02) < 1e-12);
                    });
}

// From the block under a level joint through the cavern into that above.
BOOST_AUTO_TEST_CASE(bolt_crosses_a_void)
{
  const auto bolts =
    bolts_of<2>("  set Heads = 2, 4.2; 2, 5.6\n  set Ends = 8, 6.8; 8, 6.8\n",
                "subsection Joints\n set Names = bed\n subsection bed\n"
                "  set Point = 0, 5.5\n  set Dip = 0\n end\nend\n");
  BOOST_REQUIRE(bolts.size() == 2u);
  // the other one goes on in the same block
  BOOST_TEST(bolts[1].crossings.empty());
  BOOST_REQUIRE(bolts[0].crossings.size() == 1u);
  const BoltCrossing<2> &crossing = bolts[0].crossings[0];
  BOOST_TEST(crossing.is_void());
  BOOST_TEST(std::abs(bolts[0].at(crossing.begin)[0] - 3.) < 1e-12);
  BOOST_TEST(std::abs(bolts[0].at(crossing.end)[0] - 7.) < 1e-12);
  BOOST_TEST(crossing.block[0] != crossing.block[1]);
  BOOST_TEST(crossing.normal.norm() == 0.);
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

// All of a bolt's length is that of the grout of one node, however it is
// divided.
BOOST_AUTO_TEST_CASE(bolt_grout_is_as_long_as_the_bolt)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0., 1.);
  std::string heads, ends;
  for (unsigned int i = 0; i < 60; ++i)
    {
      const std::string separator = i == 0 ? "" : "; ";
      heads += separator + std::to_string(3.5 + 3. * any(random)) + ", 7";
      ends += separator + std::to_string(3.5 + 3. * any(random)) + ", " +
              std::to_string(7.2 + 2.5 * any(random));
    }
  const std::string place =
    "  set Heads = " + heads + "\n  set Ends = " + ends + "\n";
  for (const std::string segment : {"0", "0.05", "0.27", "0.1", "0.031"})
    with_bolts<2>(
      place + "  set Segment length = " + segment + "\n",
      "",
      [&](const std::vector<Bolt<2>> &bolts,
          const SplitMesh<2> &split,
          const Scene<2> &scene) {
        BOOST_REQUIRE(bolts.size() == 60u);
        for (const Bolt<2> &bolt : bolts)
          {
            const BoltRemains remains =
              find_remains(bolt,
                           Ground<2>{scene, split, scene.stage_number("dig")});
            double length = 0.;
            for (const auto &grout : remains.grout)
              length += grout[1] - grout[0];
            BOOST_TEST(std::abs(length / bolt.length() - 1.) < 1e-12);
          }
      });
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
        const double slope = bolt.length() / 2.5, near = 1e-9;
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

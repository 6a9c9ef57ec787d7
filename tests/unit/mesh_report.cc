// SPDX-License-Identifier: LGPL-2.1-or-later
// What is printed of joints in the mesh.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/mesh/report_warnings.h>
#include <keyblock/scene/text.h>

#include <sstream>

BOOST_AUTO_TEST_SUITE(mesh_report)

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(one_block_that_went_to_its_neighbours)
{
  const SceneInMemory memory("set Dimension = 2\n"
                             "subsection Domain\n  set Size = 20, 20\nend\n"
                             "subsection Mesh\n  set Cells = 2, 2\nend\n"
                             "subsection Joints\n  set Names = a\nend\n"
                             "subsection Materials\n  set Names = rock\nend\n");
  Scene<2> scene;
  scene.read(world, memory.name(), {});
  MeshReport<2> report;
  report.way        = "cut";
  report.area_ratio = 0.9;
  const auto text   = [&](const unsigned int n) {
    report.n_lost_blocks = n;
    std::ostringstream out;
    print_mesh_report(out, report, scene);
    for (const std::string &warning : warnings_of_mesh_report(report, scene))
      out << warning << '\n';
    return out.str();
  };
  const auto has = [](const std::string &all, const std::string &part) {
    return all.find(part) != std::string::npos;
  };
  BOOST_TEST(has(text(1), "0.9 of their length in the mean"));
  BOOST_TEST(!has(text(1), "Finite joints have"));
  for (const double ratio : {1.92, 0.5})
    {
      report.area_ratio = ratio;
      BOOST_TEST(has(text(1),
                     ratio > 1. ? "Finite joints have 1.92 of their length"
                                : "Finite joints have 0.5 of their length"));
    }
  report.area_ratio = 0.9;
  BOOST_TEST(has(text(1), "1 block smaller than a fifth"));
  BOOST_TEST(has(text(1), "to its neighbours, of 0 m2"));
  BOOST_TEST(has(text(1), "to keep it.\n"));
  BOOST_TEST(has(text(2), "2 blocks smaller than a fifth"));
  BOOST_TEST(has(text(2), "to keep them.\n"));
  // each of those at an excavation
  report.lost_exposed.push_back({0.25, {1., 2.}});
  BOOST_TEST(
    has(text(1),
        "to keep it. It is at an excavation, where it may fall, and is "
        "not judged.\n"));
  report.lost_exposed.push_back({0.5, {3., 4.}});
  BOOST_TEST(
    has(text(3), "and not judged: 0.5 m2 at (3, 4) m; 0.25 m2 at (1, 2) m.\n"));
}

BOOST_AUTO_TEST_SUITE_END()

// SPDX-License-Identifier: LGPL-2.1-or-later
// What is dug, when joints lie on the faces of excavations.
#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/exact_blocks.h>

#include <cmath>
#include <fstream>
#include <map>

#include "world.h"

BOOST_AUTO_TEST_SUITE(excavation_marks)

using namespace Keyblock;

namespace
{
  /** Area or volume that each stage digs, by its number, 2 for the first [m2,
   * m3]. */
  template <int dim>
  std::map<unsigned int, double>
  dug_by_stage(const std::string &sections)
  {
    const std::string name =
      "excavation_marks_" + std::to_string(world.size()) + ".prm";
    if (world.is_root())
      std::ofstream(name)
        << "set Dimension = " << dim << "\nsubsection Domain\n set Corner = "
        << (dim == 2 ? "-15, -10" : "-15, -4, -10")
        << "\n set Size = " << (dim == 2 ? "36, 24" : "36, 8, 24")
        << "\nend\nsubsection Mesh\n set Generator = gmsh\n set Size = 3\n"
           " set Size at excavation = 1.5\nend\nsubsection Materials\n"
           " set Names = rock\nend\nsubsection Stages\n"
           " set Names = first, second\n subsection first\n"
           "  set Duration = 1\n end\n subsection second\n"
           "  set Duration = 1\n end\nend\n"
        << sections;
    MPI_Barrier(world);
    Scene<dim> scene;
    scene.read(world, name, {});
    std::unique_ptr<ExactBlocks<dim>> exact;
    auto [mesh, blocks] =
      make_mesh_for_blocks<dim>(world, scene, exact, silent);
    std::map<unsigned int, double> dug;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      dug[mesh.excavation_stage[c]] += mesh.cell_volume(c);
    return dug;
  }

  /** A joint, infinite or not. */
  std::string
  joint(const std::string &entries)
  {
    return "subsection Joints\n set Names = joint\n subsection joint\n" +
           entries + " end\nend\n";
  }

  /** A rectangle of 6 x 7 m in two benches. */
  const std::string benches =
    "subsection Excavations\n set Names = hall\n subsection hall\n"
    "  set Shape = rectangle\n  set Width = 6\n  set Height = 7\n"
    "  set Stage = first\n  set Bench levels = 3\n"
    "  set Bench stages = second\n";

  /** A hall of 6 x 7 m, and a drift of 12 x 4 m that meets it and is dug
   * first. */
  const std::string hall_and_drift =
    "subsection Excavations\n set Names = hall, drift\n subsection hall\n"
    "  set Shape = box\n  set Corner = -3, 0\n  set Size = 6, 7\n"
    "  set Stage = second\n end\n subsection drift\n  set Shape = box\n"
    "  set Corner = 0, 0\n  set Size = 12, 4\n  set Stage = first\n end\nend\n";
} // namespace

BOOST_AUTO_TEST_CASE(joints_on_benches_let_them_be_dug)
{
  for (const std::string level : {"0", "3", "7", "5"})
    {
      const auto dug = dug_by_stage<2>(
        benches + " end\nend\n" + joint("  set Point = 0, " + level + "\n"));
      BOOST_TEST(std::abs(dug.at(2) - 24.) < 1e-6, "joint at " << level);
      BOOST_TEST(std::abs(dug.at(3) - 18.) < 1e-6, "joint at " << level);
      const auto dug_3d =
        dug_by_stage<3>(benches + "  set From = -4\n  set To = 4\n end\nend\n" +
                        joint("  set Point = 0, 0, " + level + "\n"));
      BOOST_TEST(std::abs(dug_3d.at(2) - 8. * 24.) < 1e-6,
                 "joint at " << level);
      BOOST_TEST(std::abs(dug_3d.at(3) - 8. * 18.) < 1e-6,
                 "joint at " << level);
    }
}

BOOST_AUTO_TEST_CASE(a_joint_on_a_roof_keeps_nothing_from_being_dug)
{
  // on a part of the drift's roof, on a part of the hall's wall, on both
  for (const std::string vertices :
       {"5, 4; 9, 4", "-3, 2; -3, 9", "1, 4; 14, 4"})
    {
      const auto dug = dug_by_stage<2>(
        hall_and_drift +
        joint("  set Extent = polygon\n  set Vertices = " + vertices + "\n"));
      BOOST_TEST(std::abs(dug.at(2) - 48.) < 1e-6, vertices);
      BOOST_TEST(std::abs(dug.at(3) - 30.) < 1e-6, vertices);
    }
}

// the polygon has the area of the circle; what its chords cut off, or reach
// beyond, is within 0.15 % of the radius
BOOST_AUTO_TEST_CASE(a_circle_is_dug_in_benches)
{
  const std::string circle =
    "subsection Excavations\n set Names = tunnel\n subsection tunnel\n"
    "  set Shape = circle\n  set Radius = 5\n  set Segments = 24\n"
    "  set Stage = first\n  set Bench levels = 2\n"
    "  set Bench stages = second\n";
  const double area  = 25. * dealii::numbers::PI;
  const double angle = std::acos(0.4); // half of the arc above the level
  const double above = 25. * (angle - 0.4 * std::sin(angle));
  const double error = 1.5e-3 * 2. * 25. * angle;
  const auto check   = [&](const auto &dug, const double length) {
    BOOST_TEST(std::abs(dug.at(2) - above * length) < error * length);
    BOOST_TEST(std::abs(dug.at(2) + dug.at(3) - area * length) <
               1e-9 * area * length);
  };
  check(dug_by_stage<2>(circle + " end\nend\n"), 1.);
  check(dug_by_stage<3>(circle + "  set From = -4\n  set To = 4\n end\nend\n"),
        8.);
}

BOOST_AUTO_TEST_SUITE_END()

// SPDX-License-Identifier: LGPL-2.1-or-later
// Joints of a scene from names, table and sets, and what overrides them.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/joints.h>
#include <keyblock/scene/network_output.h>
#include <keyblock/scene/scene.h>

#include <chrono>
#include <fstream>
#include <sstream>

BOOST_AUTO_TEST_SUITE(scene_joints)

using namespace Keyblock;

namespace
{
  /** Names of files that no other number of ranks has. */
  std::string
  own(const std::string &name)
  {
    return "joints_" + std::to_string(world.size()) + "_" + name;
  }

  void
  write(const std::string &name, const std::string &content)
  {
    MPI_Barrier(world);
    if (world.is_root())
      std::ofstream(own(name), std::ios::binary) << content;
    MPI_Barrier(world);
  }

  /** A scene in a box of 20 m with this in the place of its joints. */
  void
  write_scene(const std::string &joints)
  {
    write("scene.prm",
          "set Dimension = 3\nsubsection Domain\n set Size = 20, 20, 20\n set "
          "Origin = 100, 0, 0\nend\nsubsection Mesh\n set Generator = "
          "gmsh\nend\nsubsection Materials\n set Names = rock\nend\n" +
            joints);
  }

  std::unique_ptr<Scene<3>>
  read(const std::vector<std::string> &overrides = {},
       const std::string &name                   = "scene.prm")
  {
    auto scene = std::make_unique<Scene<3>>();
    scene->read(world, own(name), overrides);
    return scene;
  }

  const std::string table = "name,set,dip,dip direction,x,y,z,radius,friction\n"
                            "a,A,60,30,103.1,4,5,2.7,20\n"
                            "b,A,61,31,104,5,6,3,\n"
                            "c,,62,32,105,6,7,3.3,\n";

  std::string
  scene_of_all()
  {
    return "subsection Joints\n set Names = plane # a comment\n set File = " +
           own("table.csv") +
           "\n subsection plane\n  set Point = 10, 10, 10\n  set Set = A\n "
           "end\n subsection b\n  set Cohesion = 1e4\n end\n"
           "end\nsubsection Joint sets\n set Names = A, S\n subsection A\n  "
           "set Friction angle = 25\n end\n subsection S\n  set Dip = 10\n  "
           "set Dip direction = 200\n  set Concentration = 30\n  set P32 = "
           "0.05\n  set Radius law = exponential\n  set Radius mean = 2.5\n  "
           "set Friction angle = 33\n end\nend\n";
  }

  const Joint<3> &
  joint(const Scene<3> &scene, const std::string &name)
  {
    const auto found = scene.joints_called(name);
    BOOST_REQUIRE(found.size() == 1u);
    return *scene.joints[found[0]];
  }

  std::string
  content_of(const std::string &name)
  {
    std::ostringstream text;
    text << std::ifstream(name).rdbuf();
    return text.str();
  }

  void
  check_refused(const std::vector<std::string> &overrides,
                const std::string &part)
  {
    std::string message;
    try
      {
        read(overrides);
      }
    catch (const InputError &error)
      {
        message = error.message;
      }
    BOOST_TEST(message.find(part) != std::string::npos,
               "'" << message << "' has not '" << part << "'");
    BOOST_TEST(message.find('\n') == std::string::npos);
  }
} // namespace

BOOST_AUTO_TEST_CASE(joints_of_all_sources)
{
  write("table.csv", table);
  write_scene(scene_of_all());
  const auto scene = read();
  BOOST_REQUIRE(scene->joints.size() > 10u);
  BOOST_TEST(scene->joints[0]->name == "plane");
  BOOST_TEST(scene->joints[1]->name == "a");
  BOOST_TEST(scene->joints[4]->name == "S.1");
  BOOST_TEST(scene->joints_called("A").size() == 3u);
  BOOST_TEST(scene->joints_called("S").size() == scene->joints.size() - 4);
  BOOST_TEST(scene->joints_called("nothing").empty());

  BOOST_TEST(joint(*scene, "plane").friction_angle == 25.); // of the set
  BOOST_TEST(joint(*scene, "a").friction_angle == 20.);     // of the row
  BOOST_TEST(joint(*scene, "b").friction_angle == 25.);
  BOOST_TEST(joint(*scene, "b").cohesion == 1e4); // of the subsection
  BOOST_TEST(joint(*scene, "b").dip == 61.);
  BOOST_TEST(joint(*scene, "c").friction_angle == 30.);
  BOOST_TEST(joint(*scene, "c").point[0] == 5.); // 105 - 100
  BOOST_TEST(joint(*scene, "S.1").friction_angle == 33.);
}

BOOST_AUTO_TEST_CASE(overrides_by_pattern)
{
  write("table.csv", table);
  write_scene(scene_of_all());
  const auto friction = [](const std::vector<std::string> &overrides,
                           const std::string &name) {
    return joint(*read(overrides), name).friction_angle;
  };
  const std::string all = "Joints/*/Friction angle=35";
  for (const std::string name : {"plane", "a", "b", "c", "S.1", "S.2"})
    BOOST_TEST(friction({all}, name) == 35.);
  const std::string set = "Joints/A/Friction angle=36";
  for (const std::string name : {"plane", "a", "b"})
    BOOST_TEST(friction({all, set}, name) == 36.);
  BOOST_TEST(friction({all, set}, "c") == 35.);
  BOOST_TEST(friction({set, all}, "a") == 35.); // the last one counts
  const std::string begin = "Joints/S.*/Friction angle=37";
  BOOST_TEST(friction({begin}, "S.2") == 37.);
  BOOST_TEST(friction({begin}, "c") == 30.);
  BOOST_TEST(friction({"Joints/c/Set=A"}, "c") == 25.);
  BOOST_TEST(friction({"Joint sets/A/Friction angle=26"}, "b") == 26.);
}

BOOST_AUTO_TEST_CASE(used_entries_give_the_same_joints)
{
  write("table.csv", table);
  write_scene(scene_of_all());
  const auto scene = read({"Joints/c/Normal=1, 2, 3",
                           "Joints/a/Dilation angle=7",
                           "Joints/b/Law=slip weakening",
                           "Joints/b/Slip distance=0.02",
                           "Joints/b/Residual friction angle=11"});
  if (world.is_root())
    scene->write_used(own("used.prm"));
  MPI_Barrier(world);
  write("table.csv", "is not looked at\n");
  const auto again = read({}, "used.prm");
  BOOST_TEST(again->used_entries() == scene->used_entries());
  BOOST_REQUIRE(again->joints.size() == scene->joints.size());
  for (unsigned int j = 0; j < scene->joints.size(); ++j)
    {
      const Joint<3> &one = *scene->joints[j], &other = *again->joints[j];
      BOOST_TEST(one.name == other.name);
      BOOST_TEST(one.set == other.set);
      BOOST_TEST(one.dip == other.dip);
      BOOST_TEST(one.dip_direction == other.dip_direction);
      BOOST_TEST((one.point == other.point));
      BOOST_TEST(one.radius == other.radius);
      BOOST_TEST(one.friction_angle == other.friction_angle);
      BOOST_TEST(one.law == other.law);
      BOOST_TEST(one.law_values == other.law_values);
    }
  if (world.is_root())
    again->write_used(own("used_again.prm"));
  MPI_Barrier(world);
  BOOST_TEST(content_of(own("used_again.prm")) == content_of(own("used.prm")));
}

// what a checkpoint is compared by
BOOST_AUTO_TEST_CASE(used_entries_see_the_table)
{
  write("table.csv", table);
  write_scene(scene_of_all());
  const std::string before = read()->used_entries();
  BOOST_TEST(read()->used_entries() == before);
  std::string changed = table;
  changed.replace(changed.find("2.7"), 3, "2.8");
  write("table.csv", changed);
  BOOST_TEST(read()->used_entries() != before);
}

BOOST_AUTO_TEST_CASE(refused_joints)
{
  write("table.csv", table);
  write_scene(scene_of_all());
  check_refused({"Joints/x*/Cohesion=0"}, "matches no joint and no set");
  check_refused({"Joints/a/Cohesoin=0"}, "Cohesoin");
  check_refused({"Joints/a/Dip=100"}, "100");
  check_refused({"Joints/Names=plane, a"}, "whose name stands before");
  check_refused({"Joints/Names=plane, S"}, "the name of a set too");
  BOOST_TEST(!read()->joints_called("plane").empty());
  BOOST_TEST(read({"Joints/Names="})->joints_called("plane").empty());
  check_refused({"Joints/a/Tensile strength=1"},
                "Line 2 of the table '" + own("table.csv") +
                  "': the entry 'Joints/a/Tensile strength' is 1 Pa, beyond");
  check_refused({"Joint sets/A/Residual cohesion=1"}, "Residual cohesion");
  check_refused({"Safety factor/Joints=X"}, "names 'X'");
  check_refused({"Check/Joint=A"}, "a set of 3 joints");
  check_refused({"Joint sets/S/Spacing=1"}, "more than one of");
  check_refused({"Joint sets/S/P32=1e9"}, "a million is the most");
  check_refused({"Joint sets/S/Radius mean=0"}, "Radius mean");
  check_refused({"Joint sets/S/Radius minimum=50"}, "Radius maximum");
  check_refused({"Joint sets/S/Region size=1, 2, 3"}, "Region corner");
  check_refused({"Joint sets/S/Spacing law=constant"}, "infinite joints");
  check_refused({"Joint sets/S/Radius law=power law"}, "Radius minimum");
  check_refused({"Domain/Size=20, 20"}, "'Domain/Size' has 2");
  read({"Safety factor/Joints=A, S, c"});
}

BOOST_AUTO_TEST_CASE(written_network_is_read_again)
{
  // (coordinates in the grid of an origin are rounded there)
  const std::string origin                            = "Domain/Origin=0, 0, 0";
  const std::vector<std::vector<std::string>> choices = {
    {},
    {"Joints/b/Dilation angle=7"},
    {"Joints/a/Dilation angle=5",
     "Joints/a/Dilation slip=0.01",
     "Joints/c/Law=slip weakening",
     "Joints/c/Slip distance=0.02",
     "Joints/c/Residual friction angle=11"}};
  for (auto entries : choices)
    {
      write("table.csv", table);
      write_scene(scene_of_all());
      entries.insert(entries.begin(),
                     {origin, "Joints/b/Water pressure=9810*(20-z)"});
      const auto scene = read(entries);
      if (world.is_root())
        write_joint_table(own("written.csv"), *scene);
      MPI_Barrier(world);
      write_scene("subsection Joints\n set File = " + own("written.csv") +
                  "\nend\n");
      const auto again = read({origin});
      BOOST_TEST(print_joints(again->joints) == print_joints(scene->joints));
      for (unsigned int j = 0; j < scene->joints.size(); ++j)
        BOOST_TEST(again->joints[j]->law_values ==
                   scene->joints[j]->law_values);
    }
}

// a second for 10,000 rows would be slow; on a loaded machine it takes 0.3 s
BOOST_AUTO_TEST_CASE(ten_thousand_rows)
{
  std::string rows = "dip,dip direction,x,y,z,radius,friction,cohesion\n";
  for (unsigned int i = 0; i < 10000; ++i)
    rows += exact_text(i % 90) + ",30,1" + exact_text(i % 17) + ",5,6,3,30,0\n";
  write("table.csv", rows);
  write_scene("subsection Joints\n set File = " + own("table.csv") +
              "\n subsection J7\n  set Friction angle = 20\n end\nend\n");
  const auto start = std::chrono::steady_clock::now();
  const auto scene = read({"Joints/*/Cohesion=5"});
  const std::chrono::duration<double> seconds =
    std::chrono::steady_clock::now() - start;
  BOOST_TEST_MESSAGE("10,000 rows in " << seconds.count() << " s");
  BOOST_TEST(scene->joints.size() == 10000u);
  BOOST_TEST(joint(*scene, "J7").friction_angle == 20.);
  BOOST_TEST(joint(*scene, "J10000").cohesion == 5.);
  BOOST_TEST(seconds.count() < 20.);

  const auto start_again = std::chrono::steady_clock::now();
  if (world.is_root())
    scene->write_used(own("used.prm"));
  MPI_Barrier(world);
  const auto again = read({}, "used.prm");
  const std::chrono::duration<double> more =
    std::chrono::steady_clock::now() - start_again;
  BOOST_TEST_MESSAGE("written and read again as entries in " << more.count()
                                                             << " s");
  BOOST_TEST(again->joints.size() == 10000u);
  BOOST_TEST(again->joints_called("J7").size() == 1u);
  BOOST_TEST(more.count() < 20.);
}

BOOST_AUTO_TEST_CASE(extents_that_follow)
{
  const auto written = [](const std::string &entries) {
    write_scene("subsection Joints\n set Names = J\n subsection J\n" + entries +
                " end\nend\n");
  };
  const std::string corners = "0, 0, 0; 5, 0, 1; 0, 5, 2";
  const auto extent = [](const std::vector<std::string> &overrides = {}) {
    const auto scene = read(overrides);
    if (world.is_root())
      scene->write_used(own("used.prm"));
    MPI_Barrier(world);
    const auto again = read({}, "used.prm");
    BOOST_TEST(print_joints(again->joints) == print_joints(scene->joints));
    return scene->joints.at(0)->extent;
  };
  written("  set Vertices = " + corners + "\n");
  BOOST_TEST((extent() == JointShape::polygon));
  BOOST_TEST((extent({"Joints/J/Normal=-1, -2, 5"}) == JointShape::polygon));
  BOOST_TEST((extent({"Joints/J/Point=5, 5, 3"}) == JointShape::polygon));
  // without the corners nothing says where the joint is
  for (const char *shape : {"infinite", "disc"})
    check_refused({std::string("Joints/J/Extent=") + shape},
                  "entry 'Joints/J/Vertices' is given");
  BOOST_TEST((extent({"Joints/J/Vertices=", "Joints/J/Extent=infinite"}) ==
              JointShape::infinite));
  BOOST_TEST(
    (extent({"Joints/J/Vertices=", "Joints/J/Dip=5"}) == JointShape::infinite));
  check_refused({"Joints/J/Radius=2"}, "both 'Vertices' and 'Radius'");
  check_refused({"Joints/J/Dip=2"}, "entry 'Joints/J/Dip' is given");
  check_refused({"Joints/J/Point=5, 5, 4"}, "off their plane");
  written("  set Radius = 3\n  set Dip = 40\n  set Point = 1, 2, 3\n");
  BOOST_TEST((extent() == JointShape::disc));
  BOOST_TEST((extent({"Joints/J/Normal=1, 1, 1"}) == JointShape::disc));
  BOOST_TEST((extent({"Joints/J/Radius=0"}) == JointShape::infinite));
  BOOST_TEST((extent({"Joints/J/Extent=polygon",
                      "Joints/J/Vertices=" + corners}) == JointShape::polygon));
  check_refused({"Joints/J/Extent=infinite", "Joints/J/Radius=2"},
                "the extent of the joint is infinite");
  check_refused({"Joints/J/Normal=1, 1, 1", "Joints/J/Dip=2"},
                "entry 'Joints/J/Dip' is given");
  written("  set Normal = 1, 1, 1\n  set Dip = 40\n");
  check_refused({}, "entry 'Joints/J/Dip' is given");
  written("  set Extent = infinite\n  set Radius = 4\n");
  check_refused({}, "entry 'Joints/J/Radius' is given");

  // of tables, too
  write("table.csv", "name,dip,dip direction,x,y,z\nJ,60,30,103,4,5\n");
  write_scene("subsection Joints\n set File = " + own("table.csv") + "\nend\n");
  BOOST_TEST((extent({"Joints/J/Radius=2"}) == JointShape::disc));
  BOOST_TEST((extent({"Joints/J/Dip=2"}) == JointShape::infinite));
}

BOOST_AUTO_TEST_CASE(overrides_of_used_scenes)
{
  write("table.csv", table);
  write_scene(scene_of_all());
  const auto scene = read({"Joints/c/Normal=1, 2, 3"});
  if (world.is_root())
    scene->write_used(own("scene.prm"));
  MPI_Barrier(world);
  check_refused({"Joint sets/S/Friction angle=10"},
                "set 'Joints/S/Friction angle' for those of the set");
  check_refused({"Joint sets/S/P32=1"}, "run the original scene");
  check_refused({"Joint sets/Names="}, "are already made in this scene");
  check_refused({"Joints/File=" + own("table.csv")}, "already written out");
  check_refused({"Joints/c/Dip=3"}, "'Normal' says how the joint lies");
  check_refused({"Joints/plane/Radius=3"}, "is infinite");
  BOOST_TEST(joint(*read({"Joints/a/Dip=3"}), "a").dip == 3.);
  const auto weaker = read({"Joints/S/Friction angle=10"});
  for (const auto &each : weaker->joints)
    BOOST_TEST((each->friction_angle == 10.) == (each->set == "S"));
}

BOOST_AUTO_TEST_SUITE_END()

// SPDX-License-Identifier: LGPL-2.1-or-later
// What the variables of a study set: entries that there are, each only once.
#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/scene/study_entries.h>
#include <keyblock/scene/text.h>

#include "world.h"

using namespace Keyblock;

namespace
{
  /** Joints of a set, one of them with a strength of its own, one that is in
   * no set, and a set that is made. */
  const std::string text = R"(
set Dimension = 2
subsection Domain
  set Size = 20, 20
end
subsection Mesh
  set Generator = gmsh
end
subsection Materials
  set Names = rock
end
subsection Joint sets
  set Names = A, S
  subsection A
    set Friction angle = 25
  end
  subsection S
    set Dip = 40
    set P21 = 0.1
    set Radius law = constant
    set Radius mean = 3
  end
end
subsection Joints
  set Names = weak, other, lone, bent
  subsection weak
    set Point = 1, 2
    set Set = A
    set Friction angle = 11
  end
  subsection other
    set Point = 3, 4
    set Set = A
  end
  subsection lone
    set Point = 5, 6
  end
  subsection bent
    set Shape = polyline
    set Vertices = 2, 2; 5, 3; 9, 2
  end
end
)";

  std::unique_ptr<Scene<2>>
  read(const std::vector<std::string> &overrides)
  {
    const SceneInMemory memory(text);
    auto scene = std::make_unique<Scene<2>>();
    scene->read(world, memory.name(), overrides);
    return scene;
  }

  /** The scene with a study of these entries: variables v1, v2, ... */
  std::unique_ptr<Scene<2>>
  study_of(const std::vector<std::string> &entries)
  {
    std::string names = "Study/Names=";
    std::vector<std::string> overrides;
    for (const std::string &entry : entries)
      {
        const std::string name = "v" + std::to_string(overrides.size() / 3 + 1);
        names += (overrides.empty() ? "" : ", ") + name;
        for (const std::string &assignment : std::vector<std::string>{
               "Entry=" + entry, "Mean=20", "Deviation=1"})
          overrides.push_back("Study/" + name + "/" + assignment);
      }
    overrides.insert(overrides.begin(), names);
    return read(overrides);
  }

  template <typename Action>
  void
  check_refused(const Action &action, const std::string &part)
  {
    std::string message;
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        message = error.message;
      }
    BOOST_TEST(message.find(part) != std::string::npos,
               "'" << message << "' has not '" << part << "'");
  }
} // namespace



BOOST_AUTO_TEST_CASE(variables_that_set_the_same)
{
  const auto common =
    [](const std::string &a, const std::string &b, const std::string &entry) {
      check_refused(
        [&]() {
          study_of({a, b});
        },
        "'v1' and 'v2' of the study both set '" + entry + "'");
      check_refused([&]() { study_of({b, a}); }, "both set '" + entry + "'");
    };
  common("Joints/lone/Cohesion",
         "Joints/lone/Cohesion",
         "Joints/lone/Cohesion");
  common("Joints/l*/Cohesion", "Joints/lone/Cohesion", "Joints/lone/Cohesion");
  common("Joints/A/Cohesion", "Joints/other/Cohesion", "Joints/other/Cohesion");
  common("Joints/A/Cohesion", "Joints/*/Cohesion", "Joints/weak/Cohesion");
  common("Joints/bent/Cohesion", "Joints/b*/Cohesion", "Joints/bent/Cohesion");
  common("Joints/S.1/Cohesion", "Joints/S/Cohesion", "Joints/S.1/Cohesion");
  common("Joint sets/A/Friction angle",
         "Joints/other/Friction angle",
         "Joints/other/Friction angle");
  common("Joint sets/A/Friction angle",
         "Joints/A/Friction angle",
         "Joints/other/Friction angle");
  common("Joint sets/S/Dip", "Joints/S.1/Dip", "Joints/S.1/Dip");
  common("Materials/rock/Density",
         "Materials/rock/Density",
         "Materials/rock/Density");
  common("Safety factor/Teams",
         "Safety factor/Rank groups",
         "Safety factor/Rank groups");

  for (const auto &[a, b] : std::vector<std::pair<std::string, std::string>>{
         {"Joints/lone/Cohesion", "Joints/lone/Friction angle"},
         {"Joints/lone/Cohesion", "Joints/A/Cohesion"},
         // weak has an angle of its own
         {"Joint sets/A/Friction angle", "Joints/weak/Friction angle"},
         {"Joint sets/A/Friction angle", "Joint sets/S/Friction angle"},
         {"Joint sets/A/Dip", "Joints/other/Dip"},
         {"Materials/rock/Density", "Joint sets/S/Spacing"}})
    BOOST_TEST(study_of({a, b})->study_variables.size() == 2u);
}



BOOST_AUTO_TEST_CASE(entries_and_values_of_variables)
{
  for (const char *entry : {"Joints/lone/Friktion angle",
                            "Joints/nobody/Friction angle",
                            "Joint sets/*/Dip",
                            "Materials/concrete/Density",
                            "Rock/Density"})
    check_refused([&]() { study_of({entry}); },
                  std::string("'Study/v1/Entry' is '") + entry +
                    "', but the scene has no such entry");
  const auto scene = study_of({"Joints/A/Cohesion", "Joint sets/S/P32"});
  check_study_values(*scene, {{0., 3e4}, {0.1, 0.2}});
  check_refused(
    [&]() {
      check_study_values(*scene, {{5., -3., 7.}, {0.1}});
    },
    "The variable 'v1' of the study has the value -3, which the "
    "entry 'Joints/A/Cohesion' does not take; cut its distribution "
    "off by 'Study/v1/Minimum'");
  check_refused(
    [&]() {
      check_study_values(*scene, {{5.}, {-0.1}});
    },
    "entry 'Joint sets/S/P32'");
}



BOOST_AUTO_TEST_CASE(intensity_in_the_plane)
{
  BOOST_TEST(read({"Joint sets/S/P32=0.3"})->joint_sets[1]->intensity == 0.3);
  BOOST_TEST(read({"Joint sets/S/P21=0.2"})->joint_sets[1]->intensity == 0.2);
}

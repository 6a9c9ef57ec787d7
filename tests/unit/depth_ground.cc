// SPDX-License-Identifier: LGPL-2.1-or-later
// What follows from Ground/Depth, entry by entry, where a scene leaves it open.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/scene.h>
#include <keyblock/scene/text.h>

#include <random>

BOOST_AUTO_TEST_SUITE(depth_ground)

using namespace Keyblock;

namespace
{
  /** A box around elevation 0 at a depth of 200 m, with this besides. */
  template <int dim>
  std::string
  text_at_depth(const std::string &more)
  {
    return std::string("set Dimension = ") + (dim == 2 ? "2" : "3") +
           "\nsubsection Domain\n set Corner = " +
           (dim == 2 ? "-20, -30" : "-20, -20, -30") +
           "\n set Size = " + (dim == 2 ? "40, 60" : "40, 40, 60") +
           "\nend\nsubsection Mesh\n set Cells = " +
           (dim == 2 ? "4, 6" : "4, 4, 6") +
           "\nend\nsubsection Ground\n set Depth = 200\nend\nsubsection "
           "Materials\n set Names = rock\n subsection rock\n  set Density = "
           "2500\n end\nend\n" +
           more;
  }

  /** Read a scene; what it uses must be the same scene. */
  template <int dim>
  std::unique_ptr<Scene<dim>>
  read(const std::string &more, const std::vector<std::string> &overrides = {})
  {
    const SceneInMemory text(text_at_depth<dim>(more));
    auto scene = std::make_unique<Scene<dim>>();
    scene->read(world, text.name(), overrides);
    const SceneInMemory used(scene->used_entries());
    Scene<dim> again;
    again.read(world, used.name(), {});
    BOOST_TEST(again.used_entries() == scene->used_entries());
    return scene;
  }

  template <typename Item>
  std::string
  names_of(const std::vector<std::unique_ptr<Item>> &items)
  {
    std::string names;
    for (const auto &item : items)
      names += (names.empty() ? "" : ", ") + item->name;
    return names;
  }

  std::string
  list_of(const std::vector<std::string> &words)
  {
    std::string list;
    for (const std::string &word : words)
      list += (list.empty() ? "" : ", ") + word;
    return list;
  }

  const std::string overburden = exact_text(-9.81 * 2500. * 170.);
} // namespace

// the gravity of the scene, not that of the earth
BOOST_AUTO_TEST_CASE(ground_under_given_gravity)
{
  const auto scene = read<2>("", {"Initial state/Gravity=0; -10"});
  BOOST_TEST(scene->initial_state.vertical_stress_gradient == 10. * 2500.);
  BOOST_REQUIRE(scene->tractions.size() == 1u);
  BOOST_TEST(scene->tractions[0]->expression ==
             "0; " + exact_text(-10. * 2500. * 170.));
}

BOOST_AUTO_TEST_CASE(ground_gives_all_that_is_open)
{
  const auto scene = read<2>("");
  BOOST_TEST(scene->initial_state.gravity == "0; -9.81");
  BOOST_TEST(scene->initial_state.surface_elevation == 200.);
  BOOST_TEST(scene->initial_state.vertical_stress_gradient == 9.81 * 2500.);
  BOOST_TEST(names_of(scene->supports) == "ground below, ground beside");
  BOOST_TEST(list_of(scene->supports[1]->boundaries) == "left, right");
  BOOST_REQUIRE(names_of(scene->tractions) == "overburden");
  BOOST_TEST(scene->tractions[0]->expression == "0; " + overburden);
  BOOST_TEST(list_of(read<3>("")->supports[1]->boundaries) ==
             "left, right, front, back");
}

// ground above the box weighs what it weighs, in it stress grows with the rock
BOOST_AUTO_TEST_CASE(ground_of_another_density_than_the_rock)
{
  const auto scene             = read<2>("", {"Ground/Density=2000"});
  const InitialState<2> &state = scene->initial_state;
  BOOST_TEST(state.surface_elevation == 30.);
  BOOST_TEST(state.surface_stress == 9.81 * 2000. * 170.);
  BOOST_TEST(state.vertical_stress_gradient == 9.81 * 2500.);
  BOOST_TEST(scene->tractions.at(0)->expression ==
             "0; " + exact_text(-9.81 * 2000. * 170.));
  BOOST_TEST(scene->warnings().empty());
}

// a material that has no place left does not count
BOOST_AUTO_TEST_CASE(ground_of_several_materials)
{
  const std::string soft = "subsection Materials\n set Names = rock, soft\n "
                           "subsection soft\n  set Density = 2100\n  set "
                           "Region = ";
  const auto all         = read<2>(soft + "all\n end\nend\n");
  BOOST_TEST(all->initial_state.vertical_stress_gradient == 9.81 * 2100.);
  BOOST_TEST(all->warnings().empty());
  const auto above = read<2>(soft + "y - 10\n end\nend\n");
  BOOST_TEST(above->initial_state.vertical_stress_gradient == 9.81 * 2500.);
  BOOST_REQUIRE(above->warnings().size() == 1u);
  BOOST_TEST(above->warnings()[0].find(
               "'Initial state/Equilibrium' to static") != std::string::npos);
  BOOST_TEST(
    read<2>(soft + "y - 10\n end\nend\n", {"Initial state/Equilibrium=static"})
      ->warnings()
      .empty());
}

BOOST_AUTO_TEST_CASE(ground_keeps_entries_of_the_initial_stress)
{
  const std::string k0 = "Ground/K0=0.8";
  const auto given     = [&](const std::string &entry) {
    return read<2>("subsection Initial state\n set " + entry + "\nend\n", {k0});
  };
  BOOST_TEST(given("Gravity =")->initial_state.lateral_ratios.at(0) == 0.8);
  BOOST_TEST(given("Lateral ratios = 2.5")->initial_state.lateral_ratios[0] ==
             2.5);
  // the default, but it is given
  BOOST_TEST(given("Lateral ratios=1")->initial_state.lateral_ratios[0] == 1.);
  BOOST_TEST(read<2>("", {k0, "Initial state/Lateral ratios=1"})
               ->initial_state.lateral_ratios[0] == 1.);
  const auto higher = given("Surface elevation = 210");
  BOOST_TEST(higher->initial_state.surface_elevation == 210.);
  BOOST_TEST(higher->tractions[0]->expression ==
             "0; " + exact_text(-9.81 * 2500. * 180.));
  const auto loaded = given("Surface stress = 1e5");
  BOOST_TEST(loaded->initial_state.surface_stress == 1e5);
  BOOST_TEST(loaded->initial_state.surface_elevation == 200.);
  BOOST_TEST(loaded->initial_state.vertical_stress_gradient == 9.81 * 2500.);
  BOOST_TEST(loaded->tractions[0]->expression ==
             "0; " + exact_text(-(1e5 + 9.81 * 2500. * 170.)));
  const auto formula = given("Stress = -1e6; -2e6; -1e6; 0");
  BOOST_TEST(formula->initial_state.vertical_stress_gradient == 0.);
  BOOST_TEST(formula->tractions[0]->expression == "0; " + overburden);
}

BOOST_AUTO_TEST_CASE(ground_loads_the_top_unless_it_is_loaded)
{
  const auto tractions = [](const std::string &entries) {
    return names_of(read<2>("subsection Tractions\n set Names = own\n "
                            "subsection own\n" +
                            entries +
                            "  set Traction = 0; 1e5\n end\nend\nsubsection "
                            "Stages\n set Names = dig\n subsection dig\n  set "
                            "Kind = static\n end\nend\n")
                      ->tractions);
  };
  const std::string both = "own, overburden";
  BOOST_TEST(tractions("  set Region = 9 - x*x - y*y\n") == both);
  BOOST_TEST(tractions("  set Boundaries = left\n") == both);
  BOOST_TEST(tractions("  set Boundaries = top\n  set Stage = dig\n") == both);
  BOOST_TEST(tractions("  set Boundaries = top\n") == "own");
  BOOST_TEST(tractions("  set Boundaries = all\n") == "own");
  BOOST_TEST(tractions("  set Region = y - 29.9\n") == "own");
}

BOOST_AUTO_TEST_CASE(ground_ends_at_the_surface_up_to_round_off)
{
  // -20 + 43.465 is above 23.465 by round-off, which loads nothing
  const std::vector<std::string> box = {"Domain/Corner=-20, -20",
                                        "Domain/Size=40, 43.465"};
  const auto with                    = [&box](const std::string &assignment) {
    std::vector<std::string> all = box;
    all.push_back(assignment);
    return all;
  };
  BOOST_TEST(-20. + 43.465 > 23.465);
  BOOST_TEST(read<2>("", with("Ground/Depth=23.465"))->tractions.empty());
  BOOST_CHECK_THROW(read<2>("", with("Ground/Depth=23.4649")), InputError);
}

BOOST_AUTO_TEST_CASE(ground_has_a_free_top_at_the_surface)
{
  const auto sides = [](const std::vector<std::string> &overrides) {
    return list_of(read<2>("", overrides)->domain.truncated_boundaries);
  };
  BOOST_TEST(sides({}) == "all");
  BOOST_TEST(sides({"Ground/Depth=30"}) == "left, right, bottom");
  BOOST_TEST(sides({"Ground/Depth=30.1"}) == "all");
  BOOST_TEST(sides({"Ground/Depth=30", "Domain/Truncated boundaries=top"}) ==
             "top");
  BOOST_TEST(
    list_of(read<3>("", {"Ground/Depth=30"})->domain.truncated_boundaries) ==
    "left, right, front, back, bottom");
}

BOOST_AUTO_TEST_CASE(ground_holds_sides_without_a_support)
{
  // each choice of sides, and at random regions in their places
  std::mt19937 random(7);
  const std::vector<std::string> sides = {
    "left", "right", "front", "back", "bottom"};
  const std::vector<std::string> regions = {
    "-19.99 - x", "x - 19.99", "-19.99 - y", "y - 19.99", "-29.99 - z"};
  for (unsigned int choice = 0; choice < 32; ++choice)
    {
      std::string names, subsections, beside;
      for (unsigned int s = 0; s < 5; ++s)
        if (choice & (1u << s))
          {
            const std::string name = "own " + sides[s];
            names += (names.empty() ? "" : ", ") + name;
            subsections += "subsection " + name + "\n set ";
            subsections += random() % 2 ? "Boundaries = " + sides[s] + "\nend\n"
                                        : "Region = " + regions[s] + "\nend\n";
          }
        else if (s < 4)
          beside += (beside.empty() ? "" : ", ") + sides[s];
      const auto scene = read<3>("subsection Supports\nset Names = " + names +
                                 "\n" + subsections + "end\n");
      std::string found;
      for (const auto &support : scene->supports)
        if (support->name == "ground beside")
          found = list_of(support->boundaries);
      BOOST_TEST(found == beside);
      const bool has_below =
        names_of(scene->supports).find("ground below") != std::string::npos;
      BOOST_TEST(has_below == !(choice & 16u));
    }
  // a name of its own
  const auto scene = read<2>("subsection Supports\n set Names = ground "
                             "beside\n subsection ground beside\n  set "
                             "Boundaries = left\n end\nend\n");
  BOOST_TEST(names_of(scene->supports) ==
             "ground beside, ground below, ground beside 2");
}

BOOST_AUTO_TEST_CASE(ground_holds_shear_along_the_sides)
{
  const auto directions = [](const std::vector<std::string> &overrides) {
    return read<3>("", overrides)->supports.at(1)->directions;
  };
  using D = SupportDirections;
  BOOST_TEST((directions({"Ground/K0=2, 1", "Ground/Azimuth=45"}) == D::xy));
  BOOST_TEST((directions({"Ground/K0=2, 1", "Ground/Azimuth=181"}) == D::xy));
  for (const char *azimuth : {"0", "90", "180", "270", "360"})
    BOOST_TEST(
      (directions({"Ground/K0=2, 1",
                   std::string("Ground/Azimuth=") + azimuth}) == D::normal));
  BOOST_TEST((directions({"Ground/K0=2", "Ground/Azimuth=45"}) == D::normal));
  BOOST_TEST((directions({"Ground/K0=2, 1",
                          "Ground/Azimuth=45",
                          "Initial state/Lateral azimuth=90"}) == D::normal));
  BOOST_TEST((
    directions({"Initial state/Stress=-1e6; -1e6; -1e6; 0; 0; 1e5"}) == D::xy));
  BOOST_TEST((directions({"Initial state/Stress=-1e6; -1e6; -1e6; 0; 0; 0"}) ==
              D::normal));
}

BOOST_AUTO_TEST_SUITE_END()

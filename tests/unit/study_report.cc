// SPDX-License-Identifier: LGPL-2.1-or-later
// What study.json says of blocks.
#include <boost/test/unit_test.hpp>

#include <keyblock/run/study_report.h>
#include <keyblock/scene/text.h>
#include <nlohmann/json.hpp>

#include "world.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(blocks_of_a_study_are_finite_and_have_one_volume)
{
  const SceneInMemory memory("set Dimension = 2\n"
                             "subsection Domain\n  set Size = 20, 20\nend\n"
                             "subsection Mesh\n  set Cells = 2, 2\nend\n"
                             "subsection Materials\n  set Names = rock\nend\n");
  Scene<2> scene;
  scene.read(world, memory.name(), {});
  Blocks<2> blocks;
  blocks.blocks.resize(3);
  for (unsigned int b = 0; b < 3; ++b)
    {
      blocks.blocks[b].id     = b + 1;
      blocks.blocks[b].volume = 10. + b;
    }
  blocks.blocks[0].exact.is_known = true;
  blocks.blocks[0].exact.volume   = 8.;
  blocks.blocks[2].is_infinite    = true;
  SampleResult result;
  result.factors = {0.5, 2., 3.};
  count_failed(blocks, result.factors, 1., result);
  BOOST_TEST(result.failed_volume == 8.);

  const std::vector<std::vector<double>> values;
  const std::vector<SampleResult> results(2, result);
  const StudyReport<2> report(scene, &blocks, values, results, {}, 1., 1., 0);
  const std::string name =
    (std::filesystem::temp_directory_path() /
     ("study_report_" + std::to_string(world.rank()) + ".json"))
      .string();
  BOOST_REQUIRE(report.write(name));
  std::ifstream in(name);
  const auto json = nlohmann::json::parse(in);
  std::filesystem::remove(name);
  BOOST_REQUIRE(json["blocks"].size() == 2u);
  BOOST_TEST(json["blocks"][0]["id"] == 1u);
  BOOST_TEST(json["blocks"][0]["volume"].get<double>() == 8.);
  BOOST_TEST(json["blocks"][1]["volume"].get<double>() == 11.);
  BOOST_TEST(json["failed_volume_per_sample"].get<double>() == 8.);
}

// what holds at the highest factor has no value there
BOOST_AUTO_TEST_CASE(bounds_of_a_study_are_counted_apart)
{
  const SceneInMemory memory("set Dimension = 2\n"
                             "subsection Domain\n  set Size = 20, 20\nend\n"
                             "subsection Mesh\n  set Cells = 2, 2\nend\n"
                             "subsection Materials\n  set Names = rock\nend\n"
                             "subsection Study\n  set Level = full\nend\n");
  Scene<2> scene;
  scene.read(world, memory.name(), {});
  std::vector<SampleResult> results(4);
  results[0].factor    = 2.;
  results[1].factor    = scene.safety.highest;
  results[2].factor    = 4.;
  results[3].factor    = std::numeric_limits<double>::infinity();
  results[1].is_coarse = true;
  const std::vector<std::vector<double>> values;
  const StudyReport<2> report(scene, nullptr, values, results, {}, 1., 1., 0);
  const std::string name =
    (std::filesystem::temp_directory_path() /
     ("study_bounds_" + std::to_string(world.rank()) + ".json"))
      .string();
  BOOST_REQUIRE(report.write(name));
  std::ifstream in(name);
  const auto json = nlohmann::json::parse(in);
  std::filesystem::remove(name);
  BOOST_TEST(json["least_factor"]["samples"] == 2u);
  BOOST_TEST(json["least_factor"]["mean"].get<double>() == 3.);
  BOOST_TEST(json["held_share"].get<double>() == 0.25);
  BOOST_TEST(json["immovable_share"].get<double>() == 0.25);
  const std::string warning = json["warnings"].at(0);
  BOOST_TEST(warning.find("smaller than the cells are lost") !=
             std::string::npos);
  std::ostringstream out;
  report.print(out);
  BOOST_TEST(out.str().find("least factor: mean 3,") != std::string::npos);
  BOOST_TEST(out.str().find("in 1 samples every block holds") !=
             std::string::npos);
}

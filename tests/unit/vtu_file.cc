// SPDX-License-Identifier: LGPL-2.1-or-later
// VTU files as text: places of the numbers, names with marks of XML, times.
#include <keyblock/base/vtu_file.h>

#include "world.h"

#include <boost/test/unit_test.hpp>

#include <zlib.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>

BOOST_AUTO_TEST_SUITE(vtu_file)

using namespace Keyblock;

namespace
{
  std::string
  content_of(const std::string &name)
  {
    std::ifstream in(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /** A file of this rank. */
  std::string
  file_called(const std::string &name)
  {
    return name + "_" + std::to_string(world.rank()) + "_of_" +
           std::to_string(world.size());
  }

  /** The numbers of the element whose text begins with @p begin. */
  template <typename Number>
  std::vector<Number>
  numbers_of(const std::string &content, const std::string &begin)
  {
    const std::string element = content.substr(content.find(begin), 300);
    std::smatch place;
    BOOST_REQUIRE(
      std::regex_search(element, place, std::regex("offset=\"(\\d+)\"")));
    const std::size_t data = content.find("\n_") + 2 + std::stoul(place[1]);
    std::array<std::uint32_t, 4> header;
    std::memcpy(header.data(), &content[data], sizeof(header));
    if (header[0] == 0)
      return {};
    BOOST_TEST(header[0] == 1u);
    std::vector<Number> numbers(header[1] / sizeof(Number));
    uLongf length = header[1];
    BOOST_TEST(uncompress(reinterpret_cast<Bytef *>(numbers.data()),
                          &length,
                          reinterpret_cast<const Bytef *>(
                            &content[data + sizeof(header)]),
                          header[3]) == Z_OK);
    BOOST_TEST(length == header[1]);
    return numbers;
  }
} // namespace

BOOST_AUTO_TEST_CASE(vtu_of_a_hexahedron)
{
  VtuGrid grid;
  VtuArray load = VtuArray::vector("load < \"5\" & more (N)"),
           id   = VtuArray::ids("id");
  std::vector<unsigned int> corners;
  for (unsigned int v = 0; v < 8; ++v)
    {
      const std::array<double, 3> x = {
        {double(v % 2), double(v / 2 % 2), double(v / 4)}};
      corners.push_back(grid.add_point(x, 3));
      load.add_vector(x, 2);
    }
  grid.add_lattice_cell(corners);
  id.add_id(-7);
  grid.point_data        = {load};
  grid.cell_data         = {id, VtuArray::tensor("nothing (Pa)")};
  grid.texts             = {{"id names", {"", "é"}}};
  const std::string name = file_called("hexahedron.vtu");
  BOOST_REQUIRE(write_vtu(grid, name));

  const std::string content = content_of(name);
  BOOST_TEST(content.find("Name=\"load &lt; &quot;5&quot; &amp; more (N)\"") !=
             std::string::npos);
  // around the bottom, then around the top
  const std::vector<std::int32_t> expected = {0, 1, 3, 2, 4, 5, 7, 6};
  BOOST_TEST(numbers_of<std::int32_t>(content,
                                      "<DataArray type=\"Int32\" "
                                      "Name=\"connectivity\"") == expected,
             boost::test_tools::per_element());
  const auto values =
    numbers_of<float>(content, "<DataArray type=\"Float32\" Name=\"load");
  BOOST_REQUIRE(values.size() == 24u);
  for (unsigned int v = 0; v < 8; ++v)
    BOOST_TEST((values[3 * v] == v % 2 && values[3 * v + 1] == v / 2 % 2 &&
                values[3 * v + 2] == 0.f));
  BOOST_TEST(
    numbers_of<std::int32_t>(content, "<DataArray type=\"Int32\" Name=\"id\"")
      .at(0) == -7);
  BOOST_TEST(
    numbers_of<float>(content, "<DataArray type=\"Float32\" Name=\"nothing")
      .empty());
  const auto text =
    numbers_of<unsigned char>(content,
                              "<Array type=\"String\" Name=\"id names\"");
  BOOST_TEST(std::string(text.begin(), text.end()) == std::string("\0é\0", 4));
}

// 32 bits would move these by 0.25 m
BOOST_AUTO_TEST_CASE(vtu_of_points_far_away)
{
  VtuGrid grid;
  const std::array<double, 3> a = {{694200.3, 5391000.7, 1200.1}},
                              b = {{694201.3, 5391003.8, 1200.1}};
  grid.add_lattice_cell({grid.add_point(a, 3), grid.add_point(b, 3)});
  BOOST_TEST(are_far(grid.points));
  grid.is_far            = true;
  const std::string name = file_called("far.vtu");
  BOOST_REQUIRE(write_vtu(grid, name));
  const auto points =
    numbers_of<double>(content_of(name),
                       "<DataArray type=\"Float64\" Name=\"Points");
  BOOST_TEST(points ==
               std::vector<double>({a[0], a[1], a[2], b[0], b[1], b[2]}),
             boost::test_tools::per_element());
  BOOST_TEST(!are_far({0., 0., 0., 10., 5., 0.}));
  BOOST_TEST(!are_far({100., 0., 0., 120., 5., 0.}));
  BOOST_TEST(!are_far({}));
}

BOOST_AUTO_TEST_CASE(vtu_that_cannot_be_written)
{
  BOOST_TEST(!write_vtu(VtuGrid(), "no such folder/grid.vtu"));
  BOOST_TEST(!write_pvtu(VtuGrid(), {}, "no such folder/grid.pvtu"));
  BOOST_TEST(!write_pvd({}, "no such folder/grid.pvd"));
}

BOOST_AUTO_TEST_CASE(states_follow_each_other_in_time)
{
  const std::string name = file_called("states.pvd");
  BOOST_REQUIRE(write_pvd({{0., "a", "rock", "start"},
                           {0., "b", "interface", "start"},
                           {0., "c", "rock", "dig & wait"},
                           {0., "d", "interface", "dig & wait"},
                           {2.5, "e", "rock", "dig & wait"},
                           {2.5, "f", "interface", "dig & wait"}},
                          name));
  const std::string content = content_of(name);
  std::vector<double> times;
  std::string parts;
  const std::regex entry("timestep=\"([^\"]+)\" group=\"(start|dig &amp; wait)"
                         "\" part=\"(\\d)\"");
  for (std::sregex_iterator it(content.begin(), content.end(), entry), end;
       it != end;
       ++it)
    {
      times.push_back(std::stod((*it)[1]));
      parts += (*it)[3];
    }
  BOOST_TEST(parts == "010101");
  BOOST_TEST((times[0] == 0. && times[1] == 0.));
  BOOST_TEST((times[2] > 0. && times[2] < 1e-8 && times[3] == times[2]));
  BOOST_TEST((times[4] == 2.5 && times[5] == 2.5));
}

BOOST_AUTO_TEST_SUITE_END()

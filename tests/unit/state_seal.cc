// SPDX-License-Identifier: LGPL-2.1-or-later
// The seal of state files: what it tells, and that it sees every byte.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/checkpoint/state_file.h>
#include <keyblock/checkpoint/state_seal.h>

#include <cstdio>
#include <fstream>
#include <iterator>

BOOST_AUTO_TEST_SUITE(state_seal)

using namespace Keyblock;

namespace
{
  std::string
  read(const std::string &name)
  {
    std::ifstream file(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /** What check_seal says to @p content, or nothing. */
  std::string
  verdict(const std::string &name, const std::string &content)
  {
    {
      std::ofstream file(name, std::ios::binary);
      file << content;
    }
    try
      {
        check_seal(name);
      }
    catch (const InputError &error)
      {
        return error.message;
      }
    return "";
  }

  bool
  says(const std::string &text, const std::string &fragment)
  {
    return text.find(fragment) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_CASE(digest_of_published_text)
{
  // catalogue of parametrised CRC algorithms, CRC-64/XZ
  const std::string text = "123456789";
  Digest at_once, in_pieces;
  at_once.add(text.data(), text.size());
  BOOST_TEST(at_once.value() == 0x995dc9bbdf1939faull);
  in_pieces.add(text.data(), 4);
  in_pieces.add(text.data() + 4, 5);
  BOOST_TEST(in_pieces.value() == at_once.value());
}

BOOST_AUTO_TEST_CASE(seal_sees_every_byte)
{
  // files of several ranks are one and the same
  if (world.size() > 1)
    return;
  const std::string name = "state_seal_test.h5";
  StateFile file(world);
  std::vector<double> list  = {1., 2., 3.};
  std::uint64_t large       = 1ull << 40;
  const std::uint64_t first = large;
  file.exchange("run/list", list);
  file.exchange("run/large", large);
  BOOST_TEST(file.write(name).empty());
  const std::string intact = read(name);
  BOOST_TEST(verdict(name, intact) == "");
  {
    StateFile again(world, name);
    list.clear();
    large = 0;
    again.exchange("run/list", list);
    again.exchange("run/large", large);
    BOOST_TEST(list.size() == 3u);
    BOOST_TEST(list[2] == 3.);
    BOOST_TEST(large == first);
  }

  // every byte of the seal, and every seventh of the rest
  unsigned int n_missed = 0;
  for (std::size_t i = 0; i < intact.size(); i += i < seal_length ? 1 : 7)
    {
      std::string content = intact;
      content[i] ^= 1 << (i % 8);
      n_missed += verdict(name, content).empty();
    }
  BOOST_TEST(n_missed == 0u);
  for (std::size_t length = 0; length < intact.size(); length += 61)
    n_missed += verdict(name, intact.substr(0, length)).empty();
  BOOST_TEST(n_missed == 0u);

  BOOST_TEST(says(verdict(name, ""), "is not a checkpoint"));
  BOOST_TEST(says(verdict(name, "words"), "is not a checkpoint"));
  BOOST_TEST(says(verdict(name, intact.substr(seal_length)), "of format 1"));
  BOOST_TEST(says(verdict(name, intact + "x"), "bytes instead of"));
  std::string other         = intact;
  const std::string present = "format " + std::to_string(state_format);
  other.replace(other.find(present),
                present.size(),
                "format " + std::to_string(state_format + 1));
  BOOST_TEST(says(verdict(name, other),
                  "of format " + std::to_string(state_format + 1)));
  std::remove(name.c_str());
}

BOOST_AUTO_TEST_SUITE_END()

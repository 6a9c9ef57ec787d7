// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries and values that were renamed are read all the same.
#include <boost/test/unit_test.hpp>

#include <keyblock/scene/old_names.h>

BOOST_AUTO_TEST_SUITE(old_names)

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(old_names_are_replaced)
{
  std::string text     = "set Title = Teams\n"
                         "subsection Safety factor # blocks\n"
                         "  set Teams   =  2  # ranks\n"
                         "  set Blocks = all\n"
                         "end\n"
                         "SUBSECTION Contact\n"
                         "  SET Method = paper\n"
                         "END\n";
  const auto sentences = replace_old_names(text);
  BOOST_TEST(sentences.size() == 2u);
  BOOST_TEST(sentences.front().find("'Safety factor/Teams' is now called "
                                    "'Safety factor/Rank groups'") !=
             std::string::npos);
  BOOST_TEST(text == "set Title = Teams\n"
                     "subsection Safety factor # blocks\n"
                     "set Rank groups = 2\n"
                     "  set Blocks = all\n"
                     "end\n"
                     "SUBSECTION Contact\n"
                     "set Method = published\n"
                     "END\n");
}

BOOST_AUTO_TEST_CASE(present_names_stay)
{
  for (const std::string before :
       {"subsection Contact\n set Method = exact\nend",
        "subsection Stages\nsubsection Contact\nset Method = paper\nend\nend\n",
        "set Teams = 2\nset Method = paper\n",
        "subsection Safety factor\nset Teams\nend\n"})
    {
      std::string text = before;
      BOOST_TEST(replace_old_names(text).empty());
      BOOST_TEST(text == before);
    }
}

BOOST_AUTO_TEST_SUITE_END()

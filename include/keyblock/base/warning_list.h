// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_warning_list_h
#define keyblock_base_warning_list_h

#include <deal.II/base/conditional_ostream.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * What a run warns of: what is added is printed at once, and kept for
   * summary.json, each sentence once. No other place of the program prints
   * the word that warnings begin with, so that none can be left out of the
   * list.
   */
  class WarningList
  {
  public:
    explicit WarningList(const dealii::ConditionalOStream &out)
      : out(out)
    {}

    /** Print and keep a @p sentence, unless it is known or empty. The same on
     * all ranks. */
    void
    add(const std::string &sentence)
    {
      if (!keep(sentence))
        return;
      if (out.is_active())
        print(out.get_stream(), sentence);
    }

    void
    add(const std::vector<std::string> &more)
    {
      for (const std::string &sentence : more)
        add(sentence);
    }

    /** Keep what an earlier part of the run has printed. */
    void
    recall(const std::vector<std::string> &earlier)
    {
      for (const std::string &sentence : earlier)
        keep(sentence);
    }

    /** In the order in which they came. */
    const std::vector<std::string> &
    all() const
    {
      return sentences;
    }

    static void
    print(std::ostream &out, const std::string &sentence)
    {
      out << "Warning: " << sentence << std::endl;
    }

  private:
    /** Whether the @p sentence is a new one. */
    bool
    keep(const std::string &sentence)
    {
      if (sentence.empty() ||
          std::find(sentences.begin(), sentences.end(), sentence) !=
            sentences.end())
        return false;
      sentences.push_back(sentence);
      return true;
    }

    const dealii::ConditionalOStream &out;
    std::vector<std::string> sentences;
  };
} // namespace Keyblock

#endif

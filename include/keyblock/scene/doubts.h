// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_doubts_h
#define keyblock_scene_doubts_h

#include <keyblock/base/number_text.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Values of entries that are allowed and hardly ever meant. */
  class Doubts
  {
  public:
    /** An upper bound that is none. */
    static constexpr double endless = std::numeric_limits<double>::infinity();

    /** Doubt the value of an entry between two bounds, both exclusive. */
    void
    look_at(const double value,
            const std::string &owner,
            const std::string &name,
            const double above,
            const double below,
            const std::string &unit,
            const std::string &question)
    {
      if (!(value > above && value < below))
        return;
      const std::string key = name + unit + text_of(value);
      Doubt &doubt          = doubts[key];
      if (doubt.n++ == 0)
        {
          order.push_back(key);
          doubt.sentence = "The entry '" + owner + "/" + name + "' is " +
                           text_of(value) + " " + unit;
          doubt.question = question;
        }
    }

    /** Doubt a stress [Pa] below a bound that may be in one of @p units. */
    void
    look_at_stress(const double value,
                   const std::string &owner,
                   const std::string &name,
                   const double least,
                   const std::string &units)
    {
      look_at(value,
              owner,
              name,
              0.,
              least,
              "Pa",
              "is it in " + units + "? Stresses are in pascals, 1 MPa is 1e6.");
    }

    std::vector<std::string>
    sentences() const
    {
      std::vector<std::string> all;
      for (const std::string &key : order)
        {
          const Doubt &doubt = doubts.at(key);
          all.push_back(doubt.sentence +
                        (doubt.n > 1
                           ? ", as " + std::to_string(doubt.n - 1) +
                               (doubt.n > 2 ? " more are" : " more is")
                           : "") +
                        ": " + doubt.question);
        }
      return all;
    }

  private:
    struct Doubt
    {
      std::string sentence, question;
      unsigned int n = 0;
    };
    std::map<std::string, Doubt> doubts; ///< by entry, unit and value
    std::vector<std::string> order;
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_mode_h
#define keyblock_safety_block_mode_h

#include <algorithm>
#include <string>
#include <vector>

namespace Keyblock
{
  /** How a block fails, and the joints that it presses meanwhile. */
  struct BlockMode
  {
    std::string motion;              ///< such as sliding; empty: unknown
    std::vector<std::string> joints; ///< names, each once

    /** Add the name of a joint, unless it is there. */
    void
    add_joint(const std::string &name)
    {
      if (std::find(joints.begin(), joints.end(), name) == joints.end())
        joints.push_back(name);
    }

    /** The joints: J1/J2. */
    std::string
    names() const
    {
      std::string text;
      for (const std::string &name : joints)
        text += (text.empty() ? "" : "/") + name;
      return text;
    }

    /** The mode in words: falling, sliding on J1/J2. */
    std::string
    text() const
    {
      return motion + (joints.empty() ? "" : " on ") + names();
    }

    /** A text to keep it in: the motion, then the joints. */
    std::string
    packed() const
    {
      std::string text = motion;
      for (const std::string &name : joints)
        text += separator + name;
      return text;
    }

    static BlockMode
    unpacked(const std::string &text)
    {
      BlockMode mode;
      std::size_t end = text.find(separator);
      mode.motion     = text.substr(0, end);
      while (end != std::string::npos)
        {
          const std::size_t begin = end + 1;
          end                     = text.find(separator, begin);
          mode.joints.push_back(text.substr(begin, end - begin));
        }
      return mode;
    }

  private:
    static constexpr char separator = '\x1f'; // in no name of a scene
  };
} // namespace Keyblock

#endif

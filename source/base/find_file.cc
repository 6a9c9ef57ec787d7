// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/find_file.h>

#include <filesystem>
#include <fstream>

namespace Keyblock
{
  std::string
  find_file(const std::string &scene_file, const std::string &name)
  {
    namespace fs = std::filesystem;
    for (const fs::path &path :
         {fs::path(scene_file).parent_path() / name, fs::path(name)})
      if (fs::is_regular_file(path) && std::ifstream(path))
        return path.string();
    return "";
  }
} // namespace Keyblock

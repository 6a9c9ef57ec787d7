// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_group_faces_h
#define keyblock_scene_group_faces_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * The corners of each element of a physical group of @p dimension, called by
   * its name or number, in a file in one of Gmsh's formats, which Gmsh reads in
   * a child process. Throws std::runtime_error with what is wrong.
   */
  std::vector<std::vector<dealii::Point<3>>>
  read_group_faces(const std::string &path,
                   const int dimension,
                   const std::string &group);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_solid_file_h
#define keyblock_scene_solid_file_h

#include <keyblock/scene/solid.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Whether a file is one of triangles, .stl. */
  bool is_stl(const std::string &path);

  /** Cells follow each triangle of a file: more of them take long, and neither
   * excavations nor joints ask for them. */
  constexpr unsigned int most_triangles = 20000;

  /** Throws std::runtime_error for more than that. */
  void require_few_triangles(const TriangleSurface &surface);

  /** The triangles in the text of an .stl file, ASCII or binary, in its unit,
   * vertices that coincide being one. Throws std::runtime_error with what is
   * wrong. */
  TriangleSurface read_stl(const std::string &text);

  /**
   * Put the solids of a STEP or BREP file into Gmsh's current model of
   * OpenCASCADE, scaled by @p scale about the file's origin (STEP: in metres
   * before that) and then shifted by minus @p origin. Returns their tags.
   * Throws what Gmsh throws, and std::runtime_error if there is no solid.
   */
  std::vector<int> import_solids(const std::string &path,
                                 const double scale,
                                 const Point<3> &origin);

  /** Their surfaces, as triangles: exact where they are plane. Gmsh reads the
   * file in a child process. Throws std::runtime_error with what is wrong. */
  std::vector<TriangleSurface> triangulate_solids(const std::string &path,
                                                  const double scale,
                                                  const Point<3> &origin);
} // namespace Keyblock

#endif

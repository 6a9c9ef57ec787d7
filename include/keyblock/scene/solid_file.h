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

  /** Whether a file is one that OpenCASCADE reads: .step, .stp, .brep. */
  bool is_cad(const std::string &path);

  /** Whether a file says in which unit its lengths are: .step, .stp. */
  bool names_unit(const std::string &path);

  /** Throws InputError if the entry @p section /Scale is given for such one. */
  void check_scale(const std::string &section,
                   const std::string &path,
                   const double scale);

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

  /**
   * All faces of a STEP (in metres) or BREP file (in its unit), of solids and
   * by themselves, as one surface: exact where they are plane, else with
   * @p chords in a full circle, but no edges below @p least_edge, in the
   * lengths of the result, unless the faces have them. Faces that touch along
   * edges are sewn together. Gmsh reads the file in a child process. Throws
   * std::runtime_error with what is wrong.
   */
  TriangleSurface triangulate_faces(const std::string &path,
                                    const unsigned int chords,
                                    const double least_edge);
} // namespace Keyblock

#endif

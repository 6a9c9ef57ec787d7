// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_dxf_h
#define keyblock_scene_dxf_h

#include <deal.II/base/point.h>

#include <keyblock/scene/solid.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * Corners of the closed outline in the text of a drawing, ASCII DXF, in its
   * unit: one closed polyline or circle, or lines, arcs and polylines whose
   * ends meet. Arcs become chords, as many in half a circle as @p n_chords.
   * Texts, dimensions, points and what is on the paper of a layout do not
   * count. Throws std::runtime_error with what is wrong.
   */
  std::vector<dealii::Point<2>> read_dxf_outline(const std::string &text,
                                                 const unsigned int n_chords);

  /** The lines in such a drawing, open or closed, each as its points. */
  std::vector<std::vector<dealii::Point<2>>>
  read_dxf_paths(const std::string &text, const unsigned int n_chords);

  /** The triangles of the 3DFACEs in the text of a drawing, ASCII DXF, in its
   * unit, four corners as two triangles; vertices that coincide are one.
   * Throws std::runtime_error with what is wrong. */
  TriangleSurface read_dxf_faces(const std::string &text);
} // namespace Keyblock

#endif

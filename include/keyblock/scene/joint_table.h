// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_table_h
#define keyblock_scene_joint_table_h

#include <keyblock/scene/scene.h>

#include <map>

namespace Keyblock
{
  /**
   * Read the joints of the table @p file_name, one a row, in its order. Rows
   * without a name are called J1, J2, ... by their number among all rows. What
   * a row does not say about its strength it takes from @p strength_of_set,
   * else from the defaults; @p origin [m] is subtracted from coordinates.
   *
   * The orientation is given by dip and dip direction, by strike and dip
   * (dip direction = strike + 90: right-hand rule), by trend and plunge of the
   * pole (the normal that points down: dip = 90 - plunge, dip direction =
   * trend + 180), by a normal vector, or by a polygon's vertices (in 2D by
   * the ends of a trace).
   *
   * Joints with a set are called SET.NAME where a name of the table is that of
   * a set, too, or stands twice.
   *
   * Throws InputError with file, line, column and value of what cannot be
   * used. Names are not compared with each other.
   */
  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  read_joint_table(const std::string &file_name,
                   const Point<dim> &origin,
                   const std::map<std::string, JointStrength> &strength_of_set);

  /** What is allowed and probably not meant of the scene's table, as long as
   * its joints are as they were read, by the scene's @p text. */
  template <int dim>
  std::vector<std::string> warnings_of_table(const Scene<dim> &scene,
                                             const SceneText &text);

  /** Throws InputError if @p name (of what @p owner says) has letters that
   * lists and paths of entries are parted by. */
  void check_name(const std::string &name, const std::string &owner);
} // namespace Keyblock

#endif

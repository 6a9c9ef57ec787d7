// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_text_h
#define keyblock_scene_text_h

#include <keyblock/base/communicator.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  /** A line without comment, with single blanks only, as it is parsed. */
  std::string significant_part(std::string line);

  /**
   * Parse lines of a parameter file from @p file_name (for line numbers).
   * Throws InputError, one sentence that begins with @p source, for whatever
   * deal.II cannot parse.
   */
  void parse_entries(dealii::ParameterHandler &prm,
                     const std::string &text,
                     const std::string &file_name,
                     const std::string &source,
                     const bool skip_unknown = false);

  /** The text of a scene that is in no file. For as long as this lives its name
   * can be given in place of that of a file; what it includes is looked for
   * where the program runs. */
  class SceneInMemory
  {
  public:
    /** @param text the same on all ranks */
    explicit SceneInMemory(const std::string &text);
    ~SceneInMemory();
    SceneInMemory(const SceneInMemory &)            = delete;
    SceneInMemory &operator=(const SceneInMemory &) = delete;

    const std::string &
    name() const
    {
      return scene_name;
    }

  private:
    std::string scene_name;
  };

  /** What a scene says of joints by their name. */
  struct JointPassage
  {
    std::string joint;     ///< its name; of overrides a pattern, as A* or ?1
    std::string text;      ///< lines of a parameter file
    std::string place;     ///< where it stands, for messages
    unsigned int line = 0; ///< lines before it; 0: an override
  };

  /**
   * A scene file and the overrides of the command line, with what they say of
   * single joints set apart: a ParameterHandler takes too long over thousands
   * of subsections, and the joints of tables are not known when it reads.
   */
  struct SceneText
  {
    /** Throws InputError if the file cannot be read, or if an override has no
     * '=' (collective). */
    SceneText(const Communicator &communicator,
              const std::string &file_name,
              const std::vector<std::string> &overrides);

    struct Override
    {
      std::string assignment; ///< Section/Entry=value
      std::string text;       ///< the same as lines of a parameter file
    };

    std::string file_name;
    std::string text; ///< blank lines in place of joints' subsections
    std::vector<Override> overrides;
    std::vector<std::string> warnings; ///< of names that have changed

    std::vector<JointPassage> joint_subsections;
    std::vector<JointPassage> joint_overrides;

    /** Parse all but the joints. */
    void parse(dealii::ParameterHandler &prm, const bool skip_unknown) const;

    /** Whether the file or an override gives the entry, not one of a joint, of
     * this section a value, be it the default. */
    bool gives(const std::string &section, const std::string &entry) const;
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_python_any_scene_h
#define keyblock_python_any_scene_h

#include <keyblock/scene/scene.h>
#include <keyblock/scene/text.h>

#include <memory>
#include <string>
#include <vector>

// What the Python module hands out: scenes, blocks and runs whose number of
// dimensions is known when the program runs. Free of pybind11.
namespace Keyblock::Python
{
  /** Where a scene comes from, and who works on it. */
  struct SceneSource
  {
    std::string file;
    std::shared_ptr<const SceneInMemory> text; ///< in place of a file, or null
    std::vector<std::string> overrides;        ///< "Section/Entry=value"

    /** Whether each rank has a scene of its own, which no other one sees. */
    bool is_alone = false;

    Communicator communicator() const;
  };

  /** A scene that has been read and checked. */
  class AnyScene
  {
  public:
    explicit AnyScene(const SceneSource &source)
      : source(source)
    {}
    virtual ~AnyScene() = default;

    /** Throws InputError (collective unless the source is_alone). */
    static std::shared_ptr<const AnyScene> read(const SceneSource &source);

    virtual unsigned int dimension() const             = 0;
    virtual std::string title() const                  = 0;
    virtual std::vector<std::string> warnings() const  = 0;
    virtual std::string used_entries() const           = 0;
    virtual std::vector<std::string> joints() const    = 0;
    virtual std::vector<std::string> stages() const    = 0;
    virtual std::vector<std::string> materials() const = 0;

    const SceneSource source;
  };

  template <int dim>
  class SceneOf : public AnyScene
  {
  public:
    explicit SceneOf(const SceneSource &source);

    unsigned int dimension() const override;
    std::string title() const override;
    std::vector<std::string> warnings() const override;
    std::string used_entries() const override;
    std::vector<std::string> joints() const override;
    std::vector<std::string> stages() const override;
    std::vector<std::string> materials() const override;

    Scene<dim> scene;
  };
} // namespace Keyblock::Python

#endif

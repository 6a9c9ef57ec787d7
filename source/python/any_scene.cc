// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/any_scene.h>
#include <keyblock/scene/network_output.h>

namespace Keyblock::Python
{
  Communicator
  SceneSource::communicator() const
  {
    return Communicator(is_alone ? MPI_COMM_SELF : MPI_COMM_WORLD);
  }



  std::shared_ptr<const AnyScene>
  AnyScene::read(const SceneSource &source)
  {
    if (read_dimension(source.communicator(), source.file, source.overrides) ==
        2)
      return std::make_shared<SceneOf<2>>(source);
    return std::make_shared<SceneOf<3>>(source);
  }



  template <int dim>
  SceneOf<dim>::SceneOf(const SceneSource &source)
    : AnyScene(source)
  {
    scene.read(source.communicator(), source.file, source.overrides);
  }



  template <int dim>
  unsigned int
  SceneOf<dim>::dimension() const
  {
    return dim;
  }



  template <int dim>
  std::string
  SceneOf<dim>::title() const
  {
    return scene.title;
  }



  template <int dim>
  std::vector<std::string>
  SceneOf<dim>::warnings() const
  {
    return scene.warnings();
  }



  template <int dim>
  std::string
  SceneOf<dim>::used_entries() const
  {
    return scene.used_entries();
  }



  template <int dim>
  std::vector<std::string>
  SceneOf<dim>::joints() const
  {
    return names_of(scene.joints);
  }



  template <int dim>
  std::vector<std::string>
  SceneOf<dim>::stages() const
  {
    return names_of(scene.stages);
  }



  template <int dim>
  std::vector<std::string>
  SceneOf<dim>::materials() const
  {
    return names_of(scene.materials);
  }

  template class SceneOf<2>;
  template class SceneOf<3>;
} // namespace Keyblock::Python

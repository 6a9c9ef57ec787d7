// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/block_faces.h>
#include <keyblock/safety/friction_loss.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  BlockFace<dim>
  make_block_face(const Tensor<1, dim> &inward,
                  const std::string &name,
                  const std::shared_ptr<const JointLaw> &law,
                  const unsigned int joint,
                  const bool is_reduced)
  {
    const StrengthEnvelope strength = law->envelope(JointPointState());
    BlockFace<dim> face;
    face.inward           = inward;
    face.name             = name;
    face.tangent_friction = strength.static_tangent;
    face.cohesion         = strength.cohesion;
    face.tensile_strength = strength.tensile_strength;
    face.is_reduced       = is_reduced;
    face.joint            = joint;
    face.loses_friction   = FrictionLoss(*law).is_felt();
    if (law->depends_on_pressure())
      face.law = law;
    return face;
  }

  template <int dim>
  bool
  BlockSurroundings<dim>::touches(const unsigned int joint) const
  {
    return std::any_of(faces.begin(), faces.end(), [&](const auto &face) {
      return face.joint == joint;
    });
  }



  template <int dim>
  bool
  BlockSurroundings<dim>::loses_friction() const
  {
    return std::any_of(faces.begin(), faces.end(), [](const auto &face) {
      return face.loses_friction;
    });
  }



  template BlockFace<2> make_block_face(const Tensor<1, 2> &,
                                        const std::string &,
                                        const std::shared_ptr<const JointLaw> &,
                                        const unsigned int,
                                        const bool);
  template BlockFace<3> make_block_face(const Tensor<1, 3> &,
                                        const std::string &,
                                        const std::shared_ptr<const JointLaw> &,
                                        const unsigned int,
                                        const bool);
  template struct BlockSurroundings<2>;
  template struct BlockSurroundings<3>;
} // namespace Keyblock

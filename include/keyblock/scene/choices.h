// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_choices_h
#define keyblock_scene_choices_h

#include <array>
#include <optional>
#include <string>

namespace Keyblock
{
  /** The words by which entries name the values of the choice E, in the order
   * of the values. A new choice needs a line in scene/choice_patterns.h. */
  template <typename E>
  struct ChoiceNames;

  /** The word by which entries name @p choice. */
  template <typename E>
  std::string
  name_of(const E choice)
  {
    return ChoiceNames<E>::names.at(static_cast<unsigned int>(choice));
  }

  /** The value that entries name by @p word; none if there is no such one. */
  template <typename E>
  std::optional<E>
  choice_called(const std::string &word)
  {
    constexpr auto &names = ChoiceNames<E>::names;
    for (unsigned int i = 0; i < names.size(); ++i)
      if (word == names[i])
        return static_cast<E>(i);
    return {};
  }

  /** Shape of the domain; file: that of a mesh file. */
  enum class DomainShape
  {
    box,
    parallelepiped,
    polygon,
    file
  };
  template <>
  struct ChoiceNames<DomainShape>
  {
    static constexpr std::array<const char *, 4> names = {
      {"box", "parallelepiped", "polygon", "file"}};
  };

  /** Who makes the cells. */
  enum class MeshGenerator
  {
    structured,
    gmsh,
    file
  };
  template <>
  struct ChoiceNames<MeshGenerator>
  {
    static constexpr std::array<const char *, 3> names = {
      {"structured", "gmsh", "file"}};
  };

  /** Shape of an excavation. */
  enum class ExcavationShape
  {
    polygon,
    circle,
    box,
    extruded_polygon,
    formula,
    rectangle,
    horseshoe,
    cavern,
    file
  };
  template <>
  struct ChoiceNames<ExcavationShape>
  {
    static constexpr std::array<const char *, 9> names = {{"polygon",
                                                           "circle",
                                                           "box",
                                                           "extruded polygon",
                                                           "formula",
                                                           "rectangle",
                                                           "horseshoe",
                                                           "cavern",
                                                           "file"}};
  };

  /** What a joint is: a plane, or a surface of several plane facets. */
  enum class JointForm
  {
    plane,
    polyline,
    file,
    physical_group
  };
  template <>
  struct ChoiceNames<JointForm>
  {
    static constexpr std::array<const char *, 4> names = {
      {"plane", "polyline", "file", "physical group"}};
  };

  /** Extent of a joint within its plane. */
  enum class JointShape
  {
    infinite,
    disc,
    polygon
  };
  template <>
  struct ChoiceNames<JointShape>
  {
    static constexpr std::array<const char *, 3> names = {
      {"infinite", "disc", "polygon"}};
  };

  /** Distribution of a variable of a study. */
  enum class Distribution
  {
    normal,
    lognormal,
    exponential,
    uniform,
    triangular,
    sequence
  };
  template <>
  struct ChoiceNames<Distribution>
  {
    static constexpr std::array<const char *, 6> names = {{"normal",
                                                           "lognormal",
                                                           "exponential",
                                                           "uniform",
                                                           "triangular",
                                                           "sequence"}};
  };

  /** How samples of a study are drawn. */
  enum class Sampling
  {
    latin_hypercube,
    random
  };
  template <>
  struct ChoiceNames<Sampling>
  {
    static constexpr std::array<const char *, 2> names = {
      {"latin hypercube", "random"}};
  };

  /** Law of the spacings of a set of joints. */
  enum class SpacingDistribution
  {
    exponential,
    constant
  };
  template <>
  struct ChoiceNames<SpacingDistribution>
  {
    static constexpr std::array<const char *, 2> names = {
      {"exponential", "constant"}};
  };

  /** Law of the radii of a set of joints; infinite: no rims. */
  enum class RadiusDistribution
  {
    infinite,
    constant,
    uniform,
    exponential,
    lognormal,
    power_law
  };
  template <>
  struct ChoiceNames<RadiusDistribution>
  {
    static constexpr std::array<const char *, 6> names = {{"infinite",
                                                           "constant",
                                                           "uniform",
                                                           "exponential",
                                                           "lognormal",
                                                           "power law"}};
  };

  /** Constitutive model of a material. */
  enum class MaterialModel
  {
    elastic,
    mohr_coulomb,
    rigid
  };
  template <>
  struct ChoiceNames<MaterialModel>
  {
    static constexpr std::array<const char *, 3> names = {
      {"elastic", "mohr_coulomb", "rigid"}};
  };

  /** CellIntegration of the volume change of cells. */
  enum class CellIntegration
  {
    automatic,
    full,
    mean_dilatation
  };
  template <>
  struct ChoiceNames<CellIntegration>
  {
    static constexpr std::array<const char *, 3> names = {
      {"automatic", "full", "mean dilatation"}};
  };

  /** Whether a support holds its nodes, stands for infinite rock, lets waves
   * out, or moves with ground that has no excavation. */
  enum class SupportKind
  {
    held,
    far_field,
    quiet,
    free_field
  };
  template <>
  struct ChoiceNames<SupportKind>
  {
    static constexpr std::array<const char *, 4> names = {
      {"held", "far field", "quiet", "free field"}};
  };

  /** What the history of a support is one of. */
  enum class HistoryQuantity
  {
    velocity,
    acceleration,
    stress
  };
  template <>
  struct ChoiceNames<HistoryQuantity>
  {
    static constexpr std::array<const char *, 3> names = {
      {"velocity", "acceleration", "stress"}};
  };

  /** Directions that a support holds. */
  enum class SupportDirections
  {
    all,
    normal,
    x,
    y,
    z,
    xy,
    xz,
    yz
  };
  template <>
  struct ChoiceNames<SupportDirections>
  {
    static constexpr std::array<const char *, 8> names = {
      {"all", "normal", "x", "y", "z", "xy", "xz", "yz"}};
  };

  /** Whether the initial stress is brought into equilibrium. */
  enum class InitialEquilibrium
  {
    none,
    static_solve
  };
  template <>
  struct ChoiceNames<InitialEquilibrium>
  {
    static constexpr std::array<const char *, 2> names = {{"none", "static"}};
  };

  /** How contact is solved; none: joints are ignored. */
  enum class ContactMethod
  {
    exact,
    published,
    none
  };
  template <>
  struct ChoiceNames<ContactMethod>
  {
    static constexpr std::array<const char *, 3> names = {
      {"exact", "published", "none"}};
  };

  /** Geometry of the strains: the reference one or the current one. */
  enum class Kinematics
  {
    small,
    large
  };
  template <>
  struct ChoiceNames<Kinematics>
  {
    static constexpr std::array<const char *, 2> names = {{"small", "large"}};
  };

  /** How a stage goes to its end. */
  enum class StageKind
  {
    dynamic,
    quasi_static,
    static_solve
  };
  template <>
  struct ChoiceNames<StageKind>
  {
    static constexpr std::array<const char *, 3> names = {
      {"dynamic", "quasi-static", "static"}};
  };

  /** Which parts of Rayleigh damping act. */
  enum class RayleighTerms
  {
    both,
    mass,
    stiffness
  };
  template <>
  struct ChoiceNames<RayleighTerms>
  {
    static constexpr std::array<const char *, 3> names = {
      {"both", "mass", "stiffness"}};
  };

  /** What judges the blocks of a study's samples. */
  enum class StudyLevel
  {
    rigid,
    full
  };
  template <>
  struct ChoiceNames<StudyLevel>
  {
    static constexpr std::array<const char *, 2> names = {{"rigid", "full"}};
  };

  /** What a monitor looks at. */
  enum class MonitorKind
  {
    point,
    block,
    region,
    joint,
    support
  };
  template <>
  struct ChoiceNames<MonitorKind>
  {
    static constexpr std::array<const char *, 5> names = {
      {"point", "block", "region", "joint", "support"}};
  };

  /** Joints whose strength a trial reduces. */
  enum class ReducedJoints
  {
    of_block,
    all
  };
  template <>
  struct ChoiceNames<ReducedJoints>
  {
    static constexpr std::array<const char *, 2> names = {
      {"of the block", "all"}};
  };

  /** Search for the safety factor. */
  enum class FactorSearch
  {
    bisection,
    sweep
  };
  template <>
  struct ChoiceNames<FactorSearch>
  {
    static constexpr std::array<const char *, 2> names = {
      {"bisection", "sweep"}};
  };

  /** How the forces of bolts enter a factor. */
  enum class BoltConvention
  {
    active,
    passive
  };
  template <>
  struct ChoiceNames<BoltConvention>
  {
    static constexpr std::array<const char *, 2> names = {
      {"active", "passive"}};
  };

  /** Closed form, or other reference, that results are compared with. */
  enum class ClosedForm
  {
    none,
    resting,
    incline,
    bar_impact,
    oblique_impact,
    bond_break,
    newmark,
    gravity_column,
    kirsch,
    salencon,
    spherical_cavity,
    footing,
    value,
    toppling,
    rotation,
    joint_wave
  };
  template <>
  struct ChoiceNames<ClosedForm>
  {
    static constexpr std::array<const char *, 16> names = {{"none",
                                                            "resting",
                                                            "incline",
                                                            "bar_impact",
                                                            "oblique_impact",
                                                            "bond_break",
                                                            "newmark",
                                                            "gravity_column",
                                                            "kirsch",
                                                            "salencon",
                                                            "spherical_cavity",
                                                            "footing",
                                                            "value",
                                                            "toppling",
                                                            "rotation",
                                                            "joint_wave"}};
  };
} // namespace Keyblock

#endif

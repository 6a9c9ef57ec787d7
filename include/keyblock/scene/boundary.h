// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_boundary_h
#define keyblock_scene_boundary_h

#include <deal.II/base/point.h>

#include <keyblock/base/choice.h>
#include <keyblock/base/time_series.h>

#include <memory>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  using dealii::ParameterHandler;
  using dealii::Point;

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

  /** Nodes held, or moved in a prescribed way. */
  template <int dim>
  struct Support
  {
    std::string name;
    std::vector<std::string> boundaries;
    std::string region;
    SupportDirections directions = SupportDirections::all;
    std::string velocity;
    std::string displacement;
    SupportKind kind = SupportKind::held;
    Point<dim> center;
    std::string stage = "start"; ///< from which on it is quiet
    std::string history_file;
    HistoryQuantity history_quantity = HistoryQuantity::velocity;
    std::string history_stage; ///< in which it begins; empty: by default

    /** Of History file: velocities, of stress as they are; null: none. */
    std::shared_ptr<const TimeSeries> history;

    bool
    is_far_field() const
    {
      return kind == SupportKind::far_field;
    }

    /** Whether it lets waves out, with or without a free field. */
    bool
    is_quiet() const
    {
      return kind == SupportKind::quiet || is_free_field();
    }

    bool
    is_free_field() const
    {
      return kind == SupportKind::free_field;
    }

    /** Whether `Directions` names the axis @p d (0: x). */
    bool names_axis(const unsigned int d) const;

    void declare(ParameterHandler &prm);
  };

  /** A surface load in N/m2, tension (pull outwards) positive. */
  template <int dim>
  struct Traction
  {
    std::string name;
    std::vector<std::string> boundaries;
    std::string region;
    std::string expression;
    std::string stage = "start";

    void declare(ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

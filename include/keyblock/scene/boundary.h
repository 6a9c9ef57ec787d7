// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_boundary_h
#define keyblock_scene_boundary_h

#include <deal.II/base/point.h>

#include <keyblock/base/time_series.h>
#include <keyblock/scene/choices.h>

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

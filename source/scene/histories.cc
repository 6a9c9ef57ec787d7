// SPDX-License-Identifier: LGPL-2.1-or-later
// What a scene says of water, shaking and histories, and what it is warned of.
#include <keyblock/base/history_columns.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/scene/idle_entries.h>
#include <keyblock/scene/joint_facets.h>
#include <keyblock/scene/scene.h>
#include <keyblock/scene/unit_warnings.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Last over largest displacement of a history, beyond which its base line
     * is doubted [-]. */
    constexpr double largest_base_line_error = 0.05;

    /** Sine between gravity and the last axis, from which on elevations are
     * doubted [-]. */
    constexpr double tilt = 1e-6;

    /** That of a history without one in its header. */
    std::string
    unit_of(const HistoryQuantity quantity)
    {
      return quantity == HistoryQuantity::stress         ? "Pa"
             : quantity == HistoryQuantity::acceleration ? "m/s2"
                                                         : "m/s";
    }



    /** Whether a history has values other than 0 before its time 0. */
    bool
    shakes_before_start(const TimeSeries &history)
    {
      constexpr unsigned int n_samples = 1000;
      for (unsigned int i = 0; i < n_samples && history.start_time() < 0.; ++i)
        for (unsigned int c = 0; c < history.n_components(); ++c)
          if (history.value(history.start_time() * (1. - double(i) / n_samples),
                            c) != 0.)
            return true;
      return false;
    }



    /** Sentences on histories that begin when all is over, or before. */
    template <int dim>
    std::vector<std::string>
    warnings_of_late_histories(const Scene<dim> &scene)
    {
      std::vector<std::string> found;
      for (const auto &support : scene.supports)
        {
          if (!support->history)
            continue;
          double duration = 0.;
          bool is_known   = true;
          for (const auto &stage : scene.stages)
            if (scene.stage_number(stage->name) >=
                scene.history_stage(*support))
              {
                duration += stage->duration;
                is_known =
                  is_known && stage->is_dynamic() && stage->duration > 0.;
              }
          const double start = support->history->start_time();
          if (shakes_before_start(*support->history))
            found.push_back(
              "The history '" + support->history_file +
              "' of the entry "
              "'Supports/" +
              support->name + "/History file' begins at " + text_of(start) +
              " s, before its stage, where times are 0: what shakes until then "
              "is cut off; let its times begin at 0.");
          if (is_known && duration > 0. && start >= duration)
            found.push_back(
              "The history '" + support->history_file +
              "' of the entry "
              "'Supports/" +
              support->name + "/History file' begins at " + text_of(start) +
              " s, and the run ends " + text_of(duration) +
              " s after the beginning of its stage: nothing shakes; let its "
              "times begin at 0, or lengthen 'Duration'.");
        }
      return found;
    }



    /** Until when what is integrated from a history keeps its last value, from
     * the beginning of its stage [s]: while dynamic stages follow each other,
     * but for those after the first that are to come to rest. */
    template <int dim>
    double
    end_of_shaking(const Scene<dim> &scene, const Support<dim> &support)
    {
      double duration          = 0.;
      const unsigned int first = scene.history_stage(support);
      for (const auto &stage : scene.stages)
        if (const unsigned int number = scene.stage_number(stage->name);
            number >= first)
          {
            if (!stage->is_dynamic() ||
                (number > first && stage->unbalanced_ratio > 0.))
              break;
            duration += stage->duration;
          }
      return duration;
    }



    /** Sentences on histories after which the ground stays displaced, or goes
     * on. */
    template <int dim>
    std::vector<std::string>
    warnings_of_base_lines(const Scene<dim> &scene)
    {
      std::vector<std::string> found;
      for (const auto &support : scene.supports)
        if (support->history)
          {
            const bool is_stress =
              support->history_quantity == HistoryQuantity::stress;
            const bool is_integrated =
              support->history_quantity == HistoryQuantity::acceleration;
            const std::string unit   = is_stress ? " Pa s" : " m";
            const TimeSeries &motion = *support->history,
                             way     = motion.integral();
            for (unsigned int d = 0; d < dim; ++d)
              if (!is_stress &&
                  std::abs(motion.last(d)) >
                    largest_base_line_error * motion.largest_magnitude())
                found.push_back(
                  "The history '" + support->history_file +
                  "' ends with a velocity of " + text_of(motion.last(d), 3) +
                  " m/s along " + "xyz"[d] + ", and has at most " +
                  text_of(motion.largest_magnitude(), 3) +
                  " m/s along any axis on the way: the support " +
                  (is_integrated ? "goes on with it to the end of the shaking"
                                 : "stops at once") +
                  "; correct its base line, or add rows in which it comes to "
                  "rest.");
              else if (std::abs(way.last(d)) >
                       largest_base_line_error * way.largest_magnitude())
                found.push_back(
                  "The history '" + support->history_file + "' ends with " +
                  (is_stress ? "an impulse" : "a displacement") + " of " +
                  text_of(way.last(d)) + unit + " along " + "xyz"[d] +
                  ", and has at most " + text_of(way.largest_magnitude()) +
                  unit + " along any axis on the way" +
                  (is_stress ? ", which leaves the ground displaced" : "") +
                  "; correct its base line if it should end where it began.");
          }
      return found;
    }



    /** A sentence if there are water levels that do not lie across gravity. */
    template <int dim>
    std::vector<std::string>
    warnings_of_water(const Scene<dim> &scene)
    {
      bool has_level = false;
      for (unsigned int number = 1; number <= scene.stages.size() + 1; ++number)
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          has_level = has_level || (scene.joints[j]->water_pressure.empty() &&
                                    !scene.water_pressure(j, number).empty());
      const Tensor<1, dim> gravity = Gravity<dim>(scene).at(Point<dim>(), 0.);
      Tensor<1, dim> across        = gravity;
      across[dim - 1]              = 0.;
      if (!has_level || across.norm() <= tilt * gravity.norm())
        return {};
      const std::string axis(1, "xyz"[dim - 1]);
      return {"Gravity is not along " + axis +
              ", but water levels are: "
              "pressure is the 'Water/Unit weight' times the depth along " +
              axis +
              "; give 'Joints/*/Water pressure' as a formula if the "
              "scene is drawn in turned axes."};
    }
  } // namespace



  template <int dim>
  std::string
  Scene<dim>::water_pressure(const unsigned int joint,
                             const unsigned int number) const
  {
    const Joint<dim> &own = *joints[joint];
    std::string level     = water.level;
    for (const auto &stage : stages)
      if (stage_number(stage->name) <= number)
        {
          for (const std::string &name : stage->drained_joints)
            if (name == own.name || name == own.set || name == own.surface)
              return "";
          if (!stage->water_level.empty())
            level = stage->water_level;
        }
    if (!own.water_pressure.empty())
      // joints bear no suction; what has no value keeps none
      return "max((" + own.water_pressure + "), 0)";
    if (!own.water_level.empty())
      level = own.water_level;
    if (level.empty() || level == no_water)
      return "";
    return exact_text(water.unit_weight) + " * max((" + level + ") - " +
           (dim == 2 ? "y" : "z") + ", 0)";
  }



  template <int dim>
  Tensor<1, dim>
  Scene<dim>::seismic_coefficient(const unsigned int number) const
  {
    Tensor<1, dim> coefficient;
    for (const auto &stage : stages)
      if (stage_number(stage->name) <= number)
        for (unsigned int d = 0; d < stage->seismic_coefficient.size(); ++d)
          coefficient[d] = stage->seismic_coefficient[d];
    return coefficient;
  }



  template <int dim>
  void
  Scene<dim>::read_histories()
  {
    for (const auto &support : supports)
      if (!support->history_file.empty())
        {
          TimeSeries history =
            read_history((std::filesystem::path(file).parent_path() /
                          support->history_file)
                           .string(),
                         "Supports/" + support->name + "/History file",
                         dim,
                         unit_of(support->history_quantity));
          if (support->history_quantity == HistoryQuantity::acceleration)
            history =
              history.integral().held_until(end_of_shaking(*this, *support));
          support->history = std::make_shared<TimeSeries>(std::move(history));
        }
  }



  template <int dim>
  std::vector<std::string>
  Scene<dim>::warnings() const
  {
    std::vector<std::string> found = old_names;
    for (const auto &warnings : {warnings_of_facets(*this),
                                 warnings_of_units(*this),
                                 warnings_of_loads(*this),
                                 warnings_of_idle_entries(*this),
                                 warnings_of_base_lines(*this),
                                 warnings_of_late_histories(*this),
                                 warnings_of_water(*this),
                                 warnings_of_mistakes(*this),
                                 warnings_of_missing_entries(*this),
                                 warnings_of_ground(*this),
                                 warnings_of_ground_top(*this)})
      found.insert(found.end(), warnings.begin(), warnings.end());
    for (const auto &material : materials)
      if (material->is_plastic() &&
          material->tensile_strength > material->apex())
        {
          std::ostringstream text;
          text << "The entry 'Materials/" << material->name
               << "/Tensile strength' is " << material->tensile_strength
               << " Pa, beyond the apex of cohesion and friction at "
               << material->apex() << " Pa, so that it never acts.";
          found.push_back(text.str());
        }
    for (const auto &support : supports)
      if (support->is_free_field())
        for (const auto &stage : stages)
          {
            const std::string who = "The support '" + support->name +
                                    "' is a free field in the stage '" +
                                    stage->name + "', ";
            if (stage_number(stage->name) < stage_number(support->stage))
              continue;
            if (stage->damping_ratio > 0.)
              found.push_back(
                who + "whose 'Damping ratio' the ground beside the model has "
                      "not; use 'Rayleigh ratio'.");
            if (stage->kind != StageKind::dynamic)
              found.push_back(
                who +
                "which is not dynamic: the side does not hold; name the "
                "stage of the shaking in 'Supports/" +
                support->name + "/Stage'.");
          }
    for (unsigned int s = 0; s < stages.size(); ++s)
      if (stages[s]->is_dynamic() &&
          stages[s]->ramp_duration > stages[s]->duration)
        found.push_back(
          "The entry 'Stages/" + stages[s]->name + "/Ramp duration' is " +
          text_of(stages[s]->ramp_duration) + " s, more than its 'Duration' " +
          "of " + text_of(stages[s]->duration) +
          " s: what is left of the ramp " +
          (s + 1 < stages.size() ? "goes on in the next stage."
                                 : "never goes; lengthen the stage."));
    return found;
  }

#define INSTANTIATE(dim)                                                       \
  template std::string Scene<dim>::water_pressure(const unsigned int,          \
                                                  const unsigned int) const;   \
  template Tensor<1, dim> Scene<dim>::seismic_coefficient(const unsigned int)  \
    const;                                                                     \
  template void Scene<dim>::read_histories();                                  \
  template std::vector<std::string> Scene<dim>::warnings() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

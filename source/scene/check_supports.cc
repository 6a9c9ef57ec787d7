// SPDX-License-Identifier: LGPL-2.1-or-later
// Contradictions between the entries of supports.
#include <keyblock/base/expression.h>
#include <keyblock/scene/check_parts.h>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    check_motion(const Scene<dim> &scene, const Support<dim> &support)
    {
      const std::string who     = "The support '" + support.name + "' ";
      const std::string section = "Supports/" + support.name;
      check_expression<dim>(support.velocity, dim, section + "/Velocity");
      check_expression<dim>(support.displacement,
                            dim,
                            section + "/Displacement");
      require(support.velocity.empty() || support.displacement.empty(),
              who + "has both 'Velocity' and 'Displacement'; keep one.");
      require(!support.history ||
                (support.velocity.empty() && support.displacement.empty()),
              who + "has a 'History file' besides 'Velocity' or "
                    "'Displacement'; keep one.");
      require(!support.history || !support.is_far_field(),
              who + "is a far field, which follows no history; set 'Kind' to "
                    "held or quiet.");
      require(!support.history ||
                scene.history_stage(support) < scene.stages.size() + 2,
              support.history_stage.empty()
                ? who +
                    "has a 'History file', but no stage shakes it: there is "
                    "no dynamic stage" +
                    (support.stage == "start"
                       ? std::string()
                       : " from '" + support.stage + "' on") +
                    "; add one to 'Stages/Names'."
                : "The entry '" + section + "/History stage' is '" +
                    support.history_stage +
                    "', which is not in 'Stages/Names'; name a stage there.");
      require(support.history || support.history_stage.empty(),
              "The entry '" + section + "/History stage' is '" +
                support.history_stage +
                "', but there is no 'History file'; give one, or leave it "
                "out.");
      require(!support.history || support.history_stage.empty() ||
                scene.history_stage(support) >=
                  std::max(2u, scene.stage_number(support.stage)),
              "The entry '" + section + "/History stage' is '" +
                support.history_stage + "', which is before '" + support.stage +
                "', from which on the support is quiet; name "
                "a later stage.");
      require(support.history_quantity != HistoryQuantity::stress ||
                support.is_quiet(),
              who + "has 'History quantity' stress, which only a quiet support "
                    "takes; set 'Kind' to quiet, or give velocities.");
      require(!support.is_quiet() || support.displacement.empty(),
              who + "is quiet, which no 'Displacement' can be given to; set "
                    "'Velocity' for the wave that it lets in.");
      require(support.displacement.empty() || scene.has_stage_to_balance(),
              who + "has a 'Displacement', which is reached in the first "
                    "quasi-static or static stage, and there is none; add one "
                    "to 'Stages/Names', or give a 'Velocity'.");
      require(!support.is_free_field() ||
                (support.velocity.empty() && !support.history),
              who + "is a free field with a 'Velocity' or a 'History file'; "
                    "the ground beside it is moved by the support of the "
                    "boundary bottom, give them there.");
    }

    /** Whether a support holds or moves the bottom of the model. */
    template <int dim>
    bool
    has_foot(const Scene<dim> &scene)
    {
      for (const auto &support : scene.supports)
        if (!support->is_free_field())
          for (const std::string &name : support->boundaries)
            if (name == "bottom" || name == "all")
              return true;
      return false;
    }
  } // namespace



  template <int dim>
  void
  check_supports(const Scene<dim> &scene)
  {
    for (const auto &support : scene.supports)
      {
        const std::string section = "Supports/" + support->name;
        check_expression<dim>(support->region, 1, section + "/Region");
        require((!support->is_far_field() && !support->is_quiet()) ||
                  !support->boundaries.empty(),
                "The support '" + support->name + "' is " +
                  (support->is_quiet() ? "quiet" : "a far field") +
                  ", which needs 'Boundaries'; name them.");
        check_motion(scene, *support);
        require(!support->is_free_field() || has_foot(scene),
                "The support '" + support->name +
                  "' is a free field, but no other support names the boundary "
                  "bottom, on which the ground beside the model stands; add "
                  "one, held, moved or quiet.");
        require(scene.stage_number(support->stage) < scene.stages.size() + 2,
                "The entry '" + section + "/Stage' is '" + support->stage +
                  "', which is not in 'Stages/Names'; name a stage there, or "
                  "start.");
        require(support->stage == "start" || support->is_quiet(),
                "The entry '" + section + "/Stage' is '" + support->stage +
                  "', but only a quiet support begins with a stage; set 'Kind' "
                  "to quiet, or leave it out.");
        require(support->boundaries.empty() != support->region.empty(),
                "The support '" + support->name +
                  "' needs exactly one of 'Boundaries' and 'Region'.");
        require(support->directions != SupportDirections::normal ||
                  support->region.empty(),
                "The support '" + support->name +
                  "' has 'Directions' normal, which needs 'Boundaries'; "
                  "name boundaries or axes.");
        require(dim == 3 || !support->names_axis(2),
                "The entry '" + section + "/Directions' is " +
                  name_of(support->directions) + ", but there is no z in 2D.");
      }
  }

  template void check_supports(const Scene<2> &);
  template void check_supports(const Scene<3> &);
} // namespace Keyblock

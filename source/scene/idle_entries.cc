// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries that would have no effect beside others are refused.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/idle_entries.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Names of the entries that lines of a parameter file give a value. */
    std::vector<std::string>
    entries_given(const std::string &text)
    {
      std::vector<std::string> names;
      std::istringstream lines(text);
      bool is_continued = false;
      for (std::string line; std::getline(lines, line);)
        {
          const std::string words = significant_part(line);
          const auto equal        = words.find('=');
          if (!is_continued && boost::istarts_with(words, "set ") &&
              equal != std::string::npos)
            names.push_back(boost::trim_copy(words.substr(4, equal - 4)));
          is_continued = boost::ends_with(line, "\\");
        }
      return names;
    }

    /** Which entries of a joint are given, and by which of its passages. */
    template <int dim>
    class GivenEntries
    {
    public:
      GivenEntries(const Joint<dim> &joint,
                   const std::vector<const JointPassage *> &passages,
                   const bool is_resolved)
        : joint(joint)
      {
        int order = 0;
        for (const JointPassage *passage : passages)
          {
            // all of the file counts as one
            const bool is_override = passage->line == 0;
            order += is_override;
            for (const std::string &name : entries_given(passage->text))
              {
                order_of_entry[name] = order;
                if (is_override || !is_resolved)
                  looked_at[name] = order;
              }
          }
      }

      bool
      has(const std::string &name) const
      {
        return order_of_entry.count(name) > 0;
      }

      /** Throw InputError if an entry is given and none of those that leave it
       * without effect, @p rivals, later. @p why: the end of the sentence. */
      void
      require_idle_not_given(const std::string &name,
                             const std::vector<std::string> &rivals,
                             const std::string &why) const
      {
        const auto entry = looked_at.find(name);
        if (entry == looked_at.end())
          return;
        int latest = 0;
        for (const std::string &rival : rivals)
          if (has(rival))
            latest = std::max(latest, order_of_entry.at(rival));
        if (entry->second >= latest)
          refuse(name, why);
      }

      /** Throw InputError for an entry that has no effect. */
      void
      refuse(const std::string &name, const std::string &why) const
      {
        require(false,
                (joint.origin.empty() ? "The" : joint.origin + ": the") +
                  std::string(" entry 'Joints/") + joint.name + "/" + name +
                  "' is given, but it has no effect, since " + why);
      }

    private:
      const Joint<dim> &joint;
      std::map<std::string, int> order_of_entry; ///< 0: the file; overrides
      std::map<std::string, int> looked_at;
    };

    template <int dim>
    void
    infer_extent(const GivenEntries<dim> &given, Joint<dim> &joint)
    {
      if (given.has("Extent") || joint.extent != JointShape::infinite)
        return;
      require(joint.vertices.empty() || joint.radius == 0.,
              "The joint '" + joint.name +
                "' has both 'Vertices' and 'Radius'; keep one of them, or say "
                "with 'Joints/" +
                joint.name + "/Extent' which one counts.");
      if (!joint.vertices.empty())
        joint.extent = JointShape::polygon;
      else if (joint.radius > 0.)
        joint.extent = JointShape::disc;
    }

    /** Sizes that are not of the extent. */
    template <int dim>
    void
    check_extent(const GivenEntries<dim> &given, const Joint<dim> &joint)
    {
      const std::string why =
        "the extent of the joint is " + name_of(joint.extent) + "; ";
      if (joint.extent != JointShape::disc && joint.radius > 0.)
        given.require_idle_not_given("Radius",
                                     {"Extent", "Vertices"},
                                     why + "set 'Extent' to disc, or leave the "
                                           "radius out.");
      if (joint.extent != JointShape::polygon && !joint.vertices.empty())
        // whichever is given later: nothing else says where the joint is
        given.refuse("Vertices",
                     why + "set 'Extent' to polygon, or leave the vertices "
                           "out and say where the joint is.");
    }

    /** Places and directions where others say how the joint lies. */
    template <int dim>
    void
    check_position(const GivenEntries<dim> &given, const Joint<dim> &joint)
    {
      const bool is_polygon = joint.extent == JointShape::polygon;
      if (!joint.normal_entry.empty() || is_polygon)
        for (const char *name : {"Dip", "Dip direction"})
          {
            if (joint.normal_entry.empty())
              given.require_idle_not_given(
                name,
                {"Extent", "Vertices"},
                "'Vertices' say how the joint lies; leave one of them out, or "
                "give a joint with a dip the extent infinite or disc.");
            else
              given.require_idle_not_given(
                name,
                {"Normal"},
                "'Normal' says how the joint lies; leave one of them out.");
          }
      if (!is_polygon || joint.vertices.size() < dim)
        return;
      // (what is wrong with corners without a plane is said elsewhere)
      const double away = joint.distance(joint.point);
      if (std::abs(away) > 1e-6 * joint.vertices[0].distance(joint.vertices[1]))
        given.require_idle_not_given(
          "Point",
          {"Extent", "Vertices"},
          "'Vertices' say where the joint is, and the point is " +
            text_of(away) + " m off their plane; leave it out.");
    }
  } // namespace



  template <int dim>
  void
  settle_plane(Joint<dim> &joint,
               const std::vector<const JointPassage *> &passages,
               const bool is_resolved)
  {
    const GivenEntries<dim> given(joint, passages, is_resolved);
    if (joint.form == JointForm::plane)
      {
        infer_extent(given, joint);
        check_extent(given, joint);
        check_position(given, joint);
        return;
      }
    // (of Extent, Normal and Vertices those that make the facets say more)
    for (const char *name : {"Point", "Dip", "Dip direction", "Radius"})
      given.require_idle_not_given(name,
                                   {"Shape"},
                                   "'Shape' is " + name_of(joint.form) +
                                     "; leave it out, or set 'Shape' to "
                                     "plane.");
  }



  void
  refuse_idle_overrides(const SceneText &text, const bool has_depth)
  {
    const std::string why    = " ('Joints/Resolved' is true, as in used.prm); ";
    const std::string remedy = "run the original scene.";
    for (const SceneText::Override &entry : text.overrides)
      {
        const std::string path =
          entry.assignment.substr(0, entry.assignment.find('='));
        const std::string what = "The override --set \"" + entry.assignment +
                                 "\" would have no effect: ";
        const auto slash = path.find('/'), last = path.rfind('/');
        const std::string item =
          slash < last ? path.substr(slash + 1, last - slash - 1) : "";
        require(!boost::starts_with(path, "Joint sets/"),
                what + "the joints of the sets are already made in this scene" +
                  why +
                  (!item.empty() && is_strength(last_of(path))
                     ? "set 'Joints/" + item + "/" + last_of(path) +
                         "' for those of the set, or " + remedy
                     : remedy));
        require(path != "Joints/File",
                what + "all joints are already written out in this scene" +
                  why + remedy);
        require(!has_depth || !boost::starts_with(path, "Ground/"),
                what +
                  "what follows from it is already written out in this scene" +
                  why +
                  "set the entries of 'Initial state', 'Supports' and "
                  "'Tractions' themselves, or " +
                  remedy);
      }
  }

  template void settle_plane(Joint<2> &,
                             const std::vector<const JointPassage *> &,
                             const bool);
  template void settle_plane(Joint<3> &,
                             const std::vector<const JointPassage *> &,
                             const bool);
} // namespace Keyblock

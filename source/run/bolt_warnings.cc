// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/bolt_warnings.h>

#include <keyblock/base/number_text.h>
#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/blocks/bolt_path.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Lack of stiffness that is not warned of [-]. */
    constexpr double acceptable_lack = 0.1;
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_coarse_bolts(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    // longest way from a joint to the next node, over the decay length
    std::vector<double> farthest(scene.bolts.size(), 0.);
    for (const Bolt<dim> &bolt : split.bolts)
      for (const BoltCrossing<dim> &crossing : bolt.crossings)
        {
          const auto next         = std::upper_bound(bolt.places.begin(),
                                             bolt.places.end() - 1,
                                             crossing.begin);
          const BoltSet<dim> &set = *scene.bolts[bolt.set];
          if (*next <= set.free_length)
            continue;
          const double way =
            std::max(crossing.begin - *(next - 1), *next - crossing.begin);
          farthest[bolt.set] =
            std::max(farthest[bolt.set], way / decay_length(set));
        }
    // sets with the same text, by that
    std::map<std::string, std::string> names;
    for (unsigned int s = 0; s < scene.bolts.size(); ++s)
      {
        const BoltSet<dim> &set = *scene.bolts[s];
        const double decay      = decay_length(set);
        if (set.segment_length == 0. || !std::isfinite(decay))
          continue;
        // of a long bar in points of grout over exact, if it begins to be held
        // a way before the first of them
        const double regular = std::hypot(1., 0.5 * set.segment_length / decay),
                     ratio = 1. / (farthest[s] + 1. / (farthest[s] + regular));
        if (ratio >= 1. - acceptable_lack)
          continue;
        std::string &list = names
          [text_of(set.segment_length) +
           " m, while the force of a bolt dies away in their grout within " +
           text_of(decay, 3) + " m: until it slips, they are up to " +
           text_of(100. * (1. - ratio), 2)];
        list += (list.empty() ? "" : ", ") + set.name;
      }
    std::vector<std::string> warnings;
    for (const auto &[text, list] : names)
      warnings.push_back("The 'Segment length' of the bolts of '" + list +
                         "' is " + text +
                         " % too soft where they cross joints; their strength "
                         "is right. Lower it, or set it to 0, for segments "
                         "that are short there.");
    return warnings;
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_brittle_bolts(const Scene<dim> &scene,
                            const SplitMesh<dim> &split)
  {
    // shortest segments that cross a joint in grout; the bar in its free length
    // stretches as a whole
    std::vector<double> shortest(scene.bolts.size(),
                                 std::numeric_limits<double>::infinity());
    for (const Bolt<dim> &bolt : split.bolts)
      for (const BoltCrossing<dim> &crossing : bolt.crossings)
        {
          if (crossing.begin <= scene.bolts[bolt.set]->free_length +
                                  shortest_bolt_piece * bolt.length())
            continue;
          const auto end = std::upper_bound(bolt.places.begin(),
                                            bolt.places.end() - 1,
                                            crossing.begin);
          double &length = shortest[bolt.set];
          length         = std::min(length, *end - *(end - 1));
        }
    std::vector<std::string> warnings;
    for (unsigned int s = 0; s < scene.bolts.size(); ++s)
      {
        const BoltSet<dim> &set = *scene.bolts[s];
        if (set.rupture_strain > 0. && set.segment_length == 0. &&
            std::isfinite(shortest[s]))
          warnings.push_back(
            "Bolts of '" + set.name +
            "' break where a joint opens by 'Rupture strain' times the length "
            "of their segment there, " +
            text_of(set.rupture_strain * shortest[s], 3) +
            " m; give a 'Segment length', which is the length of bar that "
            "stretches.");
      }
    return warnings;
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_cut_bolts(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    const Ground<dim> last = {
      scene, split, 1 + static_cast<unsigned int>(scene.stages.size())};
    std::vector<unsigned int> n_cut(scene.bolts.size(), 0);
    std::vector<double> length(scene.bolts.size(), 0.);
    for (const Bolt<dim> &bolt : split.bolts)
      {
        const double cut = find_remains(bolt, last).cut_length;
        n_cut[bolt.set] += cut > 0.;
        length[bolt.set] += cut;
      }
    std::vector<std::string> warnings;
    for (unsigned int s = 0; s < scene.bolts.size(); ++s)
      if (n_cut[s] > 0)
        warnings.push_back("Later stages dig rock around " +
                           std::to_string(n_cut[s]) + " of the bolts of '" +
                           scene.bolts[s]->name + "' and cut off " +
                           text_of(length[s], 3) +
                           " m of them; only what is left in the rock bears "
                           "from then on.");
    return warnings;
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_idle_bolts(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    std::vector<unsigned int> n_bolts(scene.bolts.size(), 0),
      n_crossing(scene.bolts.size(), 0);
    for (const Bolt<dim> &bolt : split.bolts)
      {
        ++n_bolts[bolt.set];
        n_crossing[bolt.set] += !bolt.crossings.empty();
      }
    std::vector<std::string> warnings;
    for (unsigned int s = 0; s < scene.bolts.size(); ++s)
      if (n_bolts[s] > 0 && n_crossing[s] == 0 && !scene.joints.empty())
        warnings.push_back(
          "None of the " + std::to_string(n_bolts[s]) + " bolts of '" +
          scene.bolts[s]->name +
          "' crosses a joint or a void between blocks, so that they hold "
          "none; make them longer, or place them elsewhere.");
    return warnings;
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_heads_in_air(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    std::vector<unsigned int> n_heads(scene.bolts.size(), 0);
    std::vector<double> farthest(scene.bolts.size(), 0.);
    for (const Bolt<dim> &bolt : split.bolts)
      if (bolt.rock.front().cell == none)
        {
          const double gap = bolt.pieces[first_piece_in_rock(bolt)].begin;
          ++n_heads[bolt.set];
          farthest[bolt.set] = std::max(farthest[bolt.set], gap);
        }
    std::vector<std::string> warnings;
    for (unsigned int s = 0; s < scene.bolts.size(); ++s)
      if (n_heads[s] > 0)
        {
          const bool is_one = n_heads[s] == 1;
          warnings.push_back(
            (is_one ? "The head of a bolt"
                    : "The heads of " + std::to_string(n_heads[s]) + " bolts") +
            " of '" + scene.bolts[s]->name + "' " + (is_one ? "lies" : "lie") +
            " in the air, " + (is_one ? "" : "up to ") +
            text_of(farthest[s], 3) +
            " m before the rock: " + (is_one ? "it has" : "they have") +
            " no plate there, and bond alone holds the rock next to it; move " +
            (is_one ? "it" : "them") + " onto the face.");
        }
    return warnings;
  }



  namespace
  {
    /** What a set of bolts lacks in the ground into which it is put. */
    struct Lack
    {
      unsigned int n_bolts = 0, n_cut = 0, n_heads = 0, n_ends = 0;
      double cut_length = 0.; ///< of all of them [m]
    };

    std::string
    warning_of(const Lack &lack,
               const std::string &name,
               const bool is_tensioned)
    {
      std::string text = std::to_string(lack.n_cut) + " of the " +
                         std::to_string(lack.n_bolts) + " bolts of '" + name +
                         "' are installed where blocks have been taken "
                         "away: " +
                         text_of(lack.cut_length, 3) +
                         " m of them are in no rock";
      if (lack.n_heads > 0)
        text += ", " + std::to_string(lack.n_heads) + " have no rock under " +
                "their plate" +
                (is_tensioned ? " and lose their pretension" : "");
      if (lack.n_ends > 0)
        text += ", " + std::to_string(lack.n_ends) + " end in no rock";
      return text + "; move their heads to the faces that are there then.";
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_bolts_in_void(const Ground<dim> &ground)
  {
    const auto &sets = ground.scene.bolts;
    std::vector<Lack> lacks(sets.size());
    const Ground<dim> whole{ground.scene, ground.split, ground.stage_number};
    for (const Bolt<dim> &bolt : ground.split.bolts)
      {
        if (ground.scene.stage_number(sets[bolt.set]->stage) !=
            ground.stage_number)
          continue;
        const BoltRemains laid = find_remains(bolt, whole),
                          left = find_remains(bolt, ground);
        Lack &lack             = lacks[bolt.set];
        ++lack.n_bolts;
        lack.n_cut += left.cut_length > 0.;
        lack.cut_length += left.cut_length;
        lack.n_heads += laid.is_held.front() && !left.is_held.front();
        lack.n_ends += laid.is_held.back() && !left.is_held.back();
      }
    std::vector<std::string> warnings;
    for (unsigned int s = 0; s < sets.size(); ++s)
      if (lacks[s].n_cut > 0)
        warnings.push_back(
          warning_of(lacks[s], sets[s]->name, sets[s]->pretension > 0.));
    return warnings;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<std::string> warnings_of_coarse_bolts(                  \
    const Scene<dim> &, const SplitMesh<dim> &);                               \
  template std::vector<std::string> warnings_of_brittle_bolts(                 \
    const Scene<dim> &, const SplitMesh<dim> &);                               \
  template std::vector<std::string> warnings_of_idle_bolts(                    \
    const Scene<dim> &, const SplitMesh<dim> &);                               \
  template std::vector<std::string> warnings_of_heads_in_air(                  \
    const Scene<dim> &, const SplitMesh<dim> &);                               \
  template std::vector<std::string> warnings_of_cut_bolts(                     \
    const Scene<dim> &, const SplitMesh<dim> &);                               \
  template std::vector<std::string> warnings_of_bolts_in_void(                 \
    const Ground<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

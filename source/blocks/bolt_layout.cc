// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/bolt_layout.h>

#include <keyblock/base/number_text.h>
#include <keyblock/blocks/bolt_pattern.h>
#include <keyblock/mesh/cell_locator.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Segments of a bolt if the scene does not say. */
    constexpr unsigned int default_segments = 20;

    /** Halvings by which a crossing is found between two nodes. */
    constexpr unsigned int n_halvings = 45;

    /** Places between two nodes at which a bolt is looked for in rock that is
     * dug later. */
    constexpr unsigned int n_between = 7;

    /** How far beside a joint a bolt's sides are bound to the rock, over its
     * length. */
    constexpr double beside = 1e-6;

    template <int dim>
    std::string
    words_of(const Bolt<dim> &bolt, const BoltSet<dim> &set)
    {
      std::string text = "The bolt of 'Bolts/" + set.name + "' from (";
      for (const Point<dim> *p : {&bolt.head, &bolt.end})
        {
          for (unsigned int d = 0; d < dim; ++d)
            text += (d > 0 ? ", " : "") + text_of((*p)[d]);
          text += p == &bolt.head ? ") to (" : ")";
        }
      return text;
    }

    /** Its nodes at equal distances, and the rock at them: at a head or end on
     * the plane of a joint the rock that the bolt is in, whatever becomes of
     * the other side. */
    template <int dim>
    void
    divide(const BoltSet<dim> &set,
           const CellLocator<dim> &rock,
           Bolt<dim> &bolt)
    {
      const double length = bolt.length();
      const unsigned int n =
        set.segment_length > 0.
          ? std::max(1., std::ceil(length / set.segment_length - 1e-9))
          : default_segments;
      bool is_grouted = false;
      for (unsigned int i = 0; i <= n; ++i)
        {
          bolt.places.push_back(length * i / n);
          const Point<dim> place = bolt.at(bolt.places.back());
          bolt.rock.push_back(
            i == 0   ? rock.find_towards(place, bolt.direction())
            : i == n ? rock.find_towards(place, -bolt.direction())
                     : rock.find(place));
          is_grouted = is_grouted || (bolt.places.back() >= set.free_length &&
                                      bolt.rock.back().cell != none);
        }
      AssertThrow(bolt.rock.back().cell != none,
                  InputError(words_of(bolt, set) +
                             " does not end in rock of stage '" + set.stage +
                             "'; move its end, or shorten it."));
      AssertThrow(is_grouted,
                  InputError(words_of(bolt, set) +
                             " has no grouted part in the rock; shorten "
                             "'Free length'."));
    }

    /** A place between nodes @p j and j + 1, k of n_between + 1 parts on. */
    template <int dim>
    double
    place_between(const Bolt<dim> &bolt,
                  const unsigned int j,
                  const unsigned int k)
    {
      const double share = double(k) / (n_between + 1);
      return (1. - share) * bolt.places[j] + share * bolt.places[j + 1];
    }

    /** Cells between a bolt's nodes. */
    template <int dim>
    std::vector<unsigned int>
    list_passed(const Bolt<dim> &bolt, const CellLocator<dim> &rock)
    {
      std::vector<unsigned int> passed;
      for (unsigned int j = 0; j + 1 < bolt.places.size(); ++j)
        for (unsigned int k = 1; k <= n_between; ++k)
          passed.push_back(rock.find(bolt.at(place_between(bolt, j, k))).cell);
      return passed;
    }

    /** Cell at a place_between(), nodes included. */
    template <int dim>
    unsigned int
    cell_between(const Bolt<dim> &bolt,
                 const unsigned int j,
                 const unsigned int k)
    {
      if (k == 0 || k == n_between + 1)
        return bolt.rock[k == 0 ? j : j + 1].cell;
      return bolt.passed[n_between * j + k - 1];
    }

    /** The joint of the cell's face nearest to a crossing, and its normal. */
    template <int dim>
    void
    find_joint(const Mesh<dim> &mesh,
               const unsigned int cell,
               const Point<dim> &point,
               BoltCrossing<dim> &crossing)
    {
      double nearest = std::numeric_limits<double>::max();
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        if (mesh.joint[cell][f] != none)
          {
            const Tensor<1, dim> area   = mesh.face_area_vector(cell, f);
            const Tensor<1, dim> normal = area / area.norm();
            const double distance =
              std::abs((point - mesh.face_center(cell, f)) * normal);
            if (distance < nearest)
              {
                nearest         = distance;
                crossing.joint  = mesh.joint[cell][f];
                crossing.normal = normal;
              }
          }
    }

    /** Where a bolt goes from one block to another, as far as there is rock. */
    template <int dim>
    std::vector<BoltCrossing<dim>>
    list_crossings(const Bolt<dim> &bolt,
                   const CellLocator<dim> &rock,
                   const SplitMesh<dim> &split)
    {
      const auto block_of = [&](const unsigned int cell) {
        return cell == none ? none : split.block_of_cell[cell];
      };
      const auto block_at = [&](const double place) {
        return block_of(rock.find(bolt.at(place)).cell);
      };
      std::vector<BoltCrossing<dim>> crossings;
      for (unsigned int j = 0; j + 1 < bolt.places.size(); ++j)
        for (unsigned int k = 0; k <= n_between; ++k)
          {
            const unsigned int before = block_of(cell_between(bolt, j, k)),
                               behind = block_of(cell_between(bolt, j, k + 1));
            if (before == behind || before == none || behind == none)
              continue;
            double near = place_between(bolt, j, k),
                   far  = place_between(bolt, j, k + 1);
            for (unsigned int i = 0; i < n_halvings; ++i)
              {
                const double middle                       = 0.5 * (near + far);
                (block_at(middle) == before ? near : far) = middle;
              }
            BoltCrossing<dim> crossing;
            const double aside = beside * bolt.length();
            crossing.place     = 0.5 * (near + far);
            crossing.side      = {{rock.find(bolt.at(crossing.place - aside)),
                                   rock.find(bolt.at(crossing.place + aside))}};
            crossing.block     = {{block_of(crossing.side[0].cell),
                                   block_of(crossing.side[1].cell)}};
            if (crossing.side[0].cell != none)
              find_joint(split.mesh,
                         crossing.side[0].cell,
                         bolt.at(crossing.place),
                         crossing);
            if (crossing.joint != none)
              crossings.push_back(crossing);
          }
      return crossings;
    }

    /** Put a node between two joints that have none between them. */
    template <int dim>
    void
    add_nodes_between_joints(const CellLocator<dim> &rock, Bolt<dim> &bolt)
    {
      const unsigned int n_before = bolt.places.size();
      for (unsigned int c = 0; c + 1 < bolt.crossings.size(); ++c)
        {
          const double first = bolt.crossings[c].place,
                       last  = bolt.crossings[c + 1].place;
          const auto next =
            std::upper_bound(bolt.places.begin(), bolt.places.end(), first);
          if (*next < last)
            continue;
          const double middle = 0.5 * (first + last);
          bolt.rock.insert(bolt.rock.begin() + (next - bolt.places.begin()),
                           rock.find(bolt.at(middle)));
          bolt.places.insert(next, middle);
        }
      if (bolt.places.size() > n_before)
        bolt.passed = list_passed(bolt, rock);
    }

    /**
     * How far the grout of the nodes at both ends of a segment goes into it
     * [m]: to the joint that it crosses; to where the rock ends, half between
     * two places that were looked at; or to the middle, if there is rock all
     * the way.
     */
    template <int dim, typename IsRock>
    std::array<double, 2>
    divide_grout(const Bolt<dim> &bolt,
                 const unsigned int j,
                 const IsRock &is_rock)
    {
      std::array<double, 2> border{{bolt.places[j + 1], bolt.places[j]}};
      bool is_crossed = false;
      for (const BoltCrossing<dim> &crossing : bolt.crossings)
        if (crossing.place >= bolt.places[j] &&
            crossing.place < bolt.places[j + 1])
          {
            border.fill(crossing.place);
            is_crossed = true;
          }
      unsigned int last = 0, first = n_between + 1;
      while (last <= n_between && is_rock(cell_between(bolt, j, last + 1)))
        ++last;
      while (first > 0 && is_rock(cell_between(bolt, j, first - 1)))
        --first;
      if (last <= n_between)
        border[0] = std::min(border[0],
                             0.5 * (place_between(bolt, j, last) +
                                    place_between(bolt, j, last + 1)));
      if (first > 0)
        border[1] = std::max(border[1],
                             0.5 * (place_between(bolt, j, first - 1) +
                                    place_between(bolt, j, first)));
      if (last > n_between && first == 0 && !is_crossed)
        border.fill(0.5 * (bolt.places[j] + bolt.places[j + 1]));
      return border;
    }
  } // namespace



  namespace
  {
    /** Throw InputError if the grout that holds a bolt against its plate bears
     * less than its pretension. */
    template <int dim>
    void
    check_pretension(const Bolt<dim> &bolt,
                     const BoltSet<dim> &set,
                     const Ground<dim> &ground)
    {
      if (set.pretension == 0.)
        return;
      const BoltRemains remains = find_remains(bolt, ground);
      AssertThrow(remains.is_held[0],
                  InputError(words_of(bolt, set) +
                             " has no rock at its head, against which its "
                             "plate could bear the 'Pretension'; move its "
                             "head."));
      const double length = remains.grouted_length(set.free_length),
                   most   = set.bond_strength * length;
      AssertThrow(set.pretension <= (1. + 1e-9) * most,
                  InputError(
                    words_of(bolt, set) + " has a 'Pretension' of " +
                    text_of(set.pretension) + " N, more than its grout of " +
                    text_of(length, 4) + " m in the rock bears (" +
                    text_of(most) +
                    " N); lower it, or raise 'Bond strength' or the length "
                    "that is grouted."));
    }
  } // namespace



  double
  BoltRemains::grouted_length(const double free_length) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < grout.size(); ++i)
      if (is_held[i])
        sum += std::max(0., grout[i][1] - std::max(grout[i][0], free_length));
    return sum;
  }



  template <int dim>
  std::vector<Bolt<dim>>
  lay_out_bolts(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    std::vector<Bolt<dim>> bolts;
    for (unsigned int s = 0; s < scene.bolts.size(); ++s)
      {
        const BoltSet<dim> &set  = *scene.bolts[s];
        const Ground<dim> ground = {scene,
                                    split,
                                    scene.stage_number(set.stage)};
        std::vector<Bolt<dim>> of_set;
        for (unsigned int i = 0; i < set.heads.size(); ++i)
          of_set.emplace_back(s, set.heads[i], set.ends[i]);
        if (set.is_pattern())
          of_set = set_out_pattern(set, s, ground);
        const CellLocator<dim> rock(split.mesh, [&](const unsigned int c) {
          return !ground.is_excavated(c);
        });
        for (Bolt<dim> &bolt : of_set)
          {
            divide(set, rock, bolt);
            bolt.passed    = list_passed(bolt, rock);
            bolt.crossings = list_crossings(bolt, rock, split);
            add_nodes_between_joints(rock, bolt);
            check_pretension(bolt, set, ground);
            bolts.push_back(bolt);
          }
      }
    return bolts;
  }



  template <int dim>
  BoltRemains
  find_remains(const Bolt<dim> &bolt, const Ground<dim> &ground)
  {
    const unsigned int installed =
      ground.scene.stage_number(ground.scene.bolts[bolt.set]->stage);
    // rock around the bolt that is no longer there, or not the same
    const auto is_dug = [&](const unsigned int cell) {
      if (cell == none)
        return false;
      const unsigned int dug = ground.split.mesh.excavation_stage[cell];
      return ground.is_excavated(cell) ||
             (dug > installed && dug <= ground.stage_number);
    };
    BoltRemains remains;
    std::vector<bool> node_is_dug;
    for (const CellPoint<dim> &point : bolt.rock)
      {
        node_is_dug.push_back(is_dug(point.cell));
        remains.is_held.push_back(point.cell != none && !node_is_dug.back());
      }
    const unsigned int n = bolt.places.size() - 1;
    remains.grout.assign(n + 1, {{bolt.places[0], bolt.places[n]}});
    for (unsigned int j = 0; j < n; ++j)
      {
        const std::array<double, 2> border =
          divide_grout(bolt, j, [&](const unsigned int cell) {
            return cell != none && !is_dug(cell);
          });
        remains.grout[j][1]     = border[0];
        remains.grout[j + 1][0] = border[1];
        const auto first        = bolt.passed.begin() + j * n_between;
        const auto last         = first + n_between;
        remains.is_cut.push_back(node_is_dug[j] || node_is_dug[j + 1] ||
                                 std::any_of(first, last, is_dug));
        if (remains.is_cut.back())
          remains.cut_length += bolt.places[j + 1] - bolt.places[j];
      }
    return remains;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<Bolt<dim>> lay_out_bolts(const Scene<dim> &,            \
                                                const SplitMesh<dim> &);       \
  template BoltRemains find_remains(const Bolt<dim> &, const Ground<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

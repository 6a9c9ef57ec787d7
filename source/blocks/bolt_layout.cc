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

    /** Its nodes, and the rock at them. */
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
          bolt.rock.push_back(rock.find(bolt.at(bolt.places.back())));
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

    /** Whether anything is dug after stage @p number. */
    template <int dim>
    bool
    is_dug_after(const Scene<dim> &scene, const unsigned int number)
    {
      return std::any_of(scene.excavations.begin(),
                         scene.excavations.end(),
                         [&](const auto &excavation) {
                           return scene.stage_number(excavation->stage) >
                                  number;
                         });
    }

    /** Cells between a bolt's nodes. */
    template <int dim>
    std::vector<unsigned int>
    list_passed(const Bolt<dim> &bolt, const CellLocator<dim> &rock)
    {
      std::vector<unsigned int> passed;
      for (unsigned int j = 0; j + 1 < bolt.places.size(); ++j)
        for (unsigned int k = 1; k <= n_between; ++k)
          {
            const double share = double(k) / (n_between + 1);
            passed.push_back(rock
                               .find(bolt.at((1. - share) * bolt.places[j] +
                                             share * bolt.places[j + 1]))
                               .cell);
          }
      return passed;
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
      const auto block_of = [&](const CellPoint<dim> &point) {
        return point.cell == none ? none : split.block_of_cell[point.cell];
      };
      std::vector<BoltCrossing<dim>> crossings;
      for (unsigned int i = 1; i < bolt.places.size(); ++i)
        {
          const unsigned int before = block_of(bolt.rock[i - 1]),
                             behind = block_of(bolt.rock[i]);
          if (before == behind || before == none || behind == none)
            continue;
          double near = bolt.places[i - 1], far = bolt.places[i];
          for (unsigned int k = 0; k < n_halvings; ++k)
            {
              const double middle = 0.5 * (near + far);
              (block_of(rock.find(bolt.at(middle))) == before ? near : far) =
                middle;
            }
          BoltCrossing<dim> crossing;
          const double aside = beside * bolt.length();
          crossing.place     = 0.5 * (near + far);
          crossing.side      = {{rock.find(bolt.at(crossing.place - aside)),
                                 rock.find(bolt.at(crossing.place + aside))}};
          crossing.block     = {
                {block_of(crossing.side[0]), block_of(crossing.side[1])}};
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
  } // namespace



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
            bolt.crossings = list_crossings(bolt, rock, split);
            if (is_dug_after(scene, ground.stage_number))
              bolt.passed = list_passed(bolt, rock);
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
    for (unsigned int j = 0; j < n; ++j)
      {
        const auto first = bolt.passed.begin() + j * bolt.passed.size() / n;
        const auto last =
          bolt.passed.begin() + (j + 1) * bolt.passed.size() / n;
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

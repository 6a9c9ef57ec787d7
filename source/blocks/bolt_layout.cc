// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/bolt_layout.h>

#include <keyblock/base/number_text.h>
#include <keyblock/blocks/bolt_path.h>
#include <keyblock/blocks/bolt_pattern.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace Keyblock
{
  namespace
  {
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

    /** Distance of a head before the free face, over the size of the cell
     * there, up to which it is taken as on that face [-]. */
    constexpr double head_tolerance = 0.1;

    /** trace_bolt(), with a head that lies a little in the air moved onto the
     * free face. */
    template <int dim>
    void
    trace_from_face(const CellLocator<dim> &rock,
                    const SplitMesh<dim> &split,
                    const BoltSet<dim> &set,
                    Bolt<dim> &bolt)
    {
      const Bolt<dim> as_given = bolt;
      trace_bolt(rock, split, set, bolt);
      const unsigned int first = first_piece_in_rock(bolt);
      if (first == 0 || first == bolt.pieces.size())
        return;
      const CellPiece piece = bolt.pieces[first];
      if (piece.begin >
          head_tolerance *
            std::pow(split.mesh.cell_volume(piece.cell), 1. / dim))
        return;
      bolt      = as_given;
      bolt.head = as_given.at(piece.begin);
      for (double &place : bolt.places)
        place = std::max(0., place - piece.begin);
      trace_bolt(rock, split, set, bolt);
    }

    /** Throw InputError if a bolt does not end in rock, or has no grout there.
     */
    template <int dim>
    void
    check_place(const Bolt<dim> &bolt, const BoltSet<dim> &set)
    {
      AssertThrow(bolt.rock.back().cell != none,
                  InputError(words_of(bolt, set) +
                             " does not end in rock of stage '" + set.stage +
                             "'; move its end, or shorten it."));
      bool is_grouted = false;
      for (unsigned int i = 0; i < bolt.places.size(); ++i)
        is_grouted = is_grouted || (bolt.places[i] >= set.free_length &&
                                    bolt.rock[i].cell != none);
      AssertThrow(is_grouted,
                  InputError(words_of(bolt, set) +
                             " has no grouted part in the rock; shorten "
                             "'Free length'."));
    }

    /**
     * How far the grout of the nodes at both ends of a segment goes into it
     * [m]: as far as the rock of their blocks does, or to the middle, if that
     * is the same all the way. @p block_of gives the block of a piece, nothing
     * where there is no rock.
     */
    template <int dim, typename BlockOf>
    std::array<double, 2>
    divide_grout(const Bolt<dim> &bolt,
                 const unsigned int j,
                 const BlockOf &block_of)
    {
      const double begin = bolt.places[j], end = bolt.places[j + 1];
      const unsigned int first = bolt.piece_at(begin),
                         last  = bolt.piece_at(end);
      std::array<double, 2> border{{begin, end}};
      for (unsigned int k = first; k <= last; ++k)
        {
          if (!block_of(k) || block_of(k) != block_of(first))
            break;
          border[0] = std::min(end, bolt.pieces[k].end);
        }
      for (unsigned int k = last + 1; k-- > first;)
        {
          if (!block_of(k) || block_of(k) != block_of(last))
            break;
          border[1] = std::max(begin, bolt.pieces[k].begin);
        }
      bool is_whole = block_of(first).has_value();
      for (unsigned int k = first + 1; k <= last; ++k)
        is_whole = is_whole && block_of(k) == block_of(first);
      if (is_whole)
        border.fill(0.5 * (begin + end));
      return border;
    }

    /** Whether any piece on a segment is one for which @p is_dug holds. */
    template <int dim, typename IsDug>
    bool
    is_any_dug(const Bolt<dim> &bolt, const unsigned int j, const IsDug &is_dug)
    {
      const double begin = bolt.places[j], end = bolt.places[j + 1],
                   least = shortest_bolt_piece * bolt.length();
      for (unsigned int k = bolt.piece_at(begin); k <= bolt.piece_at(end); ++k)
        {
          const CellPiece &piece = bolt.pieces[k];
          if (is_dug(piece.cell) &&
              std::min(end, piece.end) - std::max(begin, piece.begin) > least)
            return true;
        }
      return false;
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
            trace_from_face(rock, split, set, bolt);
            check_place(bolt, set);
            check_pretension(bolt, set, ground);
            bolts.push_back(bolt);
          }
      }
    return bolts;
  }



  template <int dim>
  std::vector<Bolt<dim>>
  lay_out_bolts_like(const std::vector<Bolt<dim>> &bolts,
                     const Scene<dim> &scene,
                     const SplitMesh<dim> &split)
  {
    std::vector<Bolt<dim>> laid;
    std::unique_ptr<CellLocator<dim>> rock;
    unsigned int set = none;
    for (const Bolt<dim> &bolt : bolts)
      {
        const BoltSet<dim> &of_set = *scene.bolts[bolt.set];
        if (set != bolt.set)
          {
            const Ground<dim> ground = {scene,
                                        split,
                                        scene.stage_number(of_set.stage)};
            rock                     = std::make_unique<CellLocator<dim>>(
              split.mesh,
              [&](const unsigned int c) { return !ground.is_excavated(c); });
            set = bolt.set;
          }
        laid.emplace_back(bolt.set, bolt.head, bolt.end);
        laid.back().places = bolt.places;
        trace_from_face(*rock, split, of_set, laid.back());
      }
    return laid;
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
    const auto block_of =
      [&](const unsigned int piece) -> std::optional<unsigned int> {
      const unsigned int cell = bolt.pieces[piece].cell;
      if (cell == none || is_dug(cell))
        return {};
      return ground.split.block_of_cell[cell];
    };
    for (unsigned int j = 0; j < n; ++j)
      {
        const std::array<double, 2> border = divide_grout(bolt, j, block_of);
        remains.grout[j][1]                = border[0];
        remains.grout[j + 1][0]            = border[1];
        remains.is_cut.push_back(node_is_dug[j] || node_is_dug[j + 1] ||
                                 is_any_dug(bolt, j, is_dug));
        if (remains.is_cut.back())
          remains.cut_length += bolt.places[j + 1] - bolt.places[j];
      }
    return remains;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<Bolt<dim>> lay_out_bolts(const Scene<dim> &,            \
                                                const SplitMesh<dim> &);       \
  template BoltRemains find_remains(const Bolt<dim> &, const Ground<dim> &);   \
  template std::vector<Bolt<dim>> lay_out_bolts_like(                          \
    const std::vector<Bolt<dim>> &,                                            \
    const Scene<dim> &,                                                        \
    const SplitMesh<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

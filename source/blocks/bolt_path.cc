// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/bolt_path.h>
#include <keyblock/mesh/cell_line.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Segments of a bolt, at least, if the scene does not say. */
    constexpr unsigned int default_segments = 20;

    /** Segments then at the head and where blocks part, over the length in
     * which the force of elastic grout dies away (the stiffness there is wrong
     * by an eighth of the square, where a node lies on a joint by a third), and
     * how fast they grow from there [-]. */
    constexpr double finest_segment = 0.2, growth = 0.3;

    /** Shortest segment then, over the length of the bolt [-]. */
    constexpr double least_segment = 1e-3;

    /** Pieces of a bolt one behind the other in one block, or in rock that is
     * in none until it is dug. */
    struct Stretch
    {
      CellPiece first, last;
      unsigned int block = none;
    };

    template <int dim>
    std::vector<Stretch>
    list_stretches(const Bolt<dim> &bolt, const SplitMesh<dim> &split)
    {
      std::vector<Stretch> stretches;
      bool goes_on = false;
      for (const CellPiece &piece : bolt.pieces)
        {
          if (piece.cell == none)
            {
              goes_on = false;
              continue;
            }
          const unsigned int block = split.block_of_cell[piece.cell];
          if (goes_on && stretches.back().block == block)
            stretches.back().last = piece;
          else
            stretches.push_back({piece, piece, block});
          goes_on = true;
        }
      return stretches;
    }

    /** Distances that divide @p length into @p n equal segments. */
    std::vector<double>
    divide_equally(const double length, const unsigned int n)
    {
      std::vector<double> places;
      for (unsigned int i = 0; i <= n; ++i)
        places.push_back(length * i / n);
      places.back() = length;
      return places;
    }

    /** Distances of nodes that are @p finest apart where the bolt begins to
     * bear, and further apart away from there. */
    template <int dim>
    std::vector<double>
    divide_by_force(const Bolt<dim> &bolt,
                    const double free_length,
                    const double finest)
    {
      std::vector<double> loaded = {0., free_length};
      for (const BoltCrossing<dim> &crossing : bolt.crossings)
        loaded.insert(loaded.end(), {crossing.begin, crossing.end});
      const double length  = bolt.length();
      const auto wanted_at = [&](const double s) {
        double wanted = length / default_segments;
        for (const double place : loaded)
          wanted = std::min(wanted, finest + growth * std::abs(s - place));
        return wanted;
      };
      std::vector<double> places = {0.};
      while (places.back() < length)
        {
          const double s = places.back();
          places.push_back(s + wanted_at(s + 0.5 * wanted_at(s)));
        }
      // to the nearer of the last two
      if (places.back() - length > length - *(places.end() - 2))
        places.pop_back();
      const double scale = length / places.back();
      for (double &place : places)
        place *= scale;
      places.back() = length;
      return places;
    }

    /** Distances of the nodes from the head. */
    template <int dim>
    std::vector<double>
    set_out_nodes(const Bolt<dim> &bolt,
                  const std::vector<Stretch> &stretches,
                  const BoltSet<dim> &set)
    {
      const double length = bolt.length();
      const double finest =
        std::max(finest_segment * decay_length(set), least_segment * length);
      std::vector<double> places =
        set.segment_length > 0.
          ? divide_equally(
              length,
              std::max(1., std::ceil(length / set.segment_length - 1e-9)))
        : finest < length / default_segments
          ? divide_by_force(bolt, set.free_length, finest)
          : divide_equally(length, default_segments);
      for (const Stretch &stretch : stretches)
        {
          const double begin = stretch.first.begin, end = stretch.last.end;
          // behind its begin, as Bolt::piece_at(); the head is in the first
          const auto next =
            std::upper_bound(places.begin(), places.end(), begin);
          if (begin > 0. && *next > end)
            places.insert(next, 0.5 * (begin + end));
        }
      return places;
    }

    /** The joint of the cell's face nearest to a point, and its normal. */
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

    template <int dim>
    BoltCrossing<dim>
    cross(const Bolt<dim> &bolt,
          const Stretch &before,
          const Stretch &behind,
          const CellLocator<dim> &rock,
          const Mesh<dim> &mesh)
    {
      BoltCrossing<dim> crossing;
      crossing.begin = before.last.end;
      crossing.end   = behind.first.begin;
      crossing.block = {{before.block, behind.block}};
      crossing.side  = {
         {rock.find_in(before.last.cell, bolt.at(crossing.begin)),
          rock.find_in(behind.first.cell, bolt.at(crossing.end))}};
      if (crossing.begin == crossing.end)
        {
          const Point<dim> place = bolt.at(crossing.begin);
          find_joint(mesh, before.last.cell, place, crossing);
          // (beside slivers that rounding leaves only the far side is on it)
          if (crossing.joint == none)
            {
              find_joint(mesh, behind.first.cell, place, crossing);
              crossing.normal *= -1.;
            }
        }
      return crossing;
    }
  } // namespace



  template <int dim>
  double
  decay_length(const BoltSet<dim> &set)
  {
    return set.bond_stiffness > 0.
             ? std::sqrt(set.young_modulus * set.area / set.bond_stiffness)
             : std::numeric_limits<double>::infinity();
  }



  template <int dim>
  void
  trace_bolt(const CellLocator<dim> &rock,
             const SplitMesh<dim> &split,
             const BoltSet<dim> &set,
             Bolt<dim> &bolt)
  {
    bolt.pieces                          = cut_by_cells(split.mesh,
                               rock,
                               bolt.head,
                               bolt.end,
                               shortest_bolt_piece * bolt.length(),
                               split.block_of_cell);
    const std::vector<Stretch> stretches = list_stretches(bolt, split);
    for (unsigned int k = 1; k < stretches.size(); ++k)
      if (stretches[k - 1].block != stretches[k].block &&
          stretches[k - 1].block != none && stretches[k].block != none)
        bolt.crossings.push_back(
          cross(bolt, stretches[k - 1], stretches[k], rock, split.mesh));
    if (bolt.places.empty())
      bolt.places = set_out_nodes(bolt, stretches, set);
    for (const double place : bolt.places)
      bolt.rock.push_back(
        rock.find_in(bolt.pieces[bolt.piece_at(place)].cell, bolt.at(place)));
  }



  template <int dim>
  unsigned int
  first_piece_in_rock(const Bolt<dim> &bolt)
  {
    return std::find_if(bolt.pieces.begin(),
                        bolt.pieces.end(),
                        [](const CellPiece &piece) {
                          return piece.cell != none;
                        }) -
           bolt.pieces.begin();
  }

#define INSTANTIATE(dim)                                                       \
  template double decay_length(const BoltSet<dim> &);                          \
  template unsigned int first_piece_in_rock(const Bolt<dim> &);                \
  template void trace_bolt(const CellLocator<dim> &,                           \
                           const SplitMesh<dim> &,                             \
                           const BoltSet<dim> &,                               \
                           Bolt<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

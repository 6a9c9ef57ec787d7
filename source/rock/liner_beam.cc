// SPDX-License-Identifier: LGPL-2.1-or-later
// Liners in 2D: chains of segments that are stretched and bend at their points.
#include <keyblock/rock/liner_shell.h>


namespace Keyblock
{
  namespace
  {
    constexpr unsigned int nothing = -1;

    /** Segments that end and begin at a point, `nothing` where there is none or
     * more than one. */
    struct SegmentJoint
    {
      unsigned int before = nothing, after = nothing;
      unsigned int n_before = 0, n_after = 0;
    };

    struct Segment
    {
      unsigned int begin, end;
      double length;
      Tensor<1, 2> way, to_opening; ///< unit
    };

    /** Adds up rows of a piece, point by point. */
    struct RowOfPiece
    {
      LinerPiece<2> piece;

      void
      add(const unsigned int point, const Tensor<1, 2> &row)
      {
        for (unsigned int i = 0; i < piece.points.size(); ++i)
          if (piece.points[i] == point)
            {
              piece.rows[i][0] += row;
              return;
            }
        piece.points.push_back(point);
        piece.rows.push_back({{row}});
      }

      /** @p factor times the stretch of a segment [m] and its rotation [-]. */
      void
      add_stretch(const Segment &s, const double factor)
      {
        add(s.begin, -factor * s.way);
        add(s.end, factor * s.way);
      }
      void
      add_rotation(const Segment &s, const double factor)
      {
        add(s.begin, -factor / s.length * s.to_opening);
        add(s.end, factor / s.length * s.to_opening);
      }
    };

    /** A piece without rows yet that bends at the point @p p. */
    RowOfPiece
    begin_bending(const LinerSection &section,
                  const unsigned int p,
                  const Tensor<1, 2> &way,
                  const double length)
    {
      RowOfPiece bend;
      bend.piece.is_bending      = true;
      bend.piece.face            = p;
      bend.piece.area            = length;
      bend.piece.axes[0]         = way;
      bend.piece.stiffness[0][0] = section.bending;
      return bend;
    }

    LinerPiece<2>
    bend_between(const LinerSection &section,
                 const Segment &before,
                 const Segment &after)
    {
      const double length = 0.5 * (before.length + after.length);
      RowOfPiece bend = begin_bending(section, after.begin, after.way, length);
      bend.add_rotation(before, 1. / length);
      bend.add_rotation(after, -1. / length);
      return bend.piece;
    }

    /** At an end where the chain goes on as its mirror image. */
    LinerPiece<2>
    bend_at_mirror(const LinerSection &section,
                   const Segment &segment,
                   const bool is_at_begin)
    {
      RowOfPiece bend = begin_bending(section,
                                      is_at_begin ? segment.begin : segment.end,
                                      segment.way,
                                      0.5 * segment.length);
      bend.add_rotation(segment, (is_at_begin ? -2. : 2.) / segment.length);
      return bend.piece;
    }
  } // namespace



  std::vector<LinerPiece<2>>
  make_liner_pieces(const LinerSection &section,
                    const std::vector<Point<2>> &points,
                    const std::vector<LinedFace<2>> &faces)
  {
    std::vector<LinerPiece<2>> pieces;
    std::vector<Segment> segments;
    std::vector<SegmentJoint> joints(points.size());
    for (const LinedFace<2> &face : faces)
      {
        Segment s{face.points[0], face.points[1], 0., {}, {}};
        s.way    = points[s.end] - points[s.begin];
        s.length = s.way.norm();
        s.way /= s.length;
        s.to_opening[0] = -s.way[1];
        s.to_opening[1] = s.way[0];
        RowOfPiece stretch;
        stretch.piece.is_bending      = false;
        stretch.piece.face            = segments.size();
        stretch.piece.area            = s.length;
        stretch.piece.axes[0]         = s.way;
        stretch.piece.stiffness[0][0] = section.membrane;
        stretch.add_stretch(s, 1. / s.length);
        pieces.push_back(stretch.piece);
        joints[s.begin].after = segments.size();
        ++joints[s.begin].n_after;
        joints[s.end].before = segments.size();
        ++joints[s.end].n_before;
        segments.push_back(s);
      }
    for (const SegmentJoint &joint : joints)
      if (joint.n_before == 1 && joint.n_after == 1)
        pieces.push_back(
          bend_between(section, segments[joint.before], segments[joint.after]));
      else if (joint.n_before + joint.n_after == 1)
        {
          const bool is_at_begin = joint.n_after == 1;
          const unsigned int f   = is_at_begin ? joint.after : joint.before;
          if (faces[f].is_mirrored[is_at_begin ? 0 : 1])
            pieces.push_back(bend_at_mirror(section, segments[f], is_at_begin));
        }
    return pieces;
  }
} // namespace Keyblock

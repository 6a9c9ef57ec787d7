// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/bolt_layout.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/mesh/excavation_region.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Segments of a bolt if the scene does not say. */
    constexpr unsigned int default_segments = 20;

    /** Halvings by which a crossing is found between two nodes. */
    constexpr unsigned int n_halvings = 45;

    /** A straight piece of the outline of an excavation's section, and the
     * normal there, into the rock. */
    template <int dim>
    struct Piece
    {
      Point<dim> begin, end;
      Tensor<1, dim> inward;
    };

    template <int dim>
    using Outline = std::vector<Piece<dim>>;

    template <int dim>
    std::string
    section_of(const BoltSet<dim> &set)
    {
      return "Bolts/" + set.name;
    }

    template <int dim>
    std::string
    text_of(const Point<dim> &p)
    {
      std::ostringstream out;
      for (unsigned int d = 0; d < dim; ++d)
        out << (d ? ", " : "") << p[d];
      return out.str();
    }

    /** Whether a face with the normal @p inward is of one of the parts. */
    template <int dim>
    bool
    is_of_parts(const Tensor<1, dim> &inward,
                const std::vector<std::string> &parts)
    {
      const double up        = inward[dim - 1];
      const std::string part = std::abs(up) < std::sqrt(0.5) ? "walls"
                               : up > 0.                     ? "roof"
                                                             : "floor";
      return std::find(parts.begin(), parts.end(), part) != parts.end();
    }

    /** Free faces of the rock beside one of the set's excavations. */
    template <int dim>
    std::vector<CellFace>
    list_faces(const BoltSet<dim> &set, const Ground<dim> &ground)
    {
      const Mesh<dim> &mesh = ground.split.mesh;
      std::vector<CellFace> found;
      for (const CellFace &f : list_free_faces(ground))
        {
          if (mesh.boundary[f.cell][f.face] != none)
            continue;
          const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
          const double depth = 1e-3 * std::pow(area.norm(), 1. / (dim - 1));
          const Point<dim> outside =
            mesh.face_center(f.cell, f.face) + depth / area.norm() * area;
          const unsigned int across = mesh.neighbor[f.cell][f.face];
          for (unsigned int e = 0; e < ground.scene.excavations.size(); ++e)
            {
              const auto &excavation = *ground.scene.excavations[e];
              if (std::find(set.excavations.begin(),
                            set.excavations.end(),
                            excavation.name) == set.excavations.end())
                continue;
              if ((across != none && mesh.excavation_stage[across] > 0 &&
                   mesh.excavation[across] == e) ||
                  (excavation.shape != ExcavationShape::formula &&
                   depth_inside(excavation, outside) > 0.))
                {
                  found.push_back(f);
                  break;
                }
            }
        }
      return found;
    }

    /** Where the plane of a ring cuts a face: nothing, or a piece. */
    void
    add_cut(const Mesh<3> &mesh,
            const CellFace &face,
            const Tensor<1, 3> &axis,
            const double place,
            Outline<3> &pieces)
    {
      const Tensor<1, 3> area = mesh.face_area_vector(face.cell, face.face);
      const auto vertices     = mesh.face_vertices(face.cell, face.face);
      // around the face, not in the order of its vertices
      const std::array<unsigned int, 4> around = {{0, 1, 3, 2}};
      std::vector<Point<3>> points;
      for (unsigned int i = 0; i < 4; ++i)
        {
          const Point<3> &a = mesh.vertices[vertices[around[i]]],
                         &b = mesh.vertices[vertices[around[(i + 1) % 4]]];
          const double u = a * axis - place, v = b * axis - place;
          if ((u > 0.) != (v > 0.))
            points.push_back(a + u / (u - v) * (b - a));
        }
      if (points.size() != 2 || points[0].distance(points[1]) == 0.)
        return;
      Tensor<1, 3> inward = -area / area.norm();
      inward -= (inward * axis) * axis;
      if (inward.norm() > 0.1) // not the end of a cavern
        pieces.push_back({points[0], points[1], inward / inward.norm()});
    }

    /** Put pieces that touch into rows, each from one end to the other. */
    template <int dim>
    std::vector<Outline<dim>>
    put_in_rows(const Outline<dim> &pieces)
    {
      double size = 0.;
      for (const Piece<dim> &piece : pieces)
        size = std::max(size, piece.begin.distance(piece.end));
      const auto key = [&](const Point<dim> &p) {
        std::array<long long, dim> k;
        for (unsigned int d = 0; d < dim; ++d)
          k[d] = std::llround(p[d] / (1e-6 * size));
        return k;
      };
      std::map<std::array<long long, dim>, std::vector<unsigned int>> at;
      for (unsigned int i = 0; i < pieces.size(); ++i)
        for (const Point<dim> &p : {pieces[i].begin, pieces[i].end})
          at[key(p)].push_back(i);

      std::vector<bool> is_used(pieces.size(), false);
      std::vector<Outline<dim>> rows;
      const auto walk = [&](const unsigned int first, const Point<dim> &from) {
        rows.emplace_back();
        unsigned int i    = first;
        Point<dim> corner = from;
        while (true)
          {
            is_used[i]        = true;
            Piece<dim> piece  = pieces[i];
            const bool is_fwd = key(piece.begin) == key(corner);
            if (!is_fwd)
              std::swap(piece.begin, piece.end);
            rows.back().push_back(piece);
            corner                  = piece.end;
            const unsigned int last = i;
            for (const unsigned int other : at[key(corner)])
              if (!is_used[other])
                {
                  i = other;
                  break;
                }
            if (i == last)
              return;
          }
      };
      // open rows from their ends, then closed ones from anywhere
      for (unsigned int i = 0; i < pieces.size(); ++i)
        for (const Point<dim> &p : {pieces[i].begin, pieces[i].end})
          if (!is_used[i] && at[key(p)].size() == 1)
            walk(i, p);
      for (unsigned int i = 0; i < pieces.size(); ++i)
        if (!is_used[i])
          walk(i, pieces[i].begin);
      return rows;
    }

    /** Bolts along a row, the first and the last as far from its ends. */
    template <int dim>
    void
    add_along(const Outline<dim> &row,
              const BoltSet<dim> &set,
              const unsigned int index,
              const Tensor<1, dim> &axis,
              std::vector<Bolt<dim>> &bolts)
    {
      double length = 0.;
      for (const Piece<dim> &piece : row)
        length += piece.begin.distance(piece.end);
      const unsigned int n =
        std::max(1., std::floor(length / set.spacing[0] + 1e-9));
      double next    = 0.5 * (length - (n - 1) * set.spacing[0]);
      double passed  = 0.;
      unsigned int k = 0;
      for (const Piece<dim> &piece : row)
        {
          const double here = piece.begin.distance(piece.end);
          for (; k < n && next <= passed + here + 1e-9 * length;
               next += set.spacing[0], ++k)
            {
              const double share =
                std::min(1., std::max(0., (next - passed) / here));
              const Point<dim> head =
                piece.begin + share * (piece.end - piece.begin);
              const double angle = set.inclination * dealii::numbers::PI / 180.;
              Tensor<1, dim> across;
              if (dim == 2)
                {
                  across[0] = -piece.inward[1];
                  across[1] = piece.inward[0];
                }
              else
                across = axis;
              Tensor<1, dim> way =
                std::cos(angle) * piece.inward + std::sin(angle) * across;
              if (set.direction.norm() > 0.)
                way = set.direction / set.direction.norm();
              bolts.push_back({index, head, head + set.length * way, {}, {}});
            }
          passed += here;
        }
    }

    template <int dim>
    Tensor<1, dim>
    axis_of(const BoltSet<dim> &set,
            const Mesh<dim> &mesh,
            const std::vector<CellFace> &faces)
    {
      if (set.axis.norm() > 0.)
        return set.axis / set.axis.norm();
      Point<dim> low  = mesh.face_center(faces[0].cell, faces[0].face),
                 high = low;
      for (const CellFace &f : faces)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double x = mesh.face_center(f.cell, f.face)[d];
            low[d]         = std::min(low[d], x);
            high[d]        = std::max(high[d], x);
          }
      unsigned int longest = 0;
      for (unsigned int d = 0; d + 1 < dim; ++d) // not upwards
        if (high[d] - low[d] > high[longest] - low[longest])
          longest = d;
      Tensor<1, dim> axis;
      axis[longest] = 1.;
      return axis;
    }

    template <int dim>
    std::vector<Outline<dim>>
    list_rings(const BoltSet<dim> &set,
               const Mesh<dim> &mesh,
               const std::vector<CellFace> &faces,
               const Tensor<1, dim> &axis)
    {
      std::vector<Outline<dim>> rings;
      if constexpr (dim == 2)
        {
          (void)axis;
          (void)set;
          rings.emplace_back();
          for (const CellFace &f : faces)
            {
              const auto v              = mesh.face_vertices(f.cell, f.face);
              const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
              rings[0].push_back({mesh.vertices[v[0]],
                                  mesh.vertices[v[1]],
                                  -area / area.norm()});
            }
        }
      else
        {
          double low = 1e300, high = -1e300;
          for (const CellFace &f : faces)
            for (const unsigned int v : mesh.face_vertices(f.cell, f.face))
              {
                low  = std::min(low, mesh.vertices[v] * axis);
                high = std::max(high, mesh.vertices[v] * axis);
              }
          const unsigned int n =
            std::max(1., std::floor((high - low) / set.spacing[1] + 1e-9));
          const double first =
            low + 0.5 * (high - low - (n - 1) * set.spacing[1]);
          for (unsigned int k = 0; k < n; ++k)
            {
              rings.emplace_back();
              for (const CellFace &f : faces)
                add_cut(
                  mesh, f, axis, first + k * set.spacing[1], rings.back());
            }
        }
      return rings;
    }

    template <int dim>
    void
    add_pattern(const BoltSet<dim> &set,
                const unsigned int index,
                const Ground<dim> &ground,
                std::vector<Bolt<dim>> &bolts)
    {
      const std::vector<CellFace> faces = list_faces(set, ground);
      std::vector<Bolt<dim>> pattern;
      if (!faces.empty())
        {
          const Mesh<dim> &mesh     = ground.split.mesh;
          const Tensor<1, dim> axis = axis_of(set, mesh, faces);
          for (const Outline<dim> &ring : list_rings(set, mesh, faces, axis))
            {
              Outline<dim> wanted;
              for (const Piece<dim> &piece : ring)
                if (is_of_parts<dim>(piece.inward, set.parts))
                  wanted.push_back(piece);
              for (const Outline<dim> &row : put_in_rows<dim>(wanted))
                add_along<dim>(row, set, index, axis, pattern);
            }
        }
      if (!set.region.empty())
        {
          const Expression<dim> inside(set.region,
                                       1,
                                       section_of(set) + "/Region");
          pattern.erase(std::remove_if(pattern.begin(),
                                       pattern.end(),
                                       [&](const Bolt<dim> &bolt) {
                                         return inside.value(bolt.head,
                                                             0.,
                                                             0) <= 0.;
                                       }),
                        pattern.end());
        }
      AssertThrow(!pattern.empty(),
                  InputError("The bolts '" + section_of(set) +
                             "' have no place: after stage '" + set.stage +
                             "' there is no free face of their excavations, "
                             "'Parts' and 'Region'; correct these, or their "
                             "'Stage'."));
      bolts.insert(bolts.end(), pattern.begin(), pattern.end());
    }

    template <int dim>
    void
    divide(const BoltSet<dim> &set, Bolt<dim> &bolt)
    {
      const double length = bolt.length();
      const unsigned int n =
        set.segment_length > 0.
          ? std::max(1., std::ceil(length / set.segment_length - 1e-9))
          : default_segments;
      bolt.places.clear();
      for (unsigned int i = 0; i <= n; ++i)
        bolt.places.push_back(length * i / n);
    }

    template <int dim>
    void
    require_rock(const Bolt<dim> &bolt,
                 const BoltSet<dim> &set,
                 const CellLocator<dim> &rock)
    {
      AssertThrow(rock.find(bolt.end),
                  InputError("The bolt of '" + section_of(set) + "' from (" +
                             text_of<dim>(bolt.head) + ") to (" +
                             text_of<dim>(bolt.end) +
                             ") does not end in rock of stage '" + set.stage +
                             "'; move its end, or shorten it."));
      double grouted = 0.;
      for (const double s : bolt.places)
        if (s >= set.free_length && rock.find(bolt.at(s)))
          grouted += 1.;
      AssertThrow(grouted > 0.,
                  InputError("The bolt of '" + section_of(set) + "' from (" +
                             text_of<dim>(bolt.head) + ") to (" +
                             text_of<dim>(bolt.end) +
                             ") has no grouted part in the rock; shorten "
                             "'Free length'."));
    }

    /** Where a bolt goes from one block to another, as far as there is rock. */
    template <int dim>
    std::vector<BoltCrossing<dim>>
    list_crossings(const Bolt<dim> &bolt,
                   const CellLocator<dim> &rock,
                   const SplitMesh<dim> &split)
    {
      const Mesh<dim> &mesh = split.mesh;
      const auto block_at   = [&](const double s) {
        const auto place = rock.find(bolt.at(s));
        return place ? split.block_of_cell[place->cell] : none;
      };
      std::vector<BoltCrossing<dim>> crossings;
      unsigned int before = block_at(bolt.places[0]);
      for (unsigned int i = 1; i < bolt.places.size(); ++i)
        {
          const unsigned int now = block_at(bolt.places[i]);
          if (now == before || now == none || before == none)
            {
              before = now;
              continue;
            }
          double near = bolt.places[i - 1], far = bolt.places[i];
          for (unsigned int k = 0; k < n_halvings; ++k)
            {
              const double middle                       = 0.5 * (near + far);
              (block_at(middle) == before ? near : far) = middle;
            }
          BoltCrossing<dim> crossing;
          crossing.place  = 0.5 * (near + far);
          crossing.block  = {{before, block_at(far)}};
          const auto cell = rock.find(bolt.at(near));
          double nearest  = 1e300;
          for (unsigned int f = 0; cell && f < Mesh<dim>::n_cell_faces; ++f)
            if (mesh.joint[cell->cell][f] != none)
              {
                const Tensor<1, dim> area =
                  mesh.face_area_vector(cell->cell, f);
                const double distance =
                  std::abs((bolt.at(crossing.place) -
                            mesh.face_center(cell->cell, f)) *
                           area) /
                  area.norm();
                if (distance < nearest)
                  {
                    nearest         = distance;
                    crossing.joint  = mesh.joint[cell->cell][f];
                    crossing.normal = area / area.norm();
                  }
              }
          if (crossing.joint != none)
            crossings.push_back(crossing);
          before = now;
        }
      return crossings;
    }
  } // namespace



  template <int dim>
  CellLocator<dim>
  locate_rock(const Ground<dim> &ground)
  {
    return CellLocator<dim>(ground.split.mesh, [&](const unsigned int c) {
      const unsigned int block = ground.split.block_of_cell[c];
      return !ground.is_excavated(c) &&
             !(ground.is_removed && !ground.is_removed->empty() &&
               block != none && (*ground.is_removed)[block]);
    });
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
          of_set.push_back({s, set.heads[i], set.ends[i], {}, {}});
        if (set.is_pattern())
          add_pattern(set, s, ground, of_set);
        const CellLocator<dim> rock = locate_rock(ground);
        for (Bolt<dim> &bolt : of_set)
          {
            divide(set, bolt);
            require_rock(bolt, set, rock);
            bolt.crossings = list_crossings(bolt, rock, split);
            bolts.push_back(bolt);
          }
      }
    return bolts;
  }



#define INSTANTIATE(dim)                                                       \
  template CellLocator<dim> locate_rock(const Ground<dim> &);                  \
  template std::vector<Bolt<dim>> lay_out_bolts(const Scene<dim> &,            \
                                                const SplitMesh<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/rock_cut.h>

#include <algorithm>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** A joint that cuts rock. */
    template <int dim>
    struct CutThroughRock
    {
      const PlaneExtent<dim> &extent;
      const std::vector<unsigned int> &excavation_of_cell;

      bool
      reaches(const ExactPlane<dim> &plane, const int side) const
      {
        return extent.reaches(plane, side);
      }
      bool
      enters(const unsigned int cell) const
      {
        return cell >= excavation_of_cell.size() ||
               excavation_of_cell[cell] == ConvexCells<dim>::nothing;
      }
      bool
      overlaps(const std::vector<Point<dim>> &section) const
      {
        return extent.overlaps(section);
      }
    };
  } // namespace



  template <int dim>
  RockCut<dim>::RockCut(const PlaneScene<dim> &scene,
                        const PlaneBlockOptions &options)
    : cells(scene.sides.empty() ? ConvexCells<dim>(scene.box)
                                : ConvexCells<dim>(scene.box, scene.sides))
    , scene(scene)
    , options(options)
  {
    excavate();
    cut_joints();
  }



  template <int dim>
  void
  RockCut<dim>::excavate()
  {
    // the earliest stage counts where parts overlap
    std::vector<unsigned int> order(scene.excavations.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       return scene.excavations[a].stage <
                              scene.excavations[b].stage;
                     });
    excavation_of_cell.assign(1, nothing);
    for (const unsigned int piece : order)
      {
        n_stages = std::max(n_stages, scene.excavations[piece].stage);
        excavate(piece);
      }
  }



  /** Cut a part of an excavation out of the rock that is left. */
  template <int dim>
  void
  RockCut<dim>::excavate(const unsigned int piece)
  {
    std::vector<unsigned int> inside;
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
      if (excavation_of_cell[c] == nothing)
        inside.push_back(c);
    for (const auto &side : scene.excavations[piece].sides)
      {
        const auto outward =
          cells.add_plane(side.point, side.outward, options.narrow);
        if (outward.plane == nothing)
          {
            if (outward.side > 0)
              return;
            continue;
          }
        std::vector<unsigned int> rest;
        for (const unsigned int c : inside)
          {
            const unsigned int minus = cells.cut_cell(c, outward.plane);
            if (minus == nothing)
              {
                if (cells.side_of_cell(c, outward.plane) != outward.side)
                  rest.push_back(c);
              }
            else
              rest.push_back(outward.side > 0 ? minus : c);
          }
        inside = rest;
        excavation_of_cell.resize(cells.n_cells(), nothing);
      }
    const unsigned int index = scene.excavations[piece].excavation;
    stage_of_excavation.resize(std::max<std::size_t>(stage_of_excavation.size(),
                                                     index + 1),
                               0);
    stage_of_excavation[index] = scene.excavations[piece].stage;
    for (const unsigned int c : inside)
      excavation_of_cell[c] = index;
  }



  /** Whether a joint may touch an excavation or a free side of the domain. */
  template <int dim>
  bool
  RockCut<dim>::touches_excavation(const PlaneExtent<dim> &extent) const
  {
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
      {
        const auto &cell = cells.cell(c);
        if (excavation_of_cell[c] != nothing)
          {
            const auto &plane     = cells.plane(extent.plane.plane);
            const auto has_vertex = [&](const int side) {
              return std::any_of(cell.vertices.begin(),
                                 cell.vertices.end(),
                                 [&](const auto &vertex) {
                                   return side * plane.distance(vertex.x) >=
                                          -extent.tolerance;
                                 });
            };
            const auto reaches = [&](const auto &facet) {
              return extent.reaches(cells.plane(facet.plane), facet.side);
            };
            if (has_vertex(-1) && has_vertex(+1) &&
                std::all_of(cell.facets.begin(), cell.facets.end(), reaches))
              return true;
          }
        else
          for (const auto &facet : cell.facets)
            if (facet.domain_side != nothing &&
                !scene.is_truncated[facet.domain_side] &&
                extent.reaches(cells.plane(facet.plane), -facet.side))
              return true;
      }
    return false;
  }



  template <int dim>
  void
  RockCut<dim>::cut_joints()
  {
    for (const JointPiece<dim> &piece : scene.joints)
      {
        PlaneExtent<dim> extent(piece, cells, options.bridging);
        if (!extent.meets_box())
          continue;
        extent.plane =
          cells.add_plane(piece.point, piece.normal, options.narrow);
        if (extent.plane.plane != nothing)
          extents.push_back(extent);
      }
    if (options.leave_out)
      {
        std::vector<bool> touches;
        for (const auto &extent : extents)
          touches.push_back(touches_excavation(extent));
        std::vector<PlaneExtent<dim>> rest;
        for (const unsigned int i :
             find_relevant_extents(extents, touches, cells))
          rest.push_back(extents[i]);
        extents.swap(rest);
      }
    if (options.largest_first)
      std::stable_sort(extents.begin(),
                       extents.end(),
                       [](const auto &a, const auto &b) {
                         return a.size() > b.size();
                       });
    extents_of_plane.resize(cells.n_planes());
    for (unsigned int e = 0; e < extents.size(); ++e)
      {
        const unsigned int plane = extents[e].plane.plane;
        extents_of_plane[plane].push_back(e);
        cells.cut(plane, CutThroughRock<dim>{extents[e], excavation_of_cell});
      }
    excavation_of_cell.resize(cells.n_cells(), nothing);
    // which joint a face is of does not depend on the order of the cuts
    for (auto &list : extents_of_plane)
      {
        std::stable_sort(list.begin(),
                         list.end(),
                         [&](const unsigned int a, const unsigned int b) {
                           const unsigned int i = extents[a].joint,
                                              j = extents[b].joint;
                           return scene.rules && i != j ? scene.rules(i, j)
                                                        : i < j;
                         });
      }
  }



  template <int dim>
  unsigned int
  RockCut<dim>::closing_extent(const unsigned int plane,
                               const std::vector<Point<dim>> &polygon) const
  {
    const auto &list = extents_of_plane[plane];
    for (const unsigned int e : list)
      if (extents[e].covers(polygon))
        return e;
    if (list.size() < 2)
      return nothing;
    std::vector<const PlaneExtent<dim> *> together;
    for (const unsigned int e : list)
      together.push_back(&extents[e]);
    return cover_together(together, polygon, options.narrow / cells.length())
             ? list[0]
             : nothing;
  }



  template <int dim>
  bool
  RockCut<dim>::has_choice(const unsigned int plane,
                           const std::vector<Point<dim>> &polygon) const
  {
    unsigned int joint = nothing;
    for (const unsigned int e : extents_of_plane[plane])
      if (extents[e].joint != joint && extents[e].covers(polygon))
        {
          if (joint != nothing)
            return true;
          joint = extents[e].joint;
        }
    return false;
  }



  template class RockCut<2>;
  template class RockCut<3>;
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/blocks/plane_blocks.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    /** Length of a segment, or area vector of a polygon over its normal. */
    template <int dim>
    double
    area_of_outline(const std::vector<Point<dim>> &corners)
    {
      if constexpr (dim == 2)
        return corners[0].distance(corners[1]);
      else
        {
          Tensor<1, dim> sum;
          for (unsigned int i = 2; i < corners.size(); ++i)
            sum += cross_product_3d(corners[i - 1] - corners[0],
                                    corners[i] - corners[0]);
          return 0.5 * sum.norm();
        }
    }

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

    template <int dim>
    class PlaneBlockFinder
    {
    public:
      PlaneBlockFinder(const PlaneScene<dim> &scene,
                       const PlaneBlockOptions &options)
        : scene(scene)
        , options(options)
        , result(scene.sides.empty() ? ConvexCells<dim>(scene.box)
                                     : ConvexCells<dim>(scene.box, scene.sides))
      {}

      PlaneBlocks<dim>
      run()
      {
        excavate();
        cut_joints();
        find_contacts();
        join_dust();
        measure_blocks();
        list_faces();
        classify_blocks();
        return std::move(result);
      }

    private:
      static constexpr unsigned int nothing = ConvexCells<dim>::nothing;
      using Face                            = typename PlaneBlocks<dim>::Face;
      using FreeFace = typename PlaneBlocks<dim>::FreeFace;

      /** Two cells on both sides of a plane. */
      struct Link
      {
        unsigned int minus, plus, plane;
        unsigned int extent; ///< that closes it; or nothing
        std::vector<Point<dim>> outline;
      };

      void excavate();
      void excavate(const unsigned int piece);
      bool touches_excavation(const PlaneExtent<dim> &extent);
      void cut_joints();
      void find_contacts();
      unsigned int closing_extent(const unsigned int plane,
                                  const std::vector<Point<dim>> &units) const;
      void join_dust();
      void measure_blocks();
      void list_faces();
      void add_domain_sides(const unsigned int cell);
      void add_free_face(const Link &link, const bool is_plus);
      void classify_blocks();

      const PlaneScene<dim> &scene;
      const PlaneBlockOptions &options;
      PlaneBlocks<dim> result;
      std::vector<unsigned int> stages; ///< of excavations
      std::vector<PlaneExtent<dim>> extents;
      std::vector<std::vector<unsigned int>> extents_of_plane;
      DisjointSets sets{0}; ///< of cells
      std::vector<Link> links;
      std::vector<std::pair<unsigned int, unsigned int>> narrow_links;
      std::vector<typename ConvexCells<dim>::Measures> measures; ///< of cells
    };



    template <int dim>
    void
    PlaneBlockFinder<dim>::excavate()
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
      result.excavation_of_cell.assign(1, nothing);
      for (const unsigned int piece : order)
        {
          result.n_stages =
            std::max(result.n_stages, scene.excavations[piece].stage);
          excavate(piece);
        }
    }



    /** Cut a part of an excavation out of the rock that is left. */
    template <int dim>
    void
    PlaneBlockFinder<dim>::excavate(const unsigned int piece)
    {
      auto &cells = result.cells;
      std::vector<unsigned int> inside;
      for (unsigned int c = 0; c < cells.n_cells(); ++c)
        if (result.excavation_of_cell[c] == nothing)
          inside.push_back(c);
      for (const auto &side : scene.excavations[piece].sides)
        {
          const auto outward = cells.add_plane(side.point, side.outward);
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
          result.excavation_of_cell.resize(cells.n_cells(), nothing);
        }
      const unsigned int index = scene.excavations[piece].excavation;
      stages.resize(std::max<std::size_t>(stages.size(), index + 1), 0);
      stages[index] = scene.excavations[piece].stage;
      for (const unsigned int c : inside)
        result.excavation_of_cell[c] = index;
    }



    /** Whether a joint may touch an excavation or a free side of the domain. */
    template <int dim>
    bool
    PlaneBlockFinder<dim>::touches_excavation(const PlaneExtent<dim> &extent)
    {
      for (unsigned int c = 0; c < result.cells.n_cells(); ++c)
        {
          const auto &cell = result.cells.cell(c);
          if (result.excavation_of_cell[c] != nothing)
            {
              const auto &plane     = result.cells.plane(extent.plane.plane);
              const auto has_vertex = [&](const int side) {
                return std::any_of(cell.vertices.begin(),
                                   cell.vertices.end(),
                                   [&](const auto &vertex) {
                                     return side * plane.distance(vertex.x) >=
                                            -extent.tolerance;
                                   });
              };
              const auto reaches = [&](const auto &facet) {
                return extent.reaches(result.cells.plane(facet.plane),
                                      facet.side);
              };
              if (has_vertex(-1) && has_vertex(+1) &&
                  std::all_of(cell.facets.begin(), cell.facets.end(), reaches))
                return true;
            }
          else
            for (const auto &facet : cell.facets)
              if (facet.domain_side != nothing &&
                  !scene.is_truncated[facet.domain_side] &&
                  extent.reaches(result.cells.plane(facet.plane), -facet.side))
                return true;
        }
      return false;
    }



    template <int dim>
    void
    PlaneBlockFinder<dim>::cut_joints()
    {
      for (const JointPiece<dim> &piece : scene.joints)
        {
          PlaneExtent<dim> extent(piece, result.cells, options.bridging);
          if (!extent.meets_box())
            continue;
          extent.plane = result.cells.add_plane(piece.point, piece.normal);
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
               find_relevant_extents(extents, touches, result.cells))
            rest.push_back(extents[i]);
          extents.swap(rest);
        }
      result.n_joints_used = extents.size();
      if (options.largest_first)
        std::stable_sort(extents.begin(),
                         extents.end(),
                         [](const auto &a, const auto &b) {
                           return a.size() > b.size();
                         });
      extents_of_plane.resize(result.cells.n_planes());
      for (unsigned int e = 0; e < extents.size(); ++e)
        {
          const unsigned int plane = extents[e].plane.plane;
          extents_of_plane[plane].push_back(e);
          result.cells.cut(plane,
                           CutThroughRock<dim>{extents[e],
                                               result.excavation_of_cell});
        }
      result.excavation_of_cell.resize(result.cells.n_cells(), nothing);
      // names of faces do not depend on the order of the cuts
      for (auto &list : extents_of_plane)
        std::stable_sort(list.begin(),
                         list.end(),
                         [&](const unsigned int a, const unsigned int b) {
                           return extents[a].joint < extents[b].joint;
                         });
    }



    /** The extent that covers a polygon on a plane, the first of those that do
     * so together, or nothing. */
    template <int dim>
    unsigned int
    PlaneBlockFinder<dim>::closing_extent(
      const unsigned int plane,
      const std::vector<Point<dim>> &units) const
    {
      const auto &list = extents_of_plane[plane];
      for (const unsigned int e : list)
        if (extents[e].covers(units))
          return e;
      if (list.size() < 2)
        return nothing;
      std::vector<const PlaneExtent<dim> *> together;
      for (const unsigned int e : list)
        together.push_back(&extents[e]);
      return cover_together(together,
                            units,
                            options.narrow / result.cells.length())
               ? list[0]
               : nothing;
    }



    template <int dim>
    void
    PlaneBlockFinder<dim>::find_contacts()
    {
      const auto &cells      = result.cells;
      const auto &excavation = result.excavation_of_cell;
      sets                   = DisjointSets(cells.n_cells());
      std::vector<Point<dim>> units;
      cells.for_each_contact([&](const auto &contact) {
        const bool are_rock = excavation[contact.minus] == nothing &&
                              excavation[contact.plus] == nothing;
        if (excavation[contact.minus] != nothing &&
            excavation[contact.plus] != nothing)
          return;
        if (are_rock && extents_of_plane[contact.plane].empty() &&
            sets.root(contact.minus) == sets.root(contact.plus))
          return;
        units.clear();
        for (const auto &corner : contact.polygon)
          units.push_back(corner.vertex.x);
        const unsigned int extent = closing_extent(contact.plane, units);
        const bool is_open        = extent == nothing;
        if (are_rock && is_open)
          {
            if (is_narrow(units, options.narrow / cells.length()))
              narrow_links.emplace_back(contact.minus, contact.plus);
            else
              sets.join(contact.minus, contact.plus);
            return;
          }
        links.push_back(
          {contact.minus, contact.plus, contact.plane, extent, {}});
        for (const Point<dim> &x : units)
          links.back().outline.push_back(cells.to_metres(x));
      });
    }



    /** Blocks that are nothing but rounding go to one beside them: to one that
     * they are open to, or else to that of the largest common polygon. */
    template <int dim>
    void
    PlaneBlockFinder<dim>::join_dust()
    {
      const unsigned int n = result.cells.n_cells();
      std::vector<double> volume(n, 0.);
      for (unsigned int c = 0; c < n; ++c)
        {
          measures.push_back(result.cells.measures(c));
          volume[sets.root(c)] += measures[c].volume;
        }
      const auto is_dust = [&](const unsigned int a, const unsigned int b) {
        return std::min(volume[sets.root(a)], volume[sets.root(b)]) <
               options.dust;
      };
      const auto join_if_dust = [&](const unsigned int a,
                                    const unsigned int b) {
        const unsigned int p = sets.root(a), q = sets.root(b);
        if (p == q || !is_dust(p, q))
          return;
        const double sum = volume[p] + volume[q];
        sets.join(p, q);
        volume[sets.root(p)] = sum;
      };
      for (const auto &[a, b] : narrow_links)
        join_if_dust(a, b);
      std::vector<std::pair<double, const Link *>> closed; // by area
      for (const Link &link : links)
        if (result.excavation_of_cell[link.minus] == nothing &&
            result.excavation_of_cell[link.plus] == nothing &&
            is_dust(link.minus, link.plus))
          closed.emplace_back(-area_of_outline(link.outline), &link);
      std::stable_sort(closed.begin(),
                       closed.end(),
                       [](const auto &a, const auto &b) {
                         return a.first < b.first;
                       });
      for (const auto &[area, link] : closed)
        join_if_dust(link->minus, link->plus);
    }



    template <int dim>
    void
    PlaneBlockFinder<dim>::measure_blocks()
    {
      const auto &cells    = result.cells;
      const unsigned int n = cells.n_cells();
      std::vector<Block<dim>> found;
      std::vector<Tensor<1, dim>> moments;
      std::vector<unsigned int> number(n, nothing);
      // (the root of a set is its first cell)
      for (unsigned int c = 0; c < n; ++c)
        if (result.excavation_of_cell[c] == nothing)
          {
            if (sets.root(c) == c)
              {
                number[c] = found.size();
                found.emplace_back();
                moments.emplace_back();
              }
            number[c]         = number[sets.root(c)];
            Block<dim> &block = found[number[c]];
            ++block.n_cells;
            block.volume += measures[c].volume;
            moments[number[c]] +=
              measures[c].volume * (measures[c].centroid - scene.box.center());
            for (const auto &facet : cells.cell(c).facets)
              block.is_infinite =
                block.is_infinite || (facet.domain_side != nothing &&
                                      scene.is_truncated[facet.domain_side]);
          }
      for (unsigned int b = 0; b < found.size(); ++b)
        if (found[b].volume > 0.)
          found[b].centroid = scene.box.center() + moments[b] / found[b].volume;
      const std::vector<unsigned int> order = rank_blocks(found);
      std::vector<unsigned int> rank(found.size());
      for (unsigned int b = 0; b < order.size(); ++b)
        {
          rank[order[b]] = b;
          result.blocks.push_back(found[order[b]]);
          result.blocks.back().id = b + 1;
        }
      result.block_of_cell.assign(n, nothing);
      for (unsigned int c = 0; c < n; ++c)
        if (number[c] != nothing)
          {
            result.block_of_cell[c] = rank[number[c]];
            Block<dim> &block       = result.blocks[rank[number[c]]];
            for (const auto &vertex : cells.cell(c).vertices)
              block.size = std::max(block.size,
                                    2. * block.centroid.distance(
                                           cells.to_metres(vertex.x)));
          }
    }



    /** Faces on sides of the domain where rock ends. */
    template <int dim>
    void
    PlaneBlockFinder<dim>::add_domain_sides(const unsigned int c)
    {
      const auto &cells = result.cells;
      for (const auto &facet : cells.cell(c).facets)
        if (facet.domain_side != nothing &&
            !scene.is_truncated[facet.domain_side])
          {
            FreeFace face{0,
                          nothing,
                          facet.domain_side,
                          nothing,
                          0.,
                          double(facet.side) * cells.plane(facet.plane).normal,
                          {}};
            for (const auto &corner : cells.polygon_of(cells.cell(c), facet))
              face.outline.push_back(cells.to_metres(corner.vertex.x));
            face.area = area_of_outline(face.outline);
            result.free_faces[result.block_of_cell[c]].push_back(face);
          }
    }



    /** A face of rock on an excavation. */
    template <int dim>
    void
    PlaneBlockFinder<dim>::add_free_face(const Link &link, const bool is_plus)
    {
      const unsigned int own        = is_plus ? link.plus : link.minus,
                         other      = is_plus ? link.minus : link.plus,
                         excavation = result.excavation_of_cell[other];
      unsigned int joint            = nothing;
      if (link.extent != nothing)
        joint = extents[link.extent].joint;
      result.free_faces[result.block_of_cell[own]].push_back(
        {stages[excavation],
         excavation,
         nothing,
         joint,
         area_of_outline(link.outline),
         (is_plus ? 1. : -1.) * result.cells.plane(link.plane).normal,
         link.outline});
    }



    template <int dim>
    void
    PlaneBlockFinder<dim>::list_faces()
    {
      const unsigned int n = result.blocks.size();
      result.faces.resize(n);
      result.free_faces.resize(n);
      for (unsigned int c = 0; c < result.cells.n_cells(); ++c)
        if (result.block_of_cell[c] != nothing)
          add_domain_sides(c);
      // block, joint, neighbour, plane, side of it: index into its faces
      std::map<std::array<unsigned int, 5>, unsigned int> index;
      for (const Link &link : links)
        {
          const unsigned int minus = result.block_of_cell[link.minus],
                             plus  = result.block_of_cell[link.plus];
          for (const bool is_plus : {false, true})
            {
              const unsigned int own   = is_plus ? plus : minus,
                                 other = is_plus ? minus : plus;
              if (own == nothing || own == other)
                continue;
              if (other == nothing)
                {
                  add_free_face(link, is_plus);
                  continue;
                }
              const PlaneExtent<dim> &extent = extents[link.extent];
              const int side = (is_plus ? 1 : -1) * extent.plane.side;
              auto &faces    = result.faces[own];
              const auto [entry, is_new] = index.try_emplace(
                {{own, extent.joint, other, link.plane, is_plus}},
                faces.size());
              if (is_new)
                faces.push_back(
                  {extent.joint,
                   side,
                   other,
                   0.,
                   (is_plus ? 1. : -1.) * result.cells.plane(link.plane).normal,
                   {}});
              Face &face = faces[entry->second];
              face.area += area_of_outline(link.outline);
              face.outlines.push_back(link.outline);
            }
        }
    }



    template <int dim>
    void
    PlaneBlockFinder<dim>::classify_blocks()
    {
      for (unsigned int b = 0; b < result.blocks.size(); ++b)
        {
          Block<dim> &block = result.blocks[b];
          std::vector<Tensor<1, dim>> inward;
          for (const Face &face : result.faces[b])
            {
              block.joint_area[face.joint] += face.area;
              block.joint_side[face.joint] = face.side;
              if (std::find(inward.begin(), inward.end(), face.normal) ==
                  inward.end())
                inward.push_back(face.normal);
            }
          block.is_removable = !block.is_infinite && is_removable<dim>(inward);
          for (unsigned int s = 0; s <= result.n_stages; ++s)
            {
              bool is_free = false, is_attached = false;
              for (const FreeFace &face : result.free_faces[b])
                {
                  is_free = is_free || face.stage <= s;
                  is_attached =
                    is_attached || (face.stage > s && face.joint == nothing);
                }
              BlockClass kind = BlockClass::hidden;
              if (block.is_infinite)
                kind = BlockClass::infinite;
              else if (is_attached)
                kind = BlockClass::attached;
              else if (is_free)
                kind = BlockClass::exposed;
              block.class_of_stage.push_back(kind);
              if (is_free && kind != BlockClass::attached &&
                  block.exposed_stage == Keyblock::none)
                block.exposed_stage = s;
            }
        }
    }
  } // namespace



  template <int dim>
  PlaneBlocks<dim>
  find_plane_blocks(const PlaneScene<dim> &scene,
                    const PlaneBlockOptions &options)
  {
    return PlaneBlockFinder<dim>(scene, options).run();
  }



#define INSTANTIATE(dim)                                                       \
  template struct PlaneBlocks<dim>;                                            \
  template PlaneBlocks<dim> find_plane_blocks(const PlaneScene<dim> &,         \
                                              const PlaneBlockOptions &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/blocks/plane_blocks.h>
#include <keyblock/blocks/rock_cut.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    class PlaneBlockFinder
    {
    public:
      explicit PlaneBlockFinder(const PlaneScene<dim> &scene,
                                const PlaneBlockOptions &options)
        : scene(scene)
        , options(options)
        , rock(scene, options)
        , extents(rock.extents)
        , result(std::move(rock.cells))
      {
        result.excavation_of_cell = rock.excavation_of_cell;
        result.options            = options;
        result.n_stages           = rock.n_stages;
        result.n_joints_used      = rock.extents.size();
      }

      PlaneBlocks<dim>
      run()
      {
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

      bool
      is_rock(const unsigned int cell) const
      {
        return result.excavation_of_cell[cell] == nothing;
      }

      std::vector<Point<dim>>
      outline_of(const unsigned int cell,
                 const typename ConvexCells<dim>::Facet &facet) const
      {
        std::vector<Point<dim>> outline;
        for (const auto &corner :
             result.cells.polygon_of(result.cells.cell(cell), facet))
          outline.push_back(result.cells.to_metres(corner.vertex.x));
        return outline;
      }

      void find_contacts();
      void join_dust();
      void measure_blocks();
      void list_faces();
      void add_domain_sides(const unsigned int cell);
      void add_free_face(const Link &link, const bool is_plus);
      void classify_blocks();

      const PlaneScene<dim> &scene;
      const PlaneBlockOptions &options;
      RockCut<dim> rock;
      const std::vector<PlaneExtent<dim>> &extents;
      PlaneBlocks<dim> result;
      DisjointSets sets{0}; ///< of cells
      std::vector<Link> links;
      std::vector<std::pair<unsigned int, unsigned int>> narrow_links;
      std::vector<typename ConvexCells<dim>::Measures> measures; ///< of cells
    };



    template <int dim>
    void
    PlaneBlockFinder<dim>::find_contacts()
    {
      const auto &cells = result.cells;
      sets              = DisjointSets(cells.n_cells());
      std::vector<Point<dim>> units;
      cells.for_each_contact([&](const auto &contact) {
        result.joint_of_contact.push_back(nothing);
        const bool are_rock = is_rock(contact.minus) && is_rock(contact.plus);
        if (!is_rock(contact.minus) && !is_rock(contact.plus))
          return;
        if (are_rock && rock.extents_of_plane[contact.plane].empty() &&
            sets.root(contact.minus) == sets.root(contact.plus))
          return;
        units.clear();
        for (const auto &corner : contact.polygon)
          units.push_back(corner.vertex.x);
        const unsigned int extent = rock.closing_extent(contact.plane, units);
        const bool is_open        = extent == nothing;
        if (!is_open)
          {
            result.joint_of_contact.back() = extents[extent].joint;
            result.has_shared_places =
              result.has_shared_places || rock.has_choice(contact.plane, units);
          }
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



    /** Blocks that are nothing but rounding go to one beside them: to one
     * that they are open to, or else to that of the largest common polygon. */
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
        if (p == q || !is_dust(p, q) || !is_rock(a) || !is_rock(b))
          return;
        const double sum = volume[p] + volume[q];
        sets.join(p, q);
        volume[sets.root(p)] = sum;
      };
      for (const auto &[a, b] : narrow_links)
        join_if_dust(a, b);
      std::vector<std::pair<double, const Link *>> closed; // by area
      for (const Link &link : links)
        if (is_rock(link.minus) && is_rock(link.plus) &&
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
        if (is_rock(c))
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
                block.is_infinite ||
                (facet.domain_side != nothing &&
                 scene.is_truncated[facet.domain_side] &&
                 !is_narrow(outline_of(c, facet), options.narrow));
          }
      for (const Link &link : links)
        for (const auto &[own, other] :
             {std::pair(link.plus, link.minus), {link.minus, link.plus}})
          if (number[other] == nothing &&
              result.excavation_of_cell[other] == scene.beyond &&
              !is_narrow(link.outline, options.narrow))
            found[number[own]].is_infinite = true;
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
            face.outline = outline_of(c, facet);
            face.area    = area_of_outline(face.outline);
            if (is_narrow(face.outline, options.narrow))
              continue;
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
      if (excavation == scene.beyond || is_narrow(link.outline, options.narrow))
        return;
      const unsigned int joint =
        link.extent != nothing ? extents[link.extent].joint : nothing;
      result.free_faces[result.block_of_cell[own]].push_back(
        {rock.stage_of_excavation[excavation],
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

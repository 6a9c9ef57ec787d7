// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/free_faces.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Coordinates on a face beyond which a line misses it [-]. */
    constexpr double rim = 1e-9;

    /** Where the line through @p from along @p direction cuts the segment. */
    std::optional<double>
    cut(const Point<2> &from,
        const Tensor<1, 2> &direction,
        const std::array<Point<2>, 2> &x)
    {
      const Tensor<1, 2> edge = x[1] - x[0], start = x[0] - from;
      const auto cross = [](const Tensor<1, 2> &a, const Tensor<1, 2> &b) {
        return a[0] * b[1] - a[1] * b[0];
      };
      const double determinant = cross(direction, edge);
      if (std::abs(determinant) < rim * edge.norm())
        return {};
      const double s = cross(start, direction) / determinant;
      if (s < -rim || s > 1. + rim)
        return {};
      return cross(start, edge) / determinant;
    }

    /** The same of a triangle (Moeller and Trumbore 1997). */
    std::optional<double>
    cut(const Point<3> &from,
        const Tensor<1, 3> &direction,
        const Point<3> &a,
        const Point<3> &b,
        const Point<3> &c)
    {
      const Tensor<1, 3> u = b - a, v = c - a, start = from - a;
      const Tensor<1, 3> p     = cross_product_3d(direction, v);
      const double determinant = u * p;
      if (std::abs(determinant) < rim * u.norm() * v.norm())
        return {};
      const Tensor<1, 3> q = cross_product_3d(start, u);
      const double s       = (start * p) / determinant;
      const double t       = (direction * q) / determinant;
      if (s < -rim || t < -rim || s + t > 1. + rim)
        return {};
      return (v * q) / determinant;
    }

    std::optional<double>
    cut(const Point<3> &from,
        const Tensor<1, 3> &direction,
        const std::array<Point<3>, 4> &x)
    {
      const auto one = cut(from, direction, x[0], x[1], x[3]);
      return one ? one : cut(from, direction, x[0], x[3], x[2]);
    }

    template <int dim>
    std::array<Point<dim>, Mesh<dim>::n_face_vertices>
    corners(const Mesh<dim> &mesh, const CellFace &face)
    {
      std::array<Point<dim>, Mesh<dim>::n_face_vertices> x;
      const auto vertices = mesh.face_vertices(face.cell, face.face);
      for (unsigned int v = 0; v < vertices.size(); ++v)
        x[v] = mesh.vertices[vertices[v]];
      return x;
    }

    using ByBlock = std::vector<std::vector<unsigned int>>;

    void
    append(ByBlock &lists, const unsigned int block, const unsigned int item)
    {
      if (block == none)
        return;
      if (block >= lists.size())
        lists.resize(block + 1);
      lists[block].push_back(item);
    }

    const std::vector<unsigned int> &
    list_of(const ByBlock &lists, const unsigned int block)
    {
      static const std::vector<unsigned int> empty;
      return block < lists.size() ? lists[block] : empty;
    }
  } // namespace



  template <int dim>
  FreeFaces<dim>::FreeFaces(const Ground<dim> &ground)
    : faces(list_free_faces(ground))
    , split(ground.split)
  {
    std::vector<Entry> boxes;
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        const auto x = corners(split.mesh, faces[i]);
        dealii::BoundingBox<dim> box({x[0], x[0]});
        for (const Point<dim> &corner : x)
          box.merge_with(dealii::BoundingBox<dim>({corner, corner}));
        boxes.emplace_back(box, i);
        append(by_block, split.block_of_cell[faces[i].cell], i);
      }
    tree = dealii::pack_rtree(boxes);
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      append(cells_by_block, split.block_of_cell[c], c);
    const auto &joint_faces = split.interface.joint_faces;
    for (unsigned int i = 0; i < joint_faces.size(); ++i)
      for (const unsigned int cell :
           {joint_faces[i].minus_cell, joint_faces[i].plus_cell})
        append(joint_faces_by_block, split.block_of_cell[cell], i);
  }



  template <int dim>
  const std::vector<unsigned int> &
  FreeFaces<dim>::of_block(const unsigned int block) const
  {
    return list_of(by_block, block);
  }



  template <int dim>
  const std::vector<unsigned int> &
  FreeFaces<dim>::cells_of_block(const unsigned int block) const
  {
    return list_of(cells_by_block, block);
  }



  template <int dim>
  const std::vector<unsigned int> &
  FreeFaces<dim>::joint_faces_of_block(const unsigned int block) const
  {
    return list_of(joint_faces_by_block, block);
  }



  template <int dim>
  template <typename IsWanted>
  std::optional<typename FreeFaces<dim>::Meeting>
  FreeFaces<dim>::first_hit(const Point<dim> &from,
                            const Tensor<1, dim> &direction,
                            const double behind,
                            const double reach,
                            const IsWanted &is_wanted) const
  {
    std::optional<Meeting> first;
    std::vector<Entry> near;
    const dealii::BoundingBox<dim> box(std::array<Point<dim>, 2>{
      {from - behind * direction, from + reach * direction}});
    tree.query(boost::geometry::index::intersects(box),
               std::back_inserter(near));
    for (const Entry &entry : near)
      {
        const CellFace &face = faces[entry.second];
        if (!is_wanted(face) ||
            split.mesh.face_area_vector(face.cell, face.face) * direction >= 0.)
          continue;
        const auto way = cut(from, direction, corners(split.mesh, face));
        if (way && *way >= -behind && *way <= reach &&
            (!first || *way < first->distance))
          first = Meeting{*way, face};
      }
    return first;
  }



  template <int dim>
  std::optional<typename FreeFaces<dim>::Meeting>
  FreeFaces<dim>::first_ahead(const Point<dim> &from,
                              const Tensor<1, dim> &direction,
                              const double behind,
                              const double reach,
                              const unsigned int own) const
  {
    return first_hit(from, direction, behind, reach, [&](const CellFace &face) {
      return split.block_of_cell[face.cell] != own;
    });
  }



  template <int dim>
  std::vector<Point<dim>>
  FreeFaces<dim>::probes_of(const CellFace &face) const
  {
    constexpr double drawn_in    = 0.01;
    const Point<dim> center      = split.mesh.face_center(face.cell, face.face);
    std::vector<Point<dim>> list = {center};
    for (const Point<dim> &corner : corners(split.mesh, face))
      list.push_back(corner + drawn_in * (center - corner));
    return list;
  }



  template <int dim>
  std::optional<typename FreeFaces<dim>::Meeting>
  FreeFaces<dim>::first_met(const unsigned int block,
                            const Tensor<1, dim> &direction,
                            const double reach) const
  {
    std::optional<Meeting> first;
    const auto keep_nearer = [&](const std::optional<Meeting> &meeting) {
      if (meeting && (!first || meeting->distance < first->distance))
        first = meeting;
    };
    const auto left = [&]() { return first ? first->distance : reach; };
    // the way of the block's faces
    std::vector<Point<dim>> swept;
    for (const unsigned int i : of_block(block))
      {
        const Tensor<1, dim> area =
          split.mesh.face_area_vector(faces[i].cell, faces[i].face);
        if (area * direction <= 1e-6 * area.norm())
          continue;
        for (const Point<dim> &probe : probes_of(faces[i]))
          {
            keep_nearer(first_ahead(probe, direction, 0., left(), block));
            swept.push_back(probe);
          }
      }
    if (swept.empty())
      return first;
    for (unsigned int i = swept.size(); i-- > 0;)
      swept.push_back(swept[i] + left() * direction);
    // corners ahead, on the way back
    std::vector<Entry> ahead;
    tree.query(boost::geometry::index::intersects(
                 dealii::BoundingBox<dim>(swept)),
               std::back_inserter(ahead));
    for (const Entry &entry : ahead)
      {
        const CellFace &face = faces[entry.second];
        const Tensor<1, dim> area =
          split.mesh.face_area_vector(face.cell, face.face);
        // what it slides along is not ahead
        if (split.block_of_cell[face.cell] == block ||
            area * direction >= -1e-6 * area.norm())
          continue;
        for (const Point<dim> &probe : probes_of(face))
          if (const auto back =
                first_hit(probe, -direction, 0., left(), [&](const auto &own) {
                  return split.block_of_cell[own.cell] == block;
                }))
            keep_nearer(Meeting{back->distance, face});
      }
    return first;
  }

  template class FreeFaces<2>;
  template class FreeFaces<3>;
} // namespace Keyblock

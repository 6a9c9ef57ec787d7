// SPDX-License-Identifier: LGPL-2.1-or-later
// What monitors watch: the node, block or region that the scene names.
#include <keyblock/base/box.h>
#include <keyblock/base/expression.h>
#include <keyblock/output/monitors.h>

#include <iomanip>
#include <limits>
#include <sstream>

namespace Keyblock
{
  template <int dim>
  void
  Monitors<dim>::find_target(const Monitor<dim> &monitor)
  {
    unsigned int node = none, block = none;
    std::vector<unsigned int> nodes;
    if (monitor.kind == MonitorKind::point)
      {
        unsigned int nearest = none;
        double least         = std::numeric_limits<double>::max();
        for (unsigned int v = 0; v < split.mesh.vertices.size(); ++v)
          {
            const double d = split.mesh.vertices[v].distance(monitor.location);
            if (d < least)
              {
                least   = d;
                nearest = v;
              }
          }
        look_for_location(monitor, least);
        if (numbering.is_owned(nearest))
          node = numbering.local_node(nearest);
      }
    if (monitor.kind == MonitorKind::block)
      block = find_block(monitor);
    if (monitor.kind == MonitorKind::region)
      {
        const Expression<dim> region(monitor.region,
                                     1,
                                     "Monitors/" + monitor.name + "/Region");
        for (unsigned int i = 0; i < numbering.n_owned(); ++i)
          if (region.value(split.mesh.vertices[numbering.vertex_of_node[i]],
                           0.,
                           0) > 0.)
            nodes.push_back(i);
        const unsigned int n_nodes =
          numbering.communicator.sum(static_cast<unsigned int>(nodes.size()));
        AssertThrow(n_nodes > 0,
                    InputError("The formula of the entry 'Monitors/" +
                               monitor.name +
                               "/Region' is positive at no node; correct it, "
                               "or leave the monitor out."));
      }
    node_of_monitor.push_back(node);
    block_of_monitor.push_back(block);
    nodes_of_monitor.push_back(nodes);
  }



  template <int dim>
  unsigned int
  Monitors<dim>::find_block(const Monitor<dim> &monitor)
  {
    if (monitor.block > 0)
      {
        const unsigned int n_blocks = blocks.blocks.size();
        AssertThrow(monitor.block <= n_blocks,
                    InputError("The monitor '" + monitor.name +
                               "' is of block " +
                               std::to_string(monitor.block) +
                               ", but there are " + std::to_string(n_blocks) +
                               " in the block table; correct 'Monitors/" +
                               monitor.name + "/Block'."));
        return monitor.block - 1;
      }
    // where it lies in a cell, that one's block, however far its centre is
    const unsigned int cell = find_cell_at(monitor.location);
    if (cell != none && split.block_of_cell[cell] != none)
      return split.block_of_cell[cell];
    unsigned int nearest = none;
    double least         = std::numeric_limits<double>::max();
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      {
        const double d = split.mesh.cell_center(c).distance(monitor.location);
        if (d < least && split.block_of_cell[c] != none)
          {
            least   = d;
            nearest = c;
          }
      }
    look_for_location(monitor, least);
    AssertThrow(nearest != none,
                InputError("The monitor '" + monitor.name +
                           "' is of kind block, but there is no block: all "
                           "rock is excavated later; correct 'Monitors/" +
                           monitor.name + "/Kind'."));
    return split.block_of_cell[nearest];
  }



  template <int dim>
  unsigned int
  Monitors<dim>::find_cell_at(const Point<dim> &location) const
  {
    constexpr double tolerance = 1e-6; // of a cell's size
    const Mesh<dim> &mesh      = split.mesh;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const Point<dim> center = mesh.cell_center(c);
        double reach            = 0.;
        for (const unsigned int v : mesh.cells[c])
          reach = std::max(reach, center.distance(mesh.vertices[v]));
        if (center.distance(location) > (1. + tolerance) * reach)
          continue;
        bool is_inside = true;
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const Tensor<1, dim> area = mesh.face_area_vector(c, f);
            is_inside =
              is_inside && area * (location - mesh.face_center(c, f)) <=
                             tolerance * reach * area.norm();
          }
        if (is_inside)
          return c;
      }
    return none;
  }



  template <int dim>
  void
  Monitors<dim>::look_for_location(const Monitor<dim> &monitor,
                                   const double distance)
  {
    if (find_cell_at(monitor.location) != none)
      return;
    std::ostringstream text;
    text << "The monitor '" << monitor.name << "' is at (" << monitor.location
         << ") m, which is in no rock";
    const std::string remedy =
      "correct 'Monitors/" + monitor.name + "/Location'";
    AssertThrow(distance <= diagonal_of_box(split.mesh.vertices),
                InputError(text.str() + " by far; " + remedy + "."));
    text << "; it follows the nearest "
         << (monitor.kind == MonitorKind::block ? "block, with a cell "
                                                : "node, ")
         << std::setprecision(3) << distance << " m away: " << remedy
         << ", if that is not meant.";
    warnings.push_back(text.str());
  }

  template void Monitors<2>::find_target(const Monitor<2> &);
  template unsigned int Monitors<2>::find_block(const Monitor<2> &);
  template unsigned int Monitors<2>::find_cell_at(const Point<2> &) const;
  template void Monitors<2>::look_for_location(const Monitor<2> &,
                                               const double);
  template void Monitors<3>::find_target(const Monitor<3> &);
  template unsigned int Monitors<3>::find_block(const Monitor<3> &);
  template unsigned int Monitors<3>::find_cell_at(const Point<3> &) const;
  template void Monitors<3>::look_for_location(const Monitor<3> &,
                                               const double);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_mesh_json_h
#define keyblock_output_mesh_json_h

#include <keyblock/blocks/blocks.h>

#include <nlohmann/json.hpp>

// The mesh as it stands in summary.json.
namespace Keyblock
{
  using Json = nlohmann::ordered_json;

  /** Coordinates of a point. */
  template <int dim>
  Json
  list_of(const Point<dim> &point)
  {
    Json list = Json::array();
    for (unsigned int d = 0; d < dim; ++d)
      list.push_back(point[d]);
    return list;
  }

  /** What meshing did to the joints. */
  template <int dim>
  Json mesh_report_as_json(const MeshReport<dim> &report,
                           const Scene<dim> &scene);

  /** How its blocks differ from those between the planes. */
  template <int dim>
  Json comparison_as_json(const Blocks<dim> &blocks, const Scene<dim> &scene);
} // namespace Keyblock

#endif

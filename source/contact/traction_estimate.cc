// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/traction_estimate.h>
#include <keyblock/rock/shape.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Mean of a face's shape function of @p corner times the extrapolation
     * from Gauss point @p q of the cell. */
    template <int dim>
    double
    weight_of(const unsigned int cell_face,
              const unsigned int corner,
              const unsigned int q)
    {
      constexpr unsigned int n = Mesh<dim>::n_face_vertices;
      double weight            = 0.;
      for (unsigned int g = 0; g < n; ++g)
        {
          // Gauss point g of the face, in the cell's coordinates
          std::array<double, dim> xi;
          double value     = 1.;
          unsigned int bit = 0;
          for (unsigned int d = 0; d < dim; ++d)
            if (d == cell_face / 2)
              xi[d] = cell_face % 2;
            else
              {
                xi[d] = ((g >> bit) & 1) ? Shape<dim>::gauss_hi
                                         : Shape<dim>::gauss_lo;
                const unsigned int v =
                  GeometryInfo<dim>::face_to_cell_vertices(cell_face, corner);
                value *= ((v >> d) & 1) ? xi[d] : 1. - xi[d];
                ++bit;
              }
          double extrapolation = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double low  = Shape<dim>::gauss_lo;
              const double high = Shape<dim>::gauss_hi;
              extrapolation *= ((q >> d) & 1) ? (xi[d] - low) / (high - low)
                                              : (high - xi[d]) / (high - low);
            }
          weight += value * extrapolation / n;
        }
      return weight;
    }
  } // namespace



  template <int dim>
  TractionEstimate<dim>::TractionEstimate(
    const PairTopology<dim> &topology,
    const CellArrays<dim> &cells,
    const std::vector<unsigned int> &pairs)
    : topology(topology)
    , interface(topology.interface)
    , cells(cells)
    , pairs(pairs)
    , traction(interface.pairs.size())
  {
    for (unsigned int face = 0; face < weights.size(); ++face)
      for (unsigned int corner = 0; corner < weights[face].size(); ++corner)
        for (unsigned int q = 0; q < weights[face][corner].size(); ++q)
          weights[face][corner][q] = weight_of<dim>(face, corner, q);
  }



  template <int dim>
  void
  TractionEstimate<dim>::add_side(const JointFace &face,
                                  Side side,
                                  const unsigned int cell,
                                  const PairAt &pair_at)
  {
    const Mesh<dim> &mesh = topology.split.mesh;
    const auto minus = mesh.face_vertices(face.minus_cell, face.minus_face);
    const auto plus  = mesh.face_vertices(face.plus_cell, face.plus_face);
    const auto own   = mesh.face_vertices(cell, side.face);
    side.pair.fill(none);
    bool has_pair = false;
    for (const unsigned int vm : minus)
      for (const unsigned int vp : plus)
        {
          const auto pair = pair_at.find({{vm, vp, face.joint}});
          if (pair == pair_at.end() ||
              mesh.vertices[vm].distance(mesh.vertices[vp]) > 0.)
            continue;
          const unsigned int corner =
            std::find_if(own.begin(),
                         own.end(),
                         [&](const unsigned int v) {
                           return mesh.vertices[v] == mesh.vertices[vm];
                         }) -
            own.begin();
          side.pair[corner] = pair->second;
          has_pair          = true;
        }
    if (has_pair)
      sides.push_back(side);
  }



  template <int dim>
  void
  TractionEstimate<dim>::set_up()
  {
    sides.clear();
    PairAt pair_at;
    for (unsigned int i = 0; i < pairs.size(); ++i)
      {
        const Pair<dim> &pair = interface.pairs[pairs[i]];
        pair_at[{{pair.minus, pair.plus, pair.joint}}] = i;
      }
    if (pair_at.empty())
      return;
    const Mesh<dim> &mesh = topology.split.mesh;
    std::vector<unsigned int> local_cell(mesh.n_cells(), none);
    for (unsigned int c = 0; c < cells.mesh_cell.size(); ++c)
      local_cell[cells.mesh_cell[c]] = c;
    const auto is_rigid = [&](const unsigned int cell) {
      return topology.scene.materials[mesh.material[cell]]->is_rigid();
    };
    for (const JointFace &face : interface.joint_faces)
      {
        const bool minus_rigid = is_rigid(face.minus_cell);
        const bool plus_rigid  = is_rigid(face.plus_cell);
        const double share     = (minus_rigid || plus_rigid) ? 1. : 0.5;
        // the force on the plus side is minus the integral of N stress . n
        const Tensor<1, dim> area =
          -share * mesh.face_area_vector(face.minus_cell, face.minus_face);
        const auto add = [&](const unsigned int cell,
                             const unsigned int cell_face) {
          if (local_cell[cell] == none)
            return;
          Side side{local_cell[cell], cell_face, {}, {}};
          for (int d = 0; d < dim; ++d)
            side.area[d] = area[d];
          add_side(face, side, cell, pair_at);
        };
        if (!minus_rigid)
          add(face.minus_cell, face.minus_face);
        if (!plus_rigid)
          add(face.plus_cell, face.plus_face);
      }
    // stresses of a cell are read together
    std::stable_sort(sides.begin(),
                     sides.end(),
                     [](const Side &a, const Side &b) {
                       return a.cell < b.cell;
                     });
  }


  template <int dim>
  void
  TractionEstimate<dim>::update()
  {
    std::vector<double> sums(dim * pairs.size(), 0.);
    for (const Side &side : sides)
      {
        // of the side's stress, over the shape function of each corner
        std::array<Stress, Mesh<dim>::n_face_vertices> mean{};
        for (unsigned int q = 0; q < Mesh<dim>::n_cell_vertices; ++q)
          {
            const Stress stress = cells.stress_at(side.cell, q);
            for (unsigned int v = 0; v < mean.size(); ++v)
              for (unsigned int i = 0; i < stress.size(); ++i)
                mean[v][i] += weights[side.face][v][q] * stress[i];
          }
        for (unsigned int v = 0; v < mean.size(); ++v)
          if (side.pair[v] != none)
            {
              const Vector<dim> f =
                apply_stress<dim, double>(mean[v].data(), side.area);
              for (int d = 0; d < dim; ++d)
                sums[dim * side.pair[v] + d] += f[d];
            }
      }
    if (topology.numbering.communicator.size() > 1)
      topology.numbering.communicator.sum_lists(sums);
    for (unsigned int i = 0; i < pairs.size(); ++i)
      for (int d = 0; d < dim; ++d)
        traction[pairs[i]][d] = sums[dim * i + d];
  }

  template class TractionEstimate<2>;
  template class TractionEstimate<3>;
} // namespace Keyblock

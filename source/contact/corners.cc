// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact where several pairs share nodes that have not slid: clusters, and the
// recovery of their forces.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>
#include <keyblock/contact/damping.h>
#include <keyblock/law/friction.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** A generalised inverse of a symmetric positive semidefinite matrix by the
     * sweep operator; dependent rows are left out. */
    void
    sweep_invert(std::vector<double> &a, const unsigned int n)
    {
      std::vector<bool> is_swept(n, false);
      std::vector<double> diagonal(n);
      for (unsigned int i = 0; i < n; ++i)
        diagonal[i] = a[n * i + i];
      for (unsigned int k = 0; k < n; ++k)
        {
          const double pivot = a[n * k + k];
          if (pivot <= 1e-10 * diagonal[k])
            continue;
          is_swept[k] = true;
          for (unsigned int j = 0; j < n; ++j)
            if (j != k)
              a[n * k + j] /= pivot;
          for (unsigned int i = 0; i < n; ++i)
            if (i != k)
              {
                const double factor = a[n * i + k];
                for (unsigned int j = 0; j < n; ++j)
                  if (j != k)
                    a[n * i + j] -= factor * a[n * k + j];
                a[n * i + k] = -factor / pivot;
              }
          a[n * k + k] = 1. / pivot;
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (!is_swept[i] || !is_swept[j])
            a[n * i + j] = 0.;
    }
  } // namespace



  template <int dim>
  void
  Contact<dim>::set_up_corner(CornerGroup &corner)
  {
    const unsigned int g = corner.group;
    const unsigned int n = corner.slots.size();
    const auto index_of  = [&](const unsigned int vertex) {
      return std::find(corner.slots.begin(),
                       corner.slots.end(),
                       search.slot_of_vertex[vertex]) -
             corner.slots.begin();
    };
    corner.is_oblique = false;
    for (int d = 0; d < dim; ++d)
      {
        unsigned int n_free = 0;
        corner.free_index[d].assign(n, -1);
        for (unsigned int i = 0; i < n; ++i)
          {
            const double *p = slot_projection[corner.slots[i]];
            if (p != nullptr)
              for (int e = 0; e < dim; ++e)
                corner.is_oblique =
                  corner.is_oblique ||
                  (e != d && std::abs(p[dim * d + e]) > 1e-12);
            if (slot_inverse_mass[corner.slots[i]] > 0. &&
                (p == nullptr || p[dim * d + d] > 0.5))
              corner.free_index[d][i] = n_free++;
          }
        corner.inverse[d].assign(n_free * n_free, 0.);
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          {
            if (state[p].is_removed)
              continue;
            const double area = interface.pairs[p].area;
            const int plus =
              corner.free_index[d][index_of(interface.pairs[p].plus)];
            const int minus =
              corner.free_index[d][index_of(interface.pairs[p].minus)];
            if (plus >= 0)
              corner.inverse[d][n_free * plus + plus] += area;
            if (minus >= 0)
              corner.inverse[d][n_free * minus + minus] += area;
            if (plus >= 0 && minus >= 0)
              {
                corner.inverse[d][n_free * plus + minus] -= area;
                corner.inverse[d][n_free * minus + plus] -= area;
              }
          }
        sweep_invert(corner.inverse[d], n_free);
      }
  }



  template <int dim>
  void
  Contact<dim>::set_up_traction_weights()
  {
    traction_weights.clear();
    std::map<std::array<unsigned int, 3>, unsigned int> pair_at;
    for (const unsigned int p : corner_pairs)
      pair_at[{{interface.pairs[p].minus,
                interface.pairs[p].plus,
                interface.pairs[p].joint}}] = p;
    if (pair_at.empty())
      return;
    const Mesh<dim> &mesh = split.mesh;
    std::vector<unsigned int> local_cell(mesh.n_cells(), none);
    for (unsigned int c = 0; c < cells.mesh_cell.size(); ++c)
      local_cell[cells.mesh_cell[c]] = c;
    constexpr unsigned int n = Mesh<dim>::n_face_vertices;
    const auto is_rigid      = [&](const unsigned int cell) {
      return scene.materials[mesh.material[cell]]->is_rigid();
    };

    // the force on the plus side is minus the integral of N stress . n, with
    // the stress of each side extrapolated from its Gauss points
    const auto add_side = [&](const JointFace &face,
                              const unsigned int cell,
                              const unsigned int cell_face,
                              const double share) {
      if (local_cell[cell] == none)
        return;
      const auto minus = mesh.face_vertices(face.minus_cell, face.minus_face);
      const auto plus  = mesh.face_vertices(face.plus_cell, face.plus_face);
      const auto own   = mesh.face_vertices(cell, cell_face);
      Tensor<1, dim> n_area =
        mesh.face_area_vector(face.minus_cell, face.minus_face);
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
            for (unsigned int q = 0; q < Mesh<dim>::n_cell_vertices; ++q)
              {
                double weight = 0.;
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
                            GeometryInfo<dim>::face_to_cell_vertices(cell_face,
                                                                     corner);
                          value *= ((v >> d) & 1) ? xi[d] : 1. - xi[d];
                          ++bit;
                        }
                    double extrapolation = 1.;
                    for (unsigned int d = 0; d < dim; ++d)
                      {
                        const double low  = Shape<dim>::gauss_lo;
                        const double high = Shape<dim>::gauss_hi;
                        extrapolation *= ((q >> d) & 1)
                                           ? (xi[d] - low) / (high - low)
                                           : (high - xi[d]) / (high - low);
                      }
                    weight += value * extrapolation / n;
                  }
                TractionWeight entry{pair->second, local_cell[cell], q, {}};
                for (int d = 0; d < dim; ++d)
                  entry.weight[d] = -share * weight * n_area[d];
                traction_weights.push_back(entry);
              }
          }
    };
    for (const JointFace &face : interface.joint_faces)
      {
        const bool minus_rigid = is_rigid(face.minus_cell);
        const bool plus_rigid  = is_rigid(face.plus_cell);
        const double share     = (minus_rigid || plus_rigid) ? 1. : 0.5;
        if (!minus_rigid)
          add_side(face, face.minus_cell, face.minus_face, share);
        if (!plus_rigid)
          add_side(face, face.plus_cell, face.plus_face, share);
      }
  }



  template <int dim>
  void
  Contact<dim>::estimate_tractions()
  {
    std::vector<double> sums(dim * interface.pairs.size(), 0.);
    for (const TractionWeight &entry : traction_weights)
      {
        const Vector<dim> f = apply_stress<dim, double>(
          cells.stress_at(entry.cell, entry.point).data(), entry.weight);
        for (int d = 0; d < dim; ++d)
          sums[dim * entry.pair + d] += f[d];
      }
    std::vector<double> buffer;
    for (const unsigned int p : corner_pairs)
      for (int d = 0; d < dim; ++d)
        buffer.push_back(sums[dim * p + d]);
    if (n_ranks() > 1)
      sum_lists(buffer);
    for (unsigned int i = 0; i < corner_pairs.size(); ++i)
      for (int d = 0; d < dim; ++d)
        traction[corner_pairs[i]][d] = buffer[dim * i + d];
  }



  template <int dim>
  void
  Contact<dim>::recover_impulses(const CornerGroup &corner,
                                 const double *needed)
  {
    const unsigned int g     = corner.group;
    const unsigned int begin = interface.group_pairs_begin[g];
    const unsigned int end   = interface.group_pairs_begin[g + 1];
    const unsigned int n     = corner.slots.size();
    const auto index         = [&](const unsigned int vertex) {
      return std::find(corner.slots.begin(),
                       corner.slots.end(),
                       search.slot_of_vertex[vertex]) -
             corner.slots.begin();
    };
    for (int d = 0; d < dim; ++d)
      {
        const unsigned int n_free = n - std::count(corner.free_index[d].begin(),
                                                   corner.free_index[d].end(),
                                                   -1);
        std::vector<double> rest(n_free, 0.), lambda(n_free, 0.);
        for (unsigned int i = 0; i < n; ++i)
          if (corner.free_index[d][i] >= 0)
            rest[corner.free_index[d][i]] = needed[dim * i + d];
        for (unsigned int p = begin; p < end; ++p)
          {
            if (state[p].is_removed)
              continue;
            const int plus =
              corner.free_index[d][index(interface.pairs[p].plus)];
            const int minus =
              corner.free_index[d][index(interface.pairs[p].minus)];
            if (plus >= 0)
              rest[plus] -= state[p].impulse[d];
            if (minus >= 0)
              rest[minus] += state[p].impulse[d];
          }
        for (unsigned int i = 0; i < n_free; ++i)
          for (unsigned int j = 0; j < n_free; ++j)
            lambda[i] += corner.inverse[d][n_free * i + j] * rest[j];
        for (unsigned int p = begin; p < end; ++p)
          {
            if (state[p].is_removed)
              continue;
            const int plus =
              corner.free_index[d][index(interface.pairs[p].plus)];
            const int minus =
              corner.free_index[d][index(interface.pairs[p].minus)];
            state[p].impulse[d] +=
              interface.pairs[p].area * ((plus >= 0 ? lambda[plus] : 0.) -
                                         (minus >= 0 ? lambda[minus] : 0.));
          }
      }
  }



  template <int dim>
  bool
  Contact<dim>::try_cluster(CornerGroup &corner, const ContactStep &step)
  {
    const unsigned int g     = corner.group;
    const unsigned int begin = interface.group_pairs_begin[g];
    const unsigned int end   = interface.group_pairs_begin[g + 1];
    if (corner.is_oblique || is_published_variant())
      return false;
    for (unsigned int p = begin; p < end; ++p)
      if (!state[p].is_removed &&
          (state[p].status != ContactStatus::sticking || state[p].is_converted))
        return false;

    Vector<dim> common{};
    bool is_free = true;
    for (int d = 0; d < dim; ++d)
      {
        double mass = 0., momentum = 0., held = 0.;
        bool is_held = false;
        for (unsigned int i = 0; i < corner.slots.size(); ++i)
          {
            const unsigned int slot = corner.slots[i];
            const double v          = slot_velocity[dim * slot + d];
            if (corner.free_index[d][i] < 0)
              {
                is_held = true;
                held    = v;
              }
            else
              {
                const double m = 1. / slot_inverse_mass[slot];
                mass += m;
                momentum += m * v;
              }
          }
        is_free   = is_free && !is_held;
        common[d] = is_held ? held : momentum / mass;
      }

    std::vector<double> needed(dim * corner.slots.size(), 0.);
    for (unsigned int i = 0; i < corner.slots.size(); ++i)
      for (int d = 0; d < dim; ++d)
        if (corner.free_index[d][i] >= 0)
          needed[dim * i + d] =
            (common[d] - slot_velocity[dim * corner.slots[i] + d]) /
            slot_inverse_mass[corner.slots[i]];
    for (unsigned int p = begin; p < end; ++p)
      if (!state[p].is_removed)
        state[p].impulse = add<dim>(Vector<dim>{}, step.kick, traction[p]);
    recover_impulses(corner, needed.data());
    for (unsigned int p = begin; p < end; ++p)
      if (!state[p].is_removed &&
          violation<dim>(state[p].impulse,
                         normal[p],
                         pair_strength(p, state[p].is_intact, step.kick)) > 0.)
        return false;

    // mobile nodes are damped with all others, before contact, and so is a
    // cluster that was none in the step before
    const bool is_damped_here = is_free && !is_mobile_group[g];
    if (step.local_damping > 0. && is_damped_here &&
        fields.is_in_cluster[node_of_slot[corner.slots[0]]])
      {
        Vector<dim> old;
        for (int d = 0; d < dim; ++d)
          old[d] = slot_old_velocity[dim * corner.slots[0] + d];
        const Vector<dim> change =
          damp_cluster<dim>(common, old, step.local_damping);
        common = add<dim>(common, 1., change);
        for (const unsigned int slot : corner.slots)
          if (node_of_slot[slot] != none)
            for (int d = 0; d < dim; ++d)
              fields.local_damping[dim * node_of_slot[slot] + d] =
                change[d] / slot_inverse_mass[slot];
      }
    for (const unsigned int slot : corner.slots)
      {
        for (int d = 0; d < dim; ++d)
          slot_velocity[dim * slot + d] = common[d];
        if (node_of_slot[slot] != none)
          fields.is_in_cluster[node_of_slot[slot]] = is_damped_here;
      }
    if (step.keeps_ledger && (is_mobile_group[g] ? is_root() : is_primary(g)))
      for (unsigned int p = begin; p < end; ++p)
        {
          if (state[p].is_removed)
            continue;
          const ContactPoint<dim> point = pair_as_point(p, step.kick);
          const Vector<dim> old =
            relative_velocity<dim>(point, slot_old_velocity.data());
          if (norm<dim>(old) == 0.)
            continue;
          ContactPoint<dim> held = point;
          held.impulse           = state[p].impulse;
          book_work(held, slot_old_velocity.data(), slot_velocity.data());
        }
    return true;
  }



  template <int dim>
  void
  Contact<dim>::solve_corner(CornerGroup &corner, const ContactStep &step)
  {
    const unsigned int g     = corner.group;
    const unsigned int begin = interface.group_pairs_begin[g];
    const unsigned int end   = interface.group_pairs_begin[g + 1];
    if (!try_cluster(corner, step))
      {
        std::vector<ContactPoint<dim>> points;
        std::vector<PointStrength> broken;
        std::vector<unsigned int> pairs;
        for (unsigned int p = begin; p < end; ++p)
          {
            double w = 0.;
            for (const unsigned int v :
                 {interface.pairs[p].minus, interface.pairs[p].plus})
              w += slot_inverse_mass[search.slot_of_vertex[v]];
            if (state[p].is_removed || state[p].is_converted || w == 0.)
              continue;
            points.push_back(pair_as_point(p, step.kick));
            if (state[p].status == ContactStatus::sticking)
              points.back().impulse = state[p].impulse;
            broken.push_back(pair_strength(p, false, step.kick));
            pairs.push_back(p);
          }
        for (const unsigned int slot : corner.slots)
          if (node_of_slot[slot] != none)
            fields.is_in_cluster[node_of_slot[slot]] = false;
        solve_points(points, broken, slot_nodes, step.step);
        const bool books =
          step.keeps_ledger && (is_mobile_group[g] ? is_root() : is_primary(g));
        for (unsigned int i = 0; i < points.size(); ++i)
          {
            state[pairs[i]].impulse   = points[i].impulse;
            state[pairs[i]].status    = points[i].status;
            state[pairs[i]].is_intact = points[i].is_intact;
            if (books)
              book_work(points[i],
                        slot_old_velocity.data(),
                        slot_velocity.data());
          }
      }
    for (unsigned int p = begin; p < end; ++p)
      if (!state[p].is_converted && !state[p].is_removed)
        for (int d = 0; d < dim; ++d)
          {
            const auto plus  = search.slot_of_vertex[interface.pairs[p].plus];
            const auto minus = search.slot_of_vertex[interface.pairs[p].minus];
            slot_impulse[dim * plus + d] += state[p].impulse[d];
            slot_impulse[dim * minus + d] -= state[p].impulse[d];
          }
  }

  template void Contact<2>::set_up_corner(CornerGroup &);
  template void Contact<3>::set_up_corner(CornerGroup &);
  template void Contact<2>::set_up_traction_weights();
  template void Contact<3>::set_up_traction_weights();
  template void Contact<2>::estimate_tractions();
  template void Contact<3>::estimate_tractions();
  template void Contact<2>::solve_corner(CornerGroup &, const ContactStep &);
  template void Contact<3>::solve_corner(CornerGroup &, const ContactStep &);
} // namespace Keyblock

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/dofs/dof_handler.h>

#include <deal.II/grid/tria.h>

#include <keyblock/contact/joint_point.h>
#include <keyblock/output/output.h>
#include <keyblock/scene/network_output.h>

#include <map>

namespace Keyblock
{
  namespace
  {
    /** Quantities at contact points. */
    struct PointArrays
    {
      VtuArray u        = VtuArray::vector("displacement (m)");
      VtuArray normal   = VtuArray::vector("normal");
      VtuArray gap      = VtuArray::scalar("gap (m)");
      VtuArray slip     = VtuArray::vector("slip (m)");
      VtuArray pressure = VtuArray::scalar("pressure (Pa)");
      VtuArray shear    = VtuArray::vector("shear (Pa)");
      VtuArray state    = VtuArray::ids("state");

      template <int dim>
      void
      add(const JointPoint<dim> &point, const double *displacement)
      {
        u.add_vector(displacement, dim);
        normal.add_vector(point.normal, dim);
        gap.add(point.gap());
        slip.add_vector(point.slip(), dim);
        pressure.add(point.pressure());
        shear.add_vector(point.shear(), dim);
        state.add_id(static_cast<int>(point.state));
      }
    };



    /** The pairs of an interface and where their nodes are here. */
    template <int dim>
    class PairTable
    {
    public:
      PairTable(const Interface<dim> &interface,
                const Numbering<dim> &numbering,
                const std::vector<double> &displacement,
                const std::vector<PairState<dim>> &states,
                const double kick)
        : interface(interface)
        , numbering(numbering)
        , displacement(displacement)
        , states(states)
        , kick(kick)
      {
        for (unsigned int p = 0; p < interface.pairs.size(); ++p)
          place[{{interface.pairs[p].minus,
                  interface.pairs[p].plus,
                  interface.pairs[p].joint}}] = p;
      }

      /** The pair of @p minus with one of the vertices @p plus, or `none`. */
      template <typename Vertices>
      unsigned int
      find(const unsigned int minus,
           const Vertices &plus,
           const unsigned int joint) const
      {
        unsigned int pair = none;
        for (const unsigned int other : plus)
          {
            const auto found = place.find({{minus, other, joint}});
            if (found != place.end())
              pair = found->second;
          }
        return pair;
      }

      JointPoint<dim>
      at(const unsigned int pair) const
      {
        const Pair<dim> &p       = interface.pairs[pair];
        const unsigned int minus = numbering.local_node(p.minus),
                           plus  = numbering.local_node(p.plus);
        Vector<dim> jump;
        for (int d = 0; d < dim; ++d)
          jump[d] =
            displacement[dim * plus + d] - displacement[dim * minus + d];
        return {p, states[pair], jump, kick};
      }

    private:
      const Interface<dim> &interface;
      const Numbering<dim> &numbering;
      const std::vector<double> &displacement;
      const std::vector<PairState<dim>> &states;
      const double kick; ///< [s]
      std::map<std::array<unsigned int, 3>, unsigned int> place;
    };
  } // namespace



  template <int dim>
  VtuGrid
  Output<dim>::make_interface(const double time) const
  {
    VtuGrid grid = make_grid(time);
    grid.texts.emplace_back("state names", joint_state_names());
    const JointSetNumbers sets = number_joint_sets(scene);
    grid.texts.emplace_back("joint set names", sets.names);
    PointArrays points;
    VtuArray joint = VtuArray::ids("joint"), set = VtuArray::ids("joint set"),
             minus_block = VtuArray::ids("block on minus side"),
             plus_block  = VtuArray::ids("block on plus side"),
             is_there    = VtuArray::ids("is between rock");
    std::vector<PairState<dim>> states;
    double kick = 1.;
    if (contact)
      {
        states = contact->gather_pairs();
        kick   = contact->present_kick();
      }
    const PairTable<dim> pairs(
      split.interface, numbering, fields.displacement, states, kick);
    // the owner of the minus cell holds the nodes of both sides
    std::vector<bool> is_local(split.mesh.n_cells(), false);
    for (const auto &cell : numbering.triangulation->active_cell_iterators())
      if (cell->is_locally_owned())
        is_local[numbering.mesh_cell_of(cell)] = true;
    const auto is_dug = [&](const unsigned int cell) {
      const unsigned int in = split.mesh.excavation_stage[cell];
      return in > 0 && in <= stage;
    };
    const auto id_of = [&](const unsigned int cell) {
      const unsigned int b = split.block_of_cell[cell];
      return b == none ? 0 : blocks.blocks[b].id;
    };

    // faces share the points of pairs; others are of a vertex and a joint
    std::map<std::array<unsigned int, 3>, unsigned int> known;
    for (const JointFace &face : split.interface.joint_faces)
      {
        if (!contact || !is_local[face.minus_cell])
          continue;
        const auto minus =
          split.mesh.face_vertices(face.minus_cell, face.minus_face);
        const auto plus =
          split.mesh.face_vertices(face.plus_cell, face.plus_face);
        bool has_rock = !is_dug(face.minus_cell) && !is_dug(face.plus_cell);
        std::vector<unsigned int> corners;
        for (const unsigned int vertex : minus)
          {
            const unsigned int p = pairs.find(vertex, plus, face.joint);
            has_rock = has_rock && (p == none || !states[p].is_removed);
            const auto [found, is_new] = known.emplace(
              std::array<unsigned int, 3>{{p, vertex, face.joint}},
              grid.n_points());
            corners.push_back(found->second);
            if (!is_new)
              continue;
            JointPoint<dim> point;
            const Tensor<1, dim> normal = scene.joints[face.joint]->normal();
            for (int d = 0; d < dim; ++d)
              point.normal[d] = normal[d];
            const unsigned int node = numbering.local_node(vertex);
            grid.add_point(&fields.reference[dim * node], dim);
            points.add<dim>(p == none ? point : pairs.at(p),
                            &fields.displacement[dim * node]);
          }
        grid.add_lattice_cell(corners);
        joint.add_id(face.joint);
        set.add_id(sets.of_joint[face.joint]);
        minus_block.add_id(id_of(face.minus_cell));
        plus_block.add_id(id_of(face.plus_cell));
        is_there.add_id(has_rock);
      }
    grid.point_data = {points.u,
                       points.normal,
                       points.gap,
                       points.slip,
                       points.pressure,
                       points.shear,
                       points.state};
    grid.cell_data  = {joint, set, minus_block, plus_block, is_there};
    return grid;
  }

  template VtuGrid Output<2>::make_interface(const double) const;
  template VtuGrid Output<3>::make_interface(const double) const;
} // namespace Keyblock

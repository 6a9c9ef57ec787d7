// SPDX-License-Identifier: LGPL-2.1-or-later
// What is special about the limit equilibrium of a block, in words.
#include <keyblock/base/expression.h>
#include <keyblock/safety/block_remarks.h>
#include <keyblock/safety/friction_loss.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace Keyblock
{
  namespace
  {
    /** Way over the size of a block beyond which it has no number: what
     * balances almost passes anywhere [-]. */
    constexpr double far_outside = 10.;

    /** Adds what is to be said about one block. */
    template <int dim>
    class Remarks
    {
    public:
      Remarks(const Ground<dim> &ground,
              const FreeFaces<dim> &free,
              const Blocks<dim> &blocks,
              const unsigned int block,
              BlockStatics<dim> &statics)
        : ground(ground)
        , free(free)
        , scene(ground.scene)
        , blocks(blocks)
        , index(block)
        , block(blocks.blocks[block])
        , around(statics.around)
        , limit(statics.limit)
        , support(statics.support)
        , remarks(statics.remarks)
      {}

      void
      add_loads(const double time)
      {
        const auto &coefficient = scene.safety.seismic_coefficient;
        if (!coefficient.empty() && around.loads.seismic.norm() > 0.)
          {
            add() << "with the seismic coefficient ";
            for (unsigned int d = 0; d < coefficient.size(); ++d)
              last << (d ? ", " : "") << coefficient[d];
            last << ", which runs and trials do not see";
          }
        bool is_varying = depends_on_time(scene.initial_state.gravity);
        for (const auto &traction : scene.tractions)
          is_varying = is_varying || (!around.loads.tractions.empty() &&
                                      depends_on_time(traction->expression));
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          is_varying =
            is_varying ||
            (around.touches(j) &&
             depends_on_time(scene.water_pressure(j, ground.stage_number)));
        if (is_varying)
          add() << "loads of t = " << time << " s";
      }

      void
      add_rotation(const Rotation &rotation, const double factor_of_sliding)
      {
        using Mode = typename LimitEquilibrium<dim>::Mode;
        if (limit.mode == Mode::one_plane && !rotation.is_judged)
          add() << "rotation not judged: its base is not plane";
        if (rotation.outside == 0.)
          return;
        add() << "the resultant passes ";
        if (rotation.outside > far_outside * block.size)
          last << "far";
        else
          last << rotation.outside << " m";
        last << " outside the base";
        if (limit.mode == Mode::rotating && !rotation.is_by_moments)
          last << ", which no friction prevents; sliding alone "
               << factor_of_sliding;
        else if (dim == 2)
          last << "; " << rotation.obstacle << " keeps it from turning";
        else if (!rotation.is_by_moments)
          last << ": it may rotate (an indication only)";
      }

      void
      add_fixed_joints()
      {
        std::set<std::string> fixed;
        for (const unsigned int i : limit.faces)
          if (!around.faces[i].is_reduced)
            fixed.insert(around.faces[i].name);
        if (fixed.empty())
          return;
        add() << "strength of ";
        for (const std::string &name : fixed)
          last << (name == *fixed.begin() ? "" : " and ") << name;
        last << " not reduced";
        if (limit.is_held_by_fixed())
          last << ", which bears all that drives it";
      }

      void
      add_text(const std::string &text)
      {
        add() << text;
      }

      void
      add_faces()
      {
        std::set<std::string> names;
        for (unsigned int i = 0; i < limit.n_pressed; ++i)
          names.insert(around.faces[limit.faces[i]].name);
        using Mode = typename LimitEquilibrium<dim>::Mode;
        if (limit.mode != Mode::rotating &&
            names.size() > (limit.mode == Mode::two_planes ? 2U : 1U))
          add() << "parallel faces share the normal force by their areas";
        if (around.has_free_face)
          add() << "free faces that touch have the default friction angle";
        // facets of bent joints, by their pieces
        std::map<std::string, std::map<unsigned int, unsigned int>> n_facets;
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          {
            const auto &joint = scene.joints[j];
            if (!around.touches(j) ||
                (!joint->surface.empty() &&
                 (++n_facets[joint->surface][joint->piece] > 1 ||
                  n_facets[joint->surface].size() > 1)))
              continue;
            const std::string &name =
              joint->surface.empty() ? joint->name : joint->surface;
            if (joint->tensile_strength > 0.)
              add() << "tensile strength of " << name << " left out";
            if (joint->cohesion_of_sliding() < joint->cohesion)
              add() << "peak cohesion of " << name << ", residual "
                    << joint->cohesion_of_sliding() << " Pa";
            if (const FrictionLoss loss(*make_joint_law(*joint));
                loss.is_felt())
              add() << loss.describe(name);
          }
        names.clear();
        for (unsigned int i = 0; i < around.faces.size(); ++i)
          if (const BlockFace<dim> &face = around.faces[i];
              face.cohesion > 0. && face.inward * limit.direction > 1e-6 &&
              std::count(limit.faces.begin(), limit.faces.end(), i) == 0)
            names.insert(face.name);
        if (!names.empty())
          add() << "cohesion of " << boost::algorithm::join(names, "/")
                << (names.size() == 1 ? ", which opens" : ", which open")
                << ", left out";
        for (const auto &[name, pieces] : n_facets)
          for (const auto &[piece, n] : pieces)
            if (n > dim)
              add() << "turning along the " << n << " plane parts of " << name
                    << " that it lies on not judged";
      }

      void
      add_neighbors()
      {
        std::set<unsigned int> moving;
        std::set<std::string> moved;
        const std::set<unsigned int> pressed = limit.pressed_faces(
          around.faces, around.loads.without_water() + support.shotcrete_load);
        for (unsigned int i = 0; i < around.faces.size(); ++i)
          for (const unsigned int other : around.others[i])
            {
              const Block<dim> &b = blocks.blocks[other];
              if (!b.is_infinite && !b.is_rigid && pressed.count(i) > 0)
                moving.insert(b.id);
              if (b.is_rigid)
                add_motion_of(other, moved);
            }
        if (!moving.empty())
          {
            add() << (moving.size() == 1 ? "rests on block"
                                         : "rests on blocks");
            for (const unsigned int id : moving)
              last << (id == *moving.begin() ? " " : ", ") << id;
            last << ", taken as fixed";
          }
        for (const std::string &name : moved)
          add() << "motion of " << name << " left out";
        if (around.is_attached)
          add() << "joined to rock that is not excavated yet, left out";
        if (around.is_on_fill)
          add() << "joined to fill, left out";
        for (const auto &support : scene.supports)
          if (is_held_by(*support))
            add() << "held by the support " << support->name << ", left out";
      }

      /** Free faces ahead on its way. */
      void
      add_obstacle()
      {
        if (limit.direction.norm() == 0. ||
            limit.mode == LimitEquilibrium<dim>::Mode::rotating)
          return;
        const auto first = free.first_met(index, limit.direction, block.size);
        if (!first)
          return;
        const unsigned int other = ground.split.block_of_cell[first->face.cell];
        add() << "meets ";
        if (other == none)
          last << "rock that is not excavated yet";
        else if (blocks.blocks[other].is_infinite)
          last << "the rock";
        else
          last << "block " << blocks.blocks[other].id;
        last << " after " << first->distance << " m";
      }

      void
      finish()
      {
        add();
        remarks.pop_back();
      }

    private:
      /** Begin a remark. */
      std::ostringstream &
      add()
      {
        if (!remarks.empty())
          remarks.back() = last.str();
        remarks.emplace_back();
        last.str("");
        last.precision(4);
        return last;
      }

      /** Whether the support holds a vertex of the block. */
      bool
      is_held_by(const Support<dim> &support) const
      {
        const Mesh<dim> &mesh = ground.split.mesh;
        std::unique_ptr<Expression<dim>> inside;
        if (!support.region.empty())
          inside = std::make_unique<Expression<dim>>(support.region,
                                                     1,
                                                     "Supports/*/Region");
        for (const unsigned int c : free.cells_of_block(index))
          {
            if (inside)
              for (const unsigned int v : mesh.cells[c])
                if (inside->value(mesh.vertices[v], 0., 0) > 0.)
                  return true;
            for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
              for (const std::string &name : support.boundaries)
                if (mesh.is_on(c, f, name))
                  return true;
          }
        return false;
      }

      /** Names of the rigid bodies of a block that move. */
      void
      add_motion_of(const unsigned int other,
                    std::set<std::string> &names) const
      {
        for (const unsigned int c : free.cells_of_block(other))
          if (const auto &material =
                *scene.materials[ground.split.mesh.material[c]];
              !material.rigid_velocity.empty())
            names.insert(material.name);
      }

      const Ground<dim> &ground;
      const FreeFaces<dim> &free;
      const Scene<dim> &scene;
      const Blocks<dim> &blocks;
      const unsigned int index;
      const Block<dim> &block;
      const BlockSurroundings<dim> &around;
      const LimitEquilibrium<dim> &limit;
      const BlockSupport<dim> &support;
      std::vector<std::string> &remarks;
      std::ostringstream last;
    };
  } // namespace



  template <int dim>
  void
  add_remarks(const Ground<dim> &ground,
              const FreeFaces<dim> &free,
              const Blocks<dim> &blocks,
              const unsigned int block,
              const double time,
              const SupportedMotion<dim> &motion,
              BlockStatics<dim> &statics)
  {
    Remarks<dim> remarks(ground, free, blocks, block, statics);
    remarks.add_loads(time);
    for (const std::string &text :
         list_support_remarks(ground, blocks, statics))
      remarks.add_text(text);
    remarks.add_fixed_joints();
    remarks.add_rotation(motion.rotation, motion.factor_of_sliding);
    remarks.add_faces();
    remarks.add_neighbors();
    remarks.add_obstacle();
    remarks.finish();
  }

#define INSTANTIATE(dim)                                                       \
  template void add_remarks(const Ground<dim> &,                               \
                            const FreeFaces<dim> &,                            \
                            const Blocks<dim> &,                               \
                            const unsigned int,                                \
                            const double,                                      \
                            const SupportedMotion<dim> &,                      \
                            BlockStatics<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock

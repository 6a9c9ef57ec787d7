// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_free_field_h
#define keyblock_step_free_field_h

#include <keyblock/step/force_element.h>
#include <keyblock/step/free_field_column.h>

#include <functional>

namespace Keyblock
{
  /**
   * The ground beside side boundaries of kind free field: a FreeFieldColumn for
   * each of them, and what it does to the nodes of the side. With impedance C,
   * outward normal n, and velocity w and stress s of the column, a side gets
   * the traction C (w - v) + s n: what the model sends out leaves by dashpots,
   * and a wave that rises along the side finds the ground beside it moving as
   * it does.
   *
   * Every rank has all columns, and forces on its own nodes.
   */
  template <int dim>
  class FreeField
  {
  public:
    FreeField(const Scene<dim> &scene,
              const SplitMesh<dim> &split,
              const Numbering<dim> &numbering);

    /** Velocity that a support prescribes, or the wave that it lets in, by its
     * number, a place and a time [m/s; Pa if it lets_in_stress()]. */
    using Motion = std::function<
      Tensor<1, dim>(const unsigned int, const Point<dim> &, const double)>;

    /**
     * Find the sides of the supports that act.
     *
     * @param material by cell, `none` where it is excavated
     * @param entry_of_node index of an owned node in the lists that add_drive()
     * is given
     */
    void find_sides(
      const std::vector<bool> &acts,
      const std::vector<unsigned int> &material,
      const std::function<unsigned int(unsigned int node)> &entry_of_node);

    /** Take the ground's materials of a stage. */
    void take_ground(const Ground<dim> &ground);

    /** Move the columns on. */
    void advance(const MotionOfStep<dim> &step,
                 const std::vector<bool> &acts,
                 const Motion &motion);

    /** Add what the ground does to a side that does not move [N]. */
    void add_drive(std::vector<Tensor<1, dim>> &drive) const;

    void stop_motion();
    std::vector<double> remember() const;
    void recall(const double *numbers);

    bool
    is_empty() const
    {
      return sides.empty();
    }

  private:
    /** A boundary of a support, and the ground beside it. */
    struct Side
    {
      unsigned int support;
      std::string boundary;
      FreeFieldColumn<dim> column;
      Point<dim> foot;
      Tensor<2, dim> foot_impedance; ///< per area [Pa s/m]
    };

    /** The share that a node has in a face of a side. */
    struct Share
    {
      unsigned int side, entry;
      double elevation, face_elevation; ///< of node and face [m]
      Tensor<2, dim> impedance;         ///< times the area [N s/m]
      Tensor<1, dim> area;              ///< outwards [m2]
    };

    Side make_side(const unsigned int support,
                   const std::string &boundary) const;

    /** What the side is made of, from below. */
    std::vector<SideFace<dim>> list_faces(const std::string &boundary,
                                          const Ground<dim> &ground) const;

    FootMotion<dim> foot_motion(const Side &side,
                                const std::vector<bool> &acts,
                                const Motion &motion,
                                const MotionOfStep<dim> &step) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    std::vector<Side> sides; ///< of all supports, from the start on
    std::vector<Share> shares;
  };
} // namespace Keyblock

#endif

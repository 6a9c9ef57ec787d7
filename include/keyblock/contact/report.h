// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_report_h
#define keyblock_contact_report_h

#include <keyblock/contact/overlap.h>
#include <keyblock/contact/strength.h>
#include <keyblock/contact/surface_nodes.h>

namespace Keyblock
{

  /** Strength that points of a joint have had and do no longer. */
  struct StrengthLoss
  {
    double area     = 0.; ///< of those that have lost cohesion [m^(dim-1)]
    double cohesion = 0.; ///< over their areas [N]
    double tangent  = 0.; ///< tan(phi), mean over their normal forces [-]
  };

  /** Contact as monitors, output and safety factors see it: states and sums
   * over all ranks. */
  template <int dim>
  class ContactReport
  {
  public:
    ContactReport(const ContactSearch<dim> &search,
                  const PairTopology<dim> &topology,
                  const SurfaceNodes<dim> &nodes,
                  const Fields<dim> &fields,
                  const ContactMemory<dim> &memory);

    /** Mean of u(block) - u(other side) over the area of a block's pairs that
     * are there [m]; null without any (collective). */
    Vector<dim> mean_slip(const unsigned int block) const;

    /** Sums over the points of one block on each joint, forces on the block
     * (collective). */
    std::vector<JointSums<dim>> sum_over_block(const unsigned int block) const;

    /** Area of a block's pairs, by joint, whose cohesion is less than that of
     * the intact joint: they have opened, or slid where it is brittle
     * [m^(dim-1)] (collective). */
    std::vector<double> weakened_area(const unsigned int block) const;

    /** What a block's pairs have lost of the strength of the intact joint, by
     * joint (collective). */
    std::vector<StrengthLoss> lost_strength(const unsigned int block) const;

    /** Sums over the points of @p joints, shear being the sum of what each of
     * them bears; without any joint over all points, shear being that of all
     * joints. */
    JointSums<dim>
    sum_over_joints(const std::vector<unsigned int> &joints) const;

    /** How far the two sides of @p joints have moved, as measured between the
     * nodes that were paired at the start: means over their areas, of what is
     * there (collective). */
    JointMotion mean_motion(const std::vector<unsigned int> &joints) const;

    /** The deepest node in another block (collective). */
    Overlap<dim> largest_overlap() const;

    /** Contacts of nodes with faces of their own block that they lay behind at
     * the start: through the rock, where there should be none. */
    unsigned int count_through_rock() const;

    /** Numbers of open, sliding, sticking and intact points over all ranks. */
    JointSums<dim> count_points() const;

    /** The same of pairs alone, open and sliding ones: surfaces that merely
     * touch, as beside them, bear nothing and do not count. */
    JointSums<dim> count_pairs() const;

    /** 1 for blocks with a point that slid in the last step, by index of the
     * block, else 0 (collective). */
    std::vector<double> list_sliding_blocks() const;

    /** Blocks (indices, ascending) that some point pressed on @p block in the
     * last step (collective). */
    std::vector<unsigned int>
    list_blocks_pressed_on(const unsigned int block) const;

  private:
    /** What its joint's law remembers of a pair. */
    JointHistory history_of_pair(const unsigned int pair) const;

    void add_pairs(const std::vector<unsigned int> &sum_of_joint,
                   std::vector<JointSums<dim>> &sums,
                   std::vector<Vector<dim>> &moment) const;
    void add_surface_contacts(const std::vector<unsigned int> &sum_of_joint,
                              std::vector<JointSums<dim>> &sums,
                              std::vector<Vector<dim>> &moment) const;

    const ContactSearch<dim> &search;
    const PairTopology<dim> &topology;
    const Scene<dim> &scene;
    const Interface<dim> &interface;
    const ContactSurface<dim> &surface;
    const SurfaceNodes<dim> &nodes;
    const Fields<dim> &fields;
    const ContactMemory<dim> &memory;
  };
} // namespace Keyblock

#endif

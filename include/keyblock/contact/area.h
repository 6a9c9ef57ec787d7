// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_area_h
#define keyblock_contact_area_h

#include <keyblock/contact/overlap.h>
#include <keyblock/contact/strength.h>
#include <keyblock/contact/surface_nodes.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <vector>

namespace Keyblock
{

  /**
   * Which part of a joint each surface contact stands for, and where pairs have
   * opened. Areas where joints' faces lie on each other are given to the points
   * that touch there: the sum over a joint is the area of contact, whatever
   * touches what. Only for joints whose strength needs it.
   */
  template <int dim>
  class ContactAreas
  {
  public:
    ContactAreas(const PairTopology<dim> &topology,
                 const ContactStrength<dim> &strength,
                 const SurfaceNodes<dim> &nodes,
                 const Fields<dim> &fields,
                 ContactMemory<dim> &memory);

    /** Where faces lie on each other, after a search.
     * @param is_moved whether nodes have, since the one before */
    void find_overlaps(const bool is_moved);

    /** Share them out among the present surface contacts, by their impulses.
     */
    void share();

    /** Area that a surface contact stands for [m^(dim-1)]; NaN: unknown. */
    double of(const SurfaceContact<dim> &contact) const;

    /** Take the mean of the pressure on each joint between two blocks.
     * @param kick interval of the impulses [s] */
    void average_pressure(const double kick);

    /** That mean where a surface contact is [Pa]; 0 if there is none. What a
     * single point stands for changes as nodes pass faces. */
    double pressure_at(const SurfaceContact<dim> &contact) const;

    /** Mark the pairs of such joints whose sides have come apart, by more than
     * @p dilation_of(pair) has pushed them [m]. */
    void note_openings(const std::function<double(unsigned int)> &dilation_of);

  private:
    /** Node, joint and the other side's block of a surface contact. */
    using Footing = std::array<unsigned int, 3>;

    /** A part of where two blocks' faces lie on each other. */
    struct AreaShare
    {
      Footing footing; ///< of the point that stands for it
      Footing between; ///< joint and blocks
      double area;     ///< [m^(dim-1)]
    };

    /** A point that stands for a part of where two blocks' faces lie on each
     * other. */
    struct BearingPoint
    {
      Footing footing;
      unsigned int side_pair;   ///< index of its joint and blocks
      double area;              ///< [m^(dim-1)]
      double impulse      = 0.; ///< normal, of the last step [N s]
      double present_area = 0.; ///< once it is known what presses
    };

    /** Sums over the points of a joint between two blocks. */
    struct BearingSums
    {
      double area = 0., impulse = 0., present_area = 0.;
    };

    /** The surface contacts that need areas, in order. */
    std::vector<Footing> list_footings() const;

    /** Share the overlaps out among the points that are there. */
    void distribute(const std::vector<Footing> &footings);

    /** Index of the point of a footing; none if it has no area. */
    unsigned int find(const Footing &footing) const;

    /** Let points that hardly press give their parts to those that do. */
    void weigh_by_pressure();

    /** Joint, and two blocks in order. */
    static Footing
    between(const unsigned int joint,
            const unsigned int a,
            const unsigned int b)
    {
      return {{joint, std::min(a, b), std::max(a, b)}};
    }

    /** Joint and blocks of an overlap. */
    Footing key_of(const FaceOverlap<dim> &overlap) const;

    /** Give an area to the nodes of the slave face, else of the master face. */
    bool share_between(const FaceOverlap<dim> &overlap,
                       const double area,
                       const std::vector<Footing> &bearing,
                       std::vector<AreaShare> &shares) const;

    /** Give the nodes of a face that are in @p bearing their parts of an area
     * that it shares with @p block; false if there is none of them. */
    bool
    share_overlap(const double area,
                  const unsigned int face,
                  const unsigned int block,
                  const std::array<double, Mesh<dim>::n_face_vertices> &weight,
                  const std::vector<Footing> &bearing,
                  std::vector<AreaShare> &shares) const;

    /** Share of an overlap for which no surface point stands: that of nodes
     * with a pair, and if @p with_opened of those whose pair has opened:
     * cohesion is gone there, pressure is not. */
    double share_of_pairs(const FaceOverlap<dim> &overlap,
                          const bool with_opened) const;

    /** Whether a pair of a surface node on @p joint meets a condition of its
     * state and its partner's vertex. */
    template <typename Condition>
    bool has_pair_that(const unsigned int node,
                       const unsigned int joint,
                       const Condition &condition) const;

    /** Whether the pair of a surface node on @p joint has opened. */
    bool has_opened(const unsigned int node, const unsigned int joint) const;

    /** Whether a closed unconverted pair of a surface node on @p joint joins it
     * to a block. */
    bool has_pair(const unsigned int node,
                  const unsigned int joint,
                  const unsigned int block) const;

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const ContactSurface<dim> &surface;
    const ContactStrength<dim> &strength;
    const SurfaceNodes<dim> &nodes;
    const Fields<dim> &fields;
    ContactMemory<dim> &memory;
    std::vector<FaceOverlap<dim>> overlaps; ///< of the last search

    /** As list_footings() was when areas were distributed. */
    std::vector<Footing> shared_among;
    bool is_shared = false;
    std::vector<BearingPoint> points; ///< by footing
    std::vector<BearingSums> sums;    ///< by joint and blocks

    /** By joint and blocks [Pa]. */
    std::map<Footing, double> mean_pressure;
  };
} // namespace Keyblock

#endif

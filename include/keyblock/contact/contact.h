// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_contact_h
#define keyblock_contact_contact_h

#include <keyblock/contact/state.h>
#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>

#include <map>
#include <memory>

namespace Keyblock
{
  class JointLaw; // contact/joint_law.h
  struct JointPointState;
  struct StrengthEnvelope;

  /**
   * The contact step: from predicted velocities to velocities that satisfy
   * non-penetration, Coulomb friction and bonds (hot loop 2).
   *
   * Points that share nodes form groups. Pairs that have not slid form small
   * groups, one per vertex of the mesh before the split: a group that stuck in
   * the last step is merged into one cluster, its forces recovered and tested;
   * if a strength is exceeded it is solved by projected Gauss-Seidel. Every
   * rank that holds a node of such a group solves it, from the same numbers,
   * and so with the same result. Nodes that slid, or met a face they were not
   * paired with, are solved together on all ranks (`mobile`).
   */
  template <int dim>
  class Contact : private ContactMemory<dim>
  {
  public:
    Contact(const Scene<dim> &scene,
            const SplitMesh<dim> &split,
            const Blocks<dim> &blocks,
            const Numbering<dim> &numbering,
            const CellArrays<dim> &cells,
            Fields<dim> &fields);

    /** Replace all friction angles [deg]; negative: back to the scene's. */
    void override_friction(const double angle);

    /** Divide strengths until further notice. */
    void
    reduce_strength(const StrengthReduction &new_reduction)
    {
      reduction = new_reduction;
    }

    /** Let go of a block that is taken away, with the forces on it. */
    void remove_block(const unsigned int block);

    ContactMemory<dim>
    remember() const
    {
      return *this;
    }

    /** Go back to a state; surface contacts are searched anew. */
    void recall(const ContactMemory<dim> &memory);

    /** Take up a state of another run, and what its last search found. */
    void resume(const ContactMemory<dim> &memory);

    /** Mean of u(block) - u(other side) over the area of a block's pairs that
     * are there [m]; null without any (collective). */
    Vector<dim> mean_slip(const unsigned int block) const;

    /** Sums over the points of one block on each joint, forces on the block
     * (collective). */
    std::vector<JointSums<dim>> sum_over_block(const unsigned int block) const;

    /** Sides of a pair: blocks of its minus and plus vertices. */
    std::array<unsigned int, 2> blocks_of_pair(const unsigned int pair) const;

    /**
     * Prepare for stage @p number of the excavation: masses, supports and cells
     * may have changed, and pairs that rock dug by then had welded are let go.
     */
    void begin_stage(const unsigned int number);

    /**
     * Hold the points that, in the present state, only the mesh makes slide:
     * where it has bent a joint's faces, pressure has a part along the joint.
     * The next step is to be solved with tie(true) before, so that forces are
     * known. Not where a block is exposed (collective).
     * @return number of points held
     */
    unsigned int hold_bent_points(const std::vector<bool> &is_exposed);

    /** Let those go along the ramp of the stage that begins. */
    void release_bent_points();

    /** Whether all points stick from now on, whatever their strength. */
    void
    tie(const bool ties)
    {
      is_tied = ties;
    }

    /** Turn predicted velocities of all local nodes into final ones. */
    void solve(const ContactStep &step);

    /** Sums over the points of @p joints, shear being the sum of what each of
     * them bears; without any joint over all points, without shear. */
    JointSums<dim>
    sum_over_joints(const std::vector<unsigned int> &joints) const;

    /** The deepest node in another block (collective). */
    Overlap<dim>
    largest_overlap() const
    {
      return search.find_largest_overlap(gather_positions(), is_removed_block);
    }

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

    /** Pair states of all ranks, by index of the pair. */
    std::vector<PairState<dim>> gather_pair_states() const;

    /** Kick interval of the last step [s]. */
    double
    present_kick() const
    {
      return last_kick > 0. ? last_kick : 1.;
    }

    /** Local nodes of the slots that are solved on all ranks: those that have
     * slid, and those that may meet a face. They change when n_searches does.
     */
    std::vector<unsigned int> list_mobile_nodes() const;

    ContactWork work;              ///< sum since the start, this rank's share
    unsigned int n_capped     = 0; ///< groups that reached the cap
    double n_solved           = 0; ///< groups solved by iteration
    unsigned int n_iterations = 0; ///< largest of the last step
    unsigned int n_searches   = 0;
    unsigned int n_mobile     = 0; ///< slots solved on all ranks

  private:
    /** Node, joint and the other side's block of a surface contact. */
    using Footing = std::array<unsigned int, 3>;

    /** A group of one pair of nodes, solved on the fields themselves. */
    struct SinglePair
    {
      unsigned int pair, minus, plus; ///< local nodes
    };

    /** A group of several pairs, or with partly held nodes. */
    struct CornerGroup
    {
      unsigned int group;
      std::vector<unsigned int> slots;

      /** Inverse of the area-weighted Laplacian of the free nodes, one per
       * axis (they differ where nodes are held along an axis). */
      std::array<std::vector<double>, dim> inverse;
      std::array<std::vector<int>, dim> free_index;
      bool has_supports = false;
      bool is_oblique   = false;
    };

    /** Share of a Gauss point's stress in the mean traction of a pair. */
    struct TractionWeight
    {
      unsigned int pair, cell, point;
      Vector<dim> weight; ///< [m^(dim-1)]
    };

    void measure_slots();
    void set_up_groups();
    void list_corner_slots();
    void set_up_corners();

    /** Let go of the pairs that rock dug in stage @p number held together. What
     * they bore beyond the joint's strength is taken away with the rock. */
    void unweld(const unsigned int number);
    void set_up_corner(CornerGroup &corner);
    void set_up_traction_weights();
    void rebuild_active_slots();
    void gather_slots(const bool with_displacement);
    void scatter_slots();
    void estimate_tractions();
    void solve_single_pairs(const ContactStep &step);
    void solve_corner(CornerGroup &corner, const ContactStep &step);
    bool try_cluster(CornerGroup &corner, const ContactStep &step);
    void recover_impulses(const CornerGroup &corner, const double *needed);
    void solve_mobile(const ContactStep &step);

    /** Surface contacts nearer than @p reach [m], with their strengths and the
     * impulses of the step before. */
    void find_surface_contacts(const ContactStep &step, const double reach);

    /** What the pair bore that a surface contact replaces, before it slid. */
    Vector<dim> impulse_of_slid_pair(const SurfaceContact<dim> &contact,
                                     const double scale) const;

    /** Give the areas where joints' faces lie on each other to the points that
     * touch there: the sum over a joint is the area of contact, whatever
     * touches what. */
    void share_areas();

    /** A part of where two blocks' faces lie on each other. */
    struct AreaShare
    {
      Footing footing; ///< of the point that stands for it
      Footing between; ///< joint and blocks
      double area;     ///< [m^(dim-1)]
    };

    /** Give the nodes of a face that are in @p bearing their parts of an area
     * that it shares with @p block; false if there is none of them. */
    bool
    share_overlap(const double area,
                  const unsigned int face,
                  const unsigned int block,
                  const std::array<double, Mesh<dim>::n_face_vertices> &weight,
                  const std::vector<Footing> &bearing,
                  std::vector<AreaShare> &shares) const;

    /** Share of an overlap for which no surface point can stand: that of nodes
     * with a pair, or whose pair has opened. */
    double share_of_pairs(const FaceOverlap<dim> &overlap) const;

    /** Mark the pairs of joints with cohesion whose sides have come apart. */
    void note_openings();

    /** Whether the pair of @p slot on @p joint has opened. */
    bool has_opened(const unsigned int slot, const unsigned int joint) const;

    /** Whether a closed unconverted pair of @p slot on @p joint joins it to a
     * block.
     */
    bool has_pair(const unsigned int slot,
                  const unsigned int joint,
                  const unsigned int block) const;

    PointStrength surface_strength(const SurfaceContact<dim> &contact,
                                   const double kick) const;

    /** Mobile pairs that surface contacts may push; corners that none touches
     * are solved by themselves. */
    std::vector<unsigned int> list_mobile_pairs(const ContactStep &step);

    /** Whether node @p k of a point has a share in it and may move. */
    bool can_move(const ContactPoint<dim> &point, const int k) const;

    /** Numbers of the points that share nodes which can move. */
    std::vector<std::vector<unsigned int>>
    group_points(const std::vector<ContactPoint<dim>> &points) const;

    /** What the joints' laws remember: add the slip of the last step. */
    void advance_histories(const ContactStep &step);

    /** A pair leaves what its joint's law remembers to its nodes. */
    void pass_on_history(const unsigned int pair);

    /** What a node's law remembers; null if nothing. */
    const JointHistory *find_history(const unsigned int slot,
                                     const unsigned int joint) const;

    /** The same, made if it is not there. */
    JointHistory &history_at(const unsigned int slot, const unsigned int joint);

    /** Effective normal stress of the last step [Pa] of a point of @p area. */
    double pressure_of(const Vector<dim> &impulse,
                       const Vector<dim> &normal,
                       const double area) const;

    /** Area that a surface contact stands for [m^(dim-1)]; 0 if unknown. */
    double area_of(const SurfaceContact<dim> &contact) const;

    /** Velocity of a pair's plus side from its minus side [m/s]; false if this
     * rank does not have both. */
    bool relative_velocity_of(const unsigned int pair,
                              Vector<dim> &velocity) const;

    /** A converted pair shows the surface contact of its nodes. */
    void show_on_converted_pairs();
    void update_mobility(const ContactStep &step);

    /** Search at searched_position.
     * @param is_moved whether that is new, else only what has converted since
     *   is searched again */
    void list_candidates(const bool is_moved);

    /** Which slots are solved on all ranks, after a search. */
    void mark_mobile_slots();

    /** Whether a group has a converted pair, by group. */
    std::vector<bool> list_converted_groups() const;
    void refresh_normals();
    void correct_penetration();

    /** Solve points that belong together by the method of the scene. */
    void solve_points(std::vector<ContactPoint<dim>> &points,
                      const std::vector<PointStrength> &broken,
                      const ContactNodes<dim> &nodes,
                      const double step);
    bool
    is_published_variant() const
    {
      return scene.contact.method == "paper";
    }

    /** @return whether one has slid on this rank. */
    bool convert_slid_pairs();

    /** Put the masters of hanging nodes in their place. */
    void put_masters_into(ContactPoint<dim> &point) const;
    ContactPoint<dim> pair_as_point(const unsigned int pair,
                                    const double kick) const;
    void book_work(const ContactPoint<dim> &point,
                   const double *old_velocity,
                   const double *new_velocity);
    /** Strength by the joint's law, or of free faces (none), with what the
     * stage has put in the place of friction. */
    StrengthEnvelope envelope_of(const unsigned int joint,
                                 const JointPointState &state) const;
    PointStrength pair_strength(const unsigned int pair,
                                const bool is_intact,
                                const double kick) const;
    std::vector<double> gather_positions() const;
    bool is_primary(const unsigned int group) const;

    /** Tension and shear of a pair in state @p now beyond its strength [N]. */
    std::array<double, 2> beyond_strength(const unsigned int pair,
                                          const PairState<dim> &now) const;

    const Scene<dim> &scene;
    const Interface<dim> &interface;
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;
    const CellArrays<dim> &cells;
    Fields<dim> &fields;

    using Memory = ContactMemory<dim>;
    using Memory::contacts;
    using Memory::is_mobile_group;
    using Memory::is_mobile_slot;
    using Memory::is_removed_block;
    using Memory::is_search_due;
    using Memory::last_kick;
    using Memory::mobile_corners;
    using Memory::mobile_slots;
    using Memory::n_steps;
    using Memory::next_look;
    using Memory::node_histories;
    using Memory::normal;
    using Memory::searched_position;
    using Memory::state;

    std::vector<unsigned int> group_of_pair, group_of_slot;
    std::vector<std::shared_ptr<const JointLaw>> laws; ///< by joint
    std::shared_ptr<const JointLaw> law_of_free_faces;
    bool has_memory         = false; ///< one of the laws
    double override_tangent = -1.;
    double weld_share       = 0.; ///< as in ContactStep
    bool is_tied            = false;
    StrengthReduction reduction;

    std::vector<SinglePair> single_pairs;
    std::vector<CornerGroup> corners;
    std::vector<TractionWeight> traction_weights;
    std::vector<Vector<dim>> traction; ///< force estimate of each pair [N]
    std::vector<unsigned int> corner_pairs;

    ContactSearch<dim> search;
    std::vector<unsigned int> active_slots; ///< mobile and corner slots here

    std::vector<bool> listed_converted; ///< pairs that were at the last search

    std::vector<bool> needs_areas;          ///< of surface points, by joint
    std::vector<FaceOverlap<dim>> overlaps; ///< of such joints, last search

    /** Those within reach, and those that press, sorted. */
    std::array<std::vector<Footing>, 2> shared_among;
    std::map<Footing, double> covered_area; ///< [m^(dim-1)]

    // dim values per slot
    std::vector<double> slot_velocity, slot_old_velocity, slot_displacement,
      slot_position, slot_impulse;
    std::vector<double> slot_inverse_mass, slot_mass;
    std::vector<unsigned int> node_of_slot;
    std::vector<std::array<double, dim * dim>> projection_storage;
    std::vector<const double *> slot_projection;
    ContactNodes<dim> slot_nodes;
  };
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_scene_h
#define keyblock_scene_scene_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/base/communicator.h>
#include <keyblock/scene/bolts.h>
#include <keyblock/scene/boundary.h>
#include <keyblock/scene/domain.h>
#include <keyblock/scene/ground.h>
#include <keyblock/scene/joint.h>
#include <keyblock/scene/liner.h>
#include <keyblock/scene/results.h>
#include <keyblock/scene/safety.h>
#include <keyblock/scene/stage.h>
#include <keyblock/scene/study.h>

#include <memory>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  using dealii::ParameterHandler;
  using dealii::Point;
  using dealii::Tensor;

  struct SceneText;

  /** What seismic coefficients are multiples of [m/s2]. */
  constexpr double standard_gravity = 9.81;

  /**
   * A whole scene: one struct per section of the .prm file, defaults in the
   * structs. Lists of named things (joints, materials, ...) are declared by
   * the entry `Names` of their section, each with a subsection of its own.
   */
  template <int dim>
  struct Scene
  {
    std::string title;
    std::string file;
    Domain<dim> domain;
    Meshing<dim> meshing;
    InitialState<dim> initial_state;
    DepthGround<dim> ground;
    WaterSettings water;
    ContactSettings contact;
    TimeStepping time_stepping;
    SafetySettings safety;
    BlockTheorySettings block_theory;
    CheckSettings checks;
    OutputSettings output;
    StudySettings study;

    std::vector<std::unique_ptr<Excavation<dim>>> excavations;
    JointNetwork network;
    std::vector<std::unique_ptr<JointSet<dim>>> joint_sets;
    std::vector<std::unique_ptr<Joint<dim>>> joints; ///< from all sources
    std::vector<std::unique_ptr<Material<dim>>> materials;
    std::vector<std::unique_ptr<Support<dim>>> supports;
    std::vector<std::unique_ptr<BoltSet<dim>>> bolts;
    std::vector<std::unique_ptr<Liner>> liners;
    std::vector<std::unique_ptr<Traction<dim>>> tractions;
    std::vector<std::unique_ptr<Stage>> stages;
    std::vector<std::unique_ptr<Monitor<dim>>> monitors;
    std::vector<std::unique_ptr<StudyVariable>> study_variables;

    /**
     * Read @p file_name, apply @p overrides ("Section/Entry=value"), check.
     * Throws InputError with one sentence for whatever cannot be used.
     * Collective.
     */
    void read(const Communicator &communicator,
              const std::string &file_name,
              const std::vector<std::string> &overrides);

    /** Make the joints anew with @p overrides of entries of joint sets
     * ("Joint sets/NAME/Entry=value"), after read(), and check. Throws
     * InputError (collective). */
    void redraw(const Communicator &communicator,
                const std::vector<std::string> &overrides);

    /** Number of the stage called @p name: 1 for start, before the first stage,
     * 2 for the first one of `Stages/Names`, and so on. */
    unsigned int stage_number(const std::string &name) const;

    /** Number of the stage from whose beginning the times of a support's
     * history are counted: that of `History stage`, else the first dynamic
     * stage from `Stage` on; stages.size() + 2 if there is none. */
    unsigned int history_stage(const Support<dim> &support) const;

    /** Whether a stage is quasi-static or static: displacements of supports are
     * reached in the first one. */
    bool has_stage_to_balance() const;

    bool has_dynamic_stage() const;

    /** Index into materials of the one called @p name, or their number. */
    unsigned int material_index(const std::string &name) const;

    /** Indices into joints of the one called @p name, or of all those of the
     * set of that name; empty: there is neither. */
    std::vector<unsigned int> joints_called(const std::string &name) const;

    /** Pressure of water in a joint from the stage with this number on, a
     * formula in x, y (z) and t [Pa]; empty: none. */
    std::string water_pressure(const unsigned int joint,
                               const unsigned int number) const;

    /** Seismic acceleration over 9.81 m/s2 that acts on all rock from the stage
     * with this number on [-]. */
    Tensor<1, dim> seismic_coefficient(const unsigned int number) const;

    /** What is allowed and probably not meant, one sentence each. */
    std::vector<std::string> warnings() const;

    /** Contradictions between entries, before anything is computed. */
    void cross_check() const;

    /** Declare everything, one example of each named thing included. */
    void declare(ParameterHandler &prm);

    /** Write all entries with the values used; every joint, also those of
     * tables and sets, is written out, so that the file needs neither. */
    void write_used(const std::string &file_name) const;

    /** The same as text, without descriptions, and with digests of the files of
     * excavations. */
    std::string used_entries() const;

  private:
    void make_joints_of_sources();

    void read_histories();

    /** Put polygons in place of the excavations of a profile, one for each
     * bench. Throws InputError. */
    void make_profiles();

    /** Put in what `Ground` gives and @p text leaves open. Throws InputError.
     */
    void complete_ground(const SceneText &text);

    /** All entries as text, every joint written out. */
    std::string print_entries(const bool has_descriptions) const;

    std::shared_ptr<const SceneText> source;
    std::vector<std::string> joint_names;  ///< of `Joints/Names`
    bool is_resolved = false;              ///< as the file says
    std::shared_ptr<ParameterHandler> prm; ///< as read, all but the joints
    std::vector<std::string> old_names;    ///< sentences on those in the file
  };

  /** The value of `Dimension` in the file: 2 or 3 (collective). Throws
   * InputError. */
  unsigned int read_dimension(const Communicator &communicator,
                              const std::string &file_name,
                              const std::vector<std::string> &overrides);

  /** Write the description of every entry as Markdown (doc/parameters.md). */
  void print_parameters(std::ostream &out);
} // namespace Keyblock

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_scene_h
#define keyblock_scene_scene_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/base/communicator.h>
#include <keyblock/base/time_series.h>
#include <keyblock/law/joint_strength.h>
#include <keyblock/scene/bolts.h>
#include <keyblock/scene/choices.h>
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

  /** What seismic coefficients are multiples of [m/s2]. */
  constexpr double standard_gravity = 9.81;

  /** The body of ground that is modelled, before anything is excavated. */
  template <int dim>
  struct Domain
  {
    DomainShape shape = DomainShape::box;
    Point<dim> corner;
    std::vector<double> size;
    std::vector<Point<dim>> edges;
    std::vector<Point<dim>> polygon;
    std::string file;
    std::vector<std::string> truncated_boundaries = {"all"};
    Point<dim> origin; ///< grid coordinates of the model's (0, 0, 0) [m]

    void declare(ParameterHandler &prm);
  };

  /** How the domain is cut into cells. */
  template <int dim>
  struct Meshing
  {
    MeshGenerator generator = MeshGenerator::structured;
    std::vector<unsigned int> cells;
    std::vector<std::string> gradings;
    double size               = 0.;
    double size_at_excavation = 0.;
    double size_at_joints     = 0.;
    double grading_distance   = 0.;
    double cells_across       = 0.;
    double least_size         = 0.;
    double joint_tolerance    = 1e-6;
    double snap               = 0.2;

    // local refinement
    std::vector<double> refine_at_excavations;
    std::vector<double> refine_at_joints;
    std::string refinement_levels;

    bool
    is_refined() const
    {
      return !refine_at_excavations.empty() || !refine_at_joints.empty() ||
             !refinement_levels.empty();
    }

    void declare(ParameterHandler &prm);
  };

  /** A region that is excavated out in one stage. */
  template <int dim>
  struct Excavation
  {
    std::string name;
    ExcavationShape shape = ExcavationShape::polygon;
    std::vector<Point<2>> vertices;
    Point<dim> corner;
    std::vector<double> size;
    Point<2> center;
    double radius         = 0.;
    double width          = 0.;
    double height         = 0.;
    double rise           = 0.;
    unsigned int segments = 24;
    std::vector<double> bench_levels;
    std::vector<std::string> bench_stages;
    double from = 0.;
    double to   = 0.;
    std::string formula;
    std::string stage = "start";
    std::string backfill_stage;
    std::string backfill_material;

    /** Whether Center, Width and Height say what it is: polygons for all but
     * the reader of entries (Scene::make_profiles). */
    bool
    is_profile() const
    {
      return shape == ExcavationShape::rectangle ||
             shape == ExcavationShape::horseshoe ||
             shape == ExcavationShape::cavern;
    }

    void declare(ParameterHandler &prm);
  };

  /** Ground whose state follows from its depth: what entries leave open of
   * gravity, initial stress, supports and overburden. */
  template <int dim>
  struct DepthGround
  {
    double depth   = 0.; ///< of elevation 0 below the surface [m]; 0: none
    double density = 0.; ///< 0: of the first material that deforms
    std::vector<double> k0 = {1.};
    double azimuth         = 90.;

    void declare(ParameterHandler &prm);
  };

  /** A plane of weakness: where it is and how strong it is. */
  template <int dim>
  struct Joint : public JointStrength
  {
    std::string name;
    std::string set;    ///< name of the set it belongs to; empty: none
    std::string origin; ///< for messages: the row of the table; empty: entries
    Point<dim> point;
    std::vector<double> normal_entry;
    double dip           = 0.;
    double dip_direction = 90.;
    JointShape extent    = JointShape::infinite;
    double radius        = 0.;
    std::vector<Point<dim>> vertices;

    /** Unit normal, pointing up (to +x for a vertical joint): minus to plus. */
    Tensor<1, dim> normal() const;

    /** Signed distance [m] of @p p from the joint's plane. */
    double distance(const Point<dim> &p) const;

    /** Whether @p p, taken to lie on the plane, is within the joint's extent
     * widened by @p tolerance [m]. */
    bool is_within_extent(const Point<dim> &p, const double tolerance) const;

    void declare(ParameterHandler &prm);
  };

  /** Joints besides those of `Joints/Names`. */
  struct JointNetwork
  {
    std::string file;
    bool is_resolved = false;

    void declare(ParameterHandler &prm);
  };

  /**
   * Joints that belong together: their strength and, if Spacing, P32 or P10
   * is given, the statistics that they are made from.
   */
  template <int dim>
  struct JointSet
  {
    std::string name;
    double dip           = 0.;
    double dip_direction = 90.;
    double concentration = -1.; ///< Fisher's or von Mises' kappa; -1: parallel

    // how many; at most one of the three is positive
    double spacing                  = 0.; ///< mean, along the mean normal [m]
    SpacingDistribution spacing_law = SpacingDistribution::exponential;
    double jitter                   = 0.; ///< share of a constant spacing [-]
    double persistence = 1.; ///< jointed share of the planes spaced so [-]
    double intensity   = 0.; ///< P32 [m2/m3]; in 2D P21 [m/m2]
    double frequency   = 0.; ///< P10 along the mean normal [1/m]

    // how large
    RadiusDistribution radius_law = RadiusDistribution::infinite;
    double radius_mean            = 0.;
    double radius_deviation       = 0.;
    double radius_minimum         = 0.;
    double radius_maximum         = 0.;
    double radius_exponent        = 3.;

    // where
    std::vector<double> region_corner;
    std::vector<double> region_size;
    unsigned int seed = 1;

    JointStrength strength;

    /** Whether joints are made, and not only given their strength. */
    bool
    is_made() const
    {
      return spacing > 0. || intensity > 0. || frequency > 0.;
    }

    void declare(ParameterHandler &prm);
  };

  /** Rock, fault filling or a rigid body, and where it is. */
  template <int dim>
  struct Material
  {
    std::string name;
    std::string region         = "all";
    std::string stage          = ""; ///< from which on; empty: the start
    MaterialModel model        = MaterialModel::elastic;
    double young_modulus       = 15e9;
    double poisson_ratio       = 0.25;
    double density             = 2700.;
    std::string rigid_velocity = "";

    // strength of the model mohr_coulomb; -1 as the entries explain
    double cohesion                  = 0.;
    double friction_angle            = 30.;
    double dilation_angle            = 0.;
    double tensile_strength          = -1.;
    double residual_cohesion         = -1.;
    double residual_friction_angle   = -1.;
    double residual_tensile_strength = -1.;
    double softening_strain          = 0.;
    CellIntegration integration      = CellIntegration::automatic;

    bool
    is_rigid() const
    {
      return model == MaterialModel::rigid;
    }
    bool
    is_plastic() const
    {
      return model == MaterialModel::mohr_coulomb;
    }

    /** Whether the volume change is averaged over each cell (B-bar), so that
     * neither plastic flow nor a high Poisson ratio locks. */
    bool
    has_mean_dilatation() const
    {
      return integration == CellIntegration::mean_dilatation ||
             (integration == CellIntegration::automatic &&
              (is_plastic() || poisson_ratio > 0.4));
    }

    /** Tensile strength at which the cone of friction and cohesion ends [Pa];
     * infinite without friction. */
    double apex() const;

    double
    lame_lambda() const
    {
      return young_modulus * poisson_ratio /
             ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }
    double
    shear_modulus() const
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }

    void declare(ParameterHandler &prm);
  };

  /** Nodes held, or moved in a prescribed way. */
  template <int dim>
  struct Support
  {
    std::string name;
    std::vector<std::string> boundaries;
    std::string region;
    SupportDirections directions = SupportDirections::all;
    std::string velocity;
    std::string displacement;
    SupportKind kind = SupportKind::held;
    Point<dim> center;
    std::string stage = "start"; ///< from which on it is quiet
    std::string history_file;
    HistoryQuantity history_quantity = HistoryQuantity::velocity;

    /** Of History file: velocities, of stress as they are; null: none. */
    std::shared_ptr<const TimeSeries> history;

    bool
    is_far_field() const
    {
      return kind == SupportKind::far_field;
    }

    bool
    is_quiet() const
    {
      return kind == SupportKind::quiet;
    }

    /** Whether `Directions` names the axis @p d (0: x). */
    bool names_axis(const unsigned int d) const;

    void declare(ParameterHandler &prm);
  };

  /** A surface load in N/m2, tension (pull outwards) positive. */
  template <int dim>
  struct Traction
  {
    std::string name;
    std::vector<std::string> boundaries;
    std::string region;
    std::string expression;
    std::string stage = "start";

    void declare(ParameterHandler &prm);
  };

  /** State at time zero, and gravity. */
  template <int dim>
  struct InitialState
  {
    std::string gravity;
    std::string stress;
    std::string velocity;

    // stress that grows with depth
    double surface_elevation           = 0.;
    double vertical_stress_gradient    = 0.;
    double surface_stress              = 0.;
    std::vector<double> lateral_ratios = {1.};
    double lateral_azimuth             = 90.;

    InitialEquilibrium equilibrium = InitialEquilibrium::none;

    // stress inverted from measurements
    std::string measured_points;
    std::vector<std::string> stress_fields;

    bool
    has_depth_stress() const
    {
      return vertical_stress_gradient > 0. || surface_stress != 0.;
    }

    void declare(ParameterHandler &prm);
  };

  /** A water level that stands for none. */
  constexpr const char *no_water = "none";

  /** Water table: pressure in joints without a Water pressure of their own. */
  struct WaterSettings
  {
    std::string level;          ///< its elevation, a formula [m]; empty: none
    double unit_weight = 9810.; ///< [N/m3]

    void declare(ParameterHandler &prm);
  };

  /** How contact is found and solved. */
  struct ContactSettings
  {
    ContactMethod method            = ContactMethod::exact;
    double default_friction_angle   = 30.;
    double tolerance                = 1e-8;
    unsigned int maximum_iterations = 2000;
    double slip_tolerance           = 1e-6;
    bool weld_infinite_blocks       = true;
    bool tie_all                    = false;

    bool
    is_published_variant() const
    {
      return method == ContactMethod::published;
    }

    void declare(ParameterHandler &prm);
  };

  /** The explicit step. */
  struct TimeStepping
  {
    Kinematics kinematics     = Kinematics::small;
    double safety             = 0.9;
    double maximum_step       = 0.;
    double least_step         = 0.;
    double largest_added_mass = 0.01;
    bool ledger               = true;
    bool skips_resting        = true;
    double rest_speed         = 1e-12;

    bool
    is_large() const
    {
      return kinematics == Kinematics::large;
    }

    void declare(ParameterHandler &prm);
  };

  /** A stretch of time with its own damping, or a way to a new equilibrium;
   * excavations that name it are excavated at its start. */
  struct Stage
  {
    std::string name;
    StageKind kind             = StageKind::dynamic;
    double duration            = 0.;
    unsigned int maximum_steps = 0;
    double unbalanced_ratio    = 0.;
    double damping_ratio       = 0.;
    double mass_damping        = 0.;
    double local_damping       = 0.;
    bool damps_contact_force   = true;
    bool scales_density        = true;
    double ramp_duration       = 0.;
    std::string water_level;                 ///< from it on; empty: as before
    std::vector<double> seismic_coefficient; ///< the same
    double ramp_unbalance          = 2e-3;
    double friction_angle_override = -1.;
    bool reset_motion              = false;

    bool
    is_quasi_static() const
    {
      return kind == StageKind::quasi_static;
    }
    bool
    is_static() const
    {
      return kind == StageKind::static_solve;
    }

    /** Give the entries of a quasi-static stage that were left at zero the
     * values of its driver. */
    void complete();

    void declare(ParameterHandler &prm);
  };

  /** Safety factors by strength reduction, and what goes with them. */
  struct SafetySettings
  {
    std::string blocks = "none";
    std::vector<std::string> stages;
    std::vector<std::string> joints;
    ReducedJoints reduced_joints = ReducedJoints::of_block;
    bool reduces_rock            = false;
    FactorSearch method          = FactorSearch::bisection;
    double sweep_step            = 0.01;
    double bracket               = 0.005;
    double lowest                = 0.1;
    double highest               = 100.;
    double mass_damping          = 0.2;
    double local_damping         = 0.;
    double damping_ratio         = 1.;
    double window                = 1.;
    double maximum_periods       = 100.;
    unsigned int trial_steps     = 0;
    bool warm_start              = true;
    bool adaptive_damping        = true;
    bool true_masses             = false;
    double reach                 = 3.;
    std::vector<double> seismic_coefficient;
    double removal_slip            = 0.05;
    BoltConvention bolt_convention = BoltConvention::active;
    double wanted                  = 0.; ///< factor [-]
    double critical_factor         = 2.; ///< by limit equilibrium [-]
    unsigned int rank_groups       = 1;

    bool
    is_wanted() const
    {
      return blocks != "none";
    }

    /** Whether only blocks with a free face are asked for. */
    bool
    wants_exposed_only() const
    {
      return blocks == "exposed" || wants_critical_only();
    }

    /** Whether only those of them are, whose factor by limit equilibrium is
     * below the critical one. */
    bool
    wants_critical_only() const
    {
      return blocks == "critical";
    }

    /** Whether the factor of the block called @p id (from 1) is asked for, as
     * far as its number tells. */
    bool wants_block(const unsigned int id) const;

    bool wants_stage(const std::string &name) const;

    void declare(ParameterHandler &prm);
  };

  /** Which faces the block theory report looks at. */
  struct BlockTheorySettings
  {
    bool report = false;

    /** Azimuths that walls face, seen from the rock [deg]; in 2D 90 (+x) and
     * 270 (-x) only. */
    std::vector<double> walls = {0., 90., 180., 270.};

    /** Free width of a flat roof [m], 0: no largest wedges. */
    double roof_span = 0.;
    /** Azimuth of the axis across which it is measured [deg]. */
    double roof_axis = 0.;

    void declare(ParameterHandler &prm);
  };

  /** A quantity written to history.csv. */
  template <int dim>
  struct Monitor
  {
    std::string name;
    MonitorKind kind   = MonitorKind::point;
    std::string region = "1";
    std::string joint;
    std::string support;
    Point<dim> location;

    void declare(ParameterHandler &prm);
  };

  /** The closed form that the scene is compared with. */
  struct CheckSettings
  {
    ClosedForm closed_form = ClosedForm::none;
    std::string joint      = "";
    double reference_time  = 0.;
    double window_start    = 0.;
    double length          = 0.;
    std::string quantity   = "";
    double reference       = 0.;

    /** Whether it is measured in the rock and not by monitors. */
    bool
    needs_rock() const
    {
      return closed_form == ClosedForm::gravity_column ||
             closed_form == ClosedForm::kirsch ||
             closed_form == ClosedForm::salencon ||
             closed_form == ClosedForm::footing ||
             closed_form == ClosedForm::spherical_cavity ||
             closed_form == ClosedForm::value;
    }

    void declare(ParameterHandler &prm);
  };

  /** What is written, and how often. */
  struct OutputSettings
  {
    std::string folder            = "";
    unsigned int history_interval = 1;
    unsigned int vtu_count        = 5;
    bool write_vtu                = true;
    double checkpoint_interval    = 600.;

    void declare(ParameterHandler &prm);
  };

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

    /** Number of the stage called @p name: 1 for start, before the first stage,
     * 2 for the first one of `Stages/Names`, and so on. */
    unsigned int stage_number(const std::string &name) const;

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

    /** The same as text, without descriptions. */
    std::string used_entries() const;

  private:
    void read_histories();

    /** Put polygons in place of the excavations of a profile, one for each
     * bench. Throws InputError. */
    void make_profiles();

    /** Put in what `Ground` gives. Throws InputError. */
    void complete_ground();

    /** All entries as text, every joint written out. */
    std::string print_entries(const bool has_descriptions) const;

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

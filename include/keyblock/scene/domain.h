// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_domain_h
#define keyblock_scene_domain_h

#include <deal.II/base/point.h>

#include <keyblock/base/choice.h>

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

  class Solid;

  /** Shape of the domain; file: that of a mesh file. */
  enum class DomainShape
  {
    box,
    parallelepiped,
    polygon,
    file
  };
  template <>
  struct ChoiceNames<DomainShape>
  {
    static constexpr std::array<const char *, 4> names = {
      {"box", "parallelepiped", "polygon", "file"}};
  };

  /** Who makes the cells. */
  enum class MeshGenerator
  {
    structured,
    gmsh,
    file
  };
  template <>
  struct ChoiceNames<MeshGenerator>
  {
    static constexpr std::array<const char *, 3> names = {
      {"structured", "gmsh", "file"}};
  };

  /** Shape of an excavation. */
  enum class ExcavationShape
  {
    polygon,
    circle,
    box,
    extruded_polygon,
    formula,
    rectangle,
    horseshoe,
    cavern,
    file
  };
  template <>
  struct ChoiceNames<ExcavationShape>
  {
    static constexpr std::array<const char *, 9> names = {{"polygon",
                                                           "circle",
                                                           "box",
                                                           "extruded polygon",
                                                           "formula",
                                                           "rectangle",
                                                           "horseshoe",
                                                           "cavern",
                                                           "file"}};
  };

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
    unsigned int segments = 0; ///< 0: by the size of cells
    std::vector<double> bench_levels;
    std::vector<std::string> bench_stages;
    unsigned int bench = 0; ///< of a part: its number below the first one
    double from        = 0.;
    double to          = 0.;
    std::string formula;
    std::string file;
    double scale      = 1.; ///< length of the file's unit [m]
    std::string stage = "start";
    std::string backfill_stage;
    std::string backfill_material;

    /** What File contains, if the shape is file and was read
     * (read_shape_files()), the same on all ranks; 3D. */
    std::vector<std::shared_ptr<const Solid>> solids;
    std::string file_digest; ///< of the bytes of File

    // an extrusion's axis, from From to To
    double trend  = 0.; ///< [deg]
    double plunge = 0.; ///< [deg]
    Point<2> pivot;     ///< where it meets the x-z plane [m]

    /** Whether Center and Width and Height, or Radius, say what it is: polygons
     * for all but the reader of entries (Scene::make_profiles). A circle in 2D
     * is none unless it has benches or a number of chords. */
    bool
    is_profile() const
    {
      return shape == ExcavationShape::rectangle ||
             shape == ExcavationShape::horseshoe ||
             shape == ExcavationShape::cavern ||
             (shape == ExcavationShape::circle &&
              (dim == 3 || segments > 0 || !bench_levels.empty()));
    }

    /** Whether the axis of an extruded section is not y. */
    bool
    is_turned() const
    {
      return trend != 0. || plunge != 0.;
    }

    /** Whether it is a physical group of the mesh file, that of its name. */
    bool
    is_group() const
    {
      return shape == ExcavationShape::file && file.empty();
    }

    /** Whether depths inside are known, rather than only what is inside. */
    bool
    has_outline() const
    {
      return shape != ExcavationShape::formula && !is_group();
    }

    void declare(ParameterHandler &prm);
  };
} // namespace Keyblock

#endif

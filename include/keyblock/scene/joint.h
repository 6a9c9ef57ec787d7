// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_h
#define keyblock_scene_joint_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/base/choice.h>
#include <keyblock/law/joint_strength.h>

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

  /** What a joint is: a plane, or a surface of several plane facets. */
  enum class JointForm
  {
    plane,
    polyline,
    file,
    physical_group
  };
  template <>
  struct ChoiceNames<JointForm>
  {
    static constexpr std::array<const char *, 4> names = {
      {"plane", "polyline", "file", "physical group"}};
  };

  /** Extent of a joint within its plane. */
  enum class JointShape
  {
    infinite,
    disc,
    polygon
  };
  template <>
  struct ChoiceNames<JointShape>
  {
    static constexpr std::array<const char *, 3> names = {
      {"infinite", "disc", "polygon"}};
  };

  /** Law of the spacings of a set of joints. */
  enum class SpacingDistribution
  {
    exponential,
    constant
  };
  template <>
  struct ChoiceNames<SpacingDistribution>
  {
    static constexpr std::array<const char *, 2> names = {
      {"exponential", "constant"}};
  };

  /** Law of the radii of a set of joints; infinite: no rims. */
  enum class RadiusDistribution
  {
    infinite,
    constant,
    uniform,
    exponential,
    lognormal,
    power_law
  };
  template <>
  struct ChoiceNames<RadiusDistribution>
  {
    static constexpr std::array<const char *, 6> names = {{"infinite",
                                                           "constant",
                                                           "uniform",
                                                           "exponential",
                                                           "lognormal",
                                                           "power law"}};
  };

  /**
   * A plane of weakness: where it is and how strong it is. One that is bent or
   * kinked (its form is not plane) becomes a joint for each of its plane facets
   * before anything is made of it (make_facets()); the facets have its strength
   * and name it as their surface.
   */
  template <int dim>
  struct Joint : public JointStrength
  {
    std::string name;
    std::string set;    ///< name of the set it belongs to; empty: none
    std::string origin; ///< for messages: the row of the table; empty: entries
    unsigned int table_line = 0; ///< of the table's file; 0: from elsewhere
    Point<dim> point;
    std::vector<double> normal_entry;
    double dip           = 0.;
    double dip_direction = 90.;
    JointShape extent    = JointShape::infinite;
    double radius        = 0.;
    std::vector<Point<dim>> vertices;
    JointForm form = JointForm::plane;
    std::string file;           ///< of its triangles, faces or lines
    double scale          = 1.; ///< length of the file's unit [m]
    unsigned int segments = 24; ///< chords in half a circle of the file
    std::string group;          ///< physical group; empty: that of its name
    std::string surface;    ///< the joint of which it is a facet; empty: none
    unsigned int piece = 0; ///< of that, which do not hang together

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
    double bridging  = -1.; ///< [m]; negative: a share of the domain's size

    void declare(ParameterHandler &prm);
  };

  /** @param given `Joints/Bridging` [m], negative if it is not
   * @param side the domain's longest one [m] */
  inline double
  bridging_length(const double given, const double side)
  {
    return given < 0. ? 1e-5 * side : given;
  }

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
} // namespace Keyblock

#endif

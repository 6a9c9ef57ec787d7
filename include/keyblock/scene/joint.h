// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_h
#define keyblock_scene_joint_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/law/joint_strength.h>
#include <keyblock/scene/choices.h>

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
    Point<dim> point;
    std::vector<double> normal_entry;
    double dip           = 0.;
    double dip_direction = 90.;
    JointShape extent    = JointShape::infinite;
    double radius        = 0.;
    std::vector<Point<dim>> vertices;
    JointForm form = JointForm::plane;
    std::string file;           ///< of its triangles or lines
    double scale          = 1.; ///< length of the file's unit [m]
    unsigned int segments = 24; ///< chords in half a circle of the file
    std::string group;          ///< physical group; empty: that of its name
    std::string surface; ///< the joint of which it is a facet; empty: none

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
} // namespace Keyblock

#endif

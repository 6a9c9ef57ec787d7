// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_varied_strengths_h
#define keyblock_run_varied_strengths_h

#include <keyblock/scene/scene.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <memory>
#include <vector>

namespace Keyblock
{
  /**
   * The strengths of the joints of a scene, as the samples of a study change
   * them. Where all variables are strengths, of joints that they name or of
   * those that a pattern, a set or a bent joint means, samples differ in
   * nothing else, and are made by changing the joints in place.
   */
  template <int dim>
  class VariedStrengths
  {
  public:
    /** What reads the scene with these values of the variables. Throws
     * InputError (collective). */
    using Reader =
      std::function<void(const std::vector<double> &, Scene<dim> &)>;

    /**
     * Find the joints that each variable sets: those which the scene has other
     * strengths of where it is read with another value of the variable
     * (collective).
     * @param values by variable and sample
     */
    VariedStrengths(Scene<dim> &scene,
                    const std::vector<std::vector<double>> &values,
                    const Reader &read);

    /** Whether samples differ in strengths alone, all of which are found. */
    bool
    are_all() const
    {
      return !groups.empty();
    }

    /** Put the values of a sample into the joints. Throws InputError. */
    void set(const unsigned int sample) const;

    /** Put those of the scene back. */
    void reset() const;

  private:
    /** Joints of one strength, which the same variables change. */
    struct Group
    {
      JointStrength original, now;
      dealii::ParameterHandler prm; ///< has the entries of `now`
      std::vector<unsigned int> variables;
      std::vector<Joint<dim> *> joints;
    };

    using Joints = std::vector<std::unique_ptr<Joint<dim>>>;

    /** Find the groups, or none. */
    void find(const Reader &read);

    void add_to_group(Joint<dim> &joint,
                      const std::vector<unsigned int> &variables);

    /** Whether the present strengths are those of @p joints. */
    bool are_those_of(const Joints &joints) const;

    Scene<dim> &scene;
    const std::vector<std::vector<double>> &values;
    std::vector<std::unique_ptr<Group>> groups;
  };
} // namespace Keyblock

#endif

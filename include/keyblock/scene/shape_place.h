// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_shape_place_h
#define keyblock_scene_shape_place_h

#include <deal.II/base/bounding_box.h>

#include <keyblock/scene/scene.h>

#include <string>

namespace Keyblock
{
  /** Where a shape from a file is in the domain; throws InputError where that
   * is a sign of a wrong unit or origin. */
  template <int dim>
  class ShapePlace
  {
  public:
    /**
     * @param model whose shape is not `file`
     * @param box around the shape
     * @param has_shape begins the sentences: what has which kind of shape
     * @param section of the entries 'File' and 'Scale'
     */
    ShapePlace(const Domain<dim> &model,
               const dealii::BoundingBox<dim> &box,
               const std::string &has_shape,
               const std::string &section,
               const std::string &file);

    /** It is not as long as the domain along all axes. */
    void require_smaller() const;

    /** Its longest side is a hundredth of the domain's, or more. */
    void require_size() const;

    /** A part of it is in the domain, or, if it @p may_touch, on its outline.
     */
    void require_inside(const bool may_touch) const;

  private:
    void require_that(const bool condition, const std::string &fault) const;

    dealii::BoundingBox<dim> domain, shape;
    std::string beginning, remedy; ///< of sentences
  };
} // namespace Keyblock

#endif

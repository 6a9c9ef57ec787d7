// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_ground_h
#define keyblock_blocks_ground_h

#include <keyblock/base/expression.h>
#include <keyblock/blocks/interface.h>

namespace Keyblock
{
  /**
   * What is there at a stage: what has been excavated, filled and taken away,
   * and which faces are free. From the scene and the mesh alone.
   */
  template <int dim>
  struct Ground
  {
    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    unsigned int stage_number = 1; ///< Scene::stage_number

    /** Blocks that were taken away, by index; null or empty: none. */
    const std::vector<bool> *is_removed = nullptr;

    /** The same of the rock that limit equilibrium is asked of. */
    Ground<dim>
    rigid() const
    {
      return {scene, split.rigid(), stage_number, is_removed};
    }

    bool is_filled(const unsigned int cell) const;
    bool is_excavated(const unsigned int cell) const;

    /** Index into Scene::materials, that of the fill where it is filled. */
    unsigned int material_of(const unsigned int cell) const;

    /** The same as if nothing were filled. */
    unsigned int natural_material_of(const unsigned int cell) const;

  private:
    /** The last material that takes over the cell until now, from stage
     * @p since on, or @p material. */
    unsigned int last_material_of(const unsigned int cell,
                                  const unsigned int material,
                                  const unsigned int since) const;
  };

  /** Whether stage @p number excavates, fills, loads or changes anything. */
  template <int dim>
  bool is_changing(const Scene<dim> &scene, const unsigned int number);

  /** A face of a cell. */
  struct CellFace
  {
    unsigned int cell, face;
  };

  /** Faces of the rock beside which there is nothing: neither a cell nor the
   * other side of a joint. */
  template <int dim>
  std::vector<CellFace> list_free_faces(const Ground<dim> &ground);

  /** A face that a traction loads. */
  struct LoadedFace : CellFace
  {
    bool is_whole = true; ///< else where the traction's region is
  };

  /** Those of @p free that a traction of this stage loads, as its boundaries
   * or its region say. */
  template <int dim>
  std::vector<LoadedFace> list_loaded_faces(const Ground<dim> &ground,
                                            const std::vector<CellFace> &free,
                                            const Traction<dim> &traction);

  /** Where the region of a traction is on a face. */
  template <int dim>
  class LoadedRegion
  {
  public:
    explicit LoadedRegion(const Traction<dim> &traction);

    /** Whether the traction acts at @p place of a face with this @p center. It
     * is looked at a hair nearer to that: an edge of the region may lie on one
     * of faces. */
    bool has(const Point<dim> &center, const Point<dim> &place) const;

  private:
    const Expression<dim> inside;
  };
} // namespace Keyblock

#endif

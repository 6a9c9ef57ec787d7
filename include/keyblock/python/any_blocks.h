// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_python_any_blocks_h
#define keyblock_python_any_blocks_h

#include <keyblock/blocks/block_geometry.h>
#include <keyblock/python/any_scene.h>

#include <utility>

namespace Keyblock::Python
{
  /** Numbers with a shape, the last index fastest. */
  template <typename Number>
  struct Array
  {
    std::vector<std::size_t> shape;
    std::vector<Number> values;
  };

  /** One block as the module tells it. Lengths in m, weights in N; in 2D per
   * metre. */
  struct BlockRow
  {
    unsigned int id = 0;
    bool is_infinite, is_rigid, is_removable;
    unsigned int n_cells;
    double volume, mass, weight, size, width;
    double exact_volume, exact_weight; ///< not a number: not known
    std::vector<double> centroid;
    std::vector<std::string> classes; ///< at the start, and after each stage
    std::string exposed_in;           ///< name of a stage, start, or empty
    std::vector<std::pair<std::string, double>> joint_areas;
  };

  /** The surface of a block: faces on joints and free ones. */
  struct Surface
  {
    Array<double> vertices;          ///< [m]
    Array<int> faces;                ///< indices into them, seen from outside
                                     ///< anticlockwise
    std::vector<std::string> joints; ///< of each face; empty: free
  };

  /** What limit equilibrium says of a block at a stage. */
  struct Judgement
  {
    unsigned int block = 0; ///< id
    std::string stage;
    double factor       = 0.; ///< infinite: it cannot move
    double least_factor = 0.; ///< or when others that fail have gone
    std::string mode;
    double weight = 0., driving_force = 0.; ///< [N]
    std::vector<double> direction;          ///< of motion, or zero
    std::vector<std::pair<std::string, double>> normal_forces; ///< [N]
    std::vector<std::string> remarks;

    // of the wanted factor, if one was asked for
    double support_force = 0., support_pressure = 0.; ///< [N], [Pa]
    std::vector<std::pair<std::string, unsigned int>> bolts;
  };

  /** The blocks of a scene. */
  class AnyBlocks
  {
  public:
    virtual ~AnyBlocks() = default;

    /** Mesh the scene and find its blocks. Throws InputError.
     * @param is_verbose whether what takes a while is announced */
    static std::shared_ptr<const AnyBlocks>
    find(const std::shared_ptr<const AnyScene> &scene, const bool is_verbose);

    virtual std::vector<BlockRow> rows() const = 0;

    /** Of the block with this id. Throws InputError if there is none. */
    virtual Surface surface(const unsigned int id) const = 0;

    /**
     * Limit equilibrium of all blocks with a free face, at the start and after
     * each stage that changes anything, with strengths and loads of @p other;
     * null: of their own scene. Throws InputError if another entry of it is not
     * that of their own scene, but for leaves_geometry().
     * @param wanted factor to tell the support for; 0: none
     * @param time of the loads [s]
     */
    virtual std::vector<Judgement>
    judge(const std::shared_ptr<const AnyScene> &other,
          const double wanted,
          const double time) const = 0;

    virtual Array<double> vertices() const = 0; ///< of the split mesh [m]
    virtual Array<int> cells() const       = 0; ///< by their vertices

    /** Id of the block of each cell; 0: it is excavated. */
    virtual Array<int> block_of_cell() const = 0;

    /** Names of joints that got no face in the mesh (on rank 0). */
    virtual std::vector<std::string> lost_joints() const = 0;
  };

  template <int dim>
  class BlocksOf : public AnyBlocks
  {
  public:
    BlocksOf(const std::shared_ptr<const SceneOf<dim>> &scene,
             BlockGeometry<dim> geometry);

    std::vector<BlockRow> rows() const override;
    Surface surface(const unsigned int id) const override;
    std::vector<Judgement> judge(const std::shared_ptr<const AnyScene> &other,
                                 const double wanted,
                                 const double time) const override;
    Array<double> vertices() const override;
    Array<int> cells() const override;
    Array<int> block_of_cell() const override;
    std::vector<std::string> lost_joints() const override;

  private:
    std::shared_ptr<const SceneOf<dim>> source; ///< of the scene
    const Scene<dim> &scene;
    const BlockGeometry<dim> geometry;
    const Blocks<dim> &blocks;
    const SplitMesh<dim> &split;
  };
} // namespace Keyblock::Python

#endif

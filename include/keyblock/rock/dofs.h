// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_dofs_h
#define keyblock_rock_dofs_h

#include <keyblock/base/communicator.h>
#include <keyblock/blocks/interface.h>

#include <memory>

namespace dealii
{
  template <int, int>
  class DoFHandler;
  template <int, int>
  class Triangulation;
  namespace Utilities
  {
    namespace MPI
    {
      class Partitioner;
    }
  } // namespace Utilities
} // namespace dealii

namespace Keyblock
{
  /**
   * The distributed mesh and the numbering of its nodes. Cells are dealt to the
   * ranks as chunks of the Hilbert order, within which they are swept front by
   * front (mesh/cell_order.h). Node = dof / dim everywhere; on each
   * rank owned nodes come first, then ghosts: nodes of the rank's cells owned
   * elsewhere, and the other nodes of every interface group that has a node
   * here, so that each rank can solve all groups that touch its nodes.
   */
  template <int dim>
  class Numbering
  {
  public:
    /** Share the cells out to the ranks of @p communicator (collective). */
    Numbering(const Communicator &communicator,
              const Scene<dim> &scene,
              const SplitMesh<dim> &split);
    ~Numbering();

    unsigned int
    n_owned() const
    {
      return n_owned_nodes;
    }
    unsigned int
    n_local() const
    {
      return n_local_nodes;
    }
    unsigned int
    n_global() const
    {
      return n_global_nodes;
    }

    /** Cell of the split mesh that @p cell, an iterator of the triangulation,
     * points to. */
    template <typename CellIterator>
    unsigned int
    mesh_cell_of(const CellIterator &cell) const
    {
      return mesh_cell_of_coarse[cell->id().get_coarse_cell_id()];
    }

    /** Local index of a vertex of the split mesh, or `none` if not here. */
    unsigned int local_node(const unsigned int vertex) const;

    /** Local nodes of a cell of this rank, in the order of its vertices. */
    std::array<unsigned int, Mesh<dim>::n_cell_vertices>
    nodes_of_cell(const Mesh<dim> &mesh, const unsigned int cell) const
    {
      auto nodes = mesh.cells[cell];
      for (unsigned int &node : nodes)
        node = local_node(node);
      return nodes;
    }

    bool
    is_owned(const unsigned int vertex) const
    {
      const unsigned int node = local_node(vertex);
      return node != none && node < n_owned();
    }

    /** Add the values of @p field (dim per node) at hanging nodes to their
     * masters and clear them; before ghosts are added to owners. */
    void add_hanging_to_masters(std::vector<double> &field) const;

    /** Set @p field (dim per node) at hanging nodes to their masters' mean. */
    void interpolate_hanging(std::vector<double> &field) const;

    /** Add the ghosts' values of @p field (dim per node) to their owners and
     * clear them. */
    void add_ghosts_to_owners(std::vector<double> &field) const;

    /** Copy the owners' values of @p field (dim per node) to the ghosts. */
    void update_ghosts(std::vector<double> &field) const;

    const Communicator communicator;

    /** Deformable cells of this rank, as indices in the split mesh. */
    std::vector<unsigned int> mesh_cell;

    /** Vertex of the split mesh of each local node. */
    std::vector<unsigned int> vertex_of_node;

    /** Nodes that hang, each with a stretch of `masters`: first index, one
     * more entry than nodes. Masters of local hanging nodes are local. */
    struct Master
    {
      unsigned int node;
      double weight;
    };
    std::vector<unsigned int> hanging_nodes, masters_begin;
    std::vector<Master> masters;

    std::unique_ptr<dealii::Triangulation<dim, dim>> triangulation;
    std::unique_ptr<dealii::DoFHandler<dim, dim>> dof_handler;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

  private:
    void create_triangulation(const Scene<dim> &scene, const Mesh<dim> &mesh);

    /** Nodes of joints get the last numbers of their rank, in the order of the
     * loop over cells like the others: what contact works on stands together,
     * and so do the nodes that only cells move. */
    void put_interface_last(const SplitMesh<dim> &split);

    void create_numbering(const Scene<dim> &scene, const SplitMesh<dim> &split);

    void list_hanging_nodes(const SplitMesh<dim> &split);

    unsigned int n_owned_nodes = 0, n_local_nodes = 0, n_global_nodes = 0;
    std::vector<unsigned int> node_of_vertex;      ///< global numbers
    std::vector<unsigned int> mesh_cell_of_coarse; ///< by coarse cell

    mutable std::vector<double> exchange_buffer;
    mutable std::vector<MPI_Request> exchange_requests;
  };

  /** Call @p action(local node, weight) for the nodes of this rank that carry
   * what acts at a @p vertex. */
  template <int dim, typename Action>
  void
  for_each_owned_carrier(const SplitMesh<dim> &split,
                         const Numbering<dim> &numbering,
                         const unsigned int vertex,
                         const Action &action)
  {
    split.for_each_carrier(vertex,
                           [&](const unsigned int carrier,
                               const double weight) {
                             if (numbering.is_owned(carrier))
                               action(numbering.local_node(carrier), weight);
                           });
  }
} // namespace Keyblock

#endif

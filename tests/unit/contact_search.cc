// SPDX-License-Identifier: LGPL-2.1-or-later
// Which nodes meet which faces: not those that lie behind them, both sides of a
// kinked joint, and areas that add up to what lies on each other.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/contact/geometry.h>
#include <keyblock/contact/overlap.h>
#include <keyblock/contact/surface_places.h>
#include <keyblock/safety/slip_record.h>
#include <keyblock/scene/joint_extent.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

using namespace Keyblock;

namespace
{
  /** Everything up to the search, of a box of rock whose joints are given. */
  template <int dim>
  struct Set
  {
    Set(const std::string &name,
        const std::string &size,
        const std::string &joints,
        const double cell)
    {
      const std::string file =
        "contact_search_" + name + "_" + std::to_string(world.size()) + ".prm";
      if (world.is_root())
        std::ofstream(file)
          << "set Dimension = " << dim
          << "\nsubsection Domain\n set Size = " << size
          << "\n set Truncated boundaries = none\nend\n"
          << "subsection Mesh\n set Generator = gmsh\n set Size = " << cell
          << "\nend\nsubsection Materials\n set Names = rock\n subsection "
             "rock\n"
             "  set Young modulus = 1e9\n  set Density = 2000\n end\nend\n"
             "subsection Stages\n set Names = rest\n subsection rest\n"
             "  set Duration = 1\n end\nend\nsubsection Joints\n"
          << joints << "end\n";
      MPI_Barrier(world);
      scene.read(world, file, {});
      mesh    = make_mesh(world, scene, silent);
      blocks  = find_blocks(mesh, scene);
      split   = split_mesh(mesh, blocks, scene);
      surface = std::make_unique<ContactSurface<dim>>(split, blocks, scene);
      search  = std::make_unique<ContactSearch<dim>>(*surface);
      for (const Point<dim> &place : surface->place_of_node)
        for (unsigned int d = 0; d < dim; ++d)
          position.push_back(place[d]);
    }

    /** Contacts where nothing has moved, no pair standing for any. */
    std::vector<SurfaceContact<dim>>
    contacts() const
    {
      search->search(position, [](const unsigned int, const unsigned int) {
        return false;
      });
      std::vector<SurfaceContact<dim>> result;
      search->evaluate(position, 1e-6, 0., result);
      return result;
    }

    Scene<dim> scene;
    Mesh<dim> mesh;
    Blocks<dim> blocks;
    SplitMesh<dim> split;
    std::unique_ptr<ContactSurface<dim>> surface;
    std::unique_ptr<ContactSearch<dim>> search;
    std::vector<double> position;
  };

  /** Three planes through a point above a box's floor cut an acute block. */
  std::string
  acute_planes(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> dip(50., 75.), turn(-15., 15.);
    std::string text = " set Names = a, b, c\n";
    for (unsigned int j = 0; j < 3; ++j)
      text +=
        std::string(" subsection ") + "abc"[j] +
        "\n  set Point = 2, 2, 3\n  set Dip = " + std::to_string(dip(random)) +
        "\n  set Dip direction = " +
        std::to_string(60. + 120. * j + turn(random)) + "\n end\n";
    return text;
  }

  /** A plane, again 1 um above it, and two discs nearly along it: they have to
   * be cut into the mesh, which bends them, as it does where there are many
   * joints, here some outside. */
  std::string
  bent_joints(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> dip(20., 45.), turn(-20., 20.),
      bend(-12., 12.), shift(-0.3, 0.3);
    const double angle           = dip(random);
    const double toward          = 90. + turn(random);
    constexpr unsigned int n_far = 10;
    std::ostringstream text;
    // (nothing exact has cells for planes a hair apart that are not one)
    text << " set Bridging = 1e-9\n set Names = plane, again, one, two";
    for (unsigned int j = 0; j < n_far; ++j)
      text << ", far" << j;
    text << '\n';
    for (unsigned int j = 0; j < n_far; ++j)
      text << " subsection far" << j << "\n  set Point = " << 100 + j
           << ", 0, 0\n  set Dip = 0\n  set Extent = disc\n  set Radius = "
              "0.1\n end\n";
    for (unsigned int j = 0; j < 4; ++j)
      {
        const double x = j < 2 ? 2. : 1. + (j - 2) * 2.;
        text << " subsection "
             << std::array<const char *, 4>{{"plane", "again", "one", "two"}}[j]
             << "\n  set Dip = " << angle + (j < 2 ? 0. : bend(random))
             << "\n  set Dip direction = " << toward << "\n  set Point = " << x
             << ", 2, "
             << 2. - (x - 2.) * std::tan(angle * dealii::numbers::PI / 180.) +
                  (j == 1  ? 1e-5
                   : j > 1 ? shift(random)
                           : 0.)
             << (j < 2 ? "\n end\n"
                       : "\n  set Extent = disc\n  set Radius = 0.6\n end\n");
      }
    return text.str();
  }
} // namespace

BOOST_AUTO_TEST_SUITE(contact_search)

BOOST_AUTO_TEST_CASE(no_contact_through_rock)
{
  std::mt19937 random(7);
  for (unsigned int i = 0; i < 4; ++i)
    {
      const Set<3> set("acute", "4, 4, 4", acute_planes(random), 0.8);
      // there are nodes right behind joint faces of their own block
      unsigned int n_behind = 0, n_through = 0;
      for (unsigned int f = 0; f < set.surface->nodes_of_face.size(); ++f)
        {
          const SurfaceFace<3> &face = set.split.interface.surface[f];
          for (unsigned int node = 0; node < set.surface->n_nodes(); ++node)
            n_behind += face.joint != none &&
                        set.surface->block_of_node[node] == face.block &&
                        set.surface->start_distance(node, f) < -1e-2;
        }
      const auto contacts = set.contacts();
      for (const SurfaceContact<3> &contact : contacts)
        n_through += contact.point.gap < -2e-3;
      BOOST_TEST(n_behind > 100);
      BOOST_TEST(contacts.size() > 50);
      BOOST_TEST(n_through == 0);
    }
}

// A crack with a kink in one block: both sides belong to the block, and every
// node but the two ends meets the other side, also where a face of the other
// limb is in front of it or behind it.
BOOST_AUTO_TEST_CASE(kinked_joint_keeps_its_partners)
{
  for (const char *end : {"3, 2.2", "3, 1.1", "1.4, 2.4"})
    {
      const Set<2> set("kink",
                       "4, 3",
                       std::string(
                         " set Names = a, b\n subsection a\n  set "
                         "Extent = polygon\n  set Vertices = 1, 1; 2, "
                         "1.5\n end\n subsection b\n  set Extent = "
                         "polygon\n  set Vertices = 2, 1.5; ") +
                         end + "\n end\n",
                       0.2);
      BOOST_TEST(set.blocks.blocks.size() == 1);
      std::vector<unsigned int> n_contacts(set.surface->n_nodes(), 0);
      for (const SurfaceContact<2> &contact : set.contacts())
        {
          BOOST_TEST(std::abs(contact.point.gap) < 1e-6);
          ++n_contacts[contact.slave];
        }
      unsigned int n_on_joints = 0, n_alone = 0;
      for (const Pair<2> &pair : set.split.interface.pairs)
        for (const unsigned int v : {pair.minus, pair.plus})
          {
            ++n_on_joints;
            n_alone += n_contacts[set.surface->node_of_vertex[v]] == 0;
          }
      BOOST_TEST(n_on_joints > 10);
      // the node on the convex side of the kink may leave it to its partner
      BOOST_TEST(n_alone <= 2);
    }
}

BOOST_AUTO_TEST_CASE(overlaps_add_up)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.9, 0.9);
  const Set<3> set("floor",
                   "3, 2, 2",
                   " set Names = floor\n subsection floor\n  set Point = 0, 0, "
                   "1.1\n  set Dip = 0\n end\n",
                   0.5);
  BOOST_TEST_REQUIRE(set.blocks.blocks.size() == 2);
  for (unsigned int i = 0; i < 10; ++i)
    {
      const double x               = i == 0 ? 0. : shift(random);
      const double y               = i == 0 ? 0. : shift(random);
      std::vector<double> position = set.position;
      for (unsigned int node = 0; node < set.surface->n_nodes(); ++node)
        if (set.surface->block_of_node[node] == 1)
          {
            position[3 * node] += x;
            position[3 * node + 1] += y;
          }
      double area = 0., shares = 0.;
      for (const auto &overlap :
           list_overlaps<3>(*set.surface, position, {true}))
        {
          area += overlap.area;
          for (unsigned int k = 0; k < 4; ++k)
            shares += overlap.area *
                      (overlap.slave_weight[k] + overlap.master_weight[k]);
        }
      const double exact = (3. - std::abs(x)) * (2. - std::abs(y));
      BOOST_TEST(area == exact, boost::test_tools::tolerance(1e-9));
      BOOST_TEST(shares == 2. * exact, boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_CASE(overlap_is_found_and_measured)
{
  const Set<2> set("pressed",
                   "3, 2",
                   " set Names = floor\n subsection floor\n  set Point = 0, "
                   "1.1\n  set Dip = 0\n end\n",
                   0.3);
  const std::vector<bool> none_removed(2, false);
  BOOST_TEST(
    find_largest_overlap<2>(*set.search, set.position, none_removed).depth <
    1e-12);
  std::vector<double> position = set.position;
  for (unsigned int node = 0; node < set.surface->n_nodes(); ++node)
    {
      const Point<2> &place = set.surface->place_of_node[node];
      const bool is_upper =
        set.blocks.blocks[set.surface->block_of_node[node]].centroid[1] > 1.1;
      if (is_upper)
        position[2 * node + 1] -= 1e-3 * place[0];
    }
  const Overlap<2> overlap =
    find_largest_overlap<2>(*set.search, position, none_removed);
  BOOST_TEST(overlap.depth == 3e-3, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(overlap.place[0] == 3., boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(steady_slip_is_told_from_creep)
{
  const auto is_steady = [](const auto &way_after) {
    SlipRecord record;
    record.restart(1000);
    bool result = false;
    for (unsigned int step = 1100; step <= 20000; step += 100)
      if (record.offer(step, {0., way_after(step - 1000.)}))
        result = result || record.is_steady(1, 0.01, 0.75);
    BOOST_TEST(!record.is_steady(0, 0.01, 0.75));
    return result;
  };
  BOOST_TEST(is_steady([](const double n) { return 1e-4 * n; }));
  BOOST_TEST(is_steady([](const double n) { return 1e-8 * n * n; }));
  BOOST_TEST(!is_steady([](const double n) { return 1e-7 * n; })); // too short
  BOOST_TEST(!is_steady([](const double n) { return std::sqrt(n); }));
  BOOST_TEST(
    !is_steady([](const double n) { return 1. - std::exp(-n / 800.); }));
}

BOOST_AUTO_TEST_CASE(bent_joints_are_placed_in_their_planes)
{
  std::mt19937 random(11);
  unsigned int n_moved = 0, n_free_moved = 0;
  for (unsigned int i = 0; i < 6; ++i)
    {
      const Set<3> set("bent", "4, 4, 4", bent_joints(random), 0.9);
      const auto &surface = set.split.interface.surface;
      std::vector<std::vector<unsigned int>> faces_of_node(
        set.surface->n_nodes());
      for (unsigned int f = 0; f < surface.size(); ++f)
        for (const unsigned int node : set.surface->nodes_of_face[f])
          faces_of_node[node].push_back(f);
      const SurfacePlaces<3> places =
        place_in_joint_planes<3>(set.split.mesh,
                                 set.scene,
                                 surface,
                                 {set.surface->vertex_of_node,
                                  faces_of_node,
                                  set.surface->nodes_of_face});

      const JointExtent<3> plane(*set.scene.joints[0]);
      std::map<std::array<double, 3>, Point<3>> place_of_vertex;
      for (unsigned int node = 0; node < places.of_node.size(); ++node)
        {
          const Point<3> &vertex =
            set.split.mesh.vertices[set.surface->vertex_of_node[node]];
          bool is_on_plane = false, is_on_joint = false;
          for (const unsigned int f : faces_of_node[node])
            {
              is_on_plane = is_on_plane || surface[f].joint == 0;
              is_on_joint = is_on_joint || surface[f].joint != none;
            }
          const double moved = places.of_node[node].distance(vertex);
          n_moved += is_on_plane && moved > 1e-3;
          n_free_moved += !is_on_joint && moved > 1e-3;
          if (is_on_plane)
            BOOST_TEST(std::abs(plane.distance(places.of_node[node])) < 2e-4);
          // copies of a vertex stay together
          const auto entry = place_of_vertex.emplace(
            std::array<double, 3>{{vertex[0], vertex[1], vertex[2]}},
            places.of_node[node]);
          BOOST_TEST(entry.first->second.distance(places.of_node[node]) == 0.);
        }
      std::vector<double> at_vertices;
      for (const unsigned int v : set.surface->vertex_of_node)
        for (unsigned int d = 0; d < 3; ++d)
          at_vertices.push_back(set.split.mesh.vertices[v][d]);
      unsigned int n_flat = 0;
      for (unsigned int f = 0; f < surface.size(); ++f)
        {
          n_flat += places.is_flat[f];
          if (surface[f].joint == none && !places.is_flat[f])
            BOOST_TEST(dot<3>(set.surface->face_normal(at_vertices, f),
                              set.surface->face_normal(set.position, f)) > 0.5);
        }
      BOOST_TEST(n_flat < 0.05 * surface.size());
    }
  BOOST_TEST(n_moved > 0u);
  BOOST_TEST(n_free_moved > 0u);
}

BOOST_AUTO_TEST_SUITE_END()

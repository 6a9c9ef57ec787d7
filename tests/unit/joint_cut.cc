// SPDX-License-Identifier: LGPL-2.1-or-later
// Joints cut into a mesh: the cells stay right side out and fill the domain,
// surfaces stay where they are, sides and volumes are those of the planes.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/block_geometry.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/mesh/joint_cut.h>
#include <keyblock/run/simulation.h>
#include <keyblock/scene/near_misses.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

using namespace Keyblock;

namespace
{
  /** A cube or square of side 4 m of regular pieces, halves (2D) or sixths
   * (3D) of cells, its outer facets marked. */
  template <int dim>
  SimplexMesh<dim>
  block_of_simplices(const unsigned int n)
  {
    SimplexMesh<dim> mesh;
    for (unsigned int d = 0; d < dim; ++d)
      for (const double place : {0., 4.})
        {
          Surface<dim> side;
          side.point[d]  = place;
          side.normal[d] = 1.;
          mesh.surfaces.push_back(side);
        }
    const unsigned int n_layers = dim == 3 ? n : 0;
    const auto vertex = [n](unsigned int i, unsigned int j, unsigned int k) {
      return i + (n + 1) * (j + (n + 1) * k);
    };
    for (unsigned int k = 0; k <= n_layers; ++k)
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          {
            Point<dim> p;
            p[0]       = 4. * i / n;
            p[dim - 1] = 4. * k / n;
            p[1]       = 4. * j / n;
            mesh.add_vertex(p, 4. / n);
            unsigned int n_sides = 0;
            for (const unsigned int c : {i, j, k})
              n_sides += c == 0 || c == n;
            mesh.is_fixed.back() = n_sides == 3;
          }
    const auto add = [&mesh](typename SimplexMesh<dim>::CellVertices cell) {
      if (mesh.volume(cell) < 0.)
        std::swap(cell[0], cell[1]);
      mesh.add_cell(cell);
    };
    for (unsigned int k = 0; k < std::max(1u, n_layers); ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          if constexpr (dim == 2)
            {
              add({{vertex(i, j, 0),
                    vertex(i + 1, j, 0),
                    vertex(i + 1, j + 1, 0)}});
              add({{vertex(i, j, 0),
                    vertex(i + 1, j + 1, 0),
                    vertex(i, j + 1, 0)}});
            }
          else
            for (const auto &[a, b] :
                 std::vector<std::pair<unsigned int, unsigned int>>{
                   {1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
              {
                const auto corner = [&](const unsigned int c) {
                  return vertex(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
                };
                add({{corner(0), corner(7), corner(a), corner(b)}});
              }
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int i = 0; i <= dim; ++i)
        if (mesh.neighbor(c, i) == no_index)
          for (unsigned int s = 0; s < 2 * dim; ++s)
            {
              bool is_on = true;
              for (const unsigned int v : mesh.facet(c, i))
                is_on =
                  is_on &&
                  std::abs(mesh.surfaces[s].distance(mesh.vertices[v])) < 1e-12;
              if (is_on)
                mesh.add_mark(mesh.facet(c, i), {s, true});
            }
    return mesh;
  }

  /** A scene with @p n joints drawn from @p seed, in or across the block. */
  template <int dim>
  void
  add_joints(Scene<dim> &scene, const unsigned int n, const unsigned int seed)
  {
    std::mt19937 bits(seed);
    const auto draw = [&bits](const double low, const double high) {
      return low + (high - low) * (bits() / 4294967296.);
    };
    for (unsigned int j = 0; j < n; ++j)
      {
        auto joint  = std::make_unique<Joint<dim>>();
        joint->name = "j" + std::to_string(j);
        for (unsigned int d = 0; d < dim; ++d)
          {
            joint->point[d] = draw(0., 4.);
            joint->normal_entry.push_back(draw(-1., 1.));
          }
        joint->extent = j % 2 ? JointShape::disc : JointShape::infinite;
        joint->radius = draw(0.5, 2.);
        scene.joints.push_back(std::move(joint));
      }
  }

  /** Cells right side out that fill the block; each facet between two cells or
   * on the outside; vertices on the surfaces of the model they are bound to. */
  template <int dim>
  void
  check_mesh(const SimplexMesh<dim> &mesh)
  {
    double volume = 0., least = 1e300;
    std::map<typename SimplexMesh<dim>::Facet, unsigned int> n_cells;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.cells[c].is_alive)
        {
          volume += mesh.volume(mesh.cells[c].vertices);
          least = std::min(least, mesh.volume(mesh.cells[c].vertices));
          for (unsigned int i = 0; i <= dim; ++i)
            ++n_cells[mesh.facet(c, i)];
        }
    BOOST_TEST(least > 0.);
    BOOST_TEST(std::abs(volume / std::pow(4., dim) - 1.) < 1e-12);
    unsigned int n_wrong = 0;
    for (const auto &[facet, n] : n_cells)
      {
        bool is_outside  = false;
        const auto found = mesh.marks.find(facet);
        if (found != mesh.marks.end())
          for (const auto &mark : found->second)
            is_outside = is_outside || mark.surface < 2 * dim;
        n_wrong += n != (is_outside ? 1 : 2);
      }
    BOOST_TEST(n_wrong == 0);
    double off = 0.;
    for (const auto &[facet, list] : mesh.marks)
      {
        BOOST_TEST(n_cells.count(facet) == 1);
        for (const auto &mark : list)
          if (!mesh.surfaces[mark.surface].is_joint())
            for (const unsigned int v : facet)
              off = std::max(off,
                             std::abs(mesh.surfaces[mark.surface].distance(
                               mesh.vertices[v])));
      }
    BOOST_TEST(off < 1e-12);
  }

  template <int dim>
  void
  check_cut()
  {
    for (unsigned int seed = 1; seed <= 10; ++seed)
      {
        Scene<dim> scene;
        add_joints(scene, 3 + 2 * seed, seed);
        SimplexMesh<dim> mesh = block_of_simplices<dim>(dim == 2 ? 8 : 4);
        const auto report     = cut_joints(mesh, scene, 0.2, 1.);
        check_mesh(mesh);
        BOOST_TEST(report.largest_shift_in_cells < 0.6);
        double least = 1.;
        for (const auto &cell : mesh.cells)
          if (cell.is_alive)
            least = std::min(least, mesh.quality(cell.vertices));
        BOOST_TEST(least > 0.01);
        // sides: the cells beside a facet lie where its mark says, in the mean
        double right = 0., wrong = 0.;
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          for (unsigned int i = 0; i <= dim && mesh.cells[c].is_alive; ++i)
            {
              const auto found = mesh.marks.find(mesh.facet(c, i));
              if (found == mesh.marks.end())
                continue;
              for (const auto &mark : found->second)
                if (mesh.surfaces[mark.surface].is_joint())
                  {
                    const bool is_plus =
                      mesh.is_on_positive_side(c, i) == mark.plus_is_positive;
                    const double height = mesh.surfaces[mark.surface].distance(
                      mesh.vertices[mesh.cells[c].vertices[i]]);
                    (is_plus == (height > 0.) ? right : wrong) += 1.;
                  }
            }
        BOOST_TEST(right > 0.);
        BOOST_TEST(wrong <= 0.02 * right);
      }
  }

  template <int dim>
  std::string
  write_scene(const std::string &joints, const std::string &mesh)
  {
    const std::string name =
      "cut_" + std::to_string(dim) + "_" + std::to_string(world.size());
    if (world.is_root())
      std::ofstream(name + ".prm")
        << "set Dimension = " << dim << "\nsubsection Domain\n set Size = "
        << (dim == 2 ? "12, 12" : "12, 12, 12")
        << "\n set Truncated boundaries = left\nend\nsubsection Mesh\n set "
           "Generator = gmsh\n"
        << mesh << "end\nsubsection Materials\n set Names = rock\nend\n"
        << "subsection Output\n set Write VTU = false\nend\n"
        << joints;
    MPI_Barrier(world);
    return name;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(joint_cut)

BOOST_AUTO_TEST_CASE(mesh_stays_sound_2d)
{
  if (world.is_root()) // nothing here is shared
    check_cut<2>();
}

BOOST_AUTO_TEST_CASE(mesh_stays_sound_3d)
{
  if (world.is_root())
    check_cut<3>();
}

// Two planes a hair apart cannot be meshed exactly; the volumes are those of
// the planes, whatever was bent.
BOOST_AUTO_TEST_CASE(exact_volume_of_a_bent_block)
{
  const std::string name = write_scene<3>(
    "subsection Joints\n set Bridging = 1e-9\n set Names = a, b, c, near\n"
    " subsection a\n  set Point = 5.3, 0, 0\n  set Normal = 1, 0, 0\n end\n"
    " subsection b\n  set Point = 0, 6.1, 0\n  set Normal = 0, 1, 0.1\n end\n"
    " subsection c\n  set Point = 0, 0, 5.7\n  set Normal = 0, 0, 1\n end\n"
    " subsection near\n  set Point = 5.300001, 0, 0\n  set Normal = 1, 0, 0\n"
    " end\nend\n",
    " set Size = 1\n");
  Scene<3> scene;
  scene.read(world, name + ".prm", {});
  const BlockGeometry<3> made = make_block_geometry(world, scene, silent);
  const Blocks<3> &blocks     = made.blocks;
  if (world.is_root())
    {
      BOOST_TEST(made.report.way == "cut");
      BOOST_TEST(made.report.merged.size() == 1);
    }
  // right of near: y = 6.1 - z / 10 on plane b, z from 0 to 5.7 or on to 12
  const double width = 12. - 5.300001;
  const auto below   = [](const double from, const double to) {
    return 6.1 * (to - from) - 0.05 * (to * to - from * from);
  };
  const std::vector<double> volumes = {width * below(0., 5.7),
                                       width * below(5.7, 12.),
                                       width * (12. * 5.7 - below(0., 5.7)),
                                       width * (12. * 6.3 - below(5.7, 12.))};
  for (const double volume : volumes)
    {
      double nearest = 1e300;
      for (const auto &block : blocks.blocks)
        if (block.exact.is_known)
          nearest = std::min(nearest, std::abs(block.exact.volume - volume));
      BOOST_TEST(nearest < 1e-9 * volume);
    }
}

// A trace within a block is as long as it is, though it is met from both sides.
BOOST_AUTO_TEST_CASE(area_of_a_joint_that_ends_in_a_block)
{
  const std::string name = write_scene<2>(
    "subsection Joints\n set Names = a\n subsection a\n"
    "  set Extent = polygon\n  set Vertices = 3.1, 5.2; 9, 6.1\n end\nend\n",
    " set Size = 1\n");
  Scene<2> scene;
  scene.read(world, name + ".prm", {});
  const Mesh<2> mesh     = make_mesh(world, scene, silent);
  const Blocks<2> blocks = find_blocks(mesh, scene);
  BOOST_TEST(blocks.blocks.size() == 1);
  const double length = std::hypot(5.9, 0.9);
  BOOST_TEST(std::abs(blocks.blocks[0].joint_area.at(0) - length) <
             1e-9 * length);
}

namespace
{
  /** Blocks of a slanted joint across the domain, and of another one from the
   * top to a @p gap [m] above it. */
  template <int dim>
  void
  check_joint_that_ends_before_another(const double gap, const bool closes)
  {
    const std::string from = std::to_string(5.7 + gap);
    const std::string name = write_scene<dim>(
      "subsection Joints\n set Bridging = 1e-4\n set Names = a, b\n"
      " subsection a\n  set Point = 6, 6" +
        std::string(dim == 2 ? "" : ", 6") + "\n  set Normal = 0.3, " +
        (dim == 2 ? "1" : "0, 1") +
        "\n end\n subsection b\n  set Extent = polygon\n  set Vertices = " +
        (dim == 2
           ? "7, " + from + "; 7, 12"
           : "7, 0, " + from + "; 7, 12, " + from + "; 7, 12, 12; 7, 0, 12") +
        "\n end\nend\n",
      " set Size = 3\n set Snap = 0\n");
    Scene<dim> scene;
    scene.read(world, name + ".prm", {});
    const BlockGeometry<dim> made = make_block_geometry(world, scene, silent);
    unsigned int n_in_mesh = 0, n_between_planes = 0;
    for (const Block<dim> &block : made.blocks.blocks)
      {
        n_in_mesh += block.n_cells > 0;
        n_between_planes += block.exact.is_known || block.is_infinite;
      }
    const auto misses = list_near_misses(scene, 1e-4, 1e-3);
    BOOST_TEST_CONTEXT(dim << "D, gap of " << gap << " m")
    {
      BOOST_TEST(n_in_mesh == (closes ? 3 : 2));
      BOOST_TEST(n_between_planes == n_in_mesh);
      BOOST_TEST(misses.size() == (closes ? 0 : 1));
      for (const NearMiss &miss : misses)
        BOOST_TEST((miss.joint == 1 && miss.other == 0 &&
                    std::abs(miss.gap - gap) < 2e-6));
    }
  }
} // namespace

// The bridging is the same in the mesh and between the planes, also where
// joints are not moved.
BOOST_AUTO_TEST_CASE(joints_that_end_before_others)
{
  for (const auto &[gap, closes] :
       {std::make_pair(5e-5, true), std::make_pair(5e-4, false)})
    {
      check_joint_that_ends_before_another<2>(gap, closes);
      check_joint_that_ends_before_another<3>(gap, closes);
    }
}

// Halved cells have the joints and outlines of those they come from.
BOOST_AUTO_TEST_CASE(refined_cells_keep_joints)
{
  const std::string joint =
    "subsection Joints\n set Names = a\n subsection a\n  set Point = 6, 5.2\n"
    "  set Normal = 0.3, 1\n end\nend\n";
  const auto length_on_joint = [&joint](const std::string &mesh_entries) {
    const std::string name =
      write_scene<2>(joint, " set Size = 1\n" + mesh_entries);
    Scene<2> scene;
    scene.read(world, name + ".prm", {});
    const Mesh<2> mesh = make_mesh(world, scene, silent);
    BOOST_TEST(find_blocks(mesh, scene).blocks.size() == 2);
    double length = 0.;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < Mesh<2>::n_cell_faces; ++f)
        if (mesh.joint[c][f] != none)
          length += 0.5 * mesh.face_area_vector(c, f).norm();
    return length;
  };
  const double exact = 12. * std::sqrt(1. + 0.09);
  BOOST_TEST(length_on_joint("") == exact, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(length_on_joint(" set Refine at joints = 1, 0.4\n") == exact,
             boost::test_tools::tolerance(1e-9));
}

// A thin block between two parallel joints gets the cells it is to have across,
// while the corner of the model keeps its large ones.
BOOST_AUTO_TEST_CASE(thin_block_gets_cells_across)
{
  const std::string joints =
    "subsection Joints\n set Names = a, b, c, d\n"
    " subsection a\n  set Point = 6, 6\n  set Normal = 0, 1\n end\n"
    " subsection b\n  set Point = 6, 7.1\n  set Normal = 0, 1\n end\n"
    " subsection c\n  set Point = 5, 6\n  set Normal = 1, 0\n end\n"
    " subsection d\n  set Point = 9, 6\n  set Normal = 1, 0.2\n end\nend\n";
  const auto cells_across = [&joints](const std::string &entries,
                                      double &largest_cell) {
    const std::string name =
      write_scene<2>(joints,
                     " set Size = 2\n set Grading distance = 4\n" + entries);
    Scene<2> scene;
    scene.read(world, name + ".prm", {});
    std::unique_ptr<ExactBlocks<2>> exact;
    const auto [mesh, blocks] =
      make_mesh_for_blocks<2>(world, scene, exact, silent);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      largest_cell = std::max(largest_cell, mesh.cell_volume(c));
    for (const auto &block : blocks.blocks)
      if (!block.is_infinite && std::abs(block.width - 1.1) < 1e-9 &&
          block.centroid[0] > 5. && block.centroid[0] < 9.)
        return block.cells_across();
    return 0.;
  };
  double before = 0., after = 0.;
  const double few = cells_across("", before);
  BOOST_TEST(few > 0.);
  BOOST_TEST(few < 4.);
  BOOST_TEST(
    cells_across(" set Cells across blocks = 5\n set Least size = 0.1\n",
                 after) >= 5.);
  BOOST_TEST(after > 0.5 * before);
}

// Where two joints share faces the weaker rules, whichever comes first.
BOOST_AUTO_TEST_CASE(weaker_joint_rules)
{
  for (const unsigned int weak : {0u, 1u})
    {
      std::ostringstream joints;
      joints << "subsection Joints\n set Names = a, b\n";
      for (const unsigned int j : {0u, 1u})
        joints << " subsection " << (j ? "b" : "a") << "\n  set Point = 5, "
               << (j ? 5.00001 : 5.)
               << "\n  set Normal = 0.2, 1\n  set Friction angle = "
               << (j == weak ? 20 : 35) << "\n end\n";
      const std::string name =
        write_scene<2>(joints.str() + "end\n", " set Size = 1\n");
      Scene<2> scene;
      scene.read(world, name + ".prm", {});
      const Mesh<2> mesh   = make_mesh(world, scene, silent);
      unsigned int n_faces = 0;
      for (const auto &faces : mesh.joint)
        for (const unsigned int joint : faces)
          if (joint != none)
            {
              ++n_faces;
              BOOST_TEST(joint == weak);
            }
      BOOST_TEST(n_faces > 10);
    }
}

// The mesh is the same on any number of ranks and every time.
BOOST_AUTO_TEST_CASE(network_is_meshed_on_all_ranks_alike)
{
  std::ostringstream joints;
  joints << "subsection Joints\n set Names = ";
  for (unsigned int j = 0; j < 30; ++j)
    joints << (j ? ", j" : "j") << j;
  joints << "\n";
  std::mt19937 bits(7);
  for (unsigned int j = 0; j < 30; ++j)
    {
      joints << " subsection j" << j << "\n  set Extent = disc\n  set Point = "
             << 12. * (bits() / 4294967296.) << ", "
             << 12. * (bits() / 4294967296.)
             << "\n  set Dip = " << 90. * (bits() / 4294967296.)
             << "\n  set Radius = " << 1. + 3. * (bits() / 4294967296.)
             << "\n end\n";
    }
  joints << "end\n";
  const std::string name =
    write_scene<2>(joints.str(), " set Size = 0.5\n set Snap = 0.2\n");
  Scene<2> scene;
  scene.read(world, name + ".prm", {});
  const Mesh<2> first  = make_mesh(world, scene, silent),
                second = make_mesh(world, scene, silent);
  BOOST_TEST(first.n_cells() > 500);
  BOOST_TEST((first.cells == second.cells));
  BOOST_TEST((first.vertices == second.vertices));
  BOOST_TEST((first.side == second.side));
  double checksum = 0.;
  for (unsigned int v = 0; v < first.vertices.size(); ++v)
    checksum += (v + 1.) * (first.vertices[v][0] + 2. * first.vertices[v][1]);
  BOOST_TEST(world.max(checksum) == world.min(checksum));
}

namespace
{
  /** What planes make of the cube or square of side 12 m, by points in it. */
  template <int dim>
  struct Arrangement
  {
    struct Region
    {
      double volume = 0., inradius = 0.; ///< [m^dim, m]
    };
    using Code = std::vector<signed char>;
    std::map<Code, Region> regions;

    Arrangement(const std::vector<std::unique_ptr<Joint<dim>>> &planes,
                const unsigned int n_planes,
                const unsigned int n_points)
    {
      const double spacing        = 12. / n_points;
      const unsigned int n_layers = dim == 3 ? n_points : 1;
      for (unsigned int k = 0; k < n_layers; ++k)
        for (unsigned int j = 0; j < n_points; ++j)
          for (unsigned int i = 0; i < n_points; ++i)
            {
              Point<dim> p;
              p[0]       = (i + 0.5) * spacing;
              p[dim - 1] = (k + 0.5) * spacing;
              p[1]       = (j + 0.5) * spacing;
              double gap = 12.;
              for (unsigned int d = 0; d < dim; ++d)
                gap = std::min({gap, p[d], 12. - p[d]});
              Code code;
              for (unsigned int q = 0; q < n_planes; ++q)
                {
                  const double distance = planes[q]->distance(p);
                  code.push_back(distance > 0. ? 1 : -1);
                  gap = std::min(gap, std::abs(distance));
                }
              Region &region = regions[code];
              region.volume += std::pow(spacing, dim);
              region.inradius = std::max(region.inradius, gap);
            }
    }
  };

  /** Cut random planes into a mesh: regions of at least a simplex and three
   * snaps are blocks, and no block of a fifth of a simplex is none. */
  template <int dim>
  void
  check_arrangement(const unsigned int seed, const unsigned int n_planes)
  {
    constexpr double size = dim == 2 ? 0.4 : 0.6, snap = 0.2;
    const double edge    = (dim == 2 ? 2.6 : 3.) * size,
                 simplex = (dim == 2 ? 0.433 : 0.1179) * std::pow(edge, dim);
    std::mt19937 bits(seed);
    const auto random = [&bits](const double low, const double high) {
      return low + (high - low) * (bits() / 4294967296.);
    };
    std::ostringstream names, joints;
    for (unsigned int j = 0; j < n_planes; ++j)
      {
        names << "j" << j << ", ";
        std::ostringstream place, near, normal;
        place.precision(12);
        near.precision(12);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double x = random(2.5, 9.5);
            place << (d ? ", " : "") << x;
            near << (d ? ", " : "") << x + 1e-5;
            normal << (d ? ", " : "") << random(-1., 1.);
          }
        joints << " subsection j" << j << "\n  set Point = " << place.str()
               << "\n  set Normal = " << normal.str() << "\n end\n";
        if (j == 0) // once more a hair away: now nothing can be exact
          joints << " subsection near\n  set Point = " << near.str()
                 << "\n  set Normal = " << normal.str() << "\n end\n";
      }
    std::ostringstream mesh_entries;
    mesh_entries << " set Size = " << size << "\n set Snap = " << snap << "\n";
    const std::string name = write_scene<dim>(
      "subsection Joints\n set Bridging = 1e-9\n set Names = " + names.str() +
        "near\n" + joints.str() + "end\n",
      mesh_entries.str());
    Scene<dim> scene;
    scene.read(world, name + ".prm", {});
    const Mesh<dim> mesh     = make_mesh(world, scene, silent);
    const Blocks<dim> blocks = find_blocks(mesh, scene);
    if (world.is_root())
      BOOST_REQUIRE(mesh.report.way == "cut");
    const Arrangement<dim> exact(scene.joints, n_planes, dim == 2 ? 500 : 80);

    using Code      = typename Arrangement<dim>::Code;
    const auto code = sign_code(mesh, scene);
    std::vector<std::map<Code, double>> volume(blocks.blocks.size());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      volume[blocks.block_of_cell[c]]
            [Code(code[c].begin(), code[c].begin() + n_planes)] +=
        mesh.cell_volume(c);
    std::map<Code, unsigned int> n_blocks;
    for (unsigned int b = 0; b < volume.size(); ++b)
      {
        const auto largest = std::max_element(volume[b].begin(),
                                              volume[b].end(),
                                              [](const auto &x, const auto &y) {
                                                return x.second < y.second;
                                              });
        // where thin blocks are bent, the side of a face tells more
        Code known = largest->first;
        for (const auto &[joint, side] : blocks.blocks[b].joint_side)
          if (joint < n_planes)
            known[joint] = side;
        const bool exists = exact.regions.count(known) > 0;
        ++n_blocks[known];
        if (blocks.blocks[b].volume > 0.2 * simplex)
          BOOST_TEST(exists,
                     "seed " << seed << ": a block of "
                             << blocks.blocks[b].volume << " at "
                             << blocks.blocks[b].centroid << " is none");
      }
    unsigned int n_wanted = 0;
    for (const auto &[region_code, region] : exact.regions)
      if (region.volume > simplex && 2. * region.inradius > 3. * snap * edge)
        {
          ++n_wanted;
          // two: its ends, where it is too thin in the middle
          BOOST_TEST(n_blocks[region_code] >= 1,
                     "seed " << seed << ": no block where a region of "
                             << region.volume << " with an inradius of "
                             << region.inradius << " is");
        }
    BOOST_TEST(n_wanted > n_planes);
    BOOST_TEST_MESSAGE("seed " << seed << ": " << n_wanted << " of "
                               << exact.regions.size()
                               << " regions are large enough, "
                               << blocks.blocks.size() << " blocks");
  }
} // namespace

BOOST_AUTO_TEST_CASE(random_lines_make_their_blocks)
{
  for (unsigned int seed = 1; seed <= 10; ++seed)
    check_arrangement<2>(seed, 4 + seed);
}

BOOST_AUTO_TEST_CASE(random_planes_make_their_blocks)
{
  for (unsigned int seed = 1; seed <= 5; ++seed)
    check_arrangement<3>(seed, 2 + seed);
}

BOOST_AUTO_TEST_SUITE_END()

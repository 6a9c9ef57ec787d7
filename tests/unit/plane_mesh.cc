// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks between planes as a mesh: surfaces, volumes and masses, and joints of
// sets that are drawn anew.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/free_faces.h>
#include <keyblock/blocks/plane_mesh.h>
#include <keyblock/blocks/plane_scene.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <random>

BOOST_AUTO_TEST_SUITE(plane_mesh)

using namespace Keyblock;

namespace
{
  template <int dim>
  void
  read(Scene<dim> &scene,
       const std::string &text,
       const std::vector<std::string> &overrides = {})
  {
    const std::string file =
      "plane_mesh_" + std::to_string(world.size()) + ".prm";
    MPI_Barrier(world);
    if (world.is_root())
      std::ofstream(file) << "set Dimension = " << dim << '\n' << text;
    MPI_Barrier(world);
    scene.read(world, file, overrides);
  }

  const std::string mesh = "subsection Mesh\n set Generator = gmsh\n set Size "
                           "= 4\nend\n";

  /** A tunnel that is dug in two parts, the first before the first stage. */
  template <int dim>
  std::string
  tunnel()
  {
    const std::string part =
      dim == 3 ? "  set Shape = extruded polygon\n  set From = -30\n  set To = "
                 "30\n"
               : "";
    return "subsection Domain\n set Corner = " +
           std::string(dim == 2 ? "-30, -30" : "-30, -30, -30") +
           "\n set Size = " + std::string(dim == 2 ? "60, 60" : "60, 60, 60") +
           "\n set Truncated boundaries = all\nend\n"
           "subsection Excavations\n set Names = left, right\n"
           " subsection left\n" +
           part +
           "  set Vertices = -5, -4; 0, -4; 0, 4; -5, 4\n end\n"
           " subsection right\n" +
           part +
           "  set Vertices = 0, -4; 6, -4; 6, 3; 0, 4\n"
           "  set Stage = dig\n end\nend\n"
           "subsection Stages\n set Names = dig\n subsection dig\n"
           "  set Kind = quasi-static\n end\nend\n";
  }

  /** Joints of some extent that a generator draws. */
  template <int dim>
  std::string
  network(const unsigned int seed, const unsigned int n)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1., 1.);
    std::string names, text;
    for (unsigned int j = 0; j < n; ++j)
      {
        const std::string name = "j" + std::to_string(j);
        names += (j ? ", " : "") + name;
        const auto triple = [&](const double size) {
          std::string list;
          for (unsigned int d = 0; d < dim; ++d)
            list += (d ? ", " : "") + std::to_string(size * unit(random));
          return list;
        };
        text += " subsection " + name + "\n  set Point = " + triple(12.) +
                "\n  set Normal = " + triple(1.) + "\n";
        if (j % 3 > 0)
          text += "  set Extent = disc\n  set Radius = " +
                  std::to_string(14. + 8. * unit(random)) + "\n";
        text += " end\n";
      }
    return "subsection Joints\n set Names = " + names + '\n' + text + "end\n";
  }

  template <int dim>
  struct Made
  {
    explicit Made(const std::string &text)
    {
      read(scene, text + mesh);
      list   = std::get<PlaneScene<dim>>(list_planes(scene));
      planes = std::make_unique<PlaneBlocks<dim>>(
        find_plane_blocks(list, plane_block_options(list)));
      split  = make_plane_mesh(*planes, scene);
      blocks = list_plane_blocks(*planes, scene, split);
    }

    Scene<dim> scene;
    PlaneScene<dim> list;
    std::unique_ptr<PlaneBlocks<dim>> planes;
    SplitMesh<dim> split;
    Blocks<dim> blocks;
  };

  template <int dim>
  void
  check_measures(const unsigned int seed)
  {
    const Made<dim> made(tunnel<dim>() + network<dim>(seed, 6 * dim));
    const auto &blocks          = made.blocks.blocks;
    const auto &planes          = *made.planes;
    const Mesh<dim> &all        = made.split.mesh;
    constexpr unsigned int base = 2 * (dim - 1);
    std::vector<double> volumes(blocks.size(), 0.);
    std::vector<Tensor<1, dim>> closed(blocks.size());
    for (unsigned int c = 0; c < all.n_cells(); ++c)
      {
        BOOST_TEST_REQUIRE(all.cell_volume(c) >= -1e-12);
        const unsigned int b = made.split.block_of_cell[c];
        if (b == none)
          continue;
        volumes[b] += all.cell_volume(c);
        closed[b] += all.face_area_vector(c, base);
      }
    const Ground<dim> ground{made.scene, made.split, 2, nullptr};
    const FreeFaces<dim> free(ground);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        const double size = std::pow(blocks[b].volume, (dim - 1.) / dim);
        BOOST_TEST(std::abs(volumes[b] / blocks[b].volume - 1.) < 1e-11);
        BOOST_TEST(closed[b].norm() < 1e-9 * size);
        if (blocks[b].is_infinite)
          continue;
        double joints = 0., bare = 0., exact_joints = 0., exact_bare = 0.;
        for (const unsigned int i : free.joint_faces_of_block(b))
          {
            const JointFace &f = made.split.interface.joint_faces[i];
            // (a joint that ends in the block has it on both sides)
            if (ground.is_excavated(f.minus_cell) ||
                ground.is_excavated(f.plus_cell) ||
                made.split.block_of_cell[f.minus_cell] ==
                  made.split.block_of_cell[f.plus_cell])
              continue;
            joints += all.face_area_vector(f.minus_cell, f.minus_face).norm();
            // the joint lies between its sides
            const Point<dim> center =
              all.face_center(f.minus_cell, f.minus_face);
            const Tensor<1, dim> out =
              all.face_area_vector(f.minus_cell, f.minus_face);
            const Joint<dim> &joint = *made.scene.joints[f.joint];
            BOOST_TEST(std::abs(joint.distance(center)) < 1e-9);
            BOOST_TEST(out * joint.normal() > 0.99 * out.norm());
          }
        for (const unsigned int i : free.of_block(b))
          bare +=
            all.face_area_vector(free.faces[i].cell, free.faces[i].face).norm();
        for (const auto &face : planes.faces[b])
          exact_joints += face.area;
        for (const auto &face : planes.free_faces[b])
          exact_bare += face.area;
        BOOST_TEST(std::abs(joints - exact_joints) < 1e-3 * size);
        BOOST_TEST(std::abs(bare - exact_bare) < 1e-3 * size);
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(surfaces_and_volumes_2d)
{
  for (const unsigned int seed : {1, 2, 3, 4})
    check_measures<2>(seed);
}

BOOST_AUTO_TEST_CASE(surfaces_and_volumes_3d)
{
  for (const unsigned int seed : {1, 2})
    check_measures<3>(seed);
}

// Half of a triangle is of a heavy rock, whose region no joint follows.
BOOST_AUTO_TEST_CASE(mass_of_two_materials)
{
  const Made<2> made(
    "subsection Domain\n set Corner = -4, 0\n set Size = 8, 8\n"
    " set Truncated boundaries = left, right, top\nend\n"
    "subsection Joints\n set Names = a, b\n"
    " subsection a\n  set Point = 0, 3\n  set Normal = -1, 1\n end\n"
    " subsection b\n  set Point = 0, 3\n  set Normal = 1, 1\n end\nend\n"
    "subsection Materials\n set Names = light, heavy\n"
    " subsection light\n  set Density = 2000\n end\n"
    " subsection heavy\n  set Density = 3000\n  set Region = x - 0.3\n end\n"
    "end\n");
  BOOST_TEST_REQUIRE(made.blocks.blocks.size() > 0);
  const Block<2> &block = made.blocks.blocks[0];
  BOOST_TEST(!block.is_infinite);
  BOOST_TEST(std::abs(block.volume - 9.) < 1e-12);
  const double heavy = 0.5 * 2.7 * 2.7;
  BOOST_TEST(std::abs(block.mass / (2000. * 9. + 1000. * heavy) - 1.) < 1e-4);
}

// Joints of a set with another seed are those of a scene that is read with it.
BOOST_AUTO_TEST_CASE(joints_drawn_anew)
{
  const std::string text =
    tunnel<3>() + mesh +
    "subsection Joint sets\n set Names = a, b\n subsection a\n  set Dip = 50\n"
    "  set Concentration = 30\n  set Radius law = lognormal\n"
    "  set Radius mean = 5\n  set Radius deviation = 2\n  set P32 = 0.01\n"
    " end\n subsection b\n  set Dip = 20\n  set Spacing = 9\n end\nend\n"
    "subsection Joints\n set Names = own\n subsection own\n"
    "  set Point = 0, 0, 9\n  set Dip = 12\n end\nend\n";
  Scene<3> scene;
  read(scene, text);
  for (const unsigned int seed : {7, 8})
    {
      const std::vector<std::string> overrides = {
        "Joint sets/a/Seed=" + std::to_string(seed),
        "Joint sets/*/Friction angle=" + std::to_string(20 + seed)};
      scene.redraw(world, overrides);
      Scene<3> other;
      read(other, text, overrides);
      BOOST_TEST_REQUIRE(scene.joints.size() == other.joints.size());
      for (unsigned int j = 0; j < other.joints.size(); ++j)
        {
          const Joint<3> &a = *scene.joints[j], &b = *other.joints[j];
          BOOST_TEST(a.name == b.name);
          BOOST_TEST(a.point == b.point);
          BOOST_TEST(a.normal() == b.normal());
          BOOST_TEST(a.radius == b.radius);
          BOOST_TEST(a.friction_angle == b.friction_angle);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()

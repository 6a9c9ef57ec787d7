// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks between planes without a mesh: known volumes, random networks, and
// walks that know nothing of cells.
#include "random_tensor.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/plane_blocks.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

BOOST_AUTO_TEST_SUITE(plane_blocks)

using namespace Keyblock;

namespace
{
  constexpr double radian = dealii::numbers::PI / 180.;

  template <int dim>
  using Piece = JointPiece<dim>;

  /** The domain is a box with rock behind all sides. */
  template <int dim>
  PlaneScene<dim>
  scene_in_box(const Point<dim> &low, const Point<dim> &high)
  {
    PlaneScene<dim> scene;
    scene.box = BoundingBox<dim>({low, high});
    scene.is_truncated.assign(2 * dim, true);
    return scene;
  }

  template <int dim>
  ExcavationPiece<dim>
  box_excavation(const unsigned int index,
                 const unsigned int stage,
                 const Point<dim> &low,
                 const Point<dim> &high)
  {
    ExcavationPiece<dim> piece;
    piece.excavation = index;
    piece.stage      = stage;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Point<dim> axis = Point<dim>::unit_vector(d);
        piece.sides.push_back({low, -axis});
        piece.sides.push_back({high, axis});
      }
    return piece;
  }

  template <int dim>
  Piece<dim>
  plane_joint(const unsigned int joint,
              const Point<dim> &point,
              const Tensor<1, dim> &normal)
  {
    Piece<dim> piece;
    piece.joint  = joint;
    piece.point  = point;
    piece.normal = normal;
    return piece;
  }

  template <int dim>
  Piece<dim>
  disc_joint(const unsigned int joint,
             const Point<dim> &point,
             const Tensor<1, dim> &normal,
             const double radius)
  {
    Piece<dim> piece = plane_joint(joint, point, normal);
    piece.shape      = Piece<dim>::Shape::disc;
    piece.radius     = radius;
    return piece;
  }

  /** @param corners on a plane, of which the first three define it */
  template <int dim>
  Piece<dim>
  polygon_joint(const unsigned int joint,
                const std::vector<Point<dim>> &corners)
  {
    Tensor<1, dim> normal;
    if constexpr (dim == 2)
      normal = -cross_product_2d(corners[1] - corners[0]);
    else
      normal =
        cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
    Piece<dim> piece = plane_joint(joint, corners[0], normal);
    piece.shape      = Piece<dim>::Shape::polygon;
    piece.corners    = corners;
    return piece;
  }

  template <int dim>
  PlaneBlocks<dim>
  find(const PlaneScene<dim> &scene, const PlaneBlockOptions &options = {})
  {
    return find_plane_blocks(scene, options);
  }

  template <int dim>
  std::vector<Block<dim>>
  finite_blocks(const PlaneBlocks<dim> &found)
  {
    std::vector<Block<dim>> blocks;
    for (const auto &block : found.blocks)
      if (!block.is_infinite)
        blocks.push_back(block);
    return blocks;
  }

  /** Volumes fill the domain; faces of both sides agree; the surface of a
   * finite block is closed, and gives its volume. */
  template <int dim>
  void
  check(const PlaneBlocks<dim> &found,
        const double volume,
        const double narrow = 0.)
  {
    double sum = 0.;
    for (const auto &block : found.blocks)
      sum += block.volume;
    for (unsigned int c = 0; c < found.cells.n_cells(); ++c)
      if (found.excavation_of_cell[c] != found.nothing)
        {
          sum += found.cells.measures(c).volume;
          BOOST_TEST_REQUIRE(found.block_of_cell[c] == found.nothing);
        }
    BOOST_TEST_REQUIRE(std::abs(sum - volume) <= 1e-14 * volume);
    // area vectors of (joint, lower block, higher block), seen from both
    std::map<std::array<unsigned int, 3>, Tensor<1, dim>> difference;
    for (unsigned int b = 0; b < found.blocks.size(); ++b)
      {
        Tensor<1, dim> closing;
        double surface = 0., volume_inside = 0.;
        const Point<dim> center = found.blocks[b].centroid;
        const auto add          = [&](const double area,
                             const Tensor<1, dim> &normal,
                             const Point<dim> &corner) {
          closing += area * normal;
          surface += area;
          volume_inside -= area * (normal * (corner - center)) / dim;
        };
        for (const auto &face : found.faces[b])
          {
            BOOST_TEST_REQUIRE(face.neighbour != b);
            difference[{{face.joint,
                         std::min(b, face.neighbour),
                         std::max(b, face.neighbour)}}] +=
              face.area * face.normal;
            add(face.area, face.normal, face.outlines[0][0]);
          }
        for (const auto &face : found.free_faces[b])
          add(face.area, face.normal, face.outline[0]);
        const auto &block = found.blocks[b];
        if (block.is_infinite)
          continue;
        const double openings = 4. * narrow * (dim == 2 ? 1. : block.size);
        BOOST_TEST_REQUIRE(closing.norm() <= openings + 1e-12);
        BOOST_TEST_REQUIRE(std::abs(volume_inside - block.volume) <=
                           openings * block.size + 1e-11);
      }
    for (const auto &[key, area] : difference)
      BOOST_TEST_REQUIRE(area.norm() <= 1e-11);
  }

  template <int dim>
  bool
  is_exposed(const Block<dim> &block)
  {
    return block.exposed_stage != Keyblock::none && !block.is_infinite;
  }

  /** Exposed (or all) blocks have the same volumes, places and areas. */
  template <int dim>
  void
  compare(const PlaneBlocks<dim> &a, const PlaneBlocks<dim> &b, const bool all)
  {
    const auto list = [all](const PlaneBlocks<dim> &found) {
      std::vector<Block<dim>> blocks;
      for (const auto &block : found.blocks)
        if (all || is_exposed(block))
          blocks.push_back(block);
      return blocks;
    };
    const auto p = list(a), q = list(b);
    BOOST_TEST_REQUIRE(p.size() == q.size());
    for (unsigned int i = 0; i < p.size(); ++i)
      {
        BOOST_TEST_REQUIRE(std::abs(p[i].volume - q[i].volume) <= 1e-10);
        BOOST_TEST_REQUIRE(
          p[i].centroid.distance(q[i].centroid) * p[i].volume <= 1e-9);
        BOOST_TEST_REQUIRE((p[i].class_of_stage == q[i].class_of_stage));
        BOOST_TEST_REQUIRE(p[i].joint_area.size() == q[i].joint_area.size());
        for (const auto &[joint, area] : p[i].joint_area)
          BOOST_TEST_REQUIRE(std::abs(area - q[i].joint_area.at(joint)) <=
                             1e-10);
      }
  }
} // namespace



// prm/tutorial/joint_network.prm
BOOST_AUTO_TEST_CASE(joint_network)
{
  auto scene = scene_in_box<2>({-10., -10.}, {10., 10.});
  scene.excavations.push_back(box_excavation<2>(0, 1, {-2., -2.}, {2., 2.}));
  const auto add = [&](const double x,
                       const double y,
                       const double dip,
                       const double way) {
    scene.joints.push_back(plane_joint<2>(scene.joints.size(),
                                          {x - 694200., y - 5391000.},
                                          Point<2>(way * std::sin(dip * radian),
                                                   std::cos(dip * radian))));
  };
  // (in the coordinates of the mine's grid, as far as doubles hold them)
  add(694199.2, 5391003.1, 62.5, 1.);
  add(694201., 5391003.4, 55., -1.);
  add(694197.5240211703, 5390990.75952121, 15., 1.);
  add(694198.4023006158, 5390994.037304723, 15., 1.);
  add(694199.9546934239, 5390999.830913557, 15., 1.);
  add(694200.9850110181, 5391003.676111165, 15., 1.);
  add(694202.0959878449, 5391007.822333129, 15., 1.);
  const auto found = find(scene);
  check(found, 400.);
  const auto finite = finite_blocks(found);
  BOOST_TEST_REQUIRE(finite.size() == 3u);
  BOOST_TEST(std::abs(finite[0].volume - 31.360461139) < 2e-9);
  BOOST_TEST(std::abs(finite[1].volume - 23.3416) < 1e-4);
  BOOST_TEST(std::abs(finite[2].volume - 2.801) < 1e-3);
  using Classes = std::vector<BlockClass>;
  BOOST_TEST((finite[0].class_of_stage ==
              Classes{BlockClass::attached, BlockClass::exposed}));
  BOOST_TEST((finite[1].class_of_stage ==
              Classes{BlockClass::hidden, BlockClass::hidden}));
  BOOST_TEST((finite[2].class_of_stage ==
              Classes{BlockClass::attached, BlockClass::exposed}));
  BOOST_TEST(finite[0].exposed_stage == 1u);
  BOOST_TEST(!finite[0].is_removable);
}

// prm/verification/kinked_joint.prm
BOOST_AUTO_TEST_CASE(kinked_joint)
{
  auto scene            = scene_in_box<2>({0., 0.}, {20., 14.});
  scene.is_truncated[3] = false;
  scene.excavations.push_back(box_excavation<2>(0, 0, {10., 2.}, {20., 14.}));
  const Point<2> a(12., 2.59958492358058), b(6., 6.80083015283884),
    c(4.2, 15.4398339694322);
  scene.joints = {polygon_joint<2>(0, {a, b}), polygon_joint<2>(0, {b, c})};
  for (const bool leave_out : {false, true})
    {
      PlaneBlockOptions options;
      options.leave_out = leave_out;
      const auto found  = find(scene, options);
      check(found, 280.);
      BOOST_TEST_REQUIRE(found.blocks.size() == 2u);
      const auto &block = found.blocks[0];
      BOOST_TEST(std::abs(block.volume - 39.797717080) < 2e-9);
      BOOST_TEST(
        (block.class_of_stage == std::vector<BlockClass>{BlockClass::exposed}));
      BOOST_TEST(found.blocks[1].is_infinite);
      BOOST_TEST_REQUIRE(found.faces[0].size() == 2u);
      for (const auto &face : found.faces[0])
        {
          BOOST_TEST(face.neighbour == 1u);
          BOOST_TEST(face.normal * (block.centroid - face.outlines[0][0]) > 0.);
        }
      BOOST_TEST(found.block_at({8., 8.}) == 0u);
      BOOST_TEST(found.block_at({2., 8.}) == 1u);
      BOOST_TEST(found.block_at({15., 8.}) == found.nothing);
    }
}

// One joint is enough to cut off a corner of rock, between two free surfaces of
// any kind.
BOOST_AUTO_TEST_CASE(one_joint_cuts_a_corner_off)
{
  PlaneBlockOptions options;
  options.leave_out = true;
  auto scene        = scene_in_box<2>({0., 0.}, {10., 10.});
  scene.joints      = {polygon_joint<2>(0, {{3., 9.}, {6., 6.}})};
  BOOST_TEST(find(scene, options).n_joints_used == 0u);
  auto cut = scene;
  cut.excavations.push_back(box_excavation<2>(0, 0, {0., 8.}, {10., 10.}));
  cut.excavations.push_back(box_excavation<2>(1, 0, {5., 0.}, {10., 10.}));
  const auto found = find(cut, options);
  check(found, 100.);
  BOOST_TEST_REQUIRE(found.blocks.size() == 2u);
  BOOST_TEST(std::abs(found.blocks[0].volume - 0.5) < 1e-14);
  BOOST_TEST(found.free_faces[0].size() == 2u);
  auto corner               = scene;
  corner.box                = BoundingBox<2>({{0., 0.}, {5., 8.}});
  corner.is_truncated[1]    = false;
  corner.is_truncated[3]    = false;
  const auto found_at_sides = find(corner, options);
  BOOST_TEST_REQUIRE(found_at_sides.blocks.size() == 2u);
  BOOST_TEST(std::abs(found_at_sides.blocks[0].volume - 0.5) < 1e-14);
  BOOST_TEST(is_exposed(found_at_sides.blocks[0]));
  std::set<unsigned int> sides;
  for (const auto &face : found_at_sides.free_faces[0])
    sides.insert(face.domain_side);
  BOOST_TEST((sides == std::set<unsigned int>{1, 3}));
}

BOOST_AUTO_TEST_CASE(classes_by_stage)
{
  // a block between two joints, below one excavation and beside another one,
  // from which a joint parts it
  auto scene = scene_in_box<2>({0., 0.}, {10., 10.});
  scene.excavations.push_back(box_excavation<2>(4, 2, {2., 6.}, {8., 8.}));
  scene.excavations.push_back(box_excavation<2>(7, 1, {6., 4.}, {8., 7.}));
  scene.joints      = {plane_joint<2>(5, {4., 0.}, Point<2>(-1., 0.)),
                       plane_joint<2>(6, {6., 0.}, Point<2>(1., 0.)),
                       plane_joint<2>(8, {0., 5.}, Point<2>(0., 1.))};
  const auto found  = find(scene);
  const auto finite = finite_blocks(found);
  check(found, 100.);
  BOOST_TEST_REQUIRE(finite.size() == 1u);
  BOOST_TEST(std::abs(finite[0].volume - 2.) < 1e-14);
  BOOST_TEST(finite[0].centroid.distance({5., 5.5}) < 1e-14);
  using Classes = std::vector<BlockClass>;
  BOOST_TEST(
    (finite[0].class_of_stage ==
     Classes{BlockClass::attached, BlockClass::attached, BlockClass::exposed}));
  BOOST_TEST(finite[0].exposed_stage == 2u);
  // the earlier stage counts where both are
  double excavated = 0.;
  for (unsigned int c = 0; c < found.cells.n_cells(); ++c)
    if (found.excavation_of_cell[c] == 7)
      excavated += found.cells.measures(c).volume;
  BOOST_TEST(std::abs(excavated - 6.) < 1e-13);
  std::map<unsigned int, std::array<double, 3>> free; // length, stage, joint
  for (const auto &face : found.free_faces[0])
    {
      free[face.excavation][0] += face.area;
      free[face.excavation][1] = face.stage;
      free[face.excavation][2] = face.joint;
    }
  BOOST_TEST_REQUIRE(free.size() == 2u);
  BOOST_TEST(std::abs(free[4][0] - 2.) < 1e-14);
  BOOST_TEST(free[4][1] == 2.);
  BOOST_TEST(free[4][2] == double(found.nothing));
  BOOST_TEST(std::abs(free[7][0] - 1.) < 1e-14);
  BOOST_TEST(free[7][1] == 1.);
  BOOST_TEST(free[7][2] == 6.);
  std::map<unsigned int, int> sides;
  for (const auto &face : found.faces[0])
    sides[face.joint] = face.side;
  BOOST_TEST((sides == std::map<unsigned int, int>{{5, -1}, {8, 1}}));
  // a joint along the other excavation, too: nothing holds the block
  auto parted = scene;
  parted.joints.push_back(plane_joint<2>(9, {0., 6.}, Point<2>(0., 1.)));
  const auto parted_blocks = find(parted);
  BOOST_TEST(parted_blocks.block_at({5., 5.5}) == 0u);
  // sides are those of each joint's own normal, whoever named its plane first
  for (const auto &faces : parted_blocks.faces)
    for (const auto &face : faces)
      for (const auto &joint : parted.joints)
        if (joint.joint == face.joint)
          BOOST_TEST(face.side * (face.normal * joint.normal) > 0.99);
  BOOST_TEST(
    (find(parted).blocks[0].class_of_stage ==
     Classes{BlockClass::hidden, BlockClass::exposed, BlockClass::exposed}));
  // in 3D the same is as long as it is deep
  auto deep = scene_in_box<3>({0., 0., 0.}, {10., 3., 10.});
  deep.excavations.push_back(
    box_excavation<3>(4, 2, {2., -1., 6.}, {8., 4., 8.}));
  deep.is_truncated[2] = deep.is_truncated[3] = false;
  for (const auto &joint : scene.joints)
    deep.joints.push_back(
      plane_joint<3>(joint.joint,
                     {joint.point[0], 0., joint.point[1]},
                     Point<3>(joint.normal[0], 0., joint.normal[1])));
  const auto slab = find(deep);
  check(slab, 300.);
  BOOST_TEST_REQUIRE(finite_blocks(slab).size() == 1u);
  BOOST_TEST(std::abs(slab.blocks[0].volume - 6.) < 1e-13);
}

// A cube of joints is closed by squares that parts cover together, by discs
// that hold a square, and not by a smaller disc.
BOOST_AUTO_TEST_CASE(cubes)
{
  enum class Lid
  {
    square,
    halves,
    overlapping_discs,
    disc,
    small_disc,
    halves_with_gap,
    none
  };
  const auto volume_with = [](const Lid lid, const double bridging) {
    auto scene = scene_in_box<3>({-3., -3., -3.}, {3., 3., 3.});
    for (unsigned int d = 0; d < 3; ++d)
      for (const double x : {-1., 1.})
        {
          const auto corner = [&](const double u, const double w) {
            Point<3> p;
            p[d]           = x;
            p[(d + 1) % 3] = u;
            p[(d + 2) % 3] = w;
            return p;
          };
          const Tensor<1, 3> normal = Point<3>::unit_vector(d);
          const unsigned int j      = scene.joints.size();
          const auto add_part       = [&](const double from, const double to) {
            scene.joints.push_back(polygon_joint<3>(j,
                                                    {corner(from, -1.),
                                                     corner(to, -1.),
                                                     corner(to, 1.),
                                                     corner(from, 1.)}));
          };
          const auto add_disc = [&](const double u, const double radius) {
            scene.joints.push_back(
              disc_joint<3>(j, corner(u, 0.), normal, radius));
          };
          if (d != 2 || x < 0. || lid == Lid::square)
            add_part(-1., 1.);
          else if (lid == Lid::halves)
            {
              add_part(-1., 0.25);
              add_part(0.25, 1.);
            }
          else if (lid == Lid::halves_with_gap)
            {
              add_part(-1., 0.);
              add_part(1e-3, 1.);
            }
          else if (lid == Lid::overlapping_discs)
            {
              add_disc(-0.5, 1.2);
              add_disc(0.5, 1.2);
            }
          else if (lid == Lid::disc)
            add_disc(0., 1.415);
          else if (lid == Lid::small_disc)
            add_disc(0., 1.413);
        }
    PlaneBlockOptions options;
    options.bridging = bridging;
    const auto found = find(scene, options);
    check(found, 216.);
    const auto finite = finite_blocks(found);
    return finite.empty() ? 0. : finite[0].volume;
  };
  for (const Lid lid :
       {Lid::square, Lid::halves, Lid::overlapping_discs, Lid::disc})
    BOOST_TEST(std::abs(volume_with(lid, 1e-6) - 8.) < 1e-13);
  for (const Lid lid : {Lid::small_disc, Lid::halves_with_gap, Lid::none})
    BOOST_TEST(volume_with(lid, 1e-6) == 0.);
  // what is bridged is a length
  BOOST_TEST(std::abs(volume_with(Lid::halves_with_gap, 6e-4) - 8.) < 1e-13);
  BOOST_TEST(std::abs(volume_with(Lid::small_disc, 2e-3) - 8.) < 1e-13);
}

namespace
{
  /** A network around a tunnel in a box of 20 m: discs, polygons and planes. If
   * it is spoilt, many are like one before, or lie on walls. */
  template <int dim>
  PlaneScene<dim>
  random_network(std::mt19937 &random,
                 const unsigned int n_joints,
                 const bool is_spoilt)
  {
    Point<dim> low, high, tunnel_low, tunnel_high;
    for (unsigned int d = 0; d < dim; ++d)
      {
        low[d]         = -10.;
        high[d]        = 10.;
        tunnel_low[d]  = -2.;
        tunnel_high[d] = 2.;
      }
    if (dim == 3)
      {
        tunnel_low[1]  = -11.;
        tunnel_high[1] = 11.;
      }
    auto scene = scene_in_box<dim>(low, high);
    scene.excavations.push_back(
      box_excavation<dim>(0, 1, tunnel_low, tunnel_high));
    tunnel_low[0] = 1.;
    tunnel_high += 1.5 * Point<dim>::unit_vector(0);
    scene.excavations.push_back(
      box_excavation<dim>(1, 2, tunnel_low, tunnel_high));
    for (unsigned int j = 0; j < n_joints; ++j)
      {
        Point<dim> point(10. * random_tensor<dim>(random));
        if (random() % 2 == 0)
          point = Point<dim>(0.5 * point);
        Tensor<1, dim> normal  = random_tensor<dim>(random);
        const double small     = std::pow(10., -6. - double(random() % 11));
        const unsigned int how = is_spoilt ? random() % 10 : 9;
        if (how < 4 && j > 0)
          {
            const auto &old = scene.joints[random() % j];
            point           = old.point;
            normal          = old.normal / old.normal.norm();
            if (how == 1)
              point += small * random_tensor<dim>(random);
            else if (how == 2)
              normal += 1e3 * small * random_tensor<dim>(random);
            else if (how == 3)
              normal = random_tensor<dim>(random);
          }
        else if (how == 4)
          {
            point  = random() % 2 == 0 ? tunnel_low : tunnel_high;
            normal = Point<dim>::unit_vector(random() % dim);
          }
        const unsigned int shape = random() % 8;
        if (shape == 0)
          scene.joints.push_back(plane_joint<dim>(j, point, normal));
        else if (dim == 2 || shape < 5)
          scene.joints.push_back(
            disc_joint<dim>(j, point, normal, 2. + random() % 8));
        else if constexpr (dim == 3)
          {
            Tensor<1, dim> u =
              cross_product_3d(normal, random_tensor<dim>(random));
            u /= u.norm();
            Tensor<1, dim> w = cross_product_3d(normal, u);
            w /= w.norm();
            const double a = 2. + random() % 6, b = 2. + random() % 6;
            std::vector<Point<dim>> corners = {point + a * u,
                                               point + b * w,
                                               point - b * u};
            if (shape < 7)
              corners.push_back(point - a * w);
            scene.joints.push_back(polygon_joint<dim>(j, corners));
            scene.joints.back().point  = point;
            scene.joints.back().normal = normal;
          }
      }
    return scene;
  }

  template <int dim>
  void
  check_networks(const unsigned int n_networks, const unsigned int n_joints)
  {
    std::mt19937 random(31 + dim);
    unsigned int n_finite = 0, n_exposed = 0, n_left = 0, n_all = 0;
    for (unsigned int i = 0; i < n_networks; ++i)
      {
        const bool is_spoilt = i % 2 == 1;
        auto scene           = random_network<dim>(random, n_joints, is_spoilt);
        const auto found     = find(scene);
        check(found, std::pow(20., dim), is_spoilt ? 1e-6 : 0.);
        n_finite += finite_blocks(found).size();
        for (const auto &block : found.blocks)
          n_exposed += is_exposed(block);
        // joints in another order, cut in that order
        if (is_spoilt)
          continue;
        PlaneBlockOptions options;
        options.leave_out = true;
        const auto rest   = find(scene, options);
        compare(found, rest, false);
        n_left += rest.n_joints_used;
        n_all += found.n_joints_used;
        options.leave_out     = false;
        options.largest_first = false;
        std::shuffle(scene.joints.begin(), scene.joints.end(), random);
        const auto other = find(scene, options);
        check(other, std::pow(20., dim));
        compare(found, other, true);
      }
    BOOST_TEST_MESSAGE(dim << "D: " << n_finite << " finite blocks, "
                           << n_exposed << " exposed; " << n_left << " of "
                           << n_all << " joints matter");
    // there must be something to compare
    BOOST_TEST(n_exposed > 20u);
    BOOST_TEST(n_finite > n_exposed + 20u);
    BOOST_TEST(n_left < n_all);
  }
} // namespace

BOOST_AUTO_TEST_CASE(random_networks)
{
  check_networks<2>(40, 40);
  check_networks<3>(16, 40);
}

namespace
{
  /** Whether a step from @p a to @p b crosses a joint, by its formula alone; a
   * little beside it counts, too. */
  template <int dim>
  bool
  crosses(const Piece<dim> &piece, const Point<dim> &a, const Point<dim> &b)
  {
    const Tensor<1, dim> n = piece.normal / piece.normal.norm();
    const double s = n * (a - piece.point), t = n * (b - piece.point);
    const double near = 1e-5;
    if (s * t > 0. && std::min(std::abs(s), std::abs(t)) > near)
      return false;
    if (piece.shape == Piece<dim>::Shape::unbounded)
      return true;
    const double part  = s != t ? std::clamp(s / (s - t), 0., 1.) : 0.;
    const Point<dim> x = a + part * (b - a);
    return x.distance(piece.point) <= piece.radius + near ||
           std::abs(s - t) < 10. * near;
  }
} // namespace

// Steps that cross no joint stay in their block: nothing is parted wrongly. Of
// points in one cell none is behind a joint: nothing is joined wrongly there.
BOOST_AUTO_TEST_CASE(walks)
{
  std::mt19937 random(9);
  unsigned int n_steps = 0, n_crossings = 0, n_parted = 0, n_blocks = 0;
  for (unsigned int network = 0; network < 4; ++network)
    {
      auto scene = scene_in_box<3>({-10., -10., -10.}, {10., 10., 10.});
      for (unsigned int j = 0; j < 40; ++j)
        scene.joints.push_back(
          disc_joint<3>(j,
                        Point<3>(8. * random_tensor<3>(random)),
                        random_tensor<3>(random),
                        5. + random() % 8));
      const auto found = find(scene);
      n_blocks += found.blocks.size();
      const auto is_blocked = [&](const Point<3> &a, const Point<3> &b) {
        return std::any_of(scene.joints.begin(),
                           scene.joints.end(),
                           [&](const auto &piece) {
                             return crosses(piece, a, b);
                           });
      };
      for (unsigned int walk = 0; walk < 40; ++walk)
        {
          Point<3> at(9. * random_tensor<3>(random));
          const unsigned int block = found.block_at(at);
          for (unsigned int step = 0; step < 150; ++step)
            {
              const Point<3> to = at + random_tensor<3>(random);
              if (to.distance_square({}) > 100. || is_blocked(at, to))
                {
                  n_parted += found.block_at(to) != block;
                  ++n_crossings;
                  continue;
                }
              ++n_steps;
              at = to;
              BOOST_TEST_REQUIRE(found.block_at(at) == block);
            }
        }
      // (a joint may end within a cell that it cut, never go through it)
      for (unsigned int i = 0; i < 500; ++i)
        {
          const auto &cell = found.cells.cell(random() % found.cells.n_cells());
          const auto inside = [&]() {
            Point<3> p;
            double sum = 0.;
            for (const auto &vertex : cell.vertices)
              {
                const double weight = 0.01 + double(random() % 1000) / 1000.;
                p += weight * vertex.x;
                sum += weight;
              }
            return Point<3>(p / sum);
          };
          const Point<3> a = inside(), b = inside();
          for (const auto &piece : scene.joints)
            {
              const double s = piece.normal *
                               (found.cells.to_metres(a) - piece.point),
                           t = piece.normal *
                               (found.cells.to_metres(b) - piece.point);
              if (std::min(std::abs(s), std::abs(t)) > 1e-4)
                BOOST_TEST_REQUIRE(
                  (s * t > 0. || !crosses(piece,
                                          found.cells.to_metres(a),
                                          found.cells.to_metres(b))));
            }
        }
    }
  BOOST_TEST_MESSAGE(n_steps << " steps, " << n_crossings << " not taken, "
                             << n_parted << " of these to other blocks, "
                             << n_blocks << " blocks");
  BOOST_TEST(n_steps > 5000u);
  BOOST_TEST(n_parted > 100u);
  BOOST_TEST(n_blocks > 20u);
}

namespace
{
  using Triangles = std::vector<std::array<unsigned int, 3>>;

  /** An icosahedron, each triangle divided into four @p levels times. */
  void
  make_sphere(const unsigned int levels,
              std::vector<Point<3>> &corners,
              Triangles &triangles)
  {
    const double g = 0.5 * (1. + std::sqrt(5.));
    corners        = {{-1, g, 0},
                      {1, g, 0},
                      {-1, -g, 0},
                      {1, -g, 0},
                      {0, -1, g},
                      {0, 1, g},
                      {0, -1, -g},
                      {0, 1, -g},
                      {g, 0, -1},
                      {g, 0, 1},
                      {-g, 0, -1},
                      {-g, 0, 1}};
    triangles      = {{{0, 11, 5}},  {{0, 5, 1}},  {{0, 1, 7}},  {{0, 7, 10}},
                      {{0, 10, 11}}, {{1, 5, 9}},  {{5, 11, 4}}, {{11, 10, 2}},
                      {{10, 7, 6}},  {{7, 1, 8}},  {{3, 9, 4}},  {{3, 4, 2}},
                      {{3, 2, 6}},   {{3, 6, 8}},  {{3, 8, 9}},  {{4, 9, 5}},
                      {{2, 4, 11}},  {{6, 2, 10}}, {{8, 6, 7}},  {{9, 8, 1}}};
    for (unsigned int level = 0; level < levels; ++level)
      {
        std::map<std::pair<unsigned int, unsigned int>, unsigned int> middles;
        const auto middle = [&](const unsigned int a, const unsigned int b) {
          const auto [entry, is_new] =
            middles.try_emplace(std::minmax(a, b), corners.size());
          if (is_new)
            corners.push_back(corners[a] + 0.5 * (corners[b] - corners[a]));
          return entry->second;
        };
        Triangles finer;
        for (const auto &[a, b, c] : triangles)
          {
            const unsigned int ab = middle(a, b), bc = middle(b, c),
                               ca = middle(c, a);
            finer.insert(
              finer.end(),
              {{{a, ab, ca}}, {{ab, b, bc}}, {{ca, bc, c}}, {{ab, bc, ca}}});
          }
        triangles = finer;
      }
  }
} // namespace

// Closed surfaces of triangles that are not convex are one block each.
BOOST_AUTO_TEST_CASE(shells)
{
  std::mt19937 random(2);
  double largest_error = 0.;
  for (unsigned int i = 0; i < 12; ++i)
    {
      std::vector<Point<3>> corners;
      Triangles triangles;
      make_sphere(i < 10 ? 0 : 1, corners, triangles);
      const Point<3> shift(random_tensor<3>(random));
      for (Point<3> &p : corners)
        p = shift + (3. + double(random() % 1000) / 500.) * p / p.norm();
      double volume = 0.;
      auto scene    = scene_in_box<3>({-7., -7., -7.}, {7., 7., 7.});
      for (const auto &[a, b, c] : triangles)
        {
          volume += (corners[a] - shift) *
                    cross_product_3d(corners[b] - shift, corners[c] - shift) /
                    6.;
          scene.joints.push_back(
            polygon_joint<3>(0, {corners[a], corners[b], corners[c]}));
        }
      const auto found = find(scene);
      check(found, std::pow(14., 3));
      BOOST_TEST_REQUIRE(found.blocks.size() == 2u);
      BOOST_TEST(!found.blocks[0].is_infinite);
      BOOST_TEST(found.blocks[1].is_infinite);
      BOOST_TEST(found.block_at(shift) == 0u);
      largest_error =
        std::max(largest_error, std::abs(found.blocks[0].volume / volume - 1.));
      // without one of the triangles it is open
      scene.joints.erase(scene.joints.begin() + random() % triangles.size());
      BOOST_TEST_REQUIRE(find(scene).blocks.size() == 1u);
    }
  BOOST_TEST_MESSAGE("volumes within " << largest_error);
  BOOST_TEST(largest_error < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()

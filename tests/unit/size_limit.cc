// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells that a mesh will have, before it is made.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/mesh/mesh.h>
#include <keyblock/mesh/size_limit.h>

using namespace Keyblock;

namespace
{
  /** Estimated number of cells of a verification scene over Gmsh's. */
  template <int dim>
  double
  estimate_over_count(const std::string &name,
                      const std::vector<std::string> &overrides)
  {
    Scene<dim> scene;
    scene.read(world, KEYBLOCK_VERIFICATION_SCENES "/" + name, overrides);
    // only rank 0 makes meshes, but all read together
    if (!world.is_root())
      return 1.;
    const Mesh<dim> mesh = make_gmsh_mesh<dim>(scene, silent, {});
    Point<dim> low = mesh.vertices[0], high = low;
    for (const Point<dim> &p : mesh.vertices)
      for (unsigned int d = 0; d < dim; ++d)
        {
          low[d]  = std::min(low[d], p[d]);
          high[d] = std::max(high[d], p[d]);
        }
    const MeshSize<dim> size(scene, high[0] - low[0]);
    const double estimate = estimate_cells(size, low, high, 1e300);
    BOOST_TEST_MESSAGE(name << ": " << estimate << " cells estimated, "
                            << mesh.n_cells() << " made");
    return estimate / mesh.n_cells();
  }
} // namespace

BOOST_AUTO_TEST_SUITE(size_limit)

BOOST_AUTO_TEST_CASE(estimates_are_about_right)
{
  for (const std::string at_hole : {"0.05", "0.01", "0.2"})
    {
      const double ratio =
        estimate_over_count<2>("kirsch.prm",
                               {"Mesh/Size at excavation=" + at_hole});
      BOOST_TEST(ratio > 0.7);
      BOOST_TEST(ratio < 1.5);
    }
  // of meshes with few cells between joints, 1 m or 3 m here, more are made
  const double ratio =
    estimate_over_count<3>("blocks_planes_4.prm", {"Mesh/Size=0.5"});
  BOOST_TEST(ratio > 0.5);
  BOOST_TEST(ratio < 2.);
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused)
{
  const auto remedy = [](const double times) {
    return "by " + std::to_string(times);
  };
  const double fitting = usable_memory() / needed_memory<3>(1e6, 0) * 1e6;
  BOOST_CHECK_NO_THROW(require_size<3>(0.5 * fitting, 0, "X", remedy));
  BOOST_CHECK_THROW(require_size<3>(3. * fitting, 0, "X", remedy), InputError);
  BOOST_CHECK_THROW(require_size<3>(0.5 * fitting, 100000, "X", remedy),
                    InputError);
  BOOST_CHECK_THROW(require_size<2>(1e300, 0, "X", remedy), InputError);
  try
    {
      require_size<2>(1e12, 0, "'Mesh/Cells'", remedy);
      BOOST_ERROR("not refused");
    }
  catch (const InputError &error)
    {
      BOOST_TEST(error.message.find("about 1e+12 cells by 'Mesh/Cells'") !=
                 std::string::npos);
      BOOST_TEST(error.message.find("GB of memory here") != std::string::npos);
    }
}

BOOST_AUTO_TEST_SUITE_END()

// SPDX-License-Identifier: LGPL-2.1-or-later
// From triangles to a volume of OpenCASCADE.
#include <gmsh.h>
#include <keyblock/base/gmsh_session.h>
#include <keyblock/base/number_text.h>
#include <keyblock/mesh/polyhedron.h>
#include <keyblock/scene/plane_faces.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace Keyblock
{
  namespace
  {
    namespace occ = gmsh::model::occ;

    using Edge     = std::pair<unsigned int, unsigned int>;
    using Triangle = TriangleSurface::Triangle;
    using Loop     = std::vector<unsigned int>;

    /** Adds faces with points and lines that they share. */
    class FaceMaker
    {
    public:
      explicit FaceMaker(const TriangleSurface &surface)
        : surface(surface)
      {}

      /** The face as one surface, or its triangles if that cannot be made. */
      void
      add(const PlaneFace &face, std::vector<int> &surfaces)
      {
        int made = 0;
        const std::string reason =
          reason_of_failure([&]() { made = add_face(face.loops); });
        if (reason.empty() && !face.loops.empty())
          surfaces.push_back(made);
        else
          for (const Triangle &t : face.triangles)
            surfaces.push_back(add_face({Loop(t.begin(), t.end())}));
      }

    private:
      int
      add_face(const std::vector<Loop> &loops)
      {
        std::vector<int> wires;
        for (const Loop &loop : loops)
          {
            std::vector<int> lines;
            for (unsigned int i = 0; i < loop.size(); ++i)
              lines.push_back(line(loop[i], loop[(i + 1) % loop.size()]));
            wires.push_back(occ::addCurveLoop(lines));
          }
        return occ::addPlaneSurface(wires);
      }

      int
      point(const unsigned int v)
      {
        const auto found = point_of.find(v);
        if (found != point_of.end())
          return found->second;
        const Point<3> &p  = surface.vertices[v];
        return point_of[v] = occ::addPoint(p[0], p[1], p[2]);
      }

      int
      line(const unsigned int from, const unsigned int to)
      {
        const Edge edge  = std::minmax(from, to);
        const auto found = line_of.find(edge);
        if (found != line_of.end())
          return found->second;
        return line_of[edge] =
                 occ::addLine(point(edge.first), point(edge.second));
      }

      const TriangleSurface &surface;
      std::map<unsigned int, int> point_of;
      std::map<Edge, int> line_of;
    };
  } // namespace



  int
  add_polyhedron(const TriangleSurface &surface)
  {
    FaceMaker maker(surface);
    std::vector<int> surfaces;
    for (const PlaneFace &face : list_faces(surface))
      maker.add(face, surfaces);
    const int solid = occ::addVolume({occ::addSurfaceLoop(surfaces, -1, true)});
    double volume   = 0.;
    occ::getMass(3, solid, volume);
    if (!(std::abs(volume - surface.volume()) < 1e-6 * surface.volume()))
      throw std::runtime_error("an excavation of triangles has a volume of " +
                               text_of(surface.volume()) + " m3 and becomes " +
                               text_of(volume) +
                               " m3, as if its surface crossed itself");
    return solid;
  }
} // namespace Keyblock

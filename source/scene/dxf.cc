// SPDX-License-Identifier: LGPL-2.1-or-later
// The outline in a drawing: ASCII DXF is pairs of lines, a code that says what
// a value is, and the value.
#include <deal.II/base/numbers.h>

#include <keyblock/base/box.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/dxf.h>
#include <keyblock/scene/solid_file.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Path = std::vector<Point<2>>;

    /** Distance of ends that meet, over the size of the drawing [-]. */
    constexpr double closeness = 1e-6;

    /** Curves that are not read, rather than left out of an outline. */
    const std::set<std::string> other_curves =
      {"SPLINE", "ELLIPSE", "INSERT", "3DFACE", "REGION", "MLINE", "HELIX"};

    struct Entity
    {
      std::string type;
      std::vector<std::pair<int, std::string>> values;

      double
      number(const int code, const double otherwise) const
      {
        for (const auto &[c, value] : values)
          if (c == code)
            return to_number(value);
        return otherwise;
      }

      double
      required(const int code) const
      {
        const double found = number(code, std::nan(""));
        if (std::isnan(found)) // no number is read as such
          throw std::runtime_error("a " + type + " has no value of code " +
                                   std::to_string(code));
        return found;
      }

      static double
      to_number(const std::string &value)
      {
        double number;
        if (!read_number(value, false, number))
          throw std::runtime_error("'" + value +
                                   "' stands where a number is expected");
        return number;
      }

      /** Whether one of the bits @p mask of the flags is set. */
      bool
      has_flag(const unsigned int mask) const
      {
        return (static_cast<unsigned int>(number(70, 0.)) & mask) != 0;
      }

      bool
      is_closed() const
      {
        return has_flag(1);
      }
    };

    /** What stands in the section ENTITIES, but for what is drawn on the paper
     * of a layout. */
    std::vector<Entity>
    read_entities(const std::string &text)
    {
      if (boost::starts_with(text, "AutoCAD Binary DXF"))
        throw std::runtime_error("it is a binary drawing where ASCII is read");
      std::vector<Entity> entities;
      std::istringstream lines(
        text.substr(boost::starts_with(text, "\xEF\xBB\xBF") ? 3 : 0));
      std::string code, value, section;
      bool is_whole = false;
      while (!is_whole && std::getline(lines, code) &&
             std::getline(lines, value))
        {
          boost::trim(code);
          boost::trim(value);
          if (code.empty() ||
              code.find_first_not_of("-0123456789") != std::string::npos ||
              code.size() > 6)
            throw std::runtime_error("'" + code.substr(0, 20) +
                                     "' stands where the code of a value is "
                                     "expected");
          const int number = std::stoi(code);
          is_whole         = number == 0 && boost::iequals(value, "EOF");
          if (number == 0)
            entities.push_back({value, {}});
          else if (!entities.empty())
            entities.back().values.emplace_back(number, value);
        }
      if (!is_whole)
        throw std::runtime_error("the file ends before its 'EOF', as one that "
                                 "was cut off");
      std::vector<Entity> drawn;
      for (const Entity &entity : entities)
        {
          if (entity.type == "SECTION" && !entity.values.empty())
            section = entity.values[0].second;
          else if (entity.type == "ENDSEC")
            section.clear();
          else if (section == "ENTITIES" && entity.number(67, 0.) != 1.)
            drawn.push_back(entity);
        }
      return drawn;
    }

    /** Add what follows @p from on an arc of @p angle, positive to the left,
     * about @p center. */
    void
    add_arc(Path &path,
            const Point<2> &from,
            const Point<2> &center,
            const double angle,
            const unsigned int n_chords)
    {
      const unsigned int n = std::max(
        1., std::ceil(std::abs(angle) / dealii::numbers::PI * n_chords - 1e-9));
      const Tensor<1, 2> radius = from - center;
      for (unsigned int i = 1; i <= n; ++i)
        {
          const double c = std::cos(angle * i / n), s = std::sin(angle * i / n);
          path.push_back(center + Point<2>(c * radius[0] - s * radius[1],
                                           s * radius[0] + c * radius[1]));
        }
    }

    /** Corners with their bulges: the tangent of a quarter of the angle of the
     * arc to the next corner. */
    struct Corner
    {
      Point<2> place;
      double bulge;
    };

    Path
    path_of(const std::vector<Corner> &corners,
            const bool is_closed,
            const unsigned int n_chords)
    {
      if (corners.size() < 2)
        return {};
      Path path = {corners[0].place};
      for (unsigned int i = 0; i + (is_closed ? 0 : 1) < corners.size(); ++i)
        {
          const Point<2> &a  = corners[i].place,
                         &b  = corners[(i + 1) % corners.size()].place;
          const double bulge = corners[i].bulge;
          if (bulge == 0. || a.distance(b) == 0.)
            {
              path.push_back(b);
              continue;
            }
          const Tensor<1, 2> chord = b - a;
          const Tensor<1, 2> left  = Point<2>(-chord[1], chord[0]);
          const Point<2> center =
            a + 0.5 * chord + (1. - bulge * bulge) / (4. * bulge) * left;
          add_arc(path, a, center, 4. * std::atan(bulge), n_chords);
          path.back() = b;
        }
      return path;
    }

    Path
    path_of_light_polyline(const Entity &entity, const unsigned int n_chords)
    {
      std::vector<Corner> corners;
      for (const auto &[code, value] : entity.values)
        if (code == 10)
          corners.push_back({Point<2>(Entity::to_number(value), 0.), 0.});
        else if (code == 20 && !corners.empty())
          corners.back().place[1] = Entity::to_number(value);
        else if (code == 42 && !corners.empty())
          corners.back().bulge = Entity::to_number(value);
      return path_of(corners, entity.is_closed(), n_chords);
    }

    /** A polyline whose corners are the entities after it; @p e becomes the
     * number of the last one. Corners of the frame of a spline lie beside the
     * curve. */
    Path
    path_of_polyline(const std::vector<Entity> &entities,
                     const unsigned int n_chords,
                     unsigned int &e)
    {
      const Entity &polyline   = entities[e];
      const bool is_fitted     = polyline.has_flag(4);
      constexpr unsigned frame = 16, mesh = 16 | 64;
      if (polyline.has_flag(mesh))
        throw std::runtime_error("it has a POLYLINE that is a mesh, not a "
                                 "line; draw the outline as a polyline");
      std::vector<Corner> corners;
      while (e + 1 < entities.size() && entities[e + 1].type == "VERTEX")
        {
          const Entity &vertex = entities[++e];
          if (!vertex.has_flag(frame))
            corners.push_back(
              {Point<2>(vertex.required(10), vertex.required(20)),
               vertex.number(42, 0.)});
        }
      if (is_fitted && corners.size() < 2)
        throw std::runtime_error("it has the frame of a spline as POLYLINE, "
                                 "but no points of its curve; draw them");
      return path_of(corners, polyline.is_closed(), n_chords);
    }

    Path
    path_of_arc(const Entity &entity, const unsigned int n_chords)
    {
      const Point<2> center(entity.required(10), entity.required(20));
      const double radius = entity.required(40);
      double from = 0., turn = 360.; // degrees
      if (entity.type == "ARC")
        {
          from = entity.required(50);
          turn = std::fmod(entity.required(51) - from, 360.);
          if (turn < 0.)
            turn += 360.;
          if (turn < closeness) // it ends where it begins
            turn = 360.;
        }
      constexpr double degree = dealii::numbers::PI / 180.;
      Path path = {center + radius * Point<2>(std::cos(degree * from),
                                              std::sin(degree * from))};
      add_arc(path, path[0], center, degree * turn, n_chords);
      if (turn == 360.)
        path.back() = path.front();
      return path;
    }

    /** Lines, arcs and polylines as chords. */
    std::vector<Path>
    list_paths(const std::vector<Entity> &entities, const unsigned int n_chords)
    {
      std::vector<Path> paths;
      for (unsigned int e = 0; e < entities.size(); ++e)
        {
          const Entity &entity = entities[e];
          Path path;
          if (entity.type == "LINE")
            path = {Point<2>(entity.required(10), entity.required(20)),
                    Point<2>(entity.required(11), entity.required(21))};
          else if (entity.type == "LWPOLYLINE")
            path = path_of_light_polyline(entity, n_chords);
          else if (entity.type == "ARC" || entity.type == "CIRCLE")
            path = path_of_arc(entity, n_chords);
          else if (entity.type == "POLYLINE")
            path = path_of_polyline(entities, n_chords, e);
          else if (other_curves.count(entity.type) > 0)
            throw std::runtime_error("it has a " + entity.type +
                                     ", which is not read; draw the outline "
                                     "as a polyline");
          // drawn on the back of the plane: x is mirrored, but not of lines
          if (entity.type != "LINE" && entity.number(230, 1.) < 0.)
            for (Point<2> &p : path)
              p[0] = -p[0];
          if (path.size() > 1)
            paths.push_back(std::move(path));
        }
      return paths;
    }

    double
    extent_of(const std::vector<Path> &paths)
    {
      Path points;
      for (const Path &path : paths)
        points.insert(points.end(), path.begin(), path.end());
      return diagonal_of_box(points);
    }

    /** Let the first path go on with others until it closes. */
    Path
    close_path(std::vector<Path> &paths, const double tolerance)
    {
      Path path = std::move(paths[0]);
      paths.erase(paths.begin());
      while (path.size() < 3 || path.front().distance(path.back()) > tolerance)
        {
          double gap   = path.front().distance(path.back());
          bool is_next = false;
          for (auto next = paths.begin(); next != paths.end() && !is_next;
               ++next)
            {
              for (const Point<2> &end : {next->front(), next->back()})
                gap = std::min(gap, end.distance(path.back()));
              if (next->back().distance(path.back()) <= tolerance)
                std::reverse(next->begin(), next->end());
              is_next = next->front().distance(path.back()) <= tolerance;
              if (is_next)
                {
                  path.insert(path.end(), next->begin() + 1, next->end());
                  paths.erase(next);
                  break;
                }
            }
          if (!is_next)
            throw std::runtime_error(
              "the outline is open: it ends at (" + text_of(path.back()[0]) +
              ", " + text_of(path.back()[1]) + "), and the next end is " +
              text_of(gap) + " units away");
        }
      return path;
    }
  } // namespace



  std::vector<Point<2>>
  read_dxf_outline(const std::string &text, const unsigned int n_chords)
  {
    std::vector<Path> paths = read_dxf_paths(text, n_chords);
    const double tolerance  = closeness * extent_of(paths);
    const Path outline      = close_path(paths, tolerance);
    if (!paths.empty())
      throw std::runtime_error(
        "it has more than one outline (another begins at (" +
        text_of(paths[0][0][0]) + ", " + text_of(paths[0][0][1]) +
        ")); give each excavation a file of its own");
    Path corners;
    for (const Point<2> &p : outline)
      if (corners.empty() || p.distance(corners.back()) > tolerance)
        corners.push_back(p);
    while (corners.size() > 1 &&
           corners.front().distance(corners.back()) <= tolerance)
      corners.pop_back();
    return corners;
  }



  std::vector<std::vector<Point<2>>>
  read_dxf_paths(const std::string &text, const unsigned int n_chords)
  {
    std::vector<Path> paths = list_paths(read_entities(text), n_chords);
    if (paths.empty())
      throw std::runtime_error(
        "it has no polyline, line, arc or circle in model space");
    return paths;
  }



  TriangleSurface
  read_dxf_faces(const std::string &text)
  {
    TriangleSurface surface;
    for (const Entity &entity : read_entities(text))
      if (entity.type == "3DFACE")
        {
          const unsigned int first = surface.vertices.size();
          for (int corner = 0; corner < 4; ++corner)
            {
              // a triangle may leave the fourth out or repeat the third
              Point<3> p = corner < 3 ? Point<3>() : surface.vertices.back();
              for (int axis = 0; axis < 3; ++axis)
                {
                  const int code = 10 * (axis + 1) + corner;
                  p[axis]        = corner < 3 ? entity.required(code)
                                              : entity.number(code, p[axis]);
                }
              surface.vertices.push_back(p);
            }
          surface.triangles.push_back({{first, first + 1, first + 2}});
          surface.triangles.push_back({{first, first + 2, first + 3}});
        }
      else if (entity.type == "POLYLINE" || other_curves.count(entity.type) > 0)
        throw std::runtime_error("it has a " + entity.type +
                                 ", which is not read; explode the surface "
                                 "into 3DFACEs");
    if (surface.triangles.empty())
      throw std::runtime_error("it has no 3DFACE");
    require_few_triangles(surface);
    surface.weld(closeness * diagonal_of_box(surface.vertices));
    return surface;
  }
} // namespace Keyblock

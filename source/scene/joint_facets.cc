// SPDX-License-Identifier: LGPL-2.1-or-later
// Bent joints from their entries and files to plane facets.
#include <keyblock/base/errors.h>
#include <keyblock/base/find_file.h>
#include <keyblock/base/gmsh_session.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/dxf.h>
#include <keyblock/scene/group_faces.h>
#include <keyblock/scene/joint_facets.h>
#include <keyblock/scene/plane_facets.h>
#include <keyblock/scene/shape_place.h>
#include <keyblock/scene/solid_file.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Facets of one joint at most: each is a plane of its own from then on. */
    constexpr unsigned int most_facets = 5000;

    /** Makes the facets of one joint. */
    template <int dim>
    class FacetMaker
    {
    public:
      FacetMaker(const Communicator &communicator,
                 const Scene<dim> &scene,
                 const Joint<dim> &joint)
        : communicator(communicator)
        , scene(scene)
        , joint(joint)
        , section("Joints/" + joint.name)
        , subject("The file '" + file() + "' of the entry '" + file_entry() +
                  "'")
      {}

      std::vector<std::unique_ptr<Joint<dim>>>
      make()
      {
        check_form();
        communicator.on_root([&]() {
          if (joint.form == JointForm::polyline)
            take_points();
          else
            find_and_read();
          check_number();
          if (joint.form == JointForm::file)
            check_place();
        });
        share();
        std::vector<std::unique_ptr<Joint<dim>>> result;
        for (unsigned int f = 0; f < facets.size(); ++f)
          {
            const PlaneFacet<dim> &facet = facets[f];
            result.push_back(std::make_unique<Joint<dim>>(joint));
            Joint<dim> &own = *result.back();
            own.surface     = joint.name;
            own.piece       = pieces[f];
            own.name += "_" + std::to_string(result.size());
            own.origin   = "The joint '" + joint.name + "'";
            own.extent   = JointShape::polygon;
            own.vertices = facet.corners;
            if (dim == 3)
              own.normal_entry.assign(facet.normal.begin_raw(),
                                      facet.normal.end_raw());
            if (joint.form == JointForm::physical_group)
              own.group = group();
            else
              {
                own.form = JointForm::plane;
                own.file.clear();
                own.scale = Joint<dim>().scale;
              }
          }
        return result;
      }

    private:
      bool
      is_group() const
      {
        return joint.form == JointForm::physical_group;
      }

      std::string
      file() const
      {
        return is_group() ? scene.domain.file : joint.file;
      }

      std::string
      file_entry() const
      {
        return is_group() ? std::string("Domain/File") : section + "/File";
      }

      std::string
      group() const
      {
        return joint.group.empty() ? joint.name : joint.group;
      }

      void
      check_form() const
      {
        const std::string form = name_of(joint.form);
        require(joint.extent == JointShape::infinite &&
                  joint.normal_entry.empty(),
                "The entry '" + section + "/Shape' is " + form +
                  ", but 'Extent' or 'Normal' is given, which are of planes; "
                  "leave them out, or set 'Shape' to plane.");
        if (joint.form == JointForm::polyline)
          require(dim == 2 && joint.vertices.size() > 1,
                  "The entry '" + section + "/Shape' is polyline with " +
                    std::to_string(joint.vertices.size()) +
                    " points in 'Vertices', and 'Dimension' is " +
                    std::to_string(dim) +
                    (dim == 2 ? "; give at least two points."
                              : "; a polyline is for 2D, in 3D give a file of "
                                "triangles ('Shape' = file)."));
        else
          require(joint.vertices.empty(),
                  "The entry '" + section + "/Shape' is " + form +
                    ", but 'Vertices' are given; leave them out.");
        if (is_group())
          require(scene.domain.shape == DomainShape::file &&
                    boost::iends_with(scene.domain.file, ".msh"),
                  "The entry '" + section +
                    "/Shape' is physical group, but the mesh is not read from "
                    "a .msh file ('Domain/File' is '" +
                    scene.domain.file + "'); name one, or give a plane.");
        if (joint.form != JointForm::file)
          return;
        require(!joint.file.empty(),
                "The entry '" + section +
                  "/File' is empty, but 'Shape' is file; name the file of the "
                  "surface.");
        const bool is_drawing = boost::iends_with(joint.file, ".dxf");
        require(is_drawing ||
                  (dim == 3 && (is_stl(joint.file) || is_cad(joint.file))),
                subject + " is not one of " +
                  (dim == 2 ? "lines (.dxf)"
                            : "triangles (.stl, .dxf) or faces (.step, .stp, "
                              ".brep)") +
                  "; convert it.");
        check_scale(section, joint.file, joint.scale);
      }

      void
      take_points()
      {
        if constexpr (dim == 2)
          {
            const std::string reason = reason_of_failure(
              [&]() { add_piece(facets_of_paths({joint.vertices})); });
            require(reason.empty(),
                    "The polyline of the entry '" + section +
                      "/Vertices' cannot be used (" + reason +
                      "); correct it.");
          }
      }

      void
      find_and_read()
      {
        const std::string found = find_file(scene.file, file());
        require(!found.empty(),
                subject + " does not exist or cannot be read; give a path "
                          "relative to the scene file.");
        const std::string reason = reason_of_failure(
          [&]() { is_group() ? read_group(found) : read_surface(found); });
        require(reason.empty(),
                subject + " cannot be used for the joint '" + joint.name +
                  "' (" + reason +
                  "); correct it in the program that made it.");
      }

      void
      read_surface(const std::string &path)
      {
        std::ifstream in(path, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in),
                               std::istreambuf_iterator<char>()};
        if constexpr (dim == 2)
          {
            auto paths = read_dxf_paths(text, joint.segments);
            for (auto &line : paths)
              for (Point<2> &p : line)
                p = Point<2>(joint.scale * p - scene.domain.origin);
            for (const auto &piece : pieces_of_paths(paths))
              add_piece(facets_of_paths(piece));
          }
        else
          {
            TriangleSurface surface =
              is_cad(path)   ? triangulate_faces(path,
                                               2 * joint.segments,
                                               smallest_cell() / joint.scale)
              : is_stl(path) ? read_stl(text)
                             : read_dxf_faces(text);
            for (Point<3> &p : surface.vertices)
              p = Point<3>(joint.scale * p - scene.domain.origin);
            for (TriangleSurface &piece : surface.components())
              add_piece(facets_of_triangles(std::move(piece)));
          }
      }

      void
      add_piece(const std::vector<PlaneFacet<dim>> &own)
      {
        pieces.resize(facets.size() + own.size(),
                      pieces.empty() ? 0 : pieces.back() + 1);
        facets.insert(facets.end(), own.begin(), own.end());
      }

      /** Smallest cell that the scene asks for [m]; 0: not known. */
      double
      smallest_cell() const
      {
        const Meshing<dim> &m = scene.meshing;
        double least          = 0.;
        for (const double size :
             {m.size, m.size_at_joints, m.size_at_excavation})
          if (size > 0. && (least == 0. || size < least))
            least = size;
        return least;
      }

      void
      read_group(const std::string &path)
      {
        std::vector<std::vector<Point<dim>>> faces;
        for (const auto &face : read_group_faces(path, dim - 1, group()))
          {
            faces.emplace_back();
            for (const Point<3> &corner : face)
              {
                faces.back().emplace_back();
                for (unsigned int d = 0; d < dim; ++d)
                  faces.back().back()[d] = corner[d];
              }
          }
        add_piece(facets_of_faces(faces));
      }

      void
      check_number() const
      {
        require(facets.size() <= most_facets,
                (joint.form == JointForm::polyline
                   ? "The polyline of the entry '" + section + "/Vertices'"
                   : subject) +
                  " gives the joint '" + joint.name + "' " +
                  std::to_string(facets.size()) + " plane parts, more than " +
                  std::to_string(most_facets) + "; make them larger" +
                  (is_cad(file()) ? ", or lower '" + section + "/Segments'."
                                  : "."));
      }

      /** The surface reaches into the domain and is of its order of size. */
      void
      check_place() const
      {
        std::vector<Point<dim>> all;
        for (const PlaneFacet<dim> &facet : facets)
          all.insert(all.end(), facet.corners.begin(), facet.corners.end());
        const ShapePlace<dim> place(scene.domain,
                                    dealii::BoundingBox<dim>(all),
                                    subject + " has a surface",
                                    section,
                                    file());
        place.require_inside(true);
        place.require_size();
      }

      /** Copy rank 0's facets to all ranks. */
      void
      share()
      {
        std::vector<unsigned int> n_corners;
        std::vector<Point<dim>> corners;
        std::vector<Tensor<1, dim>> normals;
        for (const PlaneFacet<dim> &facet : facets)
          {
            n_corners.push_back(facet.corners.size());
            corners.insert(corners.end(),
                           facet.corners.begin(),
                           facet.corners.end());
            normals.push_back(facet.normal);
          }
        communicator.broadcast(pieces);
        communicator.broadcast(n_corners);
        communicator.broadcast(corners);
        communicator.broadcast(normals);
        facets.clear();
        auto from = corners.begin();
        for (unsigned int f = 0; f < n_corners.size(); ++f)
          {
            facets.push_back({{from, from + n_corners[f]}, normals[f]});
            from += n_corners[f];
          }
      }

      const Communicator &communicator;
      const Scene<dim> &scene;
      const Joint<dim> &joint;
      const std::string section, subject;
      std::vector<PlaneFacet<dim>> facets;
      std::vector<unsigned int> pieces; ///< by facet
    };
  } // namespace



  template <int dim>
  void
  make_facets(const Communicator &communicator, Scene<dim> &scene)
  {
    std::vector<std::unique_ptr<Joint<dim>>> joints;
    std::set<std::string> names;
    for (auto &joint : scene.joints)
      {
        require(joint->form != JointForm::plane || joint->file.empty(),
                "The entry 'Joints/" + joint->name + "/File' is '" +
                  joint->file +
                  "', but 'Shape' is plane; set 'Shape' to file, or leave "
                  "'File' out.");
        names.insert(joint->name);
      }
    for (auto &joint : scene.joints)
      if (joint->form == JointForm::plane)
        joints.push_back(std::move(joint));
      else
        for (auto &facet : FacetMaker<dim>(communicator, scene, *joint).make())
          {
            require(names.insert(facet->name).second,
                    "The joint '" + facet->name +
                      "' has the name of a plane part of the joint '" +
                      joint->name + "'; give it another name.");
            joints.push_back(std::move(facet));
          }
    scene.joints = std::move(joints);
  }



  template <int dim>
  std::vector<std::vector<unsigned int>>
  joints_by_surface(const Scene<dim> &scene)
  {
    std::vector<std::vector<unsigned int>> lists;
    std::map<std::pair<std::string, unsigned int>, unsigned int> known;
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      {
        const std::string &surface = scene.joints[j]->surface;
        const auto [entry, is_new] =
          known.emplace(std::make_pair(surface, scene.joints[j]->piece),
                        lists.size());
        if (surface.empty() || is_new)
          lists.push_back({j});
        else
          lists[entry->second].push_back(j);
        if (surface.empty())
          known.erase(entry);
      }
    return lists;
  }

  template void make_facets(const Communicator &, Scene<2> &);
  template void make_facets(const Communicator &, Scene<3> &);
  template std::vector<std::vector<unsigned int>>
  joints_by_surface(const Scene<2> &);
  template std::vector<std::vector<unsigned int>>
  joints_by_surface(const Scene<3> &);
} // namespace Keyblock

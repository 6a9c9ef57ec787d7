// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces of physical groups that are joints.
#include <keyblock/base/errors.h>
#include <keyblock/mesh/mark_groups.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    std::vector<Point<dim>>
    places_of(const MixedMesh &mixed, const MixedMesh::Element &face)
    {
      std::vector<Point<dim>> places;
      for (const unsigned int v : face.vertices)
        {
          places.emplace_back();
          for (unsigned int d = 0; d < dim; ++d)
            places.back()[d] = mixed.vertices[v][d];
        }
      return places;
    }

    /** The normal of a face around which its vertices turn; in 2D the left of
     * the way from the first to the second. */
    Tensor<1, 2>
    normal_of(const std::vector<Point<2>> &places)
    {
      return -cross_product_2d(places[1] - places[0]);
    }

    Tensor<1, 3>
    normal_of(const std::vector<Point<3>> &places)
    {
      return cross_product_3d(places[1] - places[0], places[2] - places[0]);
    }

    /** Of the planes in @p list that which the face is least off. */
    template <int dim>
    unsigned int
    nearest_plane(const std::vector<Point<dim>> &places,
                  const std::vector<unsigned int> &list,
                  const std::vector<Surface<dim>> &surfaces)
    {
      unsigned int nearest = list.front();
      double least         = 1e300;
      for (const unsigned int s : list)
        {
          double height = 0.;
          for (const Point<dim> &p : places)
            height = std::max(height, std::abs(surfaces[s].distance(p)));
          if (height < least)
            {
              least   = height;
              nearest = s;
            }
        }
      return nearest;
    }
  } // namespace



  template <int dim>
  std::vector<Surface<dim>>
  mark_groups(MixedMesh &mixed,
              const Scene<dim> &scene,
              const std::string &origin)
  {
    std::vector<Surface<dim>> surfaces;
    // by the name of the bent joint
    std::map<std::string, std::vector<unsigned int>> planes_of;
    std::map<std::string, std::string> group_of;
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      if (const Joint<dim> &joint = *scene.joints[j];
          joint.form == JointForm::physical_group)
        {
          const JointExtent<dim> extent(joint);
          planes_of[joint.surface].push_back(surfaces.size());
          group_of[joint.surface] = joint.group;
          surfaces.push_back({extent.origin, extent.normal, 0., j});
        }
    for (const MixedMesh::Element &face : mixed.faces)
      for (const auto &[name, list] : planes_of)
        if (means_group("id " + group_of[name], face.id, mixed.face_names))
          {
            MixedMesh::Element marked = face;
            const auto places         = places_of<dim>(mixed, face);
            marked.id                 = nearest_plane(places, list, surfaces);
            if (normal_of(places) * surfaces[marked.id].normal < 0.)
              std::reverse(marked.vertices.begin(), marked.vertices.end());
            mixed.marked_faces.push_back(marked);
          }
    for (const MixedMesh::Element &face : loose_faces<dim>(mixed))
      {
        std::ostringstream text;
        text << origin << " has a face at (" << places_of<dim>(mixed, face)[0]
             << ") m in a physical group that is a joint, but no cell has that "
                "face; write cells and faces of one mesh.";
        AssertThrow(false, InputError(text.str()));
      }
    return surfaces;
  }

  template std::vector<Surface<2>>
  mark_groups(MixedMesh &, const Scene<2> &, const std::string &);
  template std::vector<Surface<3>>
  mark_groups(MixedMesh &, const Scene<3> &, const std::string &);
} // namespace Keyblock

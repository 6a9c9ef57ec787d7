// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of domain, mesh and excavations: name, default, range, unit and
// meaning.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/domain.h>
#include <keyblock/scene/entry_patterns.h>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::DomainShape>
    : Keyblock::ChoiceConversion<Keyblock::DomainShape>
  {};
  template <>
  struct Convert<Keyblock::MeshGenerator>
    : Keyblock::ChoiceConversion<Keyblock::MeshGenerator>
  {};
  template <>
  struct Convert<Keyblock::ExcavationShape>
    : Keyblock::ChoiceConversion<Keyblock::ExcavationShape>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;

  template <int dim>
  void
  Domain<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Shape",
                      shape,
                      "box: axis-parallel, by Corner and Size; parallelepiped: "
                      "by Corner and Edges; polygon (2D): by Polygon; file: "
                      "whatever the mesh in File covers.");
    prm.add_parameter("Corner", corner, "The corner with least x, y (z) [m].");
    prm.add_parameter("Size", size, "Lengths along x, y (z) of a box [m].");
    prm.add_parameter("Edges",
                      edges,
                      "Edge vectors of a parallelepiped from Corner [m], for "
                      "example `1, 0; 0, 2`; they must be right-handed.");
    prm.add_parameter(
      "Polygon",
      polygon,
      "Corners of a 2D domain in order [m], `x, y; x, y; ...`.");
    prm.add_parameter("File",
                      file,
                      "Mesh file: Gmsh .msh, Abaqus .inp, VTK .vtk, UCD .ucd, "
                      "relative to the scene file. Triangles, tetrahedra and "
                      "wedges are cut into quadrilaterals and hexahedra.");
    prm.add_parameter(
      "Truncated boundaries",
      truncated_boundaries,
      "Outer boundaries beyond which the rock goes on: a block "
      "that touches one is infinite. Names left, right, bottom, "
      "top, front, back, all, none, or `id N` for a "
      "boundary of a mesh file (N: number, or name of the physical group). "
      "Where 'Ground/Depth' puts the surface at the top of the domain, all is "
      "all but the top.");
    prm.add_parameter("Origin",
                      origin,
                      "Coordinates of the model's origin in the grid of the "
                      "table Joints/File and of files of excavations: they are "
                      "subtracted from the coordinates there, so that the "
                      "model has small numbers [m].");
  }


  template <int dim>
  void
  Meshing<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Generator",
                      generator,
                      "structured: equal cells in a box or parallelepiped "
                      "(joints and excavations must follow cell faces); gmsh: "
                      "a mesh that follows joints and excavations; file: "
                      "Domain/File.");
    prm.add_parameter("Cells",
                      cells,
                      "Structured: number of cells along each edge.");
    prm.add_parameter("Gradings",
                      gradings,
                      "Structured: for each edge, either `uniform` or a ratio "
                      "of the last cell's length to the first's.");
    prm.add_parameter("Size",
                      size,
                      "Gmsh: cell size far away [m]; 0 means a twentieth (2D) "
                      "or a twelfth (3D) of the domain's longest side.",
                      not_negative);
    prm.add_parameter(
      "Size at excavation",
      size_at_excavation,
      "Gmsh: cell size on the excavation [m]; 0 means Size, or, "
      "if Cells across blocks or no Size is given, at most a "
      "tenth of the narrowest excavation.",
      not_negative);
    prm.add_parameter("Size at joints",
                      size_at_joints,
                      "Gmsh: cell size on joints [m]; 0 means no request.",
                      not_negative);
    prm.add_parameter("Grading distance",
                      grading_distance,
                      "Gmsh: distance over which the size grows to Size [m]; 0 "
                      "means a quarter of the domain.",
                      not_negative);
    prm.add_parameter(
      "Cells across blocks",
      cells_across,
      "Number of cells that finite blocks near excavations (all finite blocks, "
      "if nothing is excavated) are to have across their least width, in gmsh "
      "meshes: the scene is meshed again with smaller cells where blocks have "
      "fewer, at most three times. 0: sizes do not depend on blocks.",
      Double(0., 50.));
    prm.add_parameter("Least size",
                      least_size,
                      "Gmsh: the smallest cell size that Cells across blocks "
                      "may ask for [m]; 0 means a quarter of Size at "
                      "excavation.",
                      not_negative);
    prm.add_parameter(
      "Joint tolerance",
      joint_tolerance,
      "Distance of a cell face's vertices from a joint, as a fraction of the "
      "face's size, within which the face lies on the joint [-].",
      Double(0., 0.1));
    prm.add_parameter(
      "Snap",
      snap,
      "Distance, as a fraction of the edge length wanted there (2.6 cell sizes "
      "in 2D, 3 in 3D), within which vertices are moved onto a joint that is "
      "cut into a gmsh mesh, where Gmsh cannot follow them exactly or, with "
      "dynamic stages, would make cells a hundredth as thick as others [-]. "
      "Faces "
      "of blocks at an outline are put back into the planes of their joints "
      "afterwards, as far as cells allow. Larger: larger time steps; smaller: "
      "joints and thin blocks more exact. 0: joints are always followed "
      "exactly, or the scene is refused.",
      Double(0., 0.45));
    prm.add_parameter("Refine at excavations",
                      refine_at_excavations,
                      "Distances from outlines of excavations [m], decreasing: "
                      "cells nearer than the first are halved once, nearer "
                      "than the second twice, and so on.");
    prm.add_parameter(
      "Refine at joints",
      refine_at_joints,
      "Distances from joints [m], decreasing: cells nearer than the first are "
      "halved once, nearer than the second twice, and so on.");
    prm.add_parameter(
      "Refinement levels",
      refinement_levels,
      "A formula in x, y (z): how often cells are halved whose centre is "
      "there. A box: `2 * (abs(x) < 5) * (abs(y) < 8)`.");
  }


  template <int dim>
  void
  Excavation<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Shape",
      shape,
      "polygon (2D): Vertices; circle: Center and Radius, in 2D without "
      "Segments and Bench levels followed by chords of cells, else a regular "
      "polygon of the same area; box: Corner and Size; extruded polygon "
      "(3D): Vertices in the x-z plane, From and To along y; "
      "rectangle, horseshoe (half a circle on walls), cavern "
      "(an arch of Rise on walls): Center, Width and Height; these and "
      "circles are in 3D along y as an extruded polygon; file: the solids of "
      "File (3D), "
      "or the closed outline in it (2D), in a mesh from Domain/File and if "
      "File is empty, the physical group of the excavation's name; "
      "formula (structured and file meshes): Formula.");
    prm.add_parameter(
      "Formula",
      formula,
      "A formula in x, y (z) that is positive at the centres of "
      "the cells excavated out.");
    prm.add_parameter("File",
                      file,
                      "File of the shape file, relative to the scene's: solids "
                      "from STEP or BREP (.step, .stp, .brep) or closed "
                      "surfaces of triangles (.stl), in 2D a closed outline of "
                      "polylines, lines and arcs (.dxf, ASCII).");
    prm.add_parameter("Scale",
                      scale,
                      "Length of the unit of .stl, .brep and .dxf files [m]; "
                      "STEP files name theirs.",
                      positive);
    prm.add_parameter("Vertices", vertices, "Corners in order [m].");
    prm.add_parameter("Corner",
                      corner,
                      "The corner with least coordinates [m].");
    prm.add_parameter("Size", size, "Lengths along the axes [m].");
    prm.add_parameter("Center",
                      center,
                      "Centre of the circle; middle of the floor of a "
                      "rectangle, horseshoe or cavern, in 3D its x and z [m].");
    prm.add_parameter("Width",
                      width,
                      "Width of a rectangle, horseshoe or cavern [m].",
                      not_negative);
    prm.add_parameter("Height",
                      height,
                      "Height of it, from the floor to the crown [m].",
                      not_negative);
    prm.add_parameter("Rise",
                      rise,
                      "Rise of a cavern's arch above its springs [m].",
                      not_negative);
    prm.add_parameter(
      "Segments",
      segments,
      "Number of chords of the crown, of half a circle for Shape "
      "circle and in .dxf files; 0: crowns and half circles "
      "have chords twice as long as the cells at excavations, "
      "6 to 24 of them, .dxf files 24.",
      Integer(0, 1000));
    prm.add_parameter("Bench levels",
                      bench_levels,
                      "Elevations at which it is parted into benches, from the "
                      "top down [m]. What is above the first is excavated in "
                      "Stage.");
    prm.add_parameter("Bench stages",
                      bench_stages,
                      "Name of the stage that excavates what is below each of "
                      "Bench levels. The parts are called NAME bench 1, NAME "
                      "bench 2, ...");
    prm.add_parameter("Radius",
                      radius,
                      "Radius of the circle [m].",
                      not_negative);
    prm.add_parameter("From",
                      from,
                      "Extrusion: least y, or place along the axis [m].");
    prm.add_parameter("To", to, "Extrusion: greatest y [m].");
    prm.add_parameter(
      "Trend",
      trend,
      "Extrusion: bearing of the axis, from From to To; 0: y, 90: x [deg]. It "
      "turns about Center, where these two are counted from, of an extruded "
      "polygon about the origin.",
      Double(-360., 360.));
    prm.add_parameter(
      "Plunge",
      plunge,
      "Extrusion: angle of the axis below the horizontal [deg]. "
      "Levels and heights are across it then.",
      Double(-90., 90.));
    prm.add_parameter("Stage",
                      stage,
                      "Name of the stage that excavates the region; start: the "
                      "region is empty from the beginning.");
    prm.add_parameter("Backfill stage",
                      backfill_stage,
                      "Name of a later stage that fills it, unstressed; empty: "
                      "none.");
    prm.add_parameter("Backfill material",
                      backfill_material,
                      "Name of the material it is filled with.");
  }

  template struct Domain<2>;
  template struct Domain<3>;
  template struct Meshing<2>;
  template struct Meshing<3>;
  template struct Excavation<2>;
  template struct Excavation<3>;
} // namespace Keyblock

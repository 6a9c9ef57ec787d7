#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of the rock at one time of a run.

usage: xvfb-run -a contrib/render.py solution.pvd OUT.png [--time-index I]
         [--field displacement] [--exaggeration F]

Warped by the displacement, coloured by the magnitude of a field (components of
stress: by the value); in 2D red lines show where the blocks were at first. Needs
the packages python3-vtk9, xvfb and xauth; with a display, leave xvfb-run out.
"""
import argparse
import pathlib
import sys
import xml.etree.ElementTree

try:
    from vtkmodules import vtkRenderingFreeType  # noqa: F401, draws the text
    from vtkmodules import vtkRenderingOpenGL2  # noqa: F401, draws the rest
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkFiltersCore import (vtkCleanPolyData, vtkFeatureEdges,
                                           vtkThreshold)
    from vtkmodules.vtkFiltersGeneral import vtkWarpVector
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkIOXML import (vtkXMLPUnstructuredGridReader,
                                     vtkXMLUnstructuredGridReader)
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import (
        vtkActor, vtkColorTransferFunction, vtkDataSetMapper, vtkPolyDataMapper,
        vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
except ImportError as error:
    sys.exit(f"render.py: VTK cannot be loaded ({error}); install the package "
             "python3-vtk9 and use the system's Python, /usr/bin/python3.")

SIZE = (1000, 800)
COLOURS = [(0.96, 0.96, 0.90), (0.74, 0.87, 0.75), (0.35, 0.71, 0.77),
           (0.20, 0.50, 0.74), (0.16, 0.36, 0.66)]


def read_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("collection", help="solution.pvd of a run")
    parser.add_argument("picture", help="PNG file to write")
    parser.add_argument("--time-index", type=int, default=-1,
                        help="0: first; -1: last (default)")
    parser.add_argument("--field", default="displacement")
    parser.add_argument("--exaggeration", type=float, default=1.,
                        help="factor of the displacement (default 1)")
    return parser.parse_args()


def find_rock(collection, index):
    """Time and file of the rock piece number `index` of a PVD file."""
    try:
        root = xml.etree.ElementTree.parse(collection).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        sys.exit(f"render.py: '{collection}' cannot be read: {error}.")
    sets = [s for s in root.iter("DataSet") if s.get("name", "rock") == "rock"]
    if not -len(sets) <= index < len(sets):
        sys.exit(f"render.py: '{collection}' holds {len(sets)} times; there is "
                 f"no time index {index}.")
    folder = pathlib.Path(collection).parent
    return float(sets[index].get("timestep")), folder / sets[index].get("file")


def read_grid(path):
    """The cells of a .vtu or .pvtu file; ends the program if there are none."""
    if not path.exists():
        sys.exit(f"render.py: the file '{path}' does not exist.")
    reader = (vtkXMLPUnstructuredGridReader() if path.suffix == ".pvtu" else
              vtkXMLUnstructuredGridReader())
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        sys.exit(f"render.py: the file '{path}' has no cells; it is empty, "
                 "damaged, or pieces of it are missing.")
    return grid


def unit_of(field):
    """Unit of a field of the output, by its name."""
    if field.startswith("stress"):
        return "Pa"
    return {"displacement": "m", "velocity": "m/s"}.get(field, "-")


def make_rock(grid, field, exaggeration):
    """Actor of the warped cells with their edges, and its colour bar."""
    names = [grid.GetPointData().GetArrayName(i)
             for i in range(grid.GetPointData().GetNumberOfArrays())]
    for name in (field, "displacement"):
        if name not in names:
            sys.exit(f"render.py: there is no field '{name}'; the file has "
                     f"{', '.join(names)}.")
    warp = vtkWarpVector()
    warp.SetInputData(grid)
    warp.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS,
                                "displacement")
    warp.SetScaleFactor(exaggeration)
    values = grid.GetPointData().GetArray(field)
    is_vector = values.GetNumberOfComponents() > 1
    low, high = values.GetRange(-1 if is_vector else 0)
    low = 0. if is_vector else low
    high = high if high > low else low + 1.
    colours = vtkColorTransferFunction()
    for i, colour in enumerate(COLOURS):
        share = i / (len(COLOURS) - 1)
        colours.AddRGBPoint(low + (high - low) * share, *colour)
    if is_vector:
        colours.SetVectorModeToMagnitude()
    mapper = vtkDataSetMapper()
    mapper.SetInputConnection(warp.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    mapper.SetLookupTable(colours)
    rock = vtkActor()
    rock.SetMapper(mapper)
    rock.GetProperty().EdgeVisibilityOn()
    rock.GetProperty().SetEdgeColor(0.2, 0.2, 0.2)
    rock.GetProperty().LightingOff()

    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle(f"{field} [{unit_of(field)}]\n ")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetPosition(0.84, 0.25)
    bar.SetWidth(0.08)
    bar.SetHeight(0.55)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        style(text, 18)
    return rock, bar


def make_outlines(grid):
    """Actors of the outline of each block in its first position (2D)."""
    blocks = grid.GetPointData().GetArray("block")
    numbers = {blocks.GetTuple1(i) for i in range(blocks.GetNumberOfTuples())
               } if blocks else set()
    for number in numbers:
        part = vtkThreshold()
        part.SetInputData(grid)
        part.SetInputArrayToProcess(
            0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "block")
        part.SetLowerThreshold(number)
        part.SetUpperThreshold(number)
        surface, merged, edges = (vtkGeometryFilter(), vtkCleanPolyData(),
                                  vtkFeatureEdges())
        surface.SetInputConnection(part.GetOutputPort())
        merged.SetInputConnection(surface.GetOutputPort())
        merged.SetTolerance(1e-6)
        edges.SetInputConnection(merged.GetOutputPort())
        edges.ColoringOff()
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(edges.GetOutputPort())
        mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.75, 0.15, 0.1)
        actor.GetProperty().SetLineWidth(2)
        actor.GetProperty().LightingOff()
        yield actor


def style(text, size):
    """Plain black type of a size in points."""
    text.SetColor(0., 0., 0.)
    text.SetFontFamilyToArial()
    text.SetFontSize(size)
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()


def write_picture(actors, is_flat, caption, path):
    """Draw the actors on white and write a PNG file."""
    renderer = vtkRenderer()
    renderer.SetBackground(1., 1., 1.)
    for actor in actors:
        renderer.AddActor(actor)
    label = vtkTextActor()
    label.SetInput(caption)
    label.SetPosition(30, 25)
    style(label.GetTextProperty(), 22)
    renderer.AddActor2D(label)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetPosition(*((0., 0., 1.) if is_flat else (-1., -1.6, 1.)))
    camera.SetViewUp(*((0., 1., 0.) if is_flat else (0., 0., 1.)))
    renderer.ResetCamera()
    camera.Zoom(1.2)
    camera.SetWindowCenter(0.12, -0.04)  # room for the colour bar and caption
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(9)
    writer.Write()


def main():
    """Read, draw, write."""
    arguments = read_arguments()
    time, path = find_rock(arguments.collection, arguments.time_index)
    grid = read_grid(path)
    rock, bar = make_rock(grid, arguments.field, arguments.exaggeration)
    bounds = grid.GetBounds()
    is_flat = bounds[4] == bounds[5]
    outlines = make_outlines(grid) if is_flat else []
    caption = f"t = {time:.4g} s"
    if arguments.exaggeration != 1.:
        caption += f"; displacement times {arguments.exaggeration:g}"
    if is_flat:
        caption += "; red: first position of the blocks"
    write_picture([rock, *outlines, bar], is_flat, caption, arguments.picture)


if __name__ == "__main__":
    main()

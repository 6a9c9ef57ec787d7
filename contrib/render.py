#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of the rock at one time of a run.

usage: xvfb-run -a contrib/render.py solution.pvd OUT.png [--time-index I]
         [--field displacement] [--exaggeration F] [--size WIDTH,HEIGHT]
         [--box X0,Y0,X1,Y1] [--tilt DEGREES] [--stretch F] [--explode F]
         [--eye X,Y,Z] [--mesh on]

Warped by the displacement, coloured by the magnitude of a field, one component
of it (velocity_x, stress_xx), or by block; red lines show where the blocks
were at first. Needs the packages python3-vtk9, xvfb and xauth; with a display,
leave xvfb-run out.
"""
import argparse
import dataclasses
import math
import pathlib
import sys
import xml.etree.ElementTree

try:
    import numpy
    from vtkmodules import vtkRenderingFreeType  # noqa: F401, draws the text
    from vtkmodules import vtkRenderingOpenGL2  # noqa: F401, draws the rest
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkDataObject,
                                               vtkUnstructuredGrid)
    from vtkmodules.vtkFiltersCore import (vtkDecimatePolylineFilter,
                                           vtkFeatureEdges, vtkStripper,
                                           vtkThreshold)
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkIOXML import (vtkXMLPUnstructuredGridReader,
                                     vtkXMLUnstructuredGridReader)
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import (
        vtkActor, vtkBillboardTextActor3D, vtkColorTransferFunction,
        vtkDataSetMapper, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
        vtkTextActor, vtkWindowToImageFilter)
except ImportError as error:
    sys.exit(f"render.py: VTK cannot be loaded ({error}); install the package "
             "python3-vtk9 and use the system's Python, /usr/bin/python3.")

COLOURS = [(0.96, 0.96, 0.90), (0.74, 0.87, 0.75), (0.35, 0.71, 0.77),
           (0.20, 0.50, 0.74), (0.16, 0.36, 0.66)]
BLOCK_COLOURS = [(0.90, 0.89, 0.84), (0.55, 0.74, 0.86), (0.96, 0.74, 0.47),
                 (0.64, 0.80, 0.55), (0.90, 0.58, 0.55), (0.77, 0.69, 0.87),
                 (0.97, 0.89, 0.52), (0.55, 0.80, 0.76), (0.80, 0.66, 0.53),
                 (0.94, 0.72, 0.83), (0.72, 0.75, 0.78)]
RED, DARK = (0.75, 0.15, 0.1), (0.15, 0.15, 0.15)
BAR = 0.2  # share of the width for the colour bar


@dataclasses.dataclass
class View:
    """What a picture shows and how; the options of the command line."""

    time_index: int = -1
    field: str = "displacement"
    exaggeration: float = 1.  # 0: automatic
    size: tuple = (1000, 800)
    box: tuple = ()
    tilt: float = 0.
    stretch: float = 1.
    explode: float = 0.
    mesh: str = "auto"
    eye: tuple = (-1., -1.6, 1.)  # direction in which the viewer is (3D)
    block_colours: tuple = tuple(BLOCK_COLOURS)  # of block 1, 2, ...


def numbers(text):
    """The numbers of an option such as 480,400."""
    return tuple(float(word) for word in text.split(","))


def read_arguments():
    """The command line: collection, picture and view."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("collection", help="solution.pvd of a run")
    parser.add_argument("picture", help="PNG file to write")
    parser.add_argument("--time-index", type=int, default=-1,
                        help="0: first; -1: last (default)")
    parser.add_argument("--field", default="displacement",
                        help="a field of the output, or its component x, y or "
                        "z, as in velocity_x; block: one colour for each")
    parser.add_argument("--exaggeration", type=float, default=1.,
                        help="factor of the displacement (default 1; 0: such "
                        "that the largest is 6 %% of the picture's size)")
    parser.add_argument("--size", type=numbers, default=(1000, 800),
                        help="greatest width and height in pixels")
    parser.add_argument("--box", type=numbers, default=(),
                        help="least, then greatest coordinates to show")
    parser.add_argument("--tilt", type=float, default=0.,
                        help="turn the picture clockwise [degrees]")
    parser.add_argument("--stretch", type=float, default=1.,
                        help="factor of all heights (y)")
    parser.add_argument("--explode", type=float, default=0.,
                        help="move each block away from the middle by this "
                        "share of its distance")
    parser.add_argument("--mesh", default="auto",
                        choices=("auto", "on", "off"), help="edges of cells "
                        "(auto: if ten pixels long, and not of blocks)")
    parser.add_argument("--eye", type=numbers, default=View.eye,
                        help="direction in which the viewer is (3D)")
    options = vars(parser.parse_args())
    for name, counts in (("size", (2,)), ("box", (0, 4, 6)), ("eye", (3,))):
        if len(options[name]) not in counts:
            parser.error(f"--{name} takes {' or '.join(map(str, counts[-2:]))}"
                         f" numbers, not {len(options[name])}.")
    collection, picture = options.pop("collection"), options.pop("picture")
    return collection, picture, View(**options)


def find_rock(collection, index):
    """Time and file of the rock piece number `index` of a PVD file."""
    try:
        root = xml.etree.ElementTree.parse(collection).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        sys.exit(f"render.py: '{collection}' cannot be read: {error}.")
    sets = [s for s in root.iter("DataSet") if s.get("name", "rock") == "rock"]
    if not -len(sets) <= index < len(sets):
        sys.exit(f"render.py: '{collection}' holds {len(sets)} times; there "
                 f"is no time index {index}.")
    folder = pathlib.Path(collection).parent
    return float(sets[index].get("timestep")), folder / sets[index].get("file")


def unshare(grid):
    """A grid each of whose cells has points of its own, with all fields at
    them, named without units."""
    order = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    result, places, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    places.SetData(numpy_to_vtk(points[order], deep=True))
    cells.SetData(grid.GetCells().GetOffsetsArray(), numpy_to_vtk(
        numpy.arange(len(order), dtype=order.dtype), deep=True))
    result.SetPoints(places)
    result.SetCells(grid.GetCellTypesArray(), cells)
    of_cell = numpy.repeat(numpy.arange(len(offsets) - 1),
                           numpy.diff(offsets))
    for data, place in ((grid.GetPointData(), order),
                        (grid.GetCellData(), of_cell)):
        for i in range(data.GetNumberOfArrays()):
            array = numpy_to_vtk(vtk_to_numpy(data.GetArray(i))[place],
                                 deep=True)
            array.SetName(data.GetArrayName(i).split(" (")[0])
            result.GetPointData().AddArray(array)
    return result


def read_grid(path):
    """The cells of a .vtu or .pvtu file; the program ends if it has none."""
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
    return unshare(grid)


def values_of(grid, field):
    """Values of a field or of one component of it at the points."""
    data = grid.GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    if field in names:
        return vtk_to_numpy(data.GetArray(field))
    name, _, component = field.rpartition("_")
    components = []
    if name in names:
        components = {3: ["x", "y", "z"],
                      9: [a + b for a in "xyz" for b in "xyz"]}.get(
                          data.GetArray(name).GetNumberOfComponents(), [])
    if component not in components:
        sys.exit(f"render.py: there is no field '{field}'; the file has "
                 f"{', '.join(names)}.")
    return vtk_to_numpy(data.GetArray(name))[:, components.index(component)]


def shown_values(grid, field):
    """Magnitudes or values of a field in a fitting unit, and that unit."""
    values = values_of(grid, field).astype(float)
    if values.ndim > 1:
        values = numpy.linalg.norm(values, axis=1)
    if "stress" in field:
        largest = abs(values).max()
        for unit, factor in (("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.)):
            if largest >= factor:
                return values / factor, unit
        return values, "Pa"
    unit = {"displacement": "m", "velocity": "m/s"}.get(field.split("_")[0])
    return values, unit or "-"


def round_factor(value):
    """The nearest of 1, 2, 5, 10, 20, ...; at least 1."""
    choices = [m * 10**k for k in range(12) for m in (1, 2, 5)]
    return min(choices, key=lambda c: abs(math.log(c / max(value, 1.))))


def choose_exaggeration(grid, view):
    """The factor asked for, or one that makes the displacement visible."""
    if view.exaggeration > 0.:
        return view.exaggeration
    points = vtk_to_numpy(grid.GetPoints().GetData())
    lengths = numpy.ptp(points, axis=0)
    if view.box:
        n = len(view.box) // 2
        lengths = numpy.subtract(view.box[n:], view.box[:n])
    largest = abs(values_of(grid, "displacement")).max()
    return round_factor(0.06 * max(lengths) / largest) if largest > 0. else 1.


def move_points(grid, factor, view):
    """Copy of the grid with its points displaced, drawn apart, stretched."""
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    moved = points + factor * values_of(grid, "displacement")
    if view.explode > 0.:
        block = values_of(grid, "block")
        for number in numpy.unique(block):
            mine = block == number
            centre = points[mine].mean(axis=0)
            moved[mine] += view.explode * (centre - points.mean(axis=0))
    moved[:, 1] *= view.stretch
    result, places = vtkUnstructuredGrid(), vtkPoints()
    result.DeepCopy(grid)
    places.SetData(numpy_to_vtk(moved, deep=True))
    result.SetPoints(places)
    return result


def make_colours(values, is_magnitude, view):
    """Colours from the least to the greatest value; of magnitudes from 0."""
    colours = vtkColorTransferFunction()
    if view.field == "block":
        for number in range(1, int(values.max()) + 1):
            colour = view.block_colours[(number - 1) % len(view.block_colours)]
            colours.AddRGBPoint(number - 0.4, *colour)
            colours.AddRGBPoint(number + 0.4, *colour)
        return colours
    low, high = 0. if is_magnitude else values.min(), values.max()
    high = high if high > low else low + 1.
    for i, colour in enumerate(COLOURS):
        share = i / (len(COLOURS) - 1)
        colours.AddRGBPoint(low + (high - low) * share, *colour)
    return colours


def make_rock(grid, values, colours, view):
    """Actor of the cells; their edges are shown later if there is room."""
    array = numpy_to_vtk(values, deep=True)
    array.SetName("shown")
    grid.GetPointData().AddArray(array)
    mapper = vtkDataSetMapper()
    mapper.SetInputData(grid)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("shown")
    mapper.SetLookupTable(colours)
    rock = vtkActor()
    rock.SetMapper(mapper)
    rock.GetProperty().SetEdgeColor(0.35, 0.35, 0.35)
    rock.GetProperty().SetEdgeVisibility(view.mesh == "on")
    rock.GetProperty().SetAmbient(0.5)
    rock.GetProperty().SetDiffuse(0.55)
    is_flat = grid.GetBounds()[4] == grid.GetBounds()[5]
    rock.GetProperty().SetLighting(view.field == "block" and not is_flat)
    return rock


def make_bar(colours, title, size):
    """Colour bar on the right and its title."""
    line = type_size(size)
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetPosition(1. - 0.9 * BAR, 2. * line / size[1])
    bar.SetWidth(0.08)
    bar.SetHeight(1. - 6.5 * line / size[1])
    style(bar.GetLabelTextProperty(), line)
    name = vtkTextActor()
    name.SetInput(title.replace(" [", "\n["))
    name.SetPosition((1. - 0.95 * BAR) * size[0], size[1] - 3.2 * line)
    style(name.GetTextProperty(), line)
    return [bar, name]


def make_caption(caption, size):
    """The caption below the picture."""
    text = vtkTextActor()
    text.SetInput(caption)
    text.SetPosition(0.02 * size[0], 0.5 * type_size(size))
    style(text.GetTextProperty(), type_size(size))
    return text


def merge_points(grid):
    """Copy of the grid in which cells of the same block share their points."""
    points = vtk_to_numpy(grid.GetPoints().GetData())
    block = values_of(grid, "block")
    tolerance = 1e-6 * numpy.ptp(points, axis=0).max()
    keys = numpy.column_stack([numpy.round(points / tolerance), block])
    _, kept, place = numpy.unique(keys, axis=0, return_index=True,
                                  return_inverse=True)
    result, places, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(points[kept], deep=True))
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    place = place[connectivity].astype(connectivity.dtype)
    cells.SetData(grid.GetCells().GetOffsetsArray(),
                  numpy_to_vtk(place, deep=True))
    result.SetPoints(places)
    result.SetCells(grid.GetCellTypesArray(), cells)
    array = numpy_to_vtk(block[kept], deep=True)
    array.SetName("block")
    result.GetPointData().AddArray(array)
    return result


def drop_hanging(edges):
    """The edges of a plane mesh without those along which nodes hang."""
    points = vtk_to_numpy(edges.GetPoints().GetData()).astype(float)
    lines = vtk_to_numpy(edges.GetLines().GetConnectivityArray())
    lines = lines.reshape(-1, 2)
    unit = 1e-5 * numpy.ptp(points, axis=0).max()
    keys = [tuple(k) for k in numpy.round(points / unit).astype(int)]
    # of a long edge the middle is itself a point, joined to both its ends
    middles = points[lines].mean(axis=1)
    middle_keys = [tuple(k) for k in numpy.round(middles / unit).astype(int)]
    known = {frozenset((keys[a], keys[b])) for a, b in lines}
    dropped = set()
    for (a, b), middle in zip(lines, middle_keys):
        halves = [frozenset((keys[a], middle)), frozenset((middle, keys[b]))]
        if all(half in known for half in halves):
            dropped.update(halves, [frozenset((keys[a], keys[b]))])
    kept = vtkCellArray()
    for a, b in lines:
        if frozenset((keys[a], keys[b])) not in dropped:
            kept.InsertNextCell(2)
            kept.InsertCellPoint(a)
            kept.InsertCellPoint(b)
    edges.SetLines(kept)
    return edges


def outline_of(merged, number):
    """Edges of the outline of a block of a grid with shared points."""
    part, surface, edges = (vtkThreshold(), vtkGeometryFilter(),
                            vtkFeatureEdges())
    part.SetInputData(merged)
    part.SetInputArrayToProcess(
        0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "block")
    part.SetLowerThreshold(number)
    part.SetUpperThreshold(number)
    surface.SetInputConnection(part.GetOutputPort())
    edges.SetInputConnection(surface.GetOutputPort())
    edges.ColoringOff()
    edges.Update()
    return drop_hanging(edges.GetOutput())


def make_outlines(grid, colour):
    """Actors of the outline of each block."""
    merged = merge_points(grid)
    for number in numpy.unique(values_of(merged, "block")):
        lines, straight = vtkStripper(), vtkDecimatePolylineFilter()
        lines.SetInputData(outline_of(merged, number))
        lines.JoinContiguousSegmentsOn()
        lines.SetMaximumLength(100000)
        straight.SetInputConnection(lines.GetOutputPort())
        straight.SetTargetReduction(1.)
        straight.SetMaximumError(1e-8)
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputConnection(straight.GetOutputPort())
        mapper.ScalarVisibilityOff()
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(*colour)
        actor.GetProperty().SetLineWidth(1.5)
        actor.GetProperty().LightingOff()
        yield actor


def make_numbers(grid, view):
    """The number of each block on the cell farthest from its outline (2D).

    Blocks whose cells come no farther than a line of type have none."""
    corners = vtk_to_numpy(grid.GetPoints().GetData()).reshape(-1, 4, 3)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    if view.box:
        low[:2], high[:2] = view.box[:2], view.box[2:]
    line = type_size(view.size) * max(high - low) / min(view.size)
    merged = merge_points(grid)
    centres, block = corners.mean(axis=1), values_of(grid, "block")[::4]
    for number in numpy.unique(block):
        mine = centres[block == number]
        outline = outline_of(merged, number)
        ends = vtk_to_numpy(outline.GetPoints().GetData())
        far = numpy.minimum((mine - low)[:, :2].min(axis=1),
                            (high - mine)[:, :2].min(axis=1))
        for end in ends:
            far = numpy.minimum(far, numpy.linalg.norm(mine - end, axis=1))
        if far.max() < 0.6 * line:
            continue
        text = vtkBillboardTextActor3D()
        text.SetInput(str(int(number)))
        text.SetPosition(*mine[far.argmax()])
        style(text.GetTextProperty(), type_size(view.size))
        text.GetTextProperty().SetJustificationToCentered()
        text.GetTextProperty().SetVerticalJustificationToCentered()
        yield text


def type_size(size):
    """Type in points for a picture of a size."""
    return max(11, round(0.02 * size[0]))


def style(text, size):
    """Plain black type of a size in points."""
    text.SetColor(0., 0., 0.)
    text.SetFontFamilyToArial()
    text.SetFontSize(size)
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()


def extents(places, view, is_flat):
    """Middle, width and height of places as the camera sees them; its axes."""
    back = numpy.array((0., 0., 1.) if is_flat else view.eye)
    angle = math.radians(view.tilt)
    up = numpy.array((-math.sin(angle), math.cos(angle), 0.) if is_flat else
                     (0., 0., 1.))
    back /= numpy.linalg.norm(back)
    right = numpy.cross(up, back)
    right /= numpy.linalg.norm(right)
    axes = numpy.array((right, numpy.cross(back, right), back))
    low, high = (places @ axes.T).min(axis=0), (places @ axes.T).max(axis=0)
    return axes.T @ (0.5 * (low + high)), *(high - low)[:2], axes


def corners_of(box, stretch):
    """The corners of a box given by its least and greatest coordinates."""
    n = len(box) // 2
    low, high = ((*box[:n], 0.)[:3], (*box[n:], 0.)[:3])
    return numpy.array([[x, y * stretch, z] for x in (low[0], high[0])
                        for y in (low[1], high[1]) for z in (low[2], high[2])])


def aim(camera, centre, axes, extent, half_height):
    """Look at a centre along the third axis, with the second upwards."""
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(centre + axes[2] * 2. * extent))
    camera.SetViewUp(*axes[1])
    camera.SetParallelScale(half_height)


def write_picture(actors, make_texts, places, view, path):
    """Draw actors, all places in view, and texts on white; write a PNG file.

    The height shrinks to what flat places need."""
    width, height = (int(n) for n in view.size)
    foot = 3.6 * type_size(view.size)
    is_flat = numpy.ptp(places[:, 2]) == 0.
    centre, wide, high, axes = extents(places, view, is_flat)
    across = width * (1. if view.field == "block" else 1. - BAR)
    scale = 0.95 * min(across / wide, (height - foot) / max(high, 1e-9 * wide))
    height = int(min(height, max(foot + scale * high / 0.95, 0.4 * width)))
    sheet, renderer = vtkRenderer(), vtkRenderer()
    sheet.SetBackground(1., 1., 1.)
    renderer.SetViewport(0., foot / height, across / width, 1.)
    renderer.SetLayer(1)
    aim(renderer.GetActiveCamera(), centre, axes, wide + high,
        0.5 * (height - foot) / scale)
    for actor in actors:
        renderer.AddActor(actor)
    if view.mesh == "auto" and view.field != "block":
        show_edges(actors[0], scale)
    for text in make_texts((width, height)):
        sheet.AddActor2D(text)
    renderer.ResetCameraClippingRange()
    save([sheet, renderer], (width, height), path)


def save(renderers, size, path):
    """Draw layers one upon the other and write them to a PNG file."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(4)
    window.SetNumberOfLayers(len(renderers))
    window.SetSize(*size)
    for renderer in renderers:
        window.AddRenderer(renderer)
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(9)
    writer.Write()
    if writer.GetErrorCode() != 0:
        sys.exit(f"render.py: the picture '{path}' cannot be written; check "
                 "its folder and free space.")


def show_edges(rock, scale):
    """Show the edges of cells that are at least ten pixels long."""
    points = vtk_to_numpy(rock.GetMapper().GetInput().GetPoints().GetData())
    n = 4 if numpy.ptp(points[:, 2]) == 0. else 8
    length = numpy.linalg.norm(points[1::n] - points[::n], axis=1)
    is_coarse = numpy.median(length) * scale >= 10.
    rock.GetProperty().SetEdgeVisibility(bool(is_coarse))


def describe(time, grid, view):
    """The caption."""
    factor = choose_exaggeration(grid, view)
    if view.field == "block" and time == 0.:
        n_blocks = len(numpy.unique(values_of(grid, "block")))
        lines = [f"{n_blocks} block{'s' if n_blocks > 1 else ''}"]
    else:
        lines = [f"t = {time:.4g} s"]
    if factor != 1.:
        lines.append(f"displacement times {factor:g}")
    if view.stretch != 1.:
        lines.append(f"heights times {view.stretch:g}")
    if view.tilt != 0.:
        lines.append(f"bed at {view.tilt:g} degrees")
    if view.explode > 0.:
        lines.append("drawn apart")
    text = "; ".join(lines)
    return text + ("" if view.field == "block" else
                   "\nred: first position of the blocks")


def draw(collection, picture, view):
    """Picture of one time of a collection; `view` says what it shows."""
    time, path = find_rock(collection, view.time_index)
    grid = read_grid(path)
    caption = describe(time, grid, view)
    is_flat = grid.GetBounds()[4] == grid.GetBounds()[5]
    is_block = view.field == "block"
    values, unit = shown_values(grid, view.field)
    factor = choose_exaggeration(grid, view)
    moved = move_points(grid, factor, view)
    first = moved if is_block else move_points(grid, 0., view)
    is_magnitude = values_of(grid, view.field).ndim > 1
    colours = make_colours(values, is_magnitude, view)
    actors = [make_rock(moved, values, colours, view),
              *make_outlines(first, DARK if is_block else RED)]
    if not is_block and not is_flat:
        actors += make_outlines(moved, DARK)
    if is_block and is_flat:
        actors += make_numbers(moved, view)
    places = numpy.vstack([vtk_to_numpy(g.GetPoints().GetData())
                           for g in (moved, first)])
    if view.box:
        places = corners_of(view.box, view.stretch)

    def make_texts(size):
        """Caption and colour bar for a size of the picture."""
        bar = make_bar(colours, f"{view.field} [{unit}]", size)
        return [make_caption(caption, size), *([] if is_block else bar)]

    write_picture(actors, make_texts, places, view, picture)


if __name__ == "__main__":
    draw(*read_arguments())

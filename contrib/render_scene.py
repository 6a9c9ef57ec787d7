# SPDX-License-Identifier: LGPL-2.1-or-later
"""Actors, texts, camera and files of the pictures of render.py."""
import math

import numpy
from render_data import (corners_of_cells, finite, merge_points, numpy_to_vtk,
                         outline_of, values_of, vtk_to_numpy)
from render_files import need_display, save
from vtkmodules import vtkRenderingFreeType  # noqa: F401, draws the text
from vtkmodules import vtkRenderingOpenGL2  # noqa: F401, draws the rest
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDecimatePolylineFilter, vtkStripper
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkBillboardTextActor3D, vtkColorTransferFunction,
    vtkDataSetMapper, vtkPolyDataMapper, vtkRenderer, vtkTextActor)

COLOURS = [(0.96, 0.96, 0.90), (0.74, 0.87, 0.75), (0.35, 0.71, 0.77),
           (0.20, 0.50, 0.74), (0.16, 0.36, 0.66)]
BAR = 0.2  # share of the width for the colour bar or the legend
NO_VALUE = (0.72, 0.72, 0.72)
MOST_LABELS = 30  # of more blocks only those that are exposed have numbers


def make_colours(values, is_magnitude, view):
    """Colours from the least to the greatest value; of magnitudes from 0."""
    colours = vtkColorTransferFunction()
    if view.field == "block":
        for number in range(1, int(values.max()) + 1):
            colour = view.block_colours[(number - 1) % len(view.block_colours)]
            colours.AddRGBPoint(number - 0.4, *colour)
            colours.AddRGBPoint(number + 0.4, *colour)
        return colours
    if view.field == "joint_state":
        colours.AddRGBPoint(0., 0.90, 0.89, 0.84)
        return colours
    values = finite(values)  # blocks without a factor are grey
    colours.SetNanColor(*NO_VALUE)
    low = 0. if is_magnitude else values.min(initial=numpy.inf)
    high = values.max(initial=-numpy.inf)
    low = low if numpy.isfinite(low) else 0.
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
    is_field = view.field not in ("block", "joint_state")
    rock.GetProperty().SetAmbient(0.8 if is_field else 0.5)
    rock.GetProperty().SetDiffuse(0.25 if is_field else 0.55)
    is_flat = grid.GetBounds()[4] == grid.GetBounds()[5]
    rock.GetProperty().SetLighting(not is_flat and (
        not is_field or view.has_depth()))
    return rock


def make_faces(polygons, colour, opacity=1., width=1.):
    """Actor of polygons, or of lines in a plane, of one colour."""
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    for polygon in polygons:
        cells.InsertNextCell(len(polygon))
        for place in polygon:
            cells.InsertCellPoint(points.InsertNextPoint(*map(float, place)))
    data.SetPoints(points)
    is_line = bool(len(polygons)) and len(polygons[0]) == 2
    (data.SetLines if is_line else data.SetPolys)(cells)
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().SetAmbient(0.5)
    actor.GetProperty().SetDiffuse(0.55)
    actor.GetProperty().SetLighting(not is_line)
    return actor


def make_legend(entries, size):
    """Squares of colours with what they mean, on the right."""
    line, texts = type_size(size), []
    for k, (colour, name) in enumerate(entries):
        height = size[1] - (2.4 + 1.9 * k) * line
        square, text = vtkTextActor(), vtkTextActor()
        square.SetInput("MM")
        square.SetPosition((1. - 0.98 * BAR) * size[0], height)
        style(square.GetTextProperty(), round(0.8 * line))
        square.GetTextProperty().SetColor(*colour)
        square.GetTextProperty().SetBackgroundColor(*colour)
        square.GetTextProperty().SetBackgroundOpacity(1.)
        text.SetInput(name)
        text.SetPosition((1. - 0.98 * BAR) * size[0] + 2.1 * line, height)
        style(text.GetTextProperty(), line)
        texts += [square, text]
    return texts


def make_bar(colours, title, size, n_above=0):
    """Colour bar on the right and its title, below entries of a legend."""
    line = type_size(size)
    above = (1.9 * n_above + 1.) * line if n_above else 0.
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetPosition(1. - 0.9 * BAR, 2. * line / size[1])
    bar.SetWidth(0.08)
    bar.SetHeight(1. - (6.5 * line + above) / size[1])
    style(bar.GetLabelTextProperty(), line)
    name = vtkTextActor()
    name.SetInput(title.replace(" [", "\n["))
    name.SetPosition((1. - 0.95 * BAR) * size[0], size[1] - 3.2 * line - above)
    style(name.GetTextProperty(), line)
    return [bar, name]


def make_caption(caption, size):
    """The caption below the picture."""
    text = vtkTextActor()
    text.SetInput(caption)
    text.SetPosition(0.02 * size[0], 0.5 * type_size(size))
    style(text.GetTextProperty(), type_size(size))
    return text


def make_outlines(grid, colour, width=1.5):
    """Actors of the outline of each block."""
    merged = merge_points(grid)
    for number in numpy.unique(values_of(merged, "block")):
        yield make_lines(outline_of(merged, number), colour, width)


def make_lines(edges, colour, width):
    """Actor of lines, straight ones in one piece."""
    lines, straight = vtkStripper(), vtkDecimatePolylineFilter()
    lines.SetInputData(edges)
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
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().LightingOff()
    return actor


def make_numbers(grid, view, exposed):
    """The number of each block on the cell farthest from its outline (2D).

    Blocks whose cells come no farther than a line of type have none; of many
    blocks those that are not exposed have none, too, and what is to be dug."""
    corners = corners_of_cells(grid)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    if view.box:
        low[:2], high[:2] = view.box[:2], view.box[2:]
    line = type_size(view.size) * max(high - low) / min(view.size)
    merged = merge_points(grid)
    centres, block = corners.mean(axis=1), values_of(grid, "block")[::4]
    labelled = numpy.setdiff1d(block, [0])
    is_exposed = numpy.isin(labelled, exposed)
    labelled = labelled[is_exposed] if len(labelled) > MOST_LABELS else (
        numpy.append(labelled[is_exposed], labelled[~is_exposed]))
    places = {}
    for number in labelled:
        mine = centres[block == number]
        outline = outline_of(merged, number)
        ends = vtk_to_numpy(outline.GetPoints().GetData())
        far = numpy.minimum((mine - low)[:, :2].min(axis=1),
                            (high - mine)[:, :2].min(axis=1))
        for end in ends:
            far = numpy.minimum(far, numpy.linalg.norm(mine - end, axis=1))
        if far.max() >= 0.6 * line:
            places[number] = mine[far.argmax()]
    return labels_at(places, line, view, True)


def labels_at(places, line, view, is_flat):
    """Labels of blocks at places, the first first, none over another."""
    axes, put = axes_of(view, is_flat), []
    for number, place in places.items():
        seen, half = axes[:2] @ place, 0.3 * line * len(str(int(number)))
        if all(abs(seen - other)[0] > half + width
               or abs(seen - other)[1] > line for other, width in put):
            put.append((seen, half))
            yield make_number(number, place, view)


def make_number(number, place, view):
    """The number of a block at a place."""
    text = vtkBillboardTextActor3D()
    text.SetInput(str(int(number)))
    text.SetPosition(*place)
    style(text.GetTextProperty(), type_size(view.size))
    text.GetTextProperty().SetJustificationToCentered()
    text.GetTextProperty().SetVerticalJustificationToCentered()
    return text


def numbers_in_space(grid, view, exposed):
    """The numbers of exposed blocks before them, towards the eye (3D)."""
    corners = corners_of_cells(grid)
    block = values_of(grid, "block")[::8]
    shown = corners[numpy.isin(block, exposed)].reshape(-1, 3)
    towards, places = axes_of(view, False)[2], {}
    for number in numpy.intersect1d(block, exposed):
        mine = corners[block == number].reshape(-1, 3)
        middle = 0.5 * (mine.min(axis=0) + mine.max(axis=0))
        places[number] = middle + 1.1 * towards * (
            (mine - middle) @ towards).max()
    line = type_size(view.size) * numpy.ptp(shown, axis=0).max(
        initial=0.) / min(view.size) if len(shown) else 0.
    return labels_at(places, line, view, False)


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


def axes_of(view, is_flat):
    """Axes of the camera: to the right, upwards, towards the eye."""
    back = numpy.array((0., 0., 1.) if is_flat else view.eye)
    angle = math.radians(view.tilt)
    up = numpy.array((-math.sin(angle), math.cos(angle), 0.) if is_flat else
                     (0., 0., 1.))
    back /= numpy.linalg.norm(back)
    right = numpy.cross(up, back)
    right /= numpy.linalg.norm(right)
    return numpy.array((right, numpy.cross(back, right), back))


def extents(places, view, is_flat):
    """Middle, width and height of places as the camera sees them; its axes."""
    axes = axes_of(view, is_flat)
    low, high = (places @ axes.T).min(axis=0), (places @ axes.T).max(axis=0)
    return axes.T @ (0.5 * (low + high)), *(high - low)[:2], axes


def corners_of(box, stretch):
    """The corners of a box given by its least and greatest coordinates."""
    n = len(box) // 2
    low, high = ((*box[:n], 0.)[:3], (*box[n:], 0.)[:3])
    return numpy.array([[x, y * stretch, z] for x in (low[0], high[0])
                        for y in (low[1], high[1]) for z in (low[2], high[2])])


def aim_inside(camera, inside):
    """Stand in a tunnel and look along it."""
    place, along = inside
    camera.ParallelProjectionOff()
    camera.SetViewAngle(75.)
    camera.SetPosition(*place)
    camera.SetFocalPoint(*(place + along))
    camera.SetViewUp(0., 0., 1.)


def aim(camera, centre, axes, extent, half_height):
    """Look at a centre along the third axis, with the second upwards."""
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(centre + axes[2] * 2. * extent))
    camera.SetViewUp(*axes[1])
    camera.SetParallelScale(half_height)


def write_picture(actors, make_texts, places, view, path, inside=None):
    """Draw actors, all places in view, and texts on white; write a file.

    The height shrinks to what flat places need. With a place inside and a
    direction the camera stands there."""
    need_display()
    width, height = (int(n) for n in view.size)
    foot = 3.6 * type_size(view.size)
    is_flat = numpy.ptp(places[:, 2]) == 0.
    centre, wide, high, axes = extents(places, view, is_flat)
    across = width * (1. - BAR if view.has_side() else 1.)
    scale = 0.95 * min(across / wide, (height - foot) / max(high, 1e-9 * wide))
    if inside is None:
        height = int(min(height, max(foot + scale * high / 0.95, 0.4 * width)))
    sheet, renderer = vtkRenderer(), vtkRenderer()
    sheet.SetBackground(1., 1., 1.)
    renderer.SetViewport(0., foot / height, across / width, 1.)
    renderer.SetLayer(1)
    if inside is None:
        aim(renderer.GetActiveCamera(), centre, axes, wide + high,
            0.5 * (height - foot) / scale)
    else:
        aim_inside(renderer.GetActiveCamera(), inside)
    for actor in actors:
        renderer.AddActor(actor)
    if view.mesh == "auto" and view.field not in ("block", "joint_state") and (
            not view.has_depth()):
        show_edges(actors[0], scale)
    for text in make_texts((width, height)):
        sheet.AddActor2D(text)
    renderer.ResetCameraClippingRange()
    is_seen_through = view.field == "joint_state" and not is_flat
    # of transparent things the nearer over the farther
    if view.has_depth() or is_seen_through:
        renderer.SetUseDepthPeelingForVolumes(False)
        renderer.UseDepthPeelingOn()
        renderer.SetMaximumNumberOfPeels(12)
    save([sheet, renderer], (width, height), path, view.dpi)


def show_edges(rock, scale):
    """Show the edges of cells that are at least ten pixels long."""
    points = vtk_to_numpy(rock.GetMapper().GetInput().GetPoints().GetData())
    n = 4 if numpy.ptp(points[:, 2]) == 0. else 8
    length = numpy.linalg.norm(points[1::n] - points[::n], axis=1)
    is_coarse = numpy.median(length) * scale >= 10.
    rock.GetProperty().SetEdgeVisibility(bool(is_coarse))

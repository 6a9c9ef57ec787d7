# SPDX-License-Identifier: LGPL-2.1-or-later
"""What of the rock render.py shows: cut open, blocks, tunnel, joints, states."""
import csv
import pathlib

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import (vtkImplicitBoolean, vtkPlane,
                                           vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import (vtkCleanPolyData, vtkClipPolyData,
                                       vtkCutter, vtkFeatureEdges)
from vtkmodules.vtkFiltersExtraction import vtkExtractCells
from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet

from render_data import (corners_of_cells, fail, find_joints, find_rock,
                         make_grid, merge_points, outline_of, read_classes,
                         read_grid, values_of)
from report.geometry import DOWN, FACES, is_shaft
from report.polygons import clip_polygon
from report.reading import ReportError
from report.run_files import groups_of
from report.vtu import read_cells, read_polygons

JOINT_STATES = ("bonded", "sticking", "sliding", "open")
STATE_COLOURS = [(0.45, 0.45, 0.45), (0.13, 0.53, 0.90), (0.90, 0.49, 0.),
                 (0.83, 0.07, 0.35)]
# of joints by set, as in reports
SET_COLOURS = [(0.20, 0.13, 0.53), (0.80, 0.40, 0.47), (0.07, 0.47, 0.20),
               (0.87, 0.67, 0.20), (0.53, 0.80, 0.93), (0.53, 0.13, 0.33),
               (0.27, 0.67, 0.60), (0.47, 0.47, 0.47)]


def keep_cells(grid, chosen):
    """The chosen cells of a grid."""
    numbers, part = vtkIdList(), vtkExtractCells()
    for number in numpy.flatnonzero(chosen):
        numbers.InsertNextId(int(number))
    part.SetInputData(grid)
    part.SetCellList(numbers)
    part.Update()
    result = vtkUnstructuredGrid()
    result.ShallowCopy(part.GetOutput())
    return result


def keep_blocks(grid, numbers):
    """The cells of blocks."""
    n = len(corners_of_cells(grid)[0])
    block = numpy.rint(values_of(grid, "block")).astype(int)[::n]
    return keep_cells(grid, numpy.isin(block, numbers))


def plane_of(grid, cut, eye):
    """A plane by its axis and place, None in the middle; normal from the eye."""
    axis, place = cut
    k, plane, normal = "xyz".index(axis), vtkPlane(), numpy.zeros(3)
    low, high = numpy.reshape(grid.GetBounds(), (3, 2)).T
    origin = 0.5 * (low + high)
    if place is not None:
        origin[k] = place
    normal[k] = -1. if eye[k] >= 0. else 1.
    plane.SetOrigin(*origin)
    plane.SetNormal(*normal)
    return plane


def clipped(grid, plane, is_inside):
    """The part of a grid on one side of a plane."""
    clip = vtkTableBasedClipDataSet()
    clip.SetInputData(grid)
    clip.SetClipFunction(plane)
    clip.SetInsideOut(is_inside)
    clip.Update()
    result = vtkUnstructuredGrid()
    result.ShallowCopy(clip.GetOutput())
    return result


def cut_open(grid, cuts, eye):
    """The grid without the part towards the eye of all planes at a time.

    Of two planes a quarter of the rock goes, of three an eighth. As parts of a
    grid, for what is beyond the first plane, of the rest the second, ..."""
    left, parts = grid, []
    for cut in cuts:
        plane = plane_of(grid, cut, eye)
        parts.append(clipped(left, plane, False))
        left = clipped(left, plane, True)
    parts = [part for part in parts if part.GetNumberOfCells()]
    if not parts:
        fail("the cuts leave nothing of the rock.")
    return parts


def section_lines(grid, cuts, eye):
    """Lines between blocks on planes that cut a grid, and on what is left."""
    planes = [plane_of(grid, cut, eye) for cut in cuts]
    removed = vtkImplicitBoolean()
    removed.SetOperationTypeToIntersection()
    for plane in planes:
        removed.AddFunction(plane)
    merged, found = merge_points(grid), []
    for number in numpy.unique(values_of(merged, "block")):
        found.append((outline_of(merged, number), removed))
        block = keep_cells(grid, numpy.abs(values_of(grid, "block")[
            ::len(corners_of_cells(grid)[0])] - number) < 0.5)
        for plane in planes:
            others = [other for other in planes if other is not plane]
            rest = vtkImplicitBoolean()
            rest.SetOperationTypeToIntersection()
            for other in others:
                rest.AddFunction(other)
            cutter, edges = vtkCutter(), vtkFeatureEdges()
            cutter.SetInputData(block)
            cutter.SetCutFunction(plane)
            cleaner = vtkCleanPolyData()
            cleaner.SetInputConnection(cutter.GetOutputPort())
            cleaner.SetTolerance(1e-5)  # of the size
            edges.SetInputConnection(cleaner.GetOutputPort())
            edges.FeatureEdgesOff()
            edges.ColoringOff()
            edges.Update()
            found.append((edges.GetOutput(), rest if others else None, True))
    return [clip_lines(*one) for one in found]


def clip_lines(lines, function, is_inside=False):
    """The part of lines on one side of a function, all without one."""
    if function is None:
        return lines
    clip = vtkClipPolyData()
    clip.SetInputData(lines)
    clip.SetClipFunction(function)
    clip.SetInsideOut(is_inside)
    clip.Update()
    return clip.GetOutput()


def key_of(points):
    """Places as words to compare, rounded to single precision."""
    return numpy.ascontiguousarray(points, numpy.float32).view(
        [("", numpy.float32)] * points.shape[1]).ravel()


def dug_cells(collection, grid):
    """Corners of the cells that are there at first and not in this state."""
    first = corners_of_cells(read_grid(find_rock(collection, 0)[1]))
    left = corners_of_cells(grid)
    key = [key_of(c.mean(axis=1) + 0.) for c in (first, left)]
    return first[~numpy.isin(*key)]


def exposed_blocks(collection, grid):
    """Numbers of the blocks that are exposed, by the summary.json beside the
    collection; without one those beside what is dug, now or later, that do not
    reach the edge of a plane model."""
    _, exposed = read_classes(collection)
    corners = corners_of_cells(grid)
    if exposed is not None or corners.shape[1] != 4:
        return exposed or []
    block = values_of(grid, "block")[::4]
    dug = numpy.vstack([dug_cells(collection, grid), corners[block == 0]])
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    at_edge = (numpy.isclose(corners, low) | numpy.isclose(corners, high))[
        :, :, :2].any(axis=(1, 2))
    beside = numpy.isin(key_of(corners.reshape(-1, 3) + 0.), key_of(
        dug.reshape(-1, 3) + 0.)).reshape(block.size, 4).sum(axis=1) > 1
    return numpy.setdiff1d(block[beside], [0, *block[at_edge]])


def place_inside(collection, grid):
    """A place near one end of what is dug, and the direction of its length.

    Near the top of a shaft, which is higher than long by half, and down."""
    dug = dug_cells(collection, grid)
    if not len(dug):
        fail("nothing is dug at this time, so there is no tunnel to look "
             "into.")
    centres = dug.mean(axis=1).astype(float)
    middle = 0.5 * (centres.min(axis=0) + centres.max(axis=0))
    level = centres - middle
    level[:, 2] = 0.
    along = numpy.linalg.svd(level, full_matrices=False)[2][0]
    along *= numpy.sign(along[abs(along).argmax()])
    if is_shaft(dug.reshape(-1, 3), along):
        along = DOWN
    ends = dug.reshape(-1, 3) @ along
    return middle + (ends.min() - middle @ along
                     + 0.03 * numpy.ptp(ends)) * along, along


def surface_of(grid, is_wanted):
    """Faces of the rock next to no other cell, those that are wanted, as a
    grid of quadrilaterals with the fields at their corners."""
    corners = corners_of_cells(grid)
    local = numpy.array(FACES[8])
    _, number = numpy.unique(key_of(corners.reshape(-1, 3) + 0.),
                             return_inverse=True)
    vertex = number.reshape(len(corners), -1)[:, local].reshape(-1, 4)
    order = numpy.sort(vertex, axis=1)
    _, first, counts = numpy.unique(order, axis=0, return_index=True,
                                    return_counts=True)
    alone = first[counts == 1]
    faces = corners[:, local].reshape(-1, 4, 3)[alone]
    keep = is_wanted(faces)
    data, names = grid.GetPointData(), {}
    for i in range(data.GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetArray(i))
        values = values.reshape(len(corners), 8, -1)[:, local].reshape(
            -1, 4, values.size // len(corners) // 8)
        names[data.GetArrayName(i)] = values[alone][keep]
    return make_grid(faces[keep], names) if keep.any() else None


def tunnel_surface(grid, first):
    """Free faces of the rock within the box of the first state, or None."""
    low, high = corners_of_cells(first).reshape(-1, 3).min(
        axis=0), corners_of_cells(first).reshape(-1, 3).max(axis=0)
    step = 1e-5 * (high - low).max()

    def is_inside(faces):
        on_hull = numpy.zeros(len(faces), bool)
        for bound in (low, high):
            on_hull |= (abs(faces - bound) < step).all(axis=1).any(axis=1)
        return ~on_hull

    return surface_of(grid, is_inside)


def joint_rows(collection):
    """The rows of joints.csv beside a collection."""
    try:
        with open(pathlib.Path(collection).parent / "joints.csv",
                  encoding="utf-8") as file:
            return [{name.split(" (")[0]: value for name, value in
                     row.items() if name} for row in csv.DictReader(file)]
    except (OSError, csv.Error):
        return []


def joint_planes(collection, low, high):
    """Name of each set of joints, and the polygons of its joints in a box."""
    path = pathlib.Path(collection).parent / "joints.vtu"
    try:
        polygons, fields = read_polygons(path, ["joint"])
    except ReportError as error:
        fail(str(error))
    names, group = groups_of(joint_rows(collection))
    found = {name: [] for name in names}
    for polygon, joint in zip(polygons, fields["joint"]):
        polygon = clip_polygon(polygon, low, high)
        if polygon:
            found[names[group[int(joint)]]].append(polygon)
    return {name: polygons for name, polygons in found.items() if polygons}


def state_numbers(fields):
    """Number in JOINT_STATES of each face of joints, -1 where none is known.

    The worst of a face's points, as an open one is seen better. Points that are
    welded or at the tip of a joint have none."""
    state = numpy.rint(fields["state"]).astype(int)
    return numpy.where(state < len(JOINT_STATES), state, -1).max(axis=1)


def joint_faces(collection, time):
    """Corners of the faces of joints at a time, and the state of each."""
    path = find_joints(collection, time)
    if path is None:
        return numpy.empty((0, 4, 3)), numpy.empty(0, int)
    try:
        corners, fields = read_cells(path)
    except ReportError as error:
        fail(str(error))
    if not len(corners):
        return corners, numpy.empty(0, int)
    return corners, state_numbers(fields)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grids of the states of a run for render.py: read, measured, moved, outlined."""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

try:
    import numpy
except ImportError as error:
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: numpy cannot be loaded "
             f"({error}); install the package python3-numpy and use the "
             "system's Python, /usr/bin/python3.")
try:
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkDataObject,
                                               vtkUnstructuredGrid)
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkThreshold
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
except ImportError as error:
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: VTK cannot be loaded ({error});"
             " install the package python3-vtk9 and use the system's Python, "
             "/usr/bin/python3.")

from report.reading import ReportError
from report.run_files import entries_of
from report.vtu import read_cells, split_stress, stress_of

KINDS = {2: 3, 4: 9, 8: 12}  # VTK's numbers of lines, quadrilaterals, hexahedra
# fields that are made of others: largest and least pressure of any direction
PRINCIPAL = {"stress_major": 0, "stress_minor": 2}
MOST_TIMES = 1000.  # of displacements without a factor asked for
UNITS = {"stress": (("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.)),
         "displacement": (("m", 0.1), ("mm", 1e-3), ("\N{MICRO SIGN}m", 1e-6))}


def fail(sentence):
    """End the program with a sentence and exit code 1."""
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {sentence}")


def find_rock(collection, index):
    """Time and file of the rock piece number `index` of a PVD file."""
    try:
        root = xml.etree.ElementTree.parse(collection).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        fail(f"'{collection}' cannot be read: {error}.")
    sets = [s for s in root.iter("DataSet") if s.get("name", "rock") == "rock"]
    if not -len(sets) <= index < len(sets):
        fail(f"'{collection}' holds {len(sets)} times; there is no time "
             f"index {index}.")
    folder = pathlib.Path(collection).parent
    return float(sets[index].get("timestep")), folder / sets[index].get("file")


def stage_of(collection, index):
    """The stage after which or in which a state was written, in words.

    None in collections that do not name stages."""
    root = xml.etree.ElementTree.parse(collection).getroot()
    sets = [s for s in root.iter("DataSet") if s.get("name", "rock") == "rock"]
    name = sets[index].get("group")
    if not name or name == "start":
        return "before the first stage" if name else None
    last = max(i for i, s in enumerate(sets) if s.get("group") == name)
    return ("after " if index % len(sets) == last else "in ") + name


def kind_of_stage(collection, name):
    """Kind of a stage by the used.prm beside a collection, or None."""
    path = pathlib.Path(collection).parent / "used.prm"
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return None
    return {entry: value for entry, value, _ in entries_of(text)}.get(
        f"Stages/{name}/Kind")


def find_joints(collection, time):
    """File of the joint faces of a state, or None."""
    for one in xml.etree.ElementTree.parse(collection).getroot().iter("DataSet"):
        if (one.get("name") == "interface"
                and float(one.get("timestep")) == time):
            return pathlib.Path(collection).parent / one.get("file")
    return None


def read_classes(collection):
    """Numbers of the finite blocks and of those that are exposed.

    By the summary.json beside the collection; None, None without one."""
    path = pathlib.Path(collection).parent / "summary.json"
    try:
        blocks = json.loads(path.read_text(encoding="utf-8"))["blocks"]
        finite = [b["id"] for b in blocks if not {"infinite", "rigid"} & set(
            b.get("class", []))]
        return finite, [b["id"] for b in blocks if b["id"] in set(finite)
                        and "exposed_stage" in b]
    except (OSError, ValueError, KeyError, TypeError):
        return None, None


def make_grid(corners, fields):
    """A grid in which each cell has points of its own, with fields at them."""
    n_cells, n = corners.shape[:2]
    grid, places, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(numpy.ascontiguousarray(corners.reshape(-1, 3)),
                                deep=True))
    cells.SetData(n, numpy_to_vtk(numpy.arange(n_cells * n), deep=True))
    grid.SetPoints(places)
    grid.SetCells(KINDS[n], cells)
    for name, values in fields.items():
        values = values.reshape(n_cells * n, -1)
        if values.shape[1] == 1:
            values = values[:, 0]
        put_field(grid, name, numpy.ascontiguousarray(values, numpy.float32))
    return grid


def put_field(grid, name, values):
    """Add a field at the points of a grid."""
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    grid.GetPointData().AddArray(array)


def read_grid(path):
    """The cells of a .vtu or .pvtu file; the program ends if it has none."""
    if not path.exists():
        fail(f"the file '{path}' does not exist.")
    try:
        corners, fields = read_cells(path)
    except ReportError as error:
        fail(str(error))
    if not len(corners) or corners.shape[1] not in KINDS:
        fail(f"the file '{path}' has no cells; it is empty, damaged, or "
             "pieces of it are missing.")
    return make_grid(corners, split_stress(fields))


def corners_of_cells(grid):
    """Corners (cells, n, 3) of a grid that was read."""
    n = grid.GetCell(0).GetNumberOfPoints()
    return vtk_to_numpy(grid.GetPoints().GetData()).reshape(-1, n, 3)


def principal_of(grid, names):
    """Principal pressures of the points, the largest first, or None."""
    stress = stress_of({name: vtk_to_numpy(grid.GetPointData().GetArray(name))
                        for name in names if name.startswith("stress_")})
    if stress is None:
        return None
    return -numpy.linalg.eigvalsh(stress)


def fields_of(grid):
    """What --field takes, besides components of vectors."""
    data = grid.GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    if principal_of(grid, names) is not None:
        names += PRINCIPAL
    return [*names, "joint_state"]


def values_of(grid, field):
    """Values of a field or of one component of it at the points."""
    data = grid.GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    if field in names:
        return vtk_to_numpy(data.GetArray(field))
    if field in PRINCIPAL:
        pressures = principal_of(grid, names)
        if pressures is not None:
            return pressures[:, PRINCIPAL[field]]
    name, _, component = field.rpartition("_")
    if (name not in names or component not in ("x", "y", "z") or
            data.GetArray(name).GetNumberOfComponents() != 3):
        fail(f"there is no field '{field}'; there are {', '.join(fields_of(grid))}.")
    return vtk_to_numpy(data.GetArray(name))[:, "xyz".index(component)]


def magnitudes_of(grid, field):
    """Values of a field at the points, of a vector their lengths."""
    values = values_of(grid, field).astype(float)
    return numpy.linalg.norm(values, axis=1) if values.ndim > 1 else values


def finite(values):
    """The values that are numbers; a block without a factor has none."""
    return values[numpy.isfinite(values)]


def unit_of(grid, field):
    """Name and size of the unit in which a field's values read well."""
    kind = field.split("_")[0]
    largest = abs(finite(magnitudes_of(grid, field))).max(initial=0.)
    for name, size in UNITS.get(kind, ()):
        if largest >= size:
            return name, 1. if name == "m" else size
    return UNITS[kind][-1] if kind in UNITS else (
        "m/s" if kind == "velocity" else "-", 1.)


def round_factor(value):
    """The nearest of 1, 2, 5, 10, 20, ...; at least 1."""
    choices = [m * 10**k for k in range(12) for m in (1, 2, 5)]
    return min(choices, key=lambda c: abs(math.log(c / max(value, 1.))))


def choose_exaggeration(grid, view, shown=None):
    """The factor asked for, or one that makes the displacement visible.

    The largest displacement of what is shown (grids, all without) becomes 6 % of
    the size of that: what is small in a large model is not turned inside out."""
    if view.exaggeration > 0.:
        return view.exaggeration
    shown = shown or [grid]
    places = numpy.vstack([vtk_to_numpy(g.GetPoints().GetData())
                           for g in shown])
    lengths = numpy.ptp(places, axis=0)
    if view.box:
        n = len(view.box) // 2
        lengths = numpy.subtract(view.box[n:], view.box[:n])
    largest = max(numpy.linalg.norm(values_of(g, "displacement"), axis=1).max()
                  for g in shown)
    return (round_factor(min(0.06 * max(lengths) / largest, MOST_TIMES))
            if largest > 0. else 1.)


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



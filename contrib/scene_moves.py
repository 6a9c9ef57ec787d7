# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moves of a scene in space: mirrored, turned or shifted, with gravity, supports
and loads. All vectors are lists of two or three numbers, lengths in metres."""
import math

from scene_domain import CannotExpress, move_boundaries, move_directions, move_domain
from scene_formula import (combination, components_of, coordinates_from,
                           substitute)
from scene_tree import numbers_of, points_of, text_of_points

# what the entries with a place or direction are; those of the domain, of
# excavations and supports have functions of their own
POINTS = {"Supports/NAME/Center", "Joints/NAME/Point", "Joints/NAME/Vertices",
          "Bolts/NAME/Heads", "Bolts/NAME/Ends"}
VECTORS = {"Safety factor/Seismic coefficient", "Stages/NAME/Seismic coefficient",
           "Joints/NAME/Normal", "Bolts/NAME/Direction", "Bolts/NAME/Axis"}
VECTOR_FORMULAS = {"Initial state/Gravity", "Initial state/Velocity",
                   "Materials/NAME/Rigid velocity", "Supports/NAME/Displacement",
                   "Supports/NAME/Velocity", "Tractions/NAME/Traction"}
SCALAR_FORMULAS = {"Mesh/Refinement levels", "Materials/NAME/Region",
                   "Supports/NAME/Region", "Bolts/NAME/Region",
                   "Shotcrete/NAME/Region", "Tractions/NAME/Region",
                   "Joints/NAME/Water pressure", "Joint sets/NAME/Water pressure",
                   "Excavations/NAME/Formula"}
ELEVATION_FORMULAS = {"Water/Level", "Stages/NAME/Water level",
                      "Joints/NAME/Water level", "Joint sets/NAME/Water level"}
# (row, column) of the components of a stress
STRESS = {2: [(0, 0), (1, 1), (2, 2), (0, 1)],
          3: [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]}


class Move:
    """x' = Q x + s, with an orthogonal matrix Q and a shift s [m]."""

    def __init__(self, matrix, shift=None):
        self.matrix = matrix
        self.dim = len(matrix)
        self.shift = list(shift) if shift else [0.] * self.dim
        self.keeps_plumb = all(abs(matrix[-1][j] - (j == self.dim - 1)) < 1e-12
                               for j in range(self.dim))
        self.turns = any(abs(abs(matrix[i][i]) - 1.) > 1e-12
                         for i in range(self.dim))
        self.mirrors = determinant(matrix) < 0.

    def vector(self, v):
        """A direction after the move."""
        return [sum(q * c for q, c in zip(row, v)) for row in self.matrix]

    def point(self, p):
        """A place after the move [m]."""
        return [c + s for c, s in zip(self.vector(p), self.shift)]

    def back(self, p):
        """The place before the move [m]."""
        rest = [c - s for c, s in zip(p, self.shift)]
        return [sum(self.matrix[i][j] * rest[i] for i in range(self.dim))
                for j in range(self.dim)]

    def old_coordinates(self):
        """Formulas of the old coordinates in the new ones."""
        transposed = [[self.matrix[j][i] for j in range(self.dim)]
                      for i in range(self.dim)]
        offsets = [-sum(t * s for t, s in zip(row, self.shift))
                   for row in transposed]
        return coordinates_from(transposed, offsets, "xyz"[:self.dim])

    def scalar_formula(self, text):
        """A formula of places whose value stays."""
        return substitute(text, self.old_coordinates())

    def vector_formula(self, text):
        """A formula of places with one component for each axis."""
        parts = [self.scalar_formula(part) for part in components_of(text)]
        return "; ".join(combination(row, parts) for row in self.matrix)

    def stress_formula(self, text):
        """The components of a stress, tension positive."""
        parts = [self.scalar_formula(part) for part in components_of(text)]
        pairs = STRESS[self.dim]
        q = [list(row) + [0.] * (3 - self.dim) for row in self.matrix]
        if self.dim == 2:
            q.append([0., 0., 1.])
        turned = []
        for a, b in pairs:
            factors = [q[a][i] * q[b][j] + (q[a][j] * q[b][i] if i != j else 0.)
                       for i, j in pairs]
            turned.append(combination([round_off(f) for f in factors], parts))
        return "; ".join(turned)


def round_off(value):
    """Zero for what is one but for round-off."""
    return 0. if abs(value) < 1e-15 else value


def determinant(m):
    """The determinant of a matrix of two or three rows."""
    if len(m) == 2:
        return m[0][0] * m[1][1] - m[0][1] * m[1][0]
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3]
                          - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
               for i in range(3))


def turn_about(axis, degrees):
    """The matrix of a turn in 3D about an axis by an angle [deg], and in 2D
    counterclockwise (axis None)."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    if axis is None:
        return [[c, -s], [s, c]]
    norm = math.sqrt(sum(a * a for a in axis))
    x, y, z = (a / norm for a in axis)
    d = 1. - c
    return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s],
            [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d]]


def stress_by_depth(tree):
    """The initial stress that grows with depth, as formulas [Pa]; empty: there
    is none."""
    state = "Initial state/"
    gradient = float(tree.get(state + "Vertical stress gradient", "0"))
    surface = float(tree.get(state + "Surface stress", "0"))
    if tree.get(state + "Stress") or (gradient == 0. and surface == 0.):
        return tree.get(state + "Stress")
    dim = int(tree.get("Dimension"))
    elevation = float(tree.get(state + "Surface elevation", "0"))
    ratios = numbers_of(tree.get(state + "Lateral ratios", "1"))
    vertical = (f"-({surface!r}+{gradient!r}*({elevation!r}-{'xyz'[dim - 1]}))")
    along, across = ratios[0], ratios[-1]
    if dim == 2:
        factors = [along, 1., across, 0.]
    else:
        azimuth = math.radians(float(tree.get(state + "Lateral azimuth", "90")))
        e, n = math.sin(azimuth), math.cos(azimuth)
        factors = [along * e * e + across * n * n, along * n * n + across * e * e,
                   1., 0., 0., (along - across) * e * n]
    return "; ".join(combination([round_off(f)], [vertical]) for f in factors)


def move_stress(tree, move, result):
    """The initial stress, as formulas where the move turns or mirrors it."""
    state = "Initial state/"
    if tree.get(state + "Measured points"):
        raise CannotExpress("the stress is fitted to a file of measured points")
    if move.turns or move.mirrors or tree.get(state + "Stress"):
        formulas = stress_by_depth(tree)
        if formulas:
            result.set(state + "Stress", move.stress_formula(formulas))
        for entry in ("Vertical stress gradient", "Surface stress",
                      "Surface elevation", "Lateral ratios", "Lateral azimuth"):
            result.remove(state + entry)
    else:
        elevation = float(tree.get(state + "Surface elevation", "0"))
        result.set(state + "Surface elevation", elevation + move.shift[-1])


def water_pressure(tree, level):
    """Pressure under a water table, as a formula [Pa]."""
    weight = tree.get("Water/Unit weight", "9810")
    height = "xyz"[int(tree.get("Dimension")) - 1]
    return f"{weight}*(({level})-{height})"


def move_water(tree, move, result):
    """Water tables; where the move does not keep the plumb line they become
    pressures in the joints."""
    levels = [(path, value) for path, value in tree.items()
              if generic(path) in ELEVATION_FORMULAS and value not in ("", "none")]
    if not levels:
        return
    if move.keeps_plumb:
        for path, value in levels:
            moved = move.scalar_formula(value)
            shift = move.shift[-1]
            result.set(path, f"({moved})+({shift!r})" if shift else moved)
        return
    if any(path.startswith("Stages/") for path, _ in levels):
        raise CannotExpress("stages have a water level, which is an elevation")
    table = tree.get("Water/Level")
    result.set("Water/Level", "")
    for name in tree.names("Joints"):
        joint = f"Joints/{name}/"
        level = tree.get(joint + "Water level")
        owner = f"Joint sets/{tree.get(joint + 'Set')}/"
        level = level or tree.get(owner + "Water level") or table
        pressure = (tree.get(joint + "Water pressure") or
                    tree.get(owner + "Water pressure"))
        result.set(joint + "Water level", "")
        if not pressure and level not in ("", "none"):
            pressure = water_pressure(tree, level)
        if pressure:
            result.set(joint + "Water pressure", move.scalar_formula(pressure))
    for name in tree.names("Joint sets"):
        result.remove(f"Joint sets/{name}/Water level")


def generic(path):
    """The path with NAME in the place of a name."""
    parts = path.split("/")
    return path if len(parts) < 3 else f"{parts[0]}/NAME/{parts[-1]}"


def dip_normal(tree, joint):
    """Unit normal of a joint that is given by dip and dip direction."""
    dim = int(tree.get("Dimension"))
    dip = math.radians(float(tree.get(joint + "Dip", "0")))
    azimuth = math.radians(float(tree.get(joint + "Dip direction", "90")))
    s, c = math.sin(dip), math.cos(dip)
    if dim == 2:
        return [s * round(math.sin(azimuth)), c]
    return [s * math.sin(azimuth), s * math.cos(azimuth), c]


def move_joints(tree, move, result):
    """Normals in place of dips; files of joints are in no resolved scene."""
    for name in tree.names("Joints"):
        joint = f"Joints/{name}/"
        if tree.get(joint + "Shape", "plane") != "plane":
            raise CannotExpress(f"the joint '{name}' is no plane in used.prm")
        if tree.get(joint + "Normal"):
            continue
        if tree.get(joint + "Extent", "infinite") != "polygon":
            result.set(joint + "Normal", move.vector(dip_normal(tree, joint)))
        for entry in ("Dip", "Dip direction"):
            result.remove(joint + entry)


def move_entry(path, value, move):
    """The value of an entry after the move; None: it stays."""
    kind = generic(path)
    if not value.strip():
        return None
    if kind in POINTS:
        return text_of_points([move.point(p) for p in points_of(value)])
    if kind in VECTORS:
        return text_of_points([move.vector(v) for v in points_of(value)])
    if kind in VECTOR_FORMULAS:
        return move.vector_formula(value)
    if kind in SCALAR_FORMULAS and not (
            value == "all" or value.startswith(("id ", "band "))):
        return move.scalar_formula(value)
    return None


def check_supports(tree, move):
    """Refuse supports that a move would have to rewrite in files."""
    for name in tree.names("Supports"):
        support = f"Supports/{name}/"
        if tree.get(support + "History file"):
            raise CannotExpress(f"the support '{name}' moves by a file")
        if tree.get(support + "Kind") == "free field" and not move.keeps_plumb:
            raise CannotExpress("a free field needs plumb sides")


def move_scene(tree, move, move_excavations, move_bolts):
    """The scene after a move.

    The functions `move_excavations` and `move_bolts` (tree, move, result) move
    what has a shape of its own."""
    check_supports(tree, move)
    result = tree.copy()
    for path, value in tree.items():
        moved = move_entry(path, value, move)
        if moved is not None:
            result.set(path, moved)
    names = move_domain(tree, move, result)
    move_boundaries(tree, result, names)
    move_directions(tree, move, result)
    move_stress(tree, move, result)
    move_water(tree, move, result)
    move_joints(tree, move, result)
    move_excavations(tree, move, result)
    move_bolts(tree, move, result)
    return result

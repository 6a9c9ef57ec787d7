# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stresses on the joint faces of blocks, for figures.py (plane scenes)."""
import numpy

from figures_run import values_of, vtk_to_numpy


def cells_of(grid):
    """Corners of quadrilaterals in order around them, and their blocks."""
    order = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return order.reshape(-1, 4), points[order].reshape(-1, 4, 3)


def sides_of_faces(grid, ends):
    """The cells on both sides of each face of the first state.

    Both files round the same places, so they are compared as they are."""
    wanted = {frozenset((tuple(a[:2]), tuple(b[:2]))): i
              for i, (a, b) in enumerate(ends.tolist())}
    sides = [[] for _ in ends]
    _, corners = cells_of(grid)
    near = numpy.unique(ends.reshape(-1, 3)[:, 0])
    is_near = numpy.isin(corners[:, :, 0], near).sum(axis=1) > 1
    for cell in numpy.flatnonzero(is_near):
        places = [tuple(p[:2]) for p in corners[cell].tolist()]
        for a, b in zip(places, places[1:] + places[:1]):
            face = wanted.get(frozenset((a, b)))
            if face is not None:
                sides[face].append(int(cell))
    return sides


def stress_before(grid, ends, sides):
    """Normal and shear stress of faces from that of the cells beside them."""
    order, _ = cells_of(grid)
    stress = {name: values_of(grid, f"stress_{name}")[order[:, 0]]
              for name in ("xx", "yy", "xy")}
    along = ends[:, 1] - ends[:, 0]
    normal = numpy.column_stack([-along[:, 1], along[:, 0]])
    normal /= numpy.linalg.norm(normal, axis=1)[:, None]
    mean = {name: numpy.array([values[cells].mean() if cells else 0.
                               for cells in sides])
            for name, values in stress.items()}
    traction = numpy.column_stack([
        mean["xx"] * normal[:, 0] + mean["xy"] * normal[:, 1],
        mean["xy"] * normal[:, 0] + mean["yy"] * normal[:, 1]])
    across = (traction * normal).sum(axis=1)
    shear = numpy.linalg.norm(traction - across[:, None] * normal, axis=1)
    return -across, shear


def face_stresses(run, state, sides, ends):
    """Normal and shear stress of each face in a state.

    Of the state before the first step, for which no contact forces were
    computed yet, from the initial stress of the rock."""
    _, fields = run.joints(state)
    normal, shear = (fields[name].mean(axis=1) for name in
                     ("pressure", "shear"))
    if state == 0 and not normal.any():
        return stress_before(run.rock(0), ends, sides)
    return normal, shear


def place_of_state(run, state, kind):
    """Where a state stands on the axis of the curves."""
    x = run.positions(kind)
    return float(numpy.interp(run.states[state][0], run.history["time"], x,
                              left=0.))


def block_face_stresses(run):
    """Places, mean normal and shear stresses by block and joint.

    A block that was taken away has them up to the stage before."""
    if (not run.is_plane or not run.history or not run.states or
            not run.summary["scene"].get("pairs")):
        return {}
    ends, fields = run.joints(0)
    length = numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    joint = fields["joint"].max(axis=1).astype(int)
    grid, names = run.rock(0), run.names("Joints")
    order, _ = cells_of(grid)
    block = values_of(grid, "block")[order[:, 0]]
    sides = sides_of_faces(grid, ends)
    beside = [{int(block[cell]) for cell in cells} for cells in sides]
    kind = run.axis_kind()
    states = range(len(run.states))
    x = numpy.array([place_of_state(run, s, kind) for s in states])
    stresses = numpy.array([face_stresses(run, s, sides, ends)
                            for s in states])
    result = {}
    for number in run.finite_blocks():
        removal = run.removal_stage(number)
        n = len(x) if removal is None else run.state_of_stage(removal)
        mine = numpy.array([number in blocks for blocks in beside])
        for j in numpy.unique(joint[mine]) if n > 1 else []:
            chosen = mine & (joint == j)
            share = length[chosen] / length[chosen].sum()
            normal, shear = (stresses[:n, :, chosen] @ share).T
            result.setdefault(number, {})[names[j]] = x[:n], normal, shear
    return result

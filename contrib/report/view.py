# SPDX-License-Identifier: LGPL-2.1-or-later
"""The geometry of the interactive view, packed for the page.

Vertices are places of a block's surface (2D: of all cells) that move alike;
their displacements by state are half-precision numbers in units of the largest.
Everything is one compressed block of bytes, described by a dictionary."""
import base64
import zlib

import numpy

from .geometry import FREE, unique_rows
from .html import escape
from .pictures import exaggeration
from .polygons import clip_polygon
from .style import GROUP_COLOURS
from .statics import statics_in_words
from .tables import STATES, in_words
from .words import mode_in_words, number, support_in_words

SHARP = 0.9  # faces at an edge that is drawn differ by more, as a cosine


class Packer:
    """Arrays one after the other, at multiples of eight bytes."""

    def __init__(self):
        self.bytes, self.index = bytearray(), {}

    def put(self, name, values, kind):
        """Add an array under a name."""
        values = numpy.ascontiguousarray(values, dtype=kind)
        self.bytes += b"\0" * (-len(self.bytes) % 8)
        self.index[name] = [numpy.dtype(kind).str[1:], len(self.bytes),
                            int(values.size)]
        self.bytes += values.tobytes()

    def text(self):
        """All of it, compressed, as text."""
        return base64.b64encode(zlib.compress(bytes(self.bytes), 9)).decode()


def vertices_of(geometry, cell, corner):
    """Numbers of distinct vertices at corners of cells, and where they are."""
    shape = corner.shape
    cell = numpy.broadcast_to(cell[:, None], shape).ravel()
    corner = corner.ravel()
    moved = numpy.nan_to_num(geometry.moved[:, cell, corner])
    # displacements that differ by rounding only are the same
    scale = float(abs(moved).max()) or 1.
    small = (moved / scale).astype(numpy.float16)
    rows = numpy.column_stack([
        geometry.vertex[cell, corner].astype(numpy.uint32),
        geometry.block[cell].astype(numpy.uint32),
        numpy.ascontiguousarray(numpy.moveaxis(
            small.astype(numpy.float32), 0, 1)).reshape(
                len(cell), -1).view(numpy.uint32)])
    first, index = unique_rows(rows)
    return (index.reshape(shape), geometry.corners[cell[first], corner[first]],
            small[:, first], scale)


def surfaces(geometry):
    """Cell, corners, states and outward normals of what is to be drawn."""
    if geometry.run.is_plane:
        cells = numpy.arange(len(geometry.block))
        seen = sum(there.astype(numpy.uint32) << numpy.uint32(k)
                   for k, there in enumerate(geometry.is_there))
        return cells, numpy.tile(numpy.arange(4), (len(cells), 1)), seen, None
    faces = numpy.flatnonzero(geometry.seen_in)
    return (geometry.face_cell[faces], geometry.face_corner[faces],
            geometry.seen_in[faces], faces)


def outlines(geometry, faces):
    """Edges to be drawn: cell, two corners, states, joint or -1.

    In 2D where blocks meet or rock is free; in 3D sharp edges of surfaces, and
    where they end."""
    if geometry.run.is_plane:
        found = numpy.flatnonzero(geometry.face_differs | (
            geometry.face_kind == FREE) | (geometry.face_joint >= 0))
        cell, other = geometry.face_cell[found], geometry.face_other[found]
        seen = numpy.zeros(len(found), numpy.uint32)
        is_joint = geometry.face_differs[found] | (
            geometry.face_joint[found] >= 0)
        for k, there in enumerate(geometry.is_there):
            is_free = (other < 0) | ~there[other]
            shown = there[cell] & (is_joint | is_free)
            seen[shown] |= numpy.uint32(1 << k)
        return (cell, geometry.face_corner[found], seen,
                geometry.face_joint[found])
    corner = geometry.face_corner[faces]
    pairs = numpy.stack([corner, numpy.roll(corner, -1, 1)], axis=2)
    pairs = pairs.reshape(-1, 2)
    face = numpy.repeat(numpy.arange(len(faces)), corner.shape[1])
    cell = geometry.face_cell[faces][face]
    normals = geometry.normals(faces)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None] + 1e-30
    ends = numpy.sort(geometry.vertex[cell[:, None], pairs], axis=1)
    owner = numpy.where(geometry.is_finite[cell], geometry.block[cell], 0)
    first, edge = unique_rows(numpy.column_stack([ends, owner]).astype(
        numpy.uint32))
    seen = numpy.zeros(len(first), numpy.uint32)
    of_face = geometry.seen_in[faces][face]
    for k in range(len(geometry.is_there)):
        mine = numpy.flatnonzero(of_face >> numpy.uint32(k) & 1)
        of_edge = numpy.full(len(first), -1)
        of_edge[edge[mine]] = face[mine]  # one of the faces of each edge
        along = (normals[face[mine]] * normals[of_edge[edge[mine]]]).sum(axis=1)
        is_sharp = numpy.bincount(edge[mine], minlength=len(first)) == 1
        is_sharp[edge[mine][along < SHARP]] = True
        seen[is_sharp] |= numpy.uint32(1 << k)
    keep = seen > 0
    return (cell[first][keep], pairs[first][keep], seen[keep],
            numpy.full(keep.sum(), -1))


def triangles_of(index):
    """Two triangles for each quadrilateral."""
    return numpy.concatenate([index[:, [0, 1, 2]], index[:, [0, 2, 3]]])


def group_of(run, joint):
    """The group of joints, counted from 1, of each joint; 0 for none."""
    group = numpy.array([0] + [g + 1 for g in run.joint_groups()[1]])
    return group[numpy.where(joint + 1 < len(group), joint + 1, 0)]


def put_stress(geometry, cell, packer):
    """Major principal stress behind each quadrilateral by state, in shares.

    Returns the range in Pa that 0 to 255 stand for, without the few cells
    beyond it; None without stress."""
    if geometry.pressure is None or not len(cell):
        return None
    values = geometry.pressure[:, cell]
    if numpy.isnan(values).all():
        return None
    low, high = (float(v) for v in numpy.nanpercentile(values, (0.5, 99.5)))
    share = (numpy.nan_to_num(values) - low) / (high - low or 1.)
    for k, one in enumerate(share):
        packer.put(f"stress_{k}", numpy.rint(255. * one.clip(0., 1.)), "u1")
    return [low, high]


def put_joints(geometry, packer, box):
    """Planes (2D: lines) of the joints as they are in the scene, in a box."""
    names, group = geometry.run.joint_groups()
    polygons, joints = geometry.joint_polygons()
    parts, groups = [], []
    for polygon, joint in zip(polygons, joints):
        polygon = numpy.array(clip_polygon(polygon, *box))
        if joint >= len(group) or not len(polygon):
            continue
        fan = ([polygon] if len(polygon) == 2 else
               [polygon[[0, i, i + 1]] for i in range(1, len(polygon) - 1)])
        parts += fan
        groups += [group[joint]] * len(fan)
    if parts:
        packer.put("joint_points", numpy.array(parts) - packer.centre, "f4")
        packer.put("joint_group", groups, "u1")
    return [{"name": name, "colour": GROUP_COLOURS[k % 8]}
            for k, name in enumerate(names)] if parts else []


def tight_box(geometry, box):
    """About what is seen of the excavation and the exposed blocks."""
    points = geometry.places[geometry.face_vertices[geometry.seen_in > 0]]
    points = points.reshape(-1, 3)
    if geometry.run.is_plane or not len(points):
        return box
    return (numpy.maximum(box[0], points.min(axis=0)),
            numpy.minimum(box[1], points.max(axis=0)))


def state_to_open(geometry, rows):
    """The last state in which a block with a factor is there, if any is."""
    judged = numpy.isin(geometry.block, [
        row["block"] for row in rows if row["factor"] or row["limit"]])
    found = (geometry.is_there & judged).any(axis=1).nonzero()[0]
    return int(found[-1]) if len(found) else len(geometry.is_there) - 1


def describe(run, row):
    """What the view says of a block that is clicked."""
    factor = row["factor"]
    return {
        "state": row["state"], "exposed": row["exposed"],
        "lines": [escape(text) for text in (
            f"exposed since {row['since']}" if row["exposed"] else "hidden",
            row["where"] or "",
            f"{number(row['volume'])} m³"
            + (" per m" if run.is_plane else ""),
            f"{number(row['weight'] / 1e3)} kN" if row["weight"] else "",
            mode_in_words(row["mode"]) or "",
            {True: "held by clamping", None: "", False: ""}[row["clamped"]],
            f"needs {support_in_words(row, run.is_plane)}"
            if row["demand"] or row["tried_demand"] else "",
            f"limit equilibrium {statics_in_words(row)}"
            if row["limit"] or row["passed"] else "",
            f"strength reduction {in_words(factor)} after {factor['stage']}"
            if factor else "",
            f"failed and taken away in {row['removed']}" if row["removed"]
            else f"moved off in {row['moved_off']}" if row["moved_off"]
            else f"still moving at the end of {row['moving']}" if row["moving"]
            else "") if text]}


def pack(geometry, rows):
    """Dictionary and text of the view."""
    run, packer = geometry.run, Packer()
    cell, corner, seen, faces = surfaces(geometry)
    line_cell, line_corner, line_seen, line_joint = outlines(geometry, faces)
    n_corners = corner.shape[1]
    every_cell = numpy.concatenate([numpy.repeat(cell, n_corners),
                                    numpy.repeat(line_cell, 2)])
    every_corner = numpy.concatenate([corner.ravel(), line_corner.ravel()])
    index, places, small, scale = vertices_of(geometry, every_cell,
                                              every_corner[:, None])
    index = index.ravel()
    quads = index[:cell.size * n_corners].reshape(-1, n_corners)
    lines = index[cell.size * n_corners:].reshape(-1, 2)
    box = geometry.box_of_interest()
    packer.centre = 0.5 * (box[0] + box[1]).astype(float)
    packer.put("places", places - packer.centre, "f4")
    for k, moved in enumerate(small):
        packer.put(f"moved_{k}", moved.view(numpy.uint16), "u2")
    packer.put("triangles", triangles_of(quads), "u4")
    packer.put("triangle_seen", numpy.tile(seen, 2), "u4")
    block = numpy.where(geometry.is_finite[cell], geometry.block[cell], 0)
    packer.put("triangle_block", numpy.tile(block, 2), "i4")
    joint = (numpy.full(len(cell), -1) if faces is None else
             geometry.face_joint[faces])
    packer.put("triangle_group", numpy.tile(group_of(run, joint), 2), "u1")
    stress = put_stress(geometry, cell, packer)
    packer.put("lines", lines, "u4")
    packer.put("line_seen", line_seen, "u4")
    packer.put("line_block", numpy.where(geometry.is_finite[line_cell],
                                         geometry.block[line_cell], 0), "i4")
    packer.put("line_group", group_of(run, line_joint), "u1")
    groups = put_joints(geometry, packer, box)
    inside = None if run.is_plane else geometry.place_inside()
    down = run.down()
    meta = {
        "plane": run.is_plane, "arrays": packer.index, "scale": scale,
        "centre": packer.centre.tolist(),
        "box": [(b - packer.centre).tolist() for b in box],
        "tight": [(b - packer.centre).tolist() for b in tight_box(
            geometry, box)],
        "up": [0., 1., 0.] if run.is_plane else (
            [0., 0., 1.] if down is None else (-down).tolist()),
        "stages": ["before the first stage" if i < 0 else
                   ("in " if run.is_within_stage(k) else "after ") + name
                   for k, (name, i, *_) in enumerate(run.states[:len(small)])],
        "opens": state_to_open(geometry, rows),
        "stress": stress, "exaggeration": exaggeration(geometry, box), "groups": groups,
        "colours": {key: [value[0], value[1]]
                    for key, value in STATES.items()},
        "order": [row["block"] for row in rows],
        "blocks": {row["block"]: describe(run, row)
                   for row in rows},
        "inside": inside and {
            "place": (inside[0] - packer.centre).tolist(),
            "along": inside[1].tolist()}}
    return meta, packer.text()

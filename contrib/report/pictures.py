# SPDX-License-Identifier: LGPL-2.1-or-later
"""A picture of the rock after each stage, without a display."""
import numpy

from .geometry import FREE
from .raster import nearest
from .style import GROUP_COLOURS, ROCK, as_png, new_figure, pyplot
from .tables import STATES

if pyplot:
    from matplotlib import patheffects
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.colors import to_rgb

DPI = 110
WIDTH, HEIGHT = 7.2, 5.2  # at most [inch]
ARROWS = 0.85  # of the axes [inch]
CAVERN = "#d8d3c8"
WATER = "#1f6fd0"


def round_factor(value):
    """The greatest of 1, 2, 5, 10, ... below a value, at least 1."""
    if not numpy.isfinite(value) or value < 2.:
        return 1.
    power = 10. ** numpy.floor(numpy.log10(value))
    return float(max(f for f in (1., 2., 5.) if f * power <= value) * power)


def exaggeration(geometry, box):
    """Factor with which the largest displacement about what is dug is seen."""
    moved = geometry.moved[:, geometry.is_finite | inside(geometry, box)]
    largest = numpy.linalg.norm(moved, axis=3)
    largest = numpy.nanmax(largest) if largest.size and not numpy.isnan(
        largest).all() else 0.
    size = numpy.max(box[1] - box[0])
    return round_factor(0.03 * size / largest) if largest > 0. else 1.


def inside(geometry, box):
    """Cells whose centre is in a box."""
    centres = geometry.corners.mean(axis=1)
    return ((centres >= box[0]) & (centres <= box[1])).all(axis=1)


def mix(colour, share):
    """A colour mixed with white."""
    return tuple(share * part + 1. - share for part in to_rgb(colour))


def put_labels(axes, labels, scale):
    """Numbers of blocks, the first first; those that would cover one not."""
    put = []
    for n, place in labels.items():
        if all(abs(place - other)[0] * scale > 0.28
               or abs(place - other)[1] * scale > 0.15 for other in put):
            put_label(axes, place, str(n))
            put.append(place)


def put_label(axes, place, text):
    """A number with a white rim."""
    axes.text(*place, text, ha="center", va="center", fontsize=9,
              weight="bold", zorder=9, clip_on=True, path_effects=[
                  patheffects.withStroke(linewidth=2.5, foreground="white")])


def draw_plane(geometry, rows, state, factor, box):
    """Cells, outlines of blocks by group of joints, and labels (2D)."""
    run = geometry.run
    names, group = run.joint_groups()
    style = {row["block"]: STATES[row["state"]][0] for row in rows}
    exposed = {row["block"] for row in rows if row["exposed"]}
    wide, high = (box[1] - box[0])[:2]
    scale = min(WIDTH / wide, HEIGHT / high)
    figure, axes = new_figure((scale * wide + 0.7, scale * high + 0.5))
    axes.set(aspect="equal", xlim=(box[0][0], box[1][0]),
             ylim=(box[0][1], box[1][1]), xlabel="x [m]", ylabel="y [m]")
    there = geometry.is_there[state] & inside(
        geometry, (box[0] - 0.2 * wide, box[1] + 0.2 * wide))
    moved = numpy.nan_to_num(geometry.moved[state])
    places = (geometry.corners + factor * moved)[:, :, :2]
    colours = numpy.array([to_rgb(ROCK)] * len(geometry.block))
    for n, colour in style.items():
        colours[geometry.block == n] = mix(colour, 0.85 if n in exposed else
                                           0.35)
    axes.add_collection(PolyCollection(
        places[there], facecolors=colours[there], edgecolors=colours[there],
        linewidths=0.3, zorder=1))
    # outlines: faces to other blocks, by group of their joint, and free ones
    beside = geometry.face_other
    is_free = (beside < 0) & (geometry.face_kind == FREE) | (
        beside >= 0) & ~geometry.is_there[state][beside]
    shown = there[geometry.face_cell] & (
        is_free | geometry.face_differs | (geometry.face_joint >= 0))
    joint = geometry.face_joint[shown]
    ends = places[geometry.face_cell[shown][:, None],
                  geometry.face_corner[shown]]
    is_free = is_free[shown]
    for k in range(len(names)):
        mine = ~is_free & (joint >= 0) & (
            numpy.array(group + [-1])[joint] == k)
        if mine.any():
            axes.add_collection(LineCollection(
                ends[mine], colors=GROUP_COLOURS[k % 8], linewidths=1.,
                zorder=3))
    axes.add_collection(LineCollection(
        ends[~is_free & (joint < 0)], colors="0.6", linewidths=0.6, zorder=2))
    dug = geometry.is_there[0] & ~geometry.is_there[state] & ~numpy.isin(
        geometry.block, list(style))
    rim = dug[geometry.face_cell] & (beside >= 0) & ~dug[beside]
    first = geometry.corners[geometry.face_cell[rim][:, None],
                             geometry.face_corner[rim]][:, :, :2]
    axes.add_collection(LineCollection(first, colors="0.45", linewidths=0.8,
                                       linestyles=[(0, (4, 2))], zorder=4))
    axes.add_collection(LineCollection(ends[is_free], colors="0.1",
                                       linewidths=1.6, zorder=5))
    labels = {}
    for n in (row["block"] for row in rows if row["exposed"]):
        mine = there & (geometry.block == n)
        if mine.any():
            centres = places[mine].mean(axis=1)
            middle = centres.mean(axis=0)
            labels[n] = centres[numpy.hypot(*(centres - middle).T).argmin()]
    put_labels(axes, labels, scale)
    level = water_level(run, state)
    if level is not None and box[0][1] <= level <= box[1][1]:
        axes.axhline(level, color=WATER, linewidth=1.3, zorder=6,
                     linestyle=(0, (6, 3)))
        axes.plot([0.03], [level + 0.09 / scale], "v", color=WATER,
                  markersize=7, zorder=6, clip_on=False,
                  transform=axes.get_yaxis_transform())
    return figure


def water_level(run, state):
    """Elevation of the water table after a state; None: none, or a formula."""
    last, level = run.states[state][1], run.entries.get("Water/Level", "")
    for name in run.stages[:last + 1]:
        level = run.entries.get(f"Stages/{name}/Water level", "") or level
    try:
        return float(level)
    except ValueError:
        return None


def camera(geometry, eye):
    """Axes of a view: to the right, upwards, towards the eye."""
    down = geometry.run.down()
    up = numpy.array((0., 0., 1.)) if down is None else -down
    back = numpy.array(eye) / numpy.linalg.norm(eye)
    right = numpy.cross(up, back)
    right /= numpy.linalg.norm(right)
    return numpy.array((right, numpy.cross(back, right), back))


def frame(geometry, factor, centre, axes3):
    """Least and greatest coordinates in the picture of all that is ever seen.

    The same for all stages, with blocks where they move to."""
    shown = geometry.seen_in > 0
    points = [geometry.places[geometry.face_vertices[shown]].reshape(-1, 3)]
    for moved in geometry.moved[:, geometry.is_finite]:
        place = geometry.corners[geometry.is_finite] + factor * moved
        place = place[~numpy.isnan(place[:, 0, 0])]
        points.append(place.reshape(-1, 3))
    seen = (numpy.concatenate(points) - centre) @ axes3[:2].T
    return seen.min(axis=0), seen.max(axis=0)


def draw_solid(geometry, rows, state, factor, box):
    """What is dug, seen into from outside, and the finite blocks (3D)."""
    style = {row["block"]: STATES[row["state"]][0] for row in rows}
    exposed = {row["block"] for row in rows if row["exposed"]}
    block = geometry.block[geometry.face_cell]
    shown = (geometry.seen_in & numpy.uint32(1 << state)) > 0
    if exposed and len(style) - len(exposed) > 12:
        # hundreds of hidden blocks would cover the rest
        shown &= ~numpy.isin(block, [n for n in style if n not in exposed])
    centre = 0.5 * (box[0] + box[1])
    axes3 = camera(geometry, choose_eye(geometry, exposed, centre))
    faces = numpy.flatnonzero(shown)
    normals = geometry.normals(faces)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None] + 1e-30
    # of rock only what turns towards the eye: one sees into the cavern
    is_block = numpy.isin(block[faces], list(style))
    keep = is_block | (normals @ axes3[2] > 0.)
    faces, normals = faces[keep], normals[keep]
    cell, corner = geometry.face_cell[faces], geometry.face_corner[faces]
    moved = numpy.nan_to_num(geometry.moved[state][cell[:, None], corner])
    points = geometry.corners[cell[:, None], corner] + factor * moved
    low, high = frame(geometry, factor, centre, axes3)
    scale = min(WIDTH / (high - low)[0], HEIGHT / (high - low)[1])  # inch/m
    fine = 2. * DPI * scale  # pixels per metre, two for one of the picture
    size = numpy.ceil(fine * (high - low)).astype(int) + 8

    def pixels_of(points):
        """The nearest of faces in each pixel, or -1."""
        seen = (points - centre) @ axes3.T
        seen = numpy.concatenate([
            fine * (seen[:, :, :1] - low[0]) + 4.,
            fine * (high[1] - seen[:, :, 1:2]) + 4., fine * seen[:, :, 2:]],
            axis=2)
        triangles = seen[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3)
        number = nearest(triangles, size)
        return numpy.where(number >= 0, number // 2, -1)

    number = pixels_of(points)
    light = axes3.T @ (numpy.array((-0.3, 0.5, 0.8)) / 0.99)
    shade = 0.7 + 0.3 * numpy.abs(normals @ light)
    base = numpy.array([to_rgb(CAVERN)] * (len(faces) + 1))
    for n, colour in style.items():
        base[:-1][block[faces] == n] = mix(colour, 1. if n in exposed else
                                           0.5)
    base[:-1] *= shade[:, None]
    base[-1] = 1.
    image = base[number]
    owner = numpy.append(numpy.where(numpy.isin(block[faces], list(style)),
                                     block[faces], 0), -1)[number]
    image[edges_of(owner, numpy.vstack([normals, numpy.zeros(3)])[number])] *= (
        0.45)
    later = later_faces(geometry, state, list(style))
    if geometry.run.digs() and len(later):
        image = behind(image, owner, pixels_of(
            geometry.places[geometry.face_vertices[later]]),
            geometry.normals(later), axes3)
    image = 0.25 * (image[::2, ::2][:size[1] // 2, :size[0] // 2]
                    + image[1::2, ::2][:size[1] // 2, :size[0] // 2]
                    + image[::2, 1::2][:size[1] // 2, :size[0] // 2]
                    + image[1::2, 1::2][:size[1] // 2, :size[0] // 2])
    return show_image(image, owner, [row["block"] for row in rows
                                     if row["exposed"]], axes3)


def later_faces(geometry, state, finite):
    """Faces of rock that no state has shown yet, but one will (3D)."""
    shift = numpy.uint32(state + 1)
    is_later = (geometry.seen_in >> shift > 0) & (
        geometry.seen_in & ((numpy.uint32(1) << shift) - numpy.uint32(1)) == 0)
    # not what a block leaves behind
    beside = numpy.where(geometry.face_other >= 0,
                         geometry.block[geometry.face_other], -1)
    return numpy.flatnonzero(
        is_later & ~numpy.isin(geometry.block[geometry.face_cell], finite)
        & ~numpy.isin(beside, finite))


def behind(image, owner, number, normals, axes3):
    """A picture with pale faces of what is still to be dug behind the rest."""
    normals = normals / (numpy.linalg.norm(normals, axis=1)[:, None] + 1e-30)
    normals *= numpy.where(normals @ axes3[2] < 0., -1., 1.)[:, None]
    is_empty = owner < 0
    pale = numpy.ones_like(image)
    pale[number >= 0] = mix(CAVERN, 0.4)
    pale[edges_of(numpy.where(number >= 0, 0, -1), numpy.vstack(
        [normals, numpy.zeros(3)])[number])] = 0.6
    return numpy.where(is_empty[:, :, None], pale, image)


def choose_eye(geometry, exposed, centre):
    """From where to look: the side on which the exposed blocks are."""
    mine = numpy.isin(geometry.block, list(exposed))
    side = (geometry.corners[mine].mean(axis=(0, 1)) - centre if mine.any()
            else numpy.zeros(3))
    return (-0.8 if side[0] < 0. else 0.8, -1., 0.55)


def edges_of(owner, normals):
    """Pixels where another block begins, or a face of another direction."""
    found = numpy.zeros(owner.shape, bool)
    for axis in (0, 1):
        a = [slice(None)] * 2
        b = [slice(None)] * 2
        a[axis], b[axis] = slice(1, None), slice(None, -1)
        a, b = tuple(a), tuple(b)
        differs = (owner[a] != owner[b]) | (
            (normals[a] * normals[b]).sum(axis=-1) < 0.9) & (owner[a] >= 0)
        found[a] |= differs
        found[b] |= differs
    return found


def show_image(image, owner, exposed, axes3):
    """A figure with a picture of pixels, numbers of blocks and axes."""
    # the arrows stand on the left of what would be behind them
    side = round(ARROWS * DPI)
    if (owner[-2 * side:, :2 * side] >= 0).any():
        image = numpy.pad(image, ((0, 0), (side, 0), (0, 0)),
                          constant_values=1.)
        owner = numpy.pad(owner, ((0, 0), (2 * side, 0)), constant_values=-1)
    height, width = image.shape[:2]
    figure = pyplot.figure(figsize=(width / DPI, height / DPI))
    axes = figure.add_axes((0., 0., 1., 1.))
    axes.axis("off")
    axes.imshow(numpy.clip(image, 0., 1.), interpolation="nearest",
                aspect="auto")
    labels = {}
    for n in exposed:
        y, x = numpy.nonzero(owner == n)
        if len(x) > 60:
            k = numpy.hypot(x - x.mean(), y - y.mean()).argmin()
            labels[n] = numpy.array((0.5 * x[k], 0.5 * y[k]))
    put_labels(axes, labels, 1. / DPI)
    put_axes(axes, axes3, (side / width, side / height))
    return figure


def put_axes(axes, axes3, share):
    """Small arrows to the east, north and up, in a share of the picture."""
    inset = axes.inset_axes((0., 0., *share))
    inset.set(aspect="equal", xlim=(-1.7, 1.7), ylim=(-1.7, 1.7))
    inset.axis("off")
    for name, direction in zip(("x E", "y N", "z"), numpy.eye(3)):
        x, y = (axes3 @ direction)[:2]
        inset.annotate("", (x, y), (0, 0), arrowprops={
            "arrowstyle": "->", "color": "0.3"}, annotation_clip=False)
        inset.text(1.35 * x, 1.35 * y, name, ha="center", va="center",
                   fontsize=7, color="0.3")


def draw_stages(geometry, rows):
    """Name of the stage, address of its picture, and its caption, in turn."""
    box = geometry.box_of_interest()
    factor = exaggeration(geometry, box)
    draw = draw_plane if geometry.run.is_plane else draw_solid
    for k, (name, index, *_) in enumerate(geometry.run.states):
        if k >= len(geometry.is_there):
            break
        if geometry.run.is_within_stage(k):
            continue
        if not geometry.run.is_plane and not (
                geometry.seen_in & numpy.uint32(1 << k)).any():
            continue
        figure = draw(geometry, rows, k, factor, box)
        yield index, name, as_png(figure, DPI), factor if index >= 0 else 1.


def legend(geometry, rows):
    """Colour, kind of mark and text of what the pictures show."""
    run = geometry.run
    states = {row["state"] for row in rows}
    found = [(colour, "area", text) for key, (colour, text) in STATES.items()
             if key in states]
    if any(not row["exposed"] for row in rows):
        found.append(("", "", "hidden blocks are paler"))
    if not run.is_plane:
        found.append((CAVERN, "area", "what is dug, seen through from behind"
                      if run.digs() else "surface of the rock"))
        return found + [("#f0eee9", "area", "still to be dug")] * (
            run.digs() and any(len(later_faces(
                geometry, k, [row["block"] for row in rows]))
                for k in range(len(geometry.is_there))))
    names, group = run.joint_groups()
    group = numpy.array([*group, -1])
    used = set(group[geometry.face_joint[geometry.face_joint < len(group)]])
    found += [(GROUP_COLOURS[k % 8], "line", f"joints {name}" if
               list(group).count(k) > 1 else f"joint {name}")
              for k, name in enumerate(names) if k in used]
    if any(water_level(run, k) is not None for k in range(len(run.states))):
        found.append((WATER, "dashes", "water table"))
    return found + [("#737373", "dashes", "as dug, before it moved")]

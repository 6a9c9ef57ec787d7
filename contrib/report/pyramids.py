# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which joint pyramids can be removed from a roof, floor or wall, as SVG.

Of infinite joints the program says it (summary.json, block_theory); else the
same is computed here from the mean planes of the sets, with friction only and
gravity downward (source/safety/block_theory.cc)."""
import itertools
import math
import re

import numpy

from .plots import mean_plane, planes_of_groups
from .style import DASHES, GROUP_COLOURS, as_svg, pyplot

MOST_SETS = 6  # 64 pyramids
REACH = 2.6  # of the pictures, in radii of the horizon
DOWN = numpy.array([0., 0., -1.])
# what the colours mean: whether a pyramid is one of these, by its factor
KINDS = (("#d55e00", "falls, or factor below 1", lambda f: f < 1.),
         ("#e69f00", "slides, factor 1 to 1.5", lambda f: f < 1.5),
         ("#56b4e9", "slides, factor 1.5 and more", math.isfinite),
         ("#cfd8cf", "removable, but gravity holds it", lambda f: True))


def normal_of(dip, direction):
    """The upward unit normal of a plane."""
    dip, direction = math.radians(dip), math.radians(direction)
    return numpy.array([math.sin(dip) * math.sin(direction),
                        math.sin(dip) * math.cos(direction), math.cos(dip)])


def edges_of(normals):
    """Unit vectors along which planes meet within the cone n.d >= 0."""
    for a, b in itertools.combinations(normals, 2):
        line = numpy.cross(a, b)
        if numpy.linalg.norm(line) < 1e-9:
            continue
        line /= numpy.linalg.norm(line)
        for edge in (line, -line):
            if (normals @ edge >= -1e-9).all():
                yield edge


def has_interior(normals):
    """Whether the cone n.d >= 0 is more than a ray or a plane."""
    if len(normals) == 1:
        return True
    middle = sum(edges_of(normals), numpy.zeros(3))
    for a, b in itertools.permutations(normals, 2):
        along = b - (a @ b) * a
        if (numpy.linalg.norm(along) > 1e-9
                and (normals @ along >= -1e-9).all()):
            middle = middle + along / numpy.linalg.norm(along)
    size = numpy.linalg.norm(middle)
    return size > 1e-9 and bool((normals @ middle > 1e-9 * size).all())


def is_removable(inward, into_rock):
    """Whether a pyramid has no direction at all that stays in the rock."""
    normals = numpy.vstack([inward, into_rock])
    return (numpy.linalg.matrix_rank(normals, 1e-6) > 1
            and next(edges_of(normals), None) is None)


def factor_of(normals, tangents):
    """Friction over what drives a pyramid's blocks: 0 falls, infinite stable."""
    if (normals @ DOWN >= -1e-9).all():
        return 0.
    slips = [DOWN - (n @ DOWN) * n for n in normals]
    for n, slip, tangent in zip(normals, slips, tangents):
        if n @ DOWN < 0. and (normals @ slip >= -1e-9).all():
            driving = numpy.linalg.norm(slip)
            return -(n @ DOWN) * tangent / driving if driving > 1e-9 else math.inf
    for i, j in itertools.combinations(range(len(normals)), 2):
        line = numpy.cross(normals[i], normals[j])
        size = numpy.linalg.norm(line)
        if size < 1e-9 or abs(line @ DOWN) < 1e-9 * size:
            continue
        line *= math.copysign(1. / size, line @ DOWN)
        if ((normals @ line >= -1e-9).all() and slips[i] @ normals[j] < 0.
                and slips[j] @ normals[i] < 0.):
            forces = numpy.linalg.lstsq(
                numpy.column_stack([normals[i], normals[j]]),
                (line @ DOWN) * line - DOWN, rcond=None)[0]
            return (forces[0] * tangents[i] + forces[1] * tangents[j]) / (
                line @ DOWN)
    return math.inf


def infinite_sets(run):
    """Names and normals of the infinite joints, parallel ones together."""
    names, normals = [], []
    for row in run.joints:
        plane = run.orientation(row)
        if row.get("extent") != "infinite" or not plane:
            continue
        normal = normal_of(*plane)
        if all(abs(normal @ n) < 1. - 1e-9 for n in normals):
            names.append(row.get("name") or str(len(names) + 1))
            normals.append(normal)
    return names, numpy.array(normals)


def mean_sets(run):
    """Names, normals and least tangents of friction of the groups of joints."""
    groups = run.joint_groups()[1]
    names, normals, tangents = [], [], []
    for k, (name, planes) in enumerate(planes_of_groups(run)):
        angles = [float(row["friction angle"]) for row, g in zip(
            run.joints, groups) if g == k and row.get("friction angle")]
        if not planes:
            continue
        names.append(name)
        normals.append(normal_of(*mean_plane(planes)))
        tangents.append(math.tan(math.radians(min(angles, default=0.))))
    return names, numpy.array(normals), tangents


def signs_of(code):
    """1 above and -1 below the joint of each set, as a column."""
    return numpy.array([[1. if c == "0" else -1.] for c in code])


def faces_of(run):
    """Name and direction into the rock of the roof, the floor and walls."""
    walls = run.entries.get("Block theory/Walls", "0, 90, 180, 270")
    faces = {"roof": -DOWN, "floor": DOWN}
    for azimuth in filter(None, (w.strip() for w in walls.split(","))):
        faces[f"wall facing {float(azimuth):g}"] = -normal_of(
            90., float(azimuth))
    return faces


def find_removable(run):
    """Names and normals of the sets, and of each face its pyramids' factors.

    And whether the program says so; or None and why there is nothing."""
    theory = run.summary.get("block_theory", {})
    faces = faces_of(run)
    if "faces" in theory:
        names, normals = infinite_sets(run)
        if len(theory["joint_pyramids"][0]["code"]) == len(names):
            factor = {p["code"]: p.get("factor", math.inf)
                      for p in theory["joint_pyramids"]}
            found = {one["face"]: {code: factor[code] for code in
                                   one.get("removable", [])}
                     for one in theory["faces"]}
            return names, normals, {n: found.get(n, {}) for n in faces}, True
    names, normals, tangents = mean_sets(run)
    if len(names) > MOST_SETS:
        return None, (f"Removable joint pyramids are drawn of at most {MOST_SETS} "
                      f"sets; there are {len(names)} with different names.")
    found = {name: {} for name in faces}
    for digits in itertools.product("01", repeat=len(names)):
        code = "".join(digits)
        inward = signs_of(code) * normals
        if not has_interior(inward):
            continue
        for name, into_rock in faces.items():
            if is_removable(inward, into_rock):
                found[name][code] = factor_of(inward, tangents)
    return names, normals, found, False


def draw_face(axes, sets, into_rock, removable, grid):
    """One stereonet: the air's side, the planes and the pyramids."""
    names, normals = sets
    x, y, directions = grid
    inside = x**2 + y**2 <= REACH**2

    def shade(values, **options):
        axes.contourf(x, y, numpy.where(inside, values, numpy.nan),
                      [0., 2.], **options)
    shade(-(directions @ into_rock), colors=["#f4f1e6"])
    for code, factor in removable.items():
        values = (directions @ (signs_of(code) * normals).T).min(axis=-1)
        colour = next(c for c, _, is_one in KINDS if is_one(factor))
        shade(values, colors=[colour])
        where = numpy.unravel_index(numpy.argmax(numpy.where(
            x**2 + y**2 < (REACH - 0.3)**2, values, -2.)), values.shape)
        if values[where] > 0.:
            axes.text(x[where], y[where], code, ha="center", va="center",
                      fontsize=8, zorder=5)
    for k, normal in enumerate(normals):
        axes.contour(x, y, numpy.where(inside, directions @ normal, numpy.nan),
                     [0.], colors=GROUP_COLOURS[k % 8], linewidths=0.9,
                     linestyles=[DASHES[k % 8]])
    axes.contour(x, y, numpy.where(inside, directions @ into_rock, numpy.nan),
                 [0.], colors="black", linewidths=2.)
    axes.add_patch(pyplot.Circle((0., 0.), 1., fill=False, color="0.4",
                                 linewidth=0.7))
    axes.set(aspect="equal", xlim=(-REACH, REACH), ylim=(-REACH, REACH))
    axes.axis("off")


def stereonets(run):
    """Removable pyramids of roof, floor and walls, and a caption; 3D."""
    if run.is_plane or not run.joints:
        return None, ""
    found = find_removable(run)
    if found[0] is None:
        return found
    names, normals, removable, told = found
    if not names:
        return None, ""
    faces = {n: d for n, d in faces_of(run).items() if removable[n]}
    if not faces:
        return None, ("No joint pyramid can be removed from a roof, floor or "
                      "wall: the sets cut no finite block out of it.")
    line = numpy.linspace(-REACH, REACH, 157)
    x, y = numpy.meshgrid(line, line)
    square = x**2 + y**2
    grid = x, y, numpy.stack([2. * x, 2. * y, square - 1.], -1) / (
        1. + square)[..., None]
    columns = min(3, len(faces))
    rows = -(-len(faces) // columns)
    figure, all_axes = pyplot.subplots(
        rows, columns, figsize=(2.5 * columns, 2.7 * rows),
        squeeze=False, layout="constrained")
    for axes in all_axes.flat[len(faces):]:
        axes.axis("off")
    for axes, (name, into_rock) in zip(all_axes.flat, faces.items()):
        draw_face(axes, (names, normals), into_rock, removable[name], grid)
        axes.set_title(name, fontsize=10)
    shown = [factor for n in faces for factor in removable[n].values()]
    patches = []
    for k, (colour, text, _) in enumerate(KINDS):
        if any(next(i for i, kind in enumerate(KINDS) if kind[2](f)) == k
               for f in shown):
            patches.append((pyplot.Rectangle((0, 0), 1, 1, color=colour), text))
    patches += [(pyplot.Line2D([], [], color=GROUP_COLOURS[k % 8],
                               linestyle=DASHES[k % 8]), name)
                for k, name in enumerate(names[:6])]
    patches.append((pyplot.Line2D([], [], color="black", linewidth=2.),
                    "excavation's face"))
    figure.legend(*zip(*patches), loc="upper center", ncol=3,
                  bbox_to_anchor=(0.5, 0.), fontsize=9, frameon=False)
    caption = (
        "Removable joint pyramids (block theory of Goodman and Shi): those that "
        "lie wholly on the face's open side (tinted), so that joints and face "
        "cut finite blocks free that can move out. A code has a digit for each "
        f"of {', '.join(names)}: 0 the block is above the joint, 1 below. Whole "
        "stereographic projection, upper focal point, north up: downward "
        "directions are inside the thin circle (the horizon), upward ones "
        "outside. Walls are named by the azimuth that they face. Factors are "
        "of friction alone, without stress, cohesion and support, "
        + ("as the program has found (Block theory/Report)." if told else
           "of the sets' mean planes as if their joints were unlimited; finite "
           "joints need not meet in such blocks."))
    svg = as_svg(figure, "Removable joint pyramids")
    return re.sub(r"(\.\d\d)\d+", r"\1", svg), caption  # half as long

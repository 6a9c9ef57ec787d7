# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of figures.py that show the rock of plane scenes."""
import math

import numpy
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, to_rgb

from figures_joints import cells_of
from figures_style import (NOTHING, ROCK_COLOURS, block_colour, block_label,
                           fitting_unit, joint_style, key_of_joints,
                           new_figure, pale,
                           put_legend, put_text, pyplot)
from render_data import (merge_points, move_points, numpy_to_vtk, outline_of,
                         round_factor, values_of, vtk_to_numpy,
                         vtkUnstructuredGrid)
from render_options import RED, View
from render_scene import COLOURS


def block_of_cells(grid):
    """The number of the block of each cell, 0 for none."""
    order, _ = cells_of(grid)
    return values_of(grid, "block")[order[:, 0]].astype(int)


def outlines(grid, groups=None):
    """The outline of each block, or of groups of cells, as line segments."""
    order, _ = cells_of(grid)
    if groups is None:
        groups = block_of_cells(grid)
    marks = numpy.zeros(grid.GetNumberOfPoints())
    marks[order] = groups[:, None]
    marked = vtkUnstructuredGrid()
    marked.DeepCopy(grid)
    array = numpy_to_vtk(marks, deep=True)
    array.SetName("block")
    marked.GetPointData().AddArray(array)
    merged = merge_points(marked)
    found = {}
    for number in numpy.unique(groups):
        edges = outline_of(merged, number)
        points = vtk_to_numpy(edges.GetPoints().GetData())
        lines = vtk_to_numpy(edges.GetLines().GetConnectivityArray())
        found[int(number)] = points[lines.reshape(-1, 2)][:, :, :2]
    return found


def stage_of_cells(run):
    """The number from 1 of the stage that digs each cell of the first state.

    0 for cells that stay and for blocks taken away."""
    grid = run.rock(0)
    centres = cells_of(grid)[1].mean(axis=1)
    keys = list(map(tuple, centres.tolist()))
    stage = numpy.zeros(len(keys), dtype=int)
    if not run.history:
        return stage
    taken = [n for n in run.blocks if run.removal_stage(n) is not None]
    is_taken = numpy.isin(block_of_cells(grid), taken)
    for k in reversed(range(len(run.stages))):
        left = cells_of(run.rock(run.state_of_stage(k)))[1].mean(axis=1)
        left = set(map(tuple, left.tolist()))
        gone = numpy.array([key not in left for key in keys])
        stage[gone & ~is_taken] = k + 1
    return stage


def choose_box(run, stage, box):
    """The box asked for, or one about what is dug and what could move."""
    if box:
        return numpy.array(box).reshape(2, 2)
    grid = run.rock(0)
    corners = cells_of(grid)[1][:, :, :2]
    of_interest = numpy.isin(block_of_cells(grid), run.named_blocks())
    of_interest |= stage > 0
    whole = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    if not of_interest.any():
        return numpy.array(whole)
    shown = corners[of_interest]
    low, high = shown.min(axis=(0, 1)), shown.max(axis=(0, 1))
    margin = 0.17 * (high - low).max()
    rim = 0.1 * margin  # of the model, where it is all to be shown
    return numpy.array([numpy.maximum(low - margin, whole[0] - rim),
                        numpy.minimum(high + margin, whole[1] + rim)])


def number_places(corners, block, box, wanted):
    """A place for the numbers of blocks, far from others and the rim."""
    centres = corners.mean(axis=1)[:, :2]
    inside = ((centres > box[0]) & (centres < box[1])).all(axis=1)
    centres, block = centres[inside], block[inside]
    places = {}
    for number in numpy.intersect1d(numpy.unique(block), list(wanted)):
        mine = centres[block == number]
        mine = mine[::max(1, len(mine) // 400)]
        far = numpy.minimum(mine - box[0], box[1] - mine).min(axis=1)
        for part in numpy.array_split(centres[block != number],
                                      len(centres) // 500 + 1):
            if len(part):
                apart = numpy.linalg.norm(mine[:, None] - part, axis=2)
                far = numpy.minimum(far, apart.min(axis=1))
        # of places about as good the one in the middle
        far -= 0.1 * numpy.hypot(*(mine - mine.mean(axis=0)).T)
        if far.max() > 0.005 * (box[1] - box[0]).max():
            places[int(number)] = mine[far.argmax()]
    return places


def joint_ends(run, name, box):
    """The two ends of the trace of a joint, of an infinite one in a box."""
    entry = f"Joints/{name}/"
    vertices = run.numbers(entry + "Vertices")
    if len(vertices) == 4:
        return numpy.array(vertices).reshape(2, 2)
    point = numpy.array(run.numbers(entry + "Point")[:2])
    normal = run.numbers(entry + "Normal")[:2]
    dip, azimuth = (run.numbers(entry + name) for name in
                    ("Dip", "Dip direction"))
    if len(normal) == 2:
        along = numpy.array([-normal[1], normal[0]]) / math.hypot(*normal)
    elif dip and azimuth:
        angle = math.radians(dip[0])
        along = numpy.array([math.sin(math.radians(azimuth[0]))
                             * math.cos(angle), -math.sin(angle)])
    if len(point) < 2 or not (len(normal) == 2 or (dip and azimuth)):
        return None
    half = 2. * numpy.linalg.norm(box[1] - box[0]) + numpy.linalg.norm(
        point - box.mean(axis=0))
    if run.entries.get(entry + "Extent") == "disc":
        half = (run.numbers(entry + "Radius") or [0.])[0]
    return numpy.array([point - half * along, point + half * along])


def set_up(axes, box):
    """A plane in true proportions within a box."""
    axes.set(xlim=box[:, 0], ylim=box[:, 1], aspect="equal",
             xlabel="x [m]", ylabel="y [m]")
    axes.grid(False)


def sheet_size(box, n=1, beside=2.6):
    """Width and height of a figure for n boxes and what stands beside them."""
    wide, high = box[1] - box[0]
    height = 6.4 if n == 1 else 5.2
    width = min(max(wide / high * (height - 0.7), 3.), 9.)
    return n * (width + 0.5) + beside, max(
        min(height, width * high / wide + 1.), 3.4)


def fill_cells(run, grid):
    """Colour of each cell: of its block, of others by material."""
    order, _ = cells_of(grid)
    material = values_of(grid, "material")[order[:, 0]].astype(int)
    shades = numpy.array([to_rgb(shade) for shade in ROCK_COLOURS])
    colours = shades[material % len(shades)]
    block = block_of_cells(grid)
    for number in run.finite_blocks():
        colours[block == number] = pale(block_colour(run, number))
    return colours


def draw_block_map(run, box=()):
    """Blocks, joints and stages of the first state."""
    if not run.states:
        return "no states (solution.pvd)"
    grid, stage = run.rock(0), stage_of_cells(run)
    box = choose_box(run, stage, box)
    _, corners = cells_of(grid)
    block = numpy.where(stage > 0, 0, block_of_cells(grid))
    colours = fill_cells(run, grid)
    colours[stage > 0] = 1.
    figure, ((axes,),) = new_figure(size=sheet_size(box))
    set_up(axes, box)
    is_dug = stage > 0
    for cells, zorder in ((~is_dug, 1), (is_dug, 3)):  # joints between
        axes.add_collection(PolyCollection(
            corners[cells][:, :, :2], facecolors=colours[cells],
            edgecolors=colours[cells], linewidths=0.3, zorder=zorder))
    names = run.names("Joints")
    for name in names:
        ends = joint_ends(run, name, box)
        if ends is not None:
            axes.plot(*ends.T, zorder=2, scalex=False, scaley=False,
                      linewidth=1.6 if len(names) < 30 else 0.8,
                      **joint_style(run, name))
    put_excavations(axes, run, grid, stage)
    named = run.named_blocks()
    others = set(run.blocks) - set(run.finite_blocks())
    others = others if len(run.blocks) <= 30 else set()
    places = number_places(corners, block, box, {*named, *others})
    # the most dangerous first: labels that would lie on others are left out
    for number in [n for n in [*named, *sorted(others)] if n in places]:
        is_finite = number in named
        put_text(axes, places[number], str(number), zorder=5,
                 fontsize=11 if is_finite else 9,
                 weight="bold" if is_finite else "normal",
                 color=block_colour(run, number) if is_finite else "0.4")
    finite = run.finite_blocks()
    shown = ([(n, block_label(run, n)) for n in finite]
             if len(finite) <= 12 else
             [(n, f"{len(finite) - len(named)} others")
              for n in set(finite) - set(named)][:1])
    blocks = [axes.fill([], [], facecolor=pale(block_colour(run, n)),
                        edgecolor=block_colour(run, n), label=label)[0]
              for n, label in shown]
    put_legend(axes, handles=[*blocks, *key_of_joints(axes, run, names)])
    return figure


def put_excavations(axes, run, grid, stage):
    """Outlines of what the stages dig, with their names."""
    corners = cells_of(grid)[1]
    for number, lines in outlines(grid, stage).items():
        if number == 0:
            continue
        axes.add_collection(LineCollection(lines, colors="0.3", linewidths=1.,
                                           zorder=4))
        mine = corners[stage == number]
        centre = 0.5 * (mine.min(axis=(0, 1)) + mine.max(axis=(0, 1)))[:2]
        put_text(axes, centre, run.stages[number - 1], zorder=5, fontsize=9,
                 color="0.3")


def displacements(grid):
    """Mean length of the displacement in each cell."""
    order, _ = cells_of(grid)
    return numpy.linalg.norm(values_of(grid, "displacement")[order],
                             axis=2).mean(axis=1)


def scale_of(grids):
    """Unit of displacements, its size, and the largest of each grid in it."""
    most = [numpy.linalg.norm(values_of(grid, "displacement"), axis=1).max()
            for grid in grids]
    unit, size = fitting_unit("m", [most])
    return unit, size, [value / size for value in most]


def choose_factor(runs, stages, box):
    """Exaggeration that shows the largest displacement as 3 % of the box."""
    largest = 0.
    for run, stage in zip(runs, stages):
        grid = run.rock(run.state_of_stage(stage))
        centres = cells_of(grid)[1].mean(axis=1)[:, :2]
        inside = ((centres > box[0]) & (centres < box[1])).all(axis=1)
        largest = max([largest, *displacements(grid)[inside]])
    if largest == 0.:
        return 1.
    return round_factor(0.03 * (box[1] - box[0]).max() / largest)


def widen(box, run, grid, factor):
    """A box that holds the finite blocks where they are drawn, too."""
    chosen = numpy.isin(block_of_cells(grid), run.named_blocks())
    if not chosen.any():
        return box
    places = cells_of(move_points(grid, factor, View()))[1][chosen][:, :, :2]
    margin = 0.02 * (box[1] - box[0]).max()
    low, high = places.min(axis=(0, 1)), places.max(axis=(0, 1))
    return numpy.array([numpy.minimum(box[0], low - margin),
                        numpy.maximum(box[1], high + margin)])


def draw_deformed(runs, name=None, exaggeration=0., box=()):
    """The rock after a stage, displacements exaggerated, a panel per run."""
    if not all(run.states and run.stages for run in runs):
        return "no states (solution.pvd)"
    stages = [run.stages.index(name) if name else len(run.stages) - 1
              for run in runs]
    is_free = not box
    box = choose_box(runs[0], stage_of_cells(runs[0]), box)
    factor = exaggeration or choose_factor(runs, stages, box)
    grids = [run.rock(run.state_of_stage(k)) for run, k in zip(runs, stages)]
    if is_free:
        for run, grid in zip(runs, grids):
            box = widen(box, run, grid, factor)
    unit, size, most = scale_of(grids)
    if max(most) * size < NOTHING:
        return "nothing moves"
    figure, axes = new_figure(1, len(runs), sheet_size(box, len(runs), 1.4),
                              sharey=True)
    shades = LinearSegmentedColormap.from_list("displacement", COLOURS)
    norm = pyplot.Normalize(0., max(most))
    for one, run, grid, stage, value in zip(axes.flat, runs, grids, stages,
                                            most):
        set_up(one, box)
        plot_rock(one, run, grid, factor, (shades, norm, size))
        plot_first_places(one, run, stage)
        one.set_title((f"{run.label}\n" if len(runs) > 1 else "")
                      + f"after {run.stages[stage]}, at most "
                      f"{value:.3g} {unit}", loc="left")
    bar = figure.colorbar(pyplot.cm.ScalarMappable(norm, shades), ax=axes,
                          shrink=0.8, pad=0.02)
    bar.set_label(f"displacement [{unit}], drawn times {factor:g}")
    return figure


def plot_rock(axes, run, grid, factor, colours):
    """Displaced cells by displacement, outlines and numbers of blocks."""
    shades, norm, size = colours
    moved = move_points(grid, factor, View())
    _, corners = cells_of(moved)
    axes.add_collection(PolyCollection(
        corners[:, :, :2], array=displacements(grid) / size, cmap=shades,
        norm=norm, edgecolors=(0.3, 0.3, 0.3, 0.35), linewidths=0.25))
    named = run.named_blocks()
    for number, lines in outlines(moved).items():
        is_finite = number in named
        axes.add_collection(LineCollection(
            lines, linewidths=2. if is_finite else 0.9, zorder=3 + is_finite,
            colors=block_colour(run, number) if is_finite else "0.2"))
    box = numpy.array([axes.get_xlim(), axes.get_ylim()]).T
    places = number_places(corners, block_of_cells(grid), box, named)
    for number in named:
        if number in places:
            put_text(axes, places[number], str(number), zorder=5, fontsize=11,
                     weight="bold", color=block_colour(run, number))


def plot_first_places(axes, run, stage):
    """Where the rim of what is dug was at first, and blocks taken away."""
    grid = run.rock(0)
    is_dug = stage_of_cells(run)
    is_dug = numpy.where((is_dug > 0) & (is_dug <= stage + 1), 1, 0)
    axes.add_collection(LineCollection(
        outlines(grid, is_dug).get(1, []), colors=[RED], linewidths=0.9,
        zorder=3.5))
    taken = [n for n in run.finite_blocks()
             if (run.removal_stage(n) or 0) <= stage
             and run.removal_stage(n) is not None]
    lines = outlines(grid)
    for number in taken:
        axes.add_collection(LineCollection(
            lines.get(number, []), colors=block_colour(run, number),
            linewidths=1.2, linestyles=[(0, (1.5, 1.5))], zorder=4))
        put_text(axes, run.blocks[number]["centroid"][:2], str(number),
                 fontsize=9, color=block_colour(run, number), zorder=5)

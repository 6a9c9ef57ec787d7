# SPDX-License-Identifier: LGPL-2.1-or-later
"""Maps of stress, plastic strain and the state of joints (plane scenes)."""
import numpy
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap

from figures_joints import cells_of
from figures_maps import (block_of_cells, choose_box, number_places, outlines,
                          set_up, sheet_size, stage_of_cells)
from figures_style import (NO_STEPS, ROCK_COLOURS, block_colour, fitting_unit,
                           new_figure, put_legend, put_text, pyplot)
from render_data import magnitudes_of, values_of
from render_parts import JOINT_STATES, STATE_COLOURS, joint_faces
from render_scene import COLOURS
from report.vtu import COMPONENTS

SHADES = LinearSegmentedColormap.from_list("field", COLOURS)
MOST_CROSSES = 20  # of principal directions along the longer side of a map


def state_of(run, name):
    """The grid of the state after a stage, or the last, and a title."""
    stage = run.stages.index(name) if name else len(run.stages) - 1
    index = run.state_of_stage(stage)
    return run.rock(index), index, (
        f"after {run.stages[stage]}" if run.takes_steps() else
        f"at first, in the rock after {run.stages[stage]}")


def inside_of(corners, box):
    """Cells that reach into a box."""
    return ((corners.max(axis=1)[:, :2] > box[0])
            & (corners.min(axis=1)[:, :2] < box[1])).all(axis=1)


def put_cells(axes, corners, values, norm):
    """Cells coloured by values."""
    axes.add_collection(PolyCollection(
        corners[:, :, :2], array=values, cmap=SHADES, norm=norm,
        edgecolors="face", linewidths=0.3, zorder=1))


def put_blocks(axes, run, grid, box):
    """Outlines of the blocks, and numbers of those that have one."""
    named = run.named_blocks()
    for number, lines in outlines(grid).items():
        axes.add_collection(LineCollection(
            lines, linewidths=1.2 if number in named else 0.5, zorder=3,
            colors="0.15" if number in named else "0.45"))
    _, corners = cells_of(grid)
    places = number_places(corners, block_of_cells(grid), box, named)
    for number in [n for n in named if n in places]:
        put_text(axes, places[number], str(number), zorder=5, fontsize=9,
                 color=block_colour(run, number))


def stress_in_plane(grid):
    """Stress (cells, 2, 2) in the plane of a scene."""
    order, _ = cells_of(grid)
    stress = numpy.zeros((len(order), 2, 2))
    for name in ("xx", "yy", "xy"):
        a, b = COMPONENTS[name]
        values = values_of(grid, f"stress_{name}")[order].mean(axis=1)
        stress[:, a, b] = stress[:, b, a] = values
    return stress


def put_crosses(axes, centres, pressures, directions, box):
    """Short lines along the principal stresses, as long as they are large.

    Of the cells those nearest to the places of a coarse grid."""
    step = (box[1] - box[0]).max() / MOST_CROSSES
    place = numpy.floor((centres - box[0]) / step).astype(int)
    off = numpy.linalg.norm(centres - box[0] - (place + 0.5) * step, axis=1)
    order = numpy.argsort(off)
    _, first = numpy.unique(place[order], axis=0, return_index=True)
    chosen = order[first]
    half = 0.55 * step * pressures[chosen] / abs(pressures[chosen]).max()
    for k in range(2):
        along = directions[chosen, :, k] * half[:, [k]]
        middle = centres[chosen]
        axes.add_collection(LineCollection(
            numpy.stack([middle - along, middle + along], axis=1),
            linewidths=0.7, zorder=4, colors=[
                "#b00020" if tension else "0.1" for tension in half[:, k] < 0.]))


def draw_stress(run, name=None, box=()):
    """Major and minor principal stress in the plane, and their directions."""
    if not (run.states and run.stages):
        return "no states (solution.pvd)"
    grid, _, title = state_of(run, name)
    box = choose_box(run, stage_of_cells(run), box)
    _, corners = cells_of(grid)
    values, directions = numpy.linalg.eigh(-stress_in_plane(grid))
    inside = inside_of(corners, box)
    if not abs(values[inside]).max(initial=0.) > 0.:
        return "no stress"
    unit, size = fitting_unit("Pa", [values[inside]])
    figure, axes = new_figure(1, 2, sheet_size(box, 2, 2.2), sharey=True)
    for one, k, text in zip(axes.flat, (1, 0), ("major", "minor")):
        set_up(one, box)
        shown = values[:, k] / size
        # a few cells at corners would take all colours
        norm = pyplot.Normalize(*numpy.percentile(shown[inside], (0.5, 99.5)))
        put_cells(one, corners[inside], shown[inside], norm)
        put_blocks(one, run, grid, box)
        one.set_title(f"{text} principal stress {title}", loc="left")
        figure.colorbar(pyplot.cm.ScalarMappable(norm, SHADES), ax=one,
                        shrink=0.7, pad=0.02, extend="both").set_label(
                            f"{text}, pressed: + [{unit}]")
    put_crosses(axes[0, 0], corners[inside].mean(axis=1)[:, :2],
                values[inside], directions[inside], box)
    return figure


def draw_plastic(run, name=None, box=()):
    """Plastic strain, and how many cells have some."""
    if not (run.states and run.stages):
        return "no states (solution.pvd)"
    grid, _, title = state_of(run, name)
    if not grid.GetPointData().HasArray("plastic_strain"):
        return "no plastic material"
    order, corners = cells_of(grid)
    strain = magnitudes_of(grid, "plastic_strain")[order].mean(axis=1)
    yielded, is_free = strain > 0., not box
    box = choose_box(run, stage_of_cells(run), box)
    if is_free and yielded.any():  # all that has yielded is to be seen
        places = corners[yielded][:, :, :2]
        box = numpy.array([numpy.minimum(box[0], places.min(axis=(0, 1))),
                           numpy.maximum(box[1], places.max(axis=(0, 1)))])
    inside = inside_of(corners, box)
    figure, ((axes,),) = new_figure(size=sheet_size(box, 1, 1.4))
    set_up(axes, box)
    axes.add_collection(PolyCollection(
        corners[inside & ~yielded][:, :, :2], facecolors=ROCK_COLOURS[0],
        edgecolors="face", linewidths=0.3, zorder=1))
    norm = pyplot.Normalize(0., max(strain[inside].max(initial=0.), 1e-12))
    put_cells(axes, corners[inside & yielded], strain[inside & yielded], norm)
    put_blocks(axes, run, grid, box)
    axes.set_title(f"plastic {title}: {yielded.sum()} of {len(strain)} cells",
                   loc="left")
    figure.colorbar(pyplot.cm.ScalarMappable(norm, SHADES), ax=axes,
                    shrink=0.8, pad=0.02).set_label("plastic strain [-]")
    return figure


def draw_joint_states(run, name=None, box=()):
    """Where joints are bonded, stick, slide or are open."""
    if not run.takes_steps():
        return NO_STEPS
    if not (run.states and run.stages):
        return "no states (solution.pvd)"
    grid, index, title = state_of(run, name)
    time = run.states[index][0]
    faces, state = joint_faces(run.folder / "solution.pvd", time)
    if not len(faces):
        return "no joints with contact"
    box = choose_box(run, stage_of_cells(run), box)
    _, corners = cells_of(grid)
    figure, ((axes,),) = new_figure(size=sheet_size(box))
    set_up(axes, box)
    axes.add_collection(PolyCollection(
        corners[:, :, :2], facecolors=ROCK_COLOURS[0],
        edgecolors=ROCK_COLOURS[0], linewidths=0.3, zorder=1))
    inside = inside_of(faces, box)
    for k, text in enumerate(JOINT_STATES):
        mine = state == k
        if mine.any():
            axes.add_collection(LineCollection(
                faces[mine][:, :, :2], colors=[STATE_COLOURS[k]], zorder=2 + k,
                linewidths=1.2 + 0.5 * k,
                label=f"{text} ({(mine & inside).sum()} faces)"))
    named = run.named_blocks()
    places = number_places(corners, block_of_cells(grid), box, named)
    for number in [n for n in named if n in places]:
        put_text(axes, places[number], str(number), zorder=7, fontsize=9,
                 color="0.2")
    axes.set_title(f"joints {title}", loc="left")
    put_legend(axes)
    return figure

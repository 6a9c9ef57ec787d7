#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picture of the rock at one time of a run.

usage: xvfb-run -a contrib/render.py solution.pvd OUT.png|pdf|svg
         [--time-index I] [--field displacement] [--exaggeration F]
         [--size WIDTH,HEIGHT] [--dpi N] [--box X0,Y0,X1,Y1] [--tilt DEGREES]
         [--stretch F] [--explode F] [--eye X,Y,Z] [--mesh on]
         [--parts rock,blocks,tunnel,joints] [--cut x=0,y] [--inside]

Warped by the displacement, coloured by the magnitude of a field, one component
of it (velocity_x, stress_xx), the largest or least principal stress, pressed: +
(stress_major, stress_minor), by block, or joints by their state (joint_state);
red lines show where the blocks were at first. In 3D the rock can be cut open,
finite blocks, the surface of what is dug and joints (as in the scene, by set) be
shown without it, and all from inside what is dug. Needs the packages
python3-vtk9, xvfb and xauth; with a display, leave xvfb-run out.
"""
import dataclasses

import render_data  # first: says it if VTK cannot be loaded
import numpy
import render_parts as parts_of
from render_data import (choose_exaggeration, find_rock, magnitudes_of,
                         move_points, read_grid, unit_of, values_of,
                         vtk_to_numpy)
from render_options import DARK, RED, View, read_arguments
from render_scene import (COLOURS, corners_of, make_bar, make_caption,
                          make_colours, make_faces, make_legend, make_lines,
                          make_numbers, make_outlines, make_rock,
                          numbers_in_space, write_picture)

__all__ = ["COLOURS", "RED", "View", "draw"]


def when(collection, time, view):
    """The stage of a state, with the time where that is one of motion.

    In quasi-static stages time is scaled with the masses and means nothing."""
    stage = render_data.stage_of(collection, view.time_index)
    if stage is None:
        return f"t = {time:.4g} s"
    kind = render_data.kind_of_stage(collection, stage.partition(" ")[2])
    return stage + (f", t = {time:.4g} s" if kind == "dynamic" else "")


def describe(collection, time, grid, view, factor):
    """The caption."""
    if view.field == "block" and time == 0.:
        n_blocks = len(numpy.setdiff1d(values_of(grid, "block"), [0]))
        lines = [f"{n_blocks} block{'s' if n_blocks != 1 else ''}"]
    else:
        lines = [when(collection, time, view)]
    if factor != 1.:
        lines.append(f"displacement times {factor:g}")
    if view.stretch != 1.:
        lines.append(f"heights times {view.stretch:g}")
    if view.tilt != 0.:
        lines.append(f"bed at {view.tilt:g} degrees")
    if view.explode > 0.:
        lines.append("drawn apart")
    if view.field in ("stress_major", "stress_minor"):
        lines.append("pressed: +")
    if view.field not in ("block", "joint_state"):
        values = magnitudes_of(grid, view.field)
        if not numpy.isfinite(values).all():
            lines.append("grey: no value")
        if not values.any():
            lines.append(f"{view.field} 0 everywhere")
    text = "; ".join(lines)
    if view.field in ("block", "joint_state") or view.has_depth() or not (
            values_of(grid, "displacement").any()):
        return text
    return text + "\nred: first position of the blocks"


def solid_parts(collection, grid, view):
    """The parts of a scene in 3D as grids not yet moved, and how opaque each is.

    Through rock whose joints have the colours of their states these are seen."""
    is_state = view.field == "joint_state"
    if "rock" in view.parts and is_state and not view.cut:
        # its cells, one behind the other, would hide the joints
        yield parts_of.surface_of(grid, lambda faces: numpy.ones(
            len(faces), bool)), 0.15
    elif "rock" in view.parts:
        yield grid, 1.
    if "tunnel" in view.parts:
        first = read_grid(find_rock(collection, 0)[1])
        surface = parts_of.tunnel_surface(grid, first)
        if surface is not None:
            is_alone = view.parts == ("tunnel",) or view.inside
            yield surface, 1. if is_alone and not is_state else 0.3
    if "blocks" in view.parts:
        finite, _ = render_data.read_classes(collection)
        if finite is None:
            render_data.fail("there is no summary.json beside the collection, "
                             "which says which blocks are finite.")
        blocks = parts_of.keep_blocks(grid, finite)
        if blocks.GetNumberOfCells():  # faces of joints would lie on them
            yield blocks, 0. if is_state else 1.


def move_parts(grid, parts, factor, view):
    """Parts of a grid displaced, the rock cut open, and how opaque each is."""
    for part, opacity in parts:
        moved = move_points(part, factor, view)
        for piece in (parts_of.cut_open(moved, view.cut, view.eye)
                      if view.cut and part is grid else [moved]):
            yield piece, opacity


def paint(grids, view, scale):
    """Actors of grids by the field, and its colours."""
    if view.field == "joint_state":
        values = [numpy.zeros(grid.GetNumberOfPoints()) for grid, _ in grids]
        is_magnitude = True
    else:
        values = [magnitudes_of(grid, view.field) / scale for grid, _ in grids]
        is_magnitude = values_of(grids[0][0], view.field).ndim > 1
    colours = make_colours(numpy.concatenate(values), is_magnitude, view)
    actors = []
    for (grid, opacity), shown in zip(grids, values):
        actors.append(make_rock(grid, shown, colours, view))
        actors[-1].GetProperty().SetOpacity(opacity)
    return actors, colours


def draw_joints(collection, time, view, places):
    """Actors of joints, by their state or by set, and what colours mean."""
    actors, legend, width = [], [], 2.5 * view.dpi / 100.
    if view.field == "joint_state":
        corners, state = parts_of.joint_faces(collection, time)
        for k, name in enumerate(parts_of.JOINT_STATES):
            if (state == k).any():
                colour = parts_of.STATE_COLOURS[k]
                actors.append(make_faces(corners[state == k], colour,
                                         width=width))
                legend.append((colour, name))
    if "joints" in view.parts:
        low, high = places.min(axis=0), places.max(axis=0)
        margin = 0. if "rock" in view.parts else 0.1 * (high - low).max()
        for k, (name, polygons) in enumerate(parts_of.joint_planes(
                collection, low - margin, high + margin).items()):
            colour = parts_of.SET_COLOURS[k % 8]
            actors.append(make_faces(polygons, colour, 0.25, width))
            legend.append((colour, name))
    return actors, legend


def draw(collection, picture, view):
    """Picture of one time of a collection; `view` says what it shows."""
    time, path = find_rock(collection, view.time_index)
    view = view.in_pixels()
    grid = read_grid(path)
    is_flat = grid.GetBounds()[4] == grid.GetBounds()[5]
    if is_flat and (view.cut or view.inside or set(view.parts) - {
            "rock", "joints"}):
        render_data.fail("parts other than rock and joints, cuts and the view "
                         "from inside are of scenes in 3D.")
    parts = [(grid, 1.)] if is_flat else list(solid_parts(collection, grid,
                                                          view))
    factor = choose_exaggeration(grid, view, [part for part, _ in parts])
    caption = describe(collection, time, grid, view, factor)
    is_block, is_state = view.field == "block", view.field == "joint_state"
    is_still = not values_of(grid, "displacement").any()
    moved = move_points(grid, factor, view)
    first = moved if is_block else move_points(grid, 0., view)
    grids = [(moved, 1.)] if is_flat else list(move_parts(grid, parts, factor,
                                                          view))
    unit, scale = ("", 1.) if is_state else unit_of(grid, view.field)
    actors, colours = paint(grids, view, scale) if grids else ([], None)
    width = 1.5 * view.dpi / 100.
    if is_flat or not view.has_depth():
        actors += make_outlines(
            first, DARK if is_block or is_state or is_still else RED, width)
    if view.cut and "rock" in view.parts:
        actors += [make_lines(lines, DARK, width) for lines in
                   parts_of.section_lines(moved, view.cut, view.eye)
                   if lines.GetNumberOfCells()]
    elif not is_flat and (view.has_depth() or not is_block):
        for one, _ in grids:
            actors += make_outlines(one, DARK, width)
    exposed = parts_of.exposed_blocks(collection, grid)
    if is_block and is_flat:
        actors += make_numbers(moved, view, exposed)
    elif "blocks" in view.parts and not view.inside:
        actors += numbers_in_space(moved, view, exposed)
    places = numpy.vstack([vtk_to_numpy(g.GetPoints().GetData()) for g in (
        [moved, first] if is_flat or not view.has_depth() else
        [g for g, _ in grids] or [moved])])
    if view.box:
        places = corners_of(view.box, view.stretch)
    faces, legend = draw_joints(collection, time, view, places)
    actors += faces

    has_bar = not (is_block or is_state or colours is None) and any(
        render_data.finite(magnitudes_of(part, view.field)).any() for part, _ in grids)

    def make_texts(size):
        """Caption, and colour bar or legend for a size of the picture."""
        texts = [make_caption(caption, size)]
        texts += make_legend(legend, size)
        if has_bar:
            texts += make_bar(colours, f"{view.field} [{unit}]", size,
                              len(legend))
        return texts

    if not actors:
        render_data.fail("there is nothing to show of these parts at this "
                         "time.")
    inside = parts_of.place_inside(collection, grid) if view.inside else None
    write_picture(actors, make_texts, places, view, picture, inside)


if __name__ == "__main__":
    draw(*read_arguments(__doc__.splitlines()[0]))

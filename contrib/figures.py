#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of a run from its output folder: maps, histories, factors, ledger.

usage: contrib/figures.py RUN --to FOLDER [--compare OTHER --label A B]
         [--stage NAME] [--exaggeration auto|N] [--box=X0,Y0,X1,Y1]
         [--format png|pdf|svg] [--dpi N]

RUN and OTHER are output folders. Writes, as far as the run has what they show,

  blocks.png         blocks, joints, and what the stages dig
  deformed.png       displacements after the last stage
  deformed_NAME.png  and after the stage NAME
  stress.png         principal stresses after NAME or the last stage
  plastic.png        plastic strain after it
  joint_states.png   where joints are bonded, stick, slide or are open after it
  displacements.png  monitors of blocks and points by stage
  trials.png         slip against the factors tried, after NAME or the last
  factors.png        factors by stage, from trials and from rigid blocks
  joint_forces.png   monitors of joints by stage
  joint_stresses.png mean stresses on the faces of the finite blocks (2D only)
  energy.png         terms of the energy ledger, and how well it closes

Where limit equilibrium alone was asked for, no step is taken: what would show
one is left out. In 3D blocks.png is of the finite blocks, what is dug and the joints, the maps are
of the rock cut open, inside.png is seen from what is dug. Joints have the colour
of their set; of more than 12 finite blocks those that are exposed have numbers.

With --compare the curves of both runs, the first solid and the second dashed,
stand in one figure, and their displacements side by side. Needs the packages
python3-matplotlib and python3-vtk9, in 3D also xvfb and xauth (then call it as
xvfb-run -a contrib/figures.py ...).
"""
import argparse
import pathlib

import render_data  # noqa: F401, first: says it if VTK cannot be loaded
import figures_curves as curves
import figures_factors as factors
from figures_fields import draw_joint_states, draw_plastic, draw_stress
from figures_maps import draw_block_map, draw_deformed
from figures_run import Run, fail
from figures_style import (NO_STEPS, ROCK_COLOURS, block_colour, pale,
                           reduce_colours, save, to_rgb)
from render import View, draw
from render_options import numbers
from vtkmodules.vtkCommonCore import vtkLogger


def exaggeration(text):
    """The factor of an option; 0 for auto."""
    value = 0. if text == "auto" else float(text)
    if value < 0. or (value == 0. and text != "auto"):
        raise ValueError
    return value


def read_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.error = lambda message: fail(f"{message}; see --help.")
    parser.add_argument("run", metavar="RUN", help="output folder of a run")
    parser.add_argument("--to", required=True, metavar="FOLDER",
                        help="where the figures go; made if it is not there")
    parser.add_argument("--compare", metavar="OTHER",
                        help="output folder of a second run")
    parser.add_argument("--label", nargs=2, default=("", ""),
                        metavar=("A", "B"), help="names of the two runs in "
                        "legends (default: their folders)")
    parser.add_argument("--stage", metavar="NAME", help="a stage whose "
                        "displacements and trials are wanted besides")
    parser.add_argument("--exaggeration", type=exaggeration, default=0.,
                        metavar="auto|N", help="factor of displacements "
                        "(default auto: the largest is 3 %% of the picture)")
    parser.add_argument("--box", type=numbers, default=(),
                        metavar="X0,Y0,X1,Y1", help="part of a plane scene to "
                        "show, as in --box=-9,0,9,9 (default: about what is "
                        "dug and could move)")
    parser.add_argument("--format", default="png", choices=("png", "pdf",
                                                            "svg"),
                        help="of the files (default png); maps of scenes in "
                        "3D are pixels in all")
    parser.add_argument("--dpi", type=float, default=100., help="pixels per "
                        "inch of png files and of pictures in 3D (default 100)")
    arguments = parser.parse_args()
    if not 10. <= arguments.dpi <= 2400.:
        fail("--dpi takes a number from 10 to 2400.")
    box = arguments.box
    if box and (len(box) != 4 or box[0] >= box[2] or box[1] >= box[3]):
        fail("--box takes four numbers: the least, then the greatest x and y.")
    return arguments


def read_runs(arguments):
    """The one or two runs; those that cannot be compared end the program."""
    runs = [Run(arguments.run, arguments.label[0])]
    if arguments.compare:
        runs.append(Run(arguments.compare, arguments.label[1]))
        for what, a, b in (("stages", runs[0].stages, runs[1].stages),
                           ("blocks", [*runs[0].blocks], [*runs[1].blocks])):
            if a != b:
                fail(f"'{arguments.run}' and '{arguments.compare}' have not "
                     f"the same {what} ({len(a)} and {len(b)}); compare runs "
                     "of one scene.")
    name = arguments.stage
    if name and name not in runs[0].stages:
        fail(f"there is no stage '{name}'; the run has "
             f"{', '.join(runs[0].stages) or 'none'}.")
    return runs


def views_of_solids(run, arguments):
    """Names and views of the maps of a scene in 3D."""
    colours = [pale(block_colour(run, number)) if number in
               run.finite_blocks() else to_rgb(ROCK_COLOURS[0])
               for number in range(1, max(run.blocks, default=0) + 1)]
    last = run.stages.index(arguments.stage) if arguments.stage else (
        len(run.stages) - 1)
    index = run.state_of_stage(last)
    open_rock = {"cut": (("y", None),), "eye": (0.5, -1.6, 0.7)}
    yield "blocks", View(
        time_index=index, field="block", block_colours=tuple(colours),
        parts=("tunnel", "blocks", "joints"))
    wanted = {"deformed": len(run.stages) - 1}
    if arguments.stage:
        wanted[f"deformed_{arguments.stage}"] = last
    for name, stage in wanted.items():
        yield name, View(time_index=run.state_of_stage(stage), **open_rock,
                         exaggeration=arguments.exaggeration)
    yield "inside", View(time_index=index, inside=True,
                         parts=("tunnel", "blocks"))
    for field in ("stress_major", "stress_minor", "plastic_strain"):
        yield field, View(time_index=index, field=field, **open_rock)
    yield "joint_states", View(time_index=index, field="joint_state",
                               parts=("tunnel", "blocks"))


def draw_solids(run, folder, arguments):
    """The maps of a scene in 3D, by render.py."""
    if not run.states:
        print("blocks, deformed: no states (solution.pvd)")
        return
    is_dug = run.rock(0).GetNumberOfCells() > run.rock(
        len(run.states) - 1).GetNumberOfCells()
    has_plastic = run.rock(-1).GetPointData().HasArray("plastic_strain")
    for name, view in views_of_solids(run, arguments):
        if name == "plastic_strain" and not has_plastic:
            print("plastic_strain: no plastic material")
            continue
        if not run.takes_steps() and name.startswith(("deformed", "joint_states")):
            print(f"{name}: {NO_STEPS}")
            continue
        if name == "inside" and not is_dug:
            print("inside: nothing is dug")
            continue
        view.dpi = arguments.dpi
        path = folder / f"{name}.{arguments.format}"
        draw(run.folder / "solution.pvd", path, view)
        if path.suffix == ".png" and arguments.dpi <= 100.:
            reduce_colours(path)
        else:
            print(f"{path}  {path.stat().st_size / 1000:.0f} kB")


def wanted_figures(runs, arguments):
    """Names and functions of the figures in turn."""
    box, factor, stage = arguments.box, arguments.exaggeration, arguments.stage
    if runs[0].is_plane:
        yield "blocks", lambda: draw_block_map(runs[0], box)
        yield "deformed", lambda: draw_deformed(runs, None, factor, box)
        if stage:
            yield (f"deformed_{stage}",
                   lambda: draw_deformed(runs, stage, factor, box))
        yield "stress", lambda: draw_stress(runs[0], stage, box)
        yield "plastic", lambda: draw_plastic(runs[0], stage, box)
        yield "joint_states", lambda: draw_joint_states(runs[0], stage, box)
    yield "displacements", lambda: curves.draw_displacements(runs)
    yield "trials", lambda: factors.draw_trials(runs, stage)
    yield "factors", lambda: factors.draw_factors(runs)
    yield "joint_forces", lambda: curves.draw_joint_forces(runs)
    yield "joint_stresses", lambda: curves.draw_joint_stresses(runs)
    yield "energy", lambda: curves.draw_energy(runs)


def main():
    """Read the runs, draw what they have, say what they have not."""
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # render.py says it
    arguments = read_arguments()
    runs = read_runs(arguments)
    folder = pathlib.Path(arguments.to)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        fail(f"the folder '{folder}' cannot be made: {error.strerror}.")
    if not runs[0].is_plane:
        draw_solids(runs[0], folder, arguments)
    for name, make in wanted_figures(runs, arguments):
        figure = make()
        if isinstance(figure, str):
            print(f"{name}: {figure}")
        else:
            save(figure, folder / f"{name}.{arguments.format}", arguments.dpi)


if __name__ == "__main__":
    main()

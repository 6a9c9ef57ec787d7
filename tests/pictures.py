#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures and STL files of runs, by contrib/figures.py, render.py, blocks_stl.py.

usage: pictures.py KEYBLOCK CONTRIB PRM FOLDER CASE

network: maps of a plane scene with hundreds of joints have a legend by set and
numbers of exposed blocks only; SVG and PDF are what they say.
solid: in 3D there is a picture of each part, cut, inside, and of joint states.
curves: blocks of monitors, lines of many blocks, states by the names of stages,
fields without values, all fields named where one is not there, exaggeration by what
is shown.
stl: surfaces of blocks are closed, outward, and hold the volume of summary.json.
missing: without a display, VTK, Matplotlib or numpy there is one sentence and exit
code 1.
"""
import collections
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys

KEYBLOCK, CONTRIB, PRM, FOLDER, CASE = sys.argv[1:6]
CONTRIB, PRM, FOLDER = map(pathlib.Path, (CONTRIB, PRM, FOLDER))
STEPS = [f"Stages/stage_{k}/Maximum steps=1" for k in range(1, 9)]
SCENES = {
    "network": ("tutorial/first_tunnel", [
        "Safety factor/Blocks=none", "Mesh/Size=4", "Joint sets/east/Spacing=1.2",
        "Joint sets/west/Spacing=1.2", "Joint sets/east/Radius law=constant",
        "Joint sets/west/Radius law=constant", "Joint sets/east/Radius mean=4",
        "Joint sets/west/Radius mean=4", *(
            f"Joint sets/{name}/Region {entry}" for name in ("east", "west")
            for entry in ("corner=-20, -10", "size=40, 35")), "Stages/heading/Maximum steps=100",
        "Stages/bench/Maximum steps=100", "Output/Write VTU=true"]),
    "curves": ("verification/bolted_incline", [
        "Output/Write VTU=true", "Monitors/Names=one,place,other",
        "Monitors/one/Kind=block", "Monitors/one/Block=1",
        "Monitors/one/Location=1e3,1e3", "Monitors/place/Kind=point",
        "Monitors/other/Kind=point", "Monitors/other/Location=1,0"]),
    "": ("study/powerhouse_3d", [
        "Safety factor/Blocks=none", "Output/Write VTU=true",
        "Mesh/Size at excavation=14", "Mesh/Size=60", *STEPS])}
DISPLAY = ["xvfb-run", "-a"] if shutil.which("xvfb-run") else []
PYTHON = "/usr/bin/python3"


def has(module):
    """Whether the Python of the scripts has a module."""
    return subprocess.run([PYTHON, "-c", f"import {module}"],
                          capture_output=True).returncode == 0


def run_scene():
    """Run the scene of the case; its folder and summary."""
    scene, settings = SCENES.get(CASE, SCENES[""])
    folder = FOLDER / "output"
    subprocess.run([KEYBLOCK, PRM / f"{scene}.prm", "--output", folder]
                   + [word for s in settings for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return folder, json.loads((folder / "summary.json").read_text())


def call(*command):
    """Run a script that has to succeed; what it says."""
    done = subprocess.run([str(word) for word in command], capture_output=True,
                          text=True)
    assert done.returncode == 0, (command, done.stdout, done.stderr)
    return done.stdout


def finite_blocks(summary):
    """Blocks that could move, by number."""
    return {b["id"]: b for b in summary["blocks"]
            if not {"infinite", "rigid"} & set(b["class"])}


# labels and captions of render.py, also where there is no summary.json
LABELS = """
import pathlib
import sys
sys.path.insert(0, sys.argv[1])
import render
import render_data
import render_parts
import render_scene
collection = sys.argv[2] + "/solution.pvd"
view = render.View(field="block", size=(3000, 3000))
for index in (0, -1):
    time, path = render_data.find_rock(collection, index)
    grid = render_data.read_grid(path)
    exposed = set(render_parts.exposed_blocks(collection, grid))
    numbers = [int(text.GetInput()) for text in render_scene.make_numbers(
        grid, view, list(exposed))]
    assert len(numbers) == len(set(numbers)) > 1, numbers
    assert set(numbers) <= exposed and 0 not in numbers, (numbers, exposed)
    moving = render.describe(collection, time, grid, render.View(), 1.)
    assert ("red" in moving) == (index != 0), moving
    assert ("displacement 0 everywhere" in moving) == (index == 0), moving
places = {n: render_data.numpy.array((x, 0., 0.))
          for n, x in ((1, 0.), (2, 0.4), (3, 2.))}
put = [text.GetInput() for text in render_scene.labels_at(places, 1., view,
                                                          True)]
assert put == ["1", "3"], put
pathlib.Path(sys.argv[2], "summary.json").unlink()
assert set(render_parts.exposed_blocks(collection, grid)) == exposed
"""


def check_network():
    """Legends and labels of maps with many joints and blocks."""
    folder, summary = run_scene()
    blocks = finite_blocks(summary)
    exposed = {n for n, b in blocks.items() if "exposed_stage" in b}
    n_joints = len((folder / "joints.csv").read_text().splitlines()) - 1
    assert n_joints > 150 and len(blocks) > 40, (n_joints, len(blocks))
    assert 1 < len(exposed) < len(blocks) / 2, exposed
    call(CONTRIB / "figures.py", folder, "--to", FOLDER / "svg", "--format",
         "svg")
    for name in ("blocks", "deformed", "stress", "joint_states"):
        text = (FOLDER / "svg" / f"{name}.svg").read_text()
        shown = [t.strip() for t in re.findall(r"<text[^>]*>([^<]*)</text>",
                                               text)]
        labels = {int(n) for n in re.findall(r'id="label_(\d+)"', text)}
        assert len(labels) > 1 and labels <= exposed, (name, labels - exposed)
        assert len(shown) < 100, (name, len(shown))
        assert not any(re.match(r"(east|west)\.", t) for t in shown), name
        if name == "blocks":
            assert {"east", "west"} <= set(shown), shown
        if name == "joint_states":
            assert any(t.startswith("sticking") for t in shown), shown
    call(CONTRIB / "figures.py", folder, "--to", FOLDER / "pdf", "--format",
         "pdf")
    assert (FOLDER / "pdf/blocks.pdf").read_bytes()[:5] == b"%PDF-"
    sizes = {}
    for dpi in (50, 100):
        path = FOLDER / f"{dpi}.png"
        call(CONTRIB / "figures.py", folder, "--to", FOLDER / str(dpi),
             "--dpi", dpi)
        path = FOLDER / str(dpi) / "blocks.png"
        sizes[dpi] = struct.unpack(">II", path.read_bytes()[16:24])
    # a box around what is drawn has both its ends rounded outwards
    assert all(abs(2 * a - b) <= 4 for a, b in zip(sizes[50], sizes[100])), sizes
    call(PYTHON, "-c", LABELS, CONTRIB, folder)


def colours_of(path, begin=0.):
    """How many pixels a PNG file has of each colour, by Pillow.

    Of what is on the right of a share of its width."""
    text = subprocess.run(
        [PYTHON, "-c", "import sys, PIL.Image as i; p = i.open(sys.argv[1])."
         "convert('RGB'); w, h = p.size; p = p.crop((int(w * float("
         "sys.argv[2])), 0, w, h)); print(p.size[0], p.size[1]); "
         "[print(n, *c) for n, c in p.getcolors(10**7)]", path, str(begin)],
        capture_output=True, text=True, check=True).stdout
    size, *rows = [tuple(map(int, line.split())) for line in text.splitlines()]
    return size, {row[1:]: row[0] for row in rows}


def check_solid():
    """Pictures of parts of a scene in 3D."""
    folder, _ = run_scene()
    said = call(*DISPLAY, CONTRIB / "figures.py", folder, "--to",
                FOLDER / "curves")
    assert "joint_stresses: drawn in 2D only" in said, said
    seen = {}
    for name, options in {
            "rock": (), "cut": ("--cut", "x,y"), "blocks": ("--parts", "blocks"),
            "tunnel": ("--parts", "tunnel"), "inside": (
                "--inside", "--parts", "tunnel,blocks"),
            "joints": ("--parts", "blocks,joints", "--field", "block"),
            "major": ("--field", "stress_major", "--cut", "y"),
            "both": ("--field", "stress_xy", "--parts", "rock,joints"),
            "states_inside": ("--field", "joint_state", "--inside"),
            "states_rock": ("--field", "joint_state"),
            "states": ("--field", "joint_state", "--parts", "blocks")}.items():
        path = FOLDER / f"{name}.png"
        call(*DISPLAY, CONTRIB / "render.py", folder / "solution.pvd", path,
             "--size", "300,240", *options)
        size, seen[name] = colours_of(path)
        assert len(seen[name]) > 5, name
        drawn = sum(seen[name].values()) - seen[name].get((255, 255, 255), 0)
        assert drawn > 0.05 * size[0] * size[1], (name, drawn)
    assert seen["cut"] != seen["rock"] and seen["inside"] != seen["tunnel"]
    assert any(abs(r - 33) < 9 and abs(g - 135) < 9 and abs(b - 230) < 9
               for r, g, b in seen["states"]), "no joint that sticks"
    # through the rock, too: its surface alone is drawn, not each of its cells
    blue = [sum(n for (r, _, b), n in colours.items() if b > r + 90) for colours
            in (seen["states_rock"],
                colours_of(FOLDER / "states_rock.png", 0.78)[1])]
    assert blue[0] > blue[1] + 50, blue  # besides the legend's
    # the legend of joints, and the bar from pale to blue
    side = colours_of(FOLDER / "both.png", 0.8)[1]
    for colour in ((51, 33, 135), (204, 102, 120), (41, 92, 168)):
        assert any(max(abs(a - b) for a, b in zip(colour, one)) < 12
                   for one in side), (colour, side)
    # through the walls of what is dug joints are seen
    blue = [sum(n for (r, _, b), n in colours_of(
        FOLDER / "states_inside.png", share)[1].items() if b > r + 40)
        for share in (0., 0.78)]
    assert blue[0] > blue[1] + 400, blue
    for ending, begin in ((".pdf", b"%PDF-1"), (".svg", b"<svg ")):
        path = FOLDER / f"blocks{ending}"
        call(*DISPLAY, CONTRIB / "render.py", folder / "solution.pvd", path,
             "--parts", "blocks", "--dpi", 150)
        assert path.read_bytes().startswith(begin)
    assert 'viewBox="0 0 1500 ' in path.read_text()[:200]


def volume_of(path):
    """Volume within a binary STL file, whose edges are all met twice."""
    data, edges, volume = path.read_bytes(), collections.Counter(), 0.
    n, = struct.unpack("<I", data[80:84])
    assert len(data) == 84 + 50 * n, path
    origin = None
    for k in range(n):
        row = struct.unpack("<12fH", data[84 + 50 * k:134 + 50 * k])
        points = [row[3:6], row[6:9], row[9:12]]
        origin = origin or points[0]
        for a, b in zip(points, points[1:] + points[:1]):
            edges[a, b] += 1
        (a, b, c), (d, e, f), (g, h, i) = (
            [x - y for x, y in zip(p, origin)] for p in points)
        volume += (a * (e * i - f * h) - b * (d * i - f * g)
                   + c * (d * h - e * g)) / 6.
    for (a, b), count in edges.items():
        assert count == 1 and edges.get((b, a)) == 1, (path, a, b)
    return volume


# what needs neither a display nor a run
PARTS = """
import sys
sys.path.insert(0, sys.argv[1])
import types
import numpy
import figures_style
import render_data
import render_scene
from render_options import View
view = View(field="safety factor", exaggeration=0.)
colours = render_scene.make_colours(numpy.array([numpy.nan, 2., 3., numpy.inf]),
                                    False, view)
assert colours.GetRange() == (2., 3.), colours.GetRange()
assert len(set(colours.GetNanColor())) == 1, colours.GetNanColor()
colours = render_scene.make_colours(numpy.array([numpy.nan]), False, view)
assert numpy.isfinite(colours.GetRange()).all(), colours.GetRange()

def grid(size, moved):
    corners = size * numpy.array([[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.],
                                   [0., 1., 0.]]])
    return render_data.make_grid(corners, {
        "displacement": numpy.full((1, 4, 3), moved)})

large, small = grid(1000., 1e-3), grid(10., 5e-3)
assert render_data.choose_exaggeration(large, view, [small]) == 50.
assert render_data.choose_exaggeration(grid(10., 1e-9), view) == 1000.
run = types.SimpleNamespace(named_blocks=lambda: list(range(1, 13)))
looks = {(figures_style.block_colour(run, n), bool(figures_style.block_line(
    run, n))) for n in run.named_blocks()}
assert len(looks) == 12, looks
assert figures_style.fitting_unit("m", [[0.9997e-3]]) == ("mm", 1e-3)
assert figures_style.fitting_unit("m", [[0.9e-3]])[1] == 1e-6
from report import geometry
tall = numpy.array([[x, y, z] for x in (0., 6.) for y in (0., 6.) for z in (0., 20.)])
assert geometry.is_shaft(tall, numpy.array([1., 0., 0.]))
assert not geometry.is_shaft(tall[:, [2, 0, 1]], numpy.array([1., 0., 0.]))
import figures_maps
uneven = grid(1., 1.05e-3)
render_data.vtk_to_numpy(uneven.GetPointData().GetArray("displacement"))[1:] = 0.
unit, size, most = figures_maps.scale_of([uneven])
assert unit == "mm" and abs(most[0] - 1.05 * 3**0.5) < 1e-5, (unit, most)
"""

# a run whose states have all the same time, as stages are static
STATES = """
import sys
sys.path.insert(0, sys.argv[1])
import figures_run
import render
run = figures_run.Run(sys.argv[2])
assert len(run.stages) == 1 and run.state_of_stage(0) == len(run.states) - 1
assert run.block_at("one") == 1
collection = sys.argv[2] + "/solution.pvd"
said = [render.when(collection, 242.4, render.View(time_index=k))
        for k in (0, -1)]
assert said == ["before the first stage", "after rest"], said
"""


def check_curves():
    """Curves of monitors; what pictures take from fields and stages."""
    folder, _ = run_scene()
    call(PYTHON, "-c", PARTS, CONTRIB)
    call(CONTRIB / "figures.py", folder, "--to", FOLDER, "--format", "svg")
    text = (FOLDER / "displacements.svg").read_text()
    for label in ("block 1 (one)", "point place", "point other"):
        assert f">{label}</text>" in text, label
    colours = re.findall(r"stroke: (#\w+); stroke-width: 1.5", text)
    assert len(set(colours)) >= 3, colours
    for path in FOLDER.glob("*.svg"):  # nothing is cut off
        text = path.read_text()
        *_, wide, high = map(float, re.search(r'viewBox="([^"]*)"',
                                              text)[1].split())
        places = re.findall(r'<text[^>]*translate\(([-\d.]+) ([-\d.]+)\)',
                            text)
        assert all(0. < float(x) < wide and 0. < float(y) < high
                   for x, y in places), path
    # what shows steps is left out where none was taken
    still = FOLDER / "still"
    shutil.copytree(folder, still)
    (still / "used.prm").write_text(re.sub(
        "(?m)(^ *set Method *= )bisection.*", r"\1limit equilibrium",
        (still / "used.prm").read_text()))
    said = call(CONTRIB / "figures.py", still, "--to", FOLDER / "still_figures")
    for name in ("joint_states", "joint_stresses"):
        assert f"{name}: no step was taken" in said, said
        assert not (FOLDER / "still_figures" / f"{name}.png").exists()
    path = folder / "solution.pvd"
    done = subprocess.run([CONTRIB / "render.py", path, FOLDER / "none.png", "--field",
                           "nosuch"], capture_output=True, text=True)
    assert done.returncode == 1 and done.stderr.count("\n") == 1, done.stderr
    for field in ("velocity", "stress_xx", "stress_major", "stress_minor", "joint_state"):
        assert f" {field}" in done.stderr, (field, done.stderr)
    path.write_text(re.sub(r'timestep="[^"]*"', 'timestep="0"',
                           path.read_text()))
    call(PYTHON, "-c", STATES, CONTRIB, folder)


def check_stl():
    """Surfaces of blocks against their volumes."""
    folder, summary = run_scene()
    blocks = finite_blocks(summary)
    call(CONTRIB / "blocks_stl.py", folder, FOLDER / "stl")
    files = sorted((FOLDER / "stl").glob("*.stl"))
    assert {f.name for f in files} == {f"block_{n}.stl" for n in blocks}
    for n, block in blocks.items():
        volume = volume_of(FOLDER / "stl" / f"block_{n}.stl")
        assert abs(volume / block["volume"] - 1.) < 1e-6, (n, volume, block)
    call(CONTRIB / "blocks_stl.py", folder, FOLDER / "moved", "--state", "-1",
         "--exposed")
    assert len(list((FOLDER / "moved").glob("*.stl"))) == sum(
        "exposed_stage" in b for b in blocks.values()) < len(blocks)
    assert volume_of(FOLDER / "moved/block_1.stl") > 0.


def check_missing():
    """One sentence and exit code 1 for what is missing."""
    folder, _ = run_scene()
    bare = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    picture = FOLDER / "picture.png"
    render = [CONTRIB / "render.py", folder / "solution.pvd", picture]
    figures = [CONTRIB / "figures.py", folder, "--to", FOLDER / "figures"]
    report = [CONTRIB / "keyblock-report", folder, "-o", FOLDER / "report.html"]
    stl = [CONTRIB / "blocks_stl.py", folder, FOLDER / "stl"]
    for module, commands in (
            ("", [render, figures]), ("vtkmodules", [render, figures]),
            ("matplotlib", [figures]), ("numpy", [render, figures, report,
                                                  stl])):
        hidden = FOLDER / f"without_{module}"
        (hidden / (module or "none")).mkdir(parents=True)
        (hidden / (module or "none") / "__init__.py").write_text(
            'raise ImportError("hidden")\n')
        for display in (None, ":9876") if not module else (None,):
            place = {} if display is None else {"DISPLAY": display}
            for command in commands:
                done = subprocess.run(
                    [str(word) for word in command], capture_output=True,
                    text=True, env={**bare, **place, "PYTHONPATH": str(hidden)})
                name = command[0].name
                assert done.returncode == 1, (command, done)
                assert done.stderr.count("\n") == 1, done.stderr
                assert done.stderr.startswith(f"{name}: "), done.stderr
                assert not module or module.lower()[:3] in done.stderr.lower()
                print(done.stderr.strip())
    assert not picture.exists()


shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(parents=True)
needed = {"network": ["vtkmodules", "matplotlib"],
          "curves": ["vtkmodules", "matplotlib", "PIL"], "stl": ["numpy"],
          "missing": ["vtkmodules", "matplotlib"]}.get(CASE, [
              "vtkmodules", "matplotlib", "PIL"])
lacking = [module for module in needed if not has(module)]
if CASE == "solid" and not DISPLAY and not os.environ.get("DISPLAY"):
    lacking.append("a display or xvfb-run")
if lacking:
    print(f"skipped: {PYTHON} lacks {', '.join(lacking)}")
    sys.exit(77)
{"network": check_network, "solid": check_solid, "stl": check_stl,
 "curves": check_curves,
 "missing": check_missing}[CASE]()

#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What contrib/view.py writes and starts, with programs that only pretend.

usage: view.py KEYBLOCK ROOT FOLDER
"""
import os
import pathlib
import shutil
import subprocess
import sys

KEYBLOCK, ROOT, FOLDER = (pathlib.Path(a).absolute() for a in sys.argv[1:4])
RUN, BIN = FOLDER / "two words", FOLDER / "bin"
MODULES = os.pathsep.join([str(FOLDER / "modules"), str(ROOT / "tests")])

# a ParaView that reads the files, says what it is asked for, and knows no array
# that they have not got
SIMPLE = '''
import pathlib
import xml.etree.ElementTree
from unittest.mock import MagicMock
from vtu_reader import Grid

class Source:
    def __init__(self, grids):
        self.grids = grids

    def need(self, where, name, component=None):
        for grid in self.grids:
            arrays = {"POINTS": grid.at_points, "CELLS": grid.at_cells}[where]
            assert name in arrays, f"no {name} at {where}: {list(arrays)}"
            is_vector = any(isinstance(v, tuple) for v in arrays[name][:1])
            assert is_vector == bool(component) or not arrays[name], name

class Warped(Source):
    def __setattr__(self, name, value):
        if name == "Vectors":
            self.need(*value, "Magnitude")
        super().__setattr__(name, value)

class Shown(MagicMock):
    pass

def PVDReader(registrationName, FileName):
    root = xml.etree.ElementTree.parse(FileName).getroot()
    files = [pathlib.Path(e.get("file")) for e in root.iter("DataSet")]
    print(registrationName, len(files))
    return Source([Grid(file) for file in files])

def WarpByVector(registrationName, Input):
    return Warped(Input.grids)

def Show(source, view):
    shown = Shown()
    shown.source = source
    return shown

def SaveScreenshot(path, view):
    pathlib.Path(path).write_text("a picture")

def ColorBy(shown, value):
    shown.source.need(*value)
    print(*value)

for name in ("GetActiveViewOrCreate", "GetAnimationScene", "GetScalarBar",
             "GetColorTransferFunction", "Hide", "Render"):
    globals()[name] = MagicMock()
'''
PROGRAMS = {
    "paraview": 'echo "paraview $*"; exit 3',
    "pvpython": 'for last; do :; done\nexec /usr/bin/python3 "$last"',
    "xvfb-run": 'echo xvfb-run; shift; exec "$@"',
    "xdg-open": 'echo "xdg-open $*"'}


def view(*arguments, programs=(), display=""):
    """Exit code, output and errors, with some programs beside the usual."""
    shutil.rmtree(BIN, ignore_errors=True)
    BIN.mkdir()
    for name in programs:
        (BIN / name).write_text(f"#!/bin/sh\n{PROGRAMS[name]}\n", "utf-8")
        (BIN / name).chmod(0o755)
    for name in ("env", "sh", "python3"):  # and no ParaView of this machine
        (BIN / name).symlink_to(f"/usr/bin/{name}")
    environment = {"PATH": str(BIN), "PYTHONPATH": MODULES}
    if display:
        environment["DISPLAY"] = display
    done = subprocess.run(
        ["/usr/bin/python3", str(ROOT / "contrib" / "view.py"), *arguments],
        capture_output=True, text=True, check=False, env=environment)
    return done.returncode, done.stdout, done.stderr


def run_scene(folder, scene, *settings):
    """Run a scene into a folder."""
    subprocess.run([str(KEYBLOCK), str(ROOT / "prm" / scene), "--output",
                    str(folder), *settings], check=True,
                   stdout=subprocess.DEVNULL)


def starts_paraview():
    """With a display; its exit code is that of the command."""
    code, output, _ = view(str(RUN), programs=["paraview"], display=":7")
    assert code == 3, code
    assert f"paraview --script={RUN}/view.py\n" in output, output


def draws():
    """A picture by pvpython, without a display on one that pretends."""
    picture = FOLDER / "picture.png"
    code, output, errors = view(str(RUN), "--picture", str(picture),
                                programs=["pvpython", "xvfb-run"])
    assert code == 0 and picture.exists(), errors
    states = len(list(RUN.glob("rock_*.vtu")))
    for words in ("xvfb-run", f"rock {states}", f"joints {states}",
                  "POINTS displacement (m) Magnitude",
                  "POINTS pressure (Pa)"):
        assert words in output, f"{words} is not in {output}"
    assert "bolts" not in output
    code, output, errors = view(str(RUN), "--picture", str(picture))
    assert code == 1 and errors.count("\n") == 1, errors


def draws_bolts():
    """Bolts, too, where there are some."""
    code, output, errors = view(
        str(FOLDER / "bolts"), "--picture", str(FOLDER / "bolts.png"),
        programs=["pvpython"], display=":7")
    assert code == 0, errors
    assert "CELLS axial force (N)" in output and "xvfb-run" not in output, output


def moves_along():
    """The script finds its files where its folder is moved to."""
    shutil.copytree(RUN, FOLDER / "moved")
    shutil.move(RUN, FOLDER / "away")
    try:
        subprocess.run(
            ["/usr/bin/python3", str(FOLDER / "moved" / "view.py")], check=True,
            stdout=subprocess.DEVNULL,
            env={"PYTHONPATH": MODULES, "PATH": os.defpath})
    finally:
        shutil.move(FOLDER / "away", RUN)


def falls_back():
    """Without ParaView, or a display, on the report, which can be opened."""
    report = RUN / "report.html"
    for programs, display in (([], ":7"), (["paraview"], "")):
        report.unlink(missing_ok=True)
        code, output, errors = view(str(RUN), programs=programs,
                                    display=display)
        assert code == 0 and report.exists(), errors
        assert output.endswith(f"Report: {report}\n"), output
    code, output, _ = view(str(RUN), "--open", programs=["xdg-open"])
    assert code == 0 and output.endswith(f"xdg-open {report}\n"), output
    assert view(str(RUN), "--open")[0] == 1


def without_states():
    """A run that wrote no files for ParaView still has a report."""
    code, output, errors = view(str(FOLDER / "poor"), programs=["paraview"],
                                display=":7")
    assert code == 0 and "no solution.pvd" in output, errors
    assert (FOLDER / "poor" / "report.html").exists()


def refuses():
    """What is no run ends with one sentence."""
    (FOLDER / "empty").mkdir()
    for folder in ("empty", "nowhere"):
        code, output, errors = view(str(FOLDER / folder))
        assert (code, output) == (1, ""), output
        assert errors.count("\n") == 1 and "summary.json" in errors, errors
    (FOLDER / "moved" / "solution.pvd").write_text("<VTK", "utf-8")
    code, _, errors = view(str(FOLDER / "moved"))
    assert code == 1 and "solution.pvd' cannot be read" in errors, errors


def main():
    """Exit with 1 at the first case that is not as it should be."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    (FOLDER / "modules" / "paraview").mkdir(parents=True)
    (FOLDER / "modules" / "paraview" / "simple.py").write_text(SIMPLE, "utf-8")
    run_scene(RUN, "tutorial/sliding_block.prm")
    run_scene(FOLDER / "poor", "tutorial/sliding_block.prm",
              "--set", "Output/Write VTU=false")
    run_scene(FOLDER / "bolts", "verification/bolted_incline.prm",
              "--set", "Safety factor/Blocks=none")
    for case in (starts_paraview, draws, draws_bolts, moves_along, falls_back,
                 without_states, refuses):
        case()
        print(f"{case.__name__}: as it should be")


if __name__ == "__main__":
    main()

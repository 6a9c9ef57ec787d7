#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shows a run: in ParaView where it is installed, else as a report.

usage: contrib/view.py OUTPUT [--open] [--picture FILE.png]

Writes OUTPUT/view.py, a script that shows rock, joints and bolts in ParaView
(also elsewhere: paraview --script=OUTPUT/view.py), and starts it if there are
ParaView and a display. With --picture pvpython draws a picture instead. Without
ParaView the report of contrib/keyblock-report is written; --open shows it in a
browser (xdg-open), in any case. Exits with 1 and one sentence if OUTPUT is not
that of a run.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent

# what stands before it in the file: FOLDER, IS_PLANE, and ROCK, JOINTS, BOLTS,
# pairs of a time and a file
SCRIPT = '''
import atexit
import os
import shutil
import tempfile
from xml.sax.saxutils import quoteattr
from paraview.simple import *

if "__file__" in globals():
    FOLDER = os.path.dirname(os.path.abspath(__file__))
LISTS = tempfile.mkdtemp()
atexit.register(shutil.rmtree, LISTS, True)


def read(name, states):
    """A source with the times of the states; None if there are none."""
    if not states:
        return None
    lines = ['<VTKFile type="Collection" version="0.1"><Collection>']
    for time, file in states:
        lines.append('<DataSet timestep="%r" part="0" file=%s/>'
                     % (time, quoteattr(os.path.join(FOLDER, file))))
    lines.append("</Collection></VTKFile>")
    path = os.path.join(LISTS, name + ".pvd")
    with open(path, "w") as file:
        file.write("\\n".join(lines))
    return PVDReader(registrationName=name, FileName=path)


def show(source, where, array, component=None, title=None, **settings):
    """The source with its colours, by an array at POINTS or CELLS, and their bar."""
    shown = Show(source, view)
    ColorBy(shown, (where, array, component) if component
            else (where, array))
    shown.RescaleTransferFunctionToDataRange(True)
    shown.SetScalarBarVisibility(view, title is not None)
    if title:
        bar = GetScalarBar(GetColorTransferFunction(array), view)
        bar.Title, bar.ComponentTitle = title, ""
    for name, value in settings.items():
        setattr(shown, name, value)
    return shown


picture = os.environ.get("KEYBLOCK_PICTURE")
view = GetActiveViewOrCreate("RenderView")
if picture:
    view.ViewSize = [1600, 1200]
rock, joints, bolts = (read("rock", ROCK), read("joints", JOINTS),
                       read("bolts", BOLTS))
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
moved = WarpByVector(registrationName="displaced rock", Input=rock)
moved.Vectors = ["POINTS", "displacement (m)"]
Hide(rock, view)
show(moved, "POINTS", "displacement (m)", "Magnitude", "displacement (m)",
     Representation="Surface With Edges" if IS_PLANE else "Surface",
     Opacity=1.0 if IS_PLANE or not joints else 0.5)
if joints:
    show(joints, "POINTS", "pressure (Pa)", title="pressure on joints (Pa)",
         LineWidth=4.0)
if bolts:
    show(bolts, "CELLS", "axial force (N)", title="force of bolts (N)",
         LineWidth=4.0)
if IS_PLANE:
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
else:
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraPosition = [-1.0, -1.6, 1.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
view.ResetCamera()
Render()
if picture:
    SaveScreenshot(picture, view)
'''


def fail(sentence):
    """End the program with a sentence and exit code 1."""
    print(f"view.py: {sentence}", file=sys.stderr)
    sys.exit(1)


def states_of(path, name=None):
    """Pairs of time and file of a .pvd, of those with a name if it is given."""
    if not path.exists():
        return []
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
        return [(float(entry.get("timestep")), entry.get("file"))
                for entry in root.iter("DataSet")
                if name in (None, entry.get("name"))]
    except (OSError, ValueError, TypeError,
            xml.etree.ElementTree.ParseError) as error:
        return fail(f"'{path}' cannot be read ({error}); run the scene again.")


def write_script(folder):
    """Write the script for ParaView; its path, or None without states."""
    try:
        summary = json.loads((folder / "summary.json").read_text("utf-8"))
        is_plane = summary["scene"]["dimension"] == 2
    except (OSError, ValueError, KeyError, TypeError) as error:
        fail(f"'{folder / 'summary.json'}' cannot be read ({error}); name the "
             "output folder of a run that has ended.")
    states = {"ROCK": states_of(folder / "solution.pvd", "rock"),
              "JOINTS": states_of(folder / "solution.pvd", "interface"),
              "BOLTS": states_of(folder / "bolts.pvd")}
    if not states["ROCK"]:
        print("There is nothing for ParaView: the run wrote no solution.pvd "
              "(Output/Write VTU = false).")
        return None
    path = folder / "view.py"
    text = [f'"""Shows this run: paraview --script={path.name}"""',
            f"FOLDER = {str(folder)!r}", f"IS_PLANE = {is_plane}"]
    for name, pairs in states.items():
        text += [f"{name} = [", *(f"    {pair!r}," for pair in pairs), "]"]
    try:
        path.write_text("\n".join(text) + SCRIPT, encoding="utf-8")
    except OSError as error:
        fail(f"'{path}' cannot be written: {error.strerror}.")
    print(f"Script for ParaView: {path}")
    return path


def run(command, **settings):
    """Run a program, behind what was printed so far; its exit code."""
    sys.stdout.flush()
    return subprocess.run(command, check=False, **settings).returncode


def has_display():
    """Whether windows can be opened."""
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def draw(script, picture):
    """A picture by pvpython; without a display on that of xvfb-run."""
    if script is None:
        fail("There is nothing to draw.")
    program = shutil.which("pvpython") or fail(
        "There is no pvpython to draw the picture; install ParaView, or use "
        "contrib/render.py.")
    command = [program, "--force-offscreen-rendering", str(script)]
    if not has_display() and shutil.which("xvfb-run"):
        command = ["xvfb-run", "-a", *command]
    code = run(command, env=dict(os.environ,
                                 KEYBLOCK_PICTURE=str(picture.resolve())))
    if code != 0 or not picture.exists():
        fail(f"pvpython ended with {code} and drew no '{picture}'.")
    print(f"Picture: {picture}")


def show_report(folder, is_opened):
    """Write the report, and show it in a browser."""
    report = folder / "report.html"
    code = run(["/usr/bin/python3", str(HERE / "keyblock-report"), str(folder),
                "-o", str(report)], stdout=subprocess.DEVNULL)
    if code != 0:
        sys.exit(code)
    print(f"Report: {report}")
    if is_opened:
        program = shutil.which("xdg-open") or fail(
            "There is no xdg-open; open the report in a browser.")
        sys.exit(run([program, str(report)]))


def main():
    """Read the command line, and show the run as well as is possible."""
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", metavar="OUTPUT", type=pathlib.Path,
                        help="output folder of a run")
    parser.add_argument("--open", action="store_true",
                        help="show the report in a browser")
    parser.add_argument("--picture", metavar="FILE.png", type=pathlib.Path,
                        help="draw a picture by pvpython instead")
    arguments = parser.parse_args()
    folder = arguments.output.resolve()
    script = write_script(folder)
    paraview = shutil.which("paraview")
    if arguments.picture:
        draw(script, arguments.picture)
    elif script and paraview and has_display() and not arguments.open:
        sys.exit(run([paraview, f"--script={script}"]))
    else:
        show_report(folder, arguments.open)


if __name__ == "__main__":
    main()

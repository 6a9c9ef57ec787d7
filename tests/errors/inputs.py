#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Inputs that a command line alone cannot give: files, pipes, full disks.

usage: inputs.py KEYBLOCK PRM CASE

CASE is the name of a function below. In a folder of its own it makes the
input, runs the program and looks at how it ends.
"""
import json
import math
import os
import pathlib
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

KEYBLOCK, PRM = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
INCLINE = PRM / "verification" / "incline_30.prm"
SHORT = ["--set", "Stages/slide/Maximum steps=5",
         "--set", "Stages/rest/Maximum steps=5"]


def run(arguments, **options):
    """The program in this folder."""
    return subprocess.run([str(KEYBLOCK)] + [str(a) for a in arguments],
                          capture_output=True, check=False, **options)


def refused(done, fragment, code=1):
    """One sentence, with the fragment."""
    message = done.stderr.decode("utf-8")
    print(message)
    assert done.returncode == code, done.returncode
    assert message.startswith("Error: " if code == 1 else "Failed: ")
    assert message.strip().count("\n") == 0, "not one line"
    assert fragment in message, f"'{fragment}' is missing"


def valid(done, warning=None):
    """No error, and the warning if there is to be one; else none."""
    print(done.stderr.decode("utf-8"))
    text = done.stdout.decode("utf-8")
    found = [line for line in text.split("\n") if line.startswith("Warning")]
    print("\n".join(found))
    assert done.returncode == 0, done.returncode
    assert "The scene is valid." in text
    if warning is None:
        assert not found
    else:
        assert any(warning in line for line in found), f"no '{warning}'"


def validate(scene, settings=()):
    """Validate with entries set."""
    return run(["--validate", scene]
               + [word for s in settings for word in ("--set", s)])


def long_values():
    incline, endless = INCLINE.read_text("utf-8"), "1" * 100000
    points = "; ".join(f"{i / 2000}, 0" for i in range(2000))
    for change, fragment in (
            (("set Dip = 40", f"set Vertices = {points}; 2.0o, 0"),
             "number 4001 of it is '2.0o'; correct it"),
            (("set Dip = 40", f"set Dip = 3o{endless}"), "is not a number"),
            (("set Dip = 40", f"set Dip = 3,{endless}"),
             "numbers have a point"),
            (("set Dip = 40", f"set {endless} = 30"), "there is no entry"),
            (("subsection Materials", f"subsection {endless}"),
             "there is no section"),
            (("set Dip = 40", endless), "begins with none of set"),
            (("set Dimension = 2", f"set Dimension = 2\nset K0 = 0,{endless}"),
             "there is no entry 'K0'"),
            (("set Gravity = ", f"set Gravity = rand{' ' * 100000}(1) + "),
             "contains rand()")):
        assert change[0] in incline, change[0]
        pathlib.Path("s.prm").write_text(incline.replace(*change, 1), "utf-8")
        done = validate("s.prm")
        refused(done, fragment)
        assert len(done.stderr) < 800, "all of a long value is told"
    done = validate(INCLINE, [f"Joints/base/Dip={endless}x"])
    refused(done, "is not a number")
    assert len(done.stderr) < 800


def byte_order_mark():
    pathlib.Path("s.prm").write_bytes(b"\xef\xbb\xbf" + INCLINE.read_bytes())
    valid(validate("s.prm"))


def utf_16():
    pathlib.Path("s.prm").write_bytes(INCLINE.read_text("utf-8").encode("utf-16"))
    refused(validate("s.prm"), "save it as UTF-8")


def latin_1():
    text = INCLINE.read_bytes()
    pathlib.Path("s.prm").write_bytes(text + "# Gr\u00fc\u00dfe\n".encode("latin-1"))
    valid(validate("s.prm"))
    n_lines = text.count(b"\n")
    pathlib.Path("s.prm").write_bytes(text + "set Title = L\u00f6we\n".encode("latin-1"))
    refused(validate("s.prm"), f"Line {n_lines + 1} of the scene file 's.prm' contains")


def number_sign():
    scene = '#1 "a".prm'
    pathlib.Path(scene).write_bytes(INCLINE.read_bytes())
    done = run(["--output", "o", scene] + SHORT)
    assert done.returncode == 0, done.stderr
    summary = json.loads(pathlib.Path("o/summary.json").read_text("utf-8"))
    assert summary["scene"]["name"] == scene


def carriage_returns():
    text = INCLINE.read_bytes()
    pathlib.Path("s.prm").write_bytes(text.replace(b"\n", b"\r"))
    valid(validate("s.prm"))
    pathlib.Path("t.prm").write_bytes(text.replace(b"\n", b"\r\n"))
    valid(validate("t.prm"))


def from_a_pipe():
    valid(run(["--validate", "/dev/stdin"], input=INCLINE.read_bytes()))
    command = f"'{KEYBLOCK}' --validate <(cat '{INCLINE}')"
    valid(subprocess.run(["bash", "-c", command], capture_output=True,
                         check=False))
    valid(subprocess.run(
        ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2",
         KEYBLOCK, "--validate", "/dev/stdin"], input=INCLINE.read_bytes(),
        capture_output=True, check=False))


def a_pipe_without_end():
    refused(validate("/dev/zero"), "more than 64 MB")


def includes_itself():
    pathlib.Path("a.prm").write_text("include ./a.prm\n", encoding="utf-8")
    refused(validate("a.prm"), "includes itself")
    pathlib.Path("b.prm").write_text("include c.prm\n", encoding="utf-8")
    pathlib.Path("c.prm").write_text("include b.prm\ninclude b.prm\n",
                                     encoding="utf-8")
    refused(validate("b.prm"), "'c.prm' includes 'b.prm'")


def includes_beside_it():
    folder = pathlib.Path("scenes")
    (folder / "parts").mkdir(parents=True)
    (folder / "s.prm").write_text("include parts/one.prm\n", encoding="utf-8")
    (folder / "parts" / "one.prm").write_text("include two.prm\n",
                                              encoding="utf-8")
    shutil.copy(INCLINE, folder / "parts" / "two.prm")
    valid(validate(folder / "s.prm"))
    # or from where the program runs
    shutil.move(folder / "parts" / "two.prm", "two.prm")
    valid(validate(folder / "s.prm"))
    os.remove("two.prm")
    refused(validate(folder / "s.prm"), "included file 'two.prm' cannot be read")


def full_disk():
    for name, code in (("used.prm", 1), ("joints.csv", 1), ("joints.vtu", 1),
                       ("rock_0000.vtu", 2), ("interface_0000.vtu", 2),
                       ("solution.pvd", 2), ("history.csv", 2),
                       ("summary.json", 2)):
        shutil.rmtree("o", ignore_errors=True)
        os.mkdir("o")
        os.symlink("/dev/full", f"o/{name}")
        refused(run(["--output", "o", INCLINE] + SHORT),
                f"'o/{name}' cannot be written", code)
    shutil.rmtree("o")
    os.mkdir("o")
    os.symlink("/dev/full", "o/geostress.csv")
    refused(run(["--output", "o", PRM / "verification" / "geostress.prm"]),
            "'o/geostress.csv' cannot be written")
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([KEYBLOCK, "--help"], stdout=full,
                              stderr=subprocess.PIPE, check=False)
    assert done.returncode == 2, done.returncode


MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
1
1 3 2 1 1 1 2 3 4
$EndElements
"""

MSH_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
1 1 1 1
2 1 3 1
1 1 2 3 4
$EndElements
"""

MSH_SCENE = """subsection Domain
  set Shape = file
  set File = a.msh
end
subsection Mesh
  set Generator = file
end
subsection Materials
  set Names = rock
end
"""


def mesh(text):
    """Validate a scene on a .msh file."""
    pathlib.Path("a.msh").write_text(text, encoding="utf-8")
    pathlib.Path("a.prm").write_text(MSH_SCENE, encoding="utf-8")
    return validate("a.prm")


def damaged_msh():
    valid(mesh(MSH))
    for fault, mended in (("1 3 2", "1 3 999999"), ("1 3 2", "1 3 -9"),
                          ("$Nodes\n4", "$Nodes\n99999999999"),
                          ("$Nodes\n4", "$Nodes\n-4"),
                          ("$Elements\n1\n", "$Elements\n4000000000\n"),
                          ("1 3 2", "1 99 2"), ("2 3 4\n$End", "2 3 77\n$End"),
                          ("2.2 0", "4.1 0"), ("2.2 0 8", "2.2 1 8")):
        assert fault in MSH
        refused(mesh(MSH.replace(fault, mended)), "The mesh file 'a.msh'")
    refused(mesh(MSH.replace("3 1 1 0", "3 nan 1 0")), "a.msh")
    refused(mesh(MSH.replace("3 1 1 0", "3 1e200 1e200 0")), "at most 1e9 m")
    valid(mesh(MSH_4))
    done = mesh(MSH_4.replace("2 3 4\n$End", "2 3 -4\n$End"))
    refused(done, "The mesh file 'a.msh'")
    assert b"map" not in done.stderr


def boundary_groups():
    """Groups of outer faces that the mesh file has, and others."""
    text = MSH.replace("$Nodes", '$PhysicalNames\n2\n1 4 "side"\n2 1 "granite"\n'
                       "$EndPhysicalNames\n$Nodes").replace(
                           "$Elements\n1\n",
                           "$Elements\n2\n2 1 2 4 4 1 2\n")
    for name in ("side", "4"):
        pathlib.Path("a.msh").write_text(text, encoding="utf-8")
        pathlib.Path("a.prm").write_text(MSH_SCENE, encoding="utf-8")
        valid(validate("a.prm", [f"Domain/Truncated boundaries=id {name}",
                                 "Materials/rock/Region=id granite"]))
    for name in ("sides", "1", "granite"):
        refused(validate("a.prm", [f"Domain/Truncated boundaries=id {name}"]),
                f"names 'id {name}', but no outer face of the mesh file 'a.msh' "
                "is in a group of that number or name; groups of outer faces "
                "are: 4 (side).")
    refused(validate("a.prm", ["Materials/rock/Region=id granit"]),
            "the regions of the mesh are: 1 (granite);")


def table_without_rows():
    pathlib.Path("a.csv").write_text("dip,dip direction,x,y\n", encoding="utf-8")
    valid(validate(PRM / "tutorial" / "first_tunnel.prm",
                   [f"Joints/File={pathlib.Path('a.csv').resolve()}"]),
          "has a header and no rows")


def table_without_friction():
    """A joint of a table that nothing gives a friction angle has the default one."""
    table = pathlib.Path("a.csv").resolve()
    header, rows = "name,dip,dip direction,x,y", ("A,40,270,0,0", "B,60,90,1,0")
    for title, cells, settings, sentence in (
            ("", ("", ""), [], "has no column of friction: the default, 30 degrees"),
            (",phi", (",20", ","), [], "no friction in 1 row (line 3): the default, 30"),
            (",phi", (",20", ",25"), [], ""),
            (",phi'", (",20", ","), ["Joints/B/Friction angle=30"], "")):
        table.write_text("\n".join((header + title, rows[0] + cells[0],
                                    rows[1] + cells[1], "")), encoding="utf-8")
        told = [text for text in warnings_of(validate(
            PRM / "tutorial" / "first_tunnel.prm",
            [f"Joints/File={table}", "Joint sets/Names=",
                                         "Study/Names="] + settings))
                if "friction" in text]
        assert len(told) == bool(sentence) and all(sentence in t for t in told), told


def other_units():
    """Values that look as if they were in another unit."""
    valid(validate(INCLINE))
    for setting, warning in (
            ("Joints/base/Friction angle=0.61", "in radians? That would be 34.95"),
            ("Joints/base/Cohesion=0.05", "'Joints/base/Cohesion' is 0.05 Pa"),
            ("Materials/rock/Young modulus=15", "is it in GPa or MPa?"),
            ("Materials/rock/Density=2.7", "is it in t/m3")):
        valid(validate(INCLINE, [setting]), warning)
    drawing = (PRM.parent / "tests" / "shapes" / "opening.dxf").read_text()
    room = pathlib.Path("room.dxf").resolve()
    for code, warning in (
            (2, "says that it is in feet ($INSUNITS), but 'Scale' is 0.001"),
            (4, None), (0, None)):
        room.write_text("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n"
                        f"  {code}\n0\nENDSEC\n" + drawing)
        done = validate(PRM / "verification" / "roof_block_falls.prm", [
            "Excavations/room/Shape=file", f"Excavations/room/File={room}",
            "Excavations/room/Scale=1e-3"])
        text = done.stdout.decode("utf-8")
        assert done.returncode == 0, done.stderr
        assert (warning in text) if warning else "INSUNITS" not in text, text


def small_memory():
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (2 * 2**30,) * 2)
    refused(run(["--validate", "--set", "Mesh/Cells=2000, 1500", INCLINE],
                preexec_fn=limit), "the 2.15 GB of memory here")
    refused(run(["--validate", "--set", "Mesh/Refinement levels=10",
                 PRM / "verification" / "incline_3d.prm"], preexec_fn=limit),
            "cells by refinement")


def huge_normal():
    box = PRM / "benchmark" / "elastic_2d.prm"
    common = ["Mesh/Cells=4, 4", "Domain/Size=4, 4", "Joints/Names=a",
              "Joints/a/Point=0, 2"]
    done = [validate(box, common + [f"Joints/a/Normal={n}"])
            for n in ("0, 1", "0, 1e200", "0, 1e-200", "0, 1.7e308")]
    for one in done:
        assert one.returncode == 0, one.stderr
        assert without_estimate(one.stdout) == without_estimate(done[0].stdout)


def without_estimate(output):
    """What is said of time and memory is measured, and differs."""
    return output[:output.index(b"Estimate")]


def joint_outside():
    valid(validate(INCLINE, ["Joints/Names=base, far", "Joints/far/Point=0, 9",
                             "Joints/far/Dip=0"]),
          "1 joint outside the model, and left out: far")
    lines = PRM / "verification" / "blocks_lines.prm"
    valid(validate(lines, ["Joints/Names=@, far".replace("@", names(lines)),
                           "Joints/far/Point=0, 1e4", "Joints/far/Dip=0"]),
          "1 joint outside the model, and left out: far")
    planes = PRM / "verification" / "blocks_planes_4.prm"
    valid(validate(planes, ["Joints/j4/Point=1e308, -0.5, 0.5",
                            "Joints/j4/Normal=-1, 1e200, 1"]),
          "1 joint outside the model, and left out: j4")


def names(scene):
    """The joints of a scene."""
    text = scene.read_text("utf-8").split("subsection Joints")[1]
    return text.split("set Names = ")[1].split("\n")[0]


def joint_twice():
    valid(validate(INCLINE, ["Joints/Names=base, twin", "Joints/twin/Dip=40"]),
          "The joint 'twin' lies wholly on the joint 'base'")
    valid(validate(INCLINE, ["Joints/Names=base, twin", "Joints/twin/Dip=40",
                             "Joints/twin/Friction angle=10"]),
          "The joint 'base' lies wholly on the joint 'twin'")
    # not in the scene, but in its mesh
    valid(validate(PRM / "tutorial" / "first_tunnel.prm", [
        "Joints/Names=a, b", "Joints/a/Point=0, 12", "Joints/a/Dip=10",
        "Joints/b/Point=0, 12.002", "Joints/b/Dip=10.02", "Joint sets/Names=",
        "Study/Names=", "Stages/*/Kind=dynamic", "Stages/*/Duration=1"]),
          "The mesh has let the joint 'b' fall together with the joint 'a'")


def shape_file_changed():
    drawing = (PRM.parent / "tests" / "shapes" / "opening.dxf").read_text()
    room = pathlib.Path("room.dxf")
    room.write_text(drawing)
    arguments = [PRM / "verification" / "roof_block_falls.prm"]
    for entry in ("Excavations/room/Shape=file", f"Excavations/room/File={room}",
                  "Excavations/room/Scale=6e-4", "Output/Checkpoint interval=1e-3",
                  "Stages/dig/Maximum steps=200", "Check/Closed form=none"):
        arguments += ["--set", entry]
    assert run(arguments + ["--output", "a"]).returncode == 0
    again = arguments + ["--output", "b", "--restart", "a/checkpoint.h5"]
    assert run(again).returncode == 0
    room.write_text(drawing.replace("5000.0", "4999.0"))
    refused(run(again), "the entry 'Excavations/room/Digest of File' is")


def too_many_triangles():
    triangle = struct.pack("<12fH", 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    pathlib.Path("a.stl").write_bytes(b" " * 80 + struct.pack("<I", 20001)
                                      + 20001 * triangle)
    refused(validate(PRM / "study" / "powerhouse_3d.prm",
                     ["Excavations/crown/Shape=file", "Excavations/crown/File=a.stl"]),
            "it has 20001 triangles, more than 20000")


def coarse_steps_of_stl():
    """A cube in the coordinates of a survey, where 32 bits move its corners."""
    low = (694200.3, 5391000.7, 1200.1)
    corners = [[x + 10. * (k >> d & 1) for d, x in enumerate(low)] for k in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = [[corners[i] for i in three] for a, b, c, d in faces
                 for three in ((a, b, c), (a, c, d))]
    pathlib.Path("cube.stl").write_bytes(
        b" " * 80 + struct.pack("<I", 12)
        + b"".join(struct.pack("<12fH", 0, 0, 0, *sum(triangle, []), 0)
                   for triangle in triangles))
    refused(validate(PRM / "study" / "powerhouse_3d.prm",
                     ["Excavations/crown/Shape=file", "Excavations/crown/File=cube.stl"]),
            "numbers of binary STL have steps of 0.5 at 5391010")


def surface_of_many_triangles():
    """A million of them, a binary file of 50 MB."""
    n = 10**6
    triangle = struct.pack("<12fH", *([0.] * 3 + [0., 0., 0., 1., 0., 0., 0., 1., 0.]), 0)
    with open("many.stl", "wb") as file:
        file.write(b" " * 80 + struct.pack("<I", n) + triangle * n)
    refused(validate(PRM / "verification" / "incline_3d.prm",
                     ["Joints/base/Shape=file",
                      f"Joints/base/File={pathlib.Path('many.stl').resolve()}"]),
            "it has 1000000 triangles, more than 20000")


def joint_group_missing():
    """A physical group that the mesh file has not, or whose faces are no cells'."""
    text = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "fault"
2 2 "rock"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 2 0 0
6 2 1 0
$EndNodes
$Elements
3
1 3 2 2 2 1 2 3 4
2 3 2 2 2 2 5 6 3
3 1 2 1 1 ENDS
$EndElements
"""
    scene = """set Dimension = 2
subsection Domain
set Shape = file
set File = a.msh
end
subsection Mesh
set Generator = file
end
subsection Joints
set Names = fault
subsection fault
set Shape = physical group
end
end
subsection Materials
set Names = rock
end
"""
    pathlib.Path("a.prm").write_text(scene, encoding="utf-8")
    pathlib.Path("a.msh").write_text(text.replace("ENDS", "2 3"), encoding="utf-8")
    refused(validate("a.prm", ["Joints/fault/Group=clay"]),
            "it has no physical group 'clay' of dimension 1 (there are: fault)")
    pathlib.Path("a.msh").write_text(text.replace("ENDS", "1 3"), encoding="utf-8")
    refused(validate("a.prm"), "but no cell has that face")


def joints_welded():
    valid(validate(INCLINE, ["Domain/Truncated boundaries=all"]),
          "All joints stay welded, with 0 pairs")


def monitor_outside():
    valid(validate(INCLINE, ["Monitors/block/Location=0.5, 0.3"]),
          "The monitor 'block' is at")


TWO_CELLS = """set Dimension = 2
subsection Domain
  set Shape = box
  set Size = 1, 4
  set Truncated boundaries = bottom
end
subsection Mesh
  set Generator = structured
  set Cells = 1, 2
  set Gradings = uniform, 3
end
subsection Materials
  set Names = rock
end
subsection Joints
  set Names = cut
  subsection cut
    set Point = 0, 1
    set Dip = 0
  end
end
subsection Supports
  set Names = base
  subsection base
    set Boundaries = bottom
  end
end
subsection Initial state
  set Gravity = 0; 9.81
end
subsection Stages
  set Names = fly
  subsection fly
    set Duration = 0.1
  end
end
subsection Monitors
  set Names = upper
  subsection upper
    set Kind = block
    set Location = 0.5, 1.4
  end
end
"""


def monitor_in_a_large_cell():
    # nearer to the centre of the other block's cell
    pathlib.Path("s.prm").write_text(TWO_CELLS, encoding="utf-8")
    done = run(["--output", "o", "s.prm"])
    assert done.returncode == 0, done.stderr
    summary = json.loads(pathlib.Path("o/summary.json").read_text("utf-8"))
    risen = summary["monitors"]["upper.u_y [m]"]
    assert abs(risen - 0.5 * 9.81 * 0.1**2) < 0.001, risen


def some_tension():
    kirsch = PRM / "verification" / "kirsch.prm"
    valid(validate(kirsch, ["Initial state/Stress=7e6; -7e6; 7e6; 0"]),
          "a tension of up to 7e+06 Pa")


NETWORK = PRM / "tutorial" / "joint_network.prm"


def names_taken_out():
    # the scene has the subsections of names that --set takes out of its lists
    for names, is_there in (("", False), ("faults", False), ("bedding", True)):
        done = validate(NETWORK, [f"Joint sets/Names={names}",
                                  "Monitors/Names="])
        assert done.returncode == 0, done.stderr
        assert (b"bedding.2" in done.stdout) == is_there, names
    done = validate(INCLINE, ["Joints/Names=", "Check/Closed form=none",
                              "Check/Joint=",
                              "Monitors/Names=block"])
    assert done.returncode == 0 and b"0 pairs" in done.stdout, done.stderr
    # a name that neither list has is still an error
    text = NETWORK.read_text(encoding="utf-8")
    pathlib.Path("s.prm").write_text(
        text.replace("subsection faults", "subsection falts").replace(
            "set File = joint_network.csv", f"set File = {NETWORK.parent}/joint_network.csv"),
        encoding="utf-8")
    refused(validate("s.prm", ["Joint sets/Names="]),
            "there is a subsection 'Joint sets/falts'")


def derived_entries():
    """What follows from Ground and sections stands in used.prm, exactly."""
    scene = PRM / "verification" / "cavern_at_depth.prm"
    few = ["--set", "Output/Write VTU=false"]
    assert run([scene, "--output", "a", *few]).returncode == 0
    used = pathlib.Path("a/used.prm").read_text(encoding="utf-8")
    for entry in ("Names    = ground below, ground beside",
                  "Names = overburden", "subsection ground below"):
        words = entry.replace("    ", " ")
        assert words in " ".join(used.split()), entry
    history = pathlib.Path("a/history.csv").read_bytes()
    for folder, more in (("b", []), ("c", ["--set", "Ground/Depth=-1"])):
        done = run(["a/used.prm", "--output", folder, *few, *more])
        assert done.returncode == 0, done.stderr
        assert pathlib.Path(folder, "history.csv").read_bytes() == history, (
            f"other history of used.prm with {more}")
    again = pathlib.Path("b/used.prm").read_text(encoding="utf-8")
    values = [[line.split("#")[0].split() for line in text.splitlines()
               if line.split("#")[0].strip()] for text in (used, again)]
    assert values[0] == values[1], "used.prm of used.prm has other values"


COARSE_WEDGE = """set Dimension = 3
subsection Domain
  set Corner = -20, -20, -20
  set Size = 40, 40, 40
  set Truncated boundaries = all
end
subsection Mesh
  set Generator = gmsh
  set Size = 2.3
end
subsection Excavations
  set Names = tunnel
  subsection tunnel
    set Shape = box
    set Corner = -3, -10, -3
    set Size = 6, 20, 6
    set Stage = dig
  end
end
subsection Joints
  set Names = J1, J2, J3
  subsection J1
    set Point = -1.2, 0, 6
    set Dip = 55
    set Dip direction = 30
  end
  subsection J2
    set Point = -1.2, 0, 6
    set Dip = 60
    set Dip direction = 150
  end
  subsection J3
    set Point = -1.2, 0, 6
    set Dip = 65
    set Dip direction = 270
  end
end
subsection Materials
  set Names = rock
end
subsection Stages
  set Names = dig
  subsection dig
    set Kind = quasi-static
  end
end
"""


def coarse_mesh():
    """Planes bound 15.80 m3, by the corners where they meet, and so do coarse
    cells."""
    pathlib.Path("s.prm").write_text(COARSE_WEDGE, encoding="utf-8")
    done = validate("s.prm")
    assert done.returncode == 0, done.stderr
    text = done.stdout.decode("utf-8")
    row = re.search(r"^ +1  exposed +\S+ +([0-9.]+)", text, re.M)
    assert abs(float(row[1]) / 15.8018 - 1.) < 1e-4, text
    # joints in their planes are not warned of
    done = validate("s.prm", ["Mesh/Snap=0"])
    assert done.returncode == 0, done.stderr
    assert b"Warning: The mesh " not in done.stdout, done.stdout


LEDGE = """set Dimension = 2
subsection Domain
  set Corner = -15, -15
  set Size = 30, 30
end
subsection Mesh
  set Generator = gmsh
  set Size = 1.5
end
subsection Excavations
  set Names = room
  subsection room
    set Vertices = -3, -3; 3, -3; 3, 1; 0.9, 3; -3, 3
  end
end
subsection Joints
  set Names = a, b, top, ledge
  subsection a
    set Point = -2, 3
    set Dip = 60
    set Dip direction = 90
    set Friction angle = 35
  end
  subsection b
    set Point = 1, 3
    set Dip = 60
    set Dip direction = 90
    set Friction angle = 35
  end
  subsection top
    set Point = 0, 7
    set Dip = 0
    set Friction angle = 35
  end
  subsection ledge
    set Point = 0.9, 3
    set Dip = 40
    set Dip direction = 270
    set Friction angle = 35
  end
end
subsection Materials
  set Names = rock
end
subsection Initial state
  set Gravity = 0; -9.81
end
"""


def small_ledge():
    """A strip between two joints would slide into the room, but for a ledge of
    0.0879 m by the planes, a fortieth of an edge of the triangles, which the
    mesh must not lose."""
    pathlib.Path("s.prm").write_text(LEDGE, encoding="utf-8")
    for more, is_there in ((["Joints/ledge/Point=0.9, 3"], True),
                           (["Joints/Names=a, b, top"], False)):
        done = validate("s.prm", more)
        assert done.returncode == 0, done.stderr
        text = done.stdout.decode("utf-8")
        row = next(line for line in text.splitlines() if "the start" in line)
        print(row)
        assert ("stable" in row) == is_there, row
        assert "which the mesh has lost" not in row, row
        if not is_there:
            assert "sliding on" in row, row


ROOF = PRM / "verification" / "roof_block_falls.prm"


def warnings_of(done):
    """What the screen warned of, each once."""
    assert done.returncode == 0, done.stdout + done.stderr
    text = (done.stdout + done.stderr).decode("utf-8")
    found = re.findall("^Warning: (.*)$", text, re.MULTILINE)
    assert len(set(found)) == len(found), found
    return found


def told_and_kept():
    """Whatever the screen warns of stands in summary.json, in the same order,
    once, after a restart, too."""
    lying = ["Joints/Names=left, right, same, away, tiny",
             "Joints/same/Extent=polygon", "Joints/same/Vertices=-2.5, 3; 0, 7",
             "Joints/away/Extent=polygon", "Joints/away/Vertices=50, 50; 60, 60",
             "Joints/tiny/Extent=polygon", "Joints/tiny/Vertices=5, 5; 5.00002, 5"]
    settings = ["Joints/left/Cohesion=0.5", "Time stepping/Least step=1e-2", "Stages/*/Maximum steps=40",
                "Output/Checkpoint interval=1e-6", "Output/Write VTU=false",
                *lying]
    arguments = [word for entry in settings for word in ("--set", entry)]
    told = warnings_of(run([ROOF, "--output", "o", *arguments]))
    for kind in ("is 0.5 Pa: is it in", "lies wholly on the joint 'same'",
                 "outside the model", "too small for the cells",
                 "below 'Time stepping/Least step'"):
        assert any(kind in text for text in told), f"no '{kind}' in {told}"
    summary = json.loads(pathlib.Path("o/summary.json").read_text("utf-8"))
    assert summary["warnings"] == told, summary["warnings"]
    corner = run([PRM / "verification/corner.prm", "--output", "c", "--set",
                  "Contact/Maximum iterations=1"])
    summary = json.loads(pathlib.Path("c/summary.json").read_text("utf-8"))
    assert summary["warnings"] == warnings_of(corner), summary["warnings"]
    assert "left at 'Contact/Maximum iterations'" in summary["warnings"][-1]
    # a folder stands where a checkpoint is to be written
    pathlib.Path("full/checkpoint.h5.part").mkdir(parents=True)
    told_full = warnings_of(run([ROOF, "--output", "full", *arguments]))
    assert any("'full/checkpoint.h5' cannot be written" in text
               for text in told_full), told_full
    summary = json.loads(pathlib.Path("full/summary.json").read_text("utf-8"))
    assert summary["warnings"] == told_full, summary["warnings"]
    warnings_of(run([ROOF, "--restart", "o/checkpoint.h5", "--output", "again",
                     *arguments]))
    summary = json.loads(pathlib.Path("again/summary.json").read_text("utf-8"))
    assert sorted(summary["warnings"]) == sorted(told), summary["warnings"]


def rock_by_default():
    """A scene that says nothing of the rock has one material, 'rock'."""
    text = (PRM / "verification" / "blocks_e1.prm").read_text(encoding="utf-8")
    named = "subsection Materials\n  set Names = rock\nend\n"
    assert named in text
    path = pathlib.Path("a.prm")
    path.write_text(text.replace(named, ""), encoding="utf-8")
    told = ("all of it is 'rock', elastic, with a 'Young modulus' of 15 GPa and a "
            "'Density' of 2700 kg/m3.")

    def tells(*settings):
        return any(told in line for line in warnings_of(validate("a.prm", settings)))

    assert tells() and tells("Materials/rock/Poisson ratio=0.2")
    for setting in ("Materials/rock/Density=2600", "Materials/*/Density=2600",
                    "Materials/Names=rock", "Materials/Names=basalt"):
        assert not tells(setting), setting
    path.write_text(text.replace(named, named.replace(
        "set Names = rock", "subsection rock\n    set Density = 2600\n  end")),
                    encoding="utf-8")
    assert not tells() and not tells("Materials/Names=basalt")


def used_folder():
    """A new run leaves nothing of an earlier one in its folder, and everything
    of its user; neither a refused scene nor a restart takes anything."""
    folder = pathlib.Path("o")
    short = [ROOF, "--output", folder, "--set", "Stages/*/Maximum steps=20"]
    done = run([*short, "--set", "Output/Keep stages=true",
                "--set", "Output/Checkpoint interval=1e-6"])
    assert b"Folder" not in done.stdout and done.returncode == 0, done
    of_run = {path.name for path in folder.iterdir()}
    own = ["notes.csv", "rock_section.vtu", "my_checkpoint.h5", "rock_1.vtu"]
    for name in own:
        (folder / name).write_text("mine")
    refused(run([*short, "--set", "Mesh/Size=-1"]), "Size")
    done = run([*short, "--restart", folder / "checkpoint.h5",
                "--set", "Output/Keep stages=true",
                "--set", "Output/Checkpoint interval=1e-6"])
    assert b"Folder" not in done.stdout and done.returncode == 0, done
    assert {path.name for path in folder.iterdir()} == of_run | set(own)
    # fewer states, no stages
    done = run([*short, "--set", "Output/VTU count=1"])
    assert b"of an earlier run removed from o/: blocks.csv to " in done.stdout, done
    fresh = run([ROOF, "--output", "fresh", "--set", "Stages/*/Maximum steps=20",
                 "--set", "Output/VTU count=1"])
    assert fresh.returncode == 0 and b"Folder" not in fresh.stdout, fresh
    left = {path.name for path in folder.iterdir()}
    assert left == {path.name for path in pathlib.Path("fresh").iterdir()} | set(own)
    assert left < of_run | set(own), left
    # the checkpoint of a run that was broken off is not lost
    (folder / "checkpoint.h5").write_text("hours")
    (folder / "summary.json").unlink()
    done = run(short)
    assert b"its checkpoint is now o/earlier_checkpoint.h5" in done.stdout, done
    assert (folder / "earlier_checkpoint.h5").read_text() == "hours"
    # without the used.prm of a run nothing is known of the folder
    (folder / "used.prm").write_text("set Dimension = 2\n")
    (folder / "rock_0099.vtu").write_text("mine")
    done = run(short)
    assert b"Folder" not in done.stdout and (folder / "rock_0099.vtu").exists()


def written_wrongly():
    """File, line, entry and what is meant."""
    text = ROOF.read_text("utf-8")
    lines = text.splitlines()

    def line_of(words, begin=0):
        return 1 + next(i for i, line in enumerate(lines)
                        if i >= begin and words in line)

    def refuse(old, new, fragment, count=1):
        assert old in text
        pathlib.Path("s.prm").write_text(text.replace(old, new, count), "utf-8")
        refused(validate("s.prm"), fragment)

    refuse("Friction angle = 40", "Friction angle = 30,5",
           f"In 's.prm', line {line_of('Friction')}, joint 'left': the entry "
           "'Friction angle' is '30,5', which is not a number from 0 to 89.9; "
           "numbers have a point: write 30.5.")
    refuse("Friction angle", "Fricton angle", "is 'Friction angle' meant?")
    refuse("Young modulus", "Youngs modulus", f"In 's.prm', line {line_of('Young')}: "
           "there is no entry 'Materials/rock/Youngs modulus'; is 'Young modulus' meant?")
    refuse("subsection Materials", "subsection Matreials",
           f"line {line_of('Materials')}: there is no section 'Matreials'; is "
           "'Materials' meant?")
    refuse("set Density", "st Density", f"line {line_of('Density')}: 'st Density = "
           "2700' begins with none of set")
    refuse("  set Size = 0.8\nend", "  set Size = 0.8", "In 's.prm', line "
           f"{line_of('subsection Mesh')}: the subsection 'Mesh' has no 'end'")
    refuse("    set Density = 2700\n  end", "    set Density = 2700", "line "
           f"{line_of('subsection rock')}: the subsection 'rock' has no 'end'")
    refuse("set Title", "end\nset Title", f"line {line_of('Title')}: this 'end' closes no")
    pathlib.Path("s.prm").write_text(text[:text.rindex("end")], "utf-8")
    refused(validate("s.prm"), "has no 'end'")


def hardly_meant():
    """Values that are allowed and hardly ever meant are warned of, others not."""
    incline, cavern = INCLINE, PRM / "verification/cavern_at_depth.prm"
    radians = "s.prm"
    text = re.sub(r"Dip direction = \d+", "Dip direction = 4.7", COARSE_WEDGE)
    pathlib.Path(radians).write_text(re.sub(r"Dip = \d+", "Dip = 1.13", text))
    for scene, settings, sentences in (
            (ROOF, ["Joints/left/Cohesion=5e9", "Materials/rock/Young modulus=1e14",
                    "Materials/rock/Density=26487", "Initial state/Lateral ratios=80",
                    "Initial state/Gravity=0; -981", "Stages/*/Seismic coefficient=2.5, 0",
                    "Stages/*/Unbalanced ratio=0.5", "Water/Level=12",
                    "Joints/right/Friction angle=1.55"],
             ["'Joints/left/Cohesion' is 5e+09 Pa: no joint has as much",
              "'Materials/rock/Young modulus' is 1e+14 Pa: no rock is so stiff",
              "'Materials/rock/Density' is 26487 kg/m3: is it a unit weight",
              "'Initial state/Lateral ratios' is 80 [-]: no ground has so much more "
              "horizontal than vertical stress; is 0.8 meant?",
              "'Initial state/Gravity' is '0; -981', 981 m/s2: is it in m/s2?",
              "Seismic coefficient' is 2.5 [-]",
              "is it in m/s2? It is acceleration over 9.81 m/s2: that would be 0.255.",
              "Unbalanced ratio' is 0.5 [-]",
              "'Water/Level' is up to 12 m, above the top of the ground at 10 m: water "
              "presses in joints as deep as they lie below it, but not on faces",
              "'Joints/right/Friction angle' is 1.55 degrees: is it in radians?"]),
            (ROOF, ["Materials/rock/Density=80"], ["is it in t/m3 or kN/m3?"]),
            (cavern, ["Ground/K0=80", "Excavations/cavern/Stage=bench",
                      "Excavations/cavern/Bench stages=heading"],
             ["'Ground/K0' is 80 [-]", "'cavern bench 1' is dug in 'heading', before "
              "'cavern' above it in 'bench'"]),
            (cavern, ["Ground/Depth=-1", "Ground/K0=1", "Initial state/Gravity=9.81; 0",
                      "Domain/Corner=-50, -50", "Domain/Size=100, 100"],
             ["'Initial state/Gravity' is '9.81; 0', not down the axis y, along which "
              "the excavation 'cavern' stands"]),
            (cavern, ["Ground/Depth=-1", "Ground/K0=2", "Initial state/Gravity=0; -9.81",
                      "Domain/Corner=-50, -50", "Domain/Size=100, 100"],
             ["The section 'Ground' has entries, but not 'Depth'",
              "Nothing holds the model, neither a support nor a rigid material"]),
            (cavern, ["Ground/Depth=-1", "Domain/Corner=-50, -50", "Domain/Size=100, 100",
                      "Safety factor/Blocks=exposed", "Supports/Names=rest",
                      "Supports/rest/Boundaries=bottom"],
             ["Nothing loads the rock, neither gravity nor stress nor water"]),
            (ROOF, ["Initial state/Gravity=0; 0", "Safety factor/Blocks=none"],
             ["Blocks have no weight in limit equilibrium", "as '0; -9.81'."]),
            (incline, ["Initial state/Gravity=0; 0", "Tractions/Names=p",
                       "Tractions/p/Boundaries=top", "Tractions/p/Traction=0; -1e3"],
             ["Blocks have no weight in limit equilibrium"]),
            (cavern, ["Tractions/Names=road", "Tractions/road/Boundaries=top",
                      "Tractions/road/Traction=0; -20e3"],
             ["MPa along the vertical, and what loads the top from the start (road) is "
              "0.02 MPa"]),
            (cavern, ["Initial state/Stress=-1e6; -1e6; -1e6; 0"],
             ["is 1 MPa along the vertical, and what loads the top from the start "
              "(overburden)"]),
            (radians, [], ["'Joints/J1/Dip' is 1.13 degrees, and no dip of the scene is "
                           "above 1.6: are they in radians? That would be 64.7"]),
            (ROOF, [], []),
            (incline, ["Water/Level=-1"],
             ["'Water/Level' is -1 m, below all joints that it is for"]),
            (incline, ["Water/Level=0"], [])):
        told = warnings_of(validate(scene, settings))
        print("\n".join(told))
        for sentence in sentences:
            assert any(sentence in text for text in told), sentence
        if not sentences:
            assert not told, told


def blocks_that_lean():
    """A block is stable only while the one stays that holds it."""
    scene = PRM / "verification/factor_group.prm"
    rows = {}
    for friction in (35, 20):
        done = validate(scene, [f"Joints/lower/Friction angle={friction}"])
        assert done.returncode == 0, done.stderr
        text = done.stdout.decode("utf-8")
        table = text[text.index("factor  mode and forces"):].splitlines()[1:]
        rows[friction] = {line.split()[0]: line for line in table
                          if line[:6].strip().isdigit()}
        print(rows[friction])
    for row in rows.values():
        assert "block 2 may lean on it, left out" in row["1"], row
    assert "has gone" not in rows[35]["2"]
    assert "once block 1 has gone" in rows[20]["2"]


def places_without_round_off():
    """Blocks in the middle of a scene have 0 there, not the round-off of a sum."""
    for scene, place in (("roof_block_falls", "(0, 4.333)"), ("bolted_roof_3d", "(0, 0, 1)")):
        done = validate(PRM / "verification" / f"{scene}.prm")
        assert done.returncode == 0, done.stderr
        text = done.stdout.decode("utf-8")
        table = text[text.index("Blocks\n"):].splitlines()
        print(table[2])
        assert f"  {place}  " in table[2], table[2]


def attached_block():
    """A block that is one with rock which is dug later has no factor until then; after
    that it has that of what is left."""
    scene = PRM / "verification/cohesive_incline.prm"
    settings = ["Excavations/Names=beside, part", "Excavations/part/Shape=formula",
                "Excavations/part/Formula=if(y > 0.05, 1, -1)",
                "Excavations/part/Stage=later", "Stages/Names=rest, later",
                "Stages/later/Kind=quasi-static", "Stages/later/Unbalanced ratio=1e-7"]
    done = run([scene, "--output", "o"] + [w for s in settings for w in ("--set", s)])
    assert done.returncode == 0, done.stderr
    summary = json.loads(pathlib.Path("o/summary.json").read_text(encoding="utf-8"))
    warning = ("Block 1 has no safety factor after 'rest': it is one with rock there that "
               "a later stage digs")
    assert sum(warning in text for text in summary["warnings"]) == 1, summary["warnings"]
    assert warning in done.stdout.decode("utf-8")
    block = summary["blocks"][0]
    limit, = block["limit_equilibrium"]
    dip = math.radians(30.)
    weight = block["weight"]
    factor = ((1000. * 0.5 + weight * math.cos(dip) * math.tan(dip))
              / (weight * math.sin(dip)))
    print(limit, factor)
    assert limit["stage"] == "later" and math.isclose(limit["value"], factor, rel_tol=1e-9)
    text = validate(scene, ["Stages/Names=rest, later"]).stdout.decode("utf-8")
    assert "no safety factor" not in text, text


def lost_cohesion():
    """A heel that water opens has no cohesion, which limit equilibrium counts: a block of
    1 m and 23 kN beside 1.7 m of water."""
    settings = ["Mesh/Cells=32, 24", "Joints/crack/Water level=1.7",
                "Joints/base/Cohesion=10e3", "Joints/base/Friction angle=20",
                "Materials/rock/Young modulus=50e6"]
    done = run([PRM / "verification/crack_water.prm", "--output", "o"]
               + [w for s in settings for w in ("--set", s)])
    assert done.returncode == 0, done.stderr
    text = done.stdout.decode("utf-8")
    print(text)
    summary = json.loads(pathlib.Path("o/summary.json").read_text(encoding="utf-8"))
    block = summary["blocks"][0]
    factor, limit = block["safety_factor"][0], block["limit_equilibrium"][0]
    lost, = {t["weakened_area"] for t in factor["trials"]}
    driving, friction = 9810. * 1.7**2 / 2., 23e3 * math.tan(math.radians(20.))
    assert math.isclose(limit["value"], (friction + 10e3) / driving, rel_tol=1e-6)
    assert math.isclose(factor["value"], (friction + 10e3 * (1. - lost)) / driving,
                        rel_tol=2e-3), (factor["value"], lost)
    assert f"cohesion of base counted on {lost} m that have lost it; " in limit["remark"]
    assert f"cohesion lost on {lost} m by the last that held, counted by limit" in text


def strength_lost_by_slip():
    """A block that an earthquake slides on a base of 25 degrees: limit equilibrium says what
    slip has left of friction and of cohesion, which strength reduction finds."""
    shaken = ["Bolts/Names=", "Materials/rock/Young modulus=2e8",
              "Initial state/Gravity=9.81*sin(25*pi/180); -9.81*cos(25*pi/180)",
              "Stages/Names=rest, shake, calm", "Stages/shake/Kind=dynamic",
              "Stages/shake/Damping ratio=0.3", "Stages/shake/Seismic coefficient=0.8, 0",
              "Stages/calm/Kind=quasi-static", "Stages/calm/Unbalanced ratio=1e-6",
              "Stages/calm/Seismic coefficient=0, 0", "Stages/calm/Reset motion=true",
              "Safety factor/Stages=calm", "Safety factor/Bracket=0.002"]

    def factor_of(settings):
        done = run([PRM / "verification/bolted_incline.prm", "--output", "o"]
                   + [w for s in shaken + settings for w in ("--set", s)])
        assert done.returncode == 0, done.stderr
        print(done.stdout.decode("utf-8"))
        summary = json.loads(pathlib.Path("o/summary.json").read_text(encoding="utf-8"))
        block = summary["blocks"][0]
        limit = block["limit_equilibrium"][-1]
        assert limit["stage"] == "calm", limit
        return block["weight"], block["safety_factor"][0], limit

    def left(limit):
        return float(re.search(r"; ([0-9.]+) without that", limit["remark"]).group(1))

    dip = math.radians(25.)
    weight, factor, limit = factor_of(
        ["Stages/shake/Duration=0.09", "Joints/base/Law=slip weakening",
         "Joints/base/Friction angle=40", "Joints/base/Residual friction angle=28",
         "Joints/base/Slip distance=0.02"])
    assert math.isclose(limit["value"], math.tan(math.radians(40.)) / math.tan(dip),
                        rel_tol=1e-6), limit
    assert "friction of base counted with 40 degrees, of which " in limit["remark"], limit
    assert math.isclose(left(limit), factor["value"], rel_tol=2e-3), (limit, factor)
    assert factor["value"] < 1.3, factor

    weight, factor, limit = factor_of(
        ["Stages/shake/Duration=0.08", "Joints/base/Friction angle=30",
         "Joints/base/Cohesion=2000", "Joints/base/Residual cohesion=1500"])
    residual = (math.tan(math.radians(30.)) / math.tan(dip)
                + 1500. * 0.5 / (weight * math.sin(dip)))
    assert math.isclose(left(limit), residual, rel_tol=1e-3), (limit, residual)
    assert math.isclose(factor["value"], residual, rel_tol=2e-3), (factor, residual)


def monitor_of_all_joints():
    """Of one joint the same as of all."""
    done = run([INCLINE, "--output", "o", *SHORT, "--set", "Monitors/Names=one, every",
                "--set", "Monitors/one/Kind=joint", "--set", "Monitors/one/Joint=base",
                "--set", "Monitors/every/Kind=joint", "--set", "Monitors/every/Joint=all",
                "--set", "Check/Closed form=none"])
    assert done.returncode == 0, done.stderr
    names, *rows = (line.split(",") for line in pathlib.Path(
        "o/history.csv").read_text("utf-8").splitlines())
    last = dict(zip(names, map(float, rows[-1])))
    for name in ("normal_force [N]", "shear_force [N]", "slip [m]", "opening [m]"):
        print(name, last["one." + name], last["every." + name])
        assert last["one." + name] == last["every." + name] != 0.


def decimal_comma():
    """Two numbers that look like one."""
    scene = PRM / "verification/cavern_at_depth.prm"
    valid(validate(scene, ["Ground/K0=0,6"]), "'0,6', which are two numbers; write 0.6")
    text = scene.read_text("utf-8")
    pathlib.Path("s.prm").write_text(
        text + "subsection Ground\n  set K0 = 1,2 # as in Excel\nend\n", "utf-8")
    valid(validate("s.prm"), "'1,2', which are two numbers")


def free_field_warnings():
    """What the ground beside a free field leaves out is said."""
    scene = PRM / "verification/free_field.prm"
    valid(validate(scene))
    valid(validate(scene, ["Materials/soft/Model=mohr_coulomb",
                           "Materials/soft/Cohesion=1e6"]),
          "ground beside the model stays elastic")
    valid(validate(scene, ["Stages/shake/Damping ratio=0.01"]),
          "whose 'Damping ratio' the ground beside the model has not")


OBLIQUE = """set Dimension = 3
subsection Domain
  set Corner = -20, -20, -20
  set Size = 40, 40, 40
end
subsection Mesh
  set Cells = 4, 4, 4
end
subsection Ground
  set Depth = 200
  set K0 = 2, 1
  set Azimuth = 45
end
subsection Materials
  set Names = rock
end
subsection Stages
  set Names = rest
  subsection rest
    set Kind = static
  end
end
"""
ROLLERS = ["Supports/Names=below, beside",
           "Supports/below/Boundaries=bottom",
           "Supports/below/Directions=normal",
           "Supports/beside/Boundaries=left, right, front, back",
           "Supports/beside/Directions=normal"]


def oblique_stress():
    """Shear along the sides is held, or it is said that it leaves."""
    pathlib.Path("s.prm").write_text(OBLIQUE, encoding="utf-8")
    valid(validate("s.prm"))

    def motion(settings):
        done = run(["s.prm", "--output", "out"]
                   + [word for s in settings for word in ("--set", s)])
        assert done.returncode == 0, done.stderr
        with open("out/summary.json", encoding="utf-8") as file:
            return json.load(file)["stages"][0]["max_displacement"]

    # the shear is (2 - 1) / 2 * 9.81 * 2700 * 200 Pa; rollers let it go, which
    # moves the sides
    assert motion([]) < 1e-6
    assert motion(ROLLERS) > 1e-3
    leaves = "a mean shear of 2.65e+06 Pa along the boundaries of the support 'beside'"
    valid(validate("s.prm", ROLLERS), leaves)
    valid(validate("s.prm", ROLLERS + ["Ground/Azimuth=180"]))
    valid(validate("s.prm", ROLLERS + ["Supports/beside/Directions=xy"]))
    # held along the sides by another support, or by what is on them
    valid(validate("s.prm", ROLLERS + [
        "Supports/Names=below, beside, along",
        "Supports/along/Boundaries=left, right, front, back",
        "Supports/along/Directions=xy"]))
    flat = PRM / "verification" / "gravity_column.prm"
    sheared = ["Initial state/Stress=-1e6; -1e6; -1e6; 2e5"]
    valid(validate(flat, sheared), "a mean shear of 2e+05 Pa")


def written_out():
    """Overrides of what used.prm has written out are refused."""
    scene = PRM / "tutorial" / "first_tunnel.prm"
    few = ["--set", "Output/Write VTU=false", "--set", "Safety factor/Blocks=none"]
    for stage in ("heading", "bench"):
        few += ["--set", f"Stages/{stage}/Maximum steps=5"]
    assert run([scene, "--output", "a", *few]).returncode == 0
    used = "a/used.prm"
    refused(validate(used, ["Joint sets/east/Friction angle=10"]),
            "set 'Joints/east/Friction angle' for those of the set")
    refused(validate(used, ["Joint sets/east/Spacing=3"]),
            "the joints of the sets are already made in this scene")
    refused(validate(used, ["Ground/K0=2"]),
            "what follows from it is already written out in this scene")
    refused(run([used, "--study", "--output", "b"]), "Sample 1 of the study")
    weak = validate(used, ["Joints/east/Friction angle=10"])
    assert weak.returncode == 0, weak.stderr
    assert weak.stdout != validate(used).stdout
    assert validate(used, ["Ground/Depth=-1"]).returncode == 0


def main():
    case = globals()[sys.argv[3]]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        case()


if __name__ == "__main__":
    main()

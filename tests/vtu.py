#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the VTU files of a run hold.

usage: vtu.py KEYBLOCK PRM FOLDER CASE

column: a point for each node and the closed form's stress as a tensor at cells,
on one rank and on two. wedge: a block on two joints in space, its vectors,
states and factor, also one that is as wanted, and files of less than 120 bytes a cell. stages: plastic rock
that is dug in two stages, their names, and the same files by a run that goes on
from a checkpoint. bolts: a bolt that is tensioned. vtk: VTK reads all of that;
77 where it is not installed.
"""
import json
import math
import pathlib
import subprocess
import sys
import time
import xml.etree.ElementTree

from vtu_reader import Grid

KEYBLOCK, PRM, FOLDER, CASE = sys.argv[1:5]
PRM, FOLDER = pathlib.Path(PRM), pathlib.Path(FOLDER)
LINE, POLYGON, QUADRILATERAL, HEXAHEDRON = 3, 7, 9, 12


def run(scene, folder, *settings, ranks=1, options=()):
    """Run a scene; its summary and the entries of solution.pvd."""
    parallel = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n",
                str(ranks)] if ranks > 1 else []
    subprocess.run([*parallel, KEYBLOCK, PRM / f"{scene}.prm", "--output",
                    folder, *options]
                   + [word for s in settings for word in ("--set", s)],
                   check=True, stdout=subprocess.DEVNULL)
    root = xml.etree.ElementTree.parse(folder / "solution.pvd").getroot()
    return (json.loads((folder / "summary.json").read_text(encoding="utf-8")),
            [s.attrib for s in root.iter("DataSet")])


def near(found, expected, tolerance):
    """Whether numbers of single precision are those expected."""
    return all(abs(f - e) <= tolerance for f, e in zip(found, expected))


def rocks(entries):
    """File names and stages of the rock."""
    return [(e["file"], e["group"]) for e in entries if e["name"] == "rock"]


def assert_shape(grid, n_cells, n_points, cell_type):
    """Shared points, cells of one kind, ids that are whole numbers."""
    assert (grid.n_cells, grid.n_points) == (n_cells, n_points)
    assert set(grid.cell_types) == {cell_type}
    used = sorted({point for cell in grid.cells for point in cell})
    assert used == list(range(n_points))
    for name, kind in grid.types.items():
        is_id = name in ("block", "block class", "material", "state", "joint",
                         "excavation stage", "connectivity", "offsets")
        assert kind == ("Int32" if is_id else kind), name
        assert name in ("TimeValue", "types") or kind in ("Int32", "Float32")


def column_stress(grid):
    """Compare with the closed form; the largest stress."""
    density, gravity, height, ratio = 2700., 9.81, 100., 0.3
    largest = density * gravity * height
    for cell, stress, principal, direction in zip(
            grid.cells, grid.at_cells["stress (Pa)"],
            grid.at_cells["principal stress (Pa)"],
            grid.at_cells["direction of principal stress 3"]):
        y = sum(grid.points[p][1] for p in cell) / 4.
        down = -density * gravity * (height - y)
        side = ratio / (1. - ratio) * down
        assert near(stress, (side, 0., 0., 0., down, 0., 0., 0., side),
                    1e-6 * largest)
        trace = stress[0] + stress[4] + stress[8]
        assert abs(trace - (1. + ratio) / (1. - ratio) * down) < 1e-6 * largest
        assert near(principal, (side, side, down), 1e-6 * largest)
        assert abs(abs(direction[1]) - 1.) < 1e-6, direction
    return largest


def assert_column():
    """100 m of rock of 2700 kg/m3 and Poisson's ratio 0.3 between rollers."""
    summary, entries = run("verification/gravity_column", FOLDER)
    (_, start), (name, stage) = rocks(entries)
    assert (start, stage) == ("start", "settle")
    times = [float(e["timestep"]) for e in entries]
    assert times[0] == times[1] < times[2] == times[3] < 1e-6
    grid = Grid(FOLDER / name)
    assert_shape(grid, 40, 63, QUADRILATERAL)
    assert summary["scene"]["nodes"] == 63
    assert grid.texts["stage"] == ["settle"]
    assert set(grid.called("material")) == {"rock"}
    assert set(grid.called("excavation stage")) == {"none"}
    print(f"stresses up to {column_stress(grid):.6g} Pa")
    top = [u[1] for x, u in zip(grid.points, grid.at_points["displacement (m)"])
           if x[1] == 100.]
    stiffness = 15e9 * 0.7 / (1.3 * 0.4)
    assert len(top) == 3 and near(
        top, [-2700. * 9.81 * 100.**2 / (2. * stiffness)] * 3, 1e-8)

    _, entries = run("verification/gravity_column", FOLDER / "ranks", ranks=2)
    name = rocks(entries)[1][0]
    assert name.endswith(".pvtu")
    pieces = [Grid(FOLDER / "ranks" / name.replace(".pvtu", f".{r}.vtu"))
              for r in (0, 1)]
    assert sum(piece.n_cells for piece in pieces) == 40
    for piece in pieces:
        column_stress(piece)
    collected = xml.etree.ElementTree.fromstring(
        (FOLDER / "ranks" / name).read_bytes().partition(b"<AppendedData")[0]
        + b"</VTKFile>")
    for parent, arrays in (("PPointData", pieces[0].at_points),
                           ("PCellData", pieces[0].at_cells)):
        assert [e.get("Name") for e in collected.find(f".//{parent}")
                ] == list(arrays)


def assert_wedge():
    """A wedge that slides on A and B; the bed is rigid."""
    summary, entries = run("verification/wedge_3d", FOLDER,
                           "Output/Write VTU=true",
                           "Safety factor/Bracket=0.05")
    scene, name = summary["scene"], rocks(entries)[-1][0]
    rock = Grid(FOLDER / name)
    assert_shape(rock, scene["cells"], scene["nodes"], HEXAHEDRON)
    size = (FOLDER / name).stat().st_size / rock.n_cells
    print(f"{size:.1f} bytes a cell")
    assert size < 120.
    for block, material, kind in zip(rock.at_cells["block"],
                                     rock.called("material"),
                                     rock.called("block class")):
        assert (material, kind) == (("rock", "exposed") if block == 1 else
                                    ("bed", "rigid"))
    factor = summary["blocks"][0]["safety_factor"][0]["value"]
    for block, value, outcome in zip(rock.at_cells["block"],
                                     rock.at_cells["safety factor"],
                                     rock.called("safety factor outcome")):
        assert outcome == ("value" if block == 1 else "none")
        assert abs(value - factor) < 1e-6 if block == 1 else math.isnan(value)
    assert_faces(scene, Grid(FOLDER / name.replace("rock", "interface")))
    assert_wanted()
    planes = Grid(FOLDER / "joints.vtu")
    assert planes.called("joint") == ["A", "B"]
    assert set(planes.cell_types) == {POLYGON}
    assert near(planes.at_cells["dip (deg)"], (40., 60.), 1e-4)
    assert near(planes.at_cells["dip direction (deg)"], (130., 220.), 1e-4)


def assert_faces(scene, joints):
    """The joints of the wedge, whose normals follow from dip and azimuth."""
    assert joints.n_points == scene["pairs"]
    dips = {"A": (40., 130.), "B": (60., 220.)}
    assert set(joints.called("joint")) == set(dips)
    assert set(joints.called("joint set")) == {"none"}
    assert set(joints.at_cells["is between rock"]) == {1}
    assert set(joints.called("state")) <= {"sticking", "sliding", "open"}
    assert set(joints.at_cells["block on plus side"]) == {1}
    for cell, joint in zip(joints.cells, joints.called("joint")):
        dip, azimuth = map(math.radians, dips[joint])
        normal = (math.sin(dip) * math.sin(azimuth),
                  math.sin(dip) * math.cos(azimuth), math.cos(dip))
        for p in cell:
            assert near(joints.at_points["normal"][p], normal, 1e-6)
            for name in ("slip (m)", "shear (Pa)"):
                vector = joints.at_points[name][p]
                across = sum(v * n for v, n in zip(vector, normal))
                assert abs(across) <= 1e-6 * math.hypot(*vector), name
    assert min(joints.at_points["pressure (Pa)"]) >= 0.
    assert max(math.hypot(*s) for s in joints.at_points["shear (Pa)"]) > 1.


def assert_wanted():
    """A search that ends at the wanted factor has no value, but a name."""
    summary, entries = run("verification/wedge_3d", FOLDER / "wanted",
                           "Output/Write VTU=true", "Safety factor/Wanted=0.8")
    factor, = summary["blocks"][0]["safety_factor"]
    assert factor["outcome"] == "above 0.8, as wanted"
    rock = Grid(FOLDER / "wanted" / rocks(entries)[-1][0])
    assert set(rock.called("safety factor outcome")) == {"as wanted", "none"}
    assert all(map(math.isnan, rock.at_cells["safety factor"]))


def assert_stages():
    """Rock that yields, dug on the right, then on the left."""
    settings = ("Materials/rock/Model=mohr_coulomb",
                "Materials/rock/Cohesion=1e5", "Check/Closed form=none",
                "Stages/one/Maximum steps=1500", "Stages/two/Maximum steps=1500",
                "Output/VTU count=4")
    _, entries = run("verification/order_stepped", FOLDER, *settings)
    written = rocks(entries)
    assert [stage for _, stage in written] == sorted(
        (stage for _, stage in written), key=["start", "one", "two"].index)
    assert {"start", "one", "two"} == {stage for _, stage in written}
    first, last = (Grid(FOLDER / written[i][0]) for i in (0, -1))
    assert_shape(first, 1600, 1681, QUADRILATERAL)
    names = first.called("excavation stage")
    assert {n: names.count(n) for n in set(names)} == {
        "none": 1552, "one": 24, "two": 24}
    assert last.n_cells == 1552 and last.texts["stage"] == ["two"]
    assert set(first.at_cells["yielded"]) == {0}
    strain = last.at_cells["plastic strain"]
    assert max(strain) > 0. and last.at_cells["yielded"] == [
        int(e > 0.) for e in strain]
    # the same by a run that is stopped once it has dug, and goes on
    again = FOLDER / "again"
    again.mkdir(exist_ok=True)
    for path in again.iterdir():
        path.unlink()
    awaited = again / next(f for f, stage in written if stage == "two")
    with subprocess.Popen(
            [KEYBLOCK, PRM / "verification" / "order_stepped.prm", "--output",
             again] + [word for s in settings for word in ("--set", s)],
            stdout=subprocess.DEVNULL) as process:
        while process.poll() is None and not awaited.exists():
            time.sleep(0.002)
        process.terminate()
    assert process.returncode != 0, "it ended before it was stopped"
    _, other = run("verification/order_stepped", again, *settings,
                   options=("--restart", again / "checkpoint.h5"))
    assert entries == other
    for entry in entries:
        one, two = ((folder / entry["file"]).read_bytes()
                    for folder in (FOLDER, again))
        assert one == two, entry["file"]


def assert_bolts():
    """A bolt that bears its yield force from its head on."""
    run("verification/bolted_incline", FOLDER, "Output/Write VTU=true",
        "Safety factor/Blocks=none")
    root = xml.etree.ElementTree.parse(FOLDER / "bolts.pvd").getroot()
    entry = list(root.iter("DataSet"))[-1]
    assert entry.get("group") == "rest" and entry.get("part") == "0"
    lines = Grid(FOLDER / entry.get("file"))
    assert lines.n_points == lines.n_cells + 1 and set(
        lines.cell_types) == {LINE}
    assert set(lines.called("bolt set")) == {"anchor"}
    assert set(lines.at_cells["bolt"]) == {1}
    assert max(lines.at_cells["axial force (N)"]) > 0.
    assert len(lines.at_points["bond slip (m)"]) == lines.n_points


def assert_vtk():
    """Whatever VTK finds is what the tests' own reader finds."""
    try:
        # pylint: disable=import-outside-toplevel
        from vtkmodules.vtkIOXML import (vtkXMLPUnstructuredGridReader,
                                         vtkXMLUnstructuredGridReader)
    except ImportError:
        print("VTK is not installed")
        sys.exit(77)
    run("verification/wedge_3d", FOLDER, "Output/Write VTU=true",
        "Safety factor/Blocks=none")
    run("verification/wedge_3d", FOLDER / "ranks", "Output/Write VTU=true",
        "Safety factor/Blocks=none", ranks=2)

    def read(path):
        reader = (vtkXMLPUnstructuredGridReader if path.suffix == ".pvtu" else
                  vtkXMLUnstructuredGridReader)()
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutput()

    for path in sorted(FOLDER.glob("*.vtu")):
        ours, vtks = Grid(path), read(path)
        assert (vtks.GetNumberOfPoints(), vtks.GetNumberOfCells()) == (
            ours.n_points, ours.n_cells), path
        for data, arrays in ((vtks.GetPointData(), ours.at_points),
                             (vtks.GetCellData(), ours.at_cells)):
            assert data.GetNumberOfArrays() == len(arrays), path
            for name, values in arrays.items():
                found, last = data.GetArray(name), len(values) - 1
                value = values[last]
                assert found.GetTuple(last) == (
                    value if isinstance(value, tuple) else (value,)), name
        for name, texts in ours.texts.items():
            array = vtks.GetFieldData().GetAbstractArray(name)
            assert [array.GetValue(i) for i in
                    range(array.GetNumberOfValues())] == texts, name
    whole = read(FOLDER / "rock_0001.vtu")
    parts = read(FOLDER / "ranks" / "rock_0001.pvtu")
    assert parts.GetNumberOfCells() == whole.GetNumberOfCells()
    stage = parts.GetFieldData().GetAbstractArray("stage")
    assert stage.GetValue(0) == "rest"


{"column": assert_column, "wedge": assert_wedge, "stages": assert_stages,
 "bolts": assert_bolts, "vtk": assert_vtk}[CASE]()

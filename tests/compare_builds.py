#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether contrib/compare_builds.py finds what two programs do differently.

usage: tests/compare_builds.py FOLDER

The programs are copies of this file that write a few results of fixed content; the
name of a copy says what differs in them. Open MPI and ctest are replaced, too.
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent


# -- the programs

def vtu(values):
    """A VTU file with one point and some values at it, as the program writes it."""
    arrays = [("Points", 3, [0., 1., 2.])] + [
        (name, 1, [value]) for name, value in values.items()]
    data, elements = b"", []
    for name, width, numbers in arrays:
        raw = struct.pack(f"<{len(numbers)}f", *numbers)
        packed = zlib.compress(raw)
        elements.append(f'<DataArray type="Float32" Name="{name}" '
                        f'NumberOfComponents="{width}" format="appended" '
                        f'offset="{len(data)}"/>\n')
        data += struct.pack("<4I", 1, len(raw), 0, len(packed)) + packed
    return (
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" '
        'header_type="UInt32" compressor="vtkZLibDataCompressor">\n'
        '<UnstructuredGrid>\n<FieldData>\n<DataArray type="Float64" '
        'Name="TimeValue" NumberOfTuples="1" format="ascii">0.5</DataArray>\n'
        '</FieldData>\n<Piece NumberOfPoints="1" NumberOfCells="0">\n<PointData>\n'
        f'{"".join(elements[1:])}</PointData>\n<Points>\n{elements[0]}</Points>\n'
        '</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_').encode(
            ) + data + b"\n</AppendedData>\n</VTKFile>\n"


def write_results(fault, scene, options):
    """What a program with a fault does."""
    folder = pathlib.Path(options[options.index("--output") + 1])
    folder.mkdir()
    is_late, is_near = fault == "late", fault == "near"
    (folder / "used.prm").write_text(f"set File = {scene}\n", encoding="utf-8")
    (folder / "checkpoint.h5").write_bytes(str(time.time_ns()).encode())
    (folder / "history.csv").write_text(
        "stage,x [m],y [m]\n0,1000,0.25\n1,-2000,"
        + ("0.2500001" if is_near else "0.26" if fault == "cell" else "0.25")
        + "\n" + "1,0,0\n" * (fault == "row"), encoding="utf-8")
    (folder / "summary.json").write_text(json.dumps({
        "program": {"version": "2" if is_late else "1", "ranks": 1},
        "run": {"wall_time": time.time(), "steps": 10 + (fault == "key")},
        "blocks": [{"volume": 1e6}, {"volume": 1. + 1e-3 * is_near}],
        "warnings": [] if fault == "no_warning" else ["Mind the gap of 0.1 m."]}),
        encoding="utf-8")
    (folder / "rock_0000.vtu").write_bytes(
        vtu({"pressure (Pa)": 7.25 if fault == "vtu" else 7., "speed (m/s)": 3.}))
    if fault != "no_file":
        (folder / "blocks.csv").write_text("block\n1\n", encoding="utf-8")
    seconds = 17.3 if is_late else 0.25
    if is_late:
        print("Stage 1 of 2 (rest)  step 100  left 3 s")
    print("Stage   rest: 10 steps, "
          + ("0.6" if fault == "line" else "0.5000001" if is_near else "0.5")
          + " s, unbalanced ratio 1e-7")
    print(f"Factor  block 1 after rest: 0.7; 2 trials, {seconds} s")
    print(f"Output  {folder}/  ({seconds} s)")
    if fault == "errors":
        print("Error: a word", file=sys.stderr)
    return 2 if fault in ("code", "failing") else 0


# -- the tests

def make_script(path, text):
    """A file that can be run."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    path.chmod(0o755)
    return str(path)


def make_program(folder, fault):
    """A copy of this file for a fault."""
    text = pathlib.Path(__file__).read_text(encoding="utf-8").split("\n", 1)[1]
    return make_script(folder / f"program_{fault}", f"#!{sys.executable}\n{text}")


def compare(folder, old, new, *options):
    """Exit code and lines of the comparison of two programs."""
    path = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        [sys.executable, ROOT / "contrib" / "compare_builds.py",
         make_program(folder, old), "--keyblock", make_program(folder, new),
         "--build", folder, *options],
        capture_output=True, text=True, check=False, env={**os.environ, "PATH": path})
    assert not done.stderr, done.stderr
    return done.returncode, done.stdout.splitlines()


def check(folder, scene):
    """Every difference is found, and nothing else."""
    last = "1 runs, 1 differ"
    for fault, lines in (
            ("same", []),
            ("late", []),
            ("cell", ["history.csv: row 2, column 3 (y [m]): 0.25 -> 0.26"]),
            ("row", [f"history.csv: row 3, column {c} ({title}): missing -> {value}"
                     for c, title, value in ((1, "stage", 1), (2, "x [m]", 0),
                                             (3, "y [m]", 0))]),
            ("key", ["summary.json: run/steps: 10 -> 11"]),
            ("no_warning", ["summary.json: warnings/0: Mind the gap of 0.1 m. "
                            "-> missing", "summary.json: warnings: missing -> []"]),
            ("vtu", ["rock_0000.vtu: PointData/pressure (Pa)[0]: 7.0 -> 7.25"]),
            ("line", ["stdout: line 1: Stage rest: 10 steps, 0.5 s, unbalanced ratio "
                      "1e-7 -> Stage rest: 10 steps, 0.6 s, unbalanced ratio 1e-7"]),
            ("errors", ["stderr: line 1: nothing -> Error: a word"]),
            ("no_file", ["blocks.csv: file: there -> missing"]),
            ("code", ["exit code: program: 0 -> 2"])):
        found = compare(folder, "same", fault, "--scenes", scene, "--ranks", "1")
        expected = (1, [f"slide.1: {line}" for line in lines] + [last]) if lines else (
            0, ["1 runs, 0 differ"])
        assert found == expected, (fault, found)
    code, lines = compare(folder, "failing", "failing", "--scenes", scene,
                          "--ranks", "1")
    assert code == 1 and "both runs fail with 2" in lines[0], lines


def check_tolerance(folder, scene):
    """Columns, arrays and keys have their own scales; sentences their digits."""
    for tolerance, files in (("0", ["stdout", "history.csv", "summary.json"]),
                             ("1e-8", ["history.csv"]),
                             ("1e-6", [])):
        code, lines = compare(folder, "same", "near", "--scenes", scene,
                              "--ranks", "1", "--tolerance", tolerance)
        assert [line.split(": ")[1] for line in lines[:-1]] == files, lines
        assert code == bool(files), lines


def check_tests(folder, scene):
    """Scenes, ranks and overrides are those of the tests that ctest lists."""
    command = ["python3", "compare.py", "keyblock", scene, "slide.ref", "1",
               "folder", "--set=A=1; 2"]
    tests = {"tests": [{"name": "scenes/slide.1", "command": command},
                       {"name": "history", "command": ["python3", "history.py"]},
                       {"name": "scenes/slip.2", "command": command[:7]}]}
    make_script(folder / "bin" / "ctest",
                f"#!/bin/sh\ncat <<'END'\n{json.dumps(tests)}\nEND\n")
    log = folder / "mpirun.log"
    make_script(folder / "bin" / "mpirun",
                f'#!/bin/sh\necho "$@" >> "{log}"\n'
                'echo "[host:$$] a remark of mpirun" >&2\n'
                'while [ "$1" != -n ]; do shift; done\nshift 2\nexec "$@"\n')
    log.unlink(missing_ok=True)
    found = compare(folder, "same", "same")
    assert found == (0, ["4 runs, 0 differ"]), found
    calls = log.read_text(encoding="utf-8").splitlines()
    assert len(calls) == 4 and all("-n 2 " in call for call in calls), calls
    assert sum(call.endswith("--set=A=1; 2") for call in calls) == 2, calls
    found = compare(folder, "same", "cell", "--only", "slip.2")
    assert found[1][0].startswith("slip.2: history.csv: row 2"), found
    found = compare(folder, "same", "same", "--only", "nothing")
    assert found == (1, ["0 runs, 0 differ"]), found


def main():
    """Exit with a message if something is not found."""
    folder = pathlib.Path(sys.argv[1]).resolve()
    scene = folder / "slide.prm"
    folder.mkdir(parents=True, exist_ok=True)
    scene.write_text("", encoding="utf-8")
    check(folder, str(scene))
    check_tolerance(folder, str(scene))
    check_tests(folder, str(scene))


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv[0]).name
    if PROGRAM.startswith("program_"):
        sys.exit(write_results(PROGRAM[len("program_"):], sys.argv[1], sys.argv[2:]))
    main()

#!/usr/bin/env python3
"""Extrapolates the collapse pressure of strip footings over meshes.

usage: contrib/footing.py [--angles 10,20,30,35] [--tolerances 1,1,2,2] [--meshes 2]
         [--keyblock build/keyblock] [--keep FOLDER] [-- arguments for keyblock]

Runs prm/verification/footing_ANGLE.prm and the same with cells of half the size and
twice the steps, and extrapolates the collapse pressure to cells of no size. A
collapse load of cells with one pressure each comes from above, and its error
falls in proportion to the size of cells: order 1 is assumed, F = 2 F(h/2) - F(h).
With --meshes 3 (a quarter of the size besides) the order that was found is printed,
and the two finest meshes are extrapolated, by order 1 as well. Exits with 1 if a
run fails, or the extrapolated pressure is off the exact one by more than its
tolerance [%].
"""
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from script_tools import ROOT, make_parser, split_arguments


def entry(text, name):
    """The value of an entry that the scene has once."""
    found = re.findall(rf"(?m)^\s*set {name} = (.*)$", text)
    assert len(found) == 1, f"{len(found)} entries '{name}'"
    return found[0]


def finer(scene, times):
    """Entries for cells TIMES smaller, TIMES a power of 2."""
    text = scene.read_text(encoding="utf-8")
    cells = [int(n) for n in entry(text, "Cells").split(",")]
    steps = int(entry(text, "Maximum steps"))
    # half the width of the footing and half a cell
    length = 0.5 + (float(entry(text, "Length")) - 0.5) / times
    return {"Mesh/Cells": ", ".join(str(times * n) for n in cells),
            "Stages/push/Maximum steps": times * steps, "Check/Length": f"{length:.9g}"}


def error_of(program, scene, times, folder, rest):
    """Error of the collapse pressure, relative [-]."""
    output = folder / f"{scene.stem}_{times}"
    command = [program, str(scene), "--output", str(output),
               "--set", "Output/Write VTU=false"] + rest
    for name, value in finer(scene, times).items():
        command += ["--set", f"{name}={value}"]
    result = subprocess.run(command, text=True, capture_output=True)
    if result.returncode != 0:
        said = (result.stderr.strip() or result.stdout.strip()).splitlines()[-1:]
        sys.exit(f"{scene.stem}: exit {result.returncode}: {' '.join(said)}")
    summary = json.loads((output / "summary.json").read_text())
    return float(summary["checks"]["collapse_pressure_relative_error"])


def main():
    arguments, rest = split_arguments()
    parser = make_parser(__doc__)
    parser.add_argument("--angles", default="10,20,30,35")
    parser.add_argument("--tolerances", default="1,1,2,2")
    parser.add_argument("--meshes", type=int, default=2, choices=(2, 3))
    parser.add_argument("--keep", default="")
    options = parser.parse_args(arguments)
    folder = Path(options.keep or tempfile.mkdtemp()).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    program = str(Path(options.keyblock).resolve())
    angles = options.angles.split(",")
    tolerances = [float(t) for t in options.tolerances.split(",")]
    if len(angles) != len(tolerances):
        sys.exit(f"{len(angles)} angles, but {len(tolerances)} tolerances; give as many.")
    is_good = True
    for angle, tolerance in zip(angles, tolerances):
        scene = ROOT / "prm" / "verification" / f"footing_{angle}.prm"
        errors = [error_of(program, scene, 2 ** i, folder, rest)
                  for i in range(options.meshes)]
        extrapolated = 2. * errors[-1] - errors[-2]
        found = ", ".join(f"{100. * e:+.2f}" for e in errors)
        order = ""
        if len(errors) == 3 and (errors[0] - errors[1]) * (errors[1] - errors[2]) > 0.:
            ratio = (errors[0] - errors[1]) / (errors[1] - errors[2])
            order = f" (order found {math.log2(ratio):.2f})"
        is_within = abs(100. * extrapolated) <= tolerance
        is_good = is_good and is_within
        print(f"phi {angle}: {found} %; extrapolated by order 1{order}: "
              f"{100. * extrapolated:+.2f} %, tolerance {tolerance:g} %"
              f"{'' if is_within else '  <-- wrong'}", flush=True)
    sys.exit(0 if is_good else 1)


if __name__ == "__main__":
    main()

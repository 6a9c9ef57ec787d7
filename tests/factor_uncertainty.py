#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh errors of contrib/factor_uncertainty.py, of a program that only pretends.

usage: factor_uncertainty.py ROOT FOLDER

The program's factor is 1 + h^P with cells of size h, which each mesh makes as much
smaller as the case says: order and error are known, whatever the ratios.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT, FOLDER = (pathlib.Path(a).absolute() for a in sys.argv[1:3])
# the size of cells by what the mesh asks for; the scene holds the case
PROGRAM = '''#!/usr/bin/python3
import json, pathlib, sys
case = json.loads(pathlib.Path(sys.argv[1]).read_text())
words = sys.argv[2:]
output = pathlib.Path(words[words.index("--output") + 1])
output.mkdir(parents=True, exist_ok=True)
sets = dict(w.split("=", 1) for w in words if "=" in w)
asked = [e for e in case["finer"] if sets.get(e[0]) == e[1]]
h = asked[0][2] if asked else 0.1
value = 1. + h ** case["order"]
factor = {"stage": "dig", "outcome": "value", "value": value,
          "lower": value - 1e-6, "upper": value + 1e-6}
if case.get("open"):
    del factor["upper"]
(output / "summary.json").write_text(json.dumps({
    "warnings": ["The mesh has moved faces of blocks off ..."] if
        case.get("moved") and not asked else [],
    "scene": {"dimension": 3, "cells": round(h ** -3)}, "run": {"steps": 1},
    "blocks": [{"id": 1, "centroid": [0., 0., 0.], "volume": case.get("volume", 1.) if asked else 1.,
                "cells": round(h ** -3), "safety_factor": [factor]}]}))
(output / "used.prm").write_text("subsection Mesh\\n" + "\\n".join(
    f"set {k} = {v}" for k, v in case["mesh"].items()) + """
end
subsection Time stepping
set Safety = 0.5
end
subsection Safety factor
set Mass damping = 0.1
set Damping ratio = 0.1
end
""")
'''
GMSH = {"Generator": "gmsh", "Size": "2", "Size at excavation": "0",
        "Size at joints": "0", "Least size": "0", "Cells across blocks": "4",
        "Refinement levels": ""}


def assess(order, mesh, *finer, **case):
    """Exit code and output for a case; finer: entry, value, size of cells."""
    scene = FOLDER / "scene.prm"
    scene.write_text(json.dumps({"order": order, "mesh": mesh, "finer": finer,
                                 **case}))
    done = subprocess.run(
        [sys.executable, ROOT / "contrib/factor_uncertainty.py", scene,
         "--keyblock", FOLDER / "program", "--keep", FOLDER / "runs",
         "--meshes", str(1 + len(finer))], capture_output=True, text=True)
    assert not done.stderr, done.stderr
    return done.returncode, done.stdout


def main():
    """Exit with 1 at the first case that is not as it should be."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    (FOLDER / "program").write_text(PROGRAM)
    (FOLDER / "program").chmod(0o755)
    # the exact factor is 1, whatever the ratio is
    for size, words in ((0.05, "2.00"), (0.0625, "1.60")):
        code, text = assess(1, GMSH, ("Mesh/Size", "1", size))
        assert code == 0 and "extrapolated 1.000" in text, text
        assert f"block   {words} times smaller" in text, text
        assert ("Warning" in text) == (size > 0.06), text
    code, text = assess(2, GMSH, ("Mesh/Size", "1", 0.05),
                        ("Mesh/Size", "0.5", 0.03125))
    assert code == 0 and "order 2.00" in text and (
        "extrapolated 1.000" in text and "2.00, then 1.60" in text), text
    # cells that are about as they were tell nothing
    code, text = assess(1, GMSH, ("Mesh/Size", "1", 0.094))
    assert code == 1 and "1.06 times" in text and "mesh error  " not in text, text
    # without a size of cells they are halved where they are
    code, text = assess(1, {**GMSH, "Size": "0"},
                        ("Mesh/Refinement levels", "(0) + 1", 0.05))
    assert code == 0 and "2.00 times smaller" in text, text
    code, text = assess(1, GMSH, ("Mesh/Size", "1", 0.05), open=True)
    assert "open bracket, from" in text, text
    # another shape of the block in the finer mesh: all values are within
    for case, words in (({"volume": 1.05}, "blocks differ by 5 % in volume"),
                        ({"moved": True}, "moved faces of blocks (as it is, half "),
                        ({"volume": 1.005}, "")):
        code, text = assess(2, GMSH, ("Mesh/Size", "1", 0.05), **case)
        assert code == 0 and ("says little" in text) == (words != ""), text
        assert words in text, text
        value, _, width = re.search(r"factor  +(\S+) (\+-) (\S+) ",
                                    text).groups()
        assert float(value) + float(width) >= 1.01 - 1e-6, text
    code, text = assess(1, GMSH, ("Mesh/Size", "1", 0.03125), volume=0.9)
    value, width = map(float, re.search(r"factor  +(\S+) \+- (\S+) ",
                                        text).groups())
    assert "blocks differ by 11 %" in text and (
        abs(value - 1.03125) < 1e-5 and value + width >= 1.1), text
    code, text = assess(1, GMSH, ("Mesh/Size", "1", 0.03125))
    assert "says little" not in text and "+- 0.031" in text, text
    print("ratios are measured, errors told by them")


if __name__ == "__main__":
    main()

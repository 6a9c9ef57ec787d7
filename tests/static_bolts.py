#!/usr/bin/env python3
"""A tunnel with bolts in a static stage, and in quasi-static steps to rest.

usage: static_bolts.py KEYBLOCK PRM FOLDER RANKS

The bolts of prm/verification/lined_tunnel.prm, in place of its liner, stay
elastic, yield, or slip in their grout. Displacement and the largest force of
each bolt have to be the same within 1e-3, and the static stage in balance.
"""
import json
import pathlib
import subprocess
import sys

BOLTS = {"Stage": "dig", "Excavations": "tunnel", "Parts": "roof, walls, floor", "Length": "3",
         "Spacing": "1, 0.5", "Segment length": "0.25", "Young modulus": "200e9",
         "Plate strength": "1e6"}
CASES = {"elastic": {"Area": "1e-3", "Bond stiffness": "2e8", "Yield force": "1e9",
                     "Bond strength": "1e9"},
         "stiff": {"Area": "1e-2", "Bond stiffness": "2e9", "Yield force": "1e9",
                   "Bond strength": "1e9"},
         "yielding": {"Area": "1e-3", "Bond stiffness": "2e8", "Yield force": "120e3",
                      "Bond strength": "4e5"},
         "slipping": {"Area": "1e-3", "Bond stiffness": "2e8", "Yield force": "1e9",
                      "Bond strength": "5e4"}}
TOLERANCE = 1e-3


def summary_of(command, folder, kind, bolts):
    """Results of a run of one kind of stage."""
    entries = {"Shotcrete/Names": "", "Bolts/Names": "ring", "Stages/dig/Kind": kind,
               "Stages/dig/Unbalanced ratio": "1e-7", "Output/Write VTU": "false"}
    entries.update({f"Bolts/ring/{name}": value for name, value in bolts.items()})
    sets = [word for name, value in entries.items() for word in ("--set", f"{name}={value}")]
    subprocess.run([*command, *sets, "--output", str(folder / kind)], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads((folder / kind / "summary.json").read_text(encoding="utf-8"))


def main():
    """Exit with 1 where the two differ."""
    keyblock, prm, folder, ranks = sys.argv[1:]
    command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks] if ranks != "1" else []
    command += [keyblock, str(pathlib.Path(prm) / "verification" / "lined_tunnel.prm")]
    failures = 0
    for case, bolts in CASES.items():
        place = pathlib.Path(folder) / case
        place.mkdir(parents=True, exist_ok=True)
        solved, stepped = (summary_of(command, place, kind, {**BOLTS, **bolts})
                           for kind in ("static", "quasi-static"))
        pairs = [tuple(s["stages"][0]["max_displacement"] for s in (solved, stepped))]
        forces = [[bolt["largest_axial_force"] for bolt in s["bolts"]] for s in (solved, stepped)]
        assert len(forces[0]) == len(forces[1]) > 10
        pairs += zip(*forces)
        off = max(abs(a / b - 1.) for a, b in pairs)
        ratio = solved["stages"][0]["unbalanced_ratio"]
        failures += off > TOLERANCE or ratio > 1e-11
        print(f"{case}: {len(forces[0])} bolts of up to {1e-3 * max(forces[1]):.4g} kN, "
              f"off by {off:.2g}, unbalanced ratio {ratio:.2g}")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Run a scene and compare its checks with references.

usage: compare.py KEYBLOCK SCENE REFERENCES RANKS FOLDER [--set ...]

A line of the references reads `name value abs_tolerance rel_tolerance origin`.
The name is a key of `checks` in summary.json, or a path such as
energy/relative_residual or blocks/0/volume. The test passes if
|found - value| <= abs_tolerance + rel_tolerance * |value| on every line.
"""
import json
import subprocess
import sys


def look_up(summary, name):
    """The number called `name` in a summary."""
    if name in summary["checks"]:
        return float(summary["checks"][name])
    place = summary
    for key in name.split("/"):
        place = place[int(key)] if isinstance(place, list) else place[key]
    if isinstance(place, str):
        return place
    return float(len(place) if isinstance(place, list) else place)


def main():
    keyblock, scene, references, ranks, folder = sys.argv[1:6]
    # CMake splits lists at semicolons: @ stands for one
    overrides = [text.replace("@", ";") for text in sys.argv[6:]]
    command = [keyblock, scene, "--output", folder] + overrides
    if int(ranks) > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "-n", ranks] + command
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"exit code {run.returncode}\n{run.stdout}\n{run.stderr}")
    with open(f"{folder}/summary.json", encoding="utf-8") as file:
        summary = json.load(file)
    failures = n_lines = 0
    with open(references, encoding="utf-8") as file:
        for line in file:
            if not line.strip() or line.startswith("#"):
                continue
            name, value, absolute, relative, origin = line.rsplit(None, 4)
            assert origin in ("analytic", "published", "regression"), line
            n_lines += 1
            found = look_up(summary, name)
            if isinstance(found, str):
                failures += found != value
                print(f"{'ok  ' if found == value else 'FAIL'} {name} {found}")
                continue
            value = float(value)
            tolerance = float(absolute) + float(relative) * abs(value)
            good = abs(found - value) <= tolerance
            failures += not good
            print(f"{'ok  ' if good else 'FAIL'} {name} {found:.10g} "
                  f"(reference {value:.10g} +- {tolerance:.3g}, {origin})")
    assert n_lines > 0, "no reference"
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()

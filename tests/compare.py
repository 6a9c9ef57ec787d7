#!/usr/bin/env python3
"""Run a scene and compare its checks with references.

usage: compare.py KEYBLOCK SCENE REFERENCES RANKS FOLDER [--set ...]

A line of the references reads `name value abs_tolerance rel_tolerance origin`.
The name is a key of `checks` in summary.json, a path such as
energy/relative_residual or blocks/0/volume, or slope/STAGE/COLUMN/FROM/TO: the
slope against time of the straight line that fits a column of history.csv best,
least squares, between two times after the begin of a stage. The test passes if
|found - value| <= abs_tolerance + rel_tolerance * |value| on every line, if
summary.json is as its schema says, and if it has the warnings of the screen. In words an underscore stands for a blank.
"""
import csv
import re
import subprocess
import sys

import schema


def fit_slope(summary, folder, stage, column, begin, end):
    """Slope of a column of history.csv over a time window of a stage."""
    number = [entry["name"] for entry in summary["stages"]].index(stage)
    with open(f"{folder}/history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [title.split(" [")[0] for title in rows[0]]
    place = names.index(column)
    table = [(int(row[0]), float(row[2]), float(row[place]))
             for row in rows[1:]]
    start = max((time for n, time, _ in table if n < number), default=0.)
    points = [(time - start, value) for n, time, value in table
              if n == number and begin <= time - start <= end]
    assert len(points) >= 10, f"{len(points)} points to fit {column} to"
    mean_time = sum(time for time, _ in points) / len(points)
    mean = sum(value for _, value in points) / len(points)
    return (sum((time - mean_time) * (value - mean) for time, value in points)
            / sum((time - mean_time) ** 2 for time, _ in points))


def look_up(summary, folder, name):
    """The number or word called `name` in a summary or a history."""
    if name.startswith("slope/"):
        stage, column, begin, end = name.split("/")[1:]
        return fit_slope(summary, folder, stage, column, float(begin),
                         float(end))
    if name in summary["checks"]:
        return float(summary["checks"][name])
    place = summary
    for key in name.split("/"):
        place = place[int(key)] if isinstance(place, list) else place[key]
    if isinstance(place, str):
        return place.replace(" ", "_")
    return float(len(place) if isinstance(place, list) else place)


def main():
    keyblock, scene, references, ranks, folder = sys.argv[1:6]
    command = [keyblock, scene, "--output", folder] + sys.argv[6:]
    if int(ranks) > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "-n", ranks] + command
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"exit code {run.returncode}\n{run.stdout}\n{run.stderr}")
    summary = schema.read(f"{folder}/summary.json")
    faults = schema.faults_of(summary, "summary")
    said = re.findall("^Warning: (.*)$", run.stdout + run.stderr, re.MULTILINE)
    if said != summary["warnings"]:
        faults.append(f"the screen warns of {said}, summary.json of "
                      f"{summary['warnings']}")
    for fault in faults:
        print(f"FAIL {fault}")
    failures, n_lines = len(faults), 0
    with open(references, encoding="utf-8") as file:
        for line in file:
            if not line.strip() or line.startswith("#"):
                continue
            name, value, absolute, relative, origin = line.rsplit(None, 4)
            assert origin in ("analytic", "published", "regression"), line
            n_lines += 1
            found = look_up(summary, folder, name)
            if isinstance(found, str):
                good = found.replace(" ", "_") == value
                failures += not good
                print(f"{'ok  ' if good else 'FAIL'} {name} {found}")
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

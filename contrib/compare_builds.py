#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether two builds of the program give the same numbers, bit by bit.

usage: contrib/compare_builds.py OLD_KEYBLOCK [--keyblock NEW] [--build FOLDER]
         [--ranks 1,2] [--only TEXT]

Runs every scene of the quick tests (those that `ctest` lists in FOLDER) with both
programs and compares all rows of history.csv, as they are written; headers may
differ, and a column that only one of them has is left out. Prints the scenes that differ and by how much at most, relative to the
largest number in the column. Exits with 1 if there are any.
"""
import concurrent.futures
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from script_tools import ROOT, make_parser, numbers


def quick_scenes(build):
    """(name, scene, ranks, overrides) of each test that runs a scene."""
    tests = json.loads(subprocess.run(["ctest", "--show-only=json-v1"], cwd=build,
                                      capture_output=True, check=True).stdout)
    for test in tests["tests"]:
        command = test.get("command", [])
        if test["name"].startswith("scenes/"):
            # CMake splits lists at semicolons: @ stands for one
            yield (test["name"], command[3], int(command[5]),
                   [text.replace("@", ";") for text in command[7:]])


def rows_of(program, scene, ranks, overrides, folder):
    command = [program, scene, "--output", folder, "--set", "Output/Write VTU=false",
               *overrides]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "-n", str(ranks), *command]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    history = pathlib.Path(folder) / "history.csv"
    if done.returncode != 0 or not history.exists():
        return None
    with open(history, encoding="utf-8") as file:
        return list(csv.reader(file))


def difference(old, new):
    """Nothing if equal, else a sentence."""
    if old is None or new is None:
        return "both runs failed" if old is new else "one of the runs failed"
    if len(old[0]) != len(new[0]):  # what only one of them has says nothing
        common = set(old[0]) & set(new[0])
        old, new = ([[value for title, value in zip(rows[0], row) if title in common]
                     for row in rows] for rows in (old, new))
    old, new = old[1:], new[1:]
    if old == new:
        return None
    if [len(row) for row in old] != [len(row) for row in new]:
        return "other rows or columns"
    largest = 0.
    for a, b in zip(zip(*old), zip(*new)):
        scale = max(max(abs(float(x)) for x in a), 1e-300)
        largest = max(largest, max(abs(float(x) - float(y)) / scale
                                   for x, y in zip(a, b)))
    return f"differs by up to {largest:.1e} of the largest in its column"


def main():
    parser = make_parser(__doc__)
    parser.add_argument("old")
    parser.add_argument("--build", default=str(ROOT / "build"))
    parser.add_argument("--ranks", type=numbers, default=[1, 2])
    parser.add_argument("--only", default="", help="part of a test's name")
    options = parser.parse_args()

    def compare(job):
        name, scene, ranks, overrides = job
        with tempfile.TemporaryDirectory() as folder:
            return name, difference(*(
                rows_of(str(pathlib.Path(program).resolve()), scene, ranks, overrides,
                        f"{folder}/{i}")
                for i, program in enumerate((options.old, options.keyblock))))

    jobs = [job for job in quick_scenes(options.build)
            if job[2] in options.ranks and options.only in job[0]]
    n_different = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, text in pool.map(compare, jobs):
            if text:
                n_different += 1
                print(f"{name}: {text}", flush=True)
    print(f"{len(jobs)} runs, {n_different} differ")
    return 1 if n_different or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""history.csv grows while a run goes on, and is whole at any moment.

usage: history.py KEYBLOCK SCENE FOLDER
"""
import pathlib
import shutil
import subprocess
import sys
import time

LONGEST = 60.  # to wait for a second piece of the file [s]


def rows_of(path):
    """Its lines, by columns; none if it is not there."""
    if not path.exists():
        return []
    return [line.split(",") for line in path.read_text("utf-8").splitlines()]


def main():
    """Exit with 1 and a sentence for what is wrong."""
    keyblock, scene, folder = sys.argv[1:]
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    run = subprocess.Popen(
        [keyblock, scene, "--output", str(folder), "--set", "Output/Write VTU=false",
         "--set", "Stages/slide/Duration=1e4", "--set", "Output/History interval=50"],
        stdout=subprocess.DEVNULL)
    try:
        lengths, begin = [], time.time()
        while len(lengths) < 2 and time.time() < begin + LONGEST:
            time.sleep(0.2)
            if run.poll() is not None:
                sys.exit(f"the run ended with {run.returncode}")
            rows = rows_of(folder / "history.csv")
            if len(rows) > 1 and len(rows) not in lengths:
                lengths.append(len(rows))
    finally:
        run.kill()
        run.wait()
    if len(lengths) < 2:
        sys.exit(f"history.csv had {lengths} lines in {LONGEST} s")
    names, *rows = rows_of(folder / "history.csv")
    if any(len(row) != len(names) for row in rows):
        sys.exit("history.csv has lines of different lengths")
    steps = [int(row[names.index("step [-]")]) for row in rows]
    if steps != sorted(set(steps)):
        sys.exit("history.csv has steps twice, or not in their order")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Run a scene twice and compare the two histories byte by byte.

What is said goes to a pipe, and has no carriage returns.

usage: repeat.py KEYBLOCK SCENE RANKS FOLDER
"""
import subprocess
import sys

program, scene, ranks, folder = sys.argv[1:]
histories = []
for run in ("first", "second"):
    command = [program, scene, "--output", f"{folder}_{run}",
               "--set", "Output/Write VTU=false"]
    if int(ranks) > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "-n", ranks] + command
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"the run failed: {done.stdout}{done.stderr}")
    # mpirun gives its ranks a terminal, though this is none
    if "\r" in done.stdout.replace("\r\n", "\n"):
        sys.exit("the output has the line of progress of a terminal")
    with open(f"{folder}_{run}/history.csv", "rb") as file:
        histories.append(file.read())
if histories[0] != histories[1]:
    sys.exit("the two histories differ")
print(f"equal: {len(histories[0])} bytes")

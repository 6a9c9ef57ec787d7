#!/usr/bin/env python3
"""Break runs off, continue them, and compare with the uninterrupted run.

usage: restart.py KEYBLOCK SCENE FOLDER [options]

  --breaks N       how many runs that had saved themselves are broken off, at
                   random moments (1)
  --by HOW         kill: SIGKILL; stop: SIGTERM, or SIGUSR1 on several ranks,
                   after which the exit code must be 143 or 138; full: no room
                   for files (kill)
  --ranks N...     ranks of the first run, of the second, ... in turn (1)
  --tolerance X    of numbers in history.csv, relative to the largest of the
                   columns of their unit, and in summary.json, relative to the
                   number or 1; 0: equal bytes (0)
  --set A=B        as for keyblock

All runs but the first, uninterrupted one save themselves some twenty times, but
not oftener than every 20 ms. What was broken off must have been resumed, from its
checkpoint. At last a run goes on from the last checkpoint of one that ended.
"""
import argparse
import csv
import math
import os
import random
import re
import resource
import signal
import subprocess
import sys
import time

import schema

parser = argparse.ArgumentParser()
parser.add_argument("keyblock")
parser.add_argument("scene")
parser.add_argument("folder")
parser.add_argument("--breaks", type=int, default=1)
parser.add_argument("--by", choices=["kill", "stop", "full"], default="kill")
parser.add_argument("--ranks", type=int, nargs="+", default=[1])
parser.add_argument("--tolerance", type=float, default=0.)
parser.add_argument("--set", action="append", default=[])
options = parser.parse_args()
random.seed(1)

# besides times: the digest is that of all entries, overrides among them, the checkpoint interval included
TIMINGS = {"digest", "overrides", "wall_time", "loop_time", "contact_time", "force_time", "seconds",
           "phase_1_seconds", "million_element_steps_per_second",
           "peak_memory_bytes", "ranks"}


def command_of(folder, ranks, interval, extra):
    command = [options.keyblock, options.scene, "--output", folder,
               "--set", "Output/Write VTU=false",
               "--set", f"Output/Checkpoint interval={interval}"] + extra
    for assignment in options.set:
        # CMake splits lists at semicolons: @ stands for one
        command += ["--set", assignment.replace("@", ";")]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "-n", str(ranks)] + command
    return command


def run(command):
    return subprocess.run(command, capture_output=True, text=True)


def descendants(pid):
    """The process and all that it started."""
    found = [pid]
    try:
        with open(f"/proc/{pid}/task/{pid}/children") as file:
            for child in file.read().split():
                found += descendants(int(child))
    except FileNotFoundError:
        pass
    return found


def kill(process):
    for pid in descendants(process.pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    return process.communicate()


def assert_equal(a, b, where):
    if isinstance(a, dict):
        assert a.keys() == b.keys(), f"{where}: other keys"
        for key in a.keys() - TIMINGS:
            assert_equal(a[key], b[key], f"{where}/{key}")
    elif isinstance(a, list):
        assert len(a) == len(b), f"{where}: {len(a)} and {len(b)} entries"
        for i, (x, y) in enumerate(zip(a, b)):
            assert_equal(x, y, f"{where}/{i}")
    elif isinstance(a, float) and options.tolerance > 0.:
        scale = max(1., abs(a))
        assert abs(a - b) <= options.tolerance * scale, f"{where}: {a}, {b}"
    else:
        assert a == b, f"{where}: {a} and {b}"


def rows_of(folder):
    with open(folder + "/history.csv") as file:
        lines = list(csv.reader(file))
    return lines[0], [[float(x) for x in line] for line in lines[1:]]


def compare(folder, reference):
    """Largest difference in history.csv, relative to its unit."""
    summary = schema.read(folder + "/summary.json")
    faults = schema.faults_of(summary, "summary")
    assert not faults, faults
    assert_equal(summary, schema.read(reference + "/summary.json"), "summary")
    if options.tolerance == 0.:
        with open(folder + "/history.csv", "rb") as one, \
                open(reference + "/history.csv", "rb") as other:
            assert one.read() == other.read(), "the histories differ"
        return 0.
    (header, rows), (expected_header, expected) = map(rows_of,
                                                      (folder, reference))
    assert header == expected_header and len(rows) == len(expected), \
        "other columns or rows"
    largest = 0.
    units = [name.split(" ")[-1] for name in header]
    scales = dict.fromkeys(units, 1e-300)
    for row in expected:
        for unit, value in zip(units, row):
            scales[unit] = max(scales[unit], abs(value))
    for c, name in enumerate(header):
        difference = max(abs(row[c] - other[c])
                         for row, other in zip(rows, expected))
        difference /= scales[units[c]]
        assert difference <= options.tolerance, f"{name}: {difference:g}"
        largest = max(largest, difference)
    return largest


def is_resumed(output, restart):
    """Whether the run went on from a checkpoint, as it must if asked to."""
    assert ("Resumed " in output) == bool(restart), output
    return bool(restart)


def is_newer(file_name, begin):
    return os.path.exists(file_name) and os.path.getmtime(file_name) > begin


def wait_for(file_name, begin, process, seconds=60.):
    while not is_newer(file_name, begin) and process.poll() is None:
        assert time.time() < begin + seconds, "no checkpoint appears"
        time.sleep(0.002)


def expect(done, code, *texts):
    output = done.stdout + done.stderr
    assert done.returncode == code, f"exit code {done.returncode}: {output}"
    for text in texts:
        assert text in output, f"'{text}' is missing: {output}"


def expect_end(process, code, *texts):
    """The run ends with the code, having said so, unless it was done."""
    output = process.communicate()[0]
    if process.returncode == 0:
        return
    assert process.returncode == code, f"exit {process.returncode}: {output}"
    for text in texts:
        assert text in output, f"'{text}' is missing: {output}"


def fill_disk(process, checkpoint):
    """From now on no file can be longer than 1 kB."""
    for pid in descendants(process.pid):
        try:
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (1000, 1000))
        except ProcessLookupError:
            pass
    expect_end(process, 2, "history.csv' cannot be written",
               f"The last complete checkpoint is {checkpoint}",
               f"--restart {checkpoint}")


def stop(process, checkpoint, ranks):
    # mpirun kills the ranks a second after SIGTERM
    by = signal.SIGTERM if ranks == 1 else signal.SIGUSR1
    process.send_signal(by)
    expect_end(process, 128 + by, f"continue by: keyblock {options.scene}",
               f"--restart {checkpoint}")
    if broken == 0:
        expect_refusals(checkpoint, ranks)


def expect_refusals(checkpoint, ranks):
    """Another scene, another version and damage are refused with a sentence."""
    extra = ["--restart", checkpoint]
    folder = options.folder + "_refused"
    expect(run(command_of(folder, ranks, 0, extra + ["--set",
                                                 "Time stepping/Safety=0.7"])),
           1, "'Time stepping/Safety' is '0.9' there and '0.7' here")
    with open(checkpoint, "rb") as file:
        content = file.read()
    middle = len(content) // 2
    changed = bytes([content[middle] ^ 1])
    other = options.folder + "_other.h5"
    for text, words in (
            (re.sub(rb"written by keyblock [^\n]*", lambda found:
                    b"written by keyblock 9.9".ljust(len(found[0]), b"9"),
                    content, count=1), "was written by keyblock 9.9"),
            (content.replace(b", format ", b", format 9", 1), "is of format 9"),
            (content[512:], "is of format 1, without a checksum"),
            (content[:middle], "is damaged: it has"),
            (content[:middle] + changed + content[middle + 1:],
             "is damaged: its checksum"),
            (content[:300] + b"x" + content[301:],
             "is damaged: its first 512 bytes"),
            (b"words", "is not a checkpoint")):
        with open(other, "wb") as file:
            file.write(text)
        expect(run(command_of(folder, ranks, 0, ["--restart", other])), 1,
               words)
    expect(run(command_of(folder, ranks, 0, ["--restart", "/dev/zero"])), 1,
           "not a file")
    assert not os.path.exists(folder), "something was written"


reference = options.folder + "_reference"
expect(run(command_of(reference, options.ranks[0], 0, [])), 0)
# of the run itself, without what the program takes to start and to end
duration = schema.read(reference + "/summary.json")["run"]["wall_time"]
interval = max(0.02, duration / 20.)

broken, resumed, n_runs, largest = 0, 0, 0, 0.
while broken < options.breaks:
    folder = f"{options.folder}_{n_runs}"
    checkpoint = folder + "/checkpoint.h5"
    if os.path.exists(checkpoint):
        os.remove(checkpoint)
    n_runs += 1
    turn = 0
    while True:
        restart = ["--restart", checkpoint] if os.path.exists(checkpoint) else []
        ranks = options.ranks[turn % len(options.ranks)]
        turn += 1
        command = command_of(folder, ranks, interval, restart)
        begin = time.time()
        process = subprocess.Popen(command, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        if broken == options.breaks:
            output = process.communicate()[0]
            assert process.returncode == 0, output
            resumed += is_resumed(output, restart)
            break
        wait_for(checkpoint, begin, process)
        try:
            output = process.communicate(
                timeout=random.uniform(0., 1.2 * duration))[0]
            assert process.returncode == 0, output
            resumed += is_resumed(output, restart)
            break
        except subprocess.TimeoutExpired:
            has_saved = is_newer(checkpoint, begin)
            if options.by == "full":
                fill_disk(process, checkpoint)
            elif options.by == "stop":
                stop(process, checkpoint, ranks)
            else:
                kill(process)
            if process.returncode == 0:
                break
            # counts if it had saved itself
            broken += has_saved
    largest = max(largest, compare(folder, reference))

# nothing is left to be done after the last checkpoint of a run
ended, at_end = options.folder + "_ended", options.folder + "_at_end"
last = ended + "/checkpoint.h5"
if os.path.exists(last):
    os.remove(last)
expect(run(command_of(ended, options.ranks[0], 1e-6,
                      ["--restart", checkpoint])), 0)
if not os.path.exists(last):  # nothing was left after the other one
    last = checkpoint
done = run(command_of(at_end, options.ranks[-1], 0, ["--restart", last]))
expect(done, 0, "Resumed ")
largest = max(largest, compare(at_end, reference))

print(f"{broken} runs broken off, {n_runs} taken to the end, {resumed} of them "
      "from a checkpoint; "
      f"largest difference {largest:g}, uninterrupted {duration:.3g} s")
if resumed == 0:
    sys.exit("no run was resumed to its end")
if not math.isfinite(largest):
    sys.exit(1)

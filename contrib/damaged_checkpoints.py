#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Damages checkpoints, restarts from them and reports what must never happen.

usage: contrib/damaged_checkpoints.py [SCENE] [--number 100] [--seeds 1-3]
         [--only N] [--keyblock build/keyblock] [--keep FOLDER] [--ranks N]
         [--seconds 60] [--memory 2] [--set A=B]

A run of SCENE (prm/verification/order_stepped.prm) saves itself on its way. Each seed gives --number copies of a checkpoint, each damaged
in its own random way: --only repeats one. A copy is at fault if the restart
ends by a signal, after --seconds, or with an exit code other than 0 and 1; with
1 and more or less than one sentence, with words of C++, MPI or HDF5 in it, or
with something written; with 0 and other results than those of the run that was
never stopped. --memory: address space of a restart [GB]; 0: no limit. Copies at
fault are kept in --keep. Exits with 1 if there is one.
"""
import collections
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

from script_tools import ROOT, make_parser, numbers, without_mpirun

# what is not for users
RAW = re.compile(r"what\(\)|std::|terminate called|ExceptionBase|MPI_ABORT|"
                 r"An error occurred in|HDF5-DIAG|H5[A-Z]\w+\(|bad_alloc|"
                 r"basic_string|vector::|map::at|stod|stoul|internal check|"
                 r"Segmentation|core dumped|dealii|Process received signal")

# of summary.json: what is measured on the clock or of the machine
# besides times: the digest is that of all entries, overrides among them, the checkpoint interval included
TIMINGS = {"digest", "overrides", "wall_time", "loop_time", "contact_time", "force_time", "seconds",
           "phase_1_seconds", "million_element_steps_per_second",
           "peak_memory_bytes", "ranks"}


def region(content, rng):
    """Begin and end of a piece, mostly small, sometimes most of the file."""
    length = min(len(content), int(2**rng.uniform(0., 20.)) + 1)
    begin = rng.randrange(len(content) - length + 1)
    return begin, begin + length


def flip_bit(content, rng):
    """One bit."""
    at = rng.randrange(len(content))
    return content[:at] + bytes([content[at] ^ 1 << rng.randrange(8)]) + \
        content[at + 1:]


def flip_beginning(content, rng):
    """One bit of the first kilobyte: seal and superblock."""
    at = rng.randrange(1024)
    return content[:at] + bytes([content[at] ^ 1 << rng.randrange(8)]) + \
        content[at + 1:]


def flip_bytes(content, rng):
    """Some bytes anywhere."""
    bytes_ = bytearray(content)
    for _ in range(rng.randrange(2, 200)):
        bytes_[rng.randrange(len(bytes_))] = rng.randrange(256)
    return bytes(bytes_)


def cut_off(content, rng):
    """The end is missing."""
    return content[:rng.randrange(len(content))]


def fill(content, rng):
    """A piece of zeros, or of ones."""
    begin, end = region(content, rng)
    return content[:begin] + rng.choice((b"\0", b"\xff")) * (end - begin) + \
        content[end:]


def fill_pages(content, rng):
    """Zeros from a multiple of 4096 on, as of a disk that was not synced."""
    begin = 4096 * rng.randrange(max(1, len(content) // 4096))
    return content[:begin] + b"\0" * (len(content) - begin)


def scramble(content, rng):
    """A piece of random bytes."""
    begin, end = region(content, rng)
    return content[:begin] + bytes(rng.randrange(256)
                                   for _ in range(end - begin)) + content[end:]


def copy_piece(content, rng):
    """A piece in the place of another."""
    begin, end = region(content, rng)
    at = rng.randrange(len(content) - (end - begin) + 1)
    return content[:at] + content[begin:end] + content[at + end - begin:]


def remove(content, rng):
    """A piece is missing."""
    begin, end = region(content, rng)
    return content[:begin] + content[end:]


def insert(content, rng):
    """Bytes too many, in the middle or at the end."""
    at = rng.choice((len(content), rng.randrange(len(content))))
    return content[:at] + bytes(rng.randrange(256) for _ in range(
        rng.randrange(1, 600))) + content[at:]


def other_file(content, rng):
    """A file that is no checkpoint, or of another version."""
    return rng.choice((
        b"", b"\n", b"\0" * 4096, content[512:], content[:512],
        content[512:] + content[:512], b"keyblock checkpoint, format 2\n",
        content.replace(b", format ", b", format 9", 1),
        content.replace(b"written by keyblock ", b"written by keyblock 9", 1),
        content + content, b"set Dimension = 2\n" * 100,
        bytes(rng.randrange(256) for _ in range(rng.randrange(1, 100000)))))


DAMAGES = (flip_bit, flip_beginning, flip_bytes, cut_off, fill, fill_pages,
           scramble, copy_piece, remove, insert, other_file)


def limit_memory(gigabytes):
    """Of the process that is about to start."""
    def limit():
        if gigabytes > 0:
            resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 2**30),) * 2)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return limit


def without_timings(value):
    if isinstance(value, dict):
        return {key: without_timings(item) for key, item in value.items()
                if key not in TIMINGS}
    if isinstance(value, list):
        return [without_timings(item) for item in value]
    return value


def results_of(folder):
    """What a run has found, to the last digit."""
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    return without_timings(summary), (folder / "history.csv").read_bytes()


def command_of(options, folder, interval, arguments=()):
    command = [options.keyblock, str(options.scene), "--output", str(folder),
               "--set", "Output/Write VTU=false",
               "--set", f"Output/Checkpoint interval={interval}", *arguments]
    for assignment in options.set:
        command += ["--set", assignment]
    if options.ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n",
                   str(options.ranks)] + command
    return command


def run_intact(options, folder):
    """The run that is never stopped: results, and a checkpoint of its middle."""
    checkpoints = []
    with subprocess.Popen(command_of(options, folder, 0.02),
                          stdout=subprocess.DEVNULL) as process:
        while process.poll() is None:
            try:
                content = (folder / "checkpoint.h5").read_bytes()
                if not checkpoints or content != checkpoints[-1]:
                    checkpoints.append(content)
            except FileNotFoundError:
                pass
            time.sleep(0.01)
    if process.returncode != 0 or not checkpoints:
        sys.exit(f"the intact run ended with {process.returncode} and "
                 f"{len(checkpoints)} checkpoints")
    return results_of(folder), checkpoints[len(checkpoints) // 2]


def restart(options, checkpoint, folder):
    """Exit code, or None after too long, and what was said as an error."""
    command = command_of(options, folder, 0, ["--restart", str(checkpoint)])
    with subprocess.Popen(command, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                          preexec_fn=limit_memory(options.memory)) as process:
        try:
            _, errors = process.communicate(timeout=options.seconds)
            code = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            _, errors = process.communicate()
            code = None
    errors = errors.decode("utf-8", errors="replace")
    if options.ranks > 1:
        if code is not None and code > 128:  # a rank's signal
            code = 128 - code
        errors = without_mpirun(errors)
    return code, errors


def judge(code, errors, folder, expected):
    """What is at fault, or nothing."""
    if code is None:
        return "does not end"
    if code < 0:
        return f"signal {signal.Signals(-code).name}"
    found = RAW.search(errors)
    if found:
        return f"exit {code}, raw text '{found.group()}'"
    if code == 0:
        return "" if results_of(folder) == expected else \
            "exit 0 with other results"
    if code != 1:
        return f"exit {code}"
    message = errors.strip()
    if not message.startswith("Error: ") or not message.isprintable():
        return "exit 1, but not one sentence"
    return "exit 1, but something is written" if folder.exists() else ""


def read_options():
    parser = make_parser(__doc__)
    parser.add_argument("scene", type=pathlib.Path, nargs="?")
    parser.add_argument("--number", type=int, default=100)
    parser.add_argument("--seeds", default="1", type=numbers)
    parser.add_argument("--only", type=int)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60.)
    parser.add_argument("--memory", type=float, default=2.)
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    options.keyblock = os.path.abspath(options.keyblock)
    if options.scene is None:
        options.scene = ROOT / "prm" / "verification" / "order_stepped.prm"
    return options


def main():
    options = read_options()
    ends, n_faults = collections.defaultdict(collections.Counter), 0
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        expected, intact = run_intact(options, place / "intact")
        checkpoint = place / "checkpoint.h5"
        copies = [(seed, i) for seed in options.seeds
                  for i in range(options.number)
                  if options.only in (None, i)]
        for number, (seed, i) in enumerate([(0, 0)] + copies):
            rng = random.Random(f"{seed} {i}")
            # the first one is the checkpoint as it is
            damage = rng.choice(DAMAGES) if number else None
            content = damage(intact, rng) if damage else intact
            checkpoint.write_bytes(content)
            folder = place / f"copy_{number}"
            code, errors = restart(options, checkpoint, folder)
            fault = judge(code, errors, folder, expected)
            if not fault and code == 1 and content == intact:
                fault = "the intact checkpoint is refused"
            name = damage.__name__ if damage else "intact"
            ends[name][code] += 1
            if fault or options.only is not None:
                print(f"seed {seed}, {i} ({name}): {fault or 'in order'}  "
                      f"{errors.strip()[:300]}", flush=True)
            if fault and options.keep:
                options.keep.mkdir(parents=True, exist_ok=True)
                (options.keep / f"{seed}_{i}.h5").write_bytes(content)
            n_faults += bool(fault)
    for name, codes in sorted(ends.items()):
        print(f"{name}: " + ", ".join(f"exit {code}: {n}"
                                      for code, n in codes.items()))
    print(f"{len(copies)} damaged checkpoints, {n_faults} at fault")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares all results of two builds of the program, to prove a refactoring.

usage: contrib/compare_builds.py OLD_KEYBLOCK [--keyblock NEW] [--build FOLDER]
         [--ranks 1,2] [--only TEXT] [--tolerance 0] [--jobs N] [--scenes FILE...]

Runs the scenes of the quick tests (`ctest` lists them in FOLDER), or the files
named by --scenes, with both programs on each number of ranks. Compares the exit
code, the screen, and every file of the output folder: all keys of summary.json,
cells of CSV tables, arrays of VTU and PVTU files, and lines of other files.
Durations, memory and the build's own data (RUN_DEPENDENT, MASKS) are left out.
Checkpoints (*.h5) are not compared.

With --tolerance 0 results must be equal bit by bit. With --tolerance t numbers
may differ by t times the largest number of the same column, array or key; blocks/3/volume
and blocks/4/volume are one key. Within sentences a number may also differ
by one in its last digit, but whole numbers must be equal.

Prints `SCENE.RANKS: FILE: PLACE: OLD -> NEW` for each difference, and the number
of runs that differ. Exits with 1 if a run differs or fails, or if there was none.
"""
import concurrent.futures
import csv
import decimal
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import typing

from script_tools import ROOT, make_parser, numbers, without_mpirun

sys.path.insert(0, str(ROOT / "tests"))
from vtu_reader import VtuFile  # noqa: E402  pylint: disable=wrong-import-position

# keys of summary.json and study.json that differ from run to run ...
RUN_DEPENDENT = {
    "wall_time", "loop_time", "contact_time", "force_time", "seconds",
    "phase_1_seconds", "million_element_steps_per_second", "peak_memory_bytes",
    # ... or from build to build
    "version", "commit", "compiler", "deal_ii_version", "build_type"}

REAL = r"[-+]?[\d.]+(?:e[-+]?\d+)?"
DURATION = rf"{REAL} (?:s|min|h)"
# what differs from run to run on the screen, and what is written in its place
MASKS = [(re.compile(pattern, re.MULTILINE), replacement)
         for pattern, replacement in (
             # lines of progress, and of checkpoints by the clock
             (r"^Stage \d+ of \d+.*\n", ""),
             (r"^Factor  block \d+ of \d+.*\n", ""),
             (r"^Saved   .*\n", ""),
             (r"^        static solves before the first step: .*\n", ""),
             (rf"^(Output  .*\(){REAL} s\)$", r"\1TIME)"),
             (rf"^(Static  .* in ){REAL} s", r"\1TIME"),
             (rf"^((?:Factor|Support|        ).*trials?, ){REAL} s", r"\1TIME"),
             (rf"^(Study   .*; ){REAL} s(?:, {REAL} a minute)?", r"\1TIME"),
             (rf"^(Estimate .*; ){REAL} ms (each here on \d+ ranks?: ).*",
              r"\1TIME \2TIME"),
             (rf"^(        \d+ safety factors?: ){DURATION}(?: to {DURATION})? "
              "of trials", r"\1TIME of trials"),
             (rf"^(        memory at most about ){REAL} MB", r"\1MEMORY"))]

NOT_COMPARED = {".h5"}
# files whose bytes may differ, by durations or compression, where values do not
VALUES = {".json", ".vtu", ".pvtu"}
NUMBER = re.compile(r"([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)")
MOST_LINES, MOST_LETTERS = 5, 100


class Job(typing.NamedTuple):
    """A scene to run."""
    name: str
    scene: str
    ranks: int
    overrides: list


class Entry(typing.NamedTuple):
    """A value of a file, and the column, array or key that it belongs to."""
    group: str
    value: object


MISSING = Entry("", "missing")


# -- what is run

def test_scenes(build):
    """(name, scene, overrides) of each test scenes/NAME.RANKS in a build folder."""
    tests = json.loads(subprocess.run(["ctest", "--show-only=json-v1"], cwd=build,
                                      capture_output=True, check=True).stdout)
    scenes = {}
    for test in tests["tests"]:
        folder, _, name = test["name"].partition("/")
        if folder == "scenes" and "command" in test:
            # Python, compare.py, keyblock, scene, references, ranks, folder, ...
            command = test["command"]
            scenes[name.rpartition(".")[0]] = (command[3], command[7:])
    return [(name, *rest) for name, rest in scenes.items()]


def choose_jobs(options):
    """The runs that the options ask for."""
    if options.scenes:
        scenes = [(pathlib.Path(file).stem, str(pathlib.Path(file).resolve()), [])
                  for file in options.scenes]
    else:
        scenes = test_scenes(options.build)
    return [Job(f"{name}.{ranks}", scene, ranks, overrides)
            for name, scene, overrides in scenes for ranks in options.ranks
            if options.only in f"{name}.{ranks}"]


def run(program, job, folder):
    """Run a scene in a folder; exit code, and the two screens with times masked."""
    folder.mkdir()
    command = [program, job.scene, "--output", "output", *job.overrides]
    if job.ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                   "--bind-to", "none", "-n", str(job.ranks), *command]
    done = subprocess.run(command, capture_output=True, cwd=folder, check=False)

    def mask(raw):
        text = raw.decode("utf-8", "replace").replace("\r\n", "\n")
        text = text.replace(str(folder), "FOLDER").replace(program, "KEYBLOCK")
        for pattern, replacement in MASKS:
            text = pattern.sub(replacement, text)
        return text

    return (done.returncode,
            {"stdout": mask(done.stdout),
             "stderr": without_mpirun(mask(done.stderr))})


# -- what is compared: the entries of a file by their place

def entries_of_text(text):
    """Lines."""
    return {f"line {n}": Entry(f"line {n}", line)
            for n, line in enumerate(text.split("\n"), 1)}


def entries_of_csv(path):
    """Cells; a column is a group."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    titles = rows[0] if rows else []
    entries = {f"title {c}": Entry("titles", title)
               for c, title in enumerate(titles, 1)}
    for r, row in enumerate(rows[1:], 1):
        for c, cell in enumerate(row):
            title = titles[c] if c < len(titles) else "no title"
            entries[f"row {r}, column {c + 1} ({title})"] = Entry(f"{c}", cell)
    return entries


def entries_of_json(value, place=""):
    """Values by their keys; those of all entries of a list are one group."""
    if not isinstance(value, (dict, list)) or not value:
        group = re.sub(r"/\d+(?=/|$)", "/*", place)
        return {place.lstrip("/"): Entry(group, value)}
    entries = {}
    pairs = value.items() if isinstance(value, dict) else enumerate(value)
    for key, part in pairs:
        if key not in RUN_DEPENDENT:
            entries.update(entries_of_json(part, f"{place}/{key}"))
    return entries


def entries_of_vtu(path):
    """Numbers and texts of arrays, and the elements without their numbers."""
    file = VtuFile(path)
    head = re.sub(rb' offset="\d+"', b"", file.head)
    head = re.sub(rb">[^<>]+</DataArray>", b"></DataArray>", head)
    entries = entries_of_text(head.decode("utf-8"))
    for name, values in file.values().items():
        for i, value in enumerate(values):
            entries[f"{name}[{i}]"] = Entry(name, value)
    return entries


def entries_of(path):
    """All that is compared of a file."""
    if path.suffix == ".csv":
        return entries_of_csv(path)
    if path.suffix == ".json":
        return entries_of_json(json.loads(path.read_text(encoding="utf-8")))
    if path.suffix in (".vtu", ".pvtu"):
        return entries_of_vtu(path)
    return entries_of_text(path.read_text(encoding="utf-8", errors="replace"))


# -- how it is compared

def number_of(value):
    """The value as a number if it is one, else None."""
    try:
        return None if isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        return None


def agree(old, new, allowed):
    """Whether two numbers do."""
    if not (math.isfinite(old) and math.isfinite(new)):
        return repr(old) == repr(new)
    return abs(old - new) <= allowed


def sentences_agree(old, new, tolerance):
    """Whether two texts are equal but for numbers within the tolerance."""
    old, new = NUMBER.split(old), NUMBER.split(new)
    if old[::2] != new[::2]:
        return False
    old, new = old[1::2], new[1::2]
    allowed = tolerance * max((abs(float(text)) for text in old
                               if not text.strip("+-").isdigit()), default=0.)
    for a, b in zip(old, new):
        # value of the last digit
        digit = 10. ** min(decimal.Decimal(text).as_tuple().exponent
                           for text in (a, b))
        if a != b and (f"{a}{b}".strip("+-").isdigit() or not agree(
                float(a), float(b), max(allowed, 1.01 * digit))):
            return False
    return True


def scales_of(entries):
    """The largest finite number of each group."""
    scales = {}
    for group, value in entries.values():
        number = number_of(value)
        if number is not None and math.isfinite(number):
            scales[group] = max(scales.get(group, 0.), abs(number))
    return scales


def differences_of(old, new, tolerance):
    """(place, old value, new value) of entries that differ, in order."""
    scales = scales_of(old) if tolerance > 0. else {}
    for place in {**old, **new}:
        group, a = old.get(place, MISSING)
        b = new.get(place, MISSING).value
        if repr(a) == repr(b):
            continue
        if tolerance > 0. and place in old and place in new:
            x, y = number_of(a), number_of(b)
            if x is not None and y is not None:
                if agree(x, y, tolerance * scales.get(group, 0.)):
                    continue
            elif (isinstance(a, str) and isinstance(b, str)
                  and sentences_agree(a, b, tolerance)):
                continue
        yield place, a, b


def shortened(value, begin=0):
    """A value on one line that is not too long, from a letter on."""
    text = " ".join(str(value).split()) or "nothing"
    text = "... " * (begin > 0) + text[begin:]
    return text if len(text) <= MOST_LETTERS else text[:MOST_LETTERS] + " ..."


def describe(old, new):
    """Both values, long ones from shortly before what differs."""
    old, new = (" ".join(str(value).split()) for value in (old, new))
    begin = 0
    if max(len(old), len(new)) > MOST_LETTERS:
        begin = max(0, len(os.path.commonprefix([old, new])) - MOST_LETTERS // 2)
    return f"{shortened(old, begin)} -> {shortened(new, begin)}"


def report(file, differences):
    """Lines about the differences of a file."""
    differences = list(differences)
    lines = [f"{file}: {place}: {describe(old, new)}"
             for place, old, new in differences[:MOST_LINES]]
    if len(differences) > MOST_LINES:
        lines.append(f"{file}: and {len(differences) - MOST_LINES} more")
    return lines


def files_in(folder):
    """Files to compare in a folder, by their names in it."""
    return {str(path.relative_to(folder)): path
            for path in folder.rglob("*")
            if path.is_file() and path.suffix not in NOT_COMPARED}


def compare_files(old, new, tolerance):
    """Lines about the differences of two folders."""
    olds, news = files_in(old), files_in(new)
    lines = []
    for name in sorted(olds.keys() | news.keys()):
        if name not in news:
            lines.append(f"{name}: file: there -> missing")
        elif name not in olds:
            lines.append(f"{name}: file: missing -> there")
        elif olds[name].read_bytes() != news[name].read_bytes():
            try:
                found = report(name, differences_of(
                    entries_of(olds[name]), entries_of(news[name]), tolerance))
            except Exception as error:  # pylint: disable=broad-except
                found = [f"{name}: file: cannot be read: {shortened(error)}"]
            # such as quotes around cells
            if not found and tolerance == 0. and olds[name].suffix not in VALUES:
                found = [f"{name}: file: other bytes, but equal values"]
            lines += found
    return lines


def compare_runs(job, programs, tolerance):
    """Lines about the differences of the runs of a scene by two programs."""
    with tempfile.TemporaryDirectory() as folder:
        folders = [pathlib.Path(folder).resolve() / word for word in ("old", "new")]
        (old_code, old), (new_code, new) = (
            run(program, job, place) for program, place in zip(programs, folders))
        lines = []
        if old_code != new_code:
            lines.append(f"exit code: program: {old_code} -> {new_code}")
        elif old_code != 0:
            lines.append(f"exit code: program: both runs fail with {old_code}: "
                         f"{shortened(new['stderr'])}")
        for screen in old:
            lines += report(screen, differences_of(entries_of_text(old[screen]),
                                                   entries_of_text(new[screen]),
                                                   tolerance))
        return lines + compare_files(*(place / "output" for place in folders),
                                     tolerance)


def parse_options():
    """Options of the command line."""
    parser = make_parser(__doc__)
    parser.add_argument("old")
    parser.add_argument("--build", default=str(ROOT / "build"))
    parser.add_argument("--ranks", type=numbers, default=[1, 2])
    parser.add_argument("--only", default="", help="part of SCENE.RANKS")
    parser.add_argument("--tolerance", type=float, default=0.)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(),
                        help="processes of the programs at a time")
    parser.add_argument("--scenes", nargs="+", default=[])
    options = parser.parse_args()
    for program in (options.old, options.keyblock):
        if not os.access(program, os.X_OK):
            parser.error(f"{program} is not a program that can be run.")
    return options


def main():
    """Exit code."""
    options = parse_options()
    programs = [str(pathlib.Path(program).resolve())
                for program in (options.old, options.keyblock)]
    os.environ.setdefault("OMPI_MCA_pml", "ob1")  # no search for networks
    jobs = choose_jobs(options)
    n_different = 0
    for ranks in options.ranks:
        alike = [job for job in jobs if job.ranks == ranks]
        with concurrent.futures.ThreadPoolExecutor(
                max(1, options.jobs // ranks)) as pool:
            for job, lines in zip(alike, pool.map(
                    lambda job: compare_runs(job, programs, options.tolerance),
                    alike)):
                n_different += bool(lines)
                for line in lines:
                    print(f"{job.name}: {line}", flush=True)
    print(f"{len(jobs)} runs, {n_different} differ")
    return 1 if n_different or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())

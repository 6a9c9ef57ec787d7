#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Does what a page of the manual tells to do, and looks whether that comes out.

usage: tutorial.py PAGE.md KEYBLOCK FOLDER

In the page a fenced block whose first line ends with

    run         has commands for sh, which must end with 0. They run in FOLDER,
                which has contrib and prm of the repository and `keyblock`;
    output      has lines of what the commands before printed, in order. `...`
                stands for lines, or for part of a line, that are left out;
    file=NAME   is that file: of the repository, which must be the same, or to be
                written by the reader, and by this test.

A number in a block `output` must be what came out, rounded to as many digits as
the page gives; so must a number with a decimal point that stands in backticks in
the text, among all that came out before. Pages have the meshes of one release of
Gmsh: with another one numbers may differ by 5 %. Exits with 1 and one line per
fault.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
NUMBER = r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
# not the digits of a name, as J1 or east.2
LONE = re.compile(rf"(?<![\w.]){NUMBER}(?![\w]|\.\d)")
FENCE = re.compile(r"^```(.*)\n((?:.*\n)*?)```[ ]*$|`([^`\n]+)`", re.MULTILINE)


# release of Gmsh, as its library is called, whose meshes the pages have
GMSH = "libgmsh.so.4.8"


class Slack:
    """What numbers may be off, relative to the quoted ones."""
    of_numbers = 0.

    @classmethod
    def choose(cls, keyblock):
        """By the libraries of a program."""
        done = subprocess.run(["ldd", str(keyblock)], capture_output=True,
                              text=True, check=False)
        found = re.search(r"libgmsh\.so[.\d]*", done.stdout)
        if found and found[0] != GMSH:
            cls.of_numbers = 0.05
            print(f"{found[0]} makes other meshes than {GMSH}: numbers may "
                  f"differ by {100. * cls.of_numbers:g} %")


def is_rounded(quoted, value):
    """Whether a value, rounded to the digits of what is quoted, is that."""
    mantissa, _, exponent = quoted.lower().partition("e")
    digits = len(mantissa.partition(".")[2])
    unit = 10. ** (int(exponent or 0) - digits)
    return abs(float(quoted) - float(value)) <= (
        0.5000001 * unit + Slack.of_numbers * abs(float(quoted)))


def pattern_of(line):
    """A pattern for a line of output; its groups are the numbers in it."""
    pieces, at, numbers = [], 0, []

    def text(piece):
        return ".*?".join(r"\s+".join(map(re.escape, re.split(r"\s+", part)))
                          for part in piece.split("..."))
    for found in LONE.finditer(line):
        pieces += [text(line[at:found.start()]), f"({NUMBER})"]
        numbers.append(found[0])
        at = found.end()
    return re.compile("".join([*pieces, text(line[at:])])), numbers


def missing_lines(quoted, printed):
    """What is wrong with a block of output; nothing if all of it came out."""
    lines, at = [line.strip() for line in printed.splitlines()], 0
    for line in filter(None, map(str.strip, quoted.splitlines())):
        if line == "...":
            continue
        pattern, numbers = pattern_of(line)
        nearest = None
        for i, candidate in enumerate(lines[at:], at):
            match = pattern.fullmatch(candidate)
            if match and all(map(is_rounded, numbers, match.groups())):
                at = i + 1
                break
            nearest = nearest or (match and candidate)
        else:
            yield (f"the page has '{line}', " +
                   (f"what came out is '{nearest}'" if nearest else "which did not come out"))


def run(commands, folder, keyblock_folder):
    """Run commands; what they print, and a fault if they fail."""
    environment = {**os.environ, "PATH": f"{keyblock_folder}:{os.environ['PATH']}"}
    done = subprocess.run(["sh", "-e", "-c", commands], cwd=folder, env=environment,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    fault = (f"'{commands.strip()}' ended with {done.returncode}: {done.stdout[-500:]}"
             if done.returncode else None)
    return done.stdout, fault


def faults_of(page, folder, programs):
    """All that is wrong with a page."""
    n_runs, last, everything = 0, "", ""
    for info, body, code in FENCE.findall(page):
        kind = info.split()[-1] if info.split() else ""
        if code:
            if re.fullmatch(r"-?\d+\.\d+", code) and not any(
                    is_rounded(code, value) for value in LONE.findall(everything)):
                yield f"the page says {code} in its text, which did not come out before"
        elif kind == "run":
            n_runs += 1
            last, fault = run(body, folder, programs)
            everything += last
            if fault:
                yield fault
        elif kind == "output":
            yield from missing_lines(body, last)
        elif kind.startswith("file="):
            name = kind[len("file="):]
            if (ROOT / name).exists():
                if (ROOT / name).read_text(encoding="utf-8") != body:
                    yield f"{name} is not what the page shows"
            else:
                (folder / name).write_text(body, encoding="utf-8")
    if n_runs == 0:
        yield "the page has no commands to run"


def main():
    """Exit with 1 and the faults, if there are any."""
    page, keyblock, folder = map(pathlib.Path, sys.argv[1:])
    keyblock, start = keyblock.resolve(), time.time()
    Slack.choose(keyblock)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    folder = folder.resolve()
    for name in ("contrib", "prm"):
        (folder / name).symlink_to(ROOT / name)
    programs = folder / "programs"
    programs.mkdir()
    (programs / "keyblock").symlink_to(keyblock)
    faults = list(faults_of(page.read_text(encoding="utf-8"), folder, programs))
    print("\n".join(faults) or "all that the page says came out",
          f"({time.time() - start:.1f} s)")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

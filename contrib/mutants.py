#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Changes the physics of the source by hand, and checks that the tests notice it.

usage: contrib/mutants.py --list
       contrib/mutants.py apply|revert [NAME...]
       contrib/mutants.py run [NAME...] [--build FOLDER] [--label quick] [--tests REGEX]

A mutant is one wrong sign, index or factor. `run` applies each mutant, builds, runs
the tests of a label until one fails, and reverts the mutant, also if interrupted. It
prints the failed test or SURVIVED, and finally builds the right sources. All tests
must pass before. Exits with 1 if a mutant is not killed.
"""
import argparse
import os
import re
import signal
import subprocess
import sys

from script_tools import ROOT

JOBS = str(os.cpu_count())
# what is wrong, the file, the right text, which stands there once, and the wrong one
MUTANTS = {
    "friction_swapped": (
        "static and kinetic friction are swapped", "source/law/coulomb_joint.cc",
        "static_tangent  = static_tangent;\n        strength.kinetic_tangent = kinetic",
        "static_tangent  = kinetic_tangent;\n        strength.kinetic_tangent = static"),
    "dilation_sign": (
        "pressure falls where a joint dilates", "include/keyblock/law/friction.h",
        "r_n = (r_n + strength.dilation *", "r_n = (r_n - strength.dilation *"),
    "tension_sign": (
        "joints open at low pressure, not tension", "include/keyblock/law/friction.h",
        "if (r_n < -strength.tension)", "if (r_n < strength.tension)"),
    "masses_swapped": (
        "the lighter one of two nodes leads", "source/contact/pair_contact.cc",
        "(wp * v[pm + d] + wm * v[pp + d])", "(wm * v[pm + d] + wp * v[pp + d])"),
    "bearing_area": (
        "surface contacts have half of their area", "source/contact/area_shares.cc",
        "point.area += part.area *", "point.area += 0.5 * part.area *"),
    "pair_area": (
        "pairs of nodes have half of their area", "source/blocks/interface.cc",
        "pair.area += in_plane *", "pair.area += 0.5 * in_plane *"),
    "water_doubled": (
        "water pushes twice as much on a block", "source/safety/block_faces.cc",
        "into.water_force += water.force", "into.water_force += 2. * water.force"),
    "seismic_sign": (
        "the seismic load has the wrong sign", "source/safety/block_loads.cc",
        "loads.seismic = mass *", "loads.seismic = -mass *"),
    "wedge_face": (
        "a wedge has one force on both faces", "source/safety/limit_equilibrium.cc",
        "(rb - cosine * ra) / determinant};", "(ra - cosine * rb) / determinant};"),
    "strength_inverted": (
        "trials multiply strength by the factor", "source/safety/strength_trial.cc",
        "reduction.share  = 1. / factor;", "reduction.share  = factor;"),
    "rest_inverted": (
        "blocks out of balance are at rest", "source/safety/strength_trial.cc",
        "if (unbalanced < rest_unbalanced &&", "if (unbalanced > rest_unbalanced &&")}


def is_applied(name):
    """Whether a mutant is in its file."""
    _, file, *texts = MUTANTS[name]
    counts = [(ROOT / file).read_text(encoding="utf-8").count(t) for t in texts]
    if sorted(counts) != [0, 1]:
        sys.exit(f"{name}: {file} must have one of these once, and not the other:\n"
                 + "\n".join(texts))
    return counts[1] == 1


def switch(name, to_mutant):
    """Apply or revert a mutant, unless that is done."""
    _, file, right, wrong = MUTANTS[name]
    if is_applied(name) != to_mutant:
        text = (ROOT / file).read_text(encoding="utf-8")
        text = text.replace(*((right, wrong) if to_mutant else (wrong, right)))
        (ROOT / file).write_text(text, encoding="utf-8")


def build(options):
    """Whether the sources compile."""
    return subprocess.call(["cmake", "--build", options.build, "--parallel", JOBS],
                           stdout=subprocess.DEVNULL) == 0


def judge(options):
    """What becomes of the mutant that is applied."""
    if not build(options):
        return "DOES NOT COMPILE"
    command = ["ctest", "--stop-on-failure", "--no-tests=error", "-j", JOBS]
    for option, value in (("-L", options.label), ("-R", options.tests)):
        command += [option, value] if value else []
    tests = subprocess.run(command, capture_output=True, text=True, check=False,
                           cwd=options.build)
    failed = re.findall(r"^\s+\d+ - (\S+) \(", tests.stdout.partition(
        "The following tests FAILED:")[2], re.MULTILINE)
    if tests.returncode != 0 and not failed:
        sys.exit(f"ctest fails:\n{tests.stdout}{tests.stderr}")
    return "killed by " + ", ".join(failed) if failed else "SURVIVED"


def run(names, options):
    """Exit code of `run`."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # reverts, too
    if applied := list(filter(is_applied, MUTANTS)):
        sys.exit(f"Applied: {', '.join(applied)}. Call contrib/mutants.py revert.")
    n_alive = 0
    try:
        for name in names:
            try:
                switch(name, True)
                verdict = judge(options)
            finally:
                switch(name, False)
            n_alive += not verdict.startswith("killed")
            print(f"{name} ({MUTANTS[name][0]}): {verdict}", flush=True)
    finally:
        build(options)
    print(f"{len(names)} mutants, {n_alive} not killed")
    return 1 if n_alive else 0


def main():
    """Exit code."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("command", nargs="?", choices=["apply", "revert", "run"])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--build", default=str(ROOT / "build"))
    parser.add_argument("--label", default="quick", help="of the tests; '': all")
    parser.add_argument("--tests", help="regular expression of their names")
    options = parser.parse_args()
    if unknown := set(options.names) - MUTANTS.keys():
        parser.error(f"unknown mutants: {', '.join(sorted(unknown))}")
    if options.list:
        for name, (what, file, *_) in MUTANTS.items():
            print(f"{name}: {what} ({file})")
    elif options.command == "run":
        return run(options.names or list(MUTANTS), options)
    for name in options.names or MUTANTS if options.command else []:
        switch(name, options.command == "apply")
    return 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs scenes and changes of them that must not change factors, and compares.

usage: contrib/metamorphic.py [SCENE...] [--relations renamed,place,...]
         [--method statics|reduction|both] [--jobs N] [--timeout S]
         [--networks traces,lines [--numbers 20] [--seeds 1-100]]
         [--list] [--keyblock P] [--keep FOLDER] [-- arguments for keyblock]

Relations: groups (irrelevant, place, scale, order, numerics; quick: some of all) or
single ones, which --list prints. --method statics: limit equilibrium alone, no step is made;
reduction: the scene as it is; both: one after the other. --timeout: longest
time of a run [s]. --keep: the folder that scenes and results are kept in.
--networks takes random networks of joints (contrib/networks.py) besides the
scenes, with limit equilibrium.

Limit equilibrium must agree to 1e-6, or to 1e-3 for blocks that two different
meshes bound, not planes. Variants whose mesh is another one, and has other blocks
since joints are cut into it, are counted apart, as are networks with another mesh,
and factors of another mesh that limit equilibrium does not give. Of strength reduction
brackets must overlap and outcomes be the same. One line is printed for each
difference, for each relation that a scene cannot express, and for each run that
fails. A difference is marked as unsafe if the variant has a larger factor, or lacks
a block or a factor. Exits with
1 if there is a violation, a failure or a timeout.
"""
import concurrent.futures
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
from collections import Counter

import networks
from factor_differences import Comparison, is_unsafe
from scene_additions import IRRELEVANT
from scene_domain import CannotExpress
from scene_order import ORDER
from scene_relations import (NUMERICS, OF_STEPS, PLACE, SCALE, Scene,
                             plain_tree)
from scene_tree import SceneError, read_scene, scene_text
from scene_units import read_entries
from script_tools import make_parser, numbers, split_arguments, without_mpirun

GROUPS = {"irrelevant": IRRELEVANT, "place": PLACE, "scale": SCALE,
          "order": ORDER, "numerics": NUMERICS}
RELATIONS = {name: relation for group in GROUPS.values()
             for name, relation in group.items()}
# at least one relation of each kind
GROUPS["quick"] = (
    "bolt-in-rock", "bolt-later", "weakening-joint-far", "joints-far-50",
    "block-far", "mirrored", "turned", "turned-obliquely", "shifted-4e6",
    "lengths-1000", "renamed", "reordered", "renumbered", "cells-0.96")
STATICS = ["--set", "Safety factor/Method=limit equilibrium",
           "--set", "Safety factor/Wanted by=limit equilibrium",
           "--set", "Check/Closed form=none"]
QUIET = ["--set", "Output/Write VTU=false"]


class RunFailed(Exception):
    """A run that did not end with 0; the message is its last sentence."""


class TimedOut(Exception):
    """A run that took too long."""


def start(options, command, log):
    """(exit code, standard error) of a command; what it prints goes to `log`."""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          stdin=subprocess.DEVNULL, text=True,
                          start_new_session=True) as process:
        try:
            said, errors = process.communicate(timeout=options.timeout)
        except subprocess.TimeoutExpired as late:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            raise TimedOut() from late
    log.write_text(said + errors, "utf-8")
    return process.returncode, errors


def run(options, scene, output, ranks, arguments):
    """Run a scene; returns its summary."""
    command = [options.keyblock, "--output", str(output), str(scene)] + arguments
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n",
                   str(ranks)] + command
    log = output.parent / f"{output.name}.log"
    code, errors = start(options, command, log)
    if code != 0 and "MPI_INIT failed" in errors:
        # Open MPI, where others start at the same time
        code, errors = start(options, command, log)
    if code != 0:
        lines = without_mpirun(errors).strip().splitlines() or ["no message"]
        raise RunFailed(f"exit {code}: {lines[-1]}")
    return json.loads((output / "summary.json").read_text("utf-8"))


def with_absolute_files(tree, folder):
    """The tree of a used.prm with the files that it names found from
    anywhere."""
    for path, value in list(tree.items()):
        if path.split("/")[-1] in ("File", "History file", "Measured points"):
            if value and (folder / value).exists():
                tree.set(path, str((folder / value).resolve()))
    if tree.get("Joints/Resolved") == "true":
        tree.set("Joints/File", "")
    return tree


class Report:
    """Prints and counts what is found."""

    def __init__(self):
        self.counts = Counter()

    def count(self, kind, line):
        """Count something, and print its line if it has one."""
        self.counts[kind] += 1
        if line:
            print(line, flush=True)

    def summary(self):
        """The last line."""
        c = self.counts
        text = (f"{c['scene']} scenes, {c['variant']} variants, "
                f"{c['violation']} violations, {c['not expressible']} not "
                f"expressible, {c['timeout']} timeouts")
        if c["failure"]:
            text += f", {c['failure']} failures"
        if c["other factor"]:
            text += (f"; besides, {c['other factor']} other factors of another mesh, "
                     "which limit equilibrium does not give")
        if c["other mesh"]:
            text += (f"; besides, {c['other mesh']} variants with other blocks of "
                     "another mesh")
        return text

    def is_good(self):
        """Whether nothing was violated, failed or took too long."""
        return not (self.counts["violation"] or self.counts["failure"]
                    or self.counts["timeout"])


class Examination:
    """A scene, by one method, and its variants.

    `file`: the scene file; `folder`: where its variants and results go;
    `is_network`: whether variants with another mesh are counted apart."""

    def __init__(self, options, report, file, folder, method, is_network):
        self.options, self.report = options, report
        self.folder, self.method, self.is_network = folder, method, is_network
        self.label = f"{file.stem} ({method})"
        folder.mkdir(parents=True, exist_ok=True)
        arguments = (options.rest + QUIET
                     + (STATICS if method == "statics" else []))
        self.summary = run(options, file, folder / "scene", 1, arguments)
        used = with_absolute_files(read_scene(folder / "scene" / "used.prm"),
                                   folder / "scene")
        self.scene = Scene(plain_tree(used), self.summary, options.entries)

    def has_factors(self):
        """Whether the scene asks for factors by this method; in networks blocks
        are compared anyway."""
        if self.method == "statics":
            return any("limit_equilibrium" in b for b in self.summary["blocks"])
        return any("safety_factor" in b for b in self.summary["blocks"])

    def examine(self, name):
        """Run one variant: (kind, line) of what is found."""
        label = f"{self.label} {name}"
        try:
            variant = RELATIONS[name](self.scene)
        except CannotExpress as reason:
            return [("not expressible", str(reason))]
        for file, text in variant.files.items():
            (self.folder / file).write_text(text, "utf-8")
        scene = self.folder / f"{name}.prm"
        scene.write_text(scene_text(variant.tree), "utf-8")
        try:
            found = run(self.options, scene, self.folder / name, variant.ranks, [])
        except TimedOut:
            return [("variant", ""), ("timeout", f"{label}: more than "
                                      f"{self.options.timeout:g} s")]
        except RunFailed as failure:
            if variant.refusal and variant.refusal[0] in str(failure):
                return [("not expressible", variant.refusal[1])]
            return [("variant", ""), ("failure", f"{label}: fails, {failure}")]
        comparison = Comparison(self.summary, found, variant, self.scene.stages())
        if self.scene.has_numbered_blocks and comparison.changes_numbers():
            return [("not expressible", "it names blocks by numbers, which are "
                     "others in the variant")]
        differences = comparison.differences()
        if differences and (comparison.has_cut_blocks() or (
                self.is_network and not variant.keeps_mesh)):
            return [("variant", ""), ("other mesh", f"{label}: another mesh has "
                                      f"other blocks, {len(differences)} "
                                      "differences")]
        lines = [f"{label}: {difference.text()}"
                 + (" (unsafe)" if is_unsafe(difference) else "")
                 for difference in differences]
        kinds = ["other factor" if difference.is_of_mesh else "violation"
                 for difference in differences]
        return [("variant", "")] + list(zip(kinds, lines))

    def examine_all(self, names):
        """Run all variants and report; relations that the scene cannot express
        come last, by their reason."""
        reasons = {}
        if self.method == "statics":
            names = [name for name in names if name not in OF_STEPS]
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            for name, results in zip(names, pool.map(self.examine, names)):
                for kind, line in results:
                    self.report.count(kind, line if kind != "not expressible"
                                      else "")
                    if kind == "not expressible":
                        reasons.setdefault(line, []).append(name)
        for reason, relations in reasons.items():
            print(f"{self.label} cannot express {', '.join(relations)}: {reason}",
                  flush=True)


def relations_of(text):
    """Names of relations for names of relations and groups."""
    names = []
    for word in text.split(","):
        if word not in GROUPS and word not in RELATIONS:
            sys.exit(f"There is no relation '{word}'; --list prints them.")
        names += GROUPS.get(word, [word])
    return list(dict.fromkeys(names))


def network_files(options, folder):
    """Scenes of random networks, with factors by limit equilibrium."""
    for kind in options.networks.split(","):
        for number in options.numbers or networks.NUMBERS[kind][:1]:
            for seed in options.seeds:
                folder.mkdir(parents=True, exist_ok=True)
                file = folder / f"{kind}_{number}_{seed}.prm"
                file.write_text(networks.scene(kind, number, seed, folder) +
                                "subsection Safety factor\n  set Blocks = exposed\n"
                                "end\n", "utf-8")
                yield file


def parse():
    """The options."""
    arguments, rest = split_arguments()
    parser = make_parser(__doc__)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--relations", default=",".join(RELATIONS),
                        type=relations_of)
    parser.add_argument("--method", default="statics",
                        choices=["statics", "reduction", "both"])
    parser.add_argument("--networks", default="")
    parser.add_argument("--numbers", type=numbers)
    parser.add_argument("--seeds", "--seed", default="1-5", type=numbers)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--timeout", type=float, default=300.)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args(arguments)
    options.rest = rest
    options.keyblock = os.path.abspath(options.keyblock)
    return options


def print_relations():
    """The relations by their groups, with what they change."""
    for group, relations in GROUPS.items():
        if group == "quick":
            print(f"quick: {', '.join(relations)}")
            continue
        print(f"{group}:")
        for name in relations:
            words = " ".join(RELATIONS[name].__doc__.split())
            print(f"  {name}: {words}")


def examine_scene(options, report, file, folder, is_network):
    """Examine a scene by each method."""
    methods = (["statics"] if is_network else ["statics", "reduction"]
               if options.method == "both" else [options.method])
    report.counts["scene"] += 1
    for method in methods:
        label = f"{file.stem} ({method})"
        try:
            one = Examination(options, report, file, folder / file.stem / method,
                              method, is_network)
        except TimedOut:
            report.count("timeout", f"{label}: more than {options.timeout:g} s")
            continue
        except (RunFailed, SceneError) as failure:
            report.count("failure", f"{label}: fails, {failure}")
            continue
        if is_network or one.has_factors():
            one.examine_all(options.relations)
        else:
            report.count("not expressible", f"{label} cannot express any "
                         "relation: no block has a factor")


def main():
    options = parse()
    if options.list:
        print_relations()
        return 0
    if not options.scenes and not options.networks:
        sys.exit("Name scenes, or --networks.")
    listing = subprocess.run([options.keyblock, "--print-parameters"], check=True,
                             capture_output=True, text=True).stdout
    options.entries = read_entries(listing)
    report = Report()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.keep or pathlib.Path(temporary)).resolve()
        for file in options.scenes:
            examine_scene(options, report, file, folder, False)
        if options.networks:
            for file in network_files(options, folder / "networks"):
                examine_scene(options, report, file, folder, True)
    print(report.summary())
    return 0 if report.is_good() else 1


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measure speed against error and write doc/performance.md.

usage: benchmark.py KEYBLOCK [SECTION...]

Each section runs scenes and writes doc/benchmark/SECTION.csv; the report is made
of all files that are there. Sections: rates, growth, ranks, accuracy,
published, factors, skips, report.
"""
import concurrent.futures
import csv
import datetime
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import benchmark_report

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLES = ROOT / "doc" / "benchmark"
N_REPEATS = 3


class Run:
    """A run of prm/SCENE.prm with entries set otherwise."""

    def __init__(self, keyblock, scene, *settings, ranks=1, core=1):
        with tempfile.TemporaryDirectory() as folder:
            command = [keyblock, str(ROOT / "prm" / f"{scene}.prm"),
                       "--output", folder]
            for setting in settings:
                command += ["--set", setting]
            if ranks > 1:
                command = ["mpirun", "--allow-run-as-root", "--oversubscribe",
                           "-n", str(ranks)] + command
            elif os.cpu_count() > 1:
                command = ["taskset", "-c", str(core)] + command
            done = subprocess.run(command, capture_output=True, text=True,
                                  check=False)
            self.failed = done.returncode != 0
            self.summary = {}
            if not self.failed:
                with open(f"{folder}/summary.json", encoding="utf-8") as file:
                    self.summary = json.load(file)

    @property
    def cells(self):
        return self.summary["scene"]["cells"]

    @property
    def run(self):
        return self.summary["run"]

    def rate(self, seconds="loop_time"):
        """Million cell-steps per second."""
        return 1e-6 * self.cells * self.run["steps"] / self.run[seconds]

    def factor(self, block=0):
        """The last safety factor of a block that has one."""
        found = [b["safety_factor"] for b in self.summary["blocks"]
                 if b.get("safety_factor")]
        return found[block][-1]

    def trial_seconds(self):
        """Time that the trials of the last factor took, or nan."""
        if self.failed:
            return float("nan")
        return sum(t["seconds"] for t in self.factor()["trials"])


def check_of(name):
    """Reads a number of the scene's own checks."""
    return lambda run: run.summary["checks"][name]


def bracket_error(run, exact):
    """Relative distance of the farther end of the last bracket: its middle may
    be the first guess, which limit equilibrium gives exactly."""
    factor = run.factor()
    return max(abs(factor[end] / exact - 1.) for end in ("lower", "upper"))


def write_table(name, columns, rows):
    """Write doc/benchmark/NAME.csv and show its last line."""
    TABLES.mkdir(exist_ok=True)
    with open(TABLES / f"{name}.csv", "w", encoding="utf-8",
              newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in rows:
            writer.writerow([f"{x:.5g}" if isinstance(x, float) else x
                             for x in row])
    print(name, *rows[-1], flush=True)


def note_machine(section):
    """Keep on which processor, and when, a section was last measured."""
    processor = "unknown"
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                processor = line.partition(":")[2].strip()
    path = TABLES / "machines.csv"
    known = {}
    if path.exists():
        with open(path, encoding="utf-8", newline="") as file:
            known = {row[0]: row for row in list(csv.reader(file))[1:]}
    known[section] = [section, f"{processor}, {os.cpu_count()} cores",
                      datetime.date.today().isoformat()]
    write_table("machines", ("section", "processor", "day"),
                [known[name] for name in SECTIONS if name in known])


def yardstick(dimension):
    """Rate of the best hand-written loop with full integration, or nan."""
    folder = os.environ.get("YARDSTICK")
    if not folder:
        return float("nan")
    command = ([f"{folder}/q4", "500", "500", "60", "row"] if dimension == 2
               else [f"{folder}/h8", "64", "56", "56", "12", "row"])
    done = subprocess.run(["taskset", "-c", "1"] + command, check=True,
                          capture_output=True, text=True)
    return max(float(rate) for rate in
               re.findall(r"^full .*?([\d.]+) Mel", done.stdout, re.M))


def rates(keyblock):
    """Each kind of cell, with the yardstick between the runs."""
    variants = {
        "full integration": (),
        "mean dilatation": ("Materials/rock/Integration=mean dilatation",),
        "Mohr-Coulomb, elastic so far": ("Materials/rock/Model=mohr_coulomb",
                                         "Materials/rock/Cohesion=1e12"),
        "stiffness damping": ("Stages/run/Damping ratio=0.05",),
        "large displacements": ("Time stepping/Kinematics=large",),
    }
    rows = []
    for dimension in (2, 3):
        scene = f"benchmark/elastic_{dimension}d"
        cases = {name: (scene, settings)
                 for name, settings in variants.items()}
        cases["full integration, Gmsh mesh"] = (
            scene, ("Mesh/Generator=gmsh", f"Mesh/Size={2.5 if dimension == 2 else 2}"))
        if dimension == 2:
            contact = "benchmark/contact_2d"
            cases["10,020 pairs in contact"] = (contact, ())
            cases["the same, tied"] = (contact, ("Contact/Tie all joints=true",))
            cases["the same, no joints"] = (contact, ("Contact/Method=none",))
        measured = {name: [] for name in cases}
        for _ in range(N_REPEATS):
            hand = yardstick(dimension)
            for name, (file, settings) in cases.items():
                run = Run(keyblock, file, *settings)
                measured[name].append((run.rate("force_time"), run.rate(),
                                       hand, run.cells,
                                       run.run["peak_memory_bytes"]
                                       / run.cells))
        for name, values in measured.items():
            force, step, hand, cells, memory = (
                statistics.median(column) for column in zip(*values))
            rows.append((f"{dimension}D", name, cells, force, step, hand,
                         statistics.median(v[0] / v[2] for v in values),
                         statistics.median(v[1] / v[2] for v in values),
                         memory))
    write_table("rates", ("dimension", "variant", "cells", "cell loop [M/s]",
                          "whole step [M/s]", "yardstick [M/s]",
                          "loop / yardstick", "step / yardstick",
                          "peak memory [B/cell]"), rows)


def growth(keyblock):
    """Time and memory per cell from 1e4 to 4e6 cells."""
    rows = []
    for dimension, sizes in ((2, (100, 200, 500, 1000, 2000)),
                             (3, (22, 46, 74, 100, 159))):
        for n in sizes:
            cells = n ** dimension
            steps = max(100, int((1e8 if dimension == 2 else 2e7) / cells))
            runs = [Run(keyblock, f"benchmark/elastic_{dimension}d",
                        "Mesh/Cells=" + ", ".join([str(n)] * dimension),
                        "Domain/Size=" + ", ".join([str(n)] * dimension),
                        f"Stages/run/Maximum steps={steps}",
                        f"Output/History interval={steps}")
                    for _ in range(N_REPEATS if cells < 5e5 else 1)]
            rows.append((f"{dimension}D", cells, steps,
                         statistics.median(1e3 / r.rate() for r in runs),
                         statistics.median(1e3 / r.rate("force_time")
                                           for r in runs),
                         runs[0].run["peak_memory_bytes"] / cells,
                         statistics.median(r.run["wall_time"]
                                           - r.run["loop_time"]
                                           for r in runs)))
            write_table("growth", ("dimension", "cells", "steps",
                                   "step [ns/cell]", "cell loop [ns/cell]",
                                   "peak memory [B/cell]", "set-up [s]"), rows)


def ranks(keyblock):
    """The same scenes on one rank, on two, and twice at once on one each: two
    ranks can hardly do more than two runs that need not wait for each other."""
    rows = []
    for scene in ("elastic_2d", "elastic_3d", "contact_2d"):
        measured = []
        for _ in range(N_REPEATS + 2):
            one, two = (Run(keyblock, f"benchmark/{scene}", ranks=n).rate()
                        for n in (1, 2))
            with concurrent.futures.ThreadPoolExecutor() as pool:
                at_once = pool.map(
                    lambda core, name=scene: Run(
                        keyblock, f"benchmark/{name}", core=core).rate(),
                    (0, 1))
            measured.append((one, two, two / one, sum(at_once) / one))
        rows.append((scene, *(statistics.median(column)
                              for column in zip(*measured))))
    write_table("ranks", ("scene", "one rank [M/s]", "two ranks [M/s]",
                          "ratio", "two runs at once over one"), rows)


def accuracy(keyblock):
    """Run time and error over meshes, steps, elements and contact."""
    rows = []

    def add(case, variant, error_of, scene, *settings):
        run = Run(keyblock, f"verification/{scene}", *settings)
        error = float("nan") if run.failed else abs(error_of(run))
        rows.append((case, variant, 0 if run.failed else run.cells,
                     0 if run.failed else run.run["steps"],
                     float("nan") if run.failed else run.run["loop_time"],
                     error))

    for method in ("exact", "published"):
        for n in (20, 40, 80):
            add("incline, acceleration", f"{method} contact",
                check_of("acceleration_relative_error"), "incline_30",
                f"Mesh/Cells={n}, {max(2, n // 4)}",
                f"Contact/Method={method}")
    for safety in (0.9, 0.45, 0.225):
        add("incline, acceleration", "time step",
            check_of("acceleration_relative_error"), "incline_30",
            f"Time stepping/Safety={safety}")
    for method in ("exact", "published"):
        for n in (80, 160, 320, 640):
            add("bar impact, energy lost", f"{method} contact",
                lambda run: 1. - run.summary["checks"][
                    "final_energy_over_start"],
                "bar_impact", f"Mesh/Cells={n}, 1",
                f"Contact/Method={method}")
    for variant, scene, settings in (
            ("full", "kirsch", ("Materials/rock/Integration=full",)),
            ("mean dilatation", "kirsch",
             ("Materials/rock/Integration=mean dilatation",)),
            ("far field at 10 radii", "kirsch_far_field", ()),
            ("far field at 4 radii", "kirsch_far_field",
             ("Domain/Corner=-4, -4", "Domain/Size=8, 8"))):
        for h in (0.1, 0.05, 0.025):
            add("hole, stress", variant, check_of("stress_error"), scene,
                "Stages/dig/Kind=quasi-static",
                f"Mesh/Size at excavation={h}", f"Mesh/Size={10 * h}",
                *settings)
    for limit in (1., 5e-3, 1e-3, 3e-4):
        add("plastic tunnel, closure", "pace of the ramp",
            check_of("wall_closure_relative_error"), "salencon",
            f"Stages/dig/Ramp unbalance={limit}")
    for n in (5, 10, 20):
        add("footing, collapse load", "mean dilatation",
            check_of("collapse_pressure_relative_error"), "footing",
            "Domain/Size=3, 2", "Domain/Corner=0, -2",
            f"Mesh/Cells={6 * n}, {4 * n}", f"Check/Length={0.5 + 0.25 / n}",
            f"Stages/push/Maximum steps={1000 * n}",
            "Materials/ground/Friction angle=0",
            "Materials/ground/Dilation angle=0")
    for cells in ("9, 14, 5",):
        add("3D wedge, safety factor", "mesh",
            lambda run: bracket_error(run, 0.8770217778), "wedge_3d",
            f"Mesh/Cells={cells}")
    write_table("accuracy", ("case", "variant", "cells", "steps",
                             "time loop [s]", "error"), rows)


def published(keyblock):
    """Factors the published way, and here: time of the trials and error."""
    sweep = ("Safety factor/Method=sweep", "Safety factor/Reach=0",
             "Safety factor/Warm start=false")
    steps = sweep + ("Safety factor/Trial steps=5000",)
    half_percent = ("Safety factor/Bracket=0.005",)
    ways = (("bisection to 0.5 %, coupled contact, moves what reacts",
             half_percent),
            ("the same with uncoupled contact",
             half_percent + ("Contact/Method=published",)),
            ("sweep of 0.01, coupled contact, all cells move", sweep),
            ("the same, 5000 steps for each trial", steps),
            ("published: that with uncoupled contact",
             steps + ("Contact/Method=published",)))
    cases = (("incline", "verification/factor_incline", (), 0.6881246),
             ("powerhouse, block 1 after stage 5", "study/powerhouse",
              ("Safety factor/Stages=stage_5", "Safety factor/Blocks=1",
               "Output/Write VTU=false"), None))
    rows = []
    for case, scene, settings, exact in cases:
        for way, changes in ways:
            if exact is None and changes[0] != half_percent[0]:
                # no need to begin far below what holds
                changes += ("Safety factor/Lowest=0.99",)
            run = Run(keyblock, scene, *settings, *changes)
            has_factor = not run.failed and any(
                b.get("safety_factor") for b in run.summary["blocks"])
            factor = run.factor() if has_factor else {}
            trials = factor.get("trials", [])
            value = factor.get("value") if trials else None
            error = ""
            if value and exact:
                error = float(bracket_error(run, exact))
            rows.append((case, way, len(trials),
                         sum(t["steps"] for t in trials),
                         float(sum(t["seconds"] for t in trials)),
                         "none" if value is None else float(value), error))
            write_table("published", (
                "case", "way", "trials", "steps of trials",
                "seconds of trials", "factor", "error"), rows)


def factors(keyblock):
    """All safety factors of the powerhouse over meshes, on two rank groups."""
    with open(ROOT / "prm/study/powerhouse.prm", encoding="utf-8") as file:
        sizes = re.findall(
            r"set (Size|Size at excavation|Size at joints)\s*= ([\d.]+)$",
            file.read(), re.M)
    rows = []
    for scale in (1.3, 1., 0.7):
        run = Run(keyblock, "study/powerhouse", "Safety factor/Rank groups=2",
                  "Output/Write VTU=false",
                  *(f"Mesh/{name}={scale * float(value)}"
                    for name, value in sizes), ranks=2)
        if run.failed:
            rows.append((scale, "failed", "", "", "", ""))
            continue
        found = [b for b in run.summary["blocks"] if b.get("safety_factor")]
        rows.append((scale, run.cells, run.run["wall_time"],
                     sum(len(b["safety_factor"]) for b in found),
                     sum(len(f["trials"]) for b in found
                         for f in b["safety_factor"]),
                     "; ".join(f"{b['id']}: " + ", ".join(
                         f"{f['value']:.3g}" if "value" in f else f["outcome"]
                         for f in b["safety_factor"])
                               for b in found)))
    write_table("factors", ("mesh size over the study's", "cells",
                            "wall time [s]", "factors", "trials",
                            "by block and stage"), rows)


def skips(keyblock):
    """What each shortcut saves, and what it changes."""
    quasi_static = "Stages/dig/Kind=quasi-static"
    first = ("Safety factor/Stages=stage_1", "Safety factor/Blocks=3",
             "Output/Write VTU=false")

    def factor(run):
        return run.factor()["value"]

    def closure(run):
        return run.summary["checks"]["wall_closure"]

    def motion(run):
        return run.summary["stages"][-1]["max_displacement"]

    fall = ("Domain/Size=60,40", "Domain/Corner=-30,-30", "Mesh/Size=0.4",
            "Stages/Names=dig, fall", "Stages/dig/Kind=static",
            "Stages/fall/Duration=1.2", "Stages/fall/Damping ratio=0.1",
            "Output/History interval=100", "Output/Write VTU=false")
    cases = (
        ("trials move the block's surroundings only", "study/powerhouse",
         first, ("Safety factor/Reach=0",), factor),
        ("trials start from the last one that held", "study/powerhouse",
         first, ("Safety factor/Warm start=false",), factor),
        ("creep of a trial damped by its frequency", "study/powerhouse",
         ("Safety factor/Stages=stage_5", "Safety factor/Blocks=1",
          "Output/Write VTU=false"), ("Safety factor/Adaptive damping=false",),
         factor),
        ("scaled masses in a trial's second phase", "study/powerhouse",
         first, ("Safety factor/True masses=true",), factor),
        ("bisection instead of a sweep", "verification/factor_incline",
         (), ("Safety factor/Method=sweep",), factor),
        ("density scaling", "verification/kirsch_far_field", (quasi_static,),
         ("Stages/dig/Density scaling=false",), closure),
        ("far field by its stiffness: 4 radii instead of 30",
         "verification/kirsch_far_field",
         (quasi_static, "Domain/Corner=-4, -4", "Domain/Size=8, 8"),
         ("Domain/Corner=-30, -30", "Domain/Size=60, 60"), closure),
        ("fixed bodies without motion", "verification/incline_30", (),
         ("Materials/bed/Model=elastic", "Supports/Names=bottom",
          "Supports/bottom/Boundaries=bottom"), check_of("acceleration")),
        ("cells at rest: waves in a strip", "verification/pulse", (),
         ("Time stepping/Skip cells at rest=false",), check_of("value")),
        ("cells slower than 1e-3 of the fastest rest: the same",
         "verification/pulse", ("Time stepping/Rest speed=1e-3",),
         ("Time stepping/Rest speed=0",), check_of("value")),
        ("cells slower than 1e-2 of the fastest rest: a block falls",
         "verification/roof_block_falls",
         fall + ("Time stepping/Rest speed=1e-2",),
         ("Time stepping/Skip cells at rest=false",), check_of("value")),
        ("no energy ledger", "benchmark/elastic_2d",
         ("Time stepping/Energy ledger=false",),
         ("Time stepping/Energy ledger=true",), motion),
        ("no plastic state where rock is elastic", "benchmark/elastic_3d", (),
         ("Materials/rock/Model=mohr_coulomb", "Materials/rock/Cohesion=1e12",
          "Materials/rock/Tensile strength=1e12"), motion),
    )
    rows = []
    for name, scene, always, without, value_of in cases:
        measured = {True: [], False: []}
        for _ in range(1 if scene.startswith("study") else N_REPEATS):
            for is_on, settings in ((True, always), (False, always + without)):
                measured[is_on].append(Run(keyblock, scene, *settings))
        if any(run.failed for runs in measured.values() for run in runs):
            rows.append((name, scene, " ".join(without), "failed", "", "", ""))
            continue
        seconds = {is_on: statistics.median(
            r.trial_seconds() if value_of is factor else r.run["wall_time"]
            for r in runs) for is_on, runs in measured.items()}
        rows.append((name, scene, " ".join(without), seconds[True],
                     seconds[False], seconds[False] / seconds[True],
                     value_of(measured[True][0]) / value_of(measured[False][0])
                     - 1.))
        write_table("skips", ("shortcut", "scene", "switched off by",
                              "seconds with", "seconds without", "ratio",
                              "change of the result"), rows)


SECTIONS = {"rates": rates, "growth": growth, "ranks": ranks,
            "accuracy": accuracy, "published": published, "factors": factors,
            "skips": skips}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    names = sys.argv[2:] or list(SECTIONS)
    for name in names:
        if name != "report" and name not in SECTIONS:
            sys.exit(f"benchmark.py: there is no section '{name}'; name some "
                     f"of {', '.join(SECTIONS)}, report.")
    for name in names:
        if name != "report":
            SECTIONS[name](sys.argv[1])
            note_machine(name)
    benchmark_report.write(TABLES, ROOT / "doc")


if __name__ == "__main__":
    main()

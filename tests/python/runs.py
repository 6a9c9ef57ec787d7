#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs by the Python module.

usage: runs.py CASE PRM FOLDER [KEYBLOCK]     CASE: a function of this file
"""
import csv
import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import keyblock
import numpy
from tools import captured, check, check_raises, check_that, end

PRM, FOLDER = pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
INCLINE = PRM / "verification" / "factor_incline.prm"
FALLS = PRM / "verification" / "roof_block_falls.prm"
REMOVED = {"Safety factor/Removal slip": 0.05, "Safety factor/Blocks": "none"}


def column():
    """A column under its weight: displacement and stress against closed forms."""
    scene = keyblock.Scene(PRM / "verification" / "gravity_column.prm")
    before = set(os.listdir("."))
    with captured() as text:
        run = keyblock.Run(scene)
        stages = run.complete()
    check_that("nothing is printed", text == [""])
    check_that("nothing is written", set(os.listdir(".")) == before)
    check_that("one stage", [stage.name for stage in stages] == ["settle"])
    check_that("in balance", stages[0].converged and not run.has_stage_left)
    check("settlement", stages[0].max_displacement, 0.00655868571, 1e-8)
    blocks = run.blocks
    x, u, stress = blocks.vertices, run.displacement, run.stress
    modulus = 15e9 * 0.7 / (1.3 * 0.4)
    depth = 100. - x[:, 1]
    exact = -2700 * 9.81 / (2 * modulus) * (100**2 - depth**2)
    check("displacement", abs(u[:, 1] - exact).max(), 0., absolute=1e-10)
    check_that("shapes", u.shape == x.shape == run.velocity.shape and
               stress.shape == (len(blocks.cells), 3, 3))
    centers = x[blocks.cells].mean(axis=1)
    vertical = -2700 * 9.81 * (100. - centers[:, 1])
    check("vertical stress", abs(stress[:, 1, 1] / vertical - 1).max(), 0., absolute=1e-8)
    check("horizontal stress", abs(stress[:, 0, 0] / vertical - 3 / 7).max(), 0.,
          absolute=1e-8)
    check("shear", abs(stress[:, 0, 1]).max(), 0., absolute=1.)
    names, rows = run.history
    check("settlement in the history", rows[-1, names.index("top.u_y [m]")],
          -0.00655868571, 1e-8)
    run.close()
    check_raises(keyblock.Error, ["closed"], lambda: run.displacement)
    check("blocks outlive it", len(blocks.vertices), len(x))


def by_hand():
    """Stages run one by one leave the same files as a loop over the run."""
    with tempfile.TemporaryDirectory() as folder:
        run = keyblock.Run(keyblock.Scene(INCLINE), output=folder)
        while run.has_stage_left:
            run.run_stage(lambda progress: None)
        run.close()
        missing = {"summary.json", "blocks.csv", "history.csv"} - set(os.listdir(folder))
        check_that(f"results of the last stage are written (not {missing})", not missing)


def factor():
    """Strength reduction of one block, and the same by the program."""
    scene = keyblock.Scene(INCLINE, overrides={"Safety factor/Blocks": "none"})
    with keyblock.Run(scene) as run:
        check_raises(keyblock.Error, ["before a stage"], lambda: run.find_factor(1))
        run.run_stage()
        state = run.displacement, run.velocity, run.stress
        check_that("none was asked for by the scene", run.factors == [])
        found = run.find_factor(1)
        check_that("it is in the bracket", found.outcome == "value" and
                   found.lower < 0.6880592575 < found.upper)
        check("factor", found.value, 0.6880592575, absolute=2.1e-4)
        check("limit factor", found.limit_factor, 0.6880592575, 1e-8)
        check("stress ratio", found.stress_ratio, 0.6880592575, 1e-4)
        check_that("what it is of", (found.block, found.stage) == (1, "rest"))
        points = run.joint_points
        forces = [(points["area"][:, None] * points["shear"]).sum(0)[0],
                  points["area"] @ points["pressure"]]
        # 100 kg/m on 40 degrees
        for name, force, share in zip(("shear", "pressure"), forces,
                                      (math.sin(math.radians(40)),
                                       math.cos(math.radians(40)))):
            check(f"{name} on its base", abs(force), 981 * share, 1e-6)
        is_open = points["state"] == "open"  # it lifts uphill
        check_that("points of the base that are pressed stick, others have a gap",
                   (points["joint"] == "base").all() and 0 < is_open.sum() < 3 and
                   (points["state"][~is_open] == "sticking").all() and
                   (points["pressure"][is_open] == 0).all() and
                   (points["gap"][is_open] > 0).all())
        check_that("the block lies on the rock",
                   (numpy.sort(points["blocks"], axis=1) == (1, 2)).all())
        check_that("the state is as before", all(
            numpy.array_equal(before, now, equal_nan=True) for before, now in
            zip(state, (run.displacement, run.velocity, run.stress))))
        check_raises(keyblock.Error, ["no block 9", "1 to"], lambda: run.find_factor(9))
        check_raises(keyblock.Error, ["Block 2", "no safety factor"],
                     lambda: run.find_factor(2))
        check_raises(keyblock.Error, ["no stage left"], run.run_stage)

    # a block that fails in its stage, for which the state before is needed
    removed = keyblock.Scene(FALLS, overrides=REMOVED)
    with keyblock.Run(removed) as run:
        stage, = run.complete()
        check_that("it fails", "block 1 failed and was taken away" in stage.remark)
        asked = run.find_factor(1)
    with keyblock.Run(removed.with_overrides({"Safety factor/Blocks": 1})) as run:
        run.complete()
        own = run.factors[-1]
    check_that("the same as that which the scene asks for",
               (asked.outcome, asked.lower, asked.upper) == (own.outcome, own.lower, own.upper))


def program():
    """The module writes what the program writes, to the last digit."""
    for name in ("module", "program"):
        shutil.rmtree(FOLDER / name, ignore_errors=True)
    with captured() as text:
        run = keyblock.Run(keyblock.Scene(INCLINE), output=FOLDER / "module", verbose=True)
        run.complete()
    check_that("verbose is what the program prints",
               "Stage   rest: " in text[0] and "Factor  block 1 after rest: " in text[0])
    subprocess.run([sys.argv[4], str(INCLINE), "--output", str(FOLDER / "program")],
                   check=True, stdout=subprocess.DEVNULL)
    files = [sorted(path.name for path in (FOLDER / name).iterdir())
             for name in ("module", "program")]
    check_that(f"the files {files} are the same", files[0] == files[1])
    tables = []
    for name in ("module", "program"):
        with open(FOLDER / name / "history.csv", encoding="utf-8") as file:
            tables.append(list(csv.reader(file)))
    check_that("history.csv is the same", tables[0] == tables[1])
    check("rows of the history", len(run.history[1]), len(tables[0]) - 1)
    summaries = [json.loads((FOLDER / name / "summary.json").read_text(encoding="utf-8"))
                 for name in ("module", "program")]
    found = [summary["blocks"][0]["safety_factor"][0] for summary in summaries]
    check("factor", found[0]["value"], found[1]["value"])
    check("factor by the module", run.factors[0].value, found[1]["value"])


def several():
    """Scenes in 2D and 3D one after another give the same numbers each time."""
    def numbers(file, **overrides):
        run = keyblock.Run(keyblock.Scene(PRM / "verification" / file, overrides=overrides))
        stages = run.complete()
        return run.displacement, run.stress, [stage.energies for stage in stages]
    files = ("gravity_column.prm", "incline_30.prm", "incline_3d.prm")
    first = [numbers(file) for file in files]
    keyblock.find_blocks(keyblock.Scene(PRM / "verification" / "blocks_cube_4.prm"))
    check_raises(keyblock.Error, ["Joints/Nams"], lambda: keyblock.Scene(
        INCLINE, overrides={"Joints/Nams": "a"}))
    for file, before in zip(reversed(files), reversed(first)):
        now = numbers(file)
        check_that(f"{file} is the same again",
                   numpy.array_equal(before[0], now[0], equal_nan=True) and
                   numpy.array_equal(before[1], now[1], equal_nan=True) and
                   before[2] == now[2])
    # two runs at once, step by step
    runs = [keyblock.Run(keyblock.Scene(PRM / "verification" / file)) for file in files[:2]]
    for one in runs:
        for _ in one:
            pass
    check_that("runs side by side do not touch each other", all(
        numpy.array_equal(one.displacement, before[0]) for one, before in zip(runs, first)))


def stop():
    """Ctrl-C and callbacks that raise: the run goes on as if nothing had been."""
    scene = keyblock.Scene(PRM / "verification" / "incline_30.prm")

    def end_of(run):
        return run.displacement, run.velocity
    whole = keyblock.Run(scene)
    seen = []
    whole.complete(callback=seen.append, every=50)
    check_that("callbacks tell how far it is", len(seen) > 3 and
               [one.time for one in seen] == sorted(one.time for one in seen) and
               seen[-1].time > 0. and seen[0].stage in scene.stages)

    broken, n_calls = keyblock.Run(scene), []

    def fail(_):
        n_calls.append(1)
        if len(n_calls) in (2, 5):
            raise OSError("enough")
    n_stops = 0
    while broken.has_stage_left:
        try:
            broken.run_stage(fail, every=20)
        except OSError:
            n_stops += 1
    check("stops by what a callback raises", n_stops, 2)

    pressed, n_stops = keyblock.Run(scene), 0

    def press(progress):
        if progress.step in (30, 60):
            os.kill(os.getpid(), signal.SIGINT)
    handler = signal.getsignal(signal.SIGINT)
    while pressed.has_stage_left:
        try:
            pressed.run_stage(press, every=10)
        except KeyboardInterrupt:
            n_stops += 1
    check_that(f"Ctrl-C stopped {n_stops} times", n_stops >= 2)
    check_that("Python has its handler back", signal.getsignal(signal.SIGINT) is handler)
    for run in (broken, pressed):
        check_that("the end is the same", all(map(numpy.array_equal, end_of(whole),
                                                  end_of(run))))
    # in the search for a factor
    run = keyblock.Run(keyblock.Scene(INCLINE, overrides={
        "Safety factor/Blocks": "none", "Safety factor/Bracket": 1e-5,
        "Mesh/Cells": (80, 16)}))
    run.complete()
    state = end_of(run)
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        run.find_factor(1)
        check_that("Ctrl-C stops a search", False)
    except KeyboardInterrupt:
        pass
    check_that("the state is as before", all(map(numpy.array_equal, state, end_of(run))))
    # and a stage after it has the strength of any other
    ends = []
    for is_stopped in (False, True):
        run = keyblock.Run(keyblock.Scene(INCLINE, overrides={
            "Safety factor/Blocks": "none", "Safety factor/Bracket": 1e-5,
            "Mesh/Cells": (80, 16), "Stages/Names": "rest, slide",
            "Stages/slide/Kind": "dynamic", "Stages/slide/Duration": 0.02}))
        run.run_stage()
        if is_stopped:
            timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            try:
                run.find_factor(1)
                check_that("Ctrl-C stops a search between stages", False)
            except KeyboardInterrupt:
                pass
        run.run_stage()
        ends.append(end_of(run))
    check_that("the next stage is the same", all(map(numpy.array_equal, *ends)))
    # where nothing looks for it Python does, afterwards
    timer = threading.Timer(0.01, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        while True:
            keyblock.find_blocks(keyblock.Scene(PRM / "tutorial" / "first_tunnel.prm"))
    except KeyboardInterrupt:
        pass


def restart():
    """A run that was stopped, and one that goes on from its checkpoint."""
    def press(_):
        os.kill(os.getpid(), signal.SIGINT)

    def stopped(scene, folder, n_stops):
        """Run a scene to its end, stopped that often; the checkpoint is the last one."""
        run = keyblock.Run(scene, output=folder)
        for _ in range(n_stops):
            try:
                run.run_stage(press, every=50)
            except KeyboardInterrupt:
                pass
        run.complete()
        return run
    shutil.rmtree(FOLDER, ignore_errors=True)
    scene = keyblock.Scene(PRM / "verification" / "incline_30.prm")
    whole = stopped(scene, FOLDER / "incline", 2)
    again = keyblock.Run(scene, restart=FOLDER / "incline" / "checkpoint.h5")
    again.complete()
    check_that("the end is the same", numpy.array_equal(whole.displacement,
                                                        again.displacement))
    check_raises(keyblock.Error, ["another scene", "Friction angle"], lambda: keyblock.Run(
        scene.with_overrides({"Joints/*/Friction angle": 20}),
        restart=FOLDER / "incline" / "checkpoint.h5"))
    # a block that failed before the checkpoint, which has the state before that
    removed = keyblock.Scene(FALLS, overrides=REMOVED)
    run, checkpoint = keyblock.Run(removed, output=FOLDER / "falls"), None
    while run.has_stage_left:
        try:
            run.run_stage(press, every=50)
        except KeyboardInterrupt:
            checkpoint = FOLDER / "falls" / "checkpoint.h5"
    again = keyblock.Run(removed, restart=checkpoint)
    again.complete()
    own, found = run.find_factor(1), again.find_factor(1)
    check_that("its factor is that of the whole run",
               (own.outcome, own.lower, own.upper) == (found.outcome, found.lower, found.upper))


def threads():
    """Other threads go on while the program computes; computations queue up."""
    count, is_done = [0], threading.Event()

    def tick():
        while not is_done.is_set():
            count[0] += 1
            time.sleep(0.001)
    counter = threading.Thread(target=tick)
    counter.start()
    before, start = count[0], time.time()
    keyblock.Run(keyblock.Scene(INCLINE)).complete()
    rate = (count[0] - before) / (time.time() - start)
    is_done.set()
    counter.join()
    check_that(f"another thread goes on: {rate} ticks a second", rate > 30)

    results = {}

    def work(angle):
        scene = keyblock.Scene(INCLINE, overrides={"Joints/base/Friction angle": angle})
        results[angle] = keyblock.find_blocks(scene).limit_equilibrium()[-1].factor
    workers = [threading.Thread(target=work, args=(20. + i,)) for i in range(8)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    exact = numpy.tan(numpy.radians(20. + numpy.arange(8))) / numpy.tan(numpy.radians(40.))
    check("factors of eight threads", abs(numpy.array(
        [results[angle] for angle in sorted(results)]) - exact).max(), 0., absolute=1e-9)


def ranks():
    """Under mpirun: what a run gathers is the same on all ranks, and as on one."""
    run = keyblock.Run(keyblock.Scene(PRM / "verification" / "gravity_column.prm"))
    run.complete()
    check("sum over ranks", keyblock.sum_over_ranks(numpy.ones((2, 2))).sum(),
          4. * keyblock.size())
    check("displacements", abs(run.displacement[:, 1]).max(), 0.00655868571, 1e-8)
    check_that("all cells have a stress", numpy.isfinite(run.stress).all())
    sums = keyblock.sum_over_ranks([run.displacement.sum(), run.stress.sum()])
    check("the same displacement on all ranks", sums[0],
          keyblock.size() * run.displacement.sum(), 1e-12)
    sweep = keyblock.sweep(INCLINE, {"Joints/base/Friction angle": numpy.arange(20, 31.)})
    exact = numpy.tan(numpy.radians(numpy.arange(20, 31.))) / numpy.tan(numpy.radians(40.))
    check("shared sweep", abs(sweep.factor - exact).max(), 0., absolute=1e-9)
    check("shares", keyblock.sum_over_ranks([len(sweep.samples)])[0], 11)
    check_that("each has some", 0 < len(sweep.samples) <= 11 // keyblock.size() + 1)
    # what only some ranks meet is raised by all, that of the first combination
    check_raises(keyblock.Error, ["Friction angle=95"], lambda: keyblock.sweep(
        INCLINE, {"Joints/base/Friction angle": [20, 25, 30, 95, 35, 96]}))
    check("and no rank waits", keyblock.sum_over_ranks([1.])[0], keyblock.size())
    found = keyblock.find_blocks(keyblock.Scene(INCLINE))
    check("blocks on all ranks", found[0].volume, 0.05, 1e-10)
    check_raises(keyblock.Error, ["no_such.prm"], lambda: keyblock.Scene("no_such.prm"))
    # left open: it is closed before MPI ends
    globals()["left"] = keyblock.Run(keyblock.Scene(INCLINE))


if __name__ == "__main__":
    globals()[sys.argv[1]]()
    end()
